// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "Contraction/Curve.h"
#include "Contraction/Words.h"
#include "Core/Errors.h"

namespace myotet::contraction {
namespace fs = std::filesystem;

namespace {

using View = std::string_view;
constexpr View kBlank = " \t\r\v\f";

View trimmed(View text) {
    const std::size_t from = text.find_first_not_of(kBlank);
    if (from == View::npos) return {};
    return text.substr(from, text.find_last_not_of(kBlank) - from + 1);
}

std::string lower(View text) {
    std::string small(text);
    std::ranges::transform(small, small.begin(), [](unsigned char c) { return std::tolower(c); });
    return small;
}

/// Lines one after the other, the empty ones left out.
struct Lines {
    View text;
    std::size_t at = 0;
    int number = 0;
    View line;

    bool next() {
        while (at < text.size()) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            line = text.substr(at, end - at);
            if (line.ends_with('\r')) line.remove_suffix(1);
            at = end + 1;
            ++number;
            if (!trimmed(line).empty()) return true;
        }
        return false;
    }
};

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

/// The numbers that the header of an OpenSim file promises.
struct Promise {
    std::optional<double> rows, columns;
};

/// OpenSim: `nRows=121`; SIMM: `datarows 121`.
void note_promise(View line, Promise& promise) {
    const std::size_t end = line.find_first_of("= \t");
    if (end == View::npos) return;
    const std::string key = lower(line.substr(0, end));
    const auto value = to_number(trimmed(line.substr(end + 1)));
    if (key == "nrows" || key == "nr" || key == "datarows") promise.rows = value;
    if (key == "ncolumns" || key == "nc" || key == "datacolumns") promise.columns = value;
}

Promise pass_header(Lines& lines, const fs::path& file) {
    Promise promise;
    while (lines.next()) {
        const View line = trimmed(lines.line);
        if (lower(line) == "endheader") return promise;
        note_promise(line, promise);
    }
    throw InputError(file.string() +
                     ": has no line 'endheader', which ends the header of an OpenSim table; a "
                     "table without a header is read as .csv");
}

/// The name that users know a column by.
View short_name(View column) {
    for (const View end : {"/activation", ".activation"})
        if (column.ends_with(end)) column.remove_suffix(end.size());
    return column.substr(column.rfind('/') + 1);
}

/// A table whose names are read and whose rows are not.
struct Table {
    const fs::path& file;
    Lines lines;
    char separator = 0;
    Promise promise;
    std::vector<View> names;
};

Table open_table(const fs::path& file, View content) {
    if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);
    Table table{file, {content}};
    const std::string extension = lower(file.extension().string());
    const bool opensim = extension == ".sto" || extension == ".mot";
    if (!opensim && extension != ".csv")
        throw InputError(file.string() + ": '" + extension +
                         "' is no table that is read; use .csv, .sto or .mot");
    if (opensim) table.promise = pass_header(table.lines, file);
    if (!table.lines.next())
        throw InputError(file.string() +
                         ": has no line of column names; write one, such as "
                         "'time,biceps'");
    const View line = table.lines.line;
    const auto holds = [&](char c) { return line.find(c) != View::npos; };
    if (!opensim) table.separator = holds('\t') ? '\t' : holds(';') ? ';' : ',';
    table.names = cells_of(line, table.separator);
    return table;
}

void check_names(const Table& table) {
    const auto wrong = [&](const std::string& why) { refuse(table.file, table.lines.number, why); };
    if (to_number(table.names.front()))
        wrong("here stands the number '" + std::string(table.names.front()) +
              "' where column names must; write a line of names first, such as 'time,biceps'");
    const std::string first = lower(table.names.front());
    if (table.separator == 0 && first != "time")
        wrong("the first column is '" + std::string(table.names.front()) +
              "' but must be 'time', in s; export the table with its times");
    if (first.find("ms") != std::string::npos)
        wrong("the first column is '" + std::string(table.names.front()) +
              "', but times are s; divide them by 1000 and name the column 'time'");
    const auto promised = table.promise.columns;
    if (promised && *promised != static_cast<double>(table.names.size()))
        wrong("the header says " + shown(*promised) + " columns, but " +
              std::to_string(table.names.size()) + " are named; correct one of them");
}

/// Where the column stands, from 0.
std::size_t find_column(const Table& table, const std::string& column) {
    std::vector<std::size_t> found;
    std::vector<std::string> known;
    for (std::size_t c = 1; c < table.names.size(); ++c) {
        known.emplace_back(table.names[c]);
        if (table.names[c] == column || short_name(table.names[c]) == column) found.push_back(c);
    }
    if (found.size() > 1)
        refuse(table.file, table.lines.number,
               "'" + column + "' may be " + std::string(table.names[found[0]]) + " or " +
                   std::string(table.names[found[1]]) + "; give the column by its number, " +
                   std::to_string(found[0] + 1) + " or " + std::to_string(found[1] + 1));
    if (found.size() == 1) return found[0];
    const auto number = to_number(column);
    if (number && *number >= 2 && *number <= static_cast<double>(table.names.size()) &&
        *number == std::floor(*number))
        return static_cast<std::size_t>(*number) - 1;
    refuse(table.file, table.lines.number,
           "has no column '" + column + "'" + known_are(column, known));
}

double number_in(const Table& table, View cell, View name) {
    const auto value = to_number(cell);
    if (value && std::isfinite(*value)) return *value;
    const bool comma = cell.find(',') != View::npos;
    refuse(table.file, table.lines.number,
           "column '" + std::string(name) + "' holds '" + std::string(cell) +
               "' where a finite number should stand; " +
               (comma ? "write decimals with a point" : "correct the row or leave it out"));
}

}  // namespace

Curve read_activation(const fs::path& file, const std::string& column) {
    const std::string content = read_whole(file);
    Table table = open_table(file, content);
    check_names(table);
    const std::size_t at = find_column(table, column);
    Curve curve;
    while (table.lines.next()) {
        const auto cells = cells_of(table.lines.line, table.separator);
        if (cells.size() != table.names.size())
            refuse(file, table.lines.number,
                   "holds " + std::to_string(cells.size()) + " numbers, but there are " +
                       std::to_string(table.names.size()) + " columns; correct the row");
        const double time = number_in(table, cells[0], table.names[0]);
        const double value = number_in(table, cells[at], table.names[at]);
        if (const std::string wrong = add_activation(curve, time, value); !wrong.empty())
            refuse(file, table.lines.number, "in column '" + column + "' " + wrong);
    }
    const auto rows = static_cast<double>(curve.times.size());
    if (rows == 0) refuse(file, table.lines.number, "no row follows the names; add at least one");
    if (table.promise.rows && *table.promise.rows != rows)
        throw InputError(file.string() + ": the header says " + shown(*table.promise.rows) +
                         " rows, but there are " + shown(rows) +
                         "; the file is cut short, or its nRows is to be corrected");
    return curve;
}

}  // namespace myotet::contraction
