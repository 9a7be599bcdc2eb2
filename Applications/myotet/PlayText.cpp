// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "Costs.h"
#include "PlayJob.h"
#include "Text.h"

namespace myotet::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMilli = 1e-3;
constexpr double kKilogram = 1e3;  // of a t

Json part_json(const PlayPart& part) {
    Json json = {{"name", part.name},
                 {"kind", part.ball     ? "ball"
                          : part.muscle ? "muscle"
                                        : "soft"},
                 {"mass_kg", kKilogram * part.mass}};
    if (part.ball) return json;
    json["nodes"] = part.nodes;
    json["tets"] = part.tets;
    json["embedded_vertices"] = part.embedded;
    return json;
}

Json energies_json(const play::Energies& e) {
    return {{"kinetic", e.kinetic},
            {"elastic", e.elastic},
            {"weight", e.weight},
            {"contact", e.contact},
            {"total", e.total()}};
}

// Of what took some time, how much there was in a second of it.
double rate(double count, double seconds) { return seconds > 0 ? count / seconds : 0; }

}  // namespace

std::string to_json(const PlayReport& report) {
    const play::PlaySummary& run = report.run;
    Json json = {{"scene", report.scene},
                 {"title", report.title},
                 {"output", report.output},
                 {"frame", "LPS"},
                 {"units", "mm, N, MPa, s, mJ"},
                 {"version", MYOTET_VERSION},
                 {"threads", report.threads},
                 {"end_s", report.end},
                 {"step_s", report.step},
                 {"completed", run.completed},
                 {"interrupted", run.interrupted},
                 {"message", run.message},
                 {"reached_s", run.reached},
                 {"steps", run.steps},
                 {"steps_that_ended_early", run.unsettled_steps},
                 {"newton_iterations", run.iterations},
                 {"linear_iterations", run.linear_iterations},
                 {"steps_per_second", rate(run.steps, run.seconds)},
                 {"steps_per_processor_second", rate(run.steps, run.processor_seconds)},
                 {"times_its_own_clock", rate(run.reached, run.seconds)},
                 {"worst_frame_ms", run.worst_frame / kMilli},
                 {"worst_frame_processor_ms", run.worst_processor / kMilli},
                 {"deepest_penetration_mm", run.deepest},
                 {"smallest_volume_ratio", run.smallest_volume_ratio},
                 {"inverted_tets", run.inverted}};
    json["energy_mJ"] = {{"first", energies_json(run.first)},
                         {"last", energies_json(run.last)},
                         {"greatest_gain_in_a_step", run.greatest_gain}};
    json["contact"] = {{"gap_mm", report.contact.gap},
                       {"stiffness_MPa_per_mm", report.contact.stiffness},
                       {"friction", report.contact.friction}};
    json["bodies"] = Json::array();
    for (const PlayPart& part : report.parts) json["bodies"].push_back(part_json(part));
    add_costs(json, report);
    json["files"] = Json::array();
    for (const auto& file : run.files) json["files"].push_back(file.generic_string());
    return json.dump(2) + "\n";
}

std::string to_table(const PlayReport& report) {
    std::string text;
    if (!report.title.empty()) text += report.title + "\n";
    text += "  body                   nodes      tets   embedded      mass kg\n";
    for (const PlayPart& part : report.parts)
        text += formatted("  %-20s %7zu  %8zu  %9zu   %10.4g\n", part.name.c_str(), part.nodes,
                          part.tets, part.embedded, kKilogram * part.mass);
    text += formatted("  contact: gap %.3g mm, %.3g MPa/mm, friction %.3g\n", report.contact.gap,
                      report.contact.stiffness, report.contact.friction);
    const play::PlaySummary& run = report.run;
    if (run.steps == 0) return text;
    text += formatted(
        "  %d steps of %.4g s, %.0f a second, %.2f times as fast as their own clock\n", run.steps,
        report.step, rate(run.steps, run.seconds), rate(run.reached, run.seconds));
    text +=
        formatted("  %.0f steps a second of the processor; worst frame %.1f ms, %.1f of them its\n",
                  rate(run.steps, run.processor_seconds), run.worst_frame / kMilli,
                  run.worst_processor / kMilli);
    text +=
        formatted("  %.2f iterations a step, %.0f of conjugate gradients; %d steps ended early\n",
                  rate(run.iterations, run.steps), rate(run.linear_iterations, run.steps),
                  run.unsettled_steps);
    text +=
        formatted("  energy %.4g mJ at first, %.4g mJ at last; greatest gain in a step %.3g mJ\n",
                  run.first.total(), run.last.total(), run.greatest_gain);
    text += formatted("  deepest penetration %.3g mm; inverted elements %zu, smallest det F %.3f\n",
                      run.deepest, run.inverted, run.smallest_volume_ratio);
    return text;
}

}  // namespace myotet::app
