// SPDX-License-Identifier: Apache-2.0
#include "ContractJob.h"

#include "Core/Parallel.h"
#include "Core/Stopwatch.h"
#include "Costs.h"
#include "Machine.h"
#include "Outputs.h"
#include "Pictures.h"
#include "SceneShapes.h"

namespace myotet::app {
namespace {

// A scene with all that it names.
struct Prepared {
    contraction::Scene scene;
    contraction::Model model;
    std::vector<TriMesh> bones;
};

Prepared prepare(const ContractJobOptions& options, ContractReport& report,
                 ProgressSink& progress) {
    Stopwatch watch;
    Prepared made;
    made.scene = contraction::read_scene(options.scene);
    LoadedShapes loaded = load_shapes(made.scene, progress);
    progress.check();
    report.seconds["shapes"] = watch.lap();
    made.bones = loaded.shapes.bone_surfaces;
    made.model = contraction::build_model(made.scene, std::move(loaded.shapes),
                                          data_folder() / "materials", progress);
    report.seconds["preparation"] = watch.lap();

    report.scene = options.scene.string();
    report.title = made.scene.title;
    report.output = options.output.string();
    report.options = options;
    report.fingerprint = made.model.fingerprint;
    report.end = made.scene.time.end;
    report.step = made.scene.time.step;
    report.threads = thread_count();
    report.warnings = made.model.warnings;
    report.warnings.insert(report.warnings.end(), loaded.notes.begin(), loaded.notes.end());
    for (const std::string& warning : report.warnings) progress.warn(warning);
    const auto architecture = contraction::architecture(made.scene, made.model);
    for (std::size_t b = 0; b < made.model.bodies.size(); ++b) {
        const contraction::BodyModel& body = made.model.bodies[b];
        report.bodies.push_back({made.scene.bodies[b].name, body.nodes, body.mesh.mesh.tets.size(),
                                 architecture[b], body.notes});
    }
    return made;
}

}  // namespace

ContractReport check_scene(const ContractJobOptions& options, ProgressSink& progress) {
    const ThreadLimit limit(options.threads);
    ContractReport report;
    (void)prepare(options, report, progress);
    note_costs(report);
    return report;
}

ContractReport run_contract_job(const ContractJobOptions& options, ProgressSink& progress) {
    const ThreadLimit limit(options.threads);
    ContractReport report;
    OutputFolder out(options.output);
    Prepared prepared = prepare(options, report, progress);
    contraction::RunOptions running{.folder = options.output,
                                    .resume = options.resume,
                                    .checkpoint_every = options.checkpoint_every,
                                    .series = options.series};
    double drawing = 0;
    if (options.pictures && !options.resume)
        contraction::remove_numbered(options.output / "pictures", ".png");
    const Box fit = box_of_run(prepared.scene, prepared.model, prepared.bones);
    if (options.pictures)
        running.watch = [&](const contraction::Moment& frame, std::span<const TriMesh> bones,
                            std::size_t number) {
            Stopwatch drawn;
            write_picture(frame_picture(frame, bones, fit), options.output, number);
            drawing += drawn.lap();
        };
    Stopwatch watch;
    report.run =
        contraction::run_scene(prepared.scene, prepared.model, prepared.bones, running, progress);
    report.seconds["contraction"] = watch.lap() - drawing;
    if (options.pictures) {
        const auto pictures = write_contact_sheet(options.output, report.run.frames);
        report.run.files.insert(report.run.files.end(), pictures.begin(), pictures.end());
        report.seconds["pictures"] = watch.lap() + drawing;
    }
    note_costs(report);
    write_report(out, report);
    out.keep();
    return report;
}

}  // namespace myotet::app
