// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <concepts>
#include <string>
#include <string_view>

namespace myotet::meshfiles {

/// Collects a text. Numbers do not depend on the locale; doubles are the
/// shortest text that reads back as the same number.
class TextWriter {
public:
    template <class... Parts>
    TextWriter& add(const Parts&... parts) {
        (put(parts), ...);
        return *this;
    }
    template <class... Parts>
    TextWriter& line(const Parts&... parts) {
        return add(parts..., '\n');
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    void put(std::string_view part) { text_.append(part); }
    void put(char part) { text_.push_back(part); }
    template <class Number>
    requires std::integral<Number> || std::floating_point<Number>
    void put(Number number) {
        char digits[40];
        const auto [end, error] = std::to_chars(digits, digits + sizeof digits, number);
        text_.append(digits, end);
    }
    std::string text_;
};

/// The text as XML writes it.
[[nodiscard]] inline std::string xml_escaped(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        if (c == '&')
            safe += "&amp;";
        else if (c == '<')
            safe += "&lt;";
        else if (c == '>')
            safe += "&gt;";
        else if (c == '"')
            safe += "&quot;";
        else
            safe += c;
    }
    return safe;
}

/// What every text format says of itself in a comment.
inline constexpr std::string_view kFacts = "Myotet; SPACE=LPS; UNIT=mm";

}  // namespace myotet::meshfiles
