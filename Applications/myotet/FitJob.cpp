// SPDX-License-Identifier: Apache-2.0
#include "FitJob.h"

#include "Core/Parallel.h"
#include "Core/Stopwatch.h"
#include "Core/Text.h"
#include "Costs.h"
#include "ExitCodes.h"
#include "Machine.h"
#include "Outputs.h"
#include "SceneShapes.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

using contraction::Scene;
using skeleton::Table;

std::size_t body_of(const Scene& scene, const contraction::Model& model, const std::string& name) {
    std::vector<std::string> muscles;
    std::vector<std::size_t> found;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        if (!(model.bodies[b].greatest_tension > 0)) continue;
        muscles.push_back(scene.bodies[b].name);
        if (name.empty() || name == muscles.back()) found.push_back(b);
    }
    if (found.size() == 1) return found.front();
    if (muscles.empty())
        throw InputError(scene.file.string() + ": has no muscle whose activation could be fitted");
    throw UsageError("--body: " +
                     (name.empty() ? "the scene has several muscles; name one of "
                                   : "'" + name + "' is no muscle of the scene; it has ") +
                     list_of(muscles));
}

contraction::ActivationFit fit(Scene& scene, contraction::Model& model, std::size_t body,
                               const Table& target, const FitJobOptions& options,
                               ProgressSink& progress) {
    try {
        return contraction::fit_activation(scene, model, body, target, options.fitting, progress);
    } catch (const InputError& error) {
        throw InputError(options.target.string() + ": " + error.what());
    }
}

Table activation_table(const FitReport& report) {
    const contraction::ActivationFit& fitted = report.fitted;
    Table table{.title = fitted.fit.status == activation::Status::converged
                             ? "activation fitted to a target"
                             : "activation fitted to a target: best found, not converged",
                .columns = {report.body},
                .times = fitted.activation.times};
    for (const double value : fitted.activation.values) table.rows.push_back({value});
    return table;
}

void write_results(const FitJobOptions& options, FitReport& report) {
    OutputFolder out(options.output);
    if (report.fitted.fit.status != activation::Status::infeasible) {
        report.files = {"activation.sto", "history.csv"};
        out.write("activation.sto", [&](const fs::path& file) {
            skeleton::write_table(activation_table(report), "from 0 to 1", file);
        });
        out.write("history.csv", [&](const fs::path& file) {
            contraction::write_history(report.fitted.history, file);
        });
    }
    report.files.emplace_back("report.json");
    write_report(out, report);
    out.keep();
}

}  // namespace

FitReport run_fit_job(const FitJobOptions& options, ProgressSink& progress) {
    const ThreadLimit limit(options.threads);
    (void)OutputFolder(options.output);  // a folder that cannot be written to is told first
    Stopwatch watch;
    FitReport report{.scene = options.scene.string(),
                     .target = options.target.string(),
                     .output = options.output.string()};
    Scene scene = contraction::read_scene(options.scene);
    const Table target = skeleton::read_table(options.target);
    LoadedShapes loaded = load_shapes(scene, progress);
    progress.check();
    contraction::Model model = contraction::build_model(scene, std::move(loaded.shapes),
                                                        data_folder() / "materials", progress);
    report.fingerprint = model.fingerprint;
    report.warnings = model.warnings;
    report.warnings.insert(report.warnings.end(), loaded.notes.begin(), loaded.notes.end());
    for (const std::string& warning : report.warnings) progress.warn(warning);
    const std::size_t body = body_of(scene, model, options.body);
    report.body = scene.bodies[body].name;
    report.begin = target.times.front();
    report.end = target.times.back();
    report.seconds["preparation"] = watch.lap();
    report.fitted = fit(scene, model, body, target, options, progress);
    report.seconds["fit"] = watch.lap();
    note_costs(report);
    write_results(options, report);
    return report;
}

}  // namespace myotet::app
