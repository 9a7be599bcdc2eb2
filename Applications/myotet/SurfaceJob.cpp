// SPDX-License-Identifier: Apache-2.0
#include "SurfaceJob.h"

#include <algorithm>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Core/Stopwatch.h"
#include "Costs.h"
#include "MeshFiles/MeshFiles.h"
#include "Outputs.h"
#include "SoftParts.h"
#include "Surface/Crossings.h"
#include "SurfaceStock.h"

namespace myotet::app {
namespace {

using levelset::Region;
using surface::Cut;

// The smallest edge, unless said, in edges and in samples.
constexpr double kFinestPart = 0.25, kFinestSamples = 0.5;

/// The trim as one tissue is cut by it; a tissue does not trim itself.
surface::Field trim_for(const SurfaceStock& stock, const Tissue& tissue,
                        const surface::Field& trim) {
    const bool itself = stock.trim && stock.trim->tissue &&
                        stock.trim->tissue->layer == tissue.layer &&
                        stock.trim->tissue->label == tissue.label;
    return itself ? surface::Field{} : trim;
}

/// Several regions of a tissue: cut when some of it goes and some stays.
Cut together(const std::vector<SoftSurface>& parts) {
    const auto all = [&](Cut cut) {
        return std::ranges::all_of(parts, [&](const auto& p) { return p.made.cut == cut; });
    };
    return all(Cut::none) ? Cut::none : all(Cut::everything) ? Cut::everything : Cut::some;
}

/// Where two regions of a tissue touch, the lower level set there is the other's:
/// a region's triangles and points are held to its own.
void hold_each_to_its_own(const std::vector<SoftSurface>& parts, surface::Quality& whole) {
    whole.triangles_turned_over = 0;
    whole.points_off = whole.boundary_off_in_edges = 0;
    for (const SoftSurface& part : parts) {
        const surface::Quality& q = part.made.quality;
        whole.triangles_turned_over += q.triangles_turned_over;
        whole.points_off = std::max(whole.points_off, q.points_off);
        whole.boundary_off_in_edges =
            std::max(whole.boundary_off_in_edges, q.boundary_off_in_edges);
    }
}

/// What smoothing necks did to a tissue.
void add_softening(const std::vector<SoftSurface>& parts, SurfaceTissue& report) {
    int before = 0, after = 0;
    for (const SoftSurface& part : parts) {
        report.softened_places += part.places;
        report.softened_by = std::max(report.softened_by, part.moved);
        before += part.parts_before;
        after += part.parts_after;
    }
    if (before != after)
        report.notes.push_back("necks or slits thinner than a sample were smoothed away; of " +
                               std::to_string(before) + " closed surfaces came " +
                               std::to_string(after));
}

struct Made {
    SurfaceTissue report;
    TriMesh mesh;  ///< local coordinates
};

/// All regions of a tissue, each with what it is held by, as one.
Made join_parts(const Tissue& tissue, const std::vector<SoftSurface>& parts,
                const std::vector<const levelset::LevelSet*>& phis, const surface::Field& trim) {
    Made made{.report = {.tissue = tissue, .components = static_cast<int>(parts.size())}};
    for (const SoftSurface& part : parts) surface::append(made.mesh, part.made.mesh);
    SurfaceTissue& report = made.report;
    report.cut = together(parts);
    report.quality = surface::measure(made.mesh, {.phi = field_of(phis), .trim = trim});
    hold_each_to_its_own(parts, report.quality);
    if (made.mesh.triangles.empty())
        report.notes.emplace_back("the trim discards all of it; nothing was written");
    else
        report.notes = surface::shortfalls(report.quality);
    add_softening(parts, report);
    report.broken_promises = surface::broken_promises(report.quality);
    return made;
}

Made make_tissue(const SurfaceStock& stock, const Tissue& tissue, const surface::Field& trim,
                 const surface::Options& options, ProgressSink& progress) {
    std::vector<std::size_t> numbers;
    const std::vector<Region>& regions = stock.sets.sets.regions;
    for (std::size_t r = 0; r < regions.size(); ++r)
        if (belongs(regions[r], tissue)) numbers.push_back(r);
    std::vector<Part> given;
    for (const std::size_t r : numbers)
        given.push_back({stock.starts[r], regions[r].phi, trim, {}});
    const std::vector<SoftSurface> parts = make_soft_parts(given, options, progress);
    std::vector<const levelset::LevelSet*> phis;
    for (std::size_t i = 0; i < parts.size(); ++i)
        phis.push_back(parts[i].softened ? &*parts[i].softened : &regions[numbers[i]].phi);
    return join_parts(tissue, parts, phis, trim);
}

std::vector<Made> make_tissues(const SurfaceStock& stock, const SurfaceJobOptions& asked,
                               ProgressSink& progress) {
    const double finest = std::min(
        stock.edge_length,
        std::max(kFinestPart * stock.edge_length, kFinestSamples * stock.sets.sets.spacing));
    const surface::Options options{.edge_length = stock.edge_length,
                                   .smallest_edge_length = asked.smallest_edge_length > 0
                                                               ? asked.smallest_edge_length
                                                               : finest,
                                   .pieces = asked.pieces};
    options.validate();
    surface::Field trim;
    if (stock.trim)
        trim = surface::offset(
            trim_field(*stock.trim, stock.sets, stock.edge_length / kSamplesAlongEdge, progress),
            asked.trim_offset);
    const std::vector<Tissue>& tissues = stock.sets.tissues;
    std::vector<Made> made(tissues.size());
    parallel_for(0, tissues.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t)
            made[t] = make_tissue(stock, tissues[t], trim_for(stock, tissues[t], trim), options,
                                  progress);
    });
    return made;
}

