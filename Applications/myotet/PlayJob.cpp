// SPDX-License-Identifier: Apache-2.0
#include "PlayJob.h"

#include "Contraction/Run.h"
#include "Core/Parallel.h"
#include "Core/Stopwatch.h"
#include "Core/Text.h"
#include "Costs.h"
#include "Machine.h"
#include "Outputs.h"
#include "Pictures.h"
#include "PlayPictures.h"

namespace myotet::app {
namespace {

constexpr const char* kSheet = "pictures/play.png";

// A scene with all that it names.
struct Prepared {
    play::PlayScene scene;
    play::World world;
};

Prepared prepare(const PlayJobOptions& options, PlayReport& report, ProgressSink& progress) {
    Stopwatch watch;
    Prepared made;
    made.scene = play::read_play_scene(options.scene);
    play::MadeWorld world = play::make_world(made.scene, data_folder() / "materials");
    made.world = std::move(world.world);
    progress.check();
    report.seconds["preparation"] = watch.lap();
    report.scene = options.scene.string();
    report.title = made.scene.title;
    report.output = options.output.string();
    report.contact = made.world.contact;
    report.end = made.scene.end;
    report.step = made.scene.step;
    report.threads = thread_count();
    report.warnings = world.notes;
    for (const std::string& warning : report.warnings) progress.warn(warning);
    for (const play::Body& body : made.world.bodies)
        report.parts.push_back({.name = body.name,
                                .nodes = static_cast<std::size_t>(body.nodes),
                                .tets = body.tets.size(),
                                .embedded = body.embedding.size(),
                                .mass = body.mass,
                                .muscle = body.law != nullptr});
    for (const play::Ball& ball : made.world.balls)
        report.parts.push_back(
            {.name = ball.name, .nodes = 1, .mass = made.world.masses[ball.node], .ball = true});
    return made;
}

// What is inside of something else at the start is pushed out, which drives it.
void warn_of_overlap(PlayReport& report, ProgressSink& progress) {
    if (report.run.history.rows.empty()) return;
    const double deepest = report.run.history.rows.front()[play::kDeepestColumn];
    if (!(deepest > 0)) return;
    report.warnings.push_back("at the start things are inside each other, by up to " +
                              rounded(deepest) + " mm; place them farther apart");
    progress.warn(report.warnings.back());
}

}  // namespace

PlayReport check_play(const PlayJobOptions& options, ProgressSink& progress) {
    const ThreadLimit limit(options.threads);
    PlayReport report;
    (void)prepare(options, report, progress);
    note_costs(report);
    return report;
}

PlayReport run_play_job(const PlayJobOptions& options, ProgressSink& progress) {
    const ThreadLimit limit(options.threads);
    PlayReport report;
    OutputFolder out(options.output);
    Prepared prepared = prepare(options, report, progress);
    play::RunPlayOptions running{.folder = options.output,
                                 .step = {.iterations = prepared.scene.iterations}};
    double drawing = 0;
    contraction::remove_numbered(options.output / "pictures", ".png");
    const Box fit = box_of_play(prepared.scene, prepared.world);
    if (options.pictures)
        running.watch = [&](const play::PlayFrame& frame) {
            Stopwatch drawn;
            write_picture(play_picture(prepared.scene, frame, fit), options.output, frame.number);
            drawing += drawn.lap();
        };
    Stopwatch watch;
    report.run = play::run_play(prepared.scene, prepared.world, running, progress);
    warn_of_overlap(report, progress);
    report.seconds["steps"] = report.run.seconds;
    report.seconds["measures and files"] = watch.lap() - drawing - report.run.seconds;
    if (options.pictures) {
        const auto pictures = write_contact_sheet(options.output, report.run.frames, kSheet);
        report.run.files.insert(report.run.files.end(), pictures.begin(), pictures.end());
        report.seconds["pictures"] = watch.lap() + drawing;
    }
    note_costs(report);
    write_report(out, report);
    out.keep();
    return report;
}

}  // namespace myotet::app
