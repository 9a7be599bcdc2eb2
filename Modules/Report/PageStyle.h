// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace myotet::report {

/// The style sheet of every page: light and dark, narrow screens, paper.
extern const std::string_view kPageStyle;

/// The script of every page; it turns rows of pictures into sliders.
extern const std::string_view kPageScript;

}  // namespace myotet::report
