// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "Core/LabelVolume.h"
#include "Core/TetMesh.h"
#include "LevelSet/FromLabels.h"

namespace myotet::repair {

/// A tissue under repair: what one label value of one layer has become.
struct Tissue {
    std::int32_t label = 0;
    int layer = 0;
    std::string name;
    std::vector<levelset::Region> regions;  ///< by component, largest first
    bool changed = false;                   ///< by a step; else its regions are as they came
    bool made = false;                      ///< by a step: the scan does not have it
};

/// Outward plane of the field of view: inside where normal . x <= offset.
struct Plane {
    Vec3 normal = Vec3::UnitX();  ///< unit, LPS
    double offset = 0;            ///< mm
};

/// All tissues of a scan on one lattice. They may overlap where they come from
/// several layers, until a step decides.
struct Scene {
    Frame frame;         ///< of all regions
    double spacing = 0;  ///< mm
    std::vector<Tissue> tissues;
    std::vector<Plane> field_of_view;  ///< empty: unbounded
    /// Reads a surface in LPS, mm; what it throws goes on to the caller. Empty:
    /// steps with a surface are refused.
    std::function<TriMesh(const std::filesystem::path&)> read_surface;
};

/// Adds the tissues of one layer, which its regions name, with the volume's
/// names; the first layer brings frame, spacing and field of view. Throws InputError when a
/// later one lies on another lattice.
void add_layer(Scene& scene, levelset::LabelLevelSets&& sets, const LabelVolume& volume);

/// The six planes around a volume's voxels.
[[nodiscard]] std::vector<Plane> field_of_view(const LabelVolume& volume);

/// All regions by label value, layer and component; empties the scene.
[[nodiscard]] std::vector<levelset::Region> take_regions(Scene& scene);

}  // namespace myotet::repair
