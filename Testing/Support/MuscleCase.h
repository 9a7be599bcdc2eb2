// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <memory>

#include "Dynamics/ElasticBody.h"
#include "Dynamics/NodalLoads.h"
#include "Dynamics/QuasiStatic.h"
#include "Muscle/TissueLaw.h"
#include "Support/ReferenceCase.h"

namespace myotet::test {

enum class Elements { linear, patches, quadratic };

/// A body along z whose lower end is held, and its upper end as well or pulled: the cases of
/// another program's reference solutions.
struct MuscleCase {
    ReferenceMesh mesh;
    Elements elements = Elements::linear;
    std::vector<muscle::TissueMaterial> materials;  ///< by label, 0 first
    bool upper_held = true;
    double traction = 0;                                  ///< on the upper end, N along z
    std::function<bool(const Vec3& centroid)> activated;  ///< empty: everywhere
};

/// A case being solved.
class MuscleRun {
public:
    MuscleRun(const MuscleCase& of, const dynamics::EquilibriumOptions& options) : case_(of) {
        using namespace elasticity;
        if (of.elements == Elements::linear) points_ = linear_points(of.mesh.linear);
        if (of.elements == Elements::patches) points_ = patch_points(of.mesh.linear);
        rest_ = of.mesh.points();
        if (of.elements == Elements::quadratic) {
            const QuadraticMesh quadratic =
                of.mesh.quadratic.tets.empty() ? quadratic_mesh(of.mesh.linear) : of.mesh.quadratic;
            rest_ = quadratic.points;
            points_ = quadratic_points(quadratic);
        }
        set_law();
        set_ends();
        body_ = std::make_unique<dynamics::ElasticBody>(points_, rest_.size(), law_);
        load_ = std::make_unique<dynamics::NodalLoads>(rest_.size());
        stepper_ = std::make_unique<dynamics::LoadStepper>(
            std::vector<dynamics::Potential*>{body_.get(), load_.get()}, rest_.size(), held_,
            options);
        x = rest_;
    }

    /// To a state of traction and activation, both parts of the whole. In halves where it
    /// must, which `failed_steps` counts.
    bool go_to(double pull, double activation) {
        double part = 1, done = 0;
        const double from_pull = pull_, from_activation = activation_;
        while (done < 1) {
            const double next = std::min(1.0, done + part);
            const auto summary = stepper_->go_to(
                next,
                [&](double s, std::vector<Vec3>& at) {
                    apply(from_pull + s * (pull - from_pull),
                          from_activation + s * (activation - from_activation), at);
                },
                x);
            iterations += summary.iterations;
            if (summary.converged) {
                done = next;
                continue;
            }
            ++failed_steps;
            part /= 2;
            if (part < 1e-2) return false;
        }
        pull_ = pull;
        activation_ = activation;
        return true;
    }

    /// What holds the upper end, N along z.
    [[nodiscard]] double upper_force() const {
        const auto forces = stepper_->forces();
        double sum = 0;
        for (const std::int32_t n : upper_) sum -= forces[n].z();
        return sum;
    }
    /// Mean displacement of the upper end along z, mm.
    [[nodiscard]] double upper_displacement() const {
        double sum = 0;
        for (const std::int32_t n : upper_) sum += x[n].z() - rest_[n].z();
        return sum / static_cast<double>(upper_.size());
    }
    [[nodiscard]] const std::vector<std::int32_t>& held() const { return held_; }
    [[nodiscard]] dynamics::ElasticBody& body() { return *body_; }

