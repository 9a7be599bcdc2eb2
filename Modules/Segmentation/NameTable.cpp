// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/NameTable.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <set>
#include <vector>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "Segmentation/DcmqiTable.h"
#include "Segmentation/TextHeader.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

// FreeSurfer's whole table has 90 kB; a file this large is no table.
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 24;

/// One row of any table, before the table's form is known.
struct Row {
    int line = 0;
    std::int32_t value = 0;
    std::vector<std::string> words;  ///< what follows the value
    LabelName label;
};

[[noreturn]] void refuse(const fs::path& file, int line, const std::string& text) {
    throw InputError(file.string() + ", line " + std::to_string(line) + ": '" + text.substr(0, 60) +
                     "' makes no sense in a table of label names; write a whole number and a name");
}

std::vector<std::string> split(std::string_view text, std::string_view separators,
                               bool keep_empty) {
    std::vector<std::string> words;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
        if (keep_empty || end > at) words.emplace_back(trimmed(text.substr(at, end - at)));
        at = end + 1;
    }
    return words;
}

template <class T>
std::optional<T> number(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || text.empty()) return {};
    return value;
}

/// Three channels from 0 to 255.
std::optional<std::array<double, 3>> colour_255(const std::vector<std::string>& words,
                                                std::size_t first) {
    std::array<double, 3> colour{};
    for (int c = 0; c < 3; ++c) {
        const auto channel = number<double>(words[first + c]);
        if (!channel || !(*channel >= 0 && *channel <= 255)) return {};
        colour[c] = *channel / 255;
    }
    return colour;
}

/// #RRGGBB.
std::optional<std::array<double, 3>> colour_hex(std::string_view text) {
    if (text.size() != 7 || text.front() != '#') return {};
    std::array<double, 3> colour{};
    for (int c = 0; c < 3; ++c) {
        int channel = 0;
        const char* first = text.data() + 1 + 2 * c;
        if (std::from_chars(first, first + 2, channel, 16).ptr != first + 2) return {};
        colour[c] = channel / 255.0;
    }
    return colour;
}

std::string join(const std::vector<std::string>& words, std::size_t count) {
    std::string text;
    for (std::size_t n = 0; n < count; ++n) text += (n ? " " : "") + words[n];
    return text;
}

std::string unquoted(std::string_view text) {
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
        text = text.substr(1, text.size() - 2);
    return std::string(text);
}

/// A table whose first line names its columns `index` and `name` (BIDS _dseg.tsv).
struct Columns {
    char separator = '\t';
    std::size_t index = 0, name = 0, colour = std::string::npos;
};

std::optional<Columns> find_columns(std::string_view head) {
    for (const char separator : {'\t', ','}) {
        const std::vector<std::string> words =
            split(lower_case(head), std::string_view(&separator, 1), true);
        const auto column = [&](std::initializer_list<const char*> keys) {
            for (std::size_t n = 0; n < words.size(); ++n)
                for (const char* key : keys)
                    if (unquoted(words[n]) == key) return n;
            return std::string::npos;
        };
        const Columns found{separator, column({"index", "value", "label_value"}),
                            column({"name", "label_name"}), column({"color", "colour"})};
        if (found.index != std::string::npos && found.name != std::string::npos) return found;
    }
    return {};
}

Row column_row(const fs::path& file, const Columns& columns, int line, std::string_view text) {
    const std::vector<std::string> words =
        split(text, std::string_view(&columns.separator, 1), true);
    if (words.size() <= std::max(columns.index, columns.name))
        refuse(file, line, std::string(text));
    const auto value = number<std::int32_t>(words[columns.index]);
    if (!value) refuse(file, line, std::string(text));
    Row row{line, *value, {}, {unquoted(words[columns.name]), {}}};
    if (columns.colour < words.size()) row.label.colour = colour_hex(words[columns.colour]);
    return row;
}

/// `3 name`, `3 name R G B A` (FreeSurfer, Slicer) or `3 R G B A V M "name"` (ITK-SNAP).
Row plain_row(const fs::path& file, int line, std::string_view text) {
    const std::size_t digits = std::min(text.find_first_of(" \t,:=;"), text.size());
    const auto value = number<std::int32_t>(text.substr(0, digits));
    std::string_view rest = trimmed(text.substr(std::min(digits, text.size())));
    while (!rest.empty() && (rest.front() == ',' || rest.front() == ':' || rest.front() == '=' ||
                             rest.front() == ';'))
        rest = trimmed(rest.substr(1));
    if (!value || rest.empty()) refuse(file, line, std::string(text));

    Row row{line, *value, split(rest, " \t", false), {}};
    const std::vector<std::string>& words = row.words;
    const std::size_t open = rest.find('"'), close = rest.rfind('"');
    if (open != std::string_view::npos && close > open) {
        row.label.name = std::string(rest.substr(open + 1, close - open - 1));
        const std::vector<std::string> before = split(rest.substr(0, open), " \t", false);
        if (before.size() >= 3) row.label.colour = colour_255(before, 0);
        row.words.clear();
        return row;
    }
    for (const std::size_t channels : {std::size_t{4}, std::size_t{3}})
        if (words.size() > channels) {
            const std::size_t first = words.size() - channels;
            const auto colour = colour_255(words, first);
            if (!colour || !number<double>(words.back())) continue;
            row.label = {join(words, first), colour};
            row.words.clear();
            return row;
        }
    row.label.name = rest;
    return row;
}

