// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace myotet::report {

/// A zlib stream (RFC 1950) of the bytes, as browsers unpack it; the same for the same bytes.
[[nodiscard]] std::string deflated(std::string_view bytes);

}  // namespace myotet::report
