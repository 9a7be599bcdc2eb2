// SPDX-License-Identifier: Apache-2.0
#include "RunFacts.h"

#include "Core/Parallel.h"

namespace myotet::app {
namespace {

std::string name_of(levelset::Smoothing smoothing) {
    using levelset::Smoothing;
    return smoothing == Smoothing::none          ? "none"
           : smoothing == Smoothing::constrained ? "constrained"
                                                 : "curvature";
}

std::string name_of(segmentation::Orientation orientation) {
    using segmentation::Orientation;
    return orientation == Orientation::sform   ? "sform"
           : orientation == Orientation::qform ? "qform"
                                               : "";
}

}  // namespace

RunFacts describe_level_sets(const ScanOptions& options, const LevelSetChoices& choices,
                             const Scan& scan, const TissueSets& sets) {
    RunFacts facts;
    facts.input = options.input.string();
    facts.input_sha256 = scan.sha256;
    for (const Tissue& tissue : sets.tissues) facts.labels.push_back(tissue.label);
    const bool labels = scan.spacing.x() > 0;
    facts.options_text = {{"names_from", scan.names_from.string()},
                          {"orientation", name_of(options.reading.orientation)},
                          {"one_hot", options.reading.one_hot ? "yes" : ""},
                          {"smoothing", labels ? name_of(choices.smoothing) : ""},
                          {"repair", choices.repair.string()},
                          {"input_unit", scan.input_unit}};
    facts.options_number = {{"smooth_mm", sets.sets.smooth},
                            {"level_set_spacing_mm", sets.sets.spacing}};
    facts.gaps = scan.gaps;
    facts.healing = sets.healing;
    facts.repair = sets.repair;
    facts.threads = thread_count();
    facts.warnings = scan.warnings;
    return facts;
}

}  // namespace myotet::app
