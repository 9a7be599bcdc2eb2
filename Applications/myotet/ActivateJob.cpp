// SPDX-License-Identifier: Apache-2.0
#include "ActivateJob.h"

#include <algorithm>
#include <cmath>

#include "ActivateInput.h"
#include "Core/AtomicFile.h"
#include "Core/Parallel.h"
#include "Core/Sha256.h"
#include "Core/Stopwatch.h"
#include "Core/Text.h"
#include "Costs.h"
#include "Outputs.h"
#include "Report/Chart.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

using activation::MuscleMotion;
using activation::Sharing;
using activation::Status;
using skeleton::Model;
using skeleton::Table;

// N mm or N: what rounding leaves of a reserve.
constexpr double kNoReserve = 1e-6;

Table muscles_table(const std::string& title, const Model& model, const MuscleMotion& motion) {
    Table table{.title = title, .times = motion.times};
    for (const skeleton::Muscle& muscle : model.muscles) table.columns.push_back(muscle.name);
    return table;
}

// As OpenSim names them: NAME_moment, of a length NAME_force.
Table coordinates_table(const std::string& title, const Model& model, const MuscleMotion& motion) {
    Table table{.title = title, .times = motion.times};
    for (const skeleton::Coordinate& c : model.coordinates)
        table.columns.push_back(c.name + (c.rotational ? "_moment" : "_force"));
    return table;
}

// A column for a muscle and each coordinate that it ever moves.
Table arms_table(const Model& model, const MuscleMotion& motion) {
    constexpr double kNoArm = 1e-9;  // mm: what rounding leaves
    Table table{.title = "moment arms", .times = motion.times, .rows = {}};
    std::vector<std::pair<Eigen::Index, Eigen::Index>> entries;
    for (Eigen::Index m = 0; m < static_cast<Eigen::Index>(model.muscles.size()); ++m)
        for (Eigen::Index c = 0; c < static_cast<Eigen::Index>(model.coordinates.size()); ++c) {
            const bool moves = std::ranges::any_of(
                motion.arms, [&](const auto& arms) { return std::abs(arms(c, m)) > kNoArm; });
            if (!moves) continue;
            entries.emplace_back(c, m);
            table.columns.push_back(model.muscles[m].name + "/" + model.coordinates[c].name);
        }
    for (const Eigen::MatrixXd& arms : motion.arms) {
        std::vector<double> row;
        for (const auto& [c, m] : entries) row.push_back(arms(c, m));
        table.rows.push_back(std::move(row));
    }
    return table;
}

class Results {
public:
    Results(const ActivateJobOptions& options, ActivateReport& report)
        : out_(options.output), report_(report) {}
    void write(const Table& table, const std::string& units, const std::string& name) {
        out_.write(name, [&](const fs::path& file) { skeleton::write_table(table, units, file); });
        report_.files.push_back(name);
    }
    void draw(const report::Chart& chart) {
        out_.write("activation.png", [&](const fs::path& file) {
            report::write_png(report::draw_chart(chart, {.panel_width = 720}), file);
        });
        report_.files.emplace_back("activation.png");
    }
    void finish() {
        report_.files.emplace_back("report.json");
        out_.write("report.json",
                   [&](const fs::path& file) { write_atomically(file, to_json(report_)); });
        out_.keep();
    }

private:
    OutputFolder out_;
    ActivateReport& report_;
};

void write_motion(const Model& model, const MuscleMotion& motion, Results& results) {
    Table lengths = muscles_table("lengths of muscles with their tendons", model, motion);
    lengths.rows = motion.lengths;
    results.write(lengths, "mm", "path_length.sto");
    Table torques = coordinates_table("inverse dynamics", model, motion);
    torques.rows = motion.torques;
    results.write(torques, "moments in N mm, forces in N", "moments.sto");
    results.write(arms_table(model, motion), "mm", "moment_arms.sto");
}

void write_curves(const Model& model, const MuscleMotion& motion,
                  const activation::SharedCurves& curves, Results& results) {
    Table activations = muscles_table("activation curves", model, motion);
    Table forces = muscles_table("forces of activation curves", model, motion);
    Table left = coordinates_table("torques that activation curves leave", model, motion);
    activations.rows = curves.activations;
    forces.rows = curves.forces;
    left.rows = curves.left;
    results.write(activations, "from 0 to 1", "activation.sto");
    results.write(forces, "N", "force.sto");
    results.write(left, "moments in N mm, forces in N", "moments_left.sto");
}

