// SPDX-License-Identifier: Apache-2.0
#include "Fibres/CentralLine.h"

#include <algorithm>

namespace myotet::fibres {
namespace {

// Of the range of potentials: cuts nearer to one another than this are one.
constexpr double kApart = 1e-6;

/// Mean position of the tetrahedra's nodes whose potential is `level`.
Vec3 mean_at(const TetMesh& mesh, std::span<const double> potential, double level) {
    std::vector<char> seen(mesh.points.size(), 0);
    Vec3 sum = Vec3::Zero();
    double count = 0;
    for (const Tet& t : mesh.tets)
        for (const std::int32_t node : t)
            if (potential[node] == level && !seen[node]) {
                seen[node] = 1;
                sum += mesh.points[node];
                ++count;
            }
    return sum / count;
}

void add_point(CentralLine& line, double potential, const Vec3& point) {
    if (!line.point.empty() && !(potential > line.potential.back())) return;
    const double step = line.point.empty() ? 0 : (point - line.point.back()).norm();
    line.length.push_back(line.point.empty() ? 0 : line.length.back() + step);
    line.potential.push_back(potential);
    line.point.push_back(point);
}

/// Where `value` lies among increasing values: the interval and the share of it.
std::pair<std::size_t, double> find_interval(const std::vector<double>& values, double value) {
    if (values.size() < 2 || !(value > values.front())) return {0, 0.0};
    const auto above = std::upper_bound(values.begin(), values.end() - 1, value);
    const auto n = static_cast<std::size_t>(above - values.begin()) - 1;
    const double width = values[n + 1] - values[n];
    return {n, width > 0 ? std::min((value - values[n]) / width, 1.0) : 0.0};
}

/// What a tetrahedron adds.
struct Piece {
    double level, volume;  // mean potential; mm^3
    Vec3 centre;
};

/// By potential.
std::vector<Piece> sorted_pieces(const TetMesh& mesh, std::span<const double> potential) {
    std::vector<Piece> pieces;
    pieces.reserve(mesh.tets.size());
    for (const Tet& t : mesh.tets) {
        const auto& x = mesh.points;
        pieces.push_back(
            {0.25 * (potential[t[0]] + potential[t[1]] + potential[t[2]] + potential[t[3]]),
             signed_volume(x[t[0]], x[t[1]], x[t[2]], x[t[3]]), centroid_of(mesh, t)});
    }
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const Piece& a, const Piece& b) { return a.level < b.level; });
    return pieces;
}

/// Increasing potentials between which lie parts of about equal volume.
std::vector<double> equal_parts(const std::vector<Piece>& pieces, int parts) {
    double all = 0, passed = 0;
    for (const Piece& piece : pieces) all += piece.volume;
    const double apart = kApart * (pieces.back().level - pieces.front().level);
    std::vector<double> cuts{pieces.front().level};
    int next = 1;
    for (const Piece& piece : pieces) {
        passed += piece.volume;
        if (passed < next * all / parts) continue;
        if (piece.level > cuts.back() + apart) cuts.push_back(piece.level);
        while (passed >= next * all / parts) ++next;
    }
    return cuts;
}

}  // namespace

Vec3 CentralLine::at(double level) const {
    const auto [n, share] = find_interval(potential, level);
    return share > 0 ? Vec3((1 - share) * point[n] + share * point[n + 1]) : point[n];
}

double CentralLine::potential_at(double along) const {
    const auto [n, share] = find_interval(length, along);
    return share > 0 ? (1 - share) * potential[n] + share * potential[n + 1] : potential[n];
}

CentralLine central_line(const TetMesh& mesh, std::span<const double> potential, int parts) {
    const std::vector<Piece> pieces = sorted_pieces(mesh, potential);
    const std::vector<double> cuts = equal_parts(pieces, parts);
    // A tetrahedron belongs to both cuts between which it lies, the more to the nearer.
    std::vector<double> filled(cuts.size(), 0.0), levels(cuts.size(), 0.0);
    std::vector<Vec3> moments(cuts.size(), Vec3::Zero());
    for (const Piece& piece : pieces) {
        const auto [n, share] = find_interval(cuts, piece.level);
        const auto add = [&](std::size_t cut, double v) {
            filled[cut] += v;
            levels[cut] += v * piece.level;
            moments[cut] += v * piece.centre;
        };
        add(n, (1 - share) * piece.volume);
        if (share > 0) add(n + 1, share * piece.volume);
    }
    double least = potential[mesh.tets[0][0]], greatest = least;
    for (const Tet& t : mesh.tets)
        for (const std::int32_t node : t) {
            least = std::min(least, potential[node]);
            greatest = std::max(greatest, potential[node]);
        }
    CentralLine line;
    add_point(line, least, mean_at(mesh, potential, least));
    for (std::size_t n = 0; n < cuts.size(); ++n)
        if (filled[n] > 0) add_point(line, levels[n] / filled[n], moments[n] / filled[n]);
    add_point(line, greatest, mean_at(mesh, potential, greatest));
    return line;
}

}  // namespace myotet::fibres
