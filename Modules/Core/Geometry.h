// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>

namespace myotet {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Index3 = std::array<int, 3>;

/// Axis-aligned box [min, max] in mm; empty while min > max.
struct Box {
    Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());

    void include(const Vec3& p) {
        min = min.cwiseMin(p);
        max = max.cwiseMax(p);
    }
    [[nodiscard]] bool empty() const { return !(min.array() <= max.array()).all(); }
    [[nodiscard]] Vec3 extent() const { return empty() ? Vec3(Vec3::Zero()) : Vec3(max - min); }
    [[nodiscard]] Vec3 centre() const { return 0.5 * (min + max); }
    [[nodiscard]] double diagonal() const { return extent().norm(); }
};

/// A right-handed orthonormal frame. Level sets and meshing work in local
/// coordinates x; a point of the patient (LPS, mm) is rotation * x + origin.
struct Frame {
    Mat3 rotation = Mat3::Identity();
    Vec3 origin = Vec3::Zero();

    [[nodiscard]] Vec3 to_lps(const Vec3& local) const { return rotation * local + origin; }
    [[nodiscard]] Vec3 to_local(const Vec3& lps) const {
        return rotation.transpose() * (lps - origin);
    }
};

/// A rigid motion or place: a point that is at x at rest, or in a body's own
/// frame, is at rotation * x + translation.
struct Pose {
    Mat3 rotation = Mat3::Identity();  ///< orthonormal, right-handed
    Vec3 translation = Vec3::Zero();   ///< mm

    [[nodiscard]] Vec3 operator()(const Vec3& x) const { return rotation * x + translation; }
    [[nodiscard]] Vec3 to_rest(const Vec3& y) const {
        return rotation.transpose() * (y - translation);
    }
    [[nodiscard]] Pose inverse() const {
        return {rotation.transpose(), -(rotation.transpose() * translation)};
    }
    /// First the other, then this.
    [[nodiscard]] Pose operator*(const Pose& first) const {
        return {rotation * first.rotation, (*this)(first.translation)};
    }
};

}  // namespace myotet
