// SPDX-License-Identifier: Apache-2.0
#include "LevelSetStage.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "Core/Errors.h"
#include "ExitCodes.h"
#include "LevelSet/FromSurface.h"
#include "LevelSet/Measure.h"
#include "MeshFiles/MeshFiles.h"

namespace myotet::app {
namespace {

using levelset::LabelLevelSets;
using levelset::Region;

TissueSets set_of_surface(const Scan& scan, const LevelSetChoices& choices,
                          ProgressSink& progress) {
    TissueSets made;
    made.tissues = asked_tissues(scan);
    made.sets.spacing = choices.spacing;
    made.sets.smooth = std::max(0.0, choices.smooth);
    Region region;
    region.label = scan.tissues.front().label;
    levelset::HealSummary healing;
    try {
        region.phi = levelset::from_surface(
            *scan.surface,
            {.spacing = choices.spacing, .smooth = made.sets.smooth, .heal = scan.heal}, progress,
            &healing);
    } catch (const InputError& error) {  // which does not know the file
        throw InputError(scan.input.string() + ": " + error.what());
    }
    region.volume_level_set = levelset::enclosed_volume(region.phi);
    region.inscribed_radius = levelset::inscribed_radius(region.phi);
    if (scan.heal) made.healing = healing;
    // What an open surface encloses is known by its healing alone.
    if (healing.open_edges > 0) made.tissues.front().volume = region.volume_level_set;
    region.volume_labels = made.tissues.front().volume;
    made.sets.regions.push_back(std::move(region));
    return made;
}

std::vector<std::int32_t> values_in(const std::vector<Tissue>& tissues, int layer) {
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

/// Calls use(layer, its level sets). Layers are on one grid and so get one
/// frame; the first one's spacing serves all.
template <class Use>
void each_layer(const Scan& scan, const LevelSetChoices& choices, std::vector<Tissue>& tissues,
                ProgressSink& progress, Use&& use) {
    levelset::LabelOptions options{
        .spacing = choices.spacing, .smoothing = choices.smoothing, .smooth = choices.smooth};
    for (int layer = 0; layer < static_cast<int>(scan.layers.size()); ++layer) {
        const std::vector<std::int32_t> values = values_in(tissues, layer);
        if (values.empty()) continue;
        LabelLevelSets sets = levelset::from_labels(scan.layers[layer], values, options, progress);
        options.spacing = sets.spacing;
        for (Region& region : sets.regions) region.layer = layer;
        note_smoothing(sets, layer, tissues);
        use(layer, std::move(sets));
    }
}

TissueSets sets_of_labels(const Scan& scan, const LevelSetChoices& choices,
                          ProgressSink& progress) {
    TissueSets made;
    made.tissues = asked_tissues(scan);
    each_layer(scan, choices, made.tissues, progress, [&](int, LabelLevelSets&& sets) {
        std::vector<Region>& before = made.sets.regions;
        sets.regions.insert(sets.regions.begin(), std::make_move_iterator(before.begin()),
                            std::make_move_iterator(before.end()));
        made.sets = std::move(sets);
    });
    return made;
}

/// The scan's tissue as a recipe left it.
Tissue repaired_tissue(const repair::Tissue& now, const std::vector<Tissue>& before) {
    Tissue tissue{.layer = now.layer, .label = now.label, .name = now.name};
    const auto it = std::ranges::find_if(before, [&](const Tissue& t) {
        return !now.made && t.layer == now.layer && t.label == now.label;
    });
    if (it != before.end()) tissue = *it;
    if (!now.changed) return tissue;
    tissue.volume = 0;
    for (const Region& region : now.regions) tissue.volume += region.volume_level_set;
    return tissue;
}

TissueSets repaired_sets(const Scan& scan, const LevelSetChoices& choices, ProgressSink& progress) {
    const repair::Recipe recipe = repair::read_recipe(choices.repair);
    std::vector<Tissue> all = scan.tissues;
    TissueSets made;
    repair::Scene scene;
    scene.read_surface = [](const std::filesystem::path& file) {
        return meshfiles::read_surface(file);
    };
    each_layer(scan, choices, all, progress, [&](int layer, LabelLevelSets&& sets) {
        made.sets.frame = sets.frame;
        made.sets.spacing = sets.spacing;
        made.sets.smooth = sets.smooth;
        repair::add_layer(scene, std::move(sets), scan.layers[layer]);
    });
    made.repair = repair::apply(recipe, scene, progress).steps;

    for (const repair::Tissue& now : scene.tissues) {
        const Tissue tissue = repaired_tissue(now, all);
        if (tissue.asked) made.tissues.push_back(tissue);
    }
    std::ranges::sort(made.tissues, {},
                      [](const Tissue& t) { return std::pair(t.layer, t.label); });
    const double voxel = scan.layers.front().voxel_volume();
    for (Region& region : repair::take_regions(scene)) {
        if (std::ranges::none_of(made.tissues, [&](const Tissue& t) { return belongs(region, t); }))
            continue;
        // What a recipe made has no voxels; the mesher judges sizes by them.
        if (region.voxels == 0)
            region.voxels =
                std::max<std::int64_t>(1, std::llround(region.volume_level_set / voxel));
        made.sets.regions.push_back(std::move(region));
    }
    return made;
}

}  // namespace

TissueSets make_level_sets(const Scan& scan, const LevelSetChoices& choices,
                           ProgressSink& progress) {
    if (scan.surface && !choices.repair.empty())
        throw UsageError("--repair: " + scan.input.string() +
                         " is a surface; a recipe works on the tissues of a label file");
    if (scan.surface && choices.smoothing != levelset::Smoothing::curvature)
        throw UsageError("--smoothing: " + scan.input.string() +
                         " is a surface, which has no voxels to hold; --smooth alone smooths it");
    if (scan.surface) return set_of_surface(scan, choices, progress);
    return choices.repair.empty() ? sets_of_labels(scan, choices, progress)
                                  : repaired_sets(scan, choices, progress);
}

}  // namespace myotet::app
