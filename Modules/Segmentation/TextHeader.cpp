// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/TextHeader.h"

#include <charconv>
#include <fstream>

#include "Core/Errors.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

// Headers of segmentations with hundreds of segments take some 100 kB.
constexpr std::uint64_t kMostHeaderBytes = std::uint64_t{1} << 24;

/// Lines of a file that turns into binary data at some point.
class HeaderLines {
public:
    explicit HeaderLines(const fs::path& file) : file_(file), in_(file, std::ios::binary) {
        if (!in_)
            throw IoError(file.string() +
                          ": cannot be opened; check that the file exists and may be read");
    }

    /// The next line without its end; false at the end of the file.
    bool next(std::string& line) {
        line.clear();
        for (int c = in_.get(); c != std::ifstream::traits_type::eof(); c = in_.get()) {
            if (++offset_ > kMostHeaderBytes)
                throw InputError(file_.string() +
                                 ": the header does not end within 16 MB; the file is damaged: "
                                 "copy or export it again");
            if (c == '\n') {
                if (!line.empty() && line.back() == '\r') line.pop_back();
                return true;
            }
            line += static_cast<char>(c);
        }
        return !line.empty();
    }

    [[nodiscard]] std::uint64_t offset() const { return offset_; }

private:
    const fs::path& file_;
    std::ifstream in_;
    std::uint64_t offset_ = 0;
};

/// Whether a file lies in a folder or below it, links followed.
bool lies_in(const fs::path& folder, const fs::path& file) {
    std::error_code error;
    const fs::path root = fs::weakly_canonical(folder, error);
    if (error) return false;
    const fs::path target = fs::weakly_canonical(file, error);
    if (error) return false;
    const fs::path relative = target.lexically_relative(root);
    return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpace = " \t\r\n";
    const auto first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

std::string TextHeader::get(const std::string& key) const {
    const auto it = fields.find(key);
    return it == fields.end() ? std::string() : it->second;
}

std::int64_t whole_number(const std::string& text, const std::string& field, const fs::path& file) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        throw InputError(file.string() + ": the header's " + field + " reads '" +
                         text.substr(0, 40) +
                         "' but must be a whole number; export the file again");
    return value;
}

std::vector<double> parse_numbers(std::string_view text) {
    std::vector<double> values;
    for (const char *at = text.data(), *end = at + text.size(); at != end;) {
        if (std::string_view(" \t,()+").find(*at) != std::string_view::npos) {
            ++at;
            continue;
        }
        double value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc()) break;
        values.push_back(value);
        at = next;
    }
    return values;
}

TextHeader read_nrrd_header(const fs::path& file) {
    HeaderLines lines(file);
    std::string line;
    if (!lines.next(line) || !line.starts_with("NRRD"))
        throw InputError(file.string() +
                         ": does not start with 'NRRD', so it is no NRRD file; convert it to "
                         ".nrrd or .nii.gz");
    TextHeader header;
    while (lines.next(line) && !line.empty()) {
        if (line.front() == '#') continue;
        const auto colon = line.find(':');
        if (colon == std::string::npos) continue;  // not a field
        const bool metadata = colon + 1 < line.size() && line[colon + 1] == '=';
        const std::string_view all = line;
        const std::string key(trimmed(all.substr(0, colon)));
        const std::string value(trimmed(all.substr(colon + (metadata ? 2 : 1))));
        if (metadata)
            header.metadata[key] = value;
        else
            header.fields[lower_case(key)] = value;
    }
    header.data_offset = lines.offset();
    return header;
}

TextHeader read_metaimage_header(const fs::path& file) {
    HeaderLines lines(file);
    TextHeader header;
    std::string line;
    while (lines.next(line)) {
        const auto equals = line.find('=');
        if (equals == std::string::npos) {
            if (trimmed(line).empty()) continue;
            break;
        }
        const std::string_view all = line;
        const std::string key = lower_case(trimmed(all.substr(0, equals)));
        header.fields[key] = trimmed(all.substr(equals + 1));
        if (key == "elementdatafile") {
            header.data_offset = lines.offset();
            return header;
        }
    }
    throw InputError(file.string() +
                     ": the header has no line 'ElementDataFile = ...', so it is no MetaImage or "
                     "cut short; export the file again");
}

fs::path data_file_beside(const fs::path& header, const std::string& name) {
    if (lower_case(name).starts_with("list") || name.find('%') != std::string::npos)
        throw InputError(header.string() + ": its voxels lie in several files ('" + name +
                         "'), which is not supported; save the volume as one file");
    const fs::path folder = header.has_parent_path() ? header.parent_path() : fs::path(".");
    const fs::path data = folder / name;  // an absolute name stays as it is
    if (!lies_in(folder, data))
        throw InputError(header.string() + ": its voxels should lie in '" + name +
                         "', outside the header's folder, where a header may not point; move the "
                         "file beside the header and name it there");
    std::error_code ignored;
    if (!fs::is_regular_file(data, ignored))
        throw IoError(header.string() + ": its voxels should lie in " + data.string() +
                      ", which does not exist; keep the two files together");
    return data;
}

}  // namespace myotet::segmentation
