// SPDX-License-Identifier: Apache-2.0
#include "Meshing/Compress.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Meshing/AngleEnergy.h"
#include "Meshing/NodeEnergy.h"
#include "Meshing/Stars.h"
#include "Quality/Quality.h"

namespace myotet::meshing {
namespace {

using levelset::LevelSet;
using levelset::Sample;

constexpr std::size_t kGrain = 32;

// A node that moves less than this fraction of its scale wakes nobody.
constexpr double kStill = 2e-3;
// No step is longer than this fraction of the node's scale.
constexpr double kLongestStep = 0.5;
// A full quadrature of squares over a triangle: corners, edge midpoints and
// centre (exact for cubics).
constexpr double kCornerWeight = 3.0 / 60, kEdgeWeight = 8.0 / 60, kCentreWeight = 27.0 / 60;

// Deviations beyond this fraction of a node's scale, or of the surface's median
// one where that is smaller, count with their fourth power.
constexpr double kFarOff = 0.07;
// Tetrahedra whose q exceeds this (aspect ratio about 3) are worked on to the end.
constexpr double kBad = 3.0;
// The farthest place that there shall be, in median surface edges. Places count with this
// power of their part of it, so that 15 % of an edge weighs as much as an aspect ratio of
// 4.4; from kFar on their fit is tightened.
constexpr double kFarthest = 0.14, kFarPower = 3, kFar = 0.63;
// However far a place is, it counts as no more than this, so that no element is ruined for
// it; beyond a quarter of an edge it is given up.
constexpr float kMostFar = 1.0F, kHopeless = 5.7F;
// Badness of tetrahedra that are worked on where the angles decide, and of those whose
// fit is loosened, by how much each time. Nothing is gained within 5 % of the goal.
constexpr double kAwake = 0.8, kPoor = 0.95, kLoosen = 0.5;
// What uniform meshes shall keep to, and graded ones, whose distance is held as well.
constexpr ShapeGoal kUniformGoal{116, 28, 3.4}, kGradedGoal{134, 22.5, 3.95};
// And those of smooth shapes: uniform ones that have reached it within so many rounds.
constexpr ShapeGoal kSmoothGoal{116, 28, 2.6};
constexpr int kSmoothRounds = 2;

// One stage: `sweeps` sweeps at exponent m (kAngles: AngleEnergy) and fit weight mu.
constexpr int kAngles = 0;
struct Stage {
    int sweeps;
    int m;
    double mu;
};

// Both energies of a star at a stage.
struct Measure {
    StarEnergy powers;
    AngleEnergy angles;
};
double value(const StarEnergy& energy, const Vec3& x, int m) { return energy.value(x, m); }
double value(const AngleEnergy& energy, const Vec3& x, int) { return energy.value(x); }
Expansion expand(const StarEnergy& energy, const Vec3& x, int m) { return energy.expand(x, m); }
Expansion expand(const AngleEnergy& energy, const Vec3& x, int) { return energy.expand(x); }

class Compressor {
public:
    Compressor(TetMesh& mesh, const LevelSet& phi)
        : x_(mesh.points),
          phi_(phi),
          stars_(mesh),
          dirty_(mesh.points.size(), 1),
          weight_(mesh.points.size(), 1) {
        std::vector<double> scales;
        for (std::size_t v = 0; v < x_.size(); ++v)
            if (stars_.on_boundary(static_cast<std::int32_t>(v))) scales.push_back(stars_.scale[v]);
        MYOTET_CHECK(!scales.empty(), "a mesh has a boundary");
        const auto middle = scales.begin() + static_cast<std::ptrdiff_t>(scales.size() / 2);
        std::nth_element(scales.begin(), middle, scales.end());
        surface_scale_ = *middle;
    }

