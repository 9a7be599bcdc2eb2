// SPDX-License-Identifier: Apache-2.0
#include "TrimSolid.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

#include "Core/Errors.h"
#include "ExitCodes.h"
#include "LevelSet/FromSurface.h"
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

Field surface_field(const std::filesystem::path& file, const Frame& frame, double spacing,
                    ProgressSink& progress) {
    std::shared_ptr<const levelset::LevelSet> phi;
    try {
        phi = std::make_shared<const levelset::LevelSet>(
            levelset::from_surface(meshfiles::read_surface(file), {.spacing = spacing}, progress));
    } catch (const InputError& error) {  // which does not know the file
        throw InputError("--trim " + file.string() + ": " + error.what());
    }
    return [phi, frame](const Vec3& local) {
        const levelset::Sample s = phi->sample(frame.to_lps(local));
        return FieldSample{s.value, frame.rotation.transpose() * s.gradient};
    };
}

}  // namespace

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
    if (!std::filesystem::is_regular_file(trim.file, ignored) ||
        !meshfiles::is_surface_file(trim.file))
        throw UsageError("--trim " + text +
                         ": is neither x,y,z,nx,ny,nz nor a tissue of the scan nor a surface "
                         "file (.obj .off .stl .ply .vtp)");
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
    if (!trim.tissue) return surface_field(trim.file, frame, spacing, progress);
    std::vector<const levelset::LevelSet*> phis;
    for (const levelset::Region& region : sets.sets.regions)
        if (belongs(region, *trim.tissue)) phis.push_back(&region.phi);
    return field_of(std::move(phis));
}

}  // namespace myotet::app
