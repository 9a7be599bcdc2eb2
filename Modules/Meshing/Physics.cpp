// SPDX-License-Identifier: Apache-2.0
#include "Meshing/Physics.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "Core/Errors.h"
#include "Dynamics/MeshForces.h"
#include "Dynamics/Newmark.h"
#include "Dynamics/StrainLimit.h"

namespace myotet::meshing {
namespace {

using dynamics::NodeVectors;

// Stiffness and time have no unit here: Young's modulus 1 MPa, and one second for
// sound to cross any element.
constexpr double kYoung = 1, kCrossing = 1;
// Part of that time which a step takes: below the stable one for the worst
// shaped elements of a lattice.
constexpr double kTimeStep = 0.25;
// A surface that came nearer by less than this part in so many steps no longer improves.
constexpr double kImprovement = 0.02;
constexpr int kPatience = 12;
// With velocities, a node covers this part of its distance in a step.
constexpr double kApproach = 0.15;
constexpr int kMostHalvings = 10;
// An element is not pressed below this part of its volume in the candidate; what that
// stops may stop its neighbours, so many times in a step.
constexpr double kCrushed = 0.15;
constexpr int kMostPasses = 10;
// After a step that had to be shortened, the next ones grow again.
constexpr double kRegrowth = 1.2;
constexpr dynamics::SolverOptions kSolver{1e-4, 100};

struct Boundary {
    std::vector<Triangle> faces;
    std::vector<std::int32_t> nodes;
    std::vector<double> edge;  // per node of `nodes`: mean length of its edges
    double median_edge = 0;

    explicit Boundary(const TetMesh& mesh) : faces(boundary_faces(mesh.tets)) {
        std::vector<double> sum(mesh.points.size(), 0), all;
        std::vector<int> count(mesh.points.size(), 0);
        for (const Triangle& f : faces)
            for (int e = 0; e < 3; ++e) {
                const double length = (mesh.points[f[e]] - mesh.points[f[(e + 1) % 3]]).norm();
                all.push_back(length);
                for (const std::int32_t n : {f[e], f[(e + 1) % 3]}) {
                    sum[n] += length;
                    ++count[n];
                }
            }
        for (std::size_t n = 0; n < sum.size(); ++n)
            if (count[n] > 0) {
                nodes.push_back(static_cast<std::int32_t>(n));
                edge.push_back(sum[n] / count[n]);
            }
        MYOTET_CHECK(!all.empty(), "a mesh has a boundary");
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
        std::nth_element(all.begin(), middle, all.end());
        median_edge = *middle;
    }

    // Mean of the unit normals of the faces around each node.
    [[nodiscard]] NodeVectors normals(const NodeVectors& x) const {
        NodeVectors all(x.size(), Vec3::Zero()), out;
        for (const Triangle& f : faces) {
            const Vec3 n = (x[f[1]] - x[f[0]]).cross(x[f[2]] - x[f[0]]).normalized();
            for (const std::int32_t v : f) all[v] += n;
        }
        for (const std::int32_t v : nodes) out.push_back(all[v].normalized());
        return out;
    }
};

// The body's own forces, with the pull towards the surface where that is on.
class PulledBody final : public dynamics::ForceField {
public:
    PulledBody(std::unique_ptr<ForceField> body, const Boundary& boundary,
               const levelset::LevelSet& phi, const PhysicsOptions& options)
        : body_(std::move(body)), boundary_(boundary), phi_(phi), options_(options) {}

    void move_to(const NodeVectors& x) override {
        body_->move_to(x);
        normal_ = boundary_.normals(x);
        distance_.clear();
        for (const std::int32_t v : boundary_.nodes)
            distance_.push_back(phi_.value(x[v]) - options_.isovalue);
    }
    void add_elastic(NodeVectors& forces) const override {
        body_->add_elastic(forces);
        if (!pulling) return;
        // Proportional to phi, as stiff as `pull` edges: E h.
        for (std::size_t i = 0; i < boundary_.nodes.size(); ++i)
            forces[boundary_.nodes[i]] -=
                options_.pull * kYoung * boundary_.edge[i] * distance_[i] * normal_[i];
    }
    void add_damping(const NodeVectors& v, NodeVectors& forces) const override {
        body_->add_damping(v, forces);
    }

    [[nodiscard]] std::vector<dynamics::VelocityConstraint> drive(double time_step) const {
        std::vector<dynamics::VelocityConstraint> drive;
        for (std::size_t i = 0; i < boundary_.nodes.size(); ++i)
            drive.push_back(
                {boundary_.nodes[i], normal_[i], -kApproach * distance_[i] / time_step});
        return drive;
    }
    [[nodiscard]] double mean_distance() const {
        double sum = 0;
        for (const double d : distance_) sum += std::abs(d);
        return sum / static_cast<double>(distance_.size()) / boundary_.median_edge;
    }
    [[nodiscard]] double max_distance() const {
        double most = 0;
        for (const double d : distance_) most = std::max(most, std::abs(d));
        return most / boundary_.median_edge;
    }

