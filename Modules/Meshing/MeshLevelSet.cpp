// SPDX-License-Identifier: Apache-2.0
#include "Meshing/MeshLevelSet.h"

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"
#include "Core/Stopwatch.h"
#include "Meshing/Compress.h"
#include "Meshing/Refine.h"
#include "Meshing/Select.h"
#include "Quality/Quality.h"

namespace myotet::meshing {
namespace {

// What a finished mesh shall not have where refining a few places can help: a
// surface farther away than this part of the median edge.
constexpr double kFarFault = 0.148;
// Share of tetrahedra at faults that still counts as a few, and tries to mend them.
constexpr double kFewFaults = 1e-2;
constexpr int kFaultRounds = 2;
constexpr double kRegularAspectRatio = 1.225;  // sqrt(3 / 2), rounded up
// Fitted to the 142 tissues of an arm, a trunk and a knee: how thick the layer of
// small tetrahedra is, what grading adds, what thin parts multiply.
constexpr double kShellEdges = 2.0, kGrading = 1.2, kThinFactor = 3.4, kThinPower = 1.8;

void require(bool holds, const char* field, double value, const char* rule) {
    if (!holds)
        throw InputError(std::string(field) + " is " + std::to_string(value) + ", but " + rule);
}

void record(const Candidate& candidate, Summary& summary) {
    summary.selection_passes += candidate.passes;
    summary.candidate_tets = static_cast<std::int64_t>(candidate.mesh.tets.size());
    summary.notes.clear();
    if (candidate.bridges > 0)
        summary.notes.push_back(std::to_string(candidate.bridges) +
                                " thin necks were kept by bridges of tetrahedra");
}

// The lattice's tetrahedra around faces whose centre or edge midpoints lie
// farther from the isosurface than `tolerance` mm.
std::vector<lattice::RedTet> far_from_surface(const TetMesh& mesh,
                                              const std::vector<lattice::RedTet>& red,
                                              const levelset::LevelSet& phi, double isovalue,
                                              double tolerance) {
    const auto off = [&](const Vec3& p) { return std::abs(phi.value(p) - isovalue); };
    std::vector<char> marked(mesh.points.size(), 0);
    bool any = false;
    for (const Triangle& f : boundary_faces(mesh.tets)) {
        const Vec3 &a = mesh.points[f[0]], &b = mesh.points[f[1]], &c = mesh.points[f[2]];
        if (off((a + b + c) / 3) > tolerance || off(0.5 * (a + b)) > tolerance ||
            off(0.5 * (b + c)) > tolerance || off(0.5 * (c + a)) > tolerance) {
            for (const std::int32_t n : f) marked[n] = 1;
            any = true;
        }
    }
    std::vector<lattice::RedTet> far;
    for (std::size_t t = 0; any && t < mesh.tets.size(); ++t)
        if (std::any_of(mesh.tets[t].begin(), mesh.tets[t].end(),
                        [&](std::int32_t n) { return marked[n] != 0; }))
            far.push_back(red[t]);
    return far;
}

// The lattice and the way from it to a mesh; each step may refine it.
class Mesher {
public:
    Mesher(const levelset::LevelSet& phi, const Options& options, ProgressSink& progress)
        : phi_(phi),
          options_(options),
          progress_(progress),
          plan_(plan_levels(options)),
          lattice_(build_lattice(phi, options, plan_, progress)) {
        summary.edge_length = plan_.surface_edge;
        summary.levels = plan_.max_level;
        summary.seconds_lattice = watch_.lap();
        progress_.report("lattice", 1);
    }

    // Candidates are driven onto the surface, and the lattice refined where they
    // stay away.
    TetMesh fit() {
        for (;;) {
            Candidate candidate = select();
            record(candidate, summary);
            red_ = std::move(candidate.red);
            summary.seconds_select += watch_.lap();
            if (by_physics()) candidate_ = candidate.mesh.points;
            fit_surface(candidate.mesh, phi_, progress_);
            summary.seconds_compress += watch_.lap();
            if (summary.distance_rounds >= options_.distance_rounds ||
                !(options_.distance_factor > 0) ||
                !refine(far_from_surface(candidate.mesh, red_, phi_, 0,
                                         options_.distance_factor * options_.edge_length)))
                return std::move(candidate.mesh);
            ++summary.distance_rounds;
            progress_.report("selection",
                             summary.distance_rounds / (options_.distance_rounds + 1.0));
        }
    }

    // From the fitted mesh, or the candidate that it was, through all compressions.
    void compress(TetMesh& mesh) {
        if (by_physics()) mesh.points = candidate_;
        bool fitted = !by_physics();
        summary.physics.clear();
        for (const Compression kind : options_.compression) {
            if (kind != Compression::optimization) {
                PhysicsOptions physics;
                physics.material =
                    kind == Compression::springs ? Material::springs : Material::elements;
                summary.physics.push_back(compress_by_physics(mesh, phi_, physics, progress_));
                continue;
            }
            if (!fitted) fit_surface(mesh, phi_, progress_);
            fitted = true;
            summary.volume_offset = meshing::polish(mesh, phi_,
                                                    {.volume = options_.volume,
                                                     .hold_distance = options_.distance_factor > 0,
                                                     .draft = options_.draft},
                                                    progress_);
        }
        summary.seconds_compress += watch_.lap();
    }

