// SPDX-License-Identifier: Apache-2.0
#include "Play/SoftBody.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "Core/Errors.h"
#include "Dynamics/SafeStep.h"

namespace myotet::play {

using dynamics::BlockMatrix;
using dynamics::NodeVectors;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Curvatures above minus this part of mu are left: they are rounding.
constexpr double kRounding = 1e-9;

// grad N_a of the four corners as columns.
using Gradients = Eigen::Matrix<double, 3, 4>;

Gradients gradients_of(const Mat3& inverse_edges) {
    Gradients g;
    g.rightCols<3>() = inverse_edges.transpose();
    g.col(0) = -(g.col(1) + g.col(2) + g.col(3));
    return g;
}

// A rank-one part of the stiffness: size q_a q_b^T.
struct Lift {
    double size = 0;
    Gradients q;
};

// What the antisymmetric pairs lack to be nothing, where s is positive. Returns how many.
int lift_negative(const Mat3& F, const Gradients& g, double mu, double s,
                  std::array<Lift, 3>& lifts) {
    Eigen::SelfAdjointEigenSolver<Mat3> principal;
    principal.computeDirect(F.transpose() * F);
    const Mat3& V = principal.eigenvectors();
    Vec3 S = principal.eigenvalues().cwiseMax(1e-12).cwiseSqrt();
    int count = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = i + 1; j < 3; ++j) {
            const double curvature = mu - s / (S[i] * S[j]);
            if (!(curvature < -kRounding * mu)) continue;
            const Vec3 u_i = F * V.col(i) / S[i], u_j = F * V.col(j) / S[j];
            Lift& lift = lifts[count++];
            lift.size = -0.5 * curvature;
            lift.q.noalias() = u_i * (V.col(j).transpose() * g) - u_j * (V.col(i).transpose() * g);
        }
    return count;
}

// s such that no curvature is negative, where it is negative itself: all of them are at least
// mu + s / S_least^2.
double bounded(const Mat3& F, double mu, double s) {
    Eigen::SelfAdjointEigenSolver<Mat3> principal;
    principal.computeDirect(F.transpose() * F, Eigen::EigenvaluesOnly);
    return std::max(s, -mu * std::max(principal.eigenvalues()[0], 0.0));
}

}  // namespace

SoftBody::SoftBody(std::span<const Vec3> rest, std::vector<Tet> tets,
                   std::span<const elasticity::Lame> laws)
    : tets_(std::move(tets)), F_(tets_.size(), Mat3::Identity()), J_(tets_.size(), 1.0) {
    if (laws.size() != tets_.size())
        throw InputError("a soft body has " + std::to_string(tets_.size()) +
                         " tetrahedra, but laws for " + std::to_string(laws.size()));
    elements_.reserve(tets_.size());
    for (std::size_t t = 0; t < tets_.size(); ++t) {
        const Tet& n = tets_[t];
        const elasticity::RestTet at_rest =
            elasticity::rest_tet({rest[n[0]], rest[n[1]], rest[n[2]], rest[n[3]]});
        elements_.push_back(
            {at_rest.inverse_edges, at_rest.volume * laws[t].mu, at_rest.volume * laws[t].lambda});
    }
}

// V Psi = V (mu / 2 (F : F - 3) - mu ln J + lambda / 2 (ln J)^2)
double SoftBody::move_to(const NodeVectors& x) {
    double energy = 0;
    for (std::size_t t = 0; t < tets_.size(); ++t) {
        const Element& e = elements_[t];
        F_[t].noalias() = edges(t, x) * e.inverse_edges;
        J_[t] = F_[t].determinant();
        if (!(J_[t] > 0)) return kInfinite;
        const double log_J = std::log(J_[t]);
        energy +=
            0.5 * e.mu * (F_[t].squaredNorm() - 3) - e.mu * log_J + 0.5 * e.lambda * log_J * log_J;
    }
    return energy;
}

// f_a = -V P grad N_a, P = mu (F - F^-T) + lambda ln J F^-T
void SoftBody::add_forces(NodeVectors& forces) const {
    for (std::size_t t = 0; t < tets_.size(); ++t) {
        const Element& e = elements_[t];
        const double along = e.lambda * std::log(J_[t]) - e.mu;
        const Mat3 P = e.mu * F_[t] + along * F_[t].inverse().transpose();
        const Mat3 f = -P * e.inverse_edges.transpose();
        const Tet& n = tets_[t];
        forces[n[0]] -= f.col(0) + f.col(1) + f.col(2);
        for (int c = 0; c < 3; ++c) forces[n[c + 1]] += f.col(c);
    }
}

dynamics::Cliques SoftBody::cliques() const {
    dynamics::Cliques cliques;
    for (const Tet& t : tets_) cliques.add(t);
    return cliques;
}

void SoftBody::find_places(const BlockMatrix& K) const {
    places_.resize(tets_.size());
    for (std::size_t t = 0; t < tets_.size(); ++t)
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b < 4; ++b)
                places_[t][4 * a + b] = static_cast<std::uint32_t>(K.at(tets_[t][a], tets_[t][b]));
}

void SoftBody::add_stiffness(BlockMatrix& K) const {
    if (places_.empty()) find_places(K);
    std::array<Lift, 3> lifts;
    for (std::size_t t = 0; t < tets_.size(); ++t) {
        const Element& e = elements_[t];
        const Gradients g = gradients_of(e.inverse_edges);
        double s = e.mu - e.lambda * std::log(J_[t]);
        int lifted = 0;
        if (s >= 0)
            lifted = lift_negative(F_[t], g, e.mu, s, lifts);
        else
            s = bounded(F_[t], e.mu, s);
        const Gradients h = F_[t].inverse().transpose() * g;
        for (int a = 0; a < 4; ++a)
            for (int b = a; b < 4; ++b) {
                Mat3 block = (e.lambda * h.col(a)) * h.col(b).transpose();
                block.noalias() += (s * h.col(b)) * h.col(a).transpose();
                block.diagonal().array() += e.mu * g.col(a).dot(g.col(b));
                for (int l = 0; l < lifted; ++l)
                    block.noalias() +=
                        (lifts[l].size * lifts[l].q.col(a)) * lifts[l].q.col(b).transpose();
                K.value[places_[t][4 * a + b]] += block;
                if (a != b) K.value[places_[t][4 * b + a]] += block.transpose();
            }
    }
}

double SoftBody::largest_step(const NodeVectors& x, const NodeVectors& by) const {
    double step = 1;
    for (std::size_t t = 0; t < tets_.size(); ++t)
        step = std::min(step, dynamics::first_flat(edges(t, x), edges(t, by)));
    return step;
}

double SoftBody::smallest_volume_ratio() const {
    return J_.empty() ? 1 : *std::min_element(J_.begin(), J_.end());
}

}  // namespace myotet::play
