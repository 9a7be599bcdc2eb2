// SPDX-License-Identifier: Apache-2.0
#include "Report/Html.h"

#include <algorithm>
#include <cmath>

#include "Core/Text.h"

namespace myotet::report {
namespace {

constexpr std::string_view kUnknown = "\xEF\xBF\xBD";  // U+FFFD

// Bytes of the UTF-8 character that begins the text; 0: there is none.
std::size_t character_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    const std::size_t length = first < 0x80                     ? 1
                               : first >= 0xC2 && first < 0xE0  ? 2
                               : first >= 0xE0 && first < 0xF0  ? 3
                               : first >= 0xF0 && first <= 0xF4 ? 4
                                                                : 0;
    if (length == 0 || length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    // Longer than needed, of the surrogates, or beyond the last character.
    if ((first == 0xE0 && byte(1) < 0xA0) || (first == 0xED && byte(1) >= 0xA0) ||
        (first == 0xF0 && byte(1) < 0x90) || (first == 0xF4 && byte(1) >= 0x90))
        return 0;
    return length;
}

void append_escaped(std::string& html, std::string_view character) {
    const char c = character[0];
    if (c == '<')
        html += "&lt;";
    else if (c == '>')
        html += "&gt;";
    else if (c == '&')
        html += "&amp;";
    else if (c == '"')
        html += "&quot;";
    else if (c == '\'')
        html += "&#39;";
    else if ((c >= 0 && c < ' ' && c != '\n' && c != '\t') || c == 0x7F)
        html += kUnknown;
    else
        html += character;
}

// 1234567 as 1 234 567, with narrow spaces that keep it on one line.
std::string grouped(const std::string& digits) {
    constexpr std::size_t kShortest = 5;
    const std::size_t sign = digits.starts_with('-') ? 1 : 0;
    if (digits.size() - sign < kShortest) return digits;
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > sign && (digits.size() - i) % 3 == 0) text += "\xE2\x80\xAF";
        text += digits[i];
    }
    return text;
}

std::string readable(double number) {
    constexpr double kLargestGrouped = 1e15, kLeastWhole = 1000;
    const bool whole = number == std::floor(number) || std::abs(number) >= kLeastWhole;
    if (whole && std::abs(number) < kLargestGrouped) {
        return grouped(formatted("%.0f", number));
    }
    return formatted(std::abs(number) >= 1 ? "%.4g" : "%.3g", number);
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string html;
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        if (length == 0)
            html += kUnknown;
        else
            append_escaped(html, text.substr(0, length));
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return html;
}

std::string json_text(std::string_view text) {
    std::string json = "\"";
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        const char c = text[0];
        if (length == 0) {
            json += kUnknown;
        } else if (c == '"' || c == '\\') {
            json += {'\\', c};
        } else if (c == '<' || (c >= 0 && c < ' ')) {
            json += formatted("\\u%04x", static_cast<unsigned>(c));
        } else {
            json += text.substr(0, length);
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return json + "\"";
}

std::string base64(std::string_view bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        unsigned three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = three << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? kDigits[three >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string data_uri(const Picture& picture) {
    return "data:image/png;base64," + base64(encode_png(picture));
}

std::string css_colour(const Colour& colour) {
    const auto byte = [](double share) {
        return static_cast<unsigned>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
    };
    return formatted("#%02x%02x%02x", byte(colour[0]), byte(colour[1]), byte(colour[2]));
}

std::string number_html(double number) {
    if (!std::isfinite(number)) return "\xE2\x80\x93";
    return "<data value=\"" + shown(number) + "\">" + readable(number) + "</data>";
}

std::string paragraph(std::string_view text) { return "<p>" + escaped(text) + "</p>\n"; }

std::string list_html(const std::vector<std::string>& sentences) {
    if (sentences.empty()) return "";
    std::string html = "<ul>\n";
    for (const std::string& sentence : sentences) html += "<li>" + escaped(sentence) + "</li>\n";
    return html + "</ul>\n";
}

std::string figure(const Picture& picture, std::string_view alternative, std::string_view caption) {
    return "<figure><img src=\"" + data_uri(picture) + "\" width=\"" +
           std::to_string(picture.width) + "\" height=\"" + std::to_string(picture.height) +
           "\" alt=\"" + escaped(alternative) + "\"/><figcaption>" + escaped(caption) +
           "</figcaption></figure>\n";
}

Cell text_cell(std::string_view text) { return {escaped(text), false}; }

Cell number_cell(double number) { return {number_html(number), true}; }

Cell kept_cell(bool kept) {
    return {kept ? "<span class=\"kept\">\xE2\x9C\x93 kept</span>"
                 : "<strong class=\"broken\">\xE2\x9C\x97 broken</strong>",
            false};
}

std::string to_html(const HtmlTable& table) {
    const std::string caption = escaped(table.caption);
    std::string html = "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"" +
                       caption + "\"><table><caption>" + caption + "</caption>\n<thead><tr>";
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        const bool number = c > 0 && !table.rows.empty() && table.rows[0][c].number;
        html += "<th scope=\"col\"" + std::string(number ? " class=\"number\"" : "") + ">" +
                escaped(table.columns[c]) + "</th>";
    }
    html += "</tr></thead>\n<tbody>\n";
    for (const std::vector<Cell>& row : table.rows) {
        html += "<tr>";
        for (std::size_t c = 0; c < row.size(); ++c) {
            const char* kind = row[c].number ? " class=\"number\"" : "";
            html += c == 0 ? "<th scope=\"row\">" + row[c].html + "</th>"
                           : "<td" + std::string(kind) + ">" + row[c].html + "</td>";
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

}  // namespace myotet::report
