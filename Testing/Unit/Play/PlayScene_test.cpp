// SPDX-License-Identifier: Apache-2.0
#include "Play/PlayScene.h"

#include <gmock/gmock.h>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "MeshFiles/MeshFiles.h"
#include "Play/RunPlay.h"
#include "Support/PlayShapes.h"
#include "Support/TemporaryFolder.h"

namespace myotet::play {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const char* const kSound = R"(title: two blocks
bodies:
  block:
    cage: block.vtu
    surface: inner.stl
    soft: {young: 0.02, poisson: 0.4}
    density_kg_m3: 900
    places:
      - {translation: [0, 0, 3]}
      - {translation: [2, 1, 20], rotation: {axis: [0, 0, 1], angle_deg: 90}, velocity: [0, 0, -500]}
obstacles:
  floor: {plane: {point: [0, 0, 0], normal: [0, 0, 2]}}
  box: {bin: {min: [-30, -30, -1], max: [30, 30, 40]}}
  pusher: {sphere: {centre: [40, 0, 5], radius: 4}, motion: [{time: 0.1, translation: [-10, 0, 0]}]}
balls:
  shot: {centre: [0, 0, 60], radius: 2, mass_kg: 0.001, velocity: [0, 0, -1000]}
contact: {friction: 0.5}
time: {end: 0.1, step: 0.02}
output: {every: 0.04}
)";

const char* const kMuscle = R"(bodies:
  muscle:
    cage: block.vtu
    muscle: teran2003_muscle
    fibres: {from: constant, direction: [0, 0, 1]}
    activation: [[0, 0], [0.1, 1]]
    hold: [{point: [0, 0, 0], normal: [0, 0, 1], within: 0.1}]
time: {end: 0.1, step: 0.02}
gravity: [0, 0, 0]
)";

class PlaySceneFiles : public ::testing::Test {
protected:
    void SetUp() override {
        meshfiles::write_vtu(test::block_at({0, 0, 0}, {10, 10, 12}, {2, 2, 3}), {},
                             folder_ / "block.vtu");
        meshfiles::write_stl(boundary_surface(test::block_at({1, 1, 1}, {8, 8, 10}, {5, 5, 5})),
                             folder_ / "inner.stl");
    }
    PlayScene read(const std::string& text) {
        testing::write_bytes(folder_ / "scene.yaml", text);
        return read_play_scene(folder_ / "scene.yaml");
    }
    // `kSound` with one text for another; what is said of it.
    std::string refusal(const std::string& from, const std::string& to,
                        const char* sound = kSound) {
        std::string text = sound;
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
        try {
            (void)make_world(read(text), MYOTET_DATA_DIR "/materials");
        } catch (const InputError& error) {
            return error.what();
        }
        return "not refused";
    }
    testing::TemporaryFolder folder_;
};

TEST_F(PlaySceneFiles, a_scene_is_what_it_says) {
    const PlayScene scene = read(kSound);
    EXPECT_EQ(scene.title, "two blocks");
    ASSERT_EQ(scene.bodies.size(), 1u);
    EXPECT_EQ(scene.bodies[0].places.size(), 2u);
    EXPECT_DOUBLE_EQ(scene.bodies[0].density, 9e-10);
    ASSERT_EQ(scene.obstacles.size(), 7u) << "a bin is a floor and four walls";
    EXPECT_EQ(scene.obstacles[0].normal, Vec3(0, 0, 1));
    EXPECT_EQ(scene.obstacles[2].name, "box_wall_low_x");
    EXPECT_EQ(scene.obstacles[2].normal, Vec3(1, 0, 0));
    EXPECT_EQ(scene.obstacles[3].point.x(), 30);
    EXPECT_EQ(scene.obstacles[6].form, Form::sphere);
    EXPECT_DOUBLE_EQ(scene.balls[0].mass, 1e-6);
    EXPECT_EQ(scene.every, 0.04);
    EXPECT_EQ(scene.gravity, Vec3(0, 0, -9810));
}

TEST_F(PlaySceneFiles, a_world_weighs_what_the_surfaces_enclose) {
    const MadeWorld made = make_world(read(kSound), "");
    const World& world = made.world;
    ASSERT_EQ(world.bodies.size(), 2u);
    EXPECT_EQ(world.bodies[1].name, "block_2");
    for (const Body& body : world.bodies) {
        EXPECT_NEAR(body.mass, 640 * 9e-10, 1e-14);
        EXPECT_EQ(body.embedding.outside, 0u);
        const TriMesh detail = detail_of(body, world.rest);
        for (std::size_t i = 0; i < detail.points.size(); ++i)
            EXPECT_LT((detail.points[i] - body.detail.points[i]).norm(), 1e-9);
    }
    EXPECT_EQ(world.velocity[world.bodies[1].first_node], Vec3(0, 0, -500));
    EXPECT_NEAR(world.contact.gap, 0.05 * world.shortest_mean_edge(), 1e-12);
    EXPECT_EQ(world.contact.friction, 0.5);
    EXPECT_TRUE(made.notes.empty());
}