    void run(const Stage& stage, double offset, ProgressSink& progress) {
        offset_ = offset;
        for (int sweep = 0; sweep < stage.sweeps; ++sweep) {
            progress.check();
            for (std::size_t c = 0; c + 1 < stars_.colour_start.size(); ++c)
                parallel_for(stars_.colour_start[c], stars_.colour_start[c + 1], kGrain,
                             [&](std::size_t first, std::size_t last) {
                                 thread_local Measure measure;
                                 for (std::size_t i = first; i < last; ++i)
                                     if (stage.m == kAngles)
                                         visit(stars_.by_colour[i], stage, measure.angles);
                                     else
                                         visit(stars_.by_colour[i], stage, measure.powers);
                             });
        }
    }
    void wake_boundary() {
        for (std::size_t v = 0; v < x_.size(); ++v)
            if (stars_.on_boundary(static_cast<std::int32_t>(v))) dirty_[v] = 1;
    }
    // Wakes the nodes of all tetrahedra with q above a bound.
    void wake_bad(const TetMesh& mesh, double bound) {
        for (const Tet& t : mesh.tets)
            if (shape_energy(x_[t[0]], x_[t[1]], x_[t[2]], x_[t[3]]) > bound)
                for (const std::int32_t n : t) dirty_[n] = 1;
    }
    void aim_at(const ShapeGoal& goal) { aim_ = goal; }
    // Wakes what is bad and loosens the fit of what is poor; false when nothing is.
    bool loosen_poor(const TetMesh& mesh) {
        const std::vector<float> bad = survey_shapes(mesh, aim_);
        bool any = false;
        for (std::size_t v = 0; v < x_.size(); ++v) {
            if (!(bad[v] > kPoor)) continue;
            weight_[v] *= kLoosen;
            any = true;
        }
        return any;
    }
    // What a mesh whose distance is held still lacks at each node: the badness of the
    // worst element, and how far off the farthest face is, 1 being at the goal for both.
    struct Survey {
        std::vector<float> bad, far;
        // Leaves out places that are not to be reached.
        [[nodiscard]] float worst() const {
            float most = *std::ranges::max_element(bad);
            for (const float f : far)
                if (f < kHopeless) most = std::max(most, f);
            return most;
        }
    };
    // The farthest place shall be `farthest` mm away. Wakes the nodes of bad elements.
    [[nodiscard]] Survey survey(const TetMesh& mesh, const std::vector<Triangle>& faces,
                                double farthest) {
        Survey found{survey_shapes(mesh, kGradedGoal), std::vector<float>(x_.size(), 0)};
        for (const Triangle& f : faces) {
            const auto off = static_cast<float>(std::pow(distance(f) / farthest, kFarPower));
            for (const std::int32_t n : f) found.far[n] = std::max(found.far[n], off);
        }
        return found;
    }
    // Shifts the balance by `factor` towards what lacks most.
    void ease(const Survey& found, double factor) {
        for (std::size_t v = 0; v < x_.size(); ++v) {
            const double bad = found.bad[v] / kPoor;
            const double far = std::min(found.far[v], kMostFar) / kFar;
            if (!(std::max(bad, far) > 1)) continue;
            weight_[v] *= bad > far ? 1 / factor : factor;
            dirty_[v] = 1;
        }
    }
    void wake_all() { std::fill(dirty_.begin(), dirty_.end(), 1); }

private:
    static void make_room(StarEnergy& energy, std::size_t count) { energy.reset(count); }
    void make_room(AngleEnergy& energy, std::size_t count) const {
        energy.reset(count, aim_.max_aspect_ratio);
    }
    // Farthest of a face's corners, edge midpoints and centre from the surface, mm.
    [[nodiscard]] double distance(const Triangle& f) const {
        const Vec3 &a = x_[f[0]], &b = x_[f[1]], &c = x_[f[2]];
        double farthest = 0;
        for (const Vec3& p : {Vec3((a + b + c) / 3), Vec3(0.5 * (a + b)), Vec3(0.5 * (b + c)),
                              Vec3(0.5 * (c + a)), a, b, c})
            farthest = std::max(farthest, std::abs(phi_.value(p) - offset_));
        return farthest;
    }
    // The largest badness around each node; wakes those of bad tetrahedra.
    [[nodiscard]] std::vector<float> survey_shapes(const TetMesh& mesh, const ShapeGoal& goal) {
        std::vector<float> bad(x_.size(), 0);
        const Badness badness(goal);
        for (const Tet& t : mesh.tets) {
            const double b = badness(x_[t[0]], x_[t[1]], x_[t[2]], x_[t[3]]);
            for (const std::int32_t n : t) {
                bad[n] = std::max(bad[n], static_cast<float>(b));
                if (b > kAwake) dirty_[n] = 1;
            }
        }
        return bad;
    }
    // The fit at boundary node v displaced by `step` (mm): mu / h^2 times the
    // quadrature of (phi - c)^2 over its faces; Gauss-Newton where asked.
    double fit(std::int32_t v, const Vec3& at, double mu, Expansion* expansion) const {
        const double h = stars_.scale[v];
        const double far = kFarOff * std::min(1.0, surface_scale_ / h);
        double sum = 0;
        const auto add = [&](const Vec3& p, double weight, double share) {
            const Sample s = phi_.sample(p);
            const double off = (s.value - offset_) / h;
            const double r2 = off * off / (far * far);
            sum += mu * weight * off * off * (1 + r2);
            if (!expansion) return;
            expansion->gradient += 2 * mu * weight * share * off * (1 + 2 * r2) * s.gradient;
            expansion->hessian += 2 * mu * weight * share * share * (1 + 6 * r2) * s.gradient *
                                  s.gradient.transpose();
        };
        const auto fan = stars_.fan(v);
        for (const auto& e : fan) {
            const Vec3 &a = x_[e[0]], &b = x_[e[1]];
            add((at + a + b) / 3, kCentreWeight, 1.0 / 3);
            add(0.5 * (at + a), 2 * kEdgeWeight, 0.5);  // the edge belongs to two faces
        }
        add(at, kCornerWeight * static_cast<double>(fan.size()), 1);
        if (expansion) expansion->value += sum;
        return sum;
    }

