// SPDX-License-Identifier: Apache-2.0
#include "Report/Page.h"

#include "Report/Html.h"
#include "Report/PageStyle.h"

namespace myotet::report {

std::string to_html(const Page& page) {
    const std::string title = escaped(page.title);
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
        "style-src 'unsafe-inline'; script-src 'unsafe-inline'\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
        title + "</title>\n<style>" + std::string(kPageStyle) +
        "</style>\n</head>\n<body>\n<header>\n<h1>" + title + "</h1>\n" + page.lead +
        "</header>\n<nav aria-label=\"Parts of this page\"><ul>\n";
    for (const Section& section : page.sections)
        html += "<li><a href=\"#" + section.id + "\">" + escaped(section.title) + "</a></li>\n";
    html += "</ul></nav>\n<main>\n";
    for (const Section& section : page.sections)
        html += "<section id=\"" + section.id + "\">\n<h2>" + escaped(section.title) + "</h2>\n" +
                section.html + "</section>\n";
    return html + "</main>\n<script>" + std::string(kPageScript) + "</script>\n</body>\n</html>\n";
}

std::string to_html(const Strip& strip) {
    std::string html = "<div class=\"strip\" role=\"group\" aria-label=\"" + escaped(strip.name) +
                       "\"" + (strip.plays ? " data-plays=\"\"" : "") +
                       "><div class=\"frames\" tabindex=\"0\">\n";
    for (std::size_t f = 0; f < strip.frames.size(); ++f)
        html += "<figure class=\"frame" + std::string(f == strip.first ? " shown" : "") + "\">" +
                strip.frames[f].html + "<figcaption>" + escaped(strip.frames[f].name) +
                "</figcaption></figure>\n";
    return html + "</div></div>\n";
}

}  // namespace myotet::report
