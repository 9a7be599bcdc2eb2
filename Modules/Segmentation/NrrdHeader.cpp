// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/NrrdHeader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "Core/Errors.h"
#include "Segmentation/Formats.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

// The format's own limit.
constexpr std::int64_t kMostDimensions = 16;
// More than any segmentation has; a header that tells of more lies.
constexpr std::int64_t kMostLayers = 65535;

[[noreturn]] void refuse(const fs::path& file, const char* field, const std::string& text,
                         const char* rule) {
    throw InputError(file.string() + ": the header's " + field + " reads '" + text.substr(0, 80) +
                     "' but must be " + rule + "; correct the header or export the file again");
}

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

ScalarType type_of(const TextHeader& header, const fs::path& file) {
    std::string type;  // one blank between words
    for (const std::string& word : words_of(lower_case(header.get("type"))))
        type += (type.empty() ? "" : " ") + word;
    struct Synonyms {
        ScalarType type;
        std::initializer_list<const char*> names;
    };
    static const std::initializer_list<Synonyms> kTypes{
        {ScalarType::int8, {"signed char", "int8", "int8_t"}},
        {ScalarType::uint8, {"uchar", "unsigned char", "uint8", "uint8_t"}},
        {ScalarType::int16,
         {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}},
        {ScalarType::uint16,
         {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
        {ScalarType::int32, {"int", "signed int", "int32", "int32_t"}},
        {ScalarType::uint32, {"uint", "unsigned int", "uint32", "uint32_t"}},
        {ScalarType::int64,
         {"longlong", "long long", "long long int", "signed long long", "signed long long int",
          "int64", "int64_t"}},
        {ScalarType::uint64,
         {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"}},
        {ScalarType::float32, {"float"}},
        {ScalarType::float64, {"double"}}};
    for (const Synonyms& synonyms : kTypes)
        for (const char* name : synonyms.names)
            if (type == name) return synonyms.type;
    refuse(file, "type", header.get("type"), "an integer or real type, which labels have");
}

/// One entry an axis: its direction, or nothing for an axis that spans no space.
using Directions = std::vector<std::optional<Vec3>>;

Directions directions_of(const std::string& text, const fs::path& file) {
    Directions directions;
    for (std::size_t at = text.find_first_not_of(" \t"); at != std::string::npos;
         at = text.find_first_not_of(" \t", at)) {
        if (text.compare(at, 4, "none") == 0) {
            directions.emplace_back();
            at += 4;
            continue;
        }
        const std::size_t end = text.find(')', at);
        if (text[at] != '(' || end == std::string::npos)
            refuse(file, "space directions", text, "vectors (x,y,z) or none, one an axis");
        const std::vector<double> v =
            parse_numbers(std::string_view(text).substr(at + 1, end - at - 1));
        if (v.size() != 3) refuse(file, "space directions", text, "vectors of three numbers");
        directions.emplace_back(Vec3(v[0], v[1], v[2]));
        at = end + 1;
    }
    return directions;
}

/// Without directions: spacings along axes that `kinds` does not exclude.
Directions from_spacings(const TextHeader& header, std::size_t dimensions, const fs::path& file) {
    const std::string text = header.get("spacings");
    const std::vector<std::string> words = words_of(text), kinds = words_of(header.get("kinds"));
    Directions directions(dimensions);
    int axis = 0;
    for (std::size_t n = 0; n < dimensions && axis < 3; ++n) {
        const bool spatial = kinds.size() != dimensions || kinds[n] == "domain" ||
                             kinds[n] == "space" || kinds[n] == "???" || kinds[n] == "none";
        if (!spatial) continue;
        double spacing = 1;
        if (!words.empty()) {
            const std::vector<double> value =
                n < words.size() ? parse_numbers(words[n]) : std::vector<double>();
            if (value.size() != 1 || !(value[0] > 0))
                refuse(file, "spacings", text, "a positive number for each axis");
            spacing = value[0];
        }
        directions[n] = spacing * Vec3::Unit(axis++);
    }
    return directions;
}

/// Signs that turn a named space into LPS.
Vec3 to_lps(const TextHeader& header, const fs::path& file, std::vector<std::string>& warnings) {
    const std::string space = lower_case(header.get("space"));
    if (space == "left-posterior-superior" || space == "lps") return {1, 1, 1};
    if (space == "right-anterior-superior" || space == "ras") return {-1, -1, 1};
    if (space == "left-anterior-superior" || space == "las") return {1, -1, 1};
    warnings.push_back(file.string() + " names no patient space ('" + space.substr(0, 40) +
                       "'); its coordinates were taken as left, posterior and superior.");
    return {1, 1, 1};
}

/// Millimetres per unit of length that the header uses.
double unit_in_mm(const TextHeader& header, const fs::path& file) {
    const std::string text = lower_case(header.get("space units"));
    const auto open = text.find('"');
    if (open == std::string::npos) return 1;
    const std::string unit = text.substr(open + 1, text.find('"', open + 1) - open - 1);
    if (unit.empty() || unit == "mm" || unit == "millimeter" || unit == "millimetre") return 1;
    if (unit == "cm") return 10;
    if (unit == "m") return 1000;
    if (unit == "um" || unit == "\xc2\xb5m" || unit == "micron") return 1e-3;
    refuse(file, "space units", text, "mm, cm, m or um");
}

/// Which axes span space, and which, if any, runs over layers.
struct Axes {
    std::array<std::size_t, 3> space{};
    std::optional<std::size_t> layers;
};

[[noreturn]] void refuse_components(std::int64_t count, const std::string& kind,
                                    const fs::path& file) {
    throw InputError(file.string() + ": holds " + std::to_string(count) +
                     " values a voxel of the kind '" + kind.substr(0, 40) +
                     "', but layers of labels have the kind 'list'; export a label map, or ask "
                     "for --one-hot when each is the mask of one label");
}

/// Whether an axis that spans no space may hold the components of vectors.
void check_vector_axis(std::int64_t count, const std::string& kind, const fs::path& file) {
    constexpr std::array kVectors{
        "vector", "3-vector", "covariant-vector", "3-gradient", "3-normal", "none", "???", ""};
    if (count != 3 || std::ranges::find(kVectors, kind) == kVectors.end())
        throw InputError(file.string() + ": holds " + std::to_string(count) +
                         " values a voxel of the kind '" + kind.substr(0, 40) +
                         "', but vectors have three of the kind 'vector'; export vectors, or "
                         "correct the header's kinds");
}

/// Whether an axis that spans no space may hold layers.
void check_layer_axis(std::size_t axis, std::int64_t count, const TextHeader& header,
                      std::size_t dimensions, const fs::path& file, NrrdHolds holds) {
    const std::vector<std::string> kinds = words_of(lower_case(header.get("kinds")));
    const std::string kind = kinds.size() == dimensions ? kinds[axis] : "";
    if (kind.ends_with("-color"))
        throw InputError(file.string() + ": stores colours (kind '" + kind.substr(0, 40) +
                         "'), but labels are numbers; export the label map, not its picture");
    if (holds == NrrdHolds::vectors) return check_vector_axis(count, kind, file);
    const bool any_kind = holds == NrrdHolds::masks;
    if (count < 1 || count > kMostLayers || (!any_kind && kind != "list" && kind != "vector"))
        refuse_components(count, kind, file);
}

Axes sort_axes(const Directions& directions, const std::vector<std::int64_t>& sizes,
               const TextHeader& header, const fs::path& file, NrrdHolds holds) {
    Axes axes;
    std::size_t found = 0;
    for (std::size_t n = 0; n < sizes.size(); ++n) {
        if (directions[n] && found < 3) {
            axes.space[found++] = n;
        } else if (sizes[n] != 1) {
            check_layer_axis(n, sizes[n], header, sizes.size(), file, holds);
            if (axes.layers || (found != 0 && found != 3))
                throw InputError(file.string() +
                                 ": its axes of values stand between those of space or are "
                                 "several, but one is read, first or last; reorder the axes");
            axes.layers = n;
        }
    }
    if (found < 3)
        throw InputError(file.string() + ": holds an image of " + std::to_string(found) +
                         " dimensions in space, but tetrahedra need three; export the whole stack");
    return axes;
}

std::vector<std::int64_t> sizes_of(const TextHeader& header, const fs::path& file) {
    const std::int64_t dimensions = whole_number(header.get("dimension"), "dimension", file);
    const std::string text = header.get("sizes");
    const std::vector<std::string> words = words_of(text);
    if (dimensions < 1 || dimensions > kMostDimensions ||
        static_cast<std::int64_t>(words.size()) != dimensions)
        refuse(file, "sizes", text, "as many whole numbers as the header has dimensions");
    std::vector<std::int64_t> sizes;
    for (const std::string& word : words) sizes.push_back(whole_number(word, "sizes", file));
    return sizes;
}

std::optional<std::array<double, 3>> parse_colour(const std::string& text) {
    std::istringstream in(text);
    std::array<double, 3> colour{};
    for (double& channel : colour)
        if (!(in >> channel)) return {};
    return colour;
}

std::optional<std::int32_t> number_in(const std::string& text) {
    std::int32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc()) return {};
    return value;
}

Vec3 origin_of(const TextHeader& header, const fs::path& file) {
    const std::string text = header.get("space origin");
    if (text.empty()) return Vec3::Zero();
    const std::vector<double> v = parse_numbers(text);
    if (v.size() != 3) refuse(file, "space origin", text, "a vector of three numbers");
    return {v[0], v[1], v[2]};
}

/// By columns, from the vectors' own axes to those of space; the same where there is none.
Mat3 measurement_frame(const TextHeader& header, const fs::path& file) {
    const std::string text = header.get("measurement frame");
    if (text.empty()) return Mat3::Identity();
    const std::vector<double> v = parse_numbers(text);
    Mat3 frame = Mat3::Constant(std::nan(""));
    if (v.size() == 9) frame = Eigen::Map<const Mat3>(v.data());
    if (!(frame.allFinite() && std::abs(frame.determinant()) > 0))
        refuse(file, "measurement frame", text, "three vectors of three numbers that span space");
    return frame;
}

}  // namespace

NrrdMeaning interpret_nrrd(const TextHeader& header, const fs::path& file, NrrdHolds holds) {
    NrrdMeaning meaning;
    meaning.type = type_of(header, file);
    const std::vector<std::int64_t> sizes = sizes_of(header, file);
    const std::string text = header.get("space directions");
    const Directions directions =
        text.empty() ? from_spacings(header, sizes.size(), file) : directions_of(text, file);
    if (directions.size() != sizes.size())
        refuse(file, "space directions", text, "one entry an axis");
    const auto [axes, layers] = sort_axes(directions, sizes, header, file, holds);
    if (layers) {
        meaning.layers = sizes[*layers];
        meaning.interleaved = *layers < axes[0];
    }
    meaning.size = checked_size({sizes[axes[0]], sizes[axes[1]], sizes[axes[2]]}, file);

    Vec3 sign(1, 1, 1);
    if (!text.empty())
        sign = to_lps(header, file, meaning.warnings);
    else if (header.get("spacings").empty())
        meaning.warnings.push_back(file.string() + " does not say its spacing; 1 mm was assumed.");
    else
        meaning.warnings.push_back(file.string() +
                                   " says nothing of its place in the patient; its axes were "
                                   "taken as left, posterior and superior.");
    for (int a = 0; a < 3; ++a)
        meaning.index_to_lps.linear().col(a) = sign.cwiseProduct(*directions[axes[a]]);
    meaning.index_to_lps.translation() = sign.cwiseProduct(origin_of(header, file));
    meaning.index_to_lps.affine() *= unit_in_mm(header, file);
    check_geometry(meaning.index_to_lps, file);
    if (holds == NrrdHolds::vectors) {
        if (meaning.layers == 1)
            throw InputError(file.string() +
                             ": holds one value a voxel, but vectors have three; name a file of "
                             "vectors");
        meaning.frame_to_lps = sign.asDiagonal() * measurement_frame(header, file);
    }
    return meaning;
}

std::vector<std::map<std::int32_t, LabelName>> segment_names(const TextHeader& header,
                                                             std::int64_t layers) {
    std::vector<std::map<std::int32_t, LabelName>> names(static_cast<std::size_t>(layers));
    for (int number = 0;; ++number) {
        const std::string segment = "Segment" + std::to_string(number);
        const auto get = [&](const char* what) {
            const auto it = header.metadata.find(segment + what);
            return it == header.metadata.end() ? std::string() : it->second;
        };
        const std::string id = get("_ID"), value = get("_LabelValue");
        if (id.empty() && value.empty() && get("_Name").empty()) break;
        // Slicer's first version wrote neither: segment n was layer n, of ones.
        const auto label = value.empty() ? 1 : number_in(value);
        const auto layer = !get("_Layer").empty()        ? number_in(get("_Layer"))
                           : value.empty() && layers > 1 ? std::optional(number)
                                                         : std::optional(0);
        LabelName name{get("_Name").empty() ? id : get("_Name"), parse_colour(get("_Color"))};
        if (label && layer && *layer >= 0 && *layer < layers && !name.name.empty())
            names[static_cast<std::size_t>(*layer)].emplace(*label, std::move(name));
    }
    return names;
}

}  // namespace myotet::segmentation
