// SPDX-License-Identifier: Apache-2.0
#include "Surface/Trim.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "Core/Parallel.h"

namespace myotet::surface {
namespace {

constexpr std::size_t kGrain = 256;
constexpr double kLeastFraction = 0.25;  // [Teran05, sec. 6]: "25% inside"
constexpr int kDriveSteps = 60;
constexpr double kDriveReach = 0.2;  // of an edge, a step
constexpr double kArrived = 0.002;   // of an edge
constexpr double kSpringStep = 0.5;  // of the way to where the springs want a point

std::vector<double> sample(const Fans& fans, const Field& field) {
    std::vector<double> values(fans.points.size(), 0);
    parallel_for(0, values.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t v = first; v < last; ++v)
            if (!fans.around[v].empty()) values[v] = field(fans.points[v]).value;
    });
    return values;
}

bool well_outside(const Fans& fans, const std::vector<double>& psi, std::int32_t v) {
    if (!(psi[v] > 0)) return false;
    return std::ranges::all_of(neighbours(fans, v), [&](std::int32_t n) {
        return psi[n] > 0 || psi[v] >= kLeastFraction * (psi[v] - psi[n]);
    });
}

/// Grows a set of enveloped points until the triangles around them form a
/// surface that keeps the rules.
class Selection {
public:
    Selection(const Fans& fans, std::vector<char> enveloped)
        : fans_(fans), enveloped_(std::move(enveloped)) {
        queue_.resize(fans.points.size());
        std::iota(queue_.begin(), queue_.end(), 0);
        while (!queue_.empty()) {
            std::vector<std::int32_t> now;
            now.swap(queue_);
            for (const std::int32_t v : now)
                if (breaks_a_rule(v)) envelop(v);
        }
    }

    [[nodiscard]] bool keeps(std::int32_t triangle) const {
        const Triangle& t = fans_.triangles[triangle];
        return t[0] >= 0 && (enveloped_[t[0]] || enveloped_[t[1]] || enveloped_[t[2]]);
    }

private:
    void envelop(std::int32_t v) {
        enveloped_[v] = 1;
        for (const std::int32_t n : neighbours(fans_, v)) {
            queue_.push_back(n);
            for (const std::int32_t m : neighbours(fans_, n)) queue_.push_back(m);
        }
    }

    /// A boundary point's kept triangles are one fan, and an edge that has two of
    /// them joins it to an enveloped point.
    [[nodiscard]] bool breaks_a_rule(std::int32_t v) const {
        if (enveloped_[v]) return false;
        int ends = 0;
        for (const std::int32_t n : neighbours(fans_, v)) {
            const EdgeStar star = edge_star(fans_, v, n);
            const int kept = (star.triangle[0] >= 0 && keeps(star.triangle[0])) +
                             (star.triangle[1] >= 0 && keeps(star.triangle[1]));
            if (kept == 2 && !enveloped_[n]) return true;
            ends += kept == 1;
        }
        return ends > 2;
    }

    const Fans& fans_;
    std::vector<char> enveloped_;
    std::vector<std::int32_t> queue_;
};

void remove_triangle(Fans& fans, std::int32_t t) {
    for (const std::int32_t v : fans.triangles[t]) {
        auto& list = fans.around[v];
        list.erase(std::ranges::find(list, t));
    }
    fans.triangles[t] = {-1, -1, -1};
}

/// Number of the piece of each point, by first point; -1 for removed points.
std::vector<std::int32_t> pieces_of_points(const Fans& fans, int& count) {
    std::vector<std::int32_t> piece(fans.points.size(), -1);
    std::vector<std::int32_t> stack;
    count = 0;
    for (std::size_t seed = 0; seed < piece.size(); ++seed) {
        if (piece[seed] >= 0 || fans.around[seed].empty()) continue;
        stack.assign(1, static_cast<std::int32_t>(seed));
        piece[seed] = count;
        while (!stack.empty()) {
            const std::int32_t v = stack.back();
            stack.pop_back();
            for (const std::int32_t n : neighbours(fans, v))
                if (piece[n] < 0) {
                    piece[n] = count;
                    stack.push_back(n);
                }
        }
        ++count;
    }
    return piece;
}

/// Mean of where the springs at v want it: each at its own length from its end.
Vec3 spring_pull(const Fans& fans, std::int32_t v) {
    Vec3 pull = Vec3::Zero();
    double count = 0;
    for (const std::int32_t n : neighbours(fans, v)) {
        const Vec3 d = fans.points[n] - fans.points[v];
        const double rest = 0.5 * (fans.sizes[v] + fans.sizes[n]);
        pull += (1 - rest / std::max(d.norm(), 1e-9 * rest)) * d;
        ++count;
    }
    return count > 0 ? Vec3(pull / count) : pull;
}

