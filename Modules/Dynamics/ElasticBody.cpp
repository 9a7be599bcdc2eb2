// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/ElasticBody.h"

#include <algorithm>

#include "Core/Parallel.h"
#include "Dynamics/SafeStep.h"

namespace myotet::dynamics {

using elasticity::Points;
using elasticity::Tangent;
using elasticity::VolumeLaw;

namespace {

constexpr std::size_t kGrain = 256;

// dJ/dF = cof F, whose columns are cross products of F's.
Mat3 cofactor(const Mat3& F) {
    Mat3 C;
    C.col(0) = F.col(1).cross(F.col(2));
    C.col(1) = F.col(2).cross(F.col(0));
    C.col(2) = F.col(0).cross(F.col(1));
    return C;
}

// Adds s d2J/dF2: d(cof F)_.j by F_.l is the cross product with the third column.
void add_cofactor_slope(double s, const Mat3& F, Tangent& to) {
    for (int j = 0; j < 3; ++j)
        for (int step = 1; step < 3; ++step) {
            const int l = (j + step) % 3, third = 3 - j - l;
            // cof_.j = F_.(j+1) x F_.(j+2): by its first factor -[F_.(j+2)]x, by its second
            // [F_.(j+1)]x.
            const Vec3 a = (step == 1 ? -s : s) * F.col(third);
            auto block = to.block<3, 3>(3 * j, 3 * l);
            block(0, 1) -= a.z();
            block(0, 2) += a.y();
            block(1, 0) += a.z();
            block(1, 2) -= a.x();
            block(2, 0) -= a.y();
            block(2, 1) += a.x();
        }
}

void add_outer(double s, const Mat3& a, Tangent& to) {
    const Eigen::Matrix<double, 9, 1> v = a.reshaped();
    to.noalias() += (s * v) * v.transpose();
}

template <class Body>
void each(std::size_t count, Body&& body) {
    parallel_for(0, count, kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) body(i);
    });
}

// Finds the blocks of one row at a time.
class RowFinder {
public:
    explicit RowFinder(const BlockMatrix& K) : K_(K), at_(K.rows()) {}
    void take(std::size_t row) {
        for (std::size_t i = K_.row_start[row]; i < K_.row_start[row + 1]; ++i)
            at_[K_.column[i]] = static_cast<std::uint32_t>(i);
    }
    [[nodiscard]] std::size_t operator[](std::int32_t column) const { return at_[column]; }

private:
    const BlockMatrix& K_;
    std::vector<std::uint32_t> at_;
};

}  // namespace

ElasticBody::Slots::Slots(std::span<const std::size_t> owner_start,
                          std::span<const std::int32_t> node, std::size_t nodes)
    : start(nodes + 1, 0), slot(node.size()) {
    for (const std::int32_t n : node) ++start[n + 1];
    for (std::size_t n = 0; n < nodes; ++n) start[n + 1] += start[n];
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for (std::size_t q = 0; q + 1 < owner_start.size(); ++q)
        for (std::size_t i = owner_start[q]; i < owner_start[q + 1]; ++i)
            slot[next[node[i]]++] = {static_cast<std::uint32_t>(q), static_cast<std::uint32_t>(i)};
}

namespace {

std::pair<std::vector<std::size_t>, std::vector<std::int32_t>> nodes_of_groups(
    const Points& points) {
    std::pair<std::vector<std::size_t>, std::vector<std::int32_t>> all{{0}, {}};
    auto& [start, node] = all;
    for (std::size_t g = 0; g < points.groups.size(); ++g) {
        std::vector<std::int32_t> some;
        for (std::size_t i = points.groups.start[g]; i < points.groups.start[g + 1]; ++i) {
            const auto nodes = points.nodes(points.groups.point[i]);
            some.insert(some.end(), nodes.begin(), nodes.end());
        }
        std::sort(some.begin(), some.end());
        some.erase(std::unique(some.begin(), some.end()), some.end());
        node.insert(node.end(), some.begin(), some.end());
        start.push_back(node.size());
    }
    return all;
}

}  // namespace

ElasticBody::ElasticBody(const TetMesh& rest, std::shared_ptr<const elasticity::PointLaw> law)
    : ElasticBody(elasticity::linear_points(rest), rest.points.size(), std::move(law)) {}

