// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/Inspect.h"

#include <algorithm>
#include <map>

#include "Segmentation/InspectRuns.h"
#include "Segmentation/InspectThickness.h"

namespace myotet::segmentation {
namespace {

constexpr double kStaircase = 2.0 / 3.0;  // Cauchy: a surface's area over its voxel faces'

using Components = std::vector<std::int32_t>;  // numbers of components

/// Components of every value, by value.
std::map<std::int32_t, Components> group_by_value(const RunMap& map) {
    std::map<std::int32_t, Components> groups;
    for (std::size_t c = 0; c < map.components.size(); ++c)
        groups[map.components[c].value].push_back(static_cast<std::int32_t>(c));
    return groups;
}

bool reaches_border(const RunComponent& c, const Index3& size) {
    for (int a = 0; a < 3; ++a)
        if (c.min[a] == 0 || c.max[a] == size[a] - 1) return true;
    return false;
}

bool strictly_inside(const RunComponent& c, const RunComponent& box) {
    for (int a = 0; a < 3; ++a)
        if (!(c.min[a] > box.min[a] && c.max[a] < box.max[a])) return false;
    return true;
}

/// Which components touch which.
class Neighbours {
public:
    explicit Neighbours(const RunMap& map) : start_(map.components.size() + 1, 0) {
        for (const RunContact& c : map.contacts) ++start_[c.a + 1], ++start_[c.b + 1];
        for (std::size_t n = 1; n < start_.size(); ++n) start_[n] += start_[n - 1];
        list_.resize(start_.back());
        std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
        for (const RunContact& c : map.contacts) list_[next[c.a]++] = c.b, list_[next[c.b]++] = c.a;
    }
    [[nodiscard]] std::span<const std::int32_t> of(std::int32_t c) const {
        return {list_.data() + start_[c], start_[c + 1] - start_[c]};
    }

private:
    std::vector<std::size_t> start_;
    Components list_;
};

/// Finds what labels enclose. Whatever leaves the box around a label is not
/// enclosed by it, so that only components strictly inside that box are walked.
class Enclosure {
public:
    explicit Enclosure(const RunMap& map)
        : map_(map), neighbours_(map), seen_by_(map.components.size(), -1) {}

    [[nodiscard]] Cavities of(const Components& pieces) {
        RunComponent box = map_.components[pieces.front()];
        for (const std::int32_t p : pieces)
            for (int a = 0; a < 3; ++a) {
                box.min[a] = std::min(box.min[a], map_.components[p].min[a]);
                box.max[a] = std::max(box.max[a], map_.components[p].max[a]);
            }
        ++round_;
        Cavities cavities;
        for (const std::int32_t p : pieces)
            for (const std::int32_t c : neighbours_.of(p))
                if (seen_by_[c] != round_ && strictly_inside(map_.components[c], box))
                    walk(c, box, cavities);
        return cavities;
    }

private:
    /// Walks from component to component around the label's own; adds a cavity
    /// when that does not lead out of the box.
    void walk(std::int32_t start, const RunComponent& box, Cavities& cavities) {
        Components found{start};
        seen_by_[start] = round_;
        bool open = false, labelled = false;
        std::int64_t voxels = 0;
        for (std::size_t n = 0; n < found.size(); ++n) {
            const RunComponent& here = map_.components[found[n]];
            voxels += here.voxels;
            labelled |= here.value != 0;
            for (const std::int32_t c : neighbours_.of(found[n])) {
                if (seen_by_[c] == round_ || map_.components[c].value == box.value) continue;
                if (!strictly_inside(map_.components[c], box)) {
                    open = true;
                    continue;
                }
                seen_by_[c] = round_;
                found.push_back(c);
            }
        }
        if (open) return;
        ++cavities.count;
        cavities.voxels += voxels;
        cavities.unlabelled_count += !labelled;
        cavities.unlabelled_voxels += labelled ? 0 : voxels;
    }

