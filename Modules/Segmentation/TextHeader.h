// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace myotet::segmentation {

/// The `key: value` lines at the head of an NRRD or MetaImage file.
struct TextHeader {
    std::map<std::string, std::string> fields;    ///< key in lower case
    std::map<std::string, std::string> metadata;  ///< NRRD's key:=value, as written
    std::uint64_t data_offset = 0;                ///< first byte behind the header

    /// A field's value; empty when absent.
    [[nodiscard]] std::string get(const std::string& key) const;
};

/// Splits an NRRD header, which ends with an empty line (or the file).
[[nodiscard]] TextHeader read_nrrd_header(const std::filesystem::path& file);

/// Splits a MetaImage header (`Key = value`), which ends with ElementDataFile.
[[nodiscard]] TextHeader read_metaimage_header(const std::filesystem::path& file);

[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::string lower_case(std::string_view text);
/// A whole number, or an InputError that names file and field.
[[nodiscard]] std::int64_t whole_number(const std::string& text, const std::string& field,
                                        const std::filesystem::path& file);

/// The numbers in a text, apart by white space, commas or brackets; what
/// follows the first thing that is no number is left out.
[[nodiscard]] std::vector<double> parse_numbers(std::string_view text);

/// The data file that a header names, in the header's folder or below it;
/// InputError for files elsewhere (a header from a stranger may name any file)
/// and for lists and patterns of files, IoError when it is missing.
[[nodiscard]] std::filesystem::path data_file_beside(const std::filesystem::path& header,
                                                     const std::string& name);

}  // namespace myotet::segmentation
