// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

#include "Core/Errors.h"
#include "MeshFiles/RawMesh.h"

namespace myotet::meshfiles {

/// Walks through a file word by word, wherever its lines end, or through raw
/// numbers; knows the line for messages.
class TokenReader {
public:
    /// `comment`: the sign after which a line says nothing, or 0.
    TokenReader(std::string_view content, const std::filesystem::path& file, char comment = 0)
        : content_(content), file_(file), comment_(comment) {}

    /// The next word, or empty at the end.
    std::string_view word() {
        skip_blank();
        const std::size_t from = at_;
        while (at_ < content_.size() && !blank(content_[at_])) ++at_;
        return content_.substr(from, at_ - from);
    }
    /// What is left of the line.
    std::string_view rest_of_line() {
        const std::size_t from = at_;
        at_ = std::min(content_.find('\n', at_), content_.size());
        return content_.substr(from, at_ - from);
    }
    /// All up to `mark`, which is passed as well.
    std::string_view up_to(std::string_view mark) {
        const std::size_t end = content_.find(mark, at_);
        if (end == std::string_view::npos) fail_short();
        const std::string_view found = content_.substr(at_, end - at_);
        at_ = end + mark.size();
        return found;
    }
    template <class Number>
    Number number(std::string_view what) {
        std::string_view said = word();
        const std::string_view shown = said;
        if (said.empty()) fail_short();
        if (said.front() == '+') said.remove_prefix(1);
        Number value{};
        const auto [end, error] = std::from_chars(said.data(), said.data() + said.size(), value);
        if (error != std::errc{} || end != said.data() + said.size())
            fail("holds '" + std::string(shown.substr(0, 40)) + "' where " + std::string(what) +
                 " should stand");
        return value;
    }
    /// A number as the machine stores it.
    template <class Number>
    Number raw() {
        if (content_.size() - at_ < sizeof(Number)) fail_short();
        Number value{};
        std::memcpy(&value, content_.data() + at_, sizeof value);
        at_ += sizeof value;
        return value;
    }
    /// Throws unless `count` things of at least `bytes` bytes each can follow.
    std::int64_t require_room(std::int64_t count, std::int64_t bytes) const {
        if (count < 0) fail("counts fewer than zero");
        if (count > static_cast<std::int64_t>(content_.size() - at_) / bytes) fail_short();
        return count;
    }
    /// Passes the end of the line before raw numbers begin.
    void end_line() {
        if (at_ < content_.size() && content_[at_] == '\r') ++at_;
        if (at_ < content_.size() && content_[at_] == '\n') ++at_;
    }
    [[noreturn]] void fail(const std::string& defect) const {
        throw InputError(file_.string() + ": line " +
                         std::to_string(line_at(content_, static_cast<std::ptrdiff_t>(at_))) + " " +
                         defect +
                         "; the file is damaged or of a kind that is not read, export it again");
    }
    [[noreturn]] void fail_short() const {
        throw IoError(file_.string() +
                      ": ends before it is complete; the file is cut short, "
                      "copy or export it again");
    }

private:
    static bool blank(char c) {
        return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
    }
    void skip_blank() {
        while (at_ < content_.size()) {
            if (comment_ != 0 && content_[at_] == comment_)
                at_ = std::min(content_.find('\n', at_), content_.size());
            else if (blank(content_[at_]))
                ++at_;
            else
                return;
        }
    }
    std::string_view content_;
    std::filesystem::path file_;
    std::size_t at_ = 0;
    char comment_;
};

}  // namespace myotet::meshfiles