void require_a_cut(const std::vector<Made>& made, const SurfaceJobOptions& options) {
    const auto all = [&](Cut cut) {
        return std::ranges::all_of(made, [&](const Made& m) { return m.report.cut == cut; });
    };
    const std::string where = "--trim " + options.trim + ": ";
    const std::string of = options.scan.input.string();
    if (all(Cut::everything))
        throw InputError(where + "discards everything of " + of +
                         "; what lies inside the trimming solid goes, behind its plane for "
                         "x,y,z,nx,ny,nz: turn it round or move it");
    if (all(Cut::none))
        throw InputError(where + "discards nothing of " + of +
                         "; it does not reach inside the surface asked for (coordinates are LPS, "
                         "mm): move it or leave it out");
}

void write_surface(const TriMesh& mesh, const Tissue& tissue, const std::string& format,
                   const std::filesystem::path& path) {
    if (format == "stl") return meshfiles::write_stl(mesh, path);
    if (format == "vtk") return meshfiles::write_vtk(mesh, path);
    if (format == "vtp") return meshfiles::write_vtp(mesh, {{tissue.label, tissue.name}}, path);
    meshfiles::NamedMesh named;
    named.mesh.points = mesh.points;
    named.names = {{tissue.label, tissue.name}};
    named.faces = {{.name = tissue.name, .tag = tissue.label, .triangles = mesh.triangles}};
    meshfiles::write_mesh(named, path);
}

void write_tissue(Made& made, const SurfaceStock& stock, const std::string& format,
                  OutputFolder& out) {
    SurfaceTissue& report = made.report;
    if (made.mesh.triangles.empty() || !report.broken_promises.empty()) return;
    for (Vec3& p : made.mesh.points) p = stock.sets.sets.frame.to_lps(p);
    const Tissue& tissue = report.tissue;
    const std::string file = file_stem(tissue.layer, tissue.label, tissue.name) + "." + format;
    out.write(file, [&](const std::filesystem::path& path) {
        write_surface(made.mesh, tissue, format, path);
    });
    report.files = {file};
}

RunFacts describe(const SurfaceJobOptions& options, const SurfaceStock& stock) {
    RunFacts facts = describe_level_sets(options.scan, options.level_sets, stock.scan, stock.sets);
    facts.output = options.output.string();
    facts.options_text.emplace_back("trim", options.trim);
    facts.options_number.emplace_back("edge_length_mm", stock.edge_length);
    facts.options_number.emplace_back("trim_offset_mm", options.trim_offset);
    facts.options_number.emplace_back("pieces", options.pieces);
    return facts;
}

}  // namespace

SurfaceReport run_surface_job(const SurfaceJobOptions& options, ProgressSink& progress) {
    const ThreadLimit limit(options.threads);
    OutputFolder out(options.output);
    std::map<std::string, double> seconds;
    Stopwatch watch;

    progress.report("level sets", 0);
    SurfaceStock stock = take_stock(options, progress);
    stock.scan.layers.clear();
    progress.check();
    seconds["level_sets"] = watch.lap();

    std::vector<Made> made = make_tissues(stock, options, progress);
    if (stock.trim) require_a_cut(made, options);
    seconds["surface"] = watch.lap();

    SurfaceReport report{.run = describe(options, stock)};
    for (Made& m : made) {
        progress.check();
        write_tissue(m, stock, options.format, out);
        for (const std::string& note : m.report.notes)
            progress.warn(m.report.tissue.name + ": " + note);
        report.tissues.push_back(std::move(m.report));
    }
    seconds["write"] = watch.lap();

    report.run.seconds = seconds;
    note_costs(report.run);
    write_report(out, report);
    progress.check();
    out.keep();
    return report;
}

}  // namespace myotet::app
