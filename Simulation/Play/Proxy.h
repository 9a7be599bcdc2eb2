// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Core/BoxTree.h"
#include "Core/TetMesh.h"

namespace myotet::play {

/// A point of a proxy's surface that others must not hold: a node, or a triangle's centre.
struct Sample {
    std::array<std::int32_t, 3> node{};
    int count = 1;    ///< nodes, of equal weights
    double area = 0;  ///< that it stands for, at rest, mm^2

    [[nodiscard]] Vec3 at(const std::vector<Vec3>& x) const {
        Vec3 sum = x[node[0]];
        for (int i = 1; i < count; ++i) sum += x[node[i]];
        return sum / count;
    }
};

/// Where a surface is nearest to a point.
struct Closest {
    std::int32_t triangle = -1;             ///< -1: farther than was asked for
    std::array<double, 3> weight{0, 0, 0};  ///< of its corners
    Vec3 point = Vec3::Zero();
    Vec3 outward = Vec3::UnitZ();  ///< pseudo-normal there, unit
    double distance = 0;           ///< negative inside, mm
};

/// The closed surface of a mesh of tetrahedra as others collide with it: samples, and a tree
/// of boxes about its triangles whose shape stays while its boxes follow the nodes.
class Proxy {
public:
    /// Of tetrahedra over a scene's nodes, at rest. Throws MeshError when there is none.
    Proxy(const std::vector<Vec3>& rest, const std::vector<Tet>& tets);

    [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }
    [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
    [[nodiscard]] double mean_edge() const { return mean_edge_; }  ///< at rest, mm
    [[nodiscard]] double area(std::int32_t triangle) const { return areas_[triangle]; }
    [[nodiscard]] const std::vector<std::int32_t>& nodes() const { return nodes_; }

    /// Boxes and normals for the nodes as they are now.
    void follow(const std::vector<Vec3>& x);
    [[nodiscard]] const Box& box() const { return tree_.box(); }

    /// The nearest point of the surface within `reach` mm; inside and outside are told apart
    /// by angle-weighted pseudo-normals [Baerentzen and Aanaes 2005]. Of equally near
    /// triangles the first in the tree. Cost: below a microsecond.
    [[nodiscard]] Closest closest(const std::vector<Vec3>& x, const Vec3& p, double reach) const;

private:
    void add_samples();
    [[nodiscard]] Vec3 normal_at(const Closest& at) const;

    std::vector<Triangle> triangles_;
    std::vector<Triangle> local_;       // corners by their place in nodes_
    std::vector<Triangle> neighbours_;  // behind the edge opposite each corner
    std::vector<double> areas_;
    std::vector<std::int32_t> nodes_;
    std::vector<Sample> samples_;
    double mean_edge_ = 0;
    BoxTree tree_;
    std::vector<Vec3> normals_, corner_normals_;  // unit of triangles; weighted of nodes_
};

}  // namespace myotet::play
