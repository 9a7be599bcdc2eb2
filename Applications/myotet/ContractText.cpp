// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <nlohmann/json.hpp>

#include "ContractJob.h"
#include "Costs.h"
#include "HistoryText.h"
#include "Text.h"

namespace myotet::app {
namespace {

using Json = nlohmann::ordered_json;

Json body_json(const ContractBody& body) {
    const contraction::Architecture& a = body.architecture;
    Json json = {{"name", body.name}, {"nodes", body.nodes}, {"tets", body.tets}};
    if (a.pcsa > 0) {
        json["muscle_volume_mm3"] = a.volume;
        json["fibre_length_mm"] = a.fibre_length;
        json["pcsa_mm2"] = a.pcsa;
        json["isometric_force_expected_N"] = a.force;
    }
    json["notes"] = body.notes;
    return json;
}

Json options_json(const ContractJobOptions& options) {
    constexpr std::array series{"auto", "pvd", "xdmf"};
    return {{"resume", options.resume},
            {"checkpoint_every", options.checkpoint_every},
            {"series", series[static_cast<std::size_t>(options.series)]},
            {"pictures", options.pictures}};
}

}  // namespace

std::string to_json(const ContractReport& report) {
    const contraction::RunSummary& run = report.run;
    Json json = {{"scene", report.scene},
                 {"title", report.title},
                 {"scene_sha256", report.fingerprint},
                 {"output", report.output},
                 {"frame", "LPS"},
                 {"units", "mm, N, MPa, s"},
                 {"version", MYOTET_VERSION},
                 {"threads", report.threads},
                 {"options", options_json(report.options)},
                 {"end_s", report.end},
                 {"step_s", report.step},
                 {"completed", run.completed},
                 {"interrupted", run.interrupted},
                 {"message", run.message},
                 {"reached_s", run.reached},
                 {"resumed_from_s", run.resumed_from > 0 ? Json(run.resumed_from) : Json(nullptr)},
                 {"steps", run.steps},
                 {"failed_steps", run.failed_steps},
                 {"newton_iterations", run.iterations},
                 {"linear_iterations", run.linear_iterations},
                 {"factorisations", run.factors},
                 {"largest_residual", run.residual}};
    json["bodies"] = Json::array();
    for (const ContractBody& body : report.bodies) json["bodies"].push_back(body_json(body));
    json["history"] = history_json(run.history);
    add_costs(json, report);
    json["files"] = Json::array();
    for (const auto& file : run.files) json["files"].push_back(file.generic_string());
    return json.dump(2) + "\n";
}

std::string to_table(const ContractReport& report) {
    std::string text;
    if (!report.title.empty()) text += report.title + "\n";
    text += "  body                   nodes      tets   PCSA mm2   sigma_max x PCSA N\n";
    for (const ContractBody& body : report.bodies)
        text += formatted("  %-20s %7zu  %8zu   %8.1f   %10.1f\n", body.name.c_str(), body.nodes,
                          body.tets, body.architecture.pcsa, body.architecture.force);
    if (report.run.history.rows.empty()) return text;
    text += history_table(report.run.history);
    text += formatted("  %d steps, %d failed, %d iterations of Newton's method\n", report.run.steps,
                      report.run.failed_steps, report.run.iterations);
    return text;
}

}  // namespace myotet::app
