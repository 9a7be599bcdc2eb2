// SPDX-License-Identifier: Apache-2.0
#include "Contraction/ContactBone.h"

#include <algorithm>
#include <string>
#include <utility>

#include "Core/Errors.h"
#include "Core/Parallel.h"

namespace myotet::contraction {

using dynamics::BlockMatrix;
using dynamics::NodeVectors;

namespace {

constexpr std::size_t kGrain = 128;
// A rotation's columns are orthonormal to this: what nine printed digits leave.
constexpr double kOrthonormal = 1e-6;

}  // namespace

BoneContact::BoneContact(ContactNodes nodes, const std::vector<Vec3>& rest, ContactField bone,
                         const PenaltyLaw& law)
    : nodes_(std::move(nodes)), bone_(std::move(bone)), law_(law) {
    law_.validate();
    gap_ = gaps_at_rest(nodes_, rest, bone_, law_.gap);
    touch_.resize(gap_.size());
    for (std::size_t i = 0; i < touch_.size(); ++i) touch_[i].area = nodes_.area[i];
    settled_.assign(gap_.size(), 0);
    curvature_.assign(gap_.size(), Mat3::Zero());
}

void BoneContact::set_pose(const Pose& pose) {
    const Mat3& R = pose.rotation;
    if (!((R.transpose() * R - Mat3::Identity()).norm() <= kOrthonormal && R.determinant() > 0))
        throw InputError("the rotation of a bone's pose has the determinant " +
                         std::to_string(R.determinant()) +
                         " or columns that are not orthonormal, but it must turn without "
                         "stretching; normalise it");
    pose_ = pose;
}

double BoneContact::move_to(const NodeVectors& x) {
    parallel_for(0, touch_.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            ContactTouch& t = touch_[i];
            t.press = 0;
            const auto s = bone_.sample_below(gap_[i], pose_.to_rest(x[nodes_.node[i]]));
            if (!s) continue;
            t.press = gap_[i] - s->value;
            t.depth = std::max(0.0, std::min(gap_[i], 0.0) - s->value);
            t.normal = pose_.rotation * s->gradient;
            curvature_[i] = pose_.rotation * s->curvature * pose_.rotation.transpose();
        }
    });
    // E = sum k A (gap - d)^2 / 2
    double energy = 0;
    for (const ContactTouch& t : touch_) energy += t.area * t.press * t.press;
    return 0.5 * law_.stiffness * energy;
}

void BoneContact::add_forces(NodeVectors& forces) const {
    // f = k A (gap - d) n
    for (std::size_t i = 0; i < touch_.size(); ++i)
        if (const ContactTouch& t = touch_[i]; t.press > 0)
            forces[nodes_.node[i]] += law_.stiffness * t.area * t.press * t.normal;
}

void BoneContact::add_stiffness(BlockMatrix& K) const {
    for (std::size_t i = 0; i < touch_.size(); ++i) {
        const ContactTouch& t = touch_[i];
        const double settled = std::min(t.press, std::exchange(settled_[i], t.press));
        if (!(t.press > 0)) continue;
        const std::int32_t n = nodes_.node[i];
        K.value[K.at(n, n)] +=
            law_.stiffness * t.area * (t.normal * t.normal.transpose() - settled * curvature_[i]);
    }
}

}  // namespace myotet::contraction