/// MRIcron's tables carry the atlas's own code behind each name: `1 Precentral_L 2001`.
/// It is a column, not a part of the names, when every row has one and the
/// names are still told apart without it.
void drop_code_column(std::vector<Row>& rows) {
    std::set<std::string> names;
    for (const Row& row : rows)
        if (row.words.size() != 2 || !number<std::int64_t>(row.words[1]) ||
            !names.insert(row.words[0]).second)
            return;
    if (rows.size() > 1)
        for (Row& row : rows) row.label.name = row.words[0];
}

std::string read_text(const fs::path& file) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    std::ifstream in(file, std::ios::binary);
    if (error || !in)
        throw IoError(file.string() +
                      ": the table of label names cannot be opened; check the path");
    if (size > kMostBytes)
        throw InputError(file.string() + ": has " + std::to_string(size) +
                         " bytes, too many for a table of label names; name another file");
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
    return text;
}

std::vector<Row> read_rows(const fs::path& file) {
    const std::string content = read_text(file);
    std::vector<Row> rows;
    if (trimmed(content).starts_with('{')) {
        for (auto& [value, label] : parse_dcmqi_table(content, file))
            if (!label.name.empty()) rows.push_back({0, value, {}, std::move(label)});
        return rows;
    }
    std::optional<Columns> columns;
    int line = 0;
    bool first = true;
    for (const std::string& whole : split(content, "\n", true)) {
        ++line;
        const std::string_view text = trimmed(whole);
        if (text.empty() || text.front() == '#' || text.starts_with("//")) continue;
        if (first) columns = find_columns(text);
        if (!(first && columns))
            rows.push_back(columns ? column_row(file, *columns, line, text)
                                   : plain_row(file, line, text));
        first = false;
    }
    if (!columns) drop_code_column(rows);
    return rows;
}

}  // namespace

std::map<std::int32_t, LabelName> read_name_table(const fs::path& file) {
    std::map<std::int32_t, LabelName> names;
    for (Row& row : read_rows(file)) {
        if (row.value == 0) continue;  // background, whatever it is called
        const auto [it, is_new] = names.emplace(row.value, row.label);
        if (!is_new && it->second.name != row.label.name)
            throw InputError(
                file.string() + (row.line > 0 ? ", line " + std::to_string(row.line) : "") +
                ": names label " + std::to_string(row.value) + " '" + row.label.name +
                "', which is '" + it->second.name + "' further up; keep one of the two");
    }
    if (names.empty())
        throw InputError(file.string() +
                         ": holds no label names; write lines of a whole number and a name");
    return names;
}

std::optional<fs::path> find_name_table(const fs::path& label_file) {
    const std::string name = label_file.filename().string();
    std::string stem = name;
    for (const char* suffix :
         {".seg.nrrd", ".nii.gz", ".nii", ".nrrd", ".nhdr", ".mha", ".mhd", ".dcm"})
        if (lower_case(stem).ends_with(suffix) && stem.size() > std::string_view(suffix).size()) {
            stem.resize(stem.size() - std::string_view(suffix).size());
            break;
        }
    const fs::path folder = label_file.parent_path();
    std::error_code ignored;
    for (const std::string& candidate :
         {stem + "_labels.txt", stem + ".tsv", stem + "_labels.tsv", stem + ".ctbl",
          stem + "_LUT.txt", stem + ".label", stem + ".lbl", stem + ".nii.txt", name + ".txt",
          stem + ".txt"})
        if (fs::is_regular_file(folder / candidate, ignored)) return folder / candidate;
    // BIDS puts a .json of other content beside each file.
    const fs::path json = folder / (stem + ".json");
    if (fs::is_regular_file(json, ignored) && fs::file_size(json, ignored) <= kMostBytes &&
        read_text(json).find("\"segmentAttributes\"") != std::string::npos)
        return json;

    // Slicer saves the colour table under its own name; a sole one must be meant.
    std::vector<fs::path> tables;
    for (fs::directory_iterator it(folder.empty() ? fs::path(".") : folder, ignored), end;
         !ignored && it != end; it.increment(ignored))
        if (it->path().extension() == ".ctbl") tables.push_back(it->path());
    if (tables.size() == 1) return folder / tables.front().filename();
    return {};
}

void write_name_table(const std::map<std::int32_t, LabelName>& names, const fs::path& file) {
    std::string text;
    for (const auto& [value, label] : names)
        text += std::to_string(value) + " " + label.name + "\n";
    write_atomically(file, text);
}

}  // namespace myotet::segmentation
