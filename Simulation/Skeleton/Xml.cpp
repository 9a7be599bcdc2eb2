// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Xml.h"

#include <algorithm>
#include <pugixml.hpp>
#include <string_view>

#include "Core/Text.h"

namespace myotet::skeleton {
namespace {

constexpr int kDeepest = 100;

/// Tells the line of a byte.
class Lines {
public:
    explicit Lines(std::string_view content) {
        for (std::size_t i = 0; i < content.size(); ++i)
            if (content[i] == '\n') ends_.push_back(static_cast<std::ptrdiff_t>(i));
    }
    [[nodiscard]] int at(std::ptrdiff_t offset) const {
        return 1 + static_cast<int>(std::ranges::lower_bound(ends_, offset) - ends_.begin());
    }

private:
    std::vector<std::ptrdiff_t> ends_;
};

class Converter {
public:
    Converter(const std::filesystem::path& file, const Lines& lines) : file_(file), lines_(lines) {}

    XmlElement convert(const pugi::xml_node& node, int depth) const {
        XmlElement element{node.name(), node.attribute("name").value(),
                           std::string(trimmed(node.text().get())), lines_.at(node.offset_debug())};
        if (depth > kDeepest)
            refuse(file_, element.line,
                   "(<" + element.kind + ">) lies more than " + std::to_string(kDeepest) +
                       " elements deep; the file is damaged, export it again");
        for (const pugi::xml_node child : node)
            if (child.type() == pugi::node_element)
                element.children.push_back(convert(child, depth + 1));
        return element;
    }

private:
    const std::filesystem::path& file_;
    const Lines& lines_;
};

}  // namespace

XmlElement read_xml(const std::filesystem::path& file) {
    const std::string content = read_whole(file);
    const Lines lines(content);
    pugi::xml_document document;
    const auto result = document.load_buffer(content.data(), content.size());
    if (!result)
        refuse(file, lines.at(result.offset),
               std::string("is not valid XML (") + result.description() +
                   "); the file is damaged or of another kind, export it again");
    return Converter(file, lines).convert(document.document_element(), 0);
}

}  // namespace myotet::skeleton
