// SPDX-License-Identifier: Apache-2.0
#include "SurfaceStock.h"

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Core/Sha256.h"
#include "InputKind.h"
#include "LevelSet/Extract.h"
#include "LevelSet/Measure.h"
#include "LevelSet/ReadVdb.h"
#include "MeshFiles/MeshFiles.h"
#include "Quality/Quality.h"
#include "Sizing.h"

namespace myotet::app {
namespace {

using levelset::Region;

void refuse_what_labels_need(const SurfaceJobOptions& options, std::vector<std::string> given,
                             const std::string& what) {
    if (options.scan.heal) given.emplace_back("--heal");
    if (!options.level_sets.repair.empty()) given.emplace_back("--repair");
    if (options.level_sets.smoothing != levelset::Smoothing::curvature)
        given.emplace_back("--smoothing");
    refuse_options(given, options.scan.input, what);
}

bool is_manifold(const TriMesh& surface) {
    const quality::SurfaceShape shape = quality::measure_surface(surface);
    return shape.boundary_edges + shape.non_manifold_edges + shape.non_manifold_vertices == 0;
}

void add_label(SurfaceStock& stock, const Scan& one, const LevelSetChoices& choices,
               ProgressSink& progress) {
    TissueSets made = make_level_sets(one, choices, progress);
    Region& region = made.sets.regions.front();
    // Where parts touch in an edge or a point, the level set still is a manifold.
    stock.starts.push_back(is_manifold(*one.surface) ? *one.surface
                                                     : levelset::extract_surface(region.phi));
    stock.sets.sets.spacing = made.sets.spacing;
    stock.sets.sets.smooth = made.sets.smooth;
    stock.sets.sets.regions.push_back(std::move(region));
    stock.sets.tissues.push_back(made.tissues.front());
}

/// The scan's part that a report needs: tissues are the labels of the mesh.
SurfaceStock stock_of_mesh(const SurfaceJobOptions& options, ProgressSink& progress) {
    const std::filesystem::path& file = options.scan.input;
    std::vector<std::string> given = label_options_given(options.scan);
    if (!options.scan.input_unit.empty()) given.emplace_back("--input-unit");
    refuse_what_labels_need(options, given, "a tetrahedral mesh, for which that means nothing");
    const meshfiles::NamedMesh named = meshfiles::read_mesh(file);
    const TetMesh& mesh = named.mesh;
    SurfaceStock stock;
    stock.scan.input_unit = "mm";
    stock.edge_length =
        options.edge_length > 0 ? options.edge_length : quality::boundary_edge_lengths(mesh).median;
    LevelSetChoices choices = options.level_sets;
    if (!(choices.spacing > 0)) choices.spacing = stock.edge_length / kSamplesAlongEdge;
    for (const auto& [label, tets] : meshfiles::tets_by_label(mesh)) {
        const auto name = named.names.find(label);
        Scan one;
        one.input = file;
        one.surface = outer_surface(mesh, tets);
        one.tissues = {{.label = label,
                        .name = name != named.names.end() ? name->second : file.stem().string(),
                        .volume = std::abs(volume(*one.surface))}};
        add_label(stock, one, choices, progress);
    }
    if (!options.trim.empty()) stock.trim = read_trim(options.trim, {});
    return stock;
}

/// Regions of one frame, which all grids of the file must lie straight in.
void add_regions(SurfaceStock& stock, levelset::VdbFile&& file, const SurfaceJobOptions& options) {
    constexpr double kTurned = 1e-6;  // of an axis: a thousandth of a millimetre at a metre
    levelset::LabelLevelSets& sets = stock.sets.sets;
    sets.frame = file.level_sets.front().frame;
    sets.spacing = file.level_sets.front().phi.spacing;
    for (levelset::VdbLevelSet& set : file.level_sets) {
        if (!((set.frame.rotation - sets.frame.rotation).cwiseAbs().maxCoeff() < kTurned))
            throw InputError(options.scan.input.string() + ": grids '" +
                             file.level_sets.front().name + "' and '" + set.name +
                             "' are turned against each other; give each a file of its own");
        set.phi.origin = sets.frame.to_local(set.frame.to_lps(set.phi.origin));
        sets.spacing = std::min(sets.spacing, set.phi.spacing);
        Region region{.label = set.label, .phi = std::move(set.phi)};
        region.volume_level_set = levelset::enclosed_volume(region.phi);
        region.inscribed_radius = levelset::inscribed_radius(region.phi);
        stock.sets.tissues.push_back(
            {.label = set.label, .name = set.name, .volume = region.volume_level_set});
        sets.regions.push_back(std::move(region));
    }
    std::ranges::sort(sets.regions, {}, &Region::label);
    std::ranges::sort(stock.sets.tissues, {}, &Tissue::label);
}

void extract_starts(SurfaceStock& stock) {
    const std::vector<Region>& regions = stock.sets.sets.regions;
    stock.starts.resize(regions.size());
    parallel_for(0, regions.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t r = first; r < last; ++r)
            stock.starts[r] = levelset::extract_surface(regions[r].phi);
    });
}

SurfaceStock stock_of_level_sets(const SurfaceJobOptions& options) {
    std::vector<std::string> given = label_options_given(options.scan);
    if (options.level_sets.smooth >= 0) given.emplace_back("--smooth");
    if (options.level_sets.spacing > 0) given.emplace_back("--spacing");
    refuse_what_labels_need(options, given, "a level set already");
    levelset::VdbFile file = levelset::read_vdb(options.scan.input, options.scan.input_unit);
    SurfaceStock stock;
    stock.scan.warnings = file.warnings;
    stock.scan.input_unit = file.unit;
    add_regions(stock, std::move(file), options);
    extract_starts(stock);
    for (std::size_t r = 0; r < stock.starts.size(); ++r)
        stock.sets.tissues[r].area = quality::measure_surface(stock.starts[r]).area;
    // Samples are as good as voxels, of which they mostly come.
    Scan like_voxels;
    like_voxels.tissues = stock.sets.tissues;
    like_voxels.spacing.setConstant(stock.sets.sets.spacing);
    stock.edge_length = choose_sizes({.edge_length = options.edge_length}, like_voxels).edge_length;
    if (!options.trim.empty()) stock.trim = read_trim(options.trim, stock.sets.tissues);
    return stock;
}

SurfaceStock stock_of_scan(const SurfaceJobOptions& options, ProgressSink& progress) {
    SurfaceStock stock;
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

}  // namespace

SurfaceStock take_stock(const SurfaceJobOptions& options, ProgressSink& progress) {
    const std::filesystem::path& file = options.scan.input;
    const InputKind kind = kind_of(file);
    if (kind == InputKind::unknown)
        throw InputError(file.string() +
                         ": its extension is not known; labels come as .nii .nii.gz .nrrd "
                         ".seg.nrrd .mha .mhd .dcm, closed surfaces as .obj .off .stl .ply .vtp, "
                         "meshes as .vtu .msh .feb .inp .bdf .nas .xdmf .mesh, level sets as .vdb");
    if (kind != InputKind::tetrahedra && kind != InputKind::level_set)
        return stock_of_scan(options, progress);
    SurfaceStock stock = kind == InputKind::tetrahedra ? stock_of_mesh(options, progress)
                                                       : stock_of_level_sets(options);
    stock.scan.input = file;
    stock.scan.sha256 = sha256_of_file(file);
    stock.scan.tissues = stock.sets.tissues;
    for (const std::string& warning : stock.scan.warnings) progress.warn(warning);
    return stock;
}

}  // namespace myotet::app
