// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "ContractJob.h"

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

// Of a column of the history: where it begins and ends, and how far it goes.
Json column_json(const contraction::History& history, std::size_t c) {
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const auto& row : history.rows) {
        least = std::min(least, row[c]);
        most = std::max(most, row[c]);
    }
    return {{"unit", history.columns[c].unit},
            {"first", history.rows.front()[c]},
            {"last", history.rows.back()[c]},
            {"least", least},
            {"most", most}};
}

Json options_json(const ContractJobOptions& options) {
    constexpr std::array series{"auto", "pvd", "xdmf"};
    return {{"resume", options.resume},
            {"checkpoint_every", options.checkpoint_every},
            {"series", series[static_cast<std::size_t>(options.series)]},
            {"pictures", options.pictures}};
}

template <class... Values>
std::string line(const char* form, Values... values) {
    char text[256];
    std::snprintf(text, sizeof text, form, values...);
    return text;
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
    json["history"] = Json::object();
    if (!run.history.rows.empty())
        for (std::size_t c = 0; c < run.history.columns.size(); ++c)
            json["history"][run.history.columns[c].name] = column_json(run.history, c);
    json["seconds"] = report.seconds;
    json["processor_seconds"] = report.processor_seconds;
    json["peak_memory_bytes"] = report.peak_memory;
    json["warnings"] = report.warnings;
    json["files"] = Json::array();
    for (const auto& file : run.files) json["files"].push_back(file.generic_string());
    return json.dump(2) + "\n";
}

std::string to_table(const ContractReport& report) {
    std::string text;
    if (!report.title.empty()) text += report.title + "\n";
    text += "  body                   nodes      tets   PCSA mm2   sigma_max x PCSA N\n";
    for (const ContractBody& body : report.bodies)
        text += line("  %-20s %7zu  %8zu   %8.1f   %10.1f\n", body.name.c_str(), body.nodes,
                     body.tets, body.architecture.pcsa, body.architecture.force);
    const contraction::History& history = report.run.history;
    if (history.rows.empty()) return text;
    text += "  quantity                                first       last      least       most\n";
    for (std::size_t c = 1; c < history.columns.size(); ++c) {
        const std::string& name = history.columns[c].name;
        const bool part = name.ends_with("_x") || name.ends_with("_y") || name.ends_with("_z");
        if (part) continue;
        const Json column = column_json(history, c);
        text += line("  %-30s %-5s %9.4g  %9.4g  %9.4g  %9.4g\n", name.c_str(),
                     history.columns[c].unit.c_str(), column["first"].get<double>(),
                     column["last"].get<double>(), column["least"].get<double>(),
                     column["most"].get<double>());
    }
    text += line("  %d steps, %d failed, %d iterations of Newton's method\n", report.run.steps,
                 report.run.failed_steps, report.run.iterations);
    return text;
}

}  // namespace myotet::app
