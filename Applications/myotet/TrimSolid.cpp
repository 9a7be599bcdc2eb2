// SPDX-License-Identifier: Apache-2.0
#include "TrimSolid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <sstream>

#include "Core/Errors.h"
#include "ExitCodes.h"
#include "InputKind.h"
#include "LevelSet/FromSurface.h"
#include "LevelSet/ReadVdb.h"
#include "MeshFiles/MeshFiles.h"

namespace myotet::app {
namespace {

using surface::Field;
using surface::FieldSample;

std::optional<std::array<double, 6>> six_numbers(const std::string& text) {
    std::array<double, 6> numbers{};
    std::istringstream in(text);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        char comma = ',';
        if (!(in >> numbers[i]) || !std::isfinite(numbers[i])) return std::nullopt;
        if (i + 1 < numbers.size() && (!(in >> comma) || comma != ',')) return std::nullopt;
    }
    if (in >> std::ws && !in.eof()) return std::nullopt;
    return numbers;
}

/// A level set that the field keeps, and how its coordinates lie in the patient.
struct Placed {
    std::shared_ptr<const levelset::LevelSet> phi;
    Frame frame;
};

TriMesh whole_surface(const TetMesh& mesh) {
    std::vector<std::int32_t> all(mesh.tets.size());
    std::iota(all.begin(), all.end(), 0);
    return outer_surface(mesh, all);
}

std::vector<Placed> level_sets_in(const std::filesystem::path& file, double spacing,
                                  ProgressSink& progress) {
    std::vector<Placed> solids;
    const auto add = [&](levelset::LevelSet&& phi, const Frame& frame) {
        solids.push_back({std::make_shared<const levelset::LevelSet>(std::move(phi)), frame});
    };
    const InputKind kind = kind_of(file);
    if (kind == InputKind::level_set) {
        levelset::VdbFile made = levelset::read_vdb(file);
        for (const std::string& warning : made.warnings) progress.warn(warning);
        for (levelset::VdbLevelSet& set : made.level_sets) add(std::move(set.phi), set.frame);
    } else {
        const TriMesh surface = kind == InputKind::tetrahedra
                                    ? whole_surface(meshfiles::read_mesh(file).mesh)
                                    : meshfiles::read_surface(file);
        add(levelset::from_surface(surface, {.spacing = spacing}, progress), {});
    }
    return solids;
}

/// All that the file holds as one solid, in the local coordinates of `frame`.
Field file_field(const std::filesystem::path& file, const Frame& frame, double spacing,
                 ProgressSink& progress) {
    std::vector<Placed> solids;
    try {
        solids = level_sets_in(file, spacing, progress);
    } catch (const InputError& error) {  // which may not know the file
        throw InputError("--trim " + file.string() + ": " + error.what());
    }
    return [solids = std::move(solids), frame](const Vec3& local) {
        const Vec3 lps = frame.to_lps(local);
        FieldSample nearest{std::numeric_limits<double>::infinity(), Vec3::UnitX()};
        for (const Placed& solid : solids) {
            const levelset::Sample s = solid.phi->sample(solid.frame.to_local(lps));
            if (s.value >= nearest.value) continue;
            nearest = {s.value, frame.rotation.transpose() * (solid.frame.rotation * s.gradient)};
        }
        return nearest;
    };
}

}  // namespace

TriMesh outer_surface(const TetMesh& mesh, std::span<const std::int32_t> tets) {
    TetMesh part;
    part.points = mesh.points;
    const std::vector<Vec3>& p = mesh.points;
    for (const std::int32_t number : tets) {
        Tet t = mesh.tets[number];
        if (signed_volume(p[t[0]], p[t[1]], p[t[2]], p[t[3]]) < 0) std::swap(t[0], t[1]);
        part.tets.push_back(t);
    }
    return boundary_surface(part);
}

Field field_of(const levelset::LevelSet& phi) {
    return [&phi](const Vec3& p) {
        const levelset::Sample s = phi.sample(p);
        return FieldSample{s.value, s.gradient};
    };
}

Field field_of(std::vector<const levelset::LevelSet*> phis) {
    return [phis = std::move(phis)](const Vec3& p) {
        FieldSample nearest{std::numeric_limits<double>::infinity(), Vec3::UnitX()};
        for (const levelset::LevelSet* phi : phis) {
            const levelset::Sample s = phi->sample(p);
            if (s.value < nearest.value) nearest = {s.value, s.gradient};
        }
        return nearest;
    };
}

std::optional<Tissue> tissue_named(const std::string& text, std::span<const Tissue> tissues) {
    const auto it = std::ranges::find_if(tissues, [&](const Tissue& t) {
        return t.name == text || std::to_string(t.label) == text;
    });
    return it == tissues.end() ? std::nullopt : std::optional(*it);
}

TrimSolid read_trim(const std::string& text, std::span<const Tissue> tissues) {
    TrimSolid trim;
    trim.plane = six_numbers(text);
    if (trim.plane) {
        const auto& p = *trim.plane;
        if (!(Vec3(p[3], p[4], p[5]).norm() > 0))
            throw UsageError("--trim " + text +
                             ": the normal, the last three numbers, is zero; give its direction");
        return trim;
    }
    trim.tissue = tissue_named(text, tissues);
    if (trim.tissue) return trim;
    trim.file = text;
    std::error_code ignored;
    const InputKind kind = kind_of(trim.file);
    if (!std::filesystem::is_regular_file(trim.file, ignored) || kind == InputKind::labels ||
        kind == InputKind::unknown)
        throw UsageError("--trim " + text +
                         ": is neither x,y,z,nx,ny,nz nor a tissue of the scan nor the file of a "
                         "surface (.obj .off .stl .ply .vtp), a mesh (.vtu .msh .feb .inp .bdf "
                         ".nas .xdmf .mesh) or a level set (.vdb)");
    return trim;
}

Field trim_field(const TrimSolid& trim, const TissueSets& sets, double spacing,
                 ProgressSink& progress) {
    const Frame& frame = sets.sets.frame;
    if (trim.plane) {
        const auto& p = *trim.plane;
        return surface::half_space(frame.to_local({p[0], p[1], p[2]}),
                                   frame.rotation.transpose() * Vec3(p[3], p[4], p[5]));
    }
    if (!trim.tissue) return file_field(trim.file, frame, spacing, progress);
    std::vector<const levelset::LevelSet*> phis;
    for (const levelset::Region& region : sets.sets.regions)
        if (belongs(region, *trim.tissue)) phis.push_back(&region.phi);
    return field_of(std::move(phis));
}

}  // namespace myotet::app
