// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace myotet::testing {

/// The first mistake in a page's markup, or an empty text: tags that are not closed in their
/// order, attributes without quotes, a bare < or &. Elements without content end with "/>".
inline std::string markup_mistake(std::string_view html) {
    std::vector<std::string> open;
    const auto around = [&](std::size_t at) {
        return std::string(html.substr(at > 40 ? at - 40 : 0, 90));
    };
    for (std::size_t at = 0; at < html.size();) {
        if (html[at] == '&') {
            const std::size_t end = html.find(';', at);
            if (end == std::string_view::npos || end - at > 8) return "bare &: " + around(at);
            at = end + 1;
            continue;
        }
        if (html[at] != '<') {
            ++at;
            continue;
        }
        std::size_t end = at + 1;
        for (char quote = 0; end < html.size() && (quote != 0 || html[end] != '>'); ++end) {
            if (html[end] == '<') return "< in a tag: " + around(at);
            if (html[end] == '"') quote = quote != 0 ? 0 : '"';
        }
        if (end == html.size()) return "a tag without end: " + around(at);
        const std::string_view tag = html.substr(at + 1, end - at - 1);
        at = end + 1;
        if (tag.starts_with('!') || tag.ends_with('/')) continue;
        const bool closes = tag.starts_with('/');
        const std::string name(tag.substr(closes, tag.find_first_of(" \n") - closes));
        if (!closes) {
            open.push_back(name);
            if (name == "style" || name == "script") at = html.find("</" + name, at);
        } else if (open.empty() || open.back() != name) {
            return "</" + name + "> closes <" + (open.empty() ? "nothing" : open.back()) +
                   ">: " + around(end);
        } else {
            open.pop_back();
        }
    }
    return open.empty() ? "" : "<" + open.back() + "> is not closed";
}

}  // namespace myotet::testing