    template <class Energy>
    void visit(std::int32_t v, const Stage& stage, Energy& energy) {
        if (!dirty_[v]) return;
        dirty_[v] = 0;
        const double h = stars_.scale[v], per_h = 1 / h;
        const Vec3 start = x_[v];
        const auto star = stars_.opposite(v);
        make_room(energy, star.size());
        for (const auto& f : star)
            energy.add((x_[f[0]] - start) * per_h, (x_[f[1]] - start) * per_h,
                       (x_[f[2]] - start) * per_h);
        const bool boundary = stars_.on_boundary(v);
        Vec3 u = Vec3::Zero();  // displacement in units of h
        Expansion e = expand(energy, u, stage.m);
        MYOTET_CHECK(e.value < std::numeric_limits<double>::infinity(),
                     "a positive star stays positive");
        const double mu = stage.mu * weight_[v];
        if (boundary) fit(v, start, mu, &e);
        Eigen::LLT<Mat3> factor(e.hessian);
        if (factor.info() != Eigen::Success) {
            e.hessian.diagonal().array() += 1e-3 * e.hessian.cwiseAbs().maxCoeff() + 1e-12;
            factor.compute(e.hessian);
            if (factor.info() != Eigen::Success) return;
        }
        Vec3 step = -factor.solve(e.gradient);
        const double length = step.norm();
        if (!(length > 1e-5)) return;
        if (length > kLongestStep) step *= kLongestStep / length;
        const double slope = e.gradient.dot(step);
        double t = 1;
        for (int halving = 0; halving < 6; ++halving, t *= 0.5) {
            u = t * step;
            double energy_there = value(energy, u, stage.m);
            if (!(energy_there < std::numeric_limits<double>::infinity())) continue;
            if (boundary) energy_there += fit(v, start + h * u, mu, nullptr);
            if (energy_there <= e.value + 1e-4 * t * slope) {
                x_[v] = start + h * u;
                if (u.norm() > kStill) wake_star(v);
                return;
            }
        }
    }

    void wake_star(std::int32_t v) {
        const auto wake = [&](std::int32_t n) {
            std::atomic_ref<char>(dirty_[n]).store(1, std::memory_order_relaxed);
        };
        wake(v);
        for (const auto& f : stars_.opposite(v))
            for (const std::int32_t n : f) wake(n);
    }

