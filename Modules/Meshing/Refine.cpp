// SPDX-License-Identifier: Apache-2.0
#include "Meshing/Refine.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Core/Parallel.h"

namespace myotet::meshing {
namespace {

using lattice::RedGreenLattice;
using lattice::Verdict;
using levelset::LevelSet;

constexpr std::size_t kGrain = 1024;

// A BCC tetrahedron's circumradius is 0.56 of its long edge: farther than that
// from all four nodes there is no interface in it. A little more makes the
// change of size start one layer inside.
constexpr double kNearInterface = 0.75;

// A median surface edge after compression, as a fraction of the lattice's long
// edge: surface triangles have long and short edges, measured over shapes.
constexpr double kSurfaceEdgeOfLattice = 0.825;

// Edges are compared with a little slack, so that rounding decides nothing.
constexpr double kSlack = 1 + 1e-6;

// The size wanted at lattice nodes near the interface, computed once a node.
class WantedSize {
public:
    WantedSize(const LevelSet& phi, const Options& options, const LevelPlan& plan)
        : phi_(phi), options_(options), plan_(plan) {}

    void update(const RedGreenLattice& lattice) {
        const std::size_t first = wanted_.size();
        wanted_.resize(lattice.node_count());
        parallel_for(first, wanted_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                wanted_[i] =
                    evaluate(lattice.position(static_cast<std::int32_t>(i)), lattice.values()[i]);
        });
    }
    [[nodiscard]] float operator[](std::int32_t node) const { return wanted_[node]; }

private:
    [[nodiscard]] float evaluate(const Vec3& point, float value) const {
        double size = plan_.surface_edge;
        if (std::abs(value) < 1.2 * plan_.surface_edge) {
            if (options_.curvature_factor > 0) size = std::min(size, by_curvature(point));
            if (options_.thickness_factor > 0) {
                const double longest = plan_.surface_edge / options_.thickness_factor;
                size = std::min(size,
                                options_.thickness_factor * local_thickness(phi_, point, longest));
            }
        }
        return static_cast<float>(std::max(size, plan_.smallest_edge));
    }

    // edge <= factor / (|k1| + |k2|) at the foot of the point on the interface.
    [[nodiscard]] double by_curvature(const Vec3& point) const {
        Vec3 foot = point;
        for (int i = 0; i < 2; ++i) {
            const levelset::Sample s = phi_.sample(foot);
            const double g2 = s.gradient.squaredNorm();
            if (!(g2 > 1e-6)) break;
            foot -= s.value / g2 * s.gradient;
        }
        const double step = std::max(1.5 * phi_.spacing, 0.5 * plan_.smallest_edge);
        const auto k = levelset::principal_curvatures(phi_, foot, step);
        const double sum = std::abs(k[0]) + std::abs(k[1]);
        return sum > 0 ? options_.curvature_factor / sum : std::numeric_limits<double>::infinity();
    }

    const LevelSet& phi_;
    const Options& options_;
    const LevelPlan& plan_;
    std::vector<float> wanted_;
};

Verdict judge(const RedGreenLattice& lattice, const WantedSize& wanted, const Options& options,
              const LevelPlan& plan, int level, const Tet& t) {
    const double edge = lattice.edge_length(level);
    float lowest = std::numeric_limits<float>::max(), nearest = lowest, size = lowest;
    for (const std::int32_t n : t) {
        const float v = lattice.values()[n];
        lowest = std::min(lowest, v);
        nearest = std::min(nearest, std::abs(v));
        size = std::min(size, wanted[n]);
    }
    if (lowest > plan.outside * edge) return Verdict::discard;
    if (nearest < kNearInterface * edge && edge > size * kSlack) return Verdict::refine;
    if (options.sizing && lowest < edge && edge > plan.smallest_edge * kSlack) {
        Vec3 centre = Vec3::Zero();
        for (const std::int32_t n : t) centre += 0.25 * lattice.position(n);
        if (edge > options.sizing(centre) * kSlack) return Verdict::refine;
    }
    return Verdict::keep;
}

}  // namespace

LevelPlan plan_levels(const Options& options) {
    LevelPlan plan;
    plan.surface_edge = options.edge_length / kSurfaceEdgeOfLattice;
    const double interior =
        options.interior_edge_length > 0 ? options.interior_edge_length : 4 * options.edge_length;
    const double smallest =
        options.smallest_edge_length > 0 ? options.smallest_edge_length : options.edge_length / 8;
    plan.coarsest_edge = plan.surface_edge;
    while (2 * plan.coarsest_edge * kSurfaceEdgeOfLattice <= interior * kSlack) {
        plan.coarsest_edge *= 2;
        ++plan.surface_level;
    }
    plan.max_level = plan.surface_level;
    plan.smallest_edge = plan.surface_edge;
    const bool finer = options.curvature_factor > 0 || options.thickness_factor > 0 ||
                       options.distance_factor > 0 || options.sizing;
    while (finer && plan.smallest_edge * kSurfaceEdgeOfLattice / 2 * kSlack >= smallest) {
        plan.smallest_edge /= 2;
        ++plan.max_level;
    }
    return plan;
}

double local_thickness(const LevelSet& phi, const Vec3& point, double longest) {
    levelset::Sample s = phi.sample(point);
    double g = s.gradient.norm();
    if (!(g > 0.1)) {
        // On the medial set itself: the depth is half the thickness.
        return s.value < 0 ? std::min(longest, -2 * s.value) : longest;
    }
    const Vec3 normal = s.gradient / g;
    const Vec3 foot = point - s.value * normal;
    // Walk inwards while the foot stays the nearest surface point: -phi = depth.
    const double step = 0.5 * phi.spacing;
    for (double depth = step; depth < 0.5 * longest + step; depth += step) {
        s = phi.sample(foot - depth * normal);
        if (-s.value > depth - 0.5 * step - 0.1 * depth) continue;
        // Past the medial set. Opposite walls have opposite normals.
        s = phi.sample(foot - (depth + step) * normal);
        g = s.gradient.norm();
        if (g > 0.1 && s.gradient.dot(normal) / g > -0.5) return longest;
        return std::min(longest, 2 * depth);
    }
    return longest;
}

RedGreenLattice build_lattice(const LevelSet& phi, const Options& options, const LevelPlan& plan,
                              ProgressSink& progress) {
    RedGreenLattice lattice(phi.box(), plan.coarsest_edge, plan.max_level, plan.outside,
                            [&phi](const Vec3& p) { return phi.value(p); });
    WantedSize wanted(phi, options, plan);
    for (int level = 0; level < plan.max_level; ++level) {
        progress.check();
        wanted.update(lattice);
        const std::vector<Tet>& tets = lattice.tets(level);
        std::vector<Verdict> verdicts(tets.size());
        parallel_for(0, tets.size(), kGrain, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                verdicts[i] = judge(lattice, wanted, options, plan, level, tets[i]);
        });
        lattice.apply(level, verdicts);
    }
    lattice.close();
    return lattice;
}

}  // namespace myotet::meshing
