// SPDX-License-Identifier: Apache-2.0
#include "MeshFiles/NamedComments.h"

#include "MeshFiles/RawMesh.h"
#include "MeshFiles/RawSurface.h"

namespace myotet::meshfiles {

NamedComments read_comments(std::string_view content, char mark) {
    NamedComments found;
    const std::pair<std::string_view, std::map<std::int64_t, std::string>*> kinds[] = {
        {" label ", &found.labels}, {" faces ", &found.faces}, {" nodes ", &found.nodes}};
    for (std::size_t at = 0; at < content.size();) {
        const std::size_t end = std::min(content.find('\n', at), content.size());
        if (content[at] == mark) {
            const std::string_view line = content.substr(at + 1, end - at - 1);
            if (found.space.empty()) found.space = space_said_by(line);
            for (const auto& [word, names] : kinds) {
                std::int64_t value = 0;
                std::string name;
                if (line.starts_with(word) &&
                    parse_value_name(line.substr(word.size()), value, name))
                    (*names)[value] = name;
            }
        }
        at = end + 1;
    }
    return found;
}

}  // namespace myotet::meshfiles
