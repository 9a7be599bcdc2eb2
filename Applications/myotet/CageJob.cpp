// SPDX-License-Identifier: Apache-2.0
#include "CageJob.h"

#include <cmath>

#include "Cage/Embedding.h"
#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Core/Sha256.h"
#include "Core/Stopwatch.h"
#include "Core/Text.h"
#include "Costs.h"
#include "InputKind.h"
#include "MeshFiles/MeshFiles.h"
#include "MeshFiles/Npz.h"
#include "Outputs.h"
#include "Quality/Quality.h"
#include "SurfaceStock.h"
#include "Text.h"

namespace myotet::app {
namespace {

/// A tissue and its surface in the patient's frame.
struct Wrapped {
    Tissue tissue;
    TriMesh surface;
};

/// What cages are made about.
struct Source {
    SurfaceStock stock;
    std::vector<Wrapped> surfaces;
    cage::Crossings crossings = cage::Crossings::refused;
};

TriMesh joined(const SurfaceStock& stock, const Tissue& tissue) {
    TriMesh whole;
    for (std::size_t r = 0; r < stock.starts.size(); ++r) {
        if (!belongs(stock.sets.sets.regions[r], tissue)) continue;
        const auto first = static_cast<std::int32_t>(whole.points.size());
        for (const Vec3& p : stock.starts[r].points)
            whole.points.push_back(stock.sets.sets.frame.to_lps(p));
        for (const Triangle& t : stock.starts[r].triangles)
            whole.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return whole;
}

// A closed surface is enclosed as it is; what else there is becomes level sets first.
Source read_source(const CageJobOptions& options, ProgressSink& progress) {
    Source source;
    const ScanOptions& scan = options.source.scan;
    if (kind_of(scan.input) == InputKind::surface && !scan.heal) {
        source.stock.scan = read_scan(scan);
        tell(source.stock.scan, progress);
        source.surfaces.push_back({source.stock.scan.tissues.front(), *source.stock.scan.surface});
        source.stock.sets.tissues = source.stock.scan.tissues;
        return source;
    }
    source.stock = take_stock(options.source, progress);
    source.crossings = cage::Crossings::allowed;
    for (const Tissue& tissue : source.stock.sets.tissues)
        source.surfaces.push_back({tissue, joined(source.stock, tissue)});
    return source;
}

std::vector<std::string> notes_of(const cage::Cage& c) {
    std::vector<std::string> notes;
    if (!c.reached())
        notes.push_back("the farthest boundary node is " + rounded(c.measures.distance_max) +
                        " mm from the surface, but the offset is " + rounded(c.offset) +
                        " mm: no lattice tried with cells of " + rounded(c.cell) +
                        " mm reaches it; ask for smaller cells, a larger --offset-ratio or more "
                        "--tries");
    if (static_cast<int>(c.tries.size()) < c.tries_asked)
        notes.push_back("stopped after " + std::to_string(c.tries.size()) + " of " +
                        std::to_string(c.tries_asked) + " tries; this is the best of those");
    const cage::BombSummary& bombs = c.tries[static_cast<std::size_t>(c.best)].bombs;
    if (bombs.greedy > 0)
        notes.push_back(counted(bombs.greedy, "group") +
                        " of bombs took too long to search through; the best found may not add "
                        "the fewest tetrahedra");
    return notes;
}

CageTissue make_tissue(const Wrapped& wrapped, cage::Crossings crossings,
                       const CageJobOptions& options, ProgressSink& progress) {
    CageTissue made{.tissue = wrapped.tissue};
    const std::string who = options.source.scan.input.string() + ", " + wrapped.tissue.name + ": ";
    try {
        cage::require_closed(wrapped.surface, crossings);
    } catch (const InputError& e) {
        throw InputError(who + e.what() + ", or let --heal guess what it encloses");
    }
    cage::Options how = options.cage;
    how.crossings = cage::Crossings::allowed;  // looked for above
    try {
        made.cage = cage::make_cage(wrapped.surface, how, progress);
    } catch (const InputError& e) {
        throw InputError(who + e.what());
    }
    made.surface_points = wrapped.surface.points.size();
    made.surface_triangles = wrapped.surface.triangles.size();
    made.surface_area = quality::measure_surface(wrapped.surface).area;
    made.surface_volume = std::abs(volume(wrapped.surface));
    made.notes = notes_of(made.cage);
    if (!made.cage.enclosure.enclosed())
        made.broken_promises.push_back("does not enclose the surface: " +
                                       made.cage.enclosure.where);
    return made;
}

std::vector<meshfiles::NpzArray> arrays_of(const cage::Embedding& embedding,
                                           const TriMesh& surface) {
    std::vector<double> points, weights;
    std::vector<std::int32_t> triangles, corners;
    for (const Vec3& p : surface.points) points.insert(points.end(), p.begin(), p.end());
    for (const Triangle& t : surface.triangles)
        triangles.insert(triangles.end(), t.begin(), t.end());
    for (const Tet& t : embedding.corners) corners.insert(corners.end(), t.begin(), t.end());
    for (const cage::Weights& w : embedding.weights)
        weights.insert(weights.end(), w.begin(), w.end());
    return {{"points", 3, std::move(points)},
            {"triangles", 3, std::move(triangles)},
            {"tetrahedra", 1, embedding.tets},
            {"corners", 4, std::move(corners)},
            {"weights", 4, std::move(weights)}};
}

void write_tissue(CageTissue& made, const Wrapped& wrapped, const std::string& before,
                  const CageJobOptions& options, OutputFolder& out) {
    if (!made.broken_promises.empty() || (!made.cage.reached() && !options.write_unreached)) return;
    TetMesh mesh = made.cage.mesh;
    mesh.labels.assign(mesh.tets.size(), made.tissue.label);
    const auto write = [&](const std::string& name, const auto& how) {
        out.write(before + name, how);
        made.files.push_back(before + name);
    };
    const cage::Embedding embedding = cage::embed(mesh, wrapped.surface.points);
    write("embedding.npz", [&](const std::filesystem::path& file) {
        meshfiles::write_npz(arrays_of(embedding, wrapped.surface), file);
    });
    write("cage_surface.stl", [&](const std::filesystem::path& file) {
        meshfiles::write_stl(boundary_surface(mesh), file);
    });
    const meshfiles::NamedMesh named =
        meshfiles::with_named_boundary(mesh, {{made.tissue.label, made.tissue.name}});
    for (const std::string& format : options.formats) {
        const std::string name = before + "cage." + format;
        const auto files = meshfiles::files_of(name);
        write(files.front().string().substr(before.size()),
              [&](std::filesystem::path file) { write_mesh(named, file.replace_filename(name)); });
        for (std::size_t f = 1; f < files.size(); ++f)
            write(files[f].string().substr(before.size()), [](const std::filesystem::path&) {});
    }
}

RunFacts describe(const CageJobOptions& options, const Source& source) {
    RunFacts facts = describe_level_sets(options.source.scan, options.source.level_sets,
                                         source.stock.scan, source.stock.sets);
    facts.output = options.source.output.string();
    facts.options_number.emplace_back("cell_mm", options.cage.cell);
    facts.options_number.emplace_back("tets", static_cast<double>(options.cage.tets));
    facts.options_number.emplace_back("offset_ratio", options.cage.offset_ratio);
    facts.options_number.emplace_back("angle_deg", options.cage.angle_deg);
    facts.options_number.emplace_back("max_angle_deg", options.cage.max_angle_deg);
    facts.options_number.emplace_back("max_aspect_ratio", options.cage.max_aspect_ratio);
    facts.options_number.emplace_back("tries", options.cage.tries);
    facts.options_number.emplace_back("seed", static_cast<double>(options.cage.seed));
    return facts;
}

}  // namespace

CageReport run_cage_job(const CageJobOptions& options, ProgressSink& progress) {
    options.cage.validate();
    const ThreadLimit limit(options.source.threads);
    OutputFolder out(options.source.output);
    std::map<std::string, double> seconds;
    Stopwatch watch;
    progress.report("surface", 0);
    const Source source = read_source(options, progress);
    progress.check();
    seconds["surface"] = watch.lap();

    CageReport report{.run = describe(options, source)};
    for (const Wrapped& wrapped : source.surfaces) {
        if (report.stopped) break;
        report.tissues.push_back(make_tissue(wrapped, source.crossings, options, progress));
        report.stopped = progress.interrupted();
        for (const std::string& note : report.tissues.back().notes)
            progress.warn(wrapped.tissue.name + ": " + note);
    }
    seconds["cage"] = watch.lap();
    for (std::size_t i = 0; i < report.tissues.size(); ++i) {
        const Tissue& t = report.tissues[i].tissue;
        const std::string before =
            source.surfaces.size() == 1 ? "" : file_stem(t.layer, t.label, t.name) + "_";
        write_tissue(report.tissues[i], source.surfaces[i], before, options, out);
    }
    seconds["write"] = watch.lap();
    report.run.seconds = seconds;
    note_costs(report.run);
    write_report(out, report);
    out.keep();
    return report;
}

}  // namespace myotet::app
