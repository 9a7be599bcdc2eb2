// SPDX-License-Identifier: Apache-2.0
#include "Repair/Workshop.h"

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"
#include "LevelSet/CsgMeasure.h"
#include "LevelSet/CsgPieces.h"
#include "LevelSet/CsgTable.h"
#include "LevelSet/Measure.h"
#include "Repair/Fields.h"

namespace myotet::repair {

using levelset::Band;

namespace {

Box table_box(const Band& band) {
    Box box;
    box.include(band.origin);
    box.include(band.origin +
                Band::kSide * band.spacing * Vec3(band.blocks[0], band.blocks[1], band.blocks[2]));
    return box;
}

bool meet(const Box& a, const Box& b) {
    return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

Band empty_band(const levelset::CsgLattice& lattice) {
    Band band;
    band.origin = lattice.anchor;
    band.spacing = lattice.spacing;
    band.width = static_cast<float>(levelset::kCsgWidth * lattice.spacing);
    band.blocks = {1, 1, 1};
    band.block_of = {Band::kOutside};
    return band;
}

levelset::CsgLattice lattice_of(const Scene& scene) {
    levelset::CsgLattice lattice{Vec3::Zero(), scene.spacing};
    for (const Tissue& tissue : scene.tissues)
        for (const levelset::Region& region : tissue.regions)
            return {region.phi.origin, scene.spacing};
    return lattice;
}

}  // namespace

void refuse_step(const Recipe& recipe, const Step& step, const std::string& why) {
    throw InputError(recipe.file.string() + ", step " + std::to_string(step.number) + " (line " +
                     std::to_string(step.line) + "): " + why);
}

Workshop::Workshop(const Recipe& recipe, Scene& scene, ProgressSink& progress)
    : recipe_(recipe), scene_(scene), progress_(progress), lattice_(lattice_of(scene)) {
    states_.resize(scene.tissues.size());
    for (std::size_t t = 0; t < states_.size(); ++t)
        for (const levelset::Region& region : scene.tissues[t].regions) {
            const Box box = region.phi.box();
            states_[t].box.include(box.min);
            states_[t].box.include(box.max);
        }
}

void Workshop::begin(const Step& step) {
    step_ = &step;
    progress_.check();
}

void Workshop::end() {
    for (std::size_t t = 0; t < states_.size(); ++t)
        if (!scene_.tissues[t].changed) states_[t].band.reset();
    if (const std::size_t count = done_.size(); count > 1) {
        std::erase_if(done_, [](const StepReport& r) { return r.added == 0 && r.removed == 0; });
        if (done_.empty())
            done_.push_back({step_->number, step_->what, std::to_string(count) + " tissues", 0, 0,
                             "nothing changed"});
    }
    for (StepReport& report : done_) {
        progress_.note(to_sentence(report));
        log.push_back(std::move(report));
    }
    done_.clear();
}

void Workshop::refuse(const std::string& why) const { refuse_step(recipe_, *step_, why); }

int Workshop::find(const std::string& name) const {
    for (std::size_t t = 0; t < states_.size(); ++t)
        if (!states_[t].gone && scene_.tissues[t].name == name) return static_cast<int>(t);
    refuse("'" + name + "' is no tissue of this scan any more");
}

std::vector<int> Workshop::find_all(const std::vector<std::string>& names) const {
    std::vector<int> tissues;
    if (names.size() == 1 && names.front() == "all") {
        for (std::size_t t = 0; t < states_.size(); ++t)
            if (!states_[t].gone) tissues.push_back(static_cast<int>(t));
        return tissues;
    }
    for (const std::string& name : names) tissues.push_back(find(name));
    return tissues;
}

const Band& Workshop::band(int tissue) {
    std::optional<Band>& held = states_[tissue].band;
    if (held) return *held;
    std::vector<Band> parts;
    for (const levelset::Region& region : scene_.tissues[tissue].regions)
        parts.push_back(levelset::to_band(region.phi));
    if (parts.empty()) return held.emplace(empty_band(lattice_));
    if (parts.size() == 1) return held.emplace(std::move(parts.front()));
    std::vector<const Band*> all;
    for (const Band& part : parts) all.push_back(&part);
    const std::size_t count = all.size();
    return held.emplace(
        levelset::merge(std::move(all), levelset::Extent::all,
                        [count](const float* v) { return *std::min_element(v, v + count); }));
}

std::vector<int> Workshop::near(const Box& box, const std::vector<int>& without) const {
    std::vector<int> tissues;
    for (std::size_t t = 0; t < states_.size(); ++t) {
        const int number = static_cast<int>(t);
        if (states_[t].gone || !meet(states_[t].box, box)) continue;
        if (std::find(without.begin(), without.end(), number) == without.end())
            tissues.push_back(number);
    }
    return tissues;
}

std::vector<const Band*> Workshop::bands(const std::vector<int>& tissues) {
    std::vector<const Band*> out;
    for (const int t : tissues) out.push_back(&band(t));
    return out;
}

Band Workshop::yield(int tissue, const Band& form, const std::vector<int>& givers) {
    std::vector<int> without = givers;
    without.push_back(tissue);
    const std::vector<int> others = near(table_box(form), without);
    return others.empty() ? form : levelset::yielding(form, band(tissue), bands(others));
}

void Workshop::replace(int tissue, Band form, const std::vector<int>& givers,
                       const std::string& note) {
    const Band before = band(tissue);
    if (levelset::is_empty(form))
        refuse("nothing would be left of '" + name(tissue) +
               "'; change the step's lengths or leave it out");
    const double added = levelset::volume_beyond(form, before);
    const double removed = levelset::volume_beyond(before, form);
    record(tissue, added, removed, note);
    if (added == 0 && removed == 0) return;
    for (const int giver : givers) {
        if (giver == tissue || !meet(states_[giver].box, table_box(form))) continue;
        // Less what is gained: max(phi, -max(form, -before)).
        Band rest = levelset::settle(
            levelset::merge({&band(giver), &form, &before}, levelset::Extent::first,
                            [](const float* v) { return std::max(v[0], std::min(-v[1], v[2])); }));
        const double taken = levelset::volume_beyond(band(giver), rest);
        if (taken == 0) continue;
        if (levelset::is_empty(rest))
            refuse("'" + name(tissue) + "' would take all of '" + name(giver) +
                   "'; leave it out of takes_from");
        record(giver, 0, taken, "gave way to " + name(tissue));
        states_[giver] = {std::move(rest), states_[giver].box, false};
        scene_.tissues[giver].changed = true;
    }
    states_[tissue].box = table_box(form);
    states_[tissue].band = std::move(form);
    scene_.tissues[tissue].changed = true;
}

int Workshop::add(const NewTissue& tissue) {
    std::int32_t free = 1;
    for (const Tissue& t : scene_.tissues) {
        if (tissue.label != 0 && t.label == tissue.label)
            refuse("label " + std::to_string(tissue.label) + " is '" + t.name +
                   "' already; choose another or leave it out");
        free = std::max(free, t.label + 1);
    }
    scene_.tissues.push_back({.label = tissue.label != 0 ? tissue.label : free,
                              .name = tissue.name,
                              .changed = true,
                              .made = true});
    states_.emplace_back();
    return static_cast<int>(states_.size()) - 1;
}

void Workshop::absorb(int tissue) {
    record(tissue, 0, levelset::enclosed_volume(band(tissue)), "is part of another tissue now");
    states_[tissue] = {};
    states_[tissue].gone = true;
}

void Workshop::record(int tissue, double added, double removed, const std::string& note) {
    done_.push_back({step_->number, step_->what, name(tissue), added, removed, note});
}

void Workshop::settle_into(Tissue& tissue, const Band& whole) {
    double voxel = 0;  // mm^3, of the scan
    for (const levelset::Region& region : tissue.regions)
        if (region.voxels > 0) voxel = region.volume_labels / static_cast<double>(region.voxels);
    const Band framed = levelset::settle(whole);
    const levelset::Pieces pieces = levelset::find_pieces(framed, levelset::Side::inside);
    tissue.regions.clear();
    for (std::size_t p = 0; p < pieces.volume.size(); ++p) {
        std::vector<char> others(pieces.volume.size(), 1);
        others[p] = 0;
        levelset::Region region;
        region.layer = tissue.layer;
        region.label = tissue.label;
        region.component = static_cast<int>(p);
        region.phi = levelset::assemble(
            pieces.volume.size() == 1 ? framed : levelset::flip_pieces(framed, pieces, others));
        region.volume_level_set = levelset::enclosed_volume(region.phi);
        region.volume_labels = region.volume_level_set;
        if (voxel > 0)
            region.voxels =
                std::max<std::int64_t>(std::llround(region.volume_level_set / voxel), 1);
        region.inscribed_radius = levelset::inscribed_radius(region.phi);
        tissue.regions.push_back(std::move(region));
    }
}

void Workshop::finish() {
    progress_.report("repair: level sets", 0);
    for (std::size_t t = 0; t < states_.size(); ++t) {
        progress_.check();
        if (scene_.tissues[t].changed && !states_[t].gone)
            settle_into(scene_.tissues[t], *states_[t].band);
        states_[t].band.reset();
        progress_.report("repair: level sets", double(t + 1) / double(states_.size()));
    }
    std::vector<Tissue> left;
    for (std::size_t t = 0; t < states_.size(); ++t)
        if (!states_[t].gone) left.push_back(std::move(scene_.tissues[t]));
    scene_.tissues = std::move(left);
}

}  // namespace myotet::repair
