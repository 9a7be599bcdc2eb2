// SPDX-License-Identifier: Apache-2.0
#include "SurfaceJob.h"

#include <algorithm>
#include <set>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Core/Sha256.h"
#include "Core/Stopwatch.h"
#include "LevelSet/Extract.h"
#include "Machine.h"
#include "MeshFiles/MeshFiles.h"
#include "Outputs.h"
#include "Quality/Quality.h"
#include "Sizing.h"
#include "TrimSolid.h"

namespace myotet::app {
namespace {

using levelset::Region;
using surface::Cut;

// Samples along a mesh's edge for its level set, and along an edge of the
// result for a trimming surface's.
constexpr double kSamplesAlongEdge = 3;
// The smallest edge, unless said, in edges and in samples.
constexpr double kFinestPart = 0.25, kFinestSamples = 0.5;

/// All that the surfaces are made from, whatever the input was.
struct Stock {
    Scan scan;
    TissueSets sets;
    std::vector<TriMesh> starts;  ///< one a region
    double edge_length = 0;       ///< mm
    std::optional<TrimSolid> trim;
};

TetMesh part_of(const TetMesh& mesh, std::int32_t label) {
    TetMesh part;
    part.points = mesh.points;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        if (mesh.labels[t] == label) part.tets.push_back(mesh.tets[t]);
    return part;
}

void require_known_options(const ScanOptions& scan, const LevelSetChoices& choices) {
    if (!scan.labels.empty() || !scan.reading.names.empty() || scan.close_gaps > 0 || scan.heal ||
        !scan.input_unit.empty() || !choices.repair.empty())
        throw InputError(scan.input.string() +
                         ": is a tetrahedral mesh, for which --labels, --names, --close-gaps, "
                         "--heal, --input-unit and --repair mean nothing; leave them out");
}

/// The scan's part that a report needs: tissues are the labels of the mesh.
Stock stock_of_mesh(const SurfaceJobOptions& options, ProgressSink& progress) {
    require_known_options(options.scan, options.level_sets);
    const meshfiles::NamedMesh named = meshfiles::read_mesh(options.scan.input);
    const TetMesh& mesh = named.mesh;
    Stock stock;
    stock.edge_length =
        options.edge_length > 0 ? options.edge_length : quality::boundary_edge_lengths(mesh).median;
    LevelSetChoices choices = options.level_sets;
    if (!(choices.spacing > 0)) choices.spacing = stock.edge_length / kSamplesAlongEdge;
    for (const std::int32_t label : std::set(mesh.labels.begin(), mesh.labels.end())) {
        const auto name = named.names.find(label);
        Scan one;
        one.input = options.scan.input;
        one.surface = boundary_surface(part_of(mesh, label));
        one.tissues = {
            {.label = label,
             .name = name != named.names.end() ? name->second : options.scan.input.stem().string(),
             .volume = std::abs(volume(*one.surface))}};
        stock.starts.push_back(*one.surface);
        TissueSets made = make_level_sets(one, choices, progress);
        stock.sets.sets.spacing = made.sets.spacing;
        stock.sets.sets.smooth = made.sets.smooth;
        stock.sets.sets.regions.push_back(std::move(made.sets.regions.front()));
        stock.sets.tissues.push_back(made.tissues.front());
        stock.scan.tissues.push_back(made.tissues.front());
    }
    stock.scan.input = options.scan.input;
    stock.scan.sha256 = sha256_of_file(options.scan.input);
    if (!options.trim.empty()) stock.trim = read_trim(options.trim, {});
    return stock;
}

void extract_starts(Stock& stock) {
    const std::vector<Region>& regions = stock.sets.sets.regions;
    stock.starts.resize(regions.size());
    parallel_for(0, regions.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t r = first; r < last; ++r)
            stock.starts[r] = levelset::extract_surface(regions[r].phi);
    });
}

