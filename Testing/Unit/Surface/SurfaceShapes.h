// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "LevelSet/Extract.h"
#include "LevelSet/LevelSet.h"
#include "LevelSet/Primitives.h"
#include "Support/AnalyticLevelSet.h"
#include "Surface/MakeSurface.h"

namespace myotet::surface {

/// A sampled level set, its zero set, and the field that this room sees.
struct Shape {
    levelset::LevelSet phi;
    TriMesh start;
    [[nodiscard]] Field field() const {
        return [this](const Vec3& p) {
            const levelset::Sample s = phi.sample(p);
            return FieldSample{s.value, s.gradient};
        };
    }
};

inline Shape make_shape(double half, double spacing,
                        const std::function<double(const Vec3&)>& distance) {
    Shape shape;
    shape.phi = support::sample_level_set(support::cube(half), spacing, distance);
    shape.start = levelset::extract_surface(shape.phi);
    return shape;
}

inline Shape ball(double radius, double spacing) {
    return make_shape(radius + 2, spacing, [radius](const Vec3& p) {
        return levelset::sphere_distance(p, Vec3::Zero(), radius);
    });
}

inline Shape ellipsoid(const Vec3& semi_axes, double spacing) {
    return make_shape(semi_axes.maxCoeff() + 2, spacing, [semi_axes](const Vec3& p) {
        return levelset::ellipsoid_distance(p, semi_axes);
    });
}

inline Shape torus(double ring, double tube, double spacing) {
    return make_shape(ring + tube + 2, spacing, [ring, tube](const Vec3& p) {
        return levelset::torus_distance(p, ring, tube);
    });
}

/// Between two concentric spheres.
inline Shape hollow_shell(double outer, double inner, double spacing) {
    return make_shape(outer + 2, spacing, [outer, inner](const Vec3& p) {
        return std::max(p.norm() - outer, inner - p.norm());
    });
}

/// A ball as a trimming field, exact.
inline Field ball_field(const Vec3& centre, double radius) {
    return [centre, radius](const Vec3& p) {
        const Vec3 d = p - centre;
        return FieldSample{d.norm() - radius, d.normalized()};
    };
}

}  // namespace myotet::surface