ElasticBody::ElasticBody(Points points, std::size_t nodes,
                         std::shared_ptr<const elasticity::PointLaw> law)
    : points_(std::move(points)),
      law_(std::move(law)),
      group_of_(points_.size(), -1),
      group_volume_(points_.size(), 0.0),
      groups_([&] {
          auto [start, node] = nodes_of_groups(points_);
          return Groups{std::move(start), std::move(node), {}, {}, {}};
      }()),
      slots_(points_.start, points_.node, nodes),
      group_slots_(groups_.start, groups_.node, nodes),
      gradient_(points_.size(), Mat3::Identity()),
      force_(points_.node.size()),
      tangent_(points_.size()) {
    for (std::size_t g = 0; g < points_.groups.size(); ++g)
        for (std::size_t i = points_.groups.start[g]; i < points_.groups.start[g + 1]; ++i) {
            group_of_[points_.groups.point[i]] = static_cast<std::int32_t>(g);
            group_volume_[points_.groups.point[i]] = points_.groups.volume[i];
        }
    groups_.pressure.resize(points_.groups.size());
    groups_.slope.resize(points_.groups.size());
    groups_.volume_slope.resize(groups_.node.size());
}

// V U(mean J) of each group, mean J = sum_t V_t J_t / V.
double ElasticBody::move_groups(const NodeVectors& x) {
    const auto& groups = points_.groups;
    return parallel_sum(0, groups.size(), kGrain, [&](std::size_t first, std::size_t last) {
        double energy = 0;
        for (std::size_t g = first; g < last; ++g) {
            double rest = 0, now = 0;
            for (std::size_t i = groups.start[g]; i < groups.start[g + 1]; ++i) {
                rest += groups.volume[i];
                now += groups.volume[i] * points_.gradient_of(groups.point[i], x).determinant();
            }
            const VolumeLaw law = law_->volume(groups.law[g]);
            energy += rest * law.energy(now / rest);
            groups_.pressure[g] = law.pressure(now / rest);
            groups_.slope[g] = law.slope(now / rest) / rest;
        }
        return energy;
    });
}

double ElasticBody::move_to(const NodeVectors& x) {
    const double of_volume = move_groups(x);
    const bool grouped = points_.groups.size() > 0;
    return of_volume +
           parallel_sum(0, points_.size(), kGrain, [&](std::size_t first, std::size_t last) {
               double energy = 0;
               for (std::size_t q = first; q < last; ++q) {
                   const Mat3 F = points_.gradient_of(q, x);
                   gradient_[q] = F;
                   const double V = points_.volume[q];
                   energy += V * law_->energy(q, F);
                   Mat3 P = V * law_->stress(q, F);
                   const VolumeLaw law = grouped ? VolumeLaw{} : law_->volume(q);
                   if (group_of_[q] >= 0) {
                       P += group_volume_[q] * groups_.pressure[group_of_[q]] * cofactor(F);
                   } else if (law.bulk != 0) {
                       const double J = F.determinant();
                       energy += V * law.energy(J);
                       P += V * law.pressure(J) * cofactor(F);
                   }
                   for (std::size_t i = points_.start[q]; i < points_.start[q + 1]; ++i)
                       force_[i] = -P * points_.gradient[i];
               }
               return energy;
           });
}

void ElasticBody::add_forces(NodeVectors& forces) const {
    each(forces.size(), [&](std::size_t n) {
        for (std::size_t i = slots_.start[n]; i < slots_.start[n + 1]; ++i)
            forces[n] += force_[slots_.slot[i].entry];
    });
}

Mat3 ElasticBody::law_stress(std::size_t q) const { return law_->stress(q, gradient_[q]); }

Mat3 ElasticBody::volume_stress(std::size_t q) const {
    const Mat3& F = gradient_[q];
    if (group_of_[q] >= 0) return groups_.pressure[group_of_[q]] * cofactor(F);
    if (points_.groups.size() > 0) return Mat3::Zero();
    return law_->volume(q).pressure(F.determinant()) * cofactor(F);
}

Cliques ElasticBody::cliques() const {
    Cliques all;
    for (std::size_t q = 0; q < points_.size(); ++q) {
        // Points of one element come one after the other.
        if (q > 0 && std::ranges::equal(points_.nodes(q), points_.nodes(q - 1))) continue;
        all.add(points_.nodes(q));
    }
    for (std::size_t g = 0; g + 1 < groups_.start.size(); ++g)
        all.add(
            {groups_.node.data() + groups_.start[g], groups_.node.data() + groups_.start[g + 1]});
    return all;
}