Stock stock_of_scan(const SurfaceJobOptions& options, ProgressSink& progress) {
    Stock stock;
    stock.scan = read_scan(options.scan);
    tell(stock.scan, progress);
    const meshing::Options sizes = choose_sizes({.edge_length = options.edge_length}, stock.scan);
    stock.edge_length = sizes.edge_length;
    LevelSetChoices choices = options.level_sets;
    if (stock.scan.surface && !(choices.spacing > 0))
        choices.spacing = level_set_spacing(sizes, stock.scan);
    // A tissue that trims needs a level set, but is no result unless asked for.
    const std::vector<Tissue> asked = asked_tissues(stock.scan);
    // A recipe may make the tissue: then it is known only afterwards.
    std::span<const Tissue> named;
    if (!stock.scan.surface) named = stock.scan.tissues;
    const bool later = !choices.repair.empty() && !tissue_named(options.trim, named);
    if (!options.trim.empty() && !later) stock.trim = read_trim(options.trim, named);
    if (stock.trim && stock.trim->tissue)
        for (Tissue& tissue : stock.scan.tissues)
            tissue.asked |= tissue.layer == stock.trim->tissue->layer &&
                            tissue.label == stock.trim->tissue->label;
    stock.sets = make_level_sets(stock.scan, choices, progress);
    if (!options.trim.empty() && later) stock.trim = read_trim(options.trim, stock.sets.tissues);
    std::erase_if(stock.sets.tissues, [&](const Tissue& t) {
        const auto same = [&](const Tissue& a) { return a.layer == t.layer && a.label == t.label; };
        const bool trims = stock.trim && stock.trim->tissue && same(*stock.trim->tissue);
        return std::ranges::none_of(asked, same) &&
               (trims || std::ranges::any_of(stock.scan.tissues, same));
    });
    extract_starts(stock);
    return stock;
}

/// The trim as one tissue is cut by it; a tissue does not trim itself.
surface::Field trim_for(const Stock& stock, const Tissue& tissue, const surface::Field& trim) {
    const bool itself = stock.trim && stock.trim->tissue &&
                        stock.trim->tissue->layer == tissue.layer &&
                        stock.trim->tissue->label == tissue.label;
    return itself ? surface::Field{} : trim;
}

/// Several regions of a tissue: cut when some of it goes and some stays.
Cut together(const std::vector<surface::Result>& results) {
    const auto all = [&](Cut cut) {
        return std::ranges::all_of(results, [&](const auto& r) { return r.cut == cut; });
    };
    return all(Cut::none) ? Cut::none : all(Cut::everything) ? Cut::everything : Cut::some;
}

struct Made {
    SurfaceTissue report;
    TriMesh mesh;  ///< local coordinates
};

Made make_tissue(const Stock& stock, const Tissue& tissue, const surface::Field& trim,
                 const surface::Options& options, ProgressSink& progress) {
    std::vector<std::size_t> numbers;
    std::vector<const levelset::LevelSet*> phis;
    const std::vector<Region>& regions = stock.sets.sets.regions;
    for (std::size_t r = 0; r < regions.size(); ++r)
        if (belongs(regions[r], tissue)) {
            numbers.push_back(r);
            phis.push_back(&regions[r].phi);
        }
    std::vector<surface::Result> results(numbers.size());
    parallel_for(0, numbers.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            results[i] =
                surface::make_surface(stock.starts[numbers[i]],
                                      {.phi = field_of(*phis[i]), .trim = trim}, options, progress);
    });
    Made made{.report = {.tissue = tissue, .components = static_cast<int>(numbers.size())}};
    for (const surface::Result& r : results) {
        const auto first = static_cast<std::int32_t>(made.mesh.points.size());
        made.mesh.points.insert(made.mesh.points.end(), r.mesh.points.begin(), r.mesh.points.end());
        for (const Triangle& t : r.mesh.triangles)
            made.mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    SurfaceTissue& report = made.report;
    report.cut = together(results);
    report.quality = surface::measure(made.mesh, {.phi = field_of(phis), .trim = trim});
    if (made.mesh.triangles.empty())
        report.notes.emplace_back("the trim discards all of it; nothing was written");
    else
        report.notes = surface::shortfalls(report.quality);
    report.broken_promises = surface::broken_promises(report.quality);
    return made;
}

std::vector<Made> make_tissues(const Stock& stock, const SurfaceJobOptions& asked,
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

void write_tissue(Made& made, const Stock& stock, const std::string& format, OutputFolder& out) {
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

RunFacts describe(const SurfaceJobOptions& options, const Stock& stock) {
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
    const bool mesh = options.scan.input.extension() == ".vtu";
    Stock stock = mesh ? stock_of_mesh(options, progress) : stock_of_scan(options, progress);
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
    report.run.peak_memory = peak_memory();
    report.run.processor_seconds = processor_seconds();
    out.write("report.json",
              [&](const std::filesystem::path& file) { write_atomically(file, to_json(report)); });
    progress.check();
    out.keep();
    return report;
}

}  // namespace myotet::app
