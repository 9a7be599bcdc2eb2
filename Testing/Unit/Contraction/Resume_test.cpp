// SPDX-License-Identifier: Apache-2.0
// Runs that are stopped and go on, runs that cannot go on, and runs that never begin.
#include "BlockScene.h"
#include "Core/Parallel.h"

namespace myotet::contraction {
namespace {

using namespace test;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// A muscle that shortens and is pressed, turned and pulled: all that a checkpoint must hold.
BlockText lively(const std::string& scheme) {
    BlockText text{
        .activation = "[[0, 0], [0.5, 1], [1, 0.2]]",
        .upper = "to: bone, within: 0.1",
        .time = "end: 1, step: 0.125, scheme: " + scheme,
        .more =
            "bones:\n  bone: {surface: bone.stl, motion: [{time: 0}, {time: 1, "
            "translation: [0, -0.5, -1], rotation: {axis: [1, 0, 0], angle_deg: 20, centre: "
            "[2, 2, 12]}}]}\n  floor: {surface: floor.stl, motion: [{time: 0}, {time: 1, "
            "translation: [0, 0.3, 0]}]}\ncontact:\n  - {between: [muscle, floor]}\n"};
    if (scheme == "quasi-static") return text;
    text.fibres += "\n    force_velocity: hill";
    text.material = "wet";
    text.more += "materials:\n  wet: {model: teran2003_muscle, viscosity: 1.0e-3}\n";
    return text;
}

struct LivelyFolder : BlockFolder {
    LivelyFolder() {
        meshfiles::write_stl(box_surface(Vec3(-1, -1, 11.5), Vec3(5, 5, 14)), folder / "bone.stl");
        meshfiles::write_stl(box_surface(Vec3(-4, -4, 3), Vec3(8, -0.1, 9)), folder / "floor.stl");
    }
};

TEST(Resume, GoesOnWithTheSameBytesOnAnyNumberOfThreads) {
    for (const char* scheme : {"quasi-static", "backward-euler", "generalized-alpha"}) {
        const LivelyFolder block;
        Loaded whole = block.load(lively(scheme));
        RunSummary at_once;
        {
            const ThreadLimit one(1);
            at_once = block.run(whole, {.checkpoint_every = 2});
        }
        EXPECT_GT(column(at_once.history, "muscle_on_floor_contact_force").back(), 0);
        const auto expected = contents(block.out());

        const ThreadLimit two(2);
        const fs::path again = block.folder / "again";
        Loaded first = block.load(lively(scheme));
        StopAfter stop(0.625);  // one step beyond the third checkpoint
        RunSummary run = block.run(first, {.folder = again, .checkpoint_every = 2}, stop);
        EXPECT_TRUE(run.interrupted);
        EXPECT_FALSE(run.completed);
        EXPECT_EQ(run.reached, 0.625);
        EXPECT_EQ(run.message, "stopped at 0.625 s");
        EXPECT_TRUE(run.resumable);

        Loaded second = block.load(lively(scheme));
        run = block.run(second, {.folder = again, .resume = true, .checkpoint_every = 3});
        EXPECT_EQ(run.resumed_from, 0.625);  // not 0.5: it made a checkpoint of its own
        EXPECT_EQ(run.iterations, at_once.iterations);
        EXPECT_EQ(run.history.rows, at_once.history.rows);
        const auto got = contents(again);
        ASSERT_EQ(got.size(), expected.size()) << scheme;
        for (const auto& [name, bytes] : expected)
            EXPECT_TRUE(got.at(name) == bytes) << scheme << ": " << name;
    }
}

TEST(Resume, OfASeriesInOneFileTheSame) {
    const LivelyFolder block;
    const RunOptions once{.checkpoint_every = 2, .series = Series::xdmf};
    Loaded whole = block.load(lively("quasi-static"));
    const RunSummary at_once = block.run(whole, once);
    const auto expected = contents(block.out());
    EXPECT_EQ(at_once.files, (std::vector<fs::path>{"contraction.h5", "contraction.xdmf",
                                                    "history.csv", "checkpoint.myotet"}));
    EXPECT_EQ(expected.size(), 4u);  // no parts are left

    const fs::path again = block.folder / "again";
    Loaded first = block.load(lively("quasi-static"));
    StopAfter stop(0.625);
    RunOptions run{.folder = again, .checkpoint_every = 2, .series = Series::xdmf};
    EXPECT_TRUE(block.run(first, run, stop).interrupted);
    EXPECT_TRUE(fs::exists(again / "contraction.xdmf"));  // what there is can be looked at
    run.resume = true;
    for (int finished = 0; finished < 2; ++finished) {
        Loaded second = block.load(lively("quasi-static"));
        (void)block.run(second, run);
        EXPECT_TRUE(contents(again) == expected);
    }
}

TEST(Resume, ManyFramesBecomeASeriesInOneFile) {
    EXPECT_EQ(decided(Series::by_count, kMostPvdFrames), Series::pvd);
    EXPECT_EQ(decided(Series::by_count, kMostPvdFrames + 1), Series::xdmf);
    EXPECT_EQ(decided(Series::pvd, 1'000'000), Series::pvd);
    EXPECT_EQ(decided(Series::xdmf, 1), Series::xdmf);
}

TEST(Resume, OfAFinishedRunChangesNothing) {
    const BlockFolder block;
    Loaded loaded = block.load(BlockText{});
    (void)block.run(loaded);
    const auto before = contents(block.out());
    Loaded again = block.load(BlockText{});
    const RunSummary run = block.run(again, {.resume = true});
    EXPECT_EQ(run.history.rows.size(), 5u);
    EXPECT_EQ(contents(block.out()), before);
}

TEST(Resume, BeforeTheFirstEquilibriumThereIsNothingToGoOnFrom) {
    const BlockFolder block;
    Loaded loaded = block.load({.activation = "1", .more = "gravity: [0, -9810, 0]\n"});
    StopAfter stop(0);
    stop.report("preparing", 0);
    (void)stop.interrupted();  // asked once: from now on it says yes
    const RunSummary run = block.run(loaded, {}, stop);
    EXPECT_TRUE(run.interrupted);
    EXPECT_FALSE(run.resumable);
    EXPECT_TRUE(contents(block.out()).empty());
}

TEST(Resume, ARunThatBeginsAnewTakesAwayWhatWasThere) {
    const BlockFolder block;
    Loaded loaded = block.load(BlockText{});
    (void)block.run(loaded);
    const auto expected = contents(block.out());
    testing::write_bytes(block.out() / "frames/frame_0099.vtu", "of a longer run");
    testing::write_bytes(block.out() / "frames/notes_of_mine.vtu", "stays");
    Loaded again = block.load(BlockText{});
    (void)block.run(again);
    auto got = contents(block.out());
    EXPECT_EQ(got.erase("frames/notes_of_mine.vtu"), 1u);
    EXPECT_EQ(got, expected);
}

TEST(Resume, WithoutACheckpointIsRefusedAndLeavesNoFolder) {
    const BlockFolder block;
    Loaded loaded = block.load(BlockText{});
    try {
        (void)block.run(loaded, {.resume = true});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("checkpoint.myotet is not there"),
                                        HasSubstr("run without --resume")));
    }
    EXPECT_FALSE(fs::exists(block.out()));
}

