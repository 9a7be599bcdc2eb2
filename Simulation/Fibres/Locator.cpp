// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "Fibres/BSplineSolid.h"

namespace myotet::fibres {
namespace {

// Grid points a span: a start lies within a span's quarter of the answer.
constexpr int kGridPerSpan = 2;
// Of the solid's size: a step towards a point that is this near is rounding.
constexpr double kClose = 1e-11;
constexpr int kMostStarts = 6, kMostSteps = 60;
// Marquardt's damping at first, the factor after a step that gains or fails, and where
// no shorter step is worth trying.
constexpr double kDamping = 1e-6, kEase = 0.1, kStiffen = 10, kMostDamping = 1e12;
constexpr double kLeastDamping = 1e-14;
// Of the parameters: a step below this changes nothing.
constexpr double kSmallStep = 1e-14;

/// The damped step (J^T J + l diag(J^T J)) d = J^T r; parameters at a wall of the cube
/// through which the step would lead stay where they are.
Vec3 damped_step(const Mat3& J, const Vec3& r, const Vec3& uvw, double damping) {
    const Mat3 normal = J.transpose() * J;
    const Vec3 downhill = J.transpose() * r;
    const double floor = 1e-14 * normal.trace();
    Mat3 A = normal;
    for (int a = 0; a < 3; ++a) A(a, a) += damping * normal(a, a) + floor;
    std::array<bool, 3> held{};
    const auto blocked = [&](int a, double towards) {
        return (uvw[a] <= 0 && towards < 0) || (uvw[a] >= 1 && towards > 0);
    };
    for (int a = 0; a < 3; ++a) held[a] = blocked(a, downhill[a]);
    Vec3 step = Vec3::Zero();
    // Each round holds at least one more parameter.
    for (int round = 0; round < 4; ++round) {
        Mat3 reduced = A;
        Vec3 right = downhill;
        for (int a = 0; a < 3; ++a) {
            if (!held[a]) continue;
            reduced.row(a).setZero();
            reduced.col(a).setZero();
            reduced(a, a) = 1;
            right[a] = 0;
        }
        step = reduced.ldlt().solve(right);
        bool again = false;
        for (int a = 0; a < 3; ++a)
            if (!held[a] && blocked(a, step[a])) held[a] = again = true;
        if (!again) break;
    }
    return step;
}

/// From a start to a point of the solid that no small step brings nearer.
SolidPlace descend(const BSplineSolid& solid, const Vec3& point, Vec3 uvw, double close) {
    SolidPoint at = evaluate(solid, uvw);
    double distance = (point - at.position).norm(), damping = kDamping;
    for (int n = 0; n < kMostSteps && distance > close && damping < kMostDamping; ++n) {
        const Vec3 step = damped_step(at.derivative, point - at.position, uvw, damping);
        const Vec3 next = (uvw + step).cwiseMax(0).cwiseMin(1);
        if (!((next - uvw).cwiseAbs().maxCoeff() > kSmallStep)) break;
        const SolidPoint there = evaluate(solid, next);
        const double distance_there = (point - there.position).norm();
        if (distance_there < distance) {
            uvw = next;
            at = there;
            distance = distance_there;
            damping = std::max(damping * kEase, kLeastDamping);
        } else {
            damping *= kStiffen;
        }
    }
    return {uvw, distance};
}

/// Indices of the points nearest to `point`, the nearest first.
std::array<std::size_t, kMostStarts> nearest(const std::vector<Vec3>& positions,
                                             const Vec3& point) {
    std::array<std::size_t, kMostStarts> index{};
    std::array<double, kMostStarts> far;
    far.fill(std::numeric_limits<double>::infinity());
    for (std::size_t n = 0; n < positions.size(); ++n) {
        const double d = (positions[n] - point).squaredNorm();
        if (!(d < far.back())) continue;
        std::size_t place = kMostStarts - 1;
        for (; place > 0 && d < far[place - 1]; --place) {
            far[place] = far[place - 1];
            index[place] = index[place - 1];
        }
        far[place] = d;
        index[place] = n;
    }
    return index;
}

}  // namespace

SolidLocator::SolidLocator(const BSplineSolid& solid) : solid_(solid) {
    solid.validate();
    std::array<int, 3> cells;
    for (int a = 0; a < 3; ++a)
        cells[a] = kGridPerSpan * (solid.shape.count[a] - solid.shape.degree[a]);
    Box box;
    // Middles of cells: a start on a wall could stick to it.
    for (int k = 0; k < cells[2]; ++k)
        for (int j = 0; j < cells[1]; ++j)
            for (int i = 0; i < cells[0]; ++i) {
                uvw_.emplace_back((i + 0.5) / cells[0], (j + 0.5) / cells[1], (k + 0.5) / cells[2]);
                position_.push_back(evaluate(solid, uvw_.back()).position);
            }
    for (const Vec3& p : solid.control) box.include(p);
    close_ = kClose * box.diagonal();
}

SolidPlace SolidLocator::find(const Vec3& point) const {
    SolidPlace best;
    best.distance = std::numeric_limits<double>::infinity();
    for (const std::size_t start : nearest(position_, point)) {
        const SolidPlace place = descend(solid_, point, uvw_[start], close_);
        if (place.distance < best.distance) best = place;
        // Inside; a hundredfold of what ends the descent, which rounding may keep off.
        if (best.distance <= 100 * close_) break;
    }
    return best;
}

}  // namespace myotet::fibres
