// SPDX-License-Identifier: Apache-2.0
#include "Core/TetMesh.h"

#include <algorithm>
#include <numeric>

#include "Core/Errors.h"
#include "Core/Parallel.h"

namespace myotet {
namespace {

std::int32_t find_root(std::vector<std::int32_t>& parent, std::int32_t i) {
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

struct FaceRecord {
    std::array<std::int32_t, 2> rest;  // the two larger node numbers, sorted
    std::int32_t slot;                 // 4 * tetrahedron + face
};

}  // namespace

double volume(const TetMesh& mesh) {
    double sum = 0;
    for (const Tet& t : mesh.tets)
        sum += signed_volume(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]],
                             mesh.points[t[3]]);
    return sum;
}

double volume(const TriMesh& surface) {
    if (surface.points.empty()) return 0;
    // V = sum of a . (b x c) / 6, taken about the first point to keep the terms small.
    const Vec3 origin = surface.points.front();
    double sum = 0;
    for (const Triangle& t : surface.triangles) {
        const Vec3 a = surface.points[t[0]] - origin;
        const Vec3 b = surface.points[t[1]] - origin;
        const Vec3 c = surface.points[t[2]] - origin;
        sum += a.dot(b.cross(c)) / 6.0;
    }
    return sum;
}

Vec3 centroid(const TetMesh& mesh) {
    Vec3 moment = Vec3::Zero();
    double total = 0;
    for (const Tet& t : mesh.tets) {
        const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]],
                   &d = mesh.points[t[3]];
        const double v = signed_volume(a, b, c, d);
        moment += v * 0.25 * (a + b + c + d);
        total += v;
    }
    if (!(total > 0)) throw MeshError("the centroid of a mesh without volume was asked for");
    return moment / total;
}

std::vector<Tet> face_neighbours(const std::vector<Tet>& tets) {
    // Bucket faces by their smallest node, then pair equal ones in the bucket.
    std::int32_t node_count = 0;
    for (const Tet& t : tets)
        node_count = std::max(node_count, *std::max_element(t.begin(), t.end()) + 1);
    std::vector<std::int64_t> start(static_cast<std::size_t>(node_count) + 1, 0);
    for (const Tet& t : tets)
        for (int i = 0; i < 4; ++i) {
            const Triangle f = face_of(t, i);
            ++start[std::min({f[0], f[1], f[2]}) + 1];
        }
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<FaceRecord> records(4 * tets.size());
    std::vector<std::int64_t> next(start.begin(), start.end() - 1);
    for (std::size_t t = 0; t < tets.size(); ++t)
        for (int i = 0; i < 4; ++i) {
            Triangle f = face_of(tets[t], i);
            std::sort(f.begin(), f.end());
            records[next[f[0]]++] = {{f[1], f[2]}, static_cast<std::int32_t>(4 * t + i)};
        }
    std::vector<Tet> neighbours(tets.size(), Tet{-1, -1, -1, -1});
    parallel_for(0, node_count, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            const auto first = records.begin() + start[n], last = records.begin() + start[n + 1];
            std::sort(first, last, [](const FaceRecord& a, const FaceRecord& b) {
                return a.rest != b.rest ? a.rest < b.rest : a.slot < b.slot;
            });
            for (auto it = first; it != last && it + 1 != last; ++it)
                if (it->rest == (it + 1)->rest) {
                    const std::int32_t a = it->slot, b = (it + 1)->slot;
                    neighbours[a / 4][a % 4] = b / 4;
                    neighbours[b / 4][b % 4] = a / 4;
                }
        }
    });
    return neighbours;
}

std::vector<Triangle> boundary_faces(const std::vector<Tet>& tets) {
    const std::vector<Tet> neighbours = face_neighbours(tets);
    std::vector<Triangle> faces;
    for (std::size_t t = 0; t < tets.size(); ++t)
        for (int i = 0; i < 4; ++i)
            if (neighbours[t][i] < 0) faces.push_back(face_of(tets[t], i));
    return faces;
}

TriMesh boundary_surface(const TetMesh& mesh) {
    TriMesh surface;
    std::vector<std::int32_t> number(mesh.points.size(), -1);
    for (Triangle face : boundary_faces(mesh.tets)) {
        for (std::int32_t& n : face) {
            if (number[n] < 0) {
                number[n] = static_cast<std::int32_t>(surface.points.size());
                surface.points.push_back(mesh.points[n]);
            }
            n = number[n];
        }
        surface.triangles.push_back(face);
    }
    return surface;
}

int count_components(const std::vector<Tet>& tets, std::size_t point_count,
                     std::vector<std::int32_t>* component_of) {
    std::vector<std::int32_t> parent(point_count);
    std::iota(parent.begin(), parent.end(), 0);
    for (const Tet& t : tets)
        for (int i = 1; i < 4; ++i) {
            const std::int32_t a = find_root(parent, t[0]), b = find_root(parent, t[i]);
            if (a != b) parent[std::max(a, b)] = std::min(a, b);
        }
    std::vector<std::int32_t> number(point_count, -1);
    int components = 0;
    if (component_of) component_of->resize(tets.size());
    for (std::size_t i = 0; i < tets.size(); ++i) {
        std::int32_t& n = number[find_root(parent, tets[i][0])];
        if (n < 0) n = components++;
        if (component_of) (*component_of)[i] = n;
    }
    return components;
}

void append(TetMesh& whole, const TetMesh& part) {
    const auto shift = static_cast<std::int32_t>(whole.points.size());
    whole.points.insert(whole.points.end(), part.points.begin(), part.points.end());
    whole.labels.insert(whole.labels.end(), part.labels.begin(), part.labels.end());
    whole.tets.reserve(whole.tets.size() + part.tets.size());
    for (Tet t : part.tets) {
        for (std::int32_t& n : t) n += shift;
        whole.tets.push_back(t);
    }
}

}  // namespace myotet
