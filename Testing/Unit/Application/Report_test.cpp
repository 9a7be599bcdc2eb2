// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <new>
#include <nlohmann/json.hpp>

#include "ExitCodes.h"
#include "MeshReport.h"
#include "ReportText.h"

namespace myotet::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::json;

TEST(BrokenPromises, NoneForAGoodMesh) {
    quality::Topology topology;
    topology.boundary_manifold = true;
    EXPECT_THAT(broken_promises({}, topology), IsEmpty());
}

TEST(BrokenPromises, ASentenceEach) {
    quality::ShapeSummary shapes;
    shapes.inverted_tets = 1;
    quality::Topology topology;
    topology.non_manifold_edges = 2;
    topology.non_manifold_vertices = 3;
    topology.tets_with_four_boundary_nodes = 4;
    topology.interior_edges_joining_boundary_nodes = 5;
    EXPECT_THAT(broken_promises(shapes, topology),
                ElementsAre(HasSubstr("1 inverted"), HasSubstr("2 boundary edges"),
                            HasSubstr("3 boundary nodes"), HasSubstr("4 tetrahedra"),
                            HasSubstr("5 interior edges")));
}

/// One tetrahedron of label 3, and two of label 9 that share a face.
TetMesh two_labels() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {9, 9, 9}},
            {{0, 1, 2, 3}, {0, 1, 2, 3}, {0, 2, 1, 4}},
            {3, 9, 9}};
}

TEST(MeasureTissues, EachLabelByItself) {
    const std::vector<TissueReport> reports = measure_tissues(two_labels());
    ASSERT_EQ(reports.size(), 2u);
    EXPECT_EQ(reports[0].label, 3);
    EXPECT_EQ(reports[0].vertices, 4u);
    EXPECT_DOUBLE_EQ(reports[0].volume_mesh, 1.0 / 6);
    EXPECT_EQ(reports[1].label, 9);
    EXPECT_EQ(reports[1].tets, 2u);
    EXPECT_EQ(reports[1].vertices, 5u);
    EXPECT_DOUBLE_EQ(reports[1].volume_mesh, 1.0 / 3);
    EXPECT_FALSE(reports[1].broken_promises.empty());  // no interior node
}

TEST(Measure, ATissueWithoutMeshBreaksAPromise) {
    TissueReport report;
    measure({}, report);
    EXPECT_THAT(report.broken_promises, ElementsAre(HasSubstr("no mesh")));
}

TEST(ToJson, NumbersThatAreNoneAndBytesThatAreNoTextStayValid) {
    RunReport run;
    run.run.input = "scan\xff.nii";
    run.run.options_number = {{"tets", std::nan("")}, {"edge_length_mm", 2}};
    run.tissues.resize(1);
    run.tissues[0].name = "m\xfcsculo";  // Latin-1
    run.tissues[0].shapes.max_aspect_ratio = std::numeric_limits<double>::infinity();
    const Json read = Json::parse(to_json(run));
    EXPECT_TRUE(read["options"]["tets"].is_null());
    EXPECT_EQ(read["options"]["edge_length_mm"], 2);
    EXPECT_TRUE(read["tissues"][0]["max_aspect_ratio"].is_null());
    EXPECT_TRUE(read["tissues"][0]["voxels"].is_null());  // a surface has none
}

TEST(ToTable, SaysWhichPromiseIsBroken) {
    RunReport run;
    run.tissues.resize(2);
    run.tissues[0].name = "biceps";
    run.tissues[1].broken_promises = {"2 inverted tetrahedra"};
    EXPECT_THAT(to_table(run), HasSubstr("biceps"));
    EXPECT_THAT(to_table(run), HasSubstr("broken promise: 2 inverted tetrahedra"));
}

TEST(EndingFor, EachKindHasItsCode) {
    const auto code = [](auto error) { return ending_for(std::make_exception_ptr(error)).code; };
    EXPECT_EQ(code(UsageError("")), ExitCode::usage);
    EXPECT_EQ(code(InputError("")), ExitCode::bad_input);
    EXPECT_EQ(code(IoError("")), ExitCode::bad_input);
    EXPECT_EQ(code(MeshError("")), ExitCode::broken_promise);
    EXPECT_EQ(code(ResourceError("")), ExitCode::out_of_resource);
    EXPECT_EQ(code(std::bad_alloc()), ExitCode::out_of_resource);
    EXPECT_EQ(code(Interrupted()), ExitCode::interrupted);
    EXPECT_EQ(code(LogicError("")), ExitCode::bug);
    EXPECT_EQ(code(1), ExitCode::bug);
}

}  // namespace
}  // namespace myotet::app
