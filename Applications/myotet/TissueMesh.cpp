// SPDX-License-Identifier: Apache-2.0
#include "TissueMesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Core/Stopwatch.h"
#include "Sizing.h"
#include "Text.h"

namespace myotet::app {
namespace {

using levelset::LabelLevelSets;
using levelset::Region;

/// Share of a region's work that each of its stages ends at, as measured.
struct StageEnd {
    std::string_view stage;
    double begin, end;
};
constexpr StageEnd kStages[] = {
    {"lattice", 0, 0.1}, {"selection", 0.1, 0.2}, {"compression", 0.2, 1}};

/// Adds the regions' progress up to the job's.
class RegionProgress final : public ProgressSink {
public:
    RegionProgress(ProgressSink& job, std::atomic<double>& done, double weight, std::string name)
        : job_(job), done_(done), weight_(weight), name_(std::move(name)) {}
    ~RegionProgress() override { advance_to(1); }

    void report(std::string_view stage, double fraction) override {
        for (const StageEnd& s : kStages)
            if (s.stage == stage) advance_to(s.begin + fraction * (s.end - s.begin));
    }
    void warn(std::string_view sentence) override {
        job_.warn(name_ + ": " + std::string(sentence));
    }
    void note(std::string_view sentence) override {
        job_.note(name_ + ": " + std::string(sentence));
    }
    [[nodiscard]] bool interrupted() const override { return job_.interrupted(); }

private:
    void advance_to(double fraction) {
        double before = reached_.load();
        while (fraction > before && !reached_.compare_exchange_weak(before, fraction)) {
        }
        if (fraction > before) job_.report("meshing", done_ += weight_ * (fraction - before));
    }

    ProgressSink& job_;
    std::atomic<double>& done_;
    std::atomic<double> reached_ = 0;
    double weight_;
    std::string name_;
};

RegionMesh mesh_region(const Region& region, const Frame& frame, const meshing::Options& sizes,
                       ProgressSink& progress) {
    RegionMesh result;
    try {
        meshing::Result meshed =
            meshing::mesh_level_set(region.phi, options_for(region, sizes), progress);
        Stopwatch watch;
        result.distance = quality::surface_distance(
            meshed.mesh, [&](const Vec3& p) { return region.phi.value(p); });
        result.boundary_faces = boundary_faces(meshed.mesh.tets).size();
        for (Vec3& p : meshed.mesh.points) p = frame.to_lps(p);
        meshed.mesh.labels.assign(meshed.mesh.tets.size(), region.label);
        result.mesh = std::move(meshed.mesh);
        result.summary = std::move(meshed.summary);
        result.seconds_check = watch.lap();
    } catch (const MeshError& error) {
        result.failure = error.what();
    }
    return result;
}

std::string name_of(const Region& region, const std::vector<Tissue>& tissues) {
    const auto it =
        std::ranges::find_if(tissues, [&](const Tissue& t) { return belongs(region, t); });
    return it->name;
}

/// Largest regions first, each taken by whoever is free; results by region.
std::vector<RegionMesh> mesh_regions(LabelLevelSets& sets, const std::vector<Tissue>& tissues,
                                     const meshing::Options& sizes, LevelSets after,
                                     ProgressSink& progress) {
    std::vector<Region>& regions = sets.regions;
    std::vector<double> weights;  // about the region's surface
    for (const Region& region : regions)
        weights.push_back(static_cast<double>(region.phi.memory()));
    const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<std::size_t> order(regions.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t r) { return weights[r]; });

    std::vector<RegionMesh> meshes(regions.size());
    std::atomic<std::size_t> next = 0;
    std::atomic<double> done = 0;
    parallel_for(0, regions.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            progress.check();
            const std::size_t r = order[next++];
            RegionProgress part(progress, done, weights[r] / all, name_of(regions[r], tissues));
            meshes[r] = mesh_region(regions[r], sets.frame, sizes, part);
            if (after == LevelSets::released) regions[r].phi = {};
        }
    });
    return meshes;
}

std::string component_text(const Region& region) {
    return "component " + std::to_string(region.component) + " (" +
           counted(region.voxels, "voxel") + ", " + readable(2 * region.inscribed_radius) +
           " mm thick)";
}

