// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/CleanName.h"

#include <cstdint>

#include "Segmentation/TextHeader.h"

namespace myotet::segmentation {
namespace {

/// Bytes of the UTF-8 sequence that starts here (RFC 3629); 0 when it is none.
std::size_t sequence_at(std::string_view text) {
    const auto byte = [&](std::size_t n) { return static_cast<std::uint8_t>(text[n]); };
    const std::uint8_t lead = byte(0);
    if (lead < 0x80) return 1;
    const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < size) return 0;
    for (std::size_t n = 1; n < size; ++n)
        if ((byte(n) & 0xC0) != 0x80) return 0;
    const bool overlong = (lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xF0 && byte(1) < 0x90);
    const bool surrogate = lead == 0xED && byte(1) >= 0xA0;
    const bool past_end = lead == 0xF4 && byte(1) >= 0x90;
    return overlong || surrogate || past_end ? 0 : size;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t size = sequence_at(text);
        if (size == 0) return false;
        text.remove_prefix(size);
    }
    return true;
}

std::string from_latin1(std::string_view text) {
    std::string utf8;
    for (const char c : text) {
        const auto code = static_cast<std::uint8_t>(c);
        if (code < 0x80) {
            utf8 += c;
        } else {
            utf8 += static_cast<char>(0xC0 | code >> 6);
            utf8 += static_cast<char>(0x80 | (code & 0x3F));
        }
    }
    return utf8;
}

}  // namespace

std::string clean_name(std::string_view text) {
    std::string name = is_utf8(text) ? std::string(text) : from_latin1(text);
    for (char& c : name)
        if (static_cast<std::uint8_t>(c) < 0x20 || c == 0x7F) c = ' ';
    return std::string(trimmed(name));
}

}  // namespace myotet::segmentation