TEST(Resume, OfAnotherSceneIsRefused) {
    const BlockFolder block;
    testing::write_bytes(block.folder / "own.yaml",
                         read_bytes(fs::path(MYOTET_MATERIALS_DIR) / "teran2003_muscle.yaml"));
    const BlockText text{.material = "own",
                         .time = "end: 0.5, step: 0.25",
                         .more = "materials:\n  own: {model: own.yaml}\n"};
    Loaded loaded = block.load(text);
    (void)block.run(loaded);
    const auto before = contents(block.out());
    const auto refused = [&](const BlockText& changed) {
        Loaded other = block.load(changed);
        try {
            (void)block.run(other, {.resume = true});
        } catch (const InputError& error) {
            EXPECT_EQ(contents(block.out()), before);
            return std::string(error.what());
        }
        return std::string("no refusal");
    };
    BlockText longer = text;
    longer.time = "end: 2, step: 0.25";
    EXPECT_THAT(refused(longer),
                AllOf(StartsWith((block.out() / kCheckpointFile).string()), HasSubstr("another")));
    // The same scene, but constants that it names have changed.
    std::string own = read_bytes(block.folder / "own.yaml");
    own.replace(own.find("C1: 0.03"), 8, "C1: 0.04");
    testing::write_bytes(block.folder / "own.yaml", own);
    EXPECT_THAT(refused(text), HasSubstr("another"));
}

