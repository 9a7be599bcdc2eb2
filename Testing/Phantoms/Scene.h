// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "Core/LabelVolume.h"
#include "Phantoms/Phantoms.h"

namespace myotet::phantoms {

/// One tissue of a phantom.
struct Tissue {
    std::int32_t label = 0;
    LabelName name;
    std::function<bool(const Vec3&)> contains;  ///< of body coordinates, mm
    double true_volume = 0;                     ///< of what the tissues before leave over, mm^3
    Distance distance;                          ///< of body coordinates; may be empty
    Fibre fibre;                                ///< of body coordinates; may be empty
};

/// A body before it is scanned.
struct Scene {
    Box box;                      ///< holds all tissues, mm
    std::vector<Tissue> tissues;  ///< the first that contains a point has it
};

/// The label at a point of body coordinates; 0 outside all tissues.
[[nodiscard]] inline std::int32_t label_at(const Scene& scene, const Vec3& point) {
    for (const Tissue& tissue : scene.tissues)
        if (tissue.contains(point)) return tissue.label;
    return 0;
}

/// An upper arm and elbow, z upwards along the humerus from the elbow's axis,
/// lateral at -x, anterior at -y.
[[nodiscard]] Scene arm_scene();

}  // namespace myotet::phantoms
