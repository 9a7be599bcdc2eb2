// SPDX-License-Identifier: Apache-2.0
#include "SoftParts.h"

#include <algorithm>

#include "Core/Parallel.h"
#include "Surface/Crossings.h"
#include "TrimSolid.h"

namespace myotet::app {
namespace {

constexpr int kRounds = 3;  // of making parts again; later ones where more cross than before

/// A tissue's parts on their way.
struct Parts {
    std::span<const Part> parts;
    std::vector<SoftSurface> made;
    std::vector<char> waits;  ///< to be made again: its start stands for it
    [[nodiscard]] const TriMesh& mesh(std::size_t i) const {
        return waits[i] ? parts[i].start : made[i].made.mesh;
    }
    [[nodiscard]] const levelset::LevelSet& phi(std::size_t i) const {
        return made[i].softened && !waits[i] ? *made[i].softened : parts[i].phi;
    }
};

/// Marks the parts of which triangles cross another's; whether any are new.
bool mark_crossing(const Parts& tissue, std::vector<char>& again) {
    if (tissue.made.size() < 2) return false;
    TriMesh all;
    std::vector<std::size_t> owner;
    for (std::size_t i = 0; i < tissue.made.size(); ++i) {
        const TriMesh& mesh = tissue.made[i].made.mesh;
        surface::append(all, mesh);
        owner.insert(owner.end(), mesh.triangles.size(), i);
    }
    bool more = false;
    for (const auto& [a, b] : surface::crossings(all.points, all.triangles)) {
        if (owner[a] == owner[b]) continue;
        more |= !again[owner[a]] || !again[owner[b]];
        again[owner[a]] = again[owner[b]] = 1;
    }
    return more;
}

bool meet(const Box& a, const Box& b) {
    return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

/// Adds the triangles that meet a box, each with points of its own; whether any do.
bool add_near(const TriMesh& mesh, const Box& box, TriMesh& near) {
    const std::size_t before = near.triangles.size();
    for (const Triangle& t : mesh.triangles) {
        Box own;
        for (const std::int32_t v : t) own.include(mesh.points[v]);
        if (!meet(own, box)) continue;
        const auto first = static_cast<std::int32_t>(near.points.size());
        for (const std::int32_t v : t) near.points.push_back(mesh.points[v]);
        near.triangles.push_back({first, first + 1, first + 2});
    }
    return near.triangles.size() > before;
}

/// What lies within `reach` of the box of part i.
surface::Beside beside(const Parts& tissue, std::size_t i, double reach) {
    Box box;
    for (const Vec3& p : tissue.parts[i].start.points) box.include(p);
    box.min -= Vec3::Constant(reach);
    box.max += Vec3::Constant(reach);
    surface::Beside beside;
    std::vector<const levelset::LevelSet*> phis;
    for (std::size_t j = 0; j < tissue.parts.size(); ++j)
        if (j != i && add_near(tissue.mesh(j), box, beside.mesh)) phis.push_back(&tissue.phi(j));
    if (!phis.empty()) beside.phi = field_of(std::move(phis));
    return beside;
}

}  // namespace

std::vector<SoftSurface> make_soft_parts(std::span<const Part> parts,
                                         const surface::Options& options, ProgressSink& progress) {
    Parts tissue{.parts = parts,
                 .made = std::vector<SoftSurface>(parts.size()),
                 .waits = std::vector<char>(parts.size(), 0)};
    parallel_for(0, parts.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            tissue.made[i] = make_soft_surface(parts[i], options, progress);
    });
    std::vector<char> again(parts.size(), 0);
    for (int round = 0; round < kRounds && mark_crossing(tissue, again); ++round) {
        tissue.waits = again;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (!again[i]) continue;
            const Part part{.start = parts[i].start,
                            .phi = parts[i].phi,
                            .trim = parts[i].trim,
                            .beside = beside(tissue, i, options.edge_length)};
            tissue.made[i] = make_soft_surface(part, options, progress);
            tissue.waits[i] = 0;
        }
    }
    return std::move(tissue.made);
}

}  // namespace myotet::app