void ElasticBody::find_tangents() const {
    const bool grouped = points_.groups.size() > 0;
    each(points_.size(), [&](std::size_t q) {
        const Mat3& F = gradient_[q];
        const double V = points_.volume[q];
        Tangent& C = tangent_[q];
        C = V * law_->tangent(q, F);
        const VolumeLaw law = grouped ? VolumeLaw{} : law_->volume(q);
        if (group_of_[q] >= 0) {
            add_cofactor_slope(group_volume_[q] * groups_.pressure[group_of_[q]], F, C);
        } else if (law.bulk != 0) {
            const double J = F.determinant();
            add_cofactor_slope(V * law.pressure(J), F, C);
            add_outer(V * law.slope(J), cofactor(F), C);
        }
    });
}

void ElasticBody::find_volume_slopes() const {
    const auto& groups = points_.groups;
    each(groups.size(), [&](std::size_t g) {
        const auto first = groups_.node.begin() + static_cast<std::ptrdiff_t>(groups_.start[g]);
        const auto last = groups_.node.begin() + static_cast<std::ptrdiff_t>(groups_.start[g + 1]);
        std::fill(groups_.volume_slope.begin() + static_cast<std::ptrdiff_t>(groups_.start[g]),
                  groups_.volume_slope.begin() + static_cast<std::ptrdiff_t>(groups_.start[g + 1]),
                  Vec3::Zero());
        for (std::size_t i = groups.start[g]; i < groups.start[g + 1]; ++i) {
            const std::size_t q = groups.point[i];
            const Mat3 slope = groups.volume[i] * cofactor(gradient_[q]);
            for (std::size_t e = points_.start[q]; e < points_.start[q + 1]; ++e) {
                const auto at = std::lower_bound(first, last, points_.node[e]);
                groups_.volume_slope[at - groups_.node.begin()] += slope * points_.gradient[e];
            }
        }
    });
}

// K_ab = V sum_jl dP_.j/dF_.l (grad N_a)_j (grad N_b)_l at each point, and of each group
// U'' / V h_a h_b^T, h being the slope of its volume.
void ElasticBody::add_stiffness(BlockMatrix& K) const {
    find_tangents();
    find_volume_slopes();
    // Each row gathers from the points around its node, in their order.
    parallel_for(0, K.rows(), 2 * kGrain, [&](std::size_t first, std::size_t last) {
        RowFinder find(K);
        for (std::size_t n = first; n < last; ++n) {
            find.take(n);
            for (std::size_t s = slots_.start[n]; s < slots_.start[n + 1]; ++s) {
                const auto [q, entry] = slots_.slot[s];
                const Vec3& a = points_.gradient[entry];
                const Tangent& C = tangent_[q];
                const Eigen::Matrix<double, 3, 9> row =
                    a[0] * C.topRows<3>() + a[1] * C.middleRows<3>(3) + a[2] * C.bottomRows<3>();
                for (std::size_t e = points_.start[q]; e < points_.start[q + 1]; ++e) {
                    const Vec3& b = points_.gradient[e];
                    K.value[find[points_.node[e]]] += b[0] * row.leftCols<3>() +
                                                      b[1] * row.middleCols<3>(3) +
                                                      b[2] * row.rightCols<3>();
                }
            }
            for (std::size_t s = group_slots_.start[n]; s < group_slots_.start[n + 1]; ++s) {
                const auto [g, entry] = group_slots_.slot[s];
                const Vec3 a = groups_.slope[g] * groups_.volume_slope[entry];
                for (std::size_t e = groups_.start[g]; e < groups_.start[g + 1]; ++e)
                    K.value[find[groups_.node[e]]] += a * groups_.volume_slope[e].transpose();
            }
        }
    });
}

double ElasticBody::largest_step(const NodeVectors& x, const NodeVectors& by) const {
    std::vector<double> step(points_.size());
    each(points_.size(), [&](std::size_t q) {
        step[q] = first_flat(points_.gradient_of(q, x), points_.gradient_of(q, by));
    });
    return step.empty() ? 1 : *std::min_element(step.begin(), step.end());
}

}  // namespace myotet::dynamics
