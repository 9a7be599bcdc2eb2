// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/HealSurface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "LevelSet/WindingTree.h"

namespace myotet::levelset {
namespace {

// Two rims belong together where they run closer than this many edge lengths,
// in directions of at least this cosine, and clearly closer than any other.
constexpr double kRimReach = 0.02, kAlong = 0.7, kClearly = 0.5;
// Rims decide when they agree by so much, of -1 to 1, ...
constexpr double kAgreement = 0.8;
// ... over at least this share of a piece's rim.
constexpr double kRimShare = 0.1;
// A ball has 0.094 of this, volume over area^1.5; less than that is no solid.
constexpr double kSolid = 0.01;
// More pairs of open edges or pieces than this would take too long to compare.
constexpr double kMostPairs = 4e8;
constexpr std::ptrdiff_t kMostPieces = 1000;

/// One triangle's use of an edge.
struct Use {
    std::int32_t low = 0, high = 0, triangle = 0;
    bool forward = true;  ///< walked from low to high
};

std::vector<Use> list_uses(const TriMesh& surface) {
    std::vector<Use> uses;
    uses.reserve(3 * surface.triangles.size());
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        for (int c = 0; c < 3; ++c) {
            const std::int32_t a = surface.triangles[t][c], b = surface.triangles[t][(c + 1) % 3];
            uses.push_back({std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t), a < b});
        }
    std::ranges::sort(uses, [](const Use& a, const Use& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    return uses;
}

/// Calls visit(first, last) for the uses of each edge.
template <class Visit>
void each_edge(const std::vector<Use>& uses, Visit&& visit) {
    for (std::size_t i = 0; i < uses.size();) {
        std::size_t end = i;
        while (end < uses.size() && uses[end].low == uses[i].low && uses[end].high == uses[i].high)
            ++end;
        visit(i, end);
        i = end;
    }
}

class Sets {
public:
    explicit Sets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    std::int32_t root(std::int32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::int32_t a, std::int32_t b) { parent_[root(a)] = root(b); }

private:
    std::vector<std::int32_t> parent_;
};

TriMesh without_doubles(const TriMesh& surface, HealSummary& summary) {
    TriMesh result;
    result.points = surface.points;
    std::set<Triangle> seen;
    for (Triangle t : surface.triangles) {
        const Triangle as_is = t;
        std::ranges::sort(t);
        if (t[0] == t[1] || t[1] == t[2]) continue;
        if (seen.insert(t).second)
            result.triangles.push_back(as_is);
        else
            ++summary.doubled_triangles;
    }
    return result;
}

void count_holes(const TriMesh& surface, const std::vector<Use>& uses, HealSummary& summary) {
    Sets rims(surface.points.size());
    std::vector<std::int32_t> ends;
    each_edge(uses, [&](std::size_t first, std::size_t last) {
        if (last - first != 1) return;
        ++summary.open_edges;
        rims.join(uses[first].low, uses[first].high);
        ends.push_back(uses[first].low);
    });
    std::set<std::int32_t> roots;
    for (const std::int32_t v : ends) roots.insert(rims.root(v));
    summary.holes = static_cast<std::int64_t>(roots.size());
}

/// Triangles that hang together by edges of two.
struct Pieces {
    std::vector<std::int32_t> of_triangle;
    std::vector<std::uint8_t> turned;  ///< per triangle: to be walked the other way
    std::vector<std::vector<std::int32_t>> triangles;
    std::vector<double> area;
};

double area_of(const TriMesh& surface, std::int32_t t) {
    const auto& [a, b, c] = surface.triangles[t];
    return 0.5 * (surface.points[b] - surface.points[a])
                     .cross(surface.points[c] - surface.points[a])
                     .norm();
}

/// Walks one piece from `start` on; false when it cannot be turned one way, as a
/// Möbius strip cannot.
bool walk_piece(const std::vector<std::vector<std::pair<std::int32_t, bool>>>& neighbours,
                std::int32_t start, std::int32_t number, Pieces& pieces) {
    bool good = true;
    std::vector<std::int32_t> found{start};
    pieces.of_triangle[start] = number;
    for (std::size_t n = 0; n < found.size(); ++n)
        for (const auto& [other, alike] : neighbours[found[n]]) {
            const std::uint8_t turned = pieces.turned[found[n]] ^ (alike ? 0 : 1);
            if (pieces.of_triangle[other] < 0) {
                pieces.of_triangle[other] = number;
                pieces.turned[other] = turned;
                found.push_back(other);
            } else {
                good &= pieces.turned[other] == turned;
            }
        }
    pieces.triangles.push_back(std::move(found));
    return good;
}

Pieces find_pieces(const TriMesh& surface, const std::vector<Use>& uses) {
    std::vector<std::vector<std::pair<std::int32_t, bool>>> neighbours(surface.triangles.size());
    each_edge(uses, [&](std::size_t first, std::size_t last) {
        if (last - first != 2) return;
        const Use &a = uses[first], &b = uses[first + 1];
        neighbours[a.triangle].emplace_back(b.triangle, a.forward != b.forward);
        neighbours[b.triangle].emplace_back(a.triangle, a.forward != b.forward);
    });
    Pieces pieces;
    pieces.of_triangle.assign(surface.triangles.size(), -1);
    pieces.turned.assign(surface.triangles.size(), 0);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        if (pieces.of_triangle[t] >= 0) continue;
        const bool good = walk_piece(neighbours, static_cast<std::int32_t>(t),
                                     static_cast<std::int32_t>(pieces.triangles.size()), pieces);
        double area = 0, turned = 0;
        for (const std::int32_t m : pieces.triangles.back()) {
            area += area_of(surface, m);
            turned += pieces.turned[m] ? area_of(surface, m) : 0;
        }
        pieces.area.push_back(area);
        // The larger part is taken to be right.
        for (const std::int32_t m : pieces.triangles.back())
            pieces.turned[m] = good ? pieces.turned[m] ^ (turned > 0.5 * area ? 1 : 0) : 0;
    }
    return pieces;
}

void turn(Pieces& pieces, std::int32_t piece) {
    for (const std::int32_t t : pieces.triangles[piece]) pieces.turned[t] ^= 1;
}

/// An open edge, walked as its triangle walks it.
struct Rim {
    Vec3 middle = Vec3::Zero(), along = Vec3::Zero();
    std::int32_t piece = 0;
};

std::vector<Rim> find_rims(const TriMesh& surface, const std::vector<Use>& uses,
                           const Pieces& pieces) {
    std::vector<Rim> rims;
    each_edge(uses, [&](std::size_t first, std::size_t last) {
        if (last - first != 1) return;
        const Use& u = uses[first];
        const Vec3 &a = surface.points[u.low], &b = surface.points[u.high];
        const bool forward = u.forward != (pieces.turned[u.triangle] != 0);
        rims.push_back(
            {0.5 * (a + b), forward ? Vec3(b - a) : Vec3(a - b), pieces.of_triangle[u.triangle]});
    });
    return rims;
}

/// How the rims of two pieces run along each other: against each other where
/// both face outwards. Lengths; negative says that one is to be turned.
struct Vote {
    std::int32_t a = 0, b = 0;
    double alike = 0, all = 0;
};

std::vector<Vote> compare_rims(const std::vector<Rim>& rims) {
    std::map<std::pair<std::int32_t, std::int32_t>, Vote> votes;
    for (const Rim& r : rims) {
        const double reach = kRimReach * r.along.norm();
        std::array<double, 2> nearest{reach, reach};  // running against it, running with it
        std::array<const Rim*, 2> found{nullptr, nullptr};
        for (const Rim& other : rims) {
            const double away = (other.middle - r.middle).norm();
            if (other.piece == r.piece || !(away < reach)) continue;
            const double cosine = r.along.normalized().dot(other.along.normalized());
            const int with = cosine > 0 ? 1 : 0;
            if (std::abs(cosine) > kAlong && away < nearest[with])
                nearest[with] = away, found[with] = &other;
        }
        const int with = nearest[1] < nearest[0] ? 1 : 0;
        // Where both run by, as between the teeth of a comb, neither tells.
        if (!found[with] || !(nearest[with] < kClearly * nearest[1 - with])) continue;
        const auto [a, b] = std::minmax(r.piece, found[with]->piece);
        Vote& vote = votes.try_emplace({a, b}, Vote{a, b}).first->second;
        vote.alike += (with ? -1 : 1) * r.along.norm();
        vote.all += r.along.norm();
    }
    std::vector<Vote> sorted;
    for (const auto& [pair, vote] : votes) sorted.push_back(vote);
    std::ranges::stable_sort(sorted, std::ranges::greater{},
                             [](const Vote& v) { return std::abs(v.alike); });
    return sorted;
}

/// Pieces that are known to face alike, and which of them are to be turned.
struct Clusters {
    std::vector<std::vector<std::int32_t>> members;
    std::vector<std::int32_t> of_piece;
    std::vector<std::uint8_t> turned;

