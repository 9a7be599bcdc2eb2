// SPDX-License-Identifier: Apache-2.0
#include "Repair/Solids.h"

#include <algorithm>
#include <cmath>

#include "LevelSet/CsgMeasure.h"
#include "LevelSet/Primitives.h"

namespace myotet::repair {
namespace {

using levelset::Distance;

// A distance that is known in coordinates of its own.
template <class Local>
Distance posed(const Pose& pose, Local local) {
    return [pose, local](const Vec3& p) { return local(pose.to_local(p)); };
}

Pose along(const Pose& pose, const Vec3& origin, const Mat3& axes) {
    return {pose.rotation * axes, pose.to_lps(origin)};
}

Box around(const Pose& pose, const Vec3& half) {
    Box box;
    for (int corner = 0; corner < 8; ++corner)
        box.include(
            pose.to_lps(Vec3(corner & 1 ? half.x() : -half.x(), corner & 2 ? half.y() : -half.y(),
                             corner & 4 ? half.z() : -half.z())));
    return box;
}

Box around_ends(const Pose& pose, const Vec3& from, const Vec3& to,
                const std::array<double, 2>& radius) {
    const Vec3 reach = Vec3::Constant(std::max(radius[0], radius[1]));
    Box box;
    for (const Vec3& end : {pose.to_lps(from), pose.to_lps(to)}) {
        box.include(end - reach);
        box.include(end + reach);
    }
    return box;
}

Mat3 axes_with_z(const Vec3& z) {
    Mat3 axes;
    axes.col(2) = z;
    axes.col(0) = z.unitOrthogonal();
    axes.col(1) = z.cross(axes.col(0));
    return axes;
}

struct Placer {
    const Pose& pose;
    const Box& domain;

    PlacedSolid operator()(const Sphere& s) const {
        const Pose at = along(pose, s.centre, Mat3::Identity());
        const double r = s.radius;
        return {
            posed(at, [r](const Vec3& p) { return levelset::sphere_distance(p, Vec3::Zero(), r); }),
            around_ends(pose, s.centre, s.centre, {r, r})};
    }
    PlacedSolid operator()(const Ellipsoid& e) const {
        const Pose at = along(pose, e.centre, e.axes);
        const Vec3 semi = e.semi_axes;
        return {posed(at, [semi](const Vec3& p) { return levelset::ellipsoid_distance(p, semi); }),
                around(at, semi)};
    }
    PlacedSolid operator()(const Capsule& c) const {
        const levelset::RoundCone cone{c.from, c.to, c.radius[0], c.radius[1]};
        return {
            posed(pose, [cone](const Vec3& p) { return levelset::round_cone_distance(p, cone); }),
            around_ends(pose, c.from, c.to, c.radius)};
    }
    PlacedSolid operator()(const Cone& c) const {
        const levelset::RoundCone cone{c.from, c.to, c.radius[0], c.radius[1]};
        return {posed(pose, [cone](const Vec3& p) { return levelset::cone_distance(p, cone); }),
                around_ends(pose, c.from, c.to, c.radius)};
    }
    PlacedSolid operator()(const Cuboid& b) const {
        const Pose at = along(pose, b.centre, b.axes);
        const Vec3 half = 0.5 * b.size;
        return {posed(at, [half](const Vec3& p) { return levelset::box_distance(p, half); }),
                around(at, half)};
    }
    PlacedSolid operator()(const Torus& t) const {
        const Pose at = along(pose, t.centre, axes_with_z(t.axis));
        const double ring = t.ring, tube = t.tube;
        return {posed(at, [=](const Vec3& p) { return levelset::torus_distance(p, ring, tube); }),
                around(at, Vec3(ring + tube, ring + tube, tube))};
    }
    PlacedSolid operator()(const HalfSpace& h) const {
        const Vec3 on = h.point, outward = h.outward;
        return {posed(pose,
                      [=](const Vec3& p) { return levelset::half_space_distance(p, on, outward); }),
                domain};
    }
};

}  // namespace

Pose principal_pose(const levelset::Band& tissue, const Frame& frame) {
    const levelset::PrincipalAxes principal = levelset::principal_axes(tissue);
    Pose pose{principal.axes, principal.centroid};
    for (int a = 0; a < 2; ++a) {
        const Vec3 lps = frame.rotation * pose.rotation.col(a);
        int largest = 0;
        lps.cwiseAbs().maxCoeff(&largest);
        if (lps[largest] < 0) pose.rotation.col(a) = -pose.rotation.col(a);
    }
    pose.rotation.col(2) = pose.rotation.col(0).cross(pose.rotation.col(1));
    return pose;
}

Pose patient_pose(const Frame& frame) {
    return {frame.rotation.transpose(), frame.to_local(Vec3::Zero())};
}

PlacedSolid place(const Solid& solid, const Pose& pose, const Box& domain) {
    return std::visit(Placer{pose, domain}, solid.shape);
}

}  // namespace myotet::repair
