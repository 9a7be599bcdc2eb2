// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "Report/Picture.h"

namespace myotet::report {

/// A text as content of an element or of an attribute in quotes: < > & " ' as entities; bytes
/// that are no UTF-8 and control characters as U+FFFD, ends of lines and tabs as they are.
[[nodiscard]] std::string escaped(std::string_view text);

/// A text in quotes as JSON (RFC 8259) that may also stand in a script of a page: < as an escape;
/// bytes that are no UTF-8 as U+FFFD.
[[nodiscard]] std::string json_text(std::string_view text);

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

/// The picture as .png in a link that holds it.
[[nodiscard]] std::string data_uri(const Picture& picture);

/// "#0072b2".
[[nodiscard]] std::string css_colour(const Colour& colour);

/// A number for a reader, three or four digits, whole numbers in groups of three; the element
/// has the whole number as its value. A number that is not finite is a dash.
[[nodiscard]] std::string number_html(double number);

/// "<p>the text</p>".
[[nodiscard]] std::string paragraph(std::string_view text);

/// Sentences below one another; nothing when there are none.
[[nodiscard]] std::string list_html(const std::vector<std::string>& sentences);

/// A picture with its alternative text and a caption below, both texts.
[[nodiscard]] std::string figure(const Picture& picture, std::string_view alternative,
                                 std::string_view caption);

/// What stands in a table's place; `html` is markup.
struct Cell {
    std::string html;
    bool number = false;  ///< to the right, digits below one another
};
[[nodiscard]] Cell text_cell(std::string_view text);
[[nodiscard]] Cell number_cell(double number);
/// Whether a rule holds: a word with a sign, not a colour alone.
[[nodiscard]] Cell kept_cell(bool kept);

/// A table whose first column names its rows.
struct HtmlTable {
    std::string caption;
    std::vector<std::string> columns;  ///< texts
    std::vector<std::vector<Cell>> rows;
};
[[nodiscard]] std::string to_html(const HtmlTable& table);

}  // namespace myotet::report
