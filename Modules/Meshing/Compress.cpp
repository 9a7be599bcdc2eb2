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
// Where the balance between shape and fit is shifted: an aspect ratio, a distance
// in median edges, and by how much each time.
constexpr double kTooLong = 4.2, kTooFar = 0.12, kShift = 3;
// Badness of tetrahedra that are worked on where the angles decide, and of those whose
// fit is loosened, by how much each time. Nothing is gained within 5 % of the goal.
constexpr double kAwake = 0.8, kPoor = 0.95, kLoosen = 0.5;

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
    // Shifts the balance where one side has lost: towards the shape at tetrahedra
    // whose aspect ratio is too large, towards the fit at faces too far away.
    void rebalance(const TetMesh& mesh, const std::vector<Triangle>& faces) {
        std::vector<char> too_long(x_.size(), 0), too_far(x_.size(), 0);
        for (const Tet& t : mesh.tets)
            if (shape_energy(x_[t[0]], x_[t[1]], x_[t[2]], x_[t[3]]) > kBad &&
                quality::measure(x_[t[0]], x_[t[1]], x_[t[2]], x_[t[3]]).aspect_ratio > kTooLong)
                for (const std::int32_t n : t) too_long[n] = 1;
        const auto is_far = [&](const Vec3& p) {
            return std::abs(phi_.value(p) - offset_) > kTooFar * surface_scale_;
        };
        for (const Triangle& f : faces) {
            const Vec3 &a = x_[f[0]], &b = x_[f[1]], &c = x_[f[2]];
            if (is_far((a + b + c) / 3) || is_far(0.5 * (a + b)) || is_far(0.5 * (b + c)) ||
                is_far(0.5 * (c + a)) || is_far(a) || is_far(b) || is_far(c))
                for (const std::int32_t n : f) too_far[n] = 1;
        }
        for (std::size_t v = 0; v < x_.size(); ++v)
            if (too_long[v] != too_far[v]) {
                weight_[v] *= too_far[v] ? kShift : 1 / kShift;
                dirty_[v] = 1;
            }
    }
    // Wakes what is bad and loosens the fit of what is poor; false when nothing is.
    bool loosen_poor(const TetMesh& mesh) {
        std::vector<char> poor(x_.size(), 0);
        bool any = false;
        for (const Tet& t : mesh.tets) {
            const double bad = badness(x_[t[0]], x_[t[1]], x_[t[2]], x_[t[3]]);
            if (!(bad > kAwake)) continue;
            for (const std::int32_t n : t) {
                dirty_[n] = 1;
                poor[n] |= static_cast<char>(bad > kPoor);
            }
            any |= bad > kPoor;
        }
        for (std::size_t v = 0; v < x_.size(); ++v)
            if (poor[v]) weight_[v] *= kLoosen;
        return any;
    }
    void wake_all() { std::fill(dirty_.begin(), dirty_.end(), 1); }

private:
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
        energy.reset(star.size());
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
constexpr Stage kAngular{3, kAngles, 2e6};
constexpr Stage kVolume{2, 2, 1e5};
constexpr Stage kDraft{2, 4, 1e6};
constexpr int kWorstRounds = 7, kFairRounds = 3, kAngleRounds = 14;
constexpr int kVolumeRounds = 3;

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
    const std::vector<Triangle> faces = boundary_faces(mesh.tets);
    const bool to_volume = options.volume > 0;
    double offset = 0;
    const auto correct_volume = [&] {
        // dV/dc is the area.
        if (to_volume) offset += (options.volume - volume(mesh)) / boundary_area(mesh);
    };
    for (int i = 0; to_volume && i < kVolumeRounds; ++i) {
        correct_volume();
        compressor.wake_boundary();
        compressor.run(kVolume, offset, progress);
    }
    compressor.wake_all();
    compressor.run(options.draft ? kDraft : kShape, offset, progress);
    const int rounds = options.draft ? 0 : options.hold_distance ? kWorstRounds : kAngleRounds;
    for (int i = 0; i < rounds; ++i) {
        progress.report("compression", (i + 1) / (rounds + 1.0));
        correct_volume();
        if (to_volume) compressor.wake_boundary();
        if (options.hold_distance) {
            compressor.wake_bad(mesh, kBad);
            if (i >= kFairRounds) compressor.rebalance(mesh, faces);
            compressor.run(kWorst, offset, progress);
        } else {
            const bool poor = compressor.loosen_poor(mesh);
            compressor.run(kAngular, offset, progress);
            if (!poor && !to_volume) break;
        }
    }
    return offset;
}

}  // namespace myotet::meshing
