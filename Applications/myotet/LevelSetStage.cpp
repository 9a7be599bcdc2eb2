// SPDX-License-Identifier: Apache-2.0
#include "LevelSetStage.h"

#include <algorithm>
#include <iterator>

#include "Core/Errors.h"
#include "LevelSet/FromSurface.h"

namespace myotet::app {
namespace {

using levelset::LabelLevelSets;
using levelset::Region;

LabelLevelSets sets_of_surface(const Scan& scan, const LevelSetChoices& choices,
                               ProgressSink& progress) {
    LabelLevelSets sets;
    sets.spacing = choices.spacing;
    sets.smooth = std::max(0.0, choices.smooth);
    Region region;
    region.label = scan.tissues.front().label;
    region.volume_labels = scan.tissues.front().volume;
    try {
        region.phi = levelset::from_surface(
            *scan.surface, {.spacing = sets.spacing, .smooth = sets.smooth}, progress);
    } catch (const InputError& error) {  // which does not know the file
        throw InputError(scan.input.string() + ": " + error.what());
    }
    sets.regions.push_back(std::move(region));
    return sets;
}

std::vector<std::int32_t> asked_values(const std::vector<Tissue>& tissues, int layer) {
    std::vector<std::int32_t> values;
    for (const Tissue& tissue : tissues)
        if (tissue.layer == layer) values.push_back(tissue.label);
    return values;
}

void note_smoothing(const LabelLevelSets& sets, int layer, std::vector<Tissue>& tissues) {
    for (const levelset::SmoothingReport& report : sets.smoothing)
        for (Tissue& tissue : tissues)
            if (tissue.layer == layer && tissue.label == report.label) tissue.smoothing = report;
}

/// Layers are on one grid and so get one frame; the first one's spacing serves all.
TissueSets sets_of_labels(const Scan& scan, const LevelSetChoices& choices,
                          ProgressSink& progress) {
    TissueSets made;
    made.tissues = asked_tissues(scan);
    levelset::LabelOptions options{
        .spacing = choices.spacing, .smoothing = choices.smoothing, .smooth = choices.smooth};
    for (int layer = 0; layer < static_cast<int>(scan.layers.size()); ++layer) {
        const std::vector<std::int32_t> values = asked_values(made.tissues, layer);
        if (values.empty()) continue;
        LabelLevelSets sets = levelset::from_labels(scan.layers[layer], values, options, progress);
        options.spacing = sets.spacing;
        for (Region& region : sets.regions) region.layer = layer;
        note_smoothing(sets, layer, made.tissues);
        std::vector<Region>& before = made.sets.regions;
        sets.regions.insert(sets.regions.begin(), std::make_move_iterator(before.begin()),
                            std::make_move_iterator(before.end()));
        made.sets = std::move(sets);
    }
    return made;
}

}  // namespace

TissueSets make_level_sets(const Scan& scan, const LevelSetChoices& choices,
                           ProgressSink& progress) {
    if (!scan.surface) return sets_of_labels(scan, choices, progress);
    return {sets_of_surface(scan, choices, progress), asked_tissues(scan)};
}

}  // namespace myotet::app
