// SPDX-License-Identifier: Apache-2.0
#include "Report/Page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "Report/ColourMap.h"
#include "Report/Html.h"
#include "Support/Markup.h"

namespace myotet::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Page, IsWellFormedAndStandsAlone) {
    const Strip strip{
        .name = "rows & \"slices\"",
        .frames = {{"<one>", figure(blank(4, 4), "a < b", "below")}, {"two", paragraph("text")}},
        .first = 1,
        .plays = true};
    const std::string html = to_html(
        Page{.title = "<script>alert(1)</script>",
             .lead = paragraph("lead"),
             .sections = {{"one", "First & second", to_html(strip)}, {"two", "Empty", ""}}});
    EXPECT_EQ(myotet::testing::markup_mistake(html), "");
    EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
    EXPECT_THAT(html, Not(HasSubstr("http:")));
    EXPECT_THAT(html, Not(HasSubstr("https:")));
    EXPECT_THAT(html, HasSubstr("<a href=\"#one\">First &amp; second</a>"));
    EXPECT_THAT(html, HasSubstr("alt=\"a &lt; b\""));
    EXPECT_THAT(html, HasSubstr("<figure class=\"frame shown\"><p>text</p>"));
    EXPECT_THAT(html, HasSubstr("prefers-color-scheme"));
    EXPECT_THAT(html, HasSubstr("default-src 'none'"));
}

TEST(Markup, MistakesAreFound) {
    EXPECT_EQ(myotet::testing::markup_mistake("<p>a<br/>b</p>"), "");
    for (const char* wrong :
         {"<p>", "</p>", "<b><i></b></i>", "a & b", "<p title=\"x></p>", "<<p>"})
        EXPECT_NE(myotet::testing::markup_mistake(wrong), "") << wrong;
}

TEST(DistinctColours, DifferAmongManyTissues) {
    for (std::size_t a = 0; a < 116; ++a)
        for (std::size_t b = 0; b < a; ++b) {
            double squares = 0;
            for (int c = 0; c < 3; ++c)
                squares += std::pow(distinct_colour(a)[c] - distinct_colour(b)[c], 2);
            EXPECT_GT(std::sqrt(squares), 0.07) << a << " " << b;
        }
}

}  // namespace
}  // namespace myotet::report
