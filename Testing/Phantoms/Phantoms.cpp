// SPDX-License-Identifier: Apache-2.0
#include "Phantoms/Phantoms.h"

#include <cmath>
#include <numbers>
#include <string>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Phantoms/Fusiform.h"
#include "Phantoms/Scene.h"
#include "Phantoms/Shapes.h"

namespace myotet::phantoms {
namespace {

// Empty voxels around the body, so that no label touches the border.
constexpr int kMargin = 3;
constexpr double kMostVoxels = 1e9;
constexpr double kOrthonormal = 1e-9;

constexpr std::array<double, 3> kRed{0.80, 0.36, 0.30}, kBlue{0.30, 0.50, 0.78};

Tissue from_distance(std::int32_t label, LabelName name, double true_volume, Distance distance) {
    return {label, std::move(name), [distance](const Vec3& p) { return distance(p) <= 0; },
            true_volume, distance};
}

Scene one_tissue(const Vec3& half, Tissue tissue) {
    Scene scene;
    scene.box.min = -half;
    scene.box.max = half;
    scene.tissues.push_back(std::move(tissue));
    return scene;
}

Scene sphere_scene() {
    constexpr double kRadius = 20;
    return one_tissue(
        Vec3::Constant(kRadius),
        from_distance(1, {"sphere", kRed},
                      4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius,
                      [](const Vec3& p) { return sphere_distance(p, Vec3::Zero(), kRadius); }));
}

Scene torus_scene() {
    constexpr double kRing = 20, kTube = 8, kAll = kRing + kTube;
    return one_tissue(Vec3(kAll, kAll, kTube),
                      from_distance(1, {"torus", kRed},
                                    2 * std::numbers::pi * std::numbers::pi * kRing * kTube * kTube,
                                    [](const Vec3& p) { return torus_distance(p, kRing, kTube); }));
}

Scene blocks_scene() {
    // Faces, edges and corners in common, and a wall that the larger overhangs.
    const Box large{Vec3(-20, -15, -10), Vec3(4, 15, 14)};
    const Box small{Vec3(4, -15, -10), Vec3(22, 7, 6)};
    Scene scene;
    scene.box = large;
    scene.box.include(small.min);
    scene.box.include(small.max);
    scene.tissues.push_back(
        from_distance(1, {"large_block", kRed}, large.extent().prod(),
                      [large](const Vec3& p) { return box_distance(p, large); }));
    scene.tissues.push_back(
        from_distance(2, {"small_block", kBlue}, small.extent().prod(),
                      [small](const Vec3& p) { return box_distance(p, small); }));
    return scene;
}

Scene ellipsoid_scene() {
    const Vec3 half(18, 14, 40);
    return one_tissue(
        half, from_distance(1, {"ellipsoid", kRed}, 4.0 / 3.0 * std::numbers::pi * half.prod(),
                            [half](const Vec3& p) { return ellipsoid_distance(p, half); }));
}

Scene shell_scene() {
    constexpr double kOuter = 20, kInner = 13;
    return one_tissue(
        Vec3::Constant(kOuter),
        from_distance(
            1, {"shell", kRed},
            4.0 / 3.0 * std::numbers::pi * (kOuter * kOuter * kOuter - kInner * kInner * kInner),
            [](const Vec3& p) { return std::max(p.norm() - kOuter, kInner - p.norm()); }));
}

Scene fusiform_scene() {
    constexpr std::array<double, 3> kWhite{0.93, 0.93, 0.82};
    Tissue belly =
        from_distance(1, {"belly", kRed}, fusiform_belly_volume(), fusiform_belly_distance);
    Tissue tendon =
        from_distance(2, {"tendon", kWhite}, fusiform_tendon_volume(), fusiform_tendon_distance);
    // The same as its distance, which is slow to find.
    belly.contains = [](const Vec3& p) {
        return p.z() >= kFusiformTendon && p.z() <= kFusiformLength - kFusiformTendon &&
               p.head<2>().norm() <= fusiform_radius(p.z());
    };
    belly.fibre = tendon.fibre = fusiform_fibre;
    Scene scene;
    scene.box.min = Vec3(-kFusiformThick, -kFusiformThick, 0);
    scene.box.max = Vec3(kFusiformThick, kFusiformThick, kFusiformLength);
    scene.tissues = {belly, tendon};
    return scene;
}

struct Entry {
    std::string_view name, description;
    Scene (*make)();
    double spacing_xy, spacing_z;
};

constexpr std::array<Entry, 7> kPhantoms{{
    {"sphere", "a ball of 20 mm radius", sphere_scene, 1, 1},
    {"torus", "a ring of 20 mm radius whose tube has 8 mm", torus_scene, 1, 1},
    {"blocks", "two touching blocks with sharp edges", blocks_scene, 1, 1},
    {"ellipsoid", "half axes of 18, 14 and 40 mm, in slices of 5 mm", ellipsoid_scene, 1, 5},
    {"shell", "a hollow ball, 20 mm outside and 13 mm inside", shell_scene, 1, 1},
    {"arm", "humerus, radius and ulna, biceps and triceps with their tendons", arm_scene, 1, 1},
    {"fusiform", "a spindle-shaped muscle of 100 mm between its tendons, with known fibres",
     fusiform_scene, 1, 1},
}};

const Entry& find_entry(std::string_view name) {
    for (const Entry& entry : kPhantoms)
        if (entry.name == name) return entry;
    std::string known;
    for (const Entry& entry : kPhantoms)
        known += (known.empty() ? "" : ", ") + std::string(entry.name);
    throw InputError("there is no phantom '" + std::string(name) + "'; choose one of " + known);
}

/// The grid's size and place around the body; its faces, not its voxel
/// centres, fall together with the body's box.
LabelVolume empty_volume(const Scene& scene, const PhantomOptions& options, const Vec3& spacing) {
    Box box;  // along the grid's axes
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p(corner & 1 ? scene.box.max.x() : scene.box.min.x(),
                     corner & 2 ? scene.box.max.y() : scene.box.min.y(),
                     corner & 4 ? scene.box.max.z() : scene.box.min.z());
        box.include(options.direction.transpose() * p);
    }
    LabelVolume volume;
    double count = 1;
    Vec3 first;
    for (int a = 0; a < 3; ++a) {
        const double inside = std::ceil(box.extent()[a] / spacing[a] - 1e-9);
        count *= inside + 2 * kMargin;
        if (!(count <= kMostVoxels))
            throw ResourceError(
                "a phantom of this spacing would have more than 10^9 voxels; "
                "choose a coarser one");
        volume.size[a] = static_cast<int>(inside) + 2 * kMargin;
        first[a] = box.min[a] + (0.5 - kMargin) * spacing[a];
    }
    volume.index_to_lps.linear() = options.direction * spacing.asDiagonal();
    volume.index_to_lps.translation() = options.direction * first + options.translation;
    volume.values.assign(static_cast<std::size_t>(count), 0);
    for (const Tissue& tissue : scene.tissues) volume.names[tissue.label] = tissue.name;
    return volume;
}

}  // namespace

