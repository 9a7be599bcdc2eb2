// SPDX-License-Identifier: Apache-2.0
#include "Fibres/Sections.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

namespace myotet::fibres {
namespace {

using Edge = std::array<std::int32_t, 2>;

/// Point of the loop at `place` points from its first, linear between points.
Vec3 point_at(const std::vector<Vec3>& loop, double place) {
    const auto n = static_cast<double>(loop.size());
    place -= n * std::floor(place / n);
    const auto i = static_cast<std::size_t>(place) % loop.size();
    const double share = place - std::floor(place);
    return (1 - share) * loop[i] + share * loop[(i + 1) % loop.size()];
}

void turn(std::vector<Vec3>& loop, double by) {
    std::vector<Vec3> turned(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i)
        turned[i] = point_at(loop, static_cast<double>(i) + by);
    loop = std::move(turned);
}

double length_of(const std::vector<Vec3>& loop) {
    double length = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        length += (loop[(i + 1) % loop.size()] - loop[i]).norm();
    return length;
}

std::vector<Vec3> resampled(const std::vector<Vec3>& loop, double length) {
    std::vector<Vec3> even;
    even.reserve(kLoopPoints);
    double passed = 0;
    for (std::size_t i = 0; i < loop.size() && even.size() < kLoopPoints; ++i) {
        const Vec3 &a = loop[i], &b = loop[(i + 1) % loop.size()];
        const double edge = (b - a).norm();
        while (even.size() < kLoopPoints) {
            const double next = length * static_cast<double>(even.size()) / kLoopPoints - passed;
            if (next >= edge) break;
            // `next` may be rounding below 0 and the edge of no length.
            even.push_back(a + (edge > 0 ? std::max(next / edge, 0.0) : 0.0) * (b - a));
        }
        passed += edge;
    }
    while (even.size() < kLoopPoints) even.push_back(loop.front());  // what rounding left over
    return even;
}

/// Closed lines at which the faces have the potential `level`, each counter-clockwise
/// about the direction of growing potential, for outward faces.
std::vector<std::vector<Vec3>> lines_at(const TetMesh& mesh, const std::vector<Triangle>& faces,
                                        std::span<const double> potential, double level) {
    const auto above = [&](std::int32_t node) { return potential[node] >= level; };
    // From the edge at which the line enters a face to that at which it leaves; about an
    // outward face the line has the potential growing on its left.
    std::multimap<Edge, Edge> next;
    const auto edge = [](std::int32_t a, std::int32_t b) {
        return Edge{std::min(a, b), std::max(a, b)};
    };
    for (const Triangle& f : faces) {
        Edge enter{-1, -1}, leave{-1, -1};
        for (int c = 0; c < 3; ++c) {
            const std::int32_t a = f[c], b = f[(c + 1) % 3];
            if (above(a) && !above(b)) enter = edge(a, b);
            if (!above(a) && above(b)) leave = edge(a, b);
        }
        if (enter[0] >= 0) next.emplace(enter, leave);
    }
    std::vector<std::vector<Vec3>> lines;
    while (!next.empty()) {
        std::vector<Vec3> line;
        for (auto it = next.begin(); it != next.end();) {
            const auto [a, b] = it->first;
            const double share = (level - potential[a]) / (potential[b] - potential[a]);
            line.push_back((1 - share) * mesh.points[a] + share * mesh.points[b]);
            const Edge to = it->second;
            next.erase(it);
            it = next.find(to);
        }
        lines.push_back(std::move(line));
    }
    return lines;
}

/// Twice the area that a loop encloses, as a vector.
Vec3 area_vector(const std::vector<Vec3>& loop, const Vec3& centre) {
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i)
        area += (loop[i] - centre).cross(loop[(i + 1) % loop.size()] - centre);
    return area;
}

}  // namespace

Section section_at(const TetMesh& mesh, const std::vector<Triangle>& faces,
                   std::span<const double> potential, double level) {
    Section section;
    section.normal.setZero();
    double longest = 0;
    std::vector<std::vector<Vec3>> lines = lines_at(mesh, faces, potential, level);
    for (const std::vector<Vec3>& line : lines)
        if (const double length = length_of(line); length > longest) {
            longest = length;
            section.loop = line;
        }
    if (section.loop.empty()) return section;
    section.left_out = lines.size() - 1;
    section.loop = resampled(section.loop, longest);
    for (const Vec3& p : section.loop) section.centre += p / kLoopPoints;
    section.normal = area_vector(section.loop, section.centre).stableNormalized();
    return section;
}

void align(const Section& to, Section& of) {
    const Mat3 carry = Eigen::Quaterniond::FromTwoVectors(to.normal, of.normal).toRotationMatrix();
    std::vector<Vec3> target;
    target.reserve(kLoopPoints);
    for (const Vec3& p : to.loop) target.push_back(carry * (p - to.centre));
    std::vector<double> match(kLoopPoints, 0.0);  // by turns of whole points
    for (int by = 0; by < kLoopPoints; ++by)
        for (int i = 0; i < kLoopPoints; ++i)
            match[by] += target[i].dot(of.loop[(i + by) % kLoopPoints] - of.centre);
    const int best = static_cast<int>(std::max_element(match.begin(), match.end()) - match.begin());
    // The top of the parabola through the best and its neighbours.
    const double before = match[(best + kLoopPoints - 1) % kLoopPoints];
    const double after = match[(best + 1) % kLoopPoints];
    const double bend = 2 * match[best] - before - after;
    turn(of.loop, best + (bend > 0 ? 0.5 * (after - before) / bend : 0.0));
}

void begin_at_long_axis(Section& section) {
    Mat3 spread = Mat3::Zero();
    for (const Vec3& p : section.loop)
        spread += (p - section.centre) * (p - section.centre).transpose();
    const Vec3 axis = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors().col(2);
    int first = 0;
    for (int i = 1; i < kLoopPoints; ++i)
        if (axis.dot(section.loop[i]) > axis.dot(section.loop[first])) first = i;
    turn(section.loop, first);
}

}  // namespace myotet::fibres
