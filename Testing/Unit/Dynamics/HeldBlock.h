// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Dynamics/ElasticBody.h"
#include "DynamicsShapes.h"
#include "Elasticity/Materials.h"

namespace myotet::dynamics::test {

/// The stiffness of a block at rest, one end held.
struct HeldBlock {
    TetMesh mesh;
    BlockMatrix K;
    std::vector<char> held;

    explicit HeldBlock(int cubes = 4, double poisson = 0.4) : mesh(block(cubes, 1)) {
        using elasticity::NeoHookean;
        ElasticBody body(mesh, std::make_shared<elasticity::OneLaw<NeoHookean>>(
                                   NeoHookean{elasticity::lame_from(1, poisson)}));
        (void)body.move_to(mesh.points);
        K = block_pattern(mesh.points.size(), body.cliques());
        body.add_stiffness(K);
        for (const Vec3& p : mesh.points) held.push_back(p.z() == 0);
    }
    [[nodiscard]] std::size_t nodes() const { return mesh.points.size(); }
    /// The same pattern, its diagonal blocks times a factor.
    [[nodiscard]] BlockMatrix with_diagonal_times(double factor) const {
        BlockMatrix changed = K;
        for (std::int32_t n = 0; n < static_cast<std::int32_t>(nodes()); ++n)
            changed.value[changed.at(n, n)] *= factor;
        return changed;
    }
    /// |K x - right| at free nodes.
    [[nodiscard]] static double miss(const BlockMatrix& K, const std::vector<char>& held,
                                     const NodeVectors& x, const NodeVectors& right) {
        const NodeVectors product = multiply(K, x);
        double squares = 0;
        for (std::size_t n = 0; n < x.size(); ++n)
            if (!held[n]) squares += (product[n] - right[n]).squaredNorm();
        return std::sqrt(squares);
    }
};

}  // namespace myotet::dynamics::test
