// SPDX-License-Identifier: Apache-2.0
#include "Fibres/SolidFile.h"

#include <charconv>
#include <fstream>
#include <string>
#include <string_view>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"

namespace myotet::fibres {
namespace {

constexpr std::string_view kName = "myotet-bspline-solid", kVersion = "1";

template <class Number>
void put(std::string& text, Number value) {
    char digits[40];
    const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
    text.append(1, ' ').append(digits, end);
}

/// Walks through the file line by line and word by word, and knows the line.
class Lines {
public:
    explicit Lines(const std::filesystem::path& file) : file_(file), in_(file) {
        if (!in_)
            throw IoError(file.string() + ": cannot be opened; check the name and the rights");
    }
    /// Goes to the next line that says something; false at the end.
    bool next() {
        while (std::getline(in_, line_)) {
            ++number_;
            line_.resize(std::min(line_.find('#'), line_.size()));
            at_ = 0;
            if (line_.find_first_not_of(kBlank) != std::string::npos) return true;
        }
        if (in_.bad()) throw IoError(file_.string() + ": cannot be read to its end");
        return false;
    }
    /// The next word of the line, or empty.
    std::string_view word() {
        const std::size_t from = std::min(line_.find_first_not_of(kBlank, at_), line_.size());
        at_ = std::min(line_.find_first_of(kBlank, from), line_.size());
        return std::string_view(line_).substr(from, at_ - from);
    }
    template <class Number>
    Number number(std::string_view what) {
        const std::string_view said = word();
        Number value{};
        const auto [end, error] = std::from_chars(said.data(), said.data() + said.size(), value);
        if (said.empty() || error != std::errc{} || end != said.data() + said.size())
            fail("has '" + std::string(said) + "' where " + std::string(what) + " should stand");
        return value;
    }
    void end_of_line() {
        if (const std::string_view more = word(); !more.empty())
            fail("has '" + std::string(more) + "' after its last word");
    }
    [[noreturn]] void fail(const std::string& defect) const {
        throw InputError(file_.string() + ": line " + std::to_string(number_) + " " + defect +
                         "; write the B-spline solid again");
    }

private:
    static constexpr const char* kBlank = " \t\r\v\f";
    std::filesystem::path file_;
    std::ifstream in_;
    std::string line_;
    std::size_t at_ = 0, number_ = 0;
};

/// A line of this word and value.
void expect(Lines& lines, std::string_view name, std::string_view value) {
    const std::string rule = "should be '" + std::string(name) + " " + std::string(value) + "'";
    if (!lines.next()) lines.fail("is the last, but the next " + rule);
    if (lines.word() != name || lines.word() != value) lines.fail(rule);
    lines.end_of_line();
}

std::array<int, 3> three(Lines& lines, std::string_view name) {
    const std::string rule = "should be '" + std::string(name) + "' and three whole numbers";
    if (!lines.next()) lines.fail("is the last, but the next " + rule);
    if (lines.word() != name) lines.fail(rule);
    std::array<int, 3> value;
    for (int& v : value) v = lines.number<int>("a whole number");
    lines.end_of_line();
    return value;
}

}  // namespace

void write_solid(const BSplineSolid& solid, const std::filesystem::path& file) {
    solid.validate();
    std::string text;
    text.append(kName).append(" ").append(kVersion).append("\nunit mm\nframe LPS\ndegree");
    for (const int d : solid.shape.degree) put(text, d);
    text.append("\ncount");
    for (const int c : solid.shape.count) put(text, c);
    text.append("\n");
    for (const Vec3& p : solid.control) {
        for (int a = 0; a < 3; ++a) put(text, p[a]);
        text.append("\n");
    }
    write_atomically(file, text);
}

BSplineSolid read_solid(const std::filesystem::path& file) {
    Lines lines(file);
    expect(lines, kName, kVersion);
    expect(lines, "unit", "mm");
    expect(lines, "frame", "LPS");
    BSplineSolid solid;
    solid.shape.degree = three(lines, "degree");
    solid.shape.count = three(lines, "count");
    try {
        solid.shape.validate();
    } catch (const InputError& error) {
        lines.fail(std::string("ends a shape that cannot be: ") + error.what());
    }
    const std::size_t points = solid.shape.controls();
    while (lines.next()) {
        if (solid.control.size() == points)
            lines.fail("follows the last of " + std::to_string(points) + " control points");
        Vec3 p;
        for (int a = 0; a < 3; ++a) p[a] = lines.number<double>("a coordinate");
        if (!p.allFinite()) lines.fail("has a coordinate that is not finite");
        lines.end_of_line();
        solid.control.push_back(p);
    }
    if (solid.control.size() != points)
        lines.fail("ends the file after " + std::to_string(solid.control.size()) + " of " +
                   std::to_string(points) + " control points");
    return solid;
}

}  // namespace myotet::fibres
