// SPDX-License-Identifier: Apache-2.0
#include "Repair/Scene.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "Core/Errors.h"

namespace myotet::repair {
namespace {

bool same_lattice(const Scene& scene, const levelset::LabelLevelSets& sets) {
    constexpr double kSame = 1e-6;  // mm
    return (scene.frame.rotation - sets.frame.rotation).norm() < kSame &&
           (scene.frame.origin - sets.frame.origin).norm() < kSame &&
           std::abs(scene.spacing - sets.spacing) < kSame;
}

}  // namespace

std::vector<Plane> field_of_view(const LabelVolume& volume) {
    // Rows of the inverse are the normals of the planes of voxels.
    const Eigen::Affine3d to_index = volume.index_to_lps.inverse();
    std::vector<Plane> planes;
    for (int a = 0; a < 3; ++a) {
        const Vec3 row = to_index.linear().row(a).transpose();
        const double length = row.norm();
        const double low = -0.5 - to_index.translation()[a];
        const double high = volume.size[a] - 0.5 - to_index.translation()[a];
        planes.push_back({-row / length, -low / length});
        planes.push_back({row / length, high / length});
    }
    return planes;
}

void add_layer(Scene& scene, levelset::LabelLevelSets&& sets, const LabelVolume& volume) {
    if (scene.tissues.empty() && scene.field_of_view.empty()) {
        scene.frame = sets.frame;
        scene.spacing = sets.spacing;
        scene.field_of_view = field_of_view(volume);
    } else if (!same_lattice(scene, sets)) {
        throw InputError(
            "the layers of the scan lie on different lattices, which no repair can join; give all "
            "of them one spacing");
    }
    for (levelset::Region& region : sets.regions) {
        const bool first = scene.tissues.empty() || scene.tissues.back().label != region.label ||
                           scene.tissues.back().layer != region.layer;
        if (first)
            scene.tissues.push_back({.label = region.label,
                                     .layer = region.layer,
                                     .name = volume.name_of(region.label)});
        scene.tissues.back().regions.push_back(std::move(region));
    }
    sets.regions.clear();
}

std::vector<levelset::Region> take_regions(Scene& scene) {
    std::stable_sort(scene.tissues.begin(), scene.tissues.end(),
                     [](const Tissue& a, const Tissue& b) {
                         return a.label != b.label ? a.label < b.label : a.layer < b.layer;
                     });
    std::vector<levelset::Region> regions;
    for (Tissue& tissue : scene.tissues)
        std::move(tissue.regions.begin(), tissue.regions.end(), std::back_inserter(regions));
    scene.tissues.clear();
    return regions;
}

}  // namespace myotet::repair
