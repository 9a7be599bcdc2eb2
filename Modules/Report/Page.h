// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace myotet::report {

/// A part of a page with its own heading.
struct Section {
    std::string id;     ///< letters and hyphens; the link to it
    std::string title;  ///< text
    std::string html;   ///< markup
};

/// A page that stands in one file: opens from disk, asks for nothing else.
struct Page {
    std::string title;  ///< text
    std::string lead;   ///< markup below the title: what matters most
    std::vector<Section> sections;
};

/// The page's file: its style, its sections and the links to them, and a script with which a
/// row of pictures becomes one picture with a slider; without it the row is scrolled. Browsers
/// are told to let nothing in from elsewhere.
[[nodiscard]] std::string to_html(const Page& page);

/// One picture of a row.
struct Frame {
    std::string name;  ///< text below it
    std::string html;  ///< markup: the picture
};

/// Pictures in a row, one at a time with a slider.
struct Strip {
    std::string name;  ///< text: what the row shows
    std::vector<Frame> frames;
    std::size_t first = 0;  ///< that is shown at first
    bool plays = false;     ///< has a button that shows one after the other
};
[[nodiscard]] std::string to_html(const Strip& strip);

}  // namespace myotet::report
