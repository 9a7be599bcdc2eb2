// SPDX-License-Identifier: Apache-2.0
#include <random>

#include "OsimKit.h"
#include "Skeleton/Skeleton.h"

namespace myotet::skeleton {
using namespace std::string_literals;
namespace {

/// A file is a model, which may be one that cannot move, or is refused; nothing else happens.
void expect_model_or_refusal(const std::string& text) {
    static const myotet::testing::TemporaryFolder folder;
    myotet::testing::write_bytes(folder / "small.osim", text);
    try {
        const Model model = read_osim(folder / "small.osim");
        const Skeleton skeleton(model);
        EXPECT_EQ(skeleton.poses().size(), model.bodies.size());
    } catch (const Error&) {
    }
}

SmallModel whole() {
    SmallModel small;
    small.upper_extra =
        "<WrapObjectSet><objects><WrapTorus name=\"t\"><inner_radius>0.01</inner_radius>"
        "<outer_radius>0.03</outer_radius><quadrant>-x</quadrant></WrapTorus></objects>"
        "</WrapObjectSet>";
    small.forces =
        "<Thelen2003Muscle name=\"m\"><GeometryPath><PathPointSet><objects>"
        "<PathPoint name=\"p\"><socket_parent_frame>/ground</socket_parent_frame>"
        "<location>0 0 0</location></PathPoint><ConditionalPathPoint name=\"q\">"
        "<socket_parent_frame>/bodyset/forearm</socket_parent_frame><location>0 -0.1 0"
        "</location><socket_coordinate>/jointset/elbow/flex</socket_coordinate>"
        "<range>0 1</range></ConditionalPathPoint></objects></PathPointSet><PathWrapSet>"
        "<objects><PathWrap><wrap_object>t</wrap_object><range>1 2</range></PathWrap></objects>"
        "</PathWrapSet></GeometryPath><max_isometric_force>100</max_isometric_force>"
        "</Thelen2003Muscle>";
    return small;
}

TEST(DamagedOsim, BytesThatChangeDoNoHarm) {
    const std::string text = whole().text();
    std::mt19937 random(7);
    const std::string bytes = "<>/\"&;-+.e09 \0\xff\x80nai"s;
    for (int trial = 0; trial < 1500; ++trial) {
        std::string damaged = text;
        for (unsigned hits = 1 + random() % 3; hits > 0; --hits)
            damaged[random() % damaged.size()] = bytes[random() % bytes.size()];
        expect_model_or_refusal(damaged);
    }
}

TEST(DamagedOsim, PiecesThatAreLostOrDoubledDoNoHarm) {
    const std::string text = whole().text();
    std::mt19937 random(11);
    for (int trial = 0; trial < 800; ++trial) {
        const std::size_t from = random() % text.size(), length = random() % 200;
        std::string damaged = text;
        if (trial % 2)
            damaged.erase(from, length);
        else
            damaged.insert(random() % text.size(), text.substr(from, length));
        expect_model_or_refusal(damaged);
    }
    for (std::size_t end = 0; end < text.size(); end += 37)
        expect_model_or_refusal(text.substr(0, end));
}

// Elements and words rather than bytes: what remains is XML, and means something else.
TEST(DamagedOsim, WordsThatAreExchangedDoNoHarm) {
    const std::string text = whole().text();
    const std::vector<std::string> words{"0",     "-1",     "nan",  "1e308", "flex",
                                         "upper", "ground", "true", "</x>",  "",
                                         "..",    "/",      "1 2",  "t",     "1e-320 0 0"};
    std::mt19937 random(13);
    for (int trial = 0; trial < 1200; ++trial) {
        const std::size_t from = text.find('>', random() % (text.size() - 200)) + 1;
        const std::size_t end = text.find('<', from);
        std::string damaged = text;
        damaged.replace(from, end - from, words[random() % words.size()]);
        expect_model_or_refusal(damaged);
    }
}

TEST(DamagedOsim, DeepNestingIsRefused) {
    std::string deep;
    for (int i = 0; i < 100000; ++i) deep += "<a>";
    EXPECT_THAT(refusal_of_text(deep), ::testing::HasSubstr("is not valid XML"));
    for (int i = 0; i < 100000; ++i) deep += "</a>";
    EXPECT_THAT(refusal_of_text(deep), ::testing::HasSubstr("more than 100 elements deep"));
}

}  // namespace
}  // namespace myotet::skeleton
