// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Table.h"

#include <cmath>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "Core/Text.h"
#include "Skeleton/TableRows.h"

namespace myotet::skeleton {
namespace {

/// What another reader could not read back.
void check_writable(const Table& table, const std::string& units,
                    const std::filesystem::path& file) {
    const auto wrong = [&](const std::string& why) {
        throw InputError(file.string() + ": cannot be written: " + why);
    };
    if (table.title.find('\n') != std::string::npos || lower(trimmed(table.title)) == "endheader")
        wrong("the title must be one line that does not end the header; change it");
    if (units.find('\n') != std::string::npos) wrong("its units must be one line; change them");
    for (const std::string& name : table.columns)
        if (name.empty() || name.find_first_of(" \t\r\n\v\f") != std::string::npos)
            wrong("the column '" + name + "' must have a name without blanks; change it");
    if (table.times.size() != table.rows.size() || table.times.empty())
        wrong("it has " + std::to_string(table.rows.size()) + " rows and " +
              std::to_string(table.times.size()) + " times; give as many, at least one");
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const std::string row = "row " + std::to_string(i + 1);
        if (!std::isfinite(table.times[i]) || (i > 0 && !(table.times[i] > table.times[i - 1])))
            wrong(row + " has time " + shown(table.times[i]) + ", but times must ascend");
        if (table.rows[i].size() != table.columns.size())
            wrong(row + " has " + std::to_string(table.rows[i].size()) +
                  " numbers, but there are " + std::to_string(table.columns.size()) +
                  " columns; give as many");
        for (const double value : table.rows[i])
            if (!std::isfinite(value))
                wrong(row + " holds " + shown(value) + "; give finite numbers");
    }
}

}  // namespace

Table read_table(const std::filesystem::path& file) {
    TableRows rows(file);
    Table table;
    table.title = rows.title();
    table.in_degrees = rows.in_degrees();
    table.columns.assign(rows.names().begin() + 1, rows.names().end());
    while (rows.next()) {
        const double time = rows.number(0);
        if (!table.times.empty() && !(time > table.times.back()))
            rows.refuse("the time " + shown(time) + " follows " + shown(table.times.back()) +
                        ", but times must ascend; sort the rows and leave out repeated ones");
        table.times.push_back(time);
        auto& row = table.rows.emplace_back();
        row.reserve(table.columns.size());
        for (std::size_t c = 1; c <= table.columns.size(); ++c) row.push_back(rows.number(c));
    }
    return table;
}

void write_table(const Table& table, const std::string& units, const std::filesystem::path& file) {
    check_writable(table, units, file);
    std::string text = (table.title.empty() ? "table" : table.title) +
                       "\nversion=1\nnRows=" + std::to_string(table.rows.size()) +
                       "\nnColumns=" + std::to_string(table.columns.size() + 1) +
                       "\ninDegrees=" + (table.in_degrees ? "yes" : "no") + "\nunits=" + units +
                       "\nendheader\ntime";
    for (const std::string& name : table.columns) text += "\t" + name;
    text += '\n';
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        text += shown(table.times[i]);
        for (const double value : table.rows[i]) text += "\t" + shown(value);
        text += '\n';
    }
    write_atomically(file, text);
}

std::string_view short_name(std::string_view column) {
    for (const std::string_view end : {"/value", "/activation", ".activation"})
        if (column.ends_with(end)) column.remove_suffix(end.size());
    return column.substr(column.rfind('/') + 1);
}

int find_column(const Table& table, const std::string& name) {
    int found = -1;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        const std::string& column = table.columns[c];
        if (column != name && short_name(column) != name) continue;
        if (found >= 0)
            throw InputError("'" + name + "' may be the column " +
                             table.columns[static_cast<std::size_t>(found)] + " or " + column +
                             "; take one of them out of the table");
        found = static_cast<int>(c);
    }
    return found;
}

}  // namespace myotet::skeleton