/// Along the surface towards trim = 0, by at most a part of an edge.
Vec3 way_to_trim(const Fans& fans, const FieldSample& psi, std::int32_t v) {
    const Vec3& n = fans.normals[v];
    const Vec3 slope = psi.gradient - n.dot(psi.gradient) * n;
    const double steep = slope.squaredNorm();
    const double most = kDriveReach * fans.sizes[v];
    if (!(steep > 1e-6)) return Vec3::Zero();
    const Vec3 way = -psi.value / steep * slope;
    return way.norm() > most ? Vec3(way * (most / way.norm())) : way;
}

bool is_landed(const Fans& fans, const Guide& guide, std::int32_t v) {
    const Vec3& p = fans.points[v];
    return std::max(std::abs(guide.phi(p).value), std::abs(guide.trim(p).value)) <=
           kArrived * fans.sizes[v];
}

/// One step of all points; returns how far the rim is from trim = 0, in edges.
double drive_once(Fans& fans, const Guide& guide) {
    std::vector<std::optional<Corner>> wanted(fans.points.size());
    std::vector<double> off(fans.points.size(), 0);
    parallel_for(0, wanted.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const auto v = static_cast<std::int32_t>(i);
            if (fans.around[v].empty()) continue;
            const Vec3& n = fans.normals[v];
            Vec3 step = kSpringStep * spring_pull(fans, v);
            step -= n.dot(step) * n;
            if (fans.rim[v]) {
                const FieldSample psi = guide.trim(fans.points[v]);
                off[v] = std::abs(psi.value) / fans.sizes[v];
                const Vec3 across = psi.gradient.normalized();
                step += way_to_trim(fans, psi, v) - across.dot(step) * across;
            }
            wanted[i] = landing({.phi = guide.phi}, fans.points[v] + step, fans.sizes[v], false);
        }
    });
    move_all(fans, guide.phi, wanted);
    return *std::ranges::max_element(off);
}

}  // namespace

Cut select_outside(Fans& fans, const Guide& guide) {
    const std::vector<double> psi = sample(fans, guide.trim);
    std::vector<char> enveloped(fans.points.size(), 0);
    bool inside = false, outside = false;
    for (std::size_t v = 0; v < psi.size(); ++v) {
        if (fans.around[v].empty()) continue;
        enveloped[v] = well_outside(fans, psi, static_cast<std::int32_t>(v));
        outside |= enveloped[v] != 0;
        inside |= psi[v] <= 0;
    }
    if (!inside) return Cut::none;
    const Selection selection(fans, std::move(enveloped));
    const auto count = static_cast<std::int32_t>(fans.triangles.size());
    std::vector<std::int32_t> discarded;
    for (std::int32_t t = 0; t < count; ++t)
        if (fans.alive(t) && !selection.keeps(t)) discarded.push_back(t);
    for (const std::int32_t t : discarded) remove_triangle(fans, t);
    find_rim(fans);
    if (discarded.empty()) return Cut::none;
    return outside ? Cut::some : Cut::everything;
}

void keep_largest_pieces(Fans& fans, int count) {
    int pieces = 0;
    const std::vector<std::int32_t> piece = pieces_of_points(fans, pieces);
    if (count <= 0 || pieces <= count) return;
    std::vector<double> area(pieces, 0);
    for (std::size_t t = 0; t < fans.triangles.size(); ++t) {
        if (!fans.alive(t)) continue;
        const Triangle& f = fans.triangles[t];
        area[piece[f[0]]] +=
            double_area(fans.points[f[0]], fans.points[f[1]], fans.points[f[2]]).norm();
    }
    std::vector<std::int32_t> order(pieces);
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::greater{}, [&](std::int32_t p) { return area[p]; });
    std::vector<char> kept(pieces, 0);
    for (int i = 0; i < count; ++i) kept[order[i]] = 1;
    for (std::size_t t = 0; t < fans.triangles.size(); ++t)
        if (fans.alive(t) && !kept[piece[fans.triangles[t][0]]])
            remove_triangle(fans, static_cast<std::int32_t>(t));
}

void drive_rim(Fans& fans, const Guide& guide) {
    for (int step = 0; step < kDriveSteps; ++step) {
        if (drive_once(fans, guide) < kArrived) break;
        even_valences(fans, guide);
    }
    place_all(fans, guide);
    land_rim(fans, guide);
}

void land_rim(Fans& fans, const Guide& guide) {
    for (std::size_t i = 0; i < fans.points.size(); ++i) {
        const auto v = static_cast<std::int32_t>(i);
        if (!fans.rim[i] || fans.around[i].empty() || is_landed(fans, guide, v)) continue;
        const auto [next, last] = rim_neighbours(fans, v);
        if (place(fans, guide, v, fans.points[v]) || next < 0 || last < 0) continue;
        const Vec3 &a = fans.points[next], &b = fans.points[last];
        for (const double share : {0.5, 0.3, 0.7})
            if (place(fans, guide, v, a + share * (b - a))) break;
    }
}

}  // namespace myotet::surface