    const RunMap& map_;
    const Neighbours neighbours_;
    std::vector<std::int32_t> seen_by_;  ///< per component: the round that saw it last
    std::int32_t round_ = -1;
};

double area_of(const std::array<std::int64_t, 3>& faces, const Vec3& spacing) {
    double area = 0;
    for (int a = 0; a < 3; ++a)
        area += static_cast<double>(faces[a]) * spacing[(a + 1) % 3] * spacing[(a + 2) % 3];
    return kStaircase * area;
}

/// By the two values, both ways.
std::map<std::int32_t, std::vector<Contact>> find_contacts(const RunMap& map, const Vec3& spacing) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::array<std::int64_t, 3>> faces_of;
    for (const RunContact& c : map.contacts) {
        const std::int32_t a = map.components[c.a].value, b = map.components[c.b].value;
        for (int axis = 0; axis < 3; ++axis) {
            faces_of[{a, b}][axis] += c.faces[axis];
            faces_of[{b, a}][axis] += c.faces[axis];
        }
    }
    std::map<std::int32_t, std::vector<Contact>> contacts;
    for (const auto& [values, faces] : faces_of)
        contacts[values.first].push_back(
            {values.second, faces[0] + faces[1] + faces[2], area_of(faces, spacing)});
    return contacts;
}

/// Voxels of each label in the outermost layers.
std::map<std::int32_t, std::array<std::int64_t, 6>> count_cut(const RunMap& map) {
    std::map<std::int32_t, std::array<std::int64_t, 6>> cut;
    for (int k = 0; k < map.size[2]; ++k)
        for (int j = 0; j < map.size[1]; ++j)
            for (std::int32_t r = map.row_start[map.row(j, k)];
                 r < map.row_start[map.row(j, k) + 1]; ++r) {
                const Run& run = map.runs[r];
                const std::int32_t value = map.components[run.component].value;
                const std::int64_t voxels = run.last - run.first + 1;
                const std::array<std::int64_t, 6> here{
                    run.first == 0,      run.last == map.size[0] - 1,
                    j == 0 ? voxels : 0, j == map.size[1] - 1 ? voxels : 0,
                    k == 0 ? voxels : 0, k == map.size[2] - 1 ? voxels : 0};
                if (value == 0 || here == std::array<std::int64_t, 6>{}) continue;
                for (int side = 0; side < 6; ++side) cut[value][side] += here[side];
            }
    return cut;
}

std::vector<Piece> describe_pieces(const Components& components, const RunMap& map,
                                   const LabelVolume& volume, std::span<const float> radius_of) {
    std::vector<Piece> pieces;
    for (const std::int32_t c : components) {
        const RunComponent& piece = map.components[c];
        const Vec3 low(piece.min[0], piece.min[1], piece.min[2]);
        const Vec3 high(piece.max[0], piece.max[1], piece.max[2]);
        pieces.push_back({piece.voxels, radius_of[c], volume.index_to_lps * (0.5 * (low + high))});
    }
    std::ranges::stable_sort(pieces, std::ranges::greater{}, &Piece::voxels);
    return pieces;
}

void set_radii(std::vector<float>& radii, LabelInspection& label) {
    if (radii.empty()) return;
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::ranges::nth_element(radii, middle);
    label.median_radius = *middle;
    label.smallest_radius = std::ranges::min(radii);
}

/// Radii along the middle of each label, and each component's largest.
struct Radii {
    std::map<std::int32_t, std::vector<float>> of_label;
    std::vector<float> largest;
};

Radii sort_radii(const Thickness& thickness, const RunMap& map) {
    Radii radii;
    radii.largest.assign(map.components.size(), 0);
    for (const MedialVoxel& m : thickness.medial) {
        radii.of_label[map.components[m.component].value].push_back(m.radius);
        radii.largest[m.component] = std::max(radii.largest[m.component], m.radius);
    }
    return radii;
}

}  // namespace

Inspection inspect(const LabelVolume& volume) {
    const RunMap map = map_runs(volume);
    const Thickness thickness = measure_thickness(volume, map);
    Radii radii = sort_radii(thickness, map);
    auto contacts = find_contacts(map, volume.spacing());
    auto cut = count_cut(map);
    Enclosure enclosure(map);

    Inspection result;
    for (const auto& [value, components] : group_by_value(map)) {
        if (value == 0) {
            for (const std::int32_t c : components)
                if (!reaches_border(map.components[c], map.size)) {
                    ++result.pockets;
                    result.pocket_voxels += map.components[c].voxels;
                }
            continue;
        }
        LabelInspection label;
        label.value = value;
        for (const std::int32_t c : components) {
            label.voxels += map.components[c].voxels;
            label.one_voxel_thick += thickness.one_voxel_thick[c];
        }
        label.volume = static_cast<double>(label.voxels) * volume.voxel_volume();
        label.pieces = describe_pieces(components, map, volume, radii.largest);
        label.cavities = enclosure.of(components);
        label.contacts = std::move(contacts[value]);
        label.cut = cut[value];
        set_radii(radii.of_label[value], label);
        result.labels.push_back(std::move(label));
    }
    return result;
}

std::vector<Overlap> find_overlaps(std::span<const LabelVolume> layers) {
    // Key: both layers, then both values, as the result is sorted.
    std::map<std::array<std::int64_t, 4>, std::int64_t> voxels;
    std::vector<std::size_t> claims;
    const std::size_t count = layers.size() > 1 ? layers.front().values.size() : 0;
    for (std::size_t n = 0; n < count; ++n) {
        claims.clear();
        for (std::size_t layer = 0; layer < layers.size(); ++layer)
            if (layers[layer].values[n] != 0) claims.push_back(layer);
        for (std::size_t b = 1; b < claims.size(); ++b)
            for (std::size_t a = 0; a < b; ++a)
                ++voxels[{static_cast<std::int64_t>(claims[a]),
                          static_cast<std::int64_t>(claims[b]), layers[claims[a]].values[n],
                          layers[claims[b]].values[n]}];
    }
    std::vector<Overlap> overlaps;
    for (const auto& [key, number] : voxels)
        overlaps.push_back({static_cast<std::size_t>(key[0]), static_cast<std::size_t>(key[1]),
                            static_cast<std::int32_t>(key[2]), static_cast<std::int32_t>(key[3]),
                            number});
    return overlaps;
}

}  // namespace myotet::segmentation
