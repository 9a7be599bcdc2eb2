// SPDX-License-Identifier: Apache-2.0
#include "Cage/Cage.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "Cage/Adjust.h"
#include "Cage/DrawIn.h"
#include "Cage/Reach.h"
#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Core/Text.h"
#include "Quality/Quality.h"

namespace myotet::cage {
namespace {

// Relaxation ends after so many rounds, or when that many brought less than the gain.
constexpr int kRounds = 150, kIdle = 20;
constexpr double kGain = 0.1;  // degrees
// Above the angle asked for, so that coordinates rounded in files keep it.
constexpr double kSpare = 1e-4;
// Rounded counts of tetrahedra within this of those asked for will do.
constexpr double kCountOff = 0.03;
constexpr int kCellSteps = 14;

/// Numbers that are the same everywhere.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double part() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    /// A rotation, all alike likely [Shoemake 1992].
    Mat3 rotation() {
        const double u = part(), v = 2 * M_PI * part(), w = 2 * M_PI * part();
        const double a = std::sqrt(1 - u), b = std::sqrt(u);
        return Eigen::Quaterniond(b * std::cos(w), a * std::sin(v), a * std::cos(v),
                                  b * std::sin(w))
            .normalized()
            .toRotationMatrix();
    }

private:
    std::mt19937_64 engine_;
};

Placement placement_of(int number, std::uint64_t seed) {
    if (number == 0) return {};
    Random random(seed * 0x9E3779B97F4A7C15ull + static_cast<std::uint64_t>(number));
    Placement p;
    p.rotation = random.rotation();
    for (int i = 0; i < 3; ++i) p.shift[i] = random.part();
    return p;
}

/// All that tries have in common.
struct Task {
    const TriMesh& surface;
    const SurfaceTree& tree;
    const std::vector<Part>& parts;
    const Options& options;
    double cell = 0;
};

struct Outcome {
    Try facts;
    TetMesh mesh;
    Enclosure enclosure;
};

void relax(Walls& walls, const RelaxOptions& options, Try& facts,
           const std::function<bool()>& stopped) {
    Relaxation relaxation(walls, options);
    double best = relaxation.worst();
    for (int round = 0, idle = 0; round < kRounds && idle < kIdle; ++round, ++idle) {
        if (stopped() || (relaxation.all_within() && relaxation.worst() >= options.goal)) break;
        relaxation.round();
        ++facts.relax_rounds;
        if (!(relaxation.worst() > best + kGain)) continue;
        best = relaxation.worst();
        idle = 0;
    }
}

double worst_score(const Body& body, const Scale& scale) {
    double least = 90;
    for (std::size_t t = 0; t < body.tets.size(); ++t)
        least = std::min(least, score_deg(body.corners(t), scale));
    return least;
}

// Nothing when stopped on the way.
std::optional<Outcome> run(const Task& task, int number, const std::function<bool()>& stopped) {
    const Options& asked = task.options;
    Outcome out;
    Try& facts = out.facts;
    facts.number = number;
    Sculpture sculpture = sculpt(task.tree, task.cell, placement_of(number, asked.seed));
    facts.bombs = defuse(sculpture);
    Body body = body_of(sculpture, facts.split_nodes);
    Walls walls(task.tree, task.parts, body);
    const double offset = asked.offset_ratio * task.cell;
    if (stopped()) return std::nullopt;
    facts.adjust_steps = adjust(walls, {.offset = offset});
    const RelaxOptions relaxing{.offset = offset,
                                .cell = task.cell,
                                .scale = asked.scale(),
                                .goal = (1 + kSpare) * asked.angle_deg,
                                .seed = asked.seed + static_cast<std::uint64_t>(number)};
    const ReachSummary reached = reach(walls, relaxing, stopped);
    facts.jumps = reached.jumps;
    facts.collapsed = reached.collapsed;
    facts.refined = reached.refined;
    facts.relax_rounds = reached.rounds;
    facts.reached = reached.reached;
    relax(walls, relaxing, facts, stopped);
    if (facts.reached) facts.relax_rounds += draw_in(walls, relaxing, stopped);
    if (stopped()) return std::nullopt;
    facts.tets = static_cast<std::int64_t>(body.tets.size());
    facts.reached = farthest(walls) <= offset;
    facts.score_deg = worst_score(body, relaxing.scale);
    out.mesh = body.mesh();
    facts.volume = volume(out.mesh);
    out.enclosure = prove_enclosure(out.mesh, task.surface, task.tree);
    facts.enclosed = out.enclosure.enclosed();
    return out;
}

bool better(const Try& a, const Try& b, const Options& options) {
    if (a.enclosed != b.enclosed) return a.enclosed;
    if (a.reached != b.reached) return a.reached;
    const bool both = std::min(a.score_deg, b.score_deg) >= options.angle_deg;
    return both ? a.volume < b.volume : a.score_deg > b.score_deg;
}

// The cell whose sculpture, unturned, has about as many tetrahedra as asked for.
double cell_for(const SurfaceTree& tree, double volume, std::int64_t tets) {
    // A cell has twelve tetrahedra; half of those of a coarse cage stand out.
    double cell = std::cbrt(18 * volume / static_cast<double>(tets));
    double large = tree.box().extent().maxCoeff(), small = 0;
    cell = std::min(cell, large);
    for (int step = 0; step < kCellSteps; ++step) {
        Sculpture s = sculpt(tree, cell, {});
        (void)defuse(s);
        const double count = static_cast<double>(s.count()), wanted = static_cast<double>(tets);
        if (std::abs(count - wanted) <= kCountOff * wanted) break;
        (count > wanted ? small : large) = cell;
        const double guess = cell * std::pow(count / wanted, 0.4);
        cell = guess > small && guess < large ? guess
               : small > 0                    ? 0.5 * (small + large)
                                              : 0.7 * large;
    }
    return cell;
}

double choose_cell(const SurfaceTree& tree, const TriMesh& surface, const Options& options) {
    const double longest = tree.box().extent().maxCoeff();
    if (!(options.cell > 0)) return cell_for(tree, std::abs(volume(surface)), options.tets);
    if (options.cell > longest)
        throw InputError("the cell width is " + rounded(options.cell) +
                         " mm, but the surface's longest side is " + rounded(longest) +
                         " mm; ask for cells smaller than it, a fifth of it for instance");
    return options.cell;
}

void require(bool holds, const std::string& name, double value, const std::string& rule) {
    if (!holds) throw InputError(name + " is " + rounded(value) + ", but must be " + rule);
}

}  // namespace