void write_sharing(const Model& model, const MuscleMotion& motion, const Sharing& sharing,
                   Results& results) {
    Table activations = muscles_table("muscle force distribution: activations", model, motion);
    Table forces = muscles_table("muscle force distribution: forces", model, motion);
    Table reserves = coordinates_table("muscle force distribution: reserves", model, motion);
    bool any = false;
    for (const activation::Distribution& one : sharing.at) {
        activations.rows.push_back(one.activations);
        forces.rows.push_back(one.forces);
        reserves.rows.push_back(one.reserves);
        for (std::size_t c = 0; c < one.reserves.size(); ++c)
            any = any || (!sharing.held[c] && std::abs(one.reserves[c]) > kNoReserve);
    }
    results.write(activations, "from 0 to 1", "activation.sto");
    results.write(forces, "N", "force.sto");
    if (!sharing.at.front().amounts.empty()) {
        Table amounts{.title = "amounts of synergies", .times = motion.times};
        for (std::size_t s = 0; s < sharing.at.front().amounts.size(); ++s)
            amounts.columns.push_back("synergy_" + std::to_string(s + 1));
        for (const activation::Distribution& one : sharing.at) amounts.rows.push_back(one.amounts);
        results.write(amounts, "from 0", "synergies.sto");
    }
    if (any) results.write(reserves, "moments in N mm, forces in N", "reserves.sto");
}

// What the report and the picture tell is of the curves, then.
void put_curves(const activation::SharedCurves& curves, Sharing& sharing) {
    sharing.status = curves.fit.status;
    sharing.message = curves.fit.message;
    for (std::size_t t = 0; t < sharing.at.size(); ++t) {
        sharing.at[t].activations = curves.activations[t];
        sharing.at[t].forces = curves.forces[t];
        sharing.at[t].missing = curves.left[t];
        sharing.at[t].bounds.assign(curves.activations[t].size(), 0);
    }
}

// A panel each for the activations, the forces and the moments.
report::Chart chart_of(const Model& model, const MuscleMotion& motion, const Sharing& sharing) {
    report::Chart chart{.title = model.name, .x_label = "time, s", .columns = 1};
    report::Panel activations{.title = "activations", .y_label = "activation"};
    report::Panel forces{.title = "forces of muscles", .y_label = "N"};
    report::Panel moments{.title = "moments of joints, without those that are held",
                          .y_label = "N m"};
    for (std::size_t m = 0; m < model.muscles.size(); ++m) {
        report::Line activation{.name = model.muscles[m].name, .x = motion.times};
        report::Line force = activation;
        for (const activation::Distribution& one : sharing.at) {
            activation.y.push_back(one.activations[m]);
            force.y.push_back(one.forces[m]);
        }
        activations.lines.push_back(std::move(activation));
        forces.lines.push_back(std::move(force));
    }
    for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
        if (sharing.held[c] || !model.coordinates[c].rotational) continue;
        report::Line moment{.name = model.coordinates[c].name, .x = motion.times};
        for (const auto& torques : motion.torques) moment.y.push_back(torques[c] / 1000);
        moments.lines.push_back(std::move(moment));
    }
    chart.panels = {std::move(activations), std::move(forces)};
    if (!moments.lines.empty()) chart.panels.push_back(std::move(moments));
    return chart;
}

void tell_muscles(const Model& model, const Sharing& sharing, ActivateReport& report) {
    for (std::size_t m = 0; m < model.muscles.size(); ++m) {
        ActivateMuscle told{model.muscles[m].name};
        for (const activation::Distribution& one : sharing.at) {
            told.highest_activation = std::max(told.highest_activation, one.activations[m]);
            told.highest_force = std::max(told.highest_force, one.forces[m]);
            told.at_bounds += one.bounds[m] != 0;
        }
        report.muscles.push_back(told);
    }
}

