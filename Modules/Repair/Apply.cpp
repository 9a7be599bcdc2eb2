// SPDX-License-Identifier: Apache-2.0
#include "Repair/Apply.h"

#include "Core/Text.h"
#include "Repair/Steps.h"

namespace myotet::repair {

std::string to_sentence(const StepReport& report) {
    const std::string volumes =
        formatted(" gained %.4g mm^3 and lost %.4g mm^3", report.added, report.removed);
    return "step " + std::to_string(report.number) + ", " + report.what + ": " + report.tissue +
           volumes + (report.note.empty() ? "" : "; " + report.note);
}

Summary apply(const Recipe& recipe, Scene& scene, ProgressSink& progress) {
    check_names(recipe, scene);
    Workshop shop(recipe, scene, progress);
    const double count = static_cast<double>(recipe.steps.size());
    for (const Step& step : recipe.steps) {
        progress.report("repair", (step.number - 1) / count);
        shop.begin(step);
        std::visit([&](const auto& task) { run(task, shop); }, step.task);
        shop.end();
    }
    shop.finish();
    progress.report("repair", 1);
    return {std::move(shop.log)};
}

}  // namespace myotet::repair
