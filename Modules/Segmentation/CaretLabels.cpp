// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include "Segmentation/Formats.h"

namespace myotet::segmentation {
namespace {

constexpr std::array<std::pair<std::string_view, char>, 5> kEntities{
    {{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}}};
constexpr std::string_view kCdataOpen = "<![CDATA[", kCdataClose = "]]>";

std::string decode_entities(std::string_view text) {
    std::string plain;
    while (!text.empty()) {
        bool found = false;
        for (const auto& [entity, character] : kEntities)
            if (text.starts_with(entity)) {
                plain += character;
                text.remove_prefix(entity.size());
                found = true;
                break;
            }
        if (found) continue;
        plain += text.front();
        text.remove_prefix(1);
    }
    return plain;
}

std::string encode_entities(std::string_view text) {
    std::string coded;
    for (const char c : text) {
        std::string piece(1, c);
        for (const auto& [entity, character] : kEntities)
            if (c == character) piece = entity;
        coded += piece;
    }
    return coded;
}

std::string_view trim(std::string_view text) {
    constexpr std::string_view kSpace = " \t\r\n";
    const auto first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

/// The number in attribute="..." of a tag.
template <class T>
std::optional<T> attribute(std::string_view tag, std::string_view name) {
    for (auto at = tag.find(name); at != std::string_view::npos; at = tag.find(name, at + 1)) {
        const auto after = at + name.size();
        if (at == 0 || (tag[at - 1] != ' ' && tag[at - 1] != '\t' && tag[at - 1] != '\n')) continue;
        if (after + 1 >= tag.size() || tag[after] != '=') continue;
        const char quote = tag[after + 1];
        if (quote != '"' && quote != '\'') continue;
        const auto end = tag.find(quote, after + 2);
        if (end == std::string_view::npos) return {};
        const std::string_view text = trim(tag.substr(after + 2, end - after - 2));
        T value{};
        const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc() && last == text.data() + text.size()) return value;
        return {};
    }
    return {};
}

std::string content_text(std::string_view content) {
    content = trim(content);
    if (content.starts_with(kCdataOpen) && content.ends_with(kCdataClose))
        return std::string(trim(content.substr(
            kCdataOpen.size(), content.size() - kCdataOpen.size() - kCdataClose.size())));
    return decode_entities(content);
}

}  // namespace

std::map<std::int32_t, LabelName> parse_caret_labels(std::string_view xml) {
    std::map<std::int32_t, LabelName> names;
    constexpr std::string_view kOpen = "<Label", kClose = "</Label>";
    for (auto at = xml.find(kOpen); at != std::string_view::npos; at = xml.find(kOpen, at + 1)) {
        const auto tag_end = xml.find('>', at);
        if (tag_end == std::string_view::npos) break;
        const std::string_view tag = xml.substr(at, tag_end - at);
        const auto key = attribute<std::int32_t>(tag, "Key");  // <LabelTable> has none
        const auto end = xml.find(kClose, tag_end);
        if (!key || end == std::string_view::npos || tag.ends_with('/')) continue;
        LabelName label{content_text(xml.substr(tag_end + 1, end - tag_end - 1)), {}};
        const auto red = attribute<double>(tag, "Red"), green = attribute<double>(tag, "Green"),
                   blue = attribute<double>(tag, "Blue");
        if (red && green && blue) label.colour = {*red, *green, *blue};
        if (*key != 0 && !label.name.empty()) names.emplace(*key, std::move(label));
    }
    return names;
}

std::string format_caret_labels(const std::map<std::int32_t, LabelName>& names) {
    std::string xml =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<CaretExtension><VolumeInformation "
        "Index=\"0\"><LabelTable>\n";
    for (const auto& [value, label] : names) {
        xml += "<Label Key=\"" + std::to_string(value) + "\"";
        if (label.colour) {
            constexpr std::array<const char*, 3> kChannels{" Red=\"", " Green=\"", " Blue=\""};
            for (int c = 0; c < 3; ++c) {
                char text[32];
                const auto end = std::to_chars(text, text + sizeof text, (*label.colour)[c]).ptr;
                xml += kChannels[c] + std::string(text, end) + "\"";
            }
            xml += " Alpha=\"1\"";
        }
        xml += ">" + encode_entities(label.name) + "</Label>\n";
    }
    return xml + "</LabelTable><VolumeMetaData/></VolumeInformation></CaretExtension>\n";
}

}  // namespace myotet::segmentation