    explicit Clusters(std::size_t count) : members(count), of_piece(count), turned(count, 0) {
        for (std::size_t p = 0; p < count; ++p)
            members[p] = {of_piece[p] = static_cast<std::int32_t>(p)};
    }
    void join(const Vote& vote) {
        std::int32_t into = of_piece[vote.a], from = of_piece[vote.b];
        if (into == from) return;
        const bool unlike = (vote.alike < 0) != (turned[vote.a] != turned[vote.b]);
        if (members[into].size() < members[from].size()) std::swap(into, from);
        for (const std::int32_t p : members[from]) {
            of_piece[p] = into;
            turned[p] ^= unlike ? 1 : 0;
            members[into].push_back(p);
        }
        members[from].clear();
    }
};

/// Joins pieces by their rims, the surest first: those that share enough of both
/// rims, then small ones with their neighbour, which must not link others.
Clusters match_rims(const TriMesh& surface, const std::vector<Use>& uses, const Pieces& pieces) {
    Clusters clusters(pieces.triangles.size());
    const std::vector<Rim> rims = find_rims(surface, uses, pieces);
    const auto count = static_cast<double>(rims.size());
    if (count * count > kMostPairs) return clusters;
    std::vector<double> length(clusters.members.size(), 0);
    for (const Rim& r : rims) length[r.piece] += r.along.norm();
    const auto sure = [&](const Vote& v, double rim) {
        return std::abs(v.alike) > kAgreement * v.all && v.all > kRimShare * rim;
    };
    const std::vector<Vote> votes = compare_rims(rims);
    for (const Vote& v : votes)
        if (sure(v, std::max(length[v.a], length[v.b]))) clusters.join(v);
    std::vector<std::uint8_t> small(length.size(), 0);
    for (const Vote& v : votes) {
        const bool a_is_small = pieces.area[v.a] < pieces.area[v.b];
        const std::int32_t less = a_is_small ? v.a : v.b, more = a_is_small ? v.b : v.a;
        if (!sure(v, length[less]) || small[more] ||
            clusters.members[clusters.of_piece[less]].size() > 1)
            continue;
        small[less] = 1;
        clusters.join(v);
    }
    return clusters;
}

TriMesh turned_surface(const TriMesh& surface, const Pieces& pieces) {
    TriMesh result = surface;
    for (std::size_t t = 0; t < result.triangles.size(); ++t)
        if (pieces.turned[t]) std::swap(result.triangles[t][1], result.triangles[t][2]);
    return result;
}

/// Volume of the cone over a cluster's triangles from the middle of their area.
struct Cone {
    double volume = 0, area = 0;
    Vec3 middle = Vec3::Zero();
};

Cone cone_of(const TriMesh& cluster) {
    Cone cone;
    const auto corner = [&](const Triangle& t, int c) { return cluster.points[t[c]]; };
    for (std::size_t t = 0; t < cluster.triangles.size(); ++t) {
        const double a = area_of(cluster, static_cast<std::int32_t>(t));
        const Triangle& v = cluster.triangles[t];
        cone.area += a;
        cone.middle += a / 3 * (corner(v, 0) + corner(v, 1) + corner(v, 2));
    }
    if (cone.area > 0) cone.middle /= cone.area;
    for (const Triangle& t : cluster.triangles)
        cone.volume += signed_volume(cone.middle, corner(t, 0), corner(t, 1), corner(t, 2));
    return cone;
}

/// Turns what has a negative volume and does not lie inside something else.
void turn_clusters(const TriMesh& surface, Pieces& pieces,
                   const std::vector<std::vector<std::int32_t>>& clusters) {
    const auto count = std::ranges::count_if(clusters, [](const auto& c) { return !c.empty(); });
    if (count > kMostPieces) return;
    for (const auto& cluster : clusters) {
        if (cluster.empty()) continue;
        const TriMesh turned = turned_surface(surface, pieces);
        TriMesh own{surface.points, {}}, rest{surface.points, {}};
        std::vector<std::uint8_t> is_own(pieces.triangles.size(), 0);
        for (const std::int32_t p : cluster) is_own[p] = 1;
        for (std::size_t t = 0; t < turned.triangles.size(); ++t)
            (is_own[pieces.of_triangle[t]] ? own : rest).triangles.push_back(turned.triangles[t]);
        const Cone cone = cone_of(own);
        if (!(cone.volume < -kSolid * std::pow(cone.area, 1.5))) continue;
        const double around = exact_winding_number(build_winding_tree(rest), cone.middle);
        if (around > 0.5) continue;  // a cavity
        for (const std::int32_t p : cluster) turn(pieces, p);
    }
}

}  // namespace

TriMesh orient_surface(const TriMesh& surface, HealSummary& summary) {
    const TriMesh clean = without_doubles(surface, summary);
    const std::vector<Use> uses = list_uses(clean);
    count_holes(clean, uses, summary);
    Pieces pieces = find_pieces(clean, uses);
    const Clusters clusters = match_rims(clean, uses, pieces);
    for (std::size_t p = 0; p < clusters.turned.size(); ++p)
        if (clusters.turned[p]) turn(pieces, static_cast<std::int32_t>(p));
    turn_clusters(clean, pieces, clusters.members);
    summary.turned_triangles = std::accumulate(pieces.turned.begin(), pieces.turned.end(), 0);
    return turned_surface(clean, pieces);
}

}  // namespace myotet::levelset