void tell_coordinates(const ActivateInput& input, const MuscleMotion& motion,
                      const Sharing& sharing, ActivateReport& report) {
    for (std::size_t c = 0; c < input.model.coordinates.size(); ++c) {
        const skeleton::Coordinate& coordinate = input.model.coordinates[c];
        ActivateCoordinate told{
            .name = coordinate.name, .rotational = coordinate.rotational, .held = sharing.held[c]};
        double squares = 0;
        for (std::size_t t = 0; t < sharing.at.size(); ++t) {
            const activation::Distribution& one = sharing.at[t];
            told.largest_torque = std::max(told.largest_torque, std::abs(motion.torques[t][c]));
            told.largest_reserve = std::max(told.largest_reserve, std::abs(one.reserves[c]));
            squares += one.reserves[c] * one.reserves[c];
            told.missing = std::max(told.missing, std::abs(one.missing[c]));
        }
        told.reserve_rms = std::sqrt(squares / static_cast<double>(sharing.at.size()));
        report.coordinates.push_back(told);
    }
}

void tell_numbers(const Sharing& sharing, ActivateReport& report) {
    report.status = sharing.status;
    report.message = sharing.message;
    for (const activation::Distribution& one : sharing.at) {
        report.iterations += one.iterations;
        report.largest_residual = std::max(report.largest_residual, one.residual);
        report.largest_torque_residual =
            std::max(report.largest_torque_residual, one.torque_residual);
    }
}

ActivateReport begin_report(const ActivateJobOptions& options, const ActivateInput& input) {
    using activation::Tendons;
    ActivateReport report;
    report.model = options.model.string();
    report.motion = options.motion.string();
    report.output = options.output.string();
    report.model_sha256 = sha256_of_file(options.model);
    report.motion_sha256 = sha256_of_file(options.motion);
    report.times = input.times.size();
    report.begin = input.times.front();
    report.end = input.times.back();
    const bool stress = options.criterion == activation::Criterion::stress;
    report.options = {{"cost", (stress ? "stress^" : "activation^") + rounded(options.exponent)},
                      {"tendon", options.tendons == Tendons::rigid     ? "rigid"
                                 : options.tendons == Tendons::elastic ? "elastic"
                                                                       : "as the model has them"},
                      {"passive", options.passive ? "yes" : "no"},
                      {"static", options.still ? "yes" : "no"},
                      {"cutoff_Hz", rounded(options.cutoff_hz)},
                      {"reserves", options.reserves.empty() ? "none" : list_of(options.reserves)},
                      {"hold", options.held.empty() ? "none" : list_of(options.held)},
                      {"bounds", options.bounds.string()},
                      {"emg", options.emg.string()},
                      {"synergies", options.synergies.string()},
                      {"curves_s", options.curves > 0 ? rounded(options.curves) : "none"}};
    report.warnings = input.warnings;
    report.notes = input.notes;
    return report;
}

}  // namespace

ActivateReport run_activate_job(const ActivateJobOptions& options, ProgressSink& progress) {
    const ThreadLimit limit(options.threads);
    Stopwatch watch;
    const ActivateInput input = read_activate_input(options);
    ActivateReport report = begin_report(options, input);
    Results results(options, report);
    report.seconds["reading"] = watch.lap();

    const MuscleMotion motion = activation::follow_muscles(input.model, input.trajectory,
                                                           input.times, options.still, progress);
    report.warnings.insert(report.warnings.end(), motion.notes.begin(), motion.notes.end());
    report.seconds["inverse dynamics"] = watch.lap();
    Sharing sharing = activation::share(input.model, motion, input.sharing, progress);
    report.notes.insert(report.notes.end(), sharing.notes.begin(), sharing.notes.end());
    for (const std::string& warning : report.warnings) progress.warn(warning);
    report.seconds["distribution"] = watch.lap();

    std::optional<activation::SharedCurves> curves;
    if (options.curves > 0 && sharing.status == Status::converged) {
        curves = activation::share_by_curves(input.model, motion, input.sharing, sharing,
                                             options.curves);
        put_curves(*curves, sharing);
        report.curves = curves->fit;
        report.seconds["curves"] = watch.lap();
    }
    tell_muscles(input.model, sharing, report);
    tell_coordinates(input, motion, sharing, report);
    tell_numbers(sharing, report);
    write_motion(input.model, motion, results);
    if (sharing.status == Status::converged) {
        if (curves)
            write_curves(input.model, motion, *curves, results);
        else
            write_sharing(input.model, motion, sharing, results);
        if (options.pictures) results.draw(chart_of(input.model, motion, sharing));
    }
    report.seconds["writing"] = watch.lap();
    note_costs(report);
    results.finish();
    return report;
}

}  // namespace myotet::app