/// Thick enough for its pieces to be promised; a surface's region always is.
bool is_thick(const Region& region, double edge_length) {
    return region.voxels == 0 || 2 * region.inscribed_radius >= 2 * edge_length;
}

/// Says what became of one region.
void record_region(const Region& region, const RegionMesh& made, double edge_length,
                   TissueReport& report) {
    const bool thick = is_thick(region, edge_length);
    if (!made.failure.empty()) {
        const std::string said = component_text(region) + " has no mesh: " + made.failure;
        (thick ? report.broken_promises : report.notes).push_back(said);
    } else if (!thick) {
        report.notes.push_back(component_text(region) +
                               " is thinner than two edge lengths; it was meshed all the same");
    }
    if (region.smoothed_less)
        report.notes.push_back(component_text(region) + " was smoothed less to keep a thin part");
    for (const meshing::PhysicsSummary& p : made.summary.physics)
        if (p.status != "surface fits")
            report.notes.push_back("component " + std::to_string(region.component) +
                                   ": the elastic body ended with '" + p.status +
                                   "', its boundary nodes " + readable(100 * p.mean_distance) +
                                   " % of an edge from the surface in the mean, " +
                                   readable(100 * p.max_distance) + " % at most");
    for (const std::string& note : made.summary.notes) report.notes.push_back(note);
    report.seconds["lattice"] += made.summary.seconds_lattice;
    report.seconds["select"] += made.summary.seconds_select;
    report.seconds["compress"] += made.summary.seconds_compress;
    report.seconds["check"] += made.seconds_check;
}

/// A tissue too thin or small for its edge length can miss its volume.
void note_volume(TissueReport& report) {
    constexpr std::int64_t kFewVoxels = 2000;
    constexpr double kSlack = 0.02, kSlackOfFew = 0.05;
    const double error = report.volume_mesh / report.volume_labels - 1;
    if (report.tets > 0 &&
        !(std::abs(error) <= (report.voxels < kFewVoxels ? kSlackOfFew : kSlack)))
        report.notes.push_back("the mesh has " + readable(100 * error) +
                               " % more volume than the input; use a shorter --edge-length");
}

}  // namespace

TissueMesh join_regions(const Tissue& tissue, const std::vector<Region>& regions,
                        std::vector<RegionMesh>& made, double edge_length) {
    TissueMesh whole;
    TissueReport& report = whole.report;
    report.layer = tissue.layer;
    report.label = tissue.label;
    report.name = tissue.name;
    report.voxels = tissue.voxels;
    report.smoothing = tissue.smoothing;
    report.volume_labels = tissue.volume;
    report.edge_length_asked = edge_length;
    std::size_t faces = 0;
    for (std::size_t r = 0; r < regions.size(); ++r) {
        if (!belongs(regions[r], tissue)) continue;
        ++report.components_in;
        record_region(regions[r], made[r], edge_length, report);
        append(whole.mesh, made[r].mesh);
        // A closed surface of F faces has 3 F + 2 nodes, edges and faces, more or
        // less: the face count weighs the components' means.
        faces += made[r].boundary_faces;
        report.distance.mean += made[r].distance.mean * static_cast<double>(made[r].boundary_faces);
        report.distance.max = std::max(report.distance.max, made[r].distance.max);
        made[r] = {};
    }
    if (faces > 0) report.distance.mean /= static_cast<double>(faces);
    measure(whole.mesh, report);
    note_volume(report);
    return whole;
}

std::vector<TissueMesh> mesh_tissues(LabelLevelSets& sets, const std::vector<Tissue>& tissues,
                                     const meshing::Options& sizes, LevelSets after,
                                     ProgressSink& progress) {
    std::vector<RegionMesh> made = mesh_regions(sets, tissues, sizes, after, progress);

    std::vector<TissueMesh> whole(tissues.size());
    for (std::size_t t = 0; t < tissues.size(); ++t) {
        progress.check();
        progress.report("checking", static_cast<double>(t) / static_cast<double>(tissues.size()));
        whole[t] = join_regions(tissues[t], sets.regions, made, sizes.edge_length);
    }
    return whole;
}

}  // namespace myotet::app
