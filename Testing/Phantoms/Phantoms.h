// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string_view>
#include <vector>

#include "Core/LabelVolume.h"

namespace myotet::phantoms {

/// Signed distance in mm to a label's true surface from a point of the
/// patient (LPS, mm); negative inside.
using Distance = std::function<double(const Vec3&)>;

/// Direction of a label's fibres at a point of the patient, of length 1, LPS.
using Fibre = std::function<Vec3(const Vec3&)>;

/// A label volume of which the truth is known.
struct Phantom {
    LabelVolume volume;
    std::map<std::int32_t, double> true_volume;  ///< mm^3, of every label
    std::map<std::int32_t, Distance> distance;   ///< of every label, but for `arm`: none
    std::map<std::int32_t, Fibre> fibre;         ///< of the labels of `fusiform`
};

/// How a phantom is scanned. The body stays where it is in the patient; the
/// grid of voxels changes.
struct PhantomOptions {
    Vec3 spacing = Vec3::Zero();        ///< mm along i, j, k; zero: the phantom's own
    Mat3 direction = Mat3::Identity();  ///< columns: unit vectors of i, j, k in LPS; may be
                                        ///< oblique or left-handed, not sheared
    Vec3 translation = Vec3::Zero();    ///< moves body and grid, mm
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// sphere, torus, blocks, ellipsoid, shell, arm, fusiform.
[[nodiscard]] std::vector<std::string_view> phantom_names();

/// Spacing that a phantom has when none is asked for, mm. Throws InputError
/// for an unknown name.
[[nodiscard]] Vec3 default_spacing(std::string_view name);

/// One line on what a phantom is. Throws InputError for an unknown name.
[[nodiscard]] std::string_view describe_phantom(std::string_view name);

/// Makes a phantom: a voxel has the label of the first tissue that contains
/// its centre. Throws InputError for an unknown name or bad options,
/// ResourceError when the grid would pass 10^9 voxels.
/// Cost: the arm at 1 mm (4 million voxels) takes about 0.1 s.
[[nodiscard]] Phantom make_phantom(std::string_view name, const PhantomOptions& options = {});
[[nodiscard]] Phantom make_phantom(std::string_view name, const Vec3& spacing);

}  // namespace myotet::phantoms
