// SPDX-License-Identifier: Apache-2.0
#include "SceneShapes.h"

#include <algorithm>
#include <optional>

#include "Contraction/TissueBody.h"
#include "Core/Errors.h"
#include "LevelSet/Extract.h"
#include "LevelSetStage.h"
#include "MeshFiles/MeshFiles.h"
#include "Scan.h"
#include "Sizing.h"

namespace myotet::app {
namespace {

using contraction::Body;
using contraction::Bone;
using contraction::Named;
using contraction::Scene;
using contraction::TissuePieces;
using levelset::Region;

// The scene's label volume, as level sets.
struct Volume {
    TissueSets sets;
    meshing::Options sizes;
    std::map<std::int32_t, std::string> names;
};

Volume read_volume(const contraction::Labels& labels, ProgressSink& progress) {
    ScanOptions options;
    options.input = labels.file;
    options.reading.names = labels.names;
    options.close_gaps = labels.close_gaps;
    progress.report("reading", 0);
    const Scan scan = read_scan(options);
    tell(scan, progress);
    if (scan.surface)
        throw InputError(labels.file.string() +
                         " is a surface, but 'labels' wants a label volume; name a surface under "
                         "'bones', or mesh it first for a body");
    LevelSetChoices choices;
    choices.smoothing = labels.smoothing;
    choices.repair = labels.repair;
    Volume volume;
    volume.sizes = choose_sizes({.edge_length = labels.edge_length}, scan);
    volume.sizes.compression = {labels.compression};
    volume.sets = make_level_sets(scan, choices, progress);
    for (const Tissue& tissue : volume.sets.tissues) volume.names[tissue.label] = tissue.name;
    return volume;
}

TissuePieces pieces_of(const Scene& scene, const Named& word, const Volume& volume) {
    TissuePieces tissue;
    tissue.label = contraction::find_label(scene, word, volume.names);
    tissue.name = volume.names.at(tissue.label);
    for (const Region& region : volume.sets.sets.regions)
        if (region.label == tissue.label) tissue.pieces.push_back(&region.phi);
    if (tissue.pieces.empty())
        contraction::refuse(scene, word.line, "the tissue " + tissue.name + " has no volume left");
    return tissue;
}

meshfiles::NamedMesh mesh_of_body(const Scene& scene, const Body& body, const Volume& volume,
                                  std::vector<std::string>& notes, ProgressSink& progress) {
    std::vector<TissuePieces> tissues;
    for (const Named& word : body.tissues) tissues.push_back(pieces_of(scene, word, volume));
    std::vector<std::string> said;
    try {
        auto mesh = contraction::mesh_of_tissues(tissues, volume.sets.sets.frame, volume.sizes,
                                                 said, progress);
        for (const std::string& note : said) notes.push_back(body.name + ": " + note);
        return mesh;
    } catch (const MeshError& error) {
        contraction::refuse(scene, body.line, body.name + " cannot be meshed: " + error.what());
    }
}

TriMesh surface_of(const TissuePieces& tissue, const Frame& frame) {
    TriMesh whole;
    for (const levelset::LevelSet* piece : tissue.pieces) {
        const TriMesh part = levelset::extract_surface(*piece);
        const auto first = static_cast<std::int32_t>(whole.points.size());
        for (const Vec3& p : part.points) whole.points.push_back(frame.to_lps(p));
        for (const Triangle& t : part.triangles)
            whole.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return whole;
}

void add_bone(const Scene& scene, const Bone& bone, const std::optional<Volume>& volume,
              LoadedShapes& loaded) {
    if (bone.tissue.name.empty()) {
        loaded.shapes.bone_surfaces.push_back(
            bone.surface.empty() ? boundary_surface(meshfiles::read_mesh(bone.mesh).mesh)
                                 : meshfiles::read_surface(bone.surface));
        loaded.shapes.bones.push_back(
            contraction::bone_of_surface(bone.name, loaded.shapes.bone_surfaces.back()));
        return;
    }
    const TissuePieces tissue = pieces_of(scene, bone.tissue, *volume);
    loaded.shapes.bone_surfaces.push_back(surface_of(tissue, volume->sets.sets.frame));
    std::vector<levelset::LevelSet> pieces;
    for (const levelset::LevelSet* piece : tissue.pieces) pieces.push_back(*piece);
    loaded.shapes.bones.push_back(
        contraction::bone_of_level_sets(bone.name, std::move(pieces), volume->sets.sets.frame));
}

}  // namespace

LoadedShapes load_shapes(const Scene& scene, ProgressSink& progress) {
    std::optional<Volume> volume;
    if (scene.labels) volume = read_volume(*scene.labels, progress);
    LoadedShapes loaded;
    for (const Body& body : scene.bodies)
        loaded.shapes.bodies.push_back(
            body.mesh.empty() ? mesh_of_body(scene, body, *volume, loaded.notes, progress)
                              : meshfiles::read_mesh(body.mesh));
    for (const Bone& bone : scene.bones) add_bone(scene, bone, volume, loaded);
    return loaded;
}

}  // namespace myotet::app
