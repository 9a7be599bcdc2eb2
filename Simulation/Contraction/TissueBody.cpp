// SPDX-License-Identifier: Apache-2.0
#include "Contraction/TissueBody.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "Contraction/Words.h"
#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "LevelSet/Csg.h"
#include "LevelSet/CsgPieces.h"
#include "LevelSet/Measure.h"

namespace myotet::contraction {
namespace {

// Of what was united, the largest connected piece.
levelset::Band largest_piece(const levelset::Band& whole, std::vector<std::string>& notes) {
    const levelset::Band framed = levelset::settle(whole);
    const levelset::Pieces pieces = levelset::find_pieces(framed, levelset::Side::inside);
    if (pieces.volume.empty()) throw MeshError("the tissues have no volume");
    if (pieces.volume.size() == 1) return framed;
    double left_out = 0;
    for (std::size_t p = 1; p < pieces.volume.size(); ++p) left_out += pieces.volume[p];
    notes.push_back(std::to_string(pieces.volume.size() - 1) +
                    " pieces that touch nothing of the body, " + shown(std::round(left_out)) +
                    " mm^3 in all, are left out");
    std::vector<char> others(pieces.volume.size(), 1);
    others[0] = 0;
    return levelset::flip_pieces(framed, pieces, others);
}

levelset::LevelSet unite_all(const std::vector<TissuePieces>& tissues,
                             std::vector<std::string>& notes) {
    std::optional<levelset::Band> whole;
    for (const TissuePieces& tissue : tissues)
        for (const levelset::LevelSet* piece : tissue.pieces) {
            levelset::Band band = levelset::to_band(*piece);
            whole = whole ? levelset::unite(*whole, band) : std::move(band);
        }
    if (!whole) throw MeshError("the body has no tissue");
    return levelset::assemble(largest_piece(*whole, notes));
}

// The tissue whose level set is least there.
std::vector<std::int32_t> labels_of(const TetMesh& mesh, const std::vector<TissuePieces>& tissues) {
    constexpr std::size_t kGrain = 1024;
    std::vector<std::int32_t> labels(mesh.tets.size());
    parallel_for(0, labels.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t) {
            Vec3 centre = Vec3::Zero();
            for (const std::int32_t n : mesh.tets[t]) centre += 0.25 * mesh.points[n];
            double least = std::numeric_limits<double>::infinity();
            for (const TissuePieces& tissue : tissues)
                for (const levelset::LevelSet* piece : tissue.pieces) {
                    const double phi = piece->value(centre);
                    if (!(phi < least)) continue;
                    least = phi;
                    labels[t] = tissue.label;
                }
        }
    });
    return labels;
}

}  // namespace

meshfiles::NamedMesh mesh_of_tissues(const std::vector<TissuePieces>& tissues, const Frame& frame,
                                     meshing::Options options, std::vector<std::string>& notes,
                                     ProgressSink& progress) {
    const levelset::LevelSet phi = unite_all(tissues, notes);
    options.components = 1;
    options.volume = levelset::enclosed_volume(phi);
    meshing::Result meshed = meshing::mesh_level_set(phi, options, progress);
    notes.insert(notes.end(), meshed.summary.notes.begin(), meshed.summary.notes.end());
    meshed.mesh.labels = labels_of(meshed.mesh, tissues);
    for (Vec3& p : meshed.mesh.points) p = frame.to_lps(p);
    std::map<std::int32_t, std::string> names;
    for (const TissuePieces& tissue : tissues) names[tissue.label] = tissue.name;
    return meshfiles::with_named_boundary(std::move(meshed.mesh), std::move(names));
}

}  // namespace myotet::contraction