void PhantomOptions::validate() const {
    const bool given = !(spacing.array() == 0).all();
    if (!spacing.allFinite() || (given && !(spacing.minCoeff() > 0)))
        throw InputError("spacing " + std::to_string(spacing[0]) + "," +
                         std::to_string(spacing[1]) + "," + std::to_string(spacing[2]) +
                         " mm must be three positive numbers");
    const Mat3 error = direction.transpose() * direction - Mat3::Identity();
    if (!(error.cwiseAbs().maxCoeff() <= kOrthonormal))
        throw InputError("direction must have orthogonal columns of length 1");
    if (!translation.allFinite()) throw InputError("translation must be finite");
}

std::vector<std::string_view> phantom_names() {
    std::vector<std::string_view> names;
    for (const Entry& entry : kPhantoms) names.push_back(entry.name);
    return names;
}

Vec3 default_spacing(std::string_view name) {
    const Entry& entry = find_entry(name);
    return {entry.spacing_xy, entry.spacing_xy, entry.spacing_z};
}

std::string_view describe_phantom(std::string_view name) { return find_entry(name).description; }

Phantom make_phantom(std::string_view name, const PhantomOptions& options) {
    options.validate();
    const Scene scene = find_entry(name).make();
    const Vec3 spacing = options.spacing.isZero(0) ? default_spacing(name) : options.spacing;
    Phantom phantom;
    phantom.volume = empty_volume(scene, options, spacing);
    LabelVolume& volume = phantom.volume;
    const Eigen::Affine3d index_to_body =
        Eigen::Translation3d(-options.translation) * volume.index_to_lps;
    parallel_for(0, static_cast<std::size_t>(volume.size[2]), 1,
                 [&](std::size_t first, std::size_t last) {
                     for (auto k = static_cast<int>(first); k < static_cast<int>(last); ++k)
                         for (int j = 0; j < volume.size[1]; ++j)
                             for (int i = 0; i < volume.size[0]; ++i)
                                 volume.values[volume.offset(i, j, k)] =
                                     label_at(scene, index_to_body * Vec3(i, j, k));
                 });
    for (const Tissue& tissue : scene.tissues) {
        phantom.true_volume[tissue.label] = tissue.true_volume;
        if (tissue.distance)
            phantom.distance[tissue.label] = [distance = tissue.distance,
                                              shift = options.translation](const Vec3& lps) {
                return distance(lps - shift);
            };
        if (tissue.fibre)
            phantom.fibre[tissue.label] = [fibre = tissue.fibre, shift = options.translation](
                                              const Vec3& lps) { return fibre(lps - shift); };
    }
    return phantom;
}

Phantom make_phantom(std::string_view name, const Vec3& spacing) {
    PhantomOptions options;
    options.spacing = spacing;
    return make_phantom(name, options);
}

}  // namespace myotet::phantoms