    // Refines at the few places where the finished mesh is not good enough; false
    // when there are none, or so many that the edge length is to blame.
    bool refine_faults(const TetMesh& mesh) {
        if (!(options_.distance_factor > 0) || options_.draft ||
            options_.compression.back() != Compression::optimization)
            return false;
        const double far = kFarFault * quality::boundary_edge_lengths(mesh).median;
        std::vector<lattice::RedTet> faults =
            far_from_surface(mesh, red_, phi_, summary.volume_offset, far);
        for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
            const Tet& n = mesh.tets[t];
            if (quality::measure(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]],
                                 mesh.points[n[3]])
                    .aspect_ratio > options_.aspect_ratio)
                faults.push_back(red_[t]);
        }
        if (static_cast<double>(faults.size()) > kFewFaults * static_cast<double>(mesh.tets.size()))
            return false;
        return refine(faults);
    }

    Summary summary;

private:
    [[nodiscard]] bool by_physics() const {
        return options_.compression.front() != Compression::optimization;
    }

    // Where repair runs into the end of the lattice, a lattice that reaches farther.
    Candidate select() {
        const SelectOptions options{.topology = options_.topology,
                                    .components = options_.components};
        try {
            return select_candidate(lattice_, options, progress_);
        } catch (const MeshError&) {
            plan_.outside *= 3;
            lattice_ = build_lattice(phi_, options_, plan_, progress_);
            return select_candidate(lattice_, options, progress_);
        }
    }

    bool refine(const std::vector<lattice::RedTet>& tets) {
        if (tets.empty() || lattice_.refine(tets) == 0) return false;
        lattice_.close();
        summary.seconds_lattice += watch_.lap();
        return true;
    }

    const levelset::LevelSet& phi_;
    const Options& options_;
    ProgressSink& progress_;
    Stopwatch watch_;
    LevelPlan plan_;
    lattice::RedGreenLattice lattice_;
    std::vector<Vec3> candidate_;       // positions before they were fitted; for physics alone
    std::vector<lattice::RedTet> red_;  // of the last candidate
};

}  // namespace

void Options::validate() const {
    require(edge_length > 0 && std::isfinite(edge_length), "edge length", edge_length,
            "it must be a positive number of mm");
    require(interior_edge_length == 0 || interior_edge_length >= edge_length,
            "interior edge length", interior_edge_length,
            "it must be 0 or at least the edge length");
    require(smallest_edge_length >= 0 && smallest_edge_length <= edge_length,
            "smallest edge length", smallest_edge_length,
            "it must be 0 or at most the edge length");
    require(curvature_factor >= 0, "curvature factor", curvature_factor, "it must not be negative");
    require(thickness_factor >= 0, "thickness factor", thickness_factor, "it must not be negative");
    require(aspect_ratio > kRegularAspectRatio, "aspect ratio", aspect_ratio,
            "it must be greater than that of a regular tetrahedron, 1.225");
    require(volume >= 0, "volume", volume, "it must not be negative");
    require(!compression.empty(), "number of compressions", 0, "there must be at least one");
    for (std::size_t i = 1; i < compression.size(); ++i)
        require(compression[i] == Compression::optimization, "compression",
                static_cast<double>(i + 1),
                "springs and fem begin from the candidate: name one "
                "of them, first, or none");
    require(components >= 0, "number of components", components, "it must not be negative");
}

Options spelled_out(Options options) {
    if (options.uniform) {
        options.interior_edge_length = options.smallest_edge_length = options.edge_length;
        options.curvature_factor = options.thickness_factor = options.distance_factor = 0;
        options.sizing = {};
    }
    if (options.draft) options.distance_rounds = 0;
    return options;
}

Result mesh_level_set(const levelset::LevelSet& phi, const Options& asked, ProgressSink& progress) {
    asked.validate();
    const Options options = spelled_out(asked);
    progress.report("lattice", 0);
    Mesher mesher(phi, options, progress);
    TetMesh mesh = mesher.fit();
    progress.report("selection", 1);
    const auto tets = static_cast<std::int64_t>(mesh.tets.size());
    mesher.summary.out_of_bounds =
        tets < options.least_tets || (options.most_tets > 0 && tets > options.most_tets);
    if (mesher.summary.out_of_bounds) return {std::move(mesh), std::move(mesher.summary)};
    mesher.compress(mesh);
    for (int round = 0; round < kFaultRounds && mesher.refine_faults(mesh); ++round) {
        mesh = mesher.fit();
        mesher.compress(mesh);
        ++mesher.summary.fault_rounds;
    }
    progress.report("compression", 1);
    return {std::move(mesh), std::move(mesher.summary)};
}

double forecast_tets(double volume, double area, const Options& options) {
    // A shell of kShellEdges edges around the surface at the surface edge, the
    // rest at the interior one; a BCC lattice has 12 tetrahedra a cell. Parts that
    // are thin for the edge (2 V / A is a slab's thickness) are refined.
    const LevelPlan plan = plan_levels(spelled_out(options));
    const double shell = std::min(volume, kShellEdges * plan.surface_edge * area);
    const auto cells = [](double v, double edge) { return v / (edge * edge * edge); };
    double tets = 12 * kGrading *
                  (cells(shell, plan.surface_edge) + cells(volume - shell, plan.coarsest_edge));
    if (options.thickness_factor > 0 && !options.uniform && volume > 0) {
        const double edge_per_thickness =
            plan.surface_edge * area / (2 * volume * options.thickness_factor);
        tets *= std::max(1.0, kThinFactor * std::pow(edge_per_thickness, kThinPower));
    }
    return tets;
}

}  // namespace myotet::meshing
