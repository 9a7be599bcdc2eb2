// SPDX-License-Identifier: Apache-2.0
#include "Report/Viewer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "Core/Errors.h"
#include "Report/Deflate.h"
#include "Report/TetCode.h"
#include "Report/ViewerPack.h"
#include "ReportShapes.h"
#include "Support/Markup.h"
#include "Support/ReferenceCase.h"

namespace myotet::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TetMesh block() { return test::five_tet_block(Vec3(6, 4, 9), {6, 4, 9}); }

// What the viewer's program does with the numbers.
class Reader {
public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}
    std::uint32_t next() {
        std::uint32_t value = 0;
        for (int shift = 0;; shift += 7) {
            const auto byte = static_cast<unsigned char>(bytes_[at_++]);
            value |= (byte & 127U) << shift;
            if (byte < 128) return value;
        }
    }
    [[nodiscard]] bool done() const { return at_ == bytes_.size(); }

private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

struct ReadTets {
    std::vector<Tet> tets;
    std::vector<Triangle> boundary;
};

ReadTets read_back(const Connections& told, std::size_t count) {
    Reader reader(told.bytes);
    ReadTets read;
    std::int32_t points = 0;
    const auto corner = [&](std::uint32_t code) {
        return code == 2 ? points++ : points - static_cast<std::int32_t>(code - 2);
    };
    std::vector<std::pair<std::size_t, int>> queue;
    std::size_t next = 0;
    while (read.tets.size() < count) {
        Tet seed;
        for (std::int32_t& c : seed) c = corner(reader.next());
        for (int face = 0; face < 4; ++face) queue.emplace_back(read.tets.size(), face);
        read.tets.push_back(seed);
        for (; next < queue.size(); ++next) {
            const auto [a, b, c] = face_of(read.tets[queue[next].first], queue[next].second);
            const std::uint32_t code = reader.next();
            if (code == 1) read.boundary.push_back({a, b, c});
            if (code < 2) continue;
            for (int face = 0; face < 3; ++face) queue.emplace_back(read.tets.size(), face);
            read.tets.push_back({a, b, c, corner(code)});
        }
    }
    EXPECT_TRUE(reader.done());
    return read;
}

// Each tetrahedron as its sorted corners; and the volume tells that none is turned over.
std::multiset<Tet> sorted(std::vector<Tet> tets) {
    for (Tet& t : tets) std::ranges::sort(t);
    return {tets.begin(), tets.end()};
}

void expect_told_whole(const TetMesh& mesh) {
    const Connections told = tell_tets(mesh.tets, mesh.points.size());
    ReadTets read = read_back(told, mesh.tets.size());
    TetMesh back;
    for (const std::int32_t old : told.points) back.points.push_back(mesh.points[old]);
    back.tets = read.tets;
    for (const Tet& t : back.tets)
        EXPECT_GT(signed_volume(back.points[t[0]], back.points[t[1]], back.points[t[2]],
                                back.points[t[3]]),
                  0);
    EXPECT_EQ(read.boundary.size(), boundary_faces(mesh.tets).size());
    for (std::size_t t = 0; t < read.tets.size(); ++t) {
        Tet old = mesh.tets[told.elements[t]], now = read.tets[t];
        for (std::int32_t& n : now) n = told.points[n];
        std::ranges::sort(old);
        std::ranges::sort(now);
        EXPECT_EQ(old, now);
        for (std::int32_t& n : read.tets[t]) n = told.points[n];
    }
    EXPECT_EQ(sorted(read.tets), sorted(mesh.tets));
}

TEST(TetCode, TellsEachTetrahedronAndTheBoundary) { expect_told_whole(block()); }

TEST(TetCode, TellsPiecesThatDoNotTouchOrOnlyAtAPoint) {
    TetMesh mesh = block();
    append(mesh, block());
    mesh.points.push_back({-1, -1, -1});
    mesh.points.push_back({-1, 0, -1});
    mesh.points.push_back({0, -1, -1});
    const auto last = static_cast<std::int32_t>(mesh.points.size()) - 1;
    mesh.tets.push_back({0, last - 2, last - 1, last});
    const Tet& t = mesh.tets.back();
    if (signed_volume(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[t[3]]) <
        0)
        std::swap(mesh.tets.back()[2], mesh.tets.back()[3]);
    expect_told_whole(mesh);
}

