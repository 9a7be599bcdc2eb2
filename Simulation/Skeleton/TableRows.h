// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace myotet::skeleton {

/// A table's rows one after the other, whose cells are numbers only when asked for: the way
/// to a column beside others that hold anything. The same files and errors as read_table.
///
///     TableRows rows(file);
///     while (rows.next()) use(rows.number(0), rows.number(3));
class TableRows {
public:
    explicit TableRows(const std::filesystem::path& file);

    [[nodiscard]] const std::string& title() const { return title_; }
    [[nodiscard]] bool in_degrees() const { return in_degrees_; }
    /// Of all columns, the time's first.
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

    /// Goes to the next row; false after the last one. Throws InputError when the row has
    /// too few or too many cells, or the rows are fewer or more than the header says or none.
    [[nodiscard]] bool next();
    /// A cell of the row. Throws InputError when it is no finite number.
    [[nodiscard]] double number(std::size_t column) const;
    /// Throws InputError "file:line: why", at the names or the row.
    [[noreturn]] void refuse(const std::string& why) const;

private:
    [[nodiscard]] bool next_line();
    void pass_header();
    void note_promise(std::string_view line);
    void read_names(bool opensim);
    void check_names() const;

    std::filesystem::path file_;
    std::string content_;
    std::size_t at_ = 0;  ///< where the next line begins
    std::string_view line_;
    int line_number_ = 0;
    char separator_ = 0;  ///< 0: blanks
    std::string title_;
    bool in_degrees_ = false;
    std::vector<std::string> names_;
    std::vector<std::string_view> cells_;
    std::optional<double> promised_rows_, promised_columns_;
    double rows_ = 0;
};

}  // namespace myotet::skeleton
