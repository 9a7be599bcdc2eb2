// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "Core/TetMesh.h"
#include "Dynamics/ForceField.h"

namespace myotet::dynamics::test {

/// A block of n^3 cubes of side `h`, each cut into six tetrahedra.
inline TetMesh block(int n, double h) {
    TetMesh mesh;
    const int m = n + 1;
    for (int k = 0; k < m; ++k)
        for (int j = 0; j < m; ++j)
            for (int i = 0; i < m; ++i) mesh.points.push_back(h * Vec3(i, j, k));
    constexpr int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    const int step[3] = {1, m, m * m};
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                for (const auto& o : order) {
                    Tet t;
                    t[0] = (k * m + j) * m + i;
                    for (int c = 0; c < 3; ++c) t[c + 1] = t[c] + step[o[c]];
                    if (signed_volume(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]],
                                      mesh.points[t[3]]) < 0)
                        std::swap(t[2], t[3]);
                    mesh.tets.push_back(t);
                }
    return mesh;
}

inline NodeVectors random_vectors(std::size_t count, double size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> entry(-size, size);
    NodeVectors v(count);
    for (Vec3& p : v) p = {entry(random), entry(random), entry(random)};
    return v;
}

/// Linear springs of constant k to the origin, and drag of constant c.
class Wells final : public ForceField {
public:
    Wells(double k, double c) : k_(k), c_(c) {}
    void move_to(const NodeVectors& x) override { x_ = x; }
    void add_elastic(NodeVectors& f) const override {
        for (std::size_t i = 0; i < f.size(); ++i) f[i] -= k_ * x_[i];
    }
    void add_damping(const NodeVectors& v, NodeVectors& f) const override {
        for (std::size_t i = 0; i < f.size(); ++i) f[i] -= c_ * v[i];
    }

private:
    double k_, c_;
    NodeVectors x_;
};

}  // namespace myotet::dynamics::test