    std::vector<Vec3>& x_;
    const LevelSet& phi_;
    Stars stars_;
    std::vector<char> dirty_;
    std::vector<double> weight_;  // of the fit at each node
    double offset_ = 0;
    ShapeGoal aim_ = kUniformGoal;
    double surface_scale_ = 0;  // median scale of boundary nodes, mm
};

double boundary_area(const TetMesh& mesh) {
    double area = 0;
    for (const Triangle& f : boundary_faces(mesh.tets))
        area += 0.5 * (mesh.points[f[1]] - mesh.points[f[0]])
                          .cross(mesh.points[f[2]] - mesh.points[f[0]])
                          .norm();
    return area;
}

// Weights of the fit against the shape measure at each exponent: found by trial
// on the dragon, skull and armadillo, where they balance a mean surface distance
// under 2 % of an edge against an aspect ratio under 4.5.
constexpr Stage kDrive[] = {{1, 1, 3},   {1, 1, 10},  {1, 1, 30},  {1, 1, 100},
                            {1, 1, 300}, {1, 1, 1e3}, {1, 1, 3e3}, {3, 2, 1e5}};
constexpr Stage kShape{8, 4, 1e6};
constexpr Stage kWorst{2, 8, 2e7};
constexpr Stage kAngular{3, kAngles, 2e6}, kEase{2, kAngles, 2e7};
constexpr Stage kVolume{2, 2, 1e5};
constexpr Stage kDraft{2, 4, 1e6};
constexpr int kVolumeRounds = 3, kWorstRounds = 2, kAngleRounds = 14, kEaseRounds = 16;
// Easing shifts the balance in a few bold rounds and then in careful ones; it ends when
// so many in a row gained nothing.
constexpr int kBoldRounds = 4, kPatience = 5;
constexpr double kBold = 2, kCareful = 1.4;
// Of the volume asked for; within half of it nothing is corrected.
constexpr double kVolumeError = 0.01;

// The volume that a mesh shall have, and the isovalue that gives it.
class VolumeGoal {
public:
    explicit VolumeGoal(double volume) : volume_(volume) {}
    [[nodiscard]] bool asked() const { return volume_ > 0; }
    [[nodiscard]] double offset() const { return offset_; }
    void reset(double offset) { offset_ = offset; }
    // Part of the volume that the mesh has too much or too little.
    [[nodiscard]] double error(const TetMesh& mesh) const {
        return asked() ? std::abs(volume(mesh) / volume_ - 1) : 0;
    }
    void correct(const TetMesh& mesh, Compressor& compressor) {
        if (!asked()) return;
        offset_ += (volume_ - volume(mesh)) / boundary_area(mesh);  // dV/dc is the area
        compressor.wake_boundary();
    }

private:
    double volume_, offset_ = 0;
};

// The few elements that are still poor, against the few places that are still too far;
// what came nearest to the goal is kept.
void ease_worst(TetMesh& mesh, Compressor& compressor, VolumeGoal& goal, ProgressSink& progress) {
    const std::vector<Triangle> faces = boundary_faces(mesh.tets);
    const double farthest = kFarthest * quality::boundary_edge_lengths(mesh).median;
    auto found = compressor.survey(mesh, faces, farthest);
    const auto shortfall = [&] {
        return std::max(double{found.worst()}, goal.error(mesh) / kVolumeError);
    };
    double least = shortfall(), offset = goal.offset();
    std::vector<Vec3> best = mesh.points;
    for (int i = 0, since = 0; i < kEaseRounds && since < kPatience && least > 1; ++i) {
        progress.report("compression", (i + 1) / (kEaseRounds + 1.0));
        if (goal.error(mesh) > 0.5 * kVolumeError) goal.correct(mesh, compressor);
        compressor.ease(found, i < kBoldRounds ? kBold : kCareful);
        compressor.run(kEase, goal.offset(), progress);
        found = compressor.survey(mesh, faces, farthest);
        since += i >= kBoldRounds;
        if (shortfall() < least) {
            least = shortfall();
            offset = goal.offset();
            best = mesh.points;
            since = 0;
        }
    }
    mesh.points = std::move(best);
    goal.reset(offset);
}

}  // namespace

void fit_surface(TetMesh& mesh, const LevelSet& phi, ProgressSink& progress) {
    Compressor compressor(mesh, phi);
    for (const Stage& stage : kDrive) {
        progress.check();
        compressor.wake_boundary();
        compressor.run(stage, 0, progress);
    }
}

double polish(TetMesh& mesh, const LevelSet& phi, const PolishOptions& options,
              ProgressSink& progress) {
    Compressor compressor(mesh, phi);
    VolumeGoal goal(options.volume);
    for (int i = 0; goal.asked() && i < kVolumeRounds; ++i) {
        goal.correct(mesh, compressor);
        compressor.run(kVolume, goal.offset(), progress);
    }
    compressor.wake_all();
    compressor.run(options.draft ? kDraft : kShape, goal.offset(), progress);
    if (options.draft) return goal.offset();
    if (options.hold_distance) {
        for (int i = 0; i < kWorstRounds; ++i) {
            goal.correct(mesh, compressor);
            compressor.wake_bad(mesh, kBad);
            compressor.run(kWorst, goal.offset(), progress);
        }
        ease_worst(mesh, compressor, goal, progress);
        return goal.offset();
    }
    for (int i = 0; i < kAngleRounds; ++i) {
        progress.report("compression", (i + 1) / (kAngleRounds + 1.0));
        goal.correct(mesh, compressor);
        bool poor = compressor.loosen_poor(mesh);
        if (i < kSmoothRounds && !poor) {
            compressor.aim_at(kSmoothGoal);
            poor = compressor.loosen_poor(mesh);
        }
        compressor.run(kAngular, goal.offset(), progress);
        if (!poor && !goal.asked()) break;
    }
    return goal.offset();
}

}  // namespace myotet::meshing
