// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace myotet::report {

/// The viewer's script, a zlib stream in base64; empty where it was not built.
extern const std::string_view kViewerProgram;

/// Name, version and licence, with its text, of each package that went into the script.
extern const std::string_view kViewerNotices;

}  // namespace myotet::report
