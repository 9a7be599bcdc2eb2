// SPDX-License-Identifier: Apache-2.0
#include "MeshStages.h"

#include <cmath>

#include "Core/Parallel.h"
#include "Meshing/Refine.h"
#include "Text.h"

namespace myotet::app {
namespace {

std::string to_text(const std::vector<meshing::Compression>& compression) {
    std::string text;
    for (const meshing::Compression kind : compression)
        text += std::string(text.empty() ? "" : ",") +
                (kind == meshing::Compression::springs ? "springs"
                 : kind == meshing::Compression::fem   ? "fem"
                                                       : "optimization");
    return text;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ",") + word;
    return text;
}

double count_tets(const std::vector<TissueMesh>& tissues) {
    double count = 0;
    for (const TissueMesh& tissue : tissues) count += static_cast<double>(tissue.mesh.tets.size());
    return count;
}

/// One region of a surface holds all its pieces.
void count_surface_pieces(const Scan& scan, std::vector<TissueMesh>& tissues) {
    if (!scan.surface) return;
    TissueReport& report = tissues.front().report;
    report.components_in = scan.shells > 0 ? scan.shells : report.components_out;
    if (report.components_out < scan.shells)
        report.notes.push_back(counted(scan.shells - report.components_out, "closed piece") +
                               " of the surface within another, touching one or too small to be "
                               "meshed");
}

}  // namespace

std::vector<TissueMesh> mesh_to_size(TissueSets& tissue_sets, const Scan& scan,
                                     meshing::Options& sizes, std::int64_t wished_tets,
                                     ProgressSink& progress) {
    constexpr int kMostTries = 3;
    levelset::LabelLevelSets& sets = tissue_sets.sets;
    const auto wished = static_cast<double>(wished_tets);
    const auto after = wished_tets > 0 ? LevelSets::kept : LevelSets::released;
    if (wished_tets > 0) sizes = sizes_for_total(sets.regions, sizes, wished, progress);
    std::vector<TissueMesh> tissues;
    for (int tries = 1;; ++tries) {
        const meshing::LevelPlan plan = meshing::plan_levels(sizes);
        progress.note("edge length " + readable(sizes.edge_length) + " mm on the surface, up to " +
                      readable(plan.coarsest_edge) + " mm inside");
        // One region's number is known long before its mesh is finished.
        const bool early = wished_tets > 0 && sets.regions.size() == 1 && tries < kMostTries;
        tissues = mesh_tissues(sets, tissue_sets.tissues, early ? bounded(sizes, wished) : sizes,
                               after, progress);
        // Refinement that follows compression can miss the number that the
        // candidates had: then a better edge length.
        const double excess = wished_tets > 0 ? count_tets(tissues) / wished : 1;
        if (std::abs(excess - 1) <= kTetsTolerance) break;
        if (tries == kMostTries) {
            progress.warn("the meshes have " + readable(excess) +
                          " times the tetrahedra asked for; name an --edge-length instead");
            break;
        }
        sizes = rescaled(sizes, excess);
        tissues.clear();
    }
    count_surface_pieces(scan, tissues);
    return tissues;
}

RunReport describe_run(const JobOptions& options, const Scan& scan, const meshing::Options& sizes,
                       const TissueSets& sets) {
    const meshing::LevelPlan plan = meshing::plan_levels(sizes);
    RunReport report;
    report.run = describe_level_sets(options.scan, options.level_sets, scan, sets);
    report.run.output = options.output.string();
    report.run.options_text.emplace_back("lattice", sizes.uniform ? "uniform" : "graded");
    report.run.options_text.emplace_back("quality", sizes.draft ? "draft" : "standard");
    report.run.options_text.emplace_back("compress", to_text(options.compression));
    report.run.options_text.emplace_back("format", joined(options.formats.extensions));
    const std::initializer_list<std::pair<std::string, double>> numbers = {
        {"tets", options.sizes.tets > 0 ? static_cast<double>(options.sizes.tets) : NAN},
        {"edge_length_mm", sizes.edge_length},
        {"interior_edge_length_mm", plan.coarsest_edge},
        {"smallest_edge_length_mm", plan.smallest_edge},
        {"curvature", sizes.curvature_factor},
        {"max_aspect_ratio", sizes.aspect_ratio}};
    report.run.options_number.insert(report.run.options_number.begin(), numbers);
    return report;
}

}  // namespace myotet::app