// Tetrahedra between what is fixed and what goes with the bone are flat when it has gone 2 mm:
// at 0.625 s.
TEST(Resume, WithoutEquilibriumItKeepsWhatItHasAndNamesTetrahedra) {
    const BlockFolder block;
    meshfiles::write_stl(box_surface(Vec3(-1, -1, 5.5), Vec3(2.5, 5, 14)),
                         block.folder / "bone.stl");
    std::string text = text_of(
        {.activation = "0",
         .upper = "to: bone, within: 0.1",
         .time = "end: 1, step: 0.125",
         .more = "bones:\n  bone: {surface: bone.stl, motion: [{time: 0}, {time: 0.5}, {time: 1, "
                 "translation: [0, 0, -8]}]}\n"});
    const std::string lower = "point: [0, 0, 0], normal: [0, 0, 1], within: 0.1";
    text.replace(text.find(lower), lower.size(),
                 "point: [0, 0, 0], normal: [0, 0, 1], within: 4.1");
    Loaded loaded = block.load_text(text);
    SilentProgress silent;
    const RunSummary run = block.run(loaded, {}, silent);
    EXPECT_FALSE(run.completed);
    EXPECT_FALSE(run.interrupted);
    EXPECT_GE(run.reached, 0.5);
    EXPECT_LT(run.reached, 0.625);
    EXPECT_GT(run.failed_steps, 0);
    EXPECT_THAT(run.message,
                AllOf(StartsWith("no equilibrium beyond "), HasSubstr(" tetrahedron "),
                      HasSubstr(" of muscle at ("), HasSubstr("; try a shorter 'step'")));
    // Rows and frames of moments that were met, and none more.
    const auto times = column(run.history, "time");
    EXPECT_LE(times.back(), run.reached);
    const auto files = contents(block.out());
    std::size_t frames = 0;
    for (const auto& [name, bytes] : files) frames += name.starts_with("frames/");
    EXPECT_EQ(frames, times.size());
    for (const double J : column(run.history, "muscle_min_J")) EXPECT_GT(J, 0);
    for (const fs::path& file : run.files) EXPECT_TRUE(files.contains(file.string())) << file;
}

TEST(Resume, WithoutEquilibriumAtTheStartNothingIsWritten) {
    const BlockFolder block;
    Loaded loaded = block.load({.activation = "1", .more = "gravity: [0, -9810, 0]\n"});
    SilentProgress silent;
    RunOptions options;
    options.solve.equilibrium.iterations = 1;
    options.solve.equilibrium.tolerance = 1e-12;
    const RunSummary run = block.run(loaded, options, silent);
    EXPECT_FALSE(run.completed);
    EXPECT_THAT(run.message, StartsWith("no equilibrium at the start: "));
    EXPECT_TRUE(run.files.empty());
    EXPECT_TRUE(contents(block.out()).empty());
}

TEST(Resume, FibresWithoutAMatrixAreWarnedOf) {
    const BlockFolder block;
    const Loaded loaded = block.load(BlockText{.material = "blemker2005_muscle"});
    EXPECT_THAT(loaded.model.warnings,
                ::testing::ElementsAre(AllOf(
                    StartsWith("material 'blemker2005_muscle' of muscle: fibres pull by their "
                               "isochoric stretch and no matrix"),
                    HasSubstr("give C1 or C2"))));
    EXPECT_TRUE(block.load(BlockText{}).model.warnings.empty());
}

}  // namespace
}  // namespace myotet::contraction
