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

/// Layers are on one grid and so get one frame; the first one's spacing serves all.
LabelLevelSets sets_of_labels(const Scan& scan, const LevelSetChoices& choices,
                              ProgressSink& progress) {
    LabelLevelSets all;
    levelset::LabelOptions options{.spacing = choices.spacing, .smooth = choices.smooth};
    for (std::size_t layer = 0; layer < scan.layers.size(); ++layer) {
        std::vector<std::int32_t> values;
        for (const Tissue& tissue : scan.tissues)
            if (tissue.layer == static_cast<int>(layer) && tissue.asked)
                values.push_back(tissue.label);
        if (values.empty()) continue;
        LabelLevelSets sets = levelset::from_labels(scan.layers[layer], values, options, progress);
        options.spacing = sets.spacing;
        for (Region& region : sets.regions) region.layer = static_cast<int>(layer);
        sets.regions.insert(sets.regions.begin(), std::make_move_iterator(all.regions.begin()),
                            std::make_move_iterator(all.regions.end()));
        all = std::move(sets);
    }
    return all;
}

}  // namespace

TissueSets make_level_sets(const Scan& scan, const LevelSetChoices& choices,
                           ProgressSink& progress) {
    TissueSets made;
    made.tissues = asked_tissues(scan);
    made.sets = scan.surface ? sets_of_surface(scan, choices, progress)
                             : sets_of_labels(scan, choices, progress);
    return made;
}

}  // namespace myotet::app
