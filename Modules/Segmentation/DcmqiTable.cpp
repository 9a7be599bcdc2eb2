// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/DcmqiTable.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "Core/Errors.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

[[noreturn]] void refuse(const fs::path& file, const char* why) {
    throw InputError(file.string() + ": " + why +
                     "; a table in JSON is what dcmqi writes, with segmentAttributes, labelID and "
                     "SegmentLabel");
}

std::string text_in(const Json& object, const char* key) {
    const auto it = object.find(key);
    return it != object.end() && it->is_string() ? it->get<std::string>() : std::string();
}

std::string meaning_in(const Json& segment, const char* key) {
    const auto it = segment.find(key);
    return it != segment.end() && it->is_object() ? text_in(*it, "CodeMeaning") : std::string();
}

std::string name_of(const Json& segment) {
    std::string name = text_in(segment, "SegmentLabel");
    if (!name.empty()) return name;
    name = meaning_in(segment, "SegmentedPropertyTypeCodeSequence");
    const std::string side = meaning_in(segment, "SegmentedPropertyTypeModifierCodeSequence");
    return name.empty() || side.empty() ? name : name + " " + side;
}

std::optional<std::array<double, 3>> colour_of(const Json& segment) {
    const auto it = segment.find("recommendedDisplayRGBValue");
    if (it == segment.end() || !it->is_array() || it->size() != 3) return {};
    std::array<double, 3> colour{};
    for (std::size_t n = 0; n < 3; ++n) {
        if (!(*it)[n].is_number()) return {};
        colour[n] = (*it)[n].get<double>() / 255;
        if (!(colour[n] >= 0 && colour[n] <= 1)) return {};
    }
    return colour;
}

std::pair<std::int32_t, LabelName> entry_of(const Json& segment, const fs::path& file) {
    if (!segment.is_object()) refuse(file, "a segment is no object");
    const auto id = segment.find("labelID");
    if (id == segment.end() || !id->is_number_integer())
        refuse(file, "a segment has no whole number labelID");
    const auto value = id->get<std::int64_t>();
    if (value < 0 || value > std::numeric_limits<std::int32_t>::max())
        refuse(file, "a segment's labelID is not from 0 to 2147483647");
    return {static_cast<std::int32_t>(value), {name_of(segment), colour_of(segment)}};
}

}  // namespace

std::vector<std::pair<std::int32_t, LabelName>> parse_dcmqi_table(const std::string& text,
                                                                  const fs::path& file) {
    const Json table = Json::parse(text, nullptr, false);
    if (table.is_discarded()) refuse(file, "is no valid JSON");
    const auto groups = table.is_object() ? table.find("segmentAttributes") : table.end();
    if (groups == table.end() || !groups->is_array()) refuse(file, "has no list segmentAttributes");
    std::vector<std::pair<std::int32_t, LabelName>> entries;
    for (const Json& group : *groups) {
        if (!group.is_array()) refuse(file, "segmentAttributes holds something else than lists");
        for (const Json& segment : group) entries.push_back(entry_of(segment, file));
    }
    return entries;
}

}  // namespace myotet::segmentation
