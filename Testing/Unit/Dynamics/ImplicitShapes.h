// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "Dynamics/ElasticBody.h"
#include "Dynamics/Implicit.h"
#include "Dynamics/NodeAlgebra.h"
#include "DynamicsShapes.h"
#include "Elasticity/LinearTet.h"
#include "Elasticity/Materials.h"

namespace myotet::dynamics::test {

inline const EquilibriumOptions kExact{.tolerance = 1e-11};
inline constexpr double kDensity = 1e-9;  // t/mm^3, water

inline std::shared_ptr<const elasticity::PointLaw> rubber(double poisson = 0.4) {
    return std::make_shared<elasticity::OneLaw<elasticity::NeoHookean>>(
        elasticity::NeoHookean{elasticity::lame_from(0.1, poisson)});
}

// A free block of soft tissue, and its motion.
struct Block {
    TetMesh mesh;
    ElasticBody body;
    std::vector<double> masses;

    explicit Block(int cubes, std::shared_ptr<const elasticity::PointLaw> law = rubber())
        : mesh(block(cubes, 1)),
          body(mesh, std::move(law)),
          masses(elasticity::nodal_masses(mesh, kDensity)) {}
    [[nodiscard]] NodeVectors still() const { return {mesh.points.size(), Vec3::Zero()}; }
    // Stretched along z by a third, thinner across.
    [[nodiscard]] NodeVectors stretched() const {
        NodeVectors x = mesh.points;
        for (Vec3& p : x) p = Vec3(0.9 * p.x() + 0.1 * p.z(), 0.9 * p.y(), 1.3 * p.z());
        return x;
    }
    [[nodiscard]] std::vector<std::int32_t> at_height(double z) const {
        std::vector<std::int32_t> nodes;
        for (std::size_t n = 0; n < mesh.points.size(); ++n)
            if (mesh.points[n].z() == z) nodes.push_back(static_cast<std::int32_t>(n));
        return nodes;
    }
};

inline void run(ImplicitIntegrator& integrator, double dt, int steps, Motion& motion) {
    for (int i = 0; i < steps; ++i) {
        const EquilibriumSummary step = integrator.step(dt, {}, motion);
        ASSERT_TRUE(step.converged) << step.message;
    }
}

inline double distance(const NodeVectors& a, const NodeVectors& b) {
    NodeVectors by = a;
    add_scaled(-1, b, by);
    return std::sqrt(dot(by, by));
}

}  // namespace myotet::dynamics::test
