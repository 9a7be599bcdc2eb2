// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "Core/Text.h"
#include "Costs.h"
#include "FitJob.h"

namespace myotet::app {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::string to_json(const FitReport& report) {
    const activation::ExpensiveFit& fit = report.fitted.fit;
    Json json = {{"scene", report.scene},
                 {"scene_sha256", report.fingerprint},
                 {"target", report.target},
                 {"output", report.output},
                 {"version", MYOTET_VERSION},
                 {"body", report.body},
                 {"status", activation::to_string(fit.status)},
                 {"message", fit.message},
                 {"evaluations", fit.evaluations},
                 {"failed_evaluations", fit.failures},
                 {"begin_s", report.begin},
                 {"end_s", report.end}};
    json["quantities"] = Json::array();
    for (const contraction::FittedQuantity& quantity : report.fitted.quantities)
        json["quantities"].push_back(
            {{"name", quantity.name}, {"most", quantity.most}, {"misfit_rms", quantity.misfit}});
    json["spline"] = {{"begin_s", report.fitted.basis.begin},
                      {"end_s", report.fitted.basis.end},
                      {"intervals", report.fitted.basis.intervals},
                      {"coefficients", fit.coefficients}};
    json["misfit_after_each_evaluation"] = Json::array();
    for (const double rms : fit.history)
        json["misfit_after_each_evaluation"].push_back(rms == rms ? Json(rms) : Json(nullptr));
    add_costs(json, report);
    json["files"] = report.files;
    return json.dump(2) + "\n";
}

std::string to_table(const FitReport& report) {
    std::string text = "activation of " + report.body + "\n";
    text += "  quantity                              most     misfit (rms)\n";
    for (const contraction::FittedQuantity& quantity : report.fitted.quantities) {
        text += formatted("  %-32s %9.4g %11.4g (%.2g %%)\n", quantity.name.c_str(), quantity.most,
                          quantity.misfit, 100 * quantity.misfit / quantity.most);
    }
    return text + formatted("  %d evaluations, %d of them failed\n", report.fitted.fit.evaluations,
                            report.fitted.fit.failures);
}

}  // namespace myotet::app
