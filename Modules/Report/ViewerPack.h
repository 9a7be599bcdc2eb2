// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "Report/Viewer.h"

namespace myotet::report {

/// A scene as the viewer's program reads it; viewer/src/header.ts names the header's members.
struct PackedScene {
    std::string header;  ///< JSON
    std::string data;    ///< bytes
};
[[nodiscard]] PackedScene packed(const ViewedScene& scene);

}  // namespace myotet::report