    std::vector<Vec3> x;
    int iterations = 0, failed_steps = 0;

private:
    void set_law() {
        const TetMesh& mesh = case_.mesh.linear;
        std::vector<std::uint32_t> material(points_.size());
        std::vector<Vec3> fibre(points_.size(), Vec3::UnitZ());
        active_.assign(points_.size(), 1.0);
        for (std::size_t q = 0; q < points_.size(); ++q) {
            Vec3 direction = Vec3::Zero(), centre = Vec3::Zero();
            for (const std::int32_t t : points_.tets(q)) {
                if (!case_.mesh.fibres.empty()) direction += case_.mesh.fibres[t];
                for (const std::int32_t n : mesh.tets[t]) centre += mesh.points[n] / 4;
            }
            centre /= static_cast<double>(points_.tets(q).size());
            material[q] = static_cast<std::uint32_t>(mesh.labels[points_.tets(q).front()]);
            if (direction.norm() > 0) fibre[q] = direction.normalized();
            if (case_.activated && !case_.activated(centre)) active_[q] = 0;
        }
        law_ = std::make_shared<muscle::TissueLaw>(case_.materials, material, fibre);
    }
    void set_ends() {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const Vec3& p : rest_) {
            low = std::min(low, p.z());
            high = std::max(high, p.z());
        }
        for (std::size_t n = 0; n < rest_.size(); ++n) {
            const bool lower = rest_[n].z()<low + 1e-6, upper = rest_[n].z()> high - 1e-6;
            if (upper) upper_.push_back(static_cast<std::int32_t>(n));
            if (lower || (upper && case_.upper_held)) held_.push_back(static_cast<std::int32_t>(n));
        }
        is_upper_.assign(rest_.size(), 0);
        for (const std::int32_t n : upper_) is_upper_[n] = 1;
        const TetMesh& mesh = case_.mesh.linear;
        if (case_.elements == Elements::quadratic) {
            // A face of the upper end has its three middles there too.
            const elasticity::QuadraticMesh& q = case_.mesh.quadratic;
            constexpr int kFaces[4][6] = {
                {0, 1, 2, 4, 5, 6}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {2, 0, 3, 6, 7, 9}};
            for (const auto& ten : q.tets)
                for (const auto& face : kFaces)
                    if (is_upper_[ten[face[0]]] && is_upper_[ten[face[1]]] &&
                        is_upper_[ten[face[2]]])
                        quadratic_faces_.push_back({ten[face[0]], ten[face[1]], ten[face[2]],
                                                    ten[face[3]], ten[face[4]], ten[face[5]]});
            return;
        }
        for (const Triangle& face : boundary_faces(mesh.tets))
            if (is_upper_[face[0]] && is_upper_[face[1]] && is_upper_[face[2]])
                faces_.push_back(face);
    }
    void apply(double pull, double activation, std::vector<Vec3>& at) {
        std::vector<double> all = active_;
        for (double& a : all) a *= activation;
        law_->set_activation(all);
        auto& forces = load_->forces();
        std::fill(forces.begin(), forces.end(), Vec3::Zero());
        const Vec3 total(0, 0, pull * case_.traction);
        if (!faces_.empty()) dynamics::add_traction(rest_, faces_, total, forces);
        if (!quadratic_faces_.empty())
            dynamics::add_quadratic_traction(rest_, quadratic_faces_, total, forces);
        for (const std::int32_t n : held_) at[n] = rest_[n];
    }

    MuscleCase case_;
    elasticity::Points points_;
    std::vector<Vec3> rest_;
    std::vector<double> active_;
    std::vector<std::int32_t> held_, upper_;
    std::vector<char> is_upper_;
    std::vector<Triangle> faces_;
    std::vector<std::array<std::int32_t, 6>> quadratic_faces_;
    std::shared_ptr<muscle::TissueLaw> law_;
    std::unique_ptr<dynamics::ElasticBody> body_;
    std::unique_ptr<dynamics::NodalLoads> load_;
    std::unique_ptr<dynamics::LoadStepper> stepper_;
    double pull_ = 0, activation_ = 0;
};

/// Blemker's muscle with the constants of those cases, and that with a Mooney-Rivlin matrix
/// instead of shears; MPa.
inline muscle::TissueMaterial blemker_muscle(double optimal_stretch) {
    muscle::TissueMaterial m;
    m.fibres = muscle::FibreCurve::blemker_muscle;
    m.fibre_stretch = muscle::FibreStretch::isochoric;
    m.G1 = m.G2 = 5e-4;
    m.bulk = 10;
    m.sigma_max = 0.3;
    m.optimal_stretch = optimal_stretch;
    m.P1 = 0.05;
    m.P2 = 6.6;
    m.linear_stretch = 1.4;
    return m;
}
inline muscle::TissueMaterial matrix_muscle(double bulk) {
    muscle::TissueMaterial m = blemker_muscle(1);
    m.C1 = 0.03;
    m.C2 = 0.01;
    m.G1 = m.G2 = 0;
    m.bulk = bulk;
    return m;
}
inline muscle::TissueMaterial blemker_tendon(double bulk) {
    muscle::TissueMaterial m;
    m.fibres = muscle::FibreCurve::blemker_tendon;
    m.fibre_stretch = muscle::FibreStretch::isochoric;
    m.G1 = m.G2 = 0.05;
    m.L1 = 2.7;
    m.L2 = 46.4;
    m.linear_stretch = 1.03;
    m.bulk = bulk;
    return m;
}
/// As Data/materials' teran2003_muscle.
inline muscle::TissueMaterial teran_muscle() {
    muscle::TissueMaterial m = matrix_muscle(10);
    m.fibres = muscle::FibreCurve::teran_muscle;
    m.fibre_stretch = muscle::FibreStretch::full;
    return m;
}

/// The middle half of the block.
inline bool in_middle_half(const Vec3& centroid) { return centroid.z() > 10 && centroid.z() < 30; }

}  // namespace myotet::test