TEST_F(PlaySceneFiles, mistakes_are_told_with_line_value_and_remedy) {
    const auto says = [&](const char* from, const char* to, const char* what) {
        EXPECT_THAT(refusal(from, to), HasSubstr(what)) << to;
    };
    EXPECT_THAT(refusal("cage: block.vtu", "cage: none.vtu"),
                AllOf(HasSubstr("scene.yaml:4: 'cage' is 'none.vtu'"), HasSubstr("no file")));
    EXPECT_THAT(refusal("young: 0.02", "young: -1"),
                HasSubstr("scene.yaml:6: 'young' is '-1' but must be a Young's modulus"));
    says("cage: block.vtu", "cage: inner.stl", "a file of tetrahedra");
    says("surface: inner.stl", "surface: block.vtu", "a file of a surface");
    says("poisson: 0.4", "poisson: 0.5", "Poisson's ratio from 0 to 0.499");
    says("soft: {", "muscel: {", "did you mean 'muscle'?");
    says("friction: 0.5", "friction: nan", "a coefficient from 0 to 10");
    says("end: 0.1, step: 0.02", "end: 0.1, step: 0.2", "make the step shorter");
    says("every: 0.04", "every: 0.001", "write 'every' at least as long");
    says("max: [30, 30, 40]", "max: [-30, 30, 40]", "'min' must be less than 'max'");
    says("mass_kg: 0.001", "mass_kg: 0.001, density_kg_m3: 1", "leave the other out");
    says("normal: [0, 0, 2]", "normal: [0, 0, 0]", "must point somewhere");
    says("time: 0.1, t", "time: 0, t", "a time in s above 0");
    says("title: two blocks", "titel: two blocks", "did you mean 'title'?");
    says("radius: 2", "radius: 0", "a length in mm above 0");
    says("end: 0.1", "end: 0.1, iterations: 2.5", "a whole number");
}

TEST_F(PlaySceneFiles, mistakes_of_muscles) {
    EXPECT_EQ(refusal("end: 0.1", "end: 0.1", kMuscle), "not refused");
    EXPECT_THAT(refusal("teran2003_muscle", "teran2003_mussel", kMuscle),
                HasSubstr("did you mean"));
    EXPECT_THAT(refusal("[0.1, 1]", "[0.1, 2]", kMuscle), HasSubstr("scene.yaml:6"));
    EXPECT_THAT(refusal("within: 0.1", "within: 100", kMuscle), HasSubstr("hold fewer"));
    EXPECT_THAT(refusal("point: [0, 0, 0]", "point: [0, 0, -5]", kMuscle),
                HasSubstr("the nearest is 5 mm away"));
    EXPECT_THAT(refusal("    fibres: {from: constant, direction: [0, 0, 1]}\n", "", kMuscle),
                HasSubstr("'fibres' is missing"));
    EXPECT_THAT(refusal("constant, direction: [0, 0, 1]", "constant, pennation_deg: 1", kMuscle),
                HasSubstr("'pennation_deg' is not known"));
}

TEST_F(PlaySceneFiles, laplace_fibres_run_from_plane_to_plane) {
    std::string text = kMuscle;
    const std::string from = "{from: constant, direction: [0, 0, 1]}";
    text.replace(text.find(from), from.size(),
                 "{from: laplace, origin: {point: [0, 0, 0], normal: [0, 0, 1], within: 0.1}, "
                 "insertion: {point: [0, 0, 12], normal: [0, 0, 1], within: 0.1}}");
    EXPECT_NO_THROW((void)make_world(read(text), MYOTET_DATA_DIR "/materials"));
}

TEST_F(PlaySceneFiles, a_muscle_shortens_and_the_end_that_is_held_stays) {
    PlayScene scene = read(kMuscle);
    MadeWorld made = make_world(scene, MYOTET_DATA_DIR "/materials");
    Stepper stepper(made.world, {});
    State state = stepper.start();
    for (int i = 0; i < 15; ++i) (void)stepper.step(scene.step, state);
    double top = 0;
    for (std::size_t n = 0; n < state.x.size(); ++n) {
        if (made.world.rest[n].z() == 12) top += state.x[n].z() / 9;
        if (made.world.rest[n].z() == 0) {
            EXPECT_EQ(state.x[n], made.world.rest[n]);
        }
    }
    // Free, the material shortens to 0.655; the held foot of a stout block hinders it.
    EXPECT_LT(top, 0.78 * 12);
    EXPECT_GT(top, 0.64 * 12);
}

TEST_F(PlaySceneFiles, a_run_writes_frames_and_counts) {
    const PlayScene scene = read(kSound);
    const auto run = [&](const char* name, int threads) {
        const ThreadLimit limit(threads);
        MadeWorld made = make_world(scene, "");
        SilentProgress quiet;
        return run_play(scene, made.world, {.folder = folder_ / name, .step = {}}, quiet);
    };
    const PlaySummary one = run("one", 1);
    EXPECT_TRUE(one.completed);
    EXPECT_EQ(one.steps, 5);
    EXPECT_EQ(one.frames, 3u);
    EXPECT_EQ(one.inverted, 0u);
    EXPECT_EQ(one.history.rows.size(), 6u);
    EXPECT_EQ(one.files.size(), 8u);
    for (const auto& file : one.files)
        EXPECT_TRUE(std::filesystem::exists(folder_ / "one" / file)) << file;
    (void)run("many", 4);
    for (const auto& file : one.files)
        EXPECT_EQ(testing::read_bytes(folder_ / "one" / file),
                  testing::read_bytes(folder_ / "many" / file))
            << file;
    const TetMesh last = meshfiles::read_vtu(folder_ / "one" / one.files[4]);
    EXPECT_EQ(last.tets.size(), 2 * 5 * 12u);
    EXPECT_EQ(last.labels.back(), 2);
}

}  // namespace
}  // namespace myotet::play
