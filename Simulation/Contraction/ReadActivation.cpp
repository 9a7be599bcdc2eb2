// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "Contraction/Curve.h"
#include "Contraction/Words.h"
#include "Skeleton/Table.h"
#include "Skeleton/TableRows.h"

namespace myotet::contraction {
namespace {

/// Where the column stands, from 0.
std::size_t find_column(const skeleton::TableRows& rows, const std::string& column) {
    const auto& names = rows.names();
    std::vector<std::size_t> found;
    for (std::size_t c = 1; c < names.size(); ++c)
        if (names[c] == column || skeleton::short_name(names[c]) == column) found.push_back(c);
    if (found.size() > 1)
        rows.refuse("'" + column + "' may be " + names[found[0]] + " or " + names[found[1]] +
                    "; give the column by its number, " + std::to_string(found[0] + 1) + " or " +
                    std::to_string(found[1] + 1));
    if (found.size() == 1) return found[0];
    const auto number = to_number(column);
    if (number && *number >= 2 && *number <= static_cast<double>(names.size()) &&
        *number == std::floor(*number))
        return static_cast<std::size_t>(*number) - 1;
    rows.refuse("has no column '" + column + "'" +
                known_are(column, {names.begin() + 1, names.end()}));
}

}  // namespace

Curve read_activation(const std::filesystem::path& file, const std::string& column) {
    skeleton::TableRows rows(file);
    const std::size_t at = find_column(rows, column);
    Curve curve;
    while (rows.next())
        if (const std::string wrong = add_activation(curve, rows.number(0), rows.number(at));
            !wrong.empty())
            rows.refuse("in column '" + column + "' " + wrong);
    return curve;
}

}  // namespace myotet::contraction