TEST(TetCode, TakesFewBytes) {
    const TetMesh mesh = test::five_tet_block(Vec3(20, 20, 20), {20, 20, 20});
    const Connections told = tell_tets(mesh.tets, mesh.points.size());
    EXPECT_LT(static_cast<double>(told.bytes.size()), 5.0 * static_cast<double>(mesh.tets.size()));
    EXPECT_LT(static_cast<double>(deflated(told.bytes).size()),
              2.0 * static_cast<double>(mesh.tets.size()));
}

TEST(TetCode, GuessesNamePointsThatAreThere) {
    const Connections told = tell_tets(block().tets, block().points.size());
    ASSERT_EQ(told.guesses.size(), told.points.size());
    for (std::size_t p = 0; p < told.guesses.size(); ++p)
        for (const std::int32_t n :
             {told.guesses[p].a, told.guesses[p].b, told.guesses[p].c, told.guesses[p].d})
            EXPECT_LT(n, static_cast<std::int32_t>(p));
}

TEST(TriangleCode, TellsEachTriangle) {
    const TriMesh surface = ball({1, 2, 3}, 5, 12, 16);
    const Connections told = tell_triangles(surface.triangles, surface.points.size());
    Reader reader(told.bytes);
    std::int32_t points = 0;
    for (const Triangle& triangle : surface.triangles)
        for (const std::int32_t corner : triangle) {
            const std::uint32_t code = reader.next();
            const std::int32_t now =
                code == 0 ? points++ : points - static_cast<std::int32_t>(code);
            EXPECT_EQ(told.points[now], corner);
        }
    EXPECT_TRUE(reader.done());
}

ViewedScene scene() {
    ViewedScene made;
    ViewedBody body{.name = "</script><b>\"left\" & 'lower'", .colour = {1, 0, 0}, .mesh = block()};
    body.values.push_back({.quantity = 0,
                           .at = ViewedValues::At::tets,
                           .times = {std::vector<double>(body.mesh.tets.size(), 0.5)}});
    body.values[0].times[0][3] = NAN;
    made.bodies.push_back(body);
    made.bodies.push_back({.name = "bone", .colour = {0, 1, 0}, .surface = ball({}, 3, 8, 9)});
    made.quantities.push_back({"stretch", 0, 1});
    return made;
}

TEST(Viewer, NamesStayTexts) {
    const PackedScene made = packed(scene());
    EXPECT_THAT(made.header, Not(HasSubstr("<")));
    EXPECT_THAT(made.header, HasSubstr("\\u003c/script>\\u003cb>\\\"left\\\" & 'lower'"));
    EXPECT_EQ(myotet::testing::markup_mistake(viewer_html(scene())), "");
}

TEST(Viewer, TheSameSceneHasTheSameBytes) { EXPECT_EQ(viewer_html(scene()), viewer_html(scene())); }

TEST(Viewer, SaysWhetherThereIsAProgram) {
    const std::string html = viewer_html(scene());
    if (has_viewer()) {
        EXPECT_THAT(html, HasSubstr("id=\"viewer-data\""));
        EXPECT_THAT(html, HasSubstr("Kitware"));
        EXPECT_LT(html.size(), 1500000u);
    } else {
        EXPECT_THAT(html, HasSubstr("was built without Node.js and npm"));
    }
}

TEST(Viewer, ValuesAreAsManyAsElements) {
    ViewedScene wrong = scene();
    wrong.bodies[0].values[0].times[0].pop_back();
    EXPECT_THROW((void)packed(wrong), InputError);
    wrong = scene();
    wrong.bodies[0].values[0].quantity = 1;
    EXPECT_THROW((void)packed(wrong), InputError);
    wrong = scene();
    wrong.bodies[0].moments = {block().points, {}};
    EXPECT_THROW((void)packed(wrong), InputError);
    wrong = scene();
    wrong.bodies[0].fibres = {{Vec3::UnitX()}};
    EXPECT_THROW((void)packed(wrong), InputError);
}

TEST(Viewer, AFlatOrEmptyBodyIsNoError) {
    ViewedScene flat;
    flat.bodies.push_back({.name = "flat", .surface = square(2, 0)});
    flat.bodies.push_back({.name = "none"});
    const PackedScene made = packed(flat);
    EXPECT_THAT(made.header, Not(HasSubstr("inf")));
    EXPECT_THAT(made.header, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace myotet::report
