// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string>
#include <string_view>

#include "Core/Errors.h"

namespace myotet::meshfiles {

/// Walks through a text line by line and word by word; knows the line number
/// for messages. Numbers do not depend on the locale.
class TextReader {
public:
    TextReader(std::string_view text, const std::filesystem::path& file)
        : text_(text), file_(file) {}

    /// Goes to the next line; false at the end of the text.
    bool next_line() {
        if (at_ >= text_.size()) return false;
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        line_ = text_.substr(at_, end - at_);
        at_ = end + 1;
        ++number_;
        return true;
    }
    /// The next word of the line, or empty.
    std::string_view word() {
        const std::size_t from = line_.find_first_not_of(kBlank);
        if (from == std::string_view::npos) return line_ = {};
        const std::size_t end = std::min(line_.find_first_of(kBlank, from), line_.size());
        const std::string_view found = line_.substr(from, end - from);
        line_.remove_prefix(end);
        return found;
    }
    /// What is left of the line.
    [[nodiscard]] std::string_view rest() const { return line_; }
    /// All that follows the line.
    [[nodiscard]] std::string_view remainder() const {
        return text_.substr(std::min(at_, text_.size()));
    }
    void forget_after(char mark) { line_ = line_.substr(0, line_.find(mark)); }

    template <class Number>
    Number number(std::string_view what) {
        return to_number<Number>(word(), what);
    }
    template <class Number>
    Number to_number(std::string_view said, std::string_view what) const {
        Number value{};
        const char* first = said.data();
        const char* last = first + said.size();
        if (first != last && *first == '+') ++first;
        const auto [end, error] = std::from_chars(first, last, value);
        if (error != std::errc{} || end != last) {
            if (said.empty()) fail("ends where " + std::string(what) + " should stand");
            fail("holds '" + std::string(said) + "' where " + std::string(what) + " should stand");
        }
        return value;
    }
    [[noreturn]] void fail(const std::string& defect) const {
        throw InputError(file_.string() + ": line " + std::to_string(number_) + " " + defect +
                         "; the file is damaged or not what its name says, export it again");
    }

private:
    static constexpr std::string_view kBlank = " \t\r\v\f";
    std::string_view text_, line_;
    std::filesystem::path file_;
    std::size_t at_ = 0;
    std::size_t number_ = 0;
};

}  // namespace myotet::meshfiles
