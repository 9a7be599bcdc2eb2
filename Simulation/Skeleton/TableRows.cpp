// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/TableRows.h"

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"
#include "Core/Text.h"

namespace myotet::skeleton {
namespace {

using View = std::string_view;
constexpr View kBlank = " \t\r\v\f";

/// Cells between separators; between blanks where there is none.
std::vector<View> cells_of(View line, char separator) {
    std::vector<View> cells;
    if (separator == 0) line = trimmed(line);
    while (separator == 0 && !line.empty()) {
        const std::size_t end = std::min(line.find_first_of(kBlank), line.size());
        cells.push_back(line.substr(0, end));
        line = trimmed(line.substr(end));
    }
    for (bool more = separator != 0; more;) {
        const std::size_t end = line.find(separator);
        View cell = trimmed(line.substr(0, end));
        if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
            cell = cell.substr(1, cell.size() - 2);
        cells.push_back(cell);
        more = end != View::npos;
        if (more) line.remove_prefix(end + 1);
    }
    return cells;
}

}  // namespace

TableRows::TableRows(const std::filesystem::path& file) : file_(file), content_(read_whole(file)) {
    if (content_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    const std::string extension = lower(file.extension().string());
    const bool opensim = extension == ".sto" || extension == ".mot";
    if (!opensim && extension != ".csv")
        throw InputError(file.string() + ": '" + extension +
                         "' is no table that is read; use .csv, .sto or .mot");
    if (opensim) pass_header();
    if (!next_line())
        throw InputError(file.string() +
                         ": has no line of column names; write one, such as "
                         "'time,biceps'");
    read_names(opensim);
    check_names();
}

/// The next line that is not empty.
bool TableRows::next_line() {
    while (at_ < content_.size()) {
        const std::size_t end = std::min(content_.find('\n', at_), content_.size());
        line_ = View(content_).substr(at_, end - at_);
        if (line_.ends_with('\r')) line_.remove_suffix(1);
        at_ = end + 1;
        ++line_number_;
        if (!trimmed(line_).empty()) return true;
    }
    return false;
}

void TableRows::pass_header() {
    bool says_unit = lower(file_.extension().string()) != ".mot";
    for (bool first = true; next_line(); first = false) {
        const View line = trimmed(line_);
        const std::string small = lower(line);
        if (small == "endheader") {
            in_degrees_ |= !says_unit;
            return;
        }
        if (first) title_ = line;
        says_unit |= small.starts_with("version") || small.starts_with("indegrees") ||
                     small.starts_with("angles are in");
        if (small.starts_with("angles are in")) in_degrees_ = small.find("degree") != View::npos;
        note_promise(line);
    }
    throw InputError(file_.string() +
                     ": has no line 'endheader', which ends the header of an OpenSim table; a "
                     "table without a header is read as .csv");
}

/// OpenSim: `nRows=121`; SIMM: `datarows 121`.
void TableRows::note_promise(View line) {
    const std::size_t end = line.find_first_of("= \t");
    if (end == View::npos) return;
    const std::string key = lower(line.substr(0, end));
    View rest = trimmed(line.substr(end + 1));
    if (rest.starts_with('=')) rest = trimmed(rest.substr(1));
    const auto value = to_number(rest);
    if (key == "nrows" || key == "nr" || key == "datarows") promised_rows_ = value;
    if (key == "ncolumns" || key == "nc" || key == "datacolumns") promised_columns_ = value;
    if (key == "indegrees") in_degrees_ = lower(rest).starts_with('y');
}

void TableRows::read_names(bool opensim) {
    const auto holds = [&](char c) { return line_.find(c) != View::npos; };
    if (!opensim) separator_ = holds('\t') ? '\t' : holds(';') ? ';' : ',';
    for (const View name : cells_of(line_, separator_)) names_.emplace_back(name);
}

void TableRows::check_names() const {
    if (to_number(names_.front()))
        refuse("here stands the number '" + names_.front() +
               "' where column names must; write a line of names first, such as 'time,biceps'");
    const std::string first = lower(names_.front());
    if (separator_ == 0 && first != "time")
        refuse("the first column is '" + names_.front() +
               "' but must be 'time', in s; export the table with its times");
    if (first.find("ms") != std::string::npos)
        refuse("the first column is '" + names_.front() +
               "', but times are s; divide them by 1000 and name the column 'time'");
    if (promised_columns_ && *promised_columns_ != static_cast<double>(names_.size()))
        refuse("the header says " + shown(*promised_columns_) + " columns, but " +
               std::to_string(names_.size()) + " are named; correct one of them");
}

bool TableRows::next() {
    if (next_line()) {
        cells_ = cells_of(line_, separator_);
        if (cells_.size() != names_.size())
            refuse("holds " + std::to_string(cells_.size()) + " numbers, but there are " +
                   std::to_string(names_.size()) + " columns; correct the row");
        ++rows_;
        return true;
    }
    if (rows_ == 0) refuse("no row follows the names; add at least one");
    if (promised_rows_ && *promised_rows_ != rows_)
        throw InputError(file_.string() + ": the header says " + shown(*promised_rows_) +
                         " rows, but there are " + shown(rows_) +
                         "; the file is cut short, or its nRows is to be corrected");
    return false;
}

double TableRows::number(std::size_t column) const {
    const View cell = cells_[column];
    const auto value = to_number(cell);
    if (value && std::isfinite(*value)) return *value;
    const bool comma = cell.find(',') != View::npos;
    refuse("column '" + names_[column] + "' holds '" + std::string(cell) +
           "' where a finite number should stand; " +
           (comma ? "write decimals with a point" : "correct the row or leave it out"));
}

void TableRows::refuse(const std::string& why) const { myotet::refuse(file_, line_number_, why); }

}  // namespace myotet::skeleton