    bool pulling = true;

private:
    std::unique_ptr<ForceField> body_;
    const Boundary& boundary_;
    const levelset::LevelSet& phi_;
    const PhysicsOptions& options_;
    NodeVectors normal_;
    std::vector<double> distance_;
};

double size_of(const Tet& t, const NodeVectors& x) {
    return std::cbrt(6 * signed_volume(x[t[0]], x[t[1]], x[t[2]], x[t[3]]));
}

// Masses for which an element of size h carries sound at the speed h / kCrossing:
// with the modulus kYoung, density kYoung / h^2.
std::vector<double> fictitious_masses(const TetMesh& mesh) {
    std::vector<double> masses(mesh.points.size(), 0.0);
    for (const Tet& t : mesh.tets) {
        const double h = size_of(t, mesh.points);
        const double mass = kYoung * kCrossing * kCrossing * h / 6;
        for (const std::int32_t n : t) masses[n] += mass / 4;
    }
    return masses;
}

std::unique_ptr<dynamics::ForceField> make_body(const TetMesh& mesh,
                                                const PhysicsOptions& options) {
    if (options.material == Material::springs) {
        // One unit of density, sound at one mm a second: the stiffness of an edge of
        // length h is about h, as that of an element of modulus kYoung.
        return std::make_unique<dynamics::SpringForces>(
            mesh, elasticity::nodal_masses(mesh, 1),
            dynamics::SpringOptions{.sound_speed = std::sqrt(kYoung),
                                    .damping_ratio = options.damping_ratio});
    }
    const elasticity::NeoHookean law{elasticity::lame_from(kYoung, options.poisson)};
    const double viscosity = options.damping_ratio * kYoung * kCrossing;
    return std::make_unique<dynamics::ElementForces>(
        mesh, [law](const Mat3& F) { return law.stress(F); },
        elasticity::Viscosity{0.5 * viscosity, 0.5 * viscosity});
}

double volume_of(const Tet& t, const NodeVectors& x) {
    return signed_volume(x[t[0]], x[t[1]], x[t[2]], x[t[3]]);
}

std::vector<double> volumes_of(const TetMesh& mesh) {
    std::vector<double> volumes;
    for (const Tet& t : mesh.tets) volumes.push_back(volume_of(t, mesh.points));
    return volumes;
}

class Compressor {
public:
    Compressor(TetMesh& mesh, const levelset::LevelSet& phi, const PhysicsOptions& options)
        : mesh_(mesh),
          options_(options),
          boundary_(mesh),
          body_(make_body(mesh, options), boundary_, phi, options),
          rest_volumes_(volumes_of(mesh)),
          problem_{fictitious_masses(mesh), &body_,
                   dynamics::AltitudeLimiter(mesh, fictitious_masses(mesh), {})},
          state_{mesh.points, NodeVectors(mesh.points.size(), Vec3::Zero())} {
        body_.move_to(state_.x);
    }

    PhysicsSummary run(ProgressSink& progress) {
        summary_.force_steps = stage(true, options_.force_steps, progress);
        summary_.velocity_steps = stage(false, options_.velocity_steps, progress);
        summary_.mean_distance = body_.mean_distance();
        summary_.max_distance = body_.max_distance();
        mesh_.points = std::move(state_.x);
        return summary_;
    }

private:
    // Returns the steps taken.
    int stage(bool pulling, int most_steps, ProgressSink& progress) {
        body_.pulling = pulling;
        summary_.status = "out of steps";
        std::vector<double> history = {body_.mean_distance()};
        for (int step = 0; step < most_steps; ++step) {
            progress.check();
            progress.report("compression", (pulling ? 0 : 0.5) + 0.5 * step / most_steps);
            if (body_.max_distance() <= options_.tolerance) {
                summary_.status = "surface fits";
                return step;
            }
            const std::size_t n = history.size();
            if (n > kPatience && history[n - 1] > (1 - kImprovement) * history[n - 1 - kPatience]) {
                summary_.status = "stopped improving";
                return step;
            }
            if (!advance(pulling)) {
                summary_.status = "stopped improving";
                return step;
            }
            history.push_back(body_.mean_distance());
        }
        return most_steps;
    }

    // One step; where it would turn an element inside out, a shorter one.
    bool advance(bool pulling) {
        for (int halving = 0; halving <= kMostHalvings; ++halving) {
            dynamics::State next = state_;
            problem_.constraints.clear();
            if (!pulling) problem_.constraints = body_.drive(kTimeStep * kCrossing);
            // The damped solver's residual only slows the approach to rest.
            (void)dynamics::newmark_step(problem_, time_step_, kSolver, next);
            if (hold_back(next)) {
                state_ = std::move(next);
                time_step_ = std::min(kTimeStep * kCrossing, kRegrowth * time_step_);
                return true;
            }
            ++summary_.halvings;
            time_step_ *= 0.5;
            for (Vec3& v : state_.v) v.setZero();
            body_.move_to(state_.x);
        }
        return false;
    }

    // Stops, for this step, the nodes of elements that it would crush. False when
    // that does not end soon.
    bool hold_back(dynamics::State& next) const {
        for (int pass = 0; pass < kMostPasses; ++pass) {
            bool any = false;
            for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
                const Tet& tet = mesh_.tets[t];
                const double volume = volume_of(tet, next.x);
                if (volume > kCrushed * rest_volumes_[t] ||
                    (volume > 0 && volume >= volume_of(tet, state_.x)))
                    continue;
                for (const std::int32_t n : tet) {
                    next.x[n] = state_.x[n];
                    next.v[n].setZero();
                }
                any = true;
            }
            if (!any) return true;
        }
        return false;
    }

    TetMesh& mesh_;
    const PhysicsOptions& options_;
    Boundary boundary_;
    PulledBody body_;
    std::vector<double> rest_volumes_;
    dynamics::Problem problem_;
    dynamics::State state_;
    double time_step_ = kTimeStep * kCrossing;
    PhysicsSummary summary_;
};

}  // namespace

PhysicsSummary compress_by_physics(TetMesh& mesh, const levelset::LevelSet& phi,
                                   const PhysicsOptions& options, ProgressSink& progress) {
    return Compressor(mesh, phi, options).run(progress);
}

}  // namespace myotet::meshing