void Options::validate() const {
    require(cell >= 0 && std::isfinite(cell), "cell", cell, "at least 0 mm");
    require(cell > 0 || tets >= 24, "tets", static_cast<double>(tets), "at least 24, a snowflake");
    require(offset_ratio > 0 && std::isfinite(offset_ratio), "offset_ratio", offset_ratio,
            "above 0");
    require(angle_deg > 0 && angle_deg <= 60, "angle_deg", angle_deg, "above 0, and 60 at most");
    require(max_angle_deg == 0 || (max_angle_deg >= 90 && max_angle_deg < 180), "max_angle_deg",
            max_angle_deg, "at least 90 and below 180, or 0 for one that goes with angle_deg");
    require(max_aspect_ratio == 0 || (max_aspect_ratio >= 1.5 && std::isfinite(max_aspect_ratio)),
            "max_aspect_ratio", max_aspect_ratio,
            "at least 1.5, or 0 for one that goes with angle_deg");
    require(tries >= 1, "tries", tries, "at least 1");
}

Scale Options::scale() const {
    Scale scale;
    if (max_angle_deg > 0) scale.large = angle_deg / (180 - max_angle_deg);
    if (max_aspect_ratio > 0) scale.slenderness = angle_deg * max_aspect_ratio;
    return scale;
}

Measures measure(const TetMesh& mesh, const TriMesh& surface, const SurfaceTree& tree) {
    Measures m;
    m.tets = static_cast<std::int64_t>(mesh.tets.size());
    m.nodes = static_cast<std::int64_t>(mesh.points.size());
    const quality::ShapeSummary shapes = quality::measure_shapes(mesh);
    m.min_dihedral_deg = shapes.min_dihedral_deg;
    m.max_dihedral_deg = shapes.max_dihedral_deg;
    m.max_aspect_ratio = shapes.max_aspect_ratio;
    m.mean_aspect_ratio = shapes.mean_aspect_ratio;
    const TriMesh boundary = boundary_surface(mesh);
    m.boundary_faces = static_cast<std::int64_t>(boundary.triangles.size());
    m.distance_min = std::numeric_limits<double>::infinity();
    for (const Vec3& p : boundary.points) {
        const double d = tree.nearest(p, std::numeric_limits<double>::infinity())->distance;
        m.distance_min = std::min(m.distance_min, d);
        m.distance_max = std::max(m.distance_max, d);
        m.distance_mean += d / static_cast<double>(boundary.points.size());
    }
    m.volume_ratio = volume(mesh) / std::abs(volume(surface));
    const quality::Topology topology = quality::measure_topology(mesh.tets, mesh.points.size());
    m.euler_characteristic = topology.euler_characteristic;
    m.boundary_manifold = topology.boundary_manifold;
    m.components = topology.components;
    return m;
}

Cage make_cage(const TriMesh& surface, const Options& options, ProgressSink& progress) {
    options.validate();
    require_closed(surface, options.crossings);
    const SurfaceTree tree(surface);
    const std::vector<Part> parts = parts_of(surface);
    const Task task{surface, tree, parts, options, choose_cell(tree, surface, options)};

    const auto stopped = [&] { return progress.interrupted(); };
    const auto count = static_cast<std::size_t>(options.tries);
    std::vector<std::optional<Outcome>> outcomes(count);
    std::atomic<int> done = 0;
    parallel_for(0, count, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last && !stopped(); ++k) {
            outcomes[k] = run(task, static_cast<int>(k), stopped);
            progress.report("tries", ++done / static_cast<double>(count));
        }
    });

    Cage cage{.cell = task.cell,
              .offset = options.offset_ratio * task.cell,
              .tries_asked = options.tries};
    const Outcome* best = nullptr;
    for (const std::optional<Outcome>& outcome : outcomes) {
        if (!outcome) continue;
        if (best == nullptr || better(outcome->facts, best->facts, options)) {
            best = &*outcome;
            cage.best = static_cast<int>(cage.tries.size());
        }
        cage.tries.push_back(outcome->facts);
    }
    if (best == nullptr) throw Interrupted();
    cage.mesh = best->mesh;
    cage.enclosure = best->enclosure;
    cage.measures = measure(cage.mesh, surface, tree);
    return cage;
}

}  // namespace myotet::cage
