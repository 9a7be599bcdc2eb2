// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace myotet::contraction {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Eigen::Quaterniond turn_of(const KeyFrame& key) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(key.angle_deg * kDegree, key.axis));
}

}  // namespace

Pose pose_of(const KeyFrame& key) {
    // x -> R (x - c) + c + t
    Pose pose;
    if (key.angle_deg != 0) pose.rotation = turn_of(key).toRotationMatrix();
    pose.translation = key.centre + key.translation;
    pose.translation -= pose.rotation * key.centre;
    return pose;
}

double turn_between_deg(const KeyFrame& a, const KeyFrame& b) {
    constexpr double kParallel = 1 - 1e-12;  // of unit vectors' products, to rounding
    const double along = a.axis.dot(b.axis);
    if (a.angle_deg == 0 || b.angle_deg == 0 || std::abs(along) >= kParallel)
        return std::abs(b.angle_deg - std::copysign(a.angle_deg, a.angle_deg * along));
    return turn_of(a).angularDistance(turn_of(b)) / kDegree;
}

Pose pose_at(const Motion& motion, double time) {
    const auto& keys = motion.keys;
    if (keys.empty()) return {};
    const auto after = std::ranges::upper_bound(keys, time, {}, &KeyFrame::time);
    if (after == keys.begin()) return pose_of(keys.front());
    const KeyFrame& from = *(after - 1);
    if (after == keys.end() || time == from.time) return pose_of(from);
    // x -> R(s) (x - c) + (1 - s) P_from(c) + s P_to(c), c the later key's centre
    const KeyFrame& to = *after;
    const double s = (time - from.time) / (to.time - from.time);
    Pose pose;
    pose.rotation = turn_of(from).slerp(s, turn_of(to)).toRotationMatrix();
    pose.translation = (1 - s) * pose_of(from)(to.centre) + s * pose_of(to)(to.centre);
    pose.translation -= pose.rotation * to.centre;
    return pose;
}

}  // namespace myotet::contraction
