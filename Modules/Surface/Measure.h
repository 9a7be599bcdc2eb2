// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "Surface/Remesh.h"

namespace myotet::surface {

/// What a surface mesh is worth.
struct Quality {
    std::size_t points = 0, triangles = 0;
    double area = 0;  ///< mm^2
    double smallest_angle_deg = 0, largest_angle_deg = 0;
    double shortest_edge = 0, median_edge = 0, longest_edge = 0;  ///< mm

    int pieces = 0;                         ///< connected by points
    std::int64_t euler_characteristic = 0;  ///< V - E + F
    int boundary_loops = 0;
    double boundary_length = 0;  ///< mm
    std::int64_t boundary_points = 0;
    std::int64_t bad_edges = 0;   ///< with more than two triangles, or two that disagree on a side
    std::int64_t bad_points = 0;  ///< whose triangles are not one fan
    std::int64_t inner_edges_joining_boundary_points = 0;
    /// That face against the gradient of phi at all three corners and the centre: at
    /// a sharp edge, where it differs from side to side, one of them is no fault.
    std::int64_t triangles_turned_over = 0;
    std::int64_t crossing_triangles = 0;  ///< pairs of triangles that cross

    double points_off = 0;     ///< largest |phi| at a point, mm
    double mean_distance = 0;  ///< of |phi| at points, edge midpoints and triangle centres, mm
    double max_distance = 0;   ///< mm
    /// At points of the boundary the largest |phi| or |trim|, in parts of the mean
    /// length of the two boundary edges there; 0 without a boundary.
    double boundary_off_in_edges = 0;
};
[[nodiscard]] Quality measure(const TriMesh& mesh, const Guide& guide);

/// A sentence for each promise about a mesh's connections that does not hold.
[[nodiscard]] std::vector<std::string> broken_promises(const Quality& quality);

/// What is asked of angles (degrees), and of the distance of points from phi = 0 and of
/// the boundary from both surfaces (parts of an edge; of the median one for points).
inline constexpr double kSmallestAngle = 25, kLargestAngle = 120, kBoundaryOff = 0.01,
                        kPointsOff = 0.01;

/// A sentence for each of these that is not met.
[[nodiscard]] std::vector<std::string> shortfalls(const Quality& quality);

/// The angles of a triangle at its corners.
[[nodiscard]] std::array<double, 3> angles_deg(const Vec3& a, const Vec3& b, const Vec3& c);

/// Of triangles that hang together by points.
[[nodiscard]] int count_pieces(const TriMesh& mesh);

/// Of all edges; 0 of an empty mesh, mm.
[[nodiscard]] double median_edge(const TriMesh& mesh);

}  // namespace myotet::surface
