// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "Core/Errors.h"
#include "Core/Text.h"
#include "LevelSet/CsgMeasure.h"
#include "LevelSet/CsgTable.h"
#include "LevelSet/FromSurface.h"
#include "Repair/Solids.h"
#include "Repair/Steps.h"

namespace myotet::repair {
namespace {

using levelset::Band;

// Largest of the distances to the planes, in lattice coordinates: exact inside
// and by a face, less than the distance beyond edges.
levelset::Distance inside_planes(const std::vector<Plane>& planes, const Frame& frame,
                                 double margin) {
    return [planes, frame, margin](const Vec3& p) {
        const Vec3 lps = frame.to_lps(p);
        double most = -1e9;
        for (const Plane& plane : planes)
            most = std::max(most, plane.normal.dot(lps) - plane.offset + margin);
        return most;
    };
}

// Planes leave a box alone when they leave its corners.
bool lies_within(const Box& box, const levelset::Distance& planes) {
    for (int corner = 0; corner < 8; ++corner)
        if (planes(Vec3(corner & 1 ? box.max.x() : box.min.x(),
                        corner & 2 ? box.max.y() : box.min.y(),
                        corner & 4 ? box.max.z() : box.min.z())) > 0)
            return false;
    return true;
}

Box grown(Box box, double by) {
    box.min -= Vec3::Constant(by);
    box.max += Vec3::Constant(by);
    return box;
}

Band solid_band(const Solid& solid, const Box& domain, Workshop& shop) {
    const Frame& frame = shop.scene().frame;
    const Pose pose = solid.relative_to.empty()
                          ? patient_pose(frame)
                          : principal_pose(shop.band(shop.find(solid.relative_to)), frame);
    PlacedSolid placed = place(solid, pose, domain);
    return levelset::sample_solid(placed.distance, placed.box, shop.lattice());
}

void tell_guess(const std::filesystem::path& file, const levelset::HealSummary& healed,
                Workshop& shop) {
    const std::string text = formatted(
        ": %lld holes were closed by a guess, %.3g mm^2 or %.2g %% of it",
        static_cast<long long>(healed.holes), healed.guessed_area, 100 * healed.guessed_share);
    shop.progress().warn(file.string() + text);
}

Band surface_band(const SurfaceFile& surface, Workshop& shop) {
    std::filesystem::path file = surface.file;
    if (file.is_relative()) file = shop.recipe().file.parent_path() / file;
    TriMesh mesh = shop.scene().read_surface(file);
    Box box;
    for (Vec3& p : mesh.points) {
        p = shop.scene().frame.to_local(p);
        box.include(p);
    }
    levelset::SurfaceOptions options;
    options.spacing = shop.spacing();
    options.heal = surface.heal;
    levelset::HealSummary healed;
    try {
        const levelset::LevelSet phi =
            levelset::from_surface(mesh, options, shop.progress(), &healed);
        if (healed.guessed_area > 0) tell_guess(file, healed, shop);
        return levelset::sample_solid([&](const Vec3& p) { return phi.value(p); }, box,
                                      shop.lattice());
    } catch (const InputError& e) {
        shop.refuse(file.string() + ": " + e.what() +
                    (surface.heal ? "" : " (in a recipe, 'heal: true' beside 'surface')"));
    }
}

Band operand_band(const Operand& operand, const Box& domain, Workshop& shop) {
    if (const auto* tissue = std::get_if<TissueName>(&operand))
        return shop.band(shop.find(tissue->name));
    if (const auto* surface = std::get_if<SurfaceFile>(&operand))
        return surface_band(*surface, shop);
    return solid_band(std::get<Solid>(operand), domain, shop);
}

// A half-space has no end: what it adds ends with the field of view.
void require_bounded(const Operand& operand, Workshop& shop) {
    const auto* solid = std::get_if<Solid>(&operand);
    if (solid && std::holds_alternative<HalfSpace>(solid->shape))
        shop.refuse("a half_space has no end; intersect or subtract it, or add a box");
}

void unite(const Combine& task, int tissue, const Band& other, Workshop& shop) {
    std::vector<int> givers = shop.find_all(task.takes_from);
    const auto* absorbed = std::get_if<TissueName>(&task.with);
    const int gone = absorbed ? shop.find(absorbed->name) : -1;
    if (absorbed) givers.push_back(gone);
    Band form = shop.yield(tissue, levelset::unite(shop.band(tissue), other, task.blend), givers);
    if (absorbed) {
        givers.pop_back();
        shop.absorb(gone);
    }
    shop.replace(tissue, std::move(form), givers);
}

}  // namespace

void run(const Combine& task, Workshop& shop) {
    const int tissue = shop.find(task.tissue);
    const double reach = task.blend + 4 * Band::kSide * shop.spacing();
    const Band other =
        operand_band(task.with, grown(levelset::inside_box(shop.band(tissue)), reach), shop);
    if (levelset::is_empty(other))
        shop.refuse("the solid is thinner than the samples of the level sets, " +
                    std::to_string(shop.spacing()) + " mm; make it thicker");
    if (task.how == Combination::unite) {
        require_bounded(task.with, shop);
        unite(task, tissue, other, shop);
        return;
    }
    const Band& whole = shop.band(tissue);
    Band form = task.how == Combination::intersect ? levelset::intersect(whole, other, task.blend)
                                                   : levelset::subtract(whole, other, task.blend);
    if (!task.into) {
        shop.replace(tissue, std::move(form));
        return;
    }
    const Band rest = levelset::subtract(whole, form);
    const int made = shop.add(*task.into);
    shop.replace(tissue, rest);
    shop.replace(made, std::move(form));
}

void run(const Create& task, Workshop& shop) {
    require_bounded(task.from, shop);
    const Band form = operand_band(task.from, {}, shop);
    const std::vector<int> givers = shop.find_all(task.takes_from);
    const int made = shop.add(task.tissue);
    shop.replace(made, shop.yield(made, form, givers), givers);
}

void run(const Clip& task, Workshop& shop) {
    if (shop.scene().field_of_view.empty())
        shop.refuse("this input has no field of view to clip at; intersect with a box instead");
    const auto distance =
        inside_planes(shop.scene().field_of_view, shop.scene().frame, task.margin);
    for (const int tissue : shop.find_all(task.tissues)) {
        const Band& whole = shop.band(tissue);
        if (lies_within(grown(levelset::inside_box(whole), shop.spacing()), distance)) {
            shop.replace(tissue, whole);
            continue;
        }
        const Box box = grown(levelset::inside_box(whole), 4 * Band::kSide * shop.spacing());
        const Band view = levelset::sample_solid(distance, box, shop.lattice());
        shop.replace(tissue, levelset::intersect(whole, view));
    }
}

void run(const Priority& task, Workshop& shop) {
    const std::vector<int> tissues = shop.find_all(task.tissues);
    for (std::size_t later = 1; later < tissues.size(); ++later) {
        Band form = shop.band(tissues[later]);
        for (std::size_t first = 0; first < later; ++first)
            form = levelset::subtract(form, shop.band(tissues[first]));
        shop.replace(tissues[later], std::move(form));
    }
}

}  // namespace myotet::repair
