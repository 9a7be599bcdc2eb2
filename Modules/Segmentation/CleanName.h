// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace myotet::segmentation {

/// A label's name as one line of UTF-8, whatever a file holds: text that is no
/// UTF-8 is taken as ISO 8859-1 (Western Europe), control characters become
/// blanks, blanks at both ends go. Names travel to files that must be valid.
[[nodiscard]] std::string clean_name(std::string_view text);

}  // namespace myotet::segmentation
