// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "ActivateJob.h"
#include "Costs.h"
#include "Text.h"

namespace myotet::app {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::string to_json(const ActivateReport& report) {
    Json json = {{"model", report.model},    {"model_sha256", report.model_sha256},
                 {"motion", report.motion},  {"motion_sha256", report.motion_sha256},
                 {"output", report.output},  {"units", "mm, N, s, rad"},
                 {"version", MYOTET_VERSION}};
    for (const auto& [name, value] : report.options) json["options"][name] = value;
    json["status"] = activation::to_string(report.status);
    json["message"] = report.message;
    json["times"] = report.times;
    json["begin_s"] = report.begin;
    json["end_s"] = report.end;
    json["largest_kkt_residual"] = report.largest_residual;
    json["largest_torque_residual"] = report.largest_torque_residual;
    json["iterations"] = report.iterations;
    if (report.curves)
        json["curves"] = {{"iterations", report.curves->iterations},
                          {"torque_rms_N_mm", report.curves->torque_rms},
                          {"measured_rms", report.curves->measured_rms},
                          {"excitation_outside_0_to_1", report.curves->excitation_out}};
    json["muscles"] = Json::array();
    for (const ActivateMuscle& m : report.muscles)
        json["muscles"].push_back({{"name", m.name},
                                   {"highest_activation", m.highest_activation},
                                   {"highest_force_N", m.highest_force},
                                   {"times_at_a_bound", m.at_bounds}});
    json["coordinates"] = Json::array();
    for (const ActivateCoordinate& c : report.coordinates) {
        const std::string unit = c.rotational ? "_N_mm" : "_N";
        json["coordinates"].push_back({{"name", c.name},
                                       {"left_to_what_holds_it", c.held},
                                       {"largest_torque" + unit, c.largest_torque},
                                       {"largest_reserve" + unit, c.largest_reserve},
                                       {"reserve_rms" + unit, c.reserve_rms},
                                       {"most_missing" + unit, c.missing}});
    }
    add_costs(json, report);
    json["notes"] = report.notes;
    json["files"] = report.files;
    return json.dump(2) + "\n";
}

std::string to_table(const ActivateReport& report) {
    std::string text =
        formatted("%zu times from %.4g to %.4g s\n", report.times, report.begin, report.end);
    text += "  muscle                    most activation   most force N   times at a bound\n";
    for (const ActivateMuscle& m : report.muscles)
        text += formatted("  %-25s %15.4f %14.2f %18d\n", m.name.c_str(), m.highest_activation,
                          m.highest_force, m.at_bounds);
    text += "  coordinate                largest torque    largest reserve   missing\n";
    for (const ActivateCoordinate& c : report.coordinates)
        text += formatted("  %-25s %9.4g %-6s %9.4g %-6s %9.4g%s\n", c.name.c_str(),
                          c.largest_torque, c.rotational ? "N mm" : "N",
                          c.held ? 0.0 : c.largest_reserve, c.rotational ? "N mm" : "N", c.missing,
                          c.held ? "  left to what holds it" : "");
    if (report.curves)
        return text +
               formatted("  curves leave %.3g N mm (rms); excitation leaves 0 to 1 by %.2g\n",
                         report.curves->torque_rms, report.curves->excitation_out);
    text += formatted("  KKT residual %.1e, torque residual %.1e, %d iterations\n",
                      report.largest_residual, report.largest_torque_residual, report.iterations);
    return text;
}

}  // namespace myotet::app
