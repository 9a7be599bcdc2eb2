// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Active.h"

#include <algorithm>

namespace myotet::membrane {

namespace {

class Gathering {
public:
    Gathering(const Levels& levels, const Selection& selection,
              std::span<const LevelProperties> properties)
        : levels_(levels), selection_(selection), properties_(properties) {
        active_.mass.assign(levels.rest.size(), 0);
        edges_of_.assign(levels.rest.size(), 0);
        touched_.assign(levels.rest.size(), 0);
    }

    Active run() {
        std::vector<std::int32_t> now(levels_.meshes[0].triangles.size()), finer;
        for (std::size_t f = 0; f < now.size(); ++f) now[f] = static_cast<std::int32_t>(f);
        for (int level = 0; !now.empty(); ++level) {
            active_.finest = level;
            gather_level(level, now, finer);
            std::swap(now, finer);
        }
        for (std::size_t v = 0; v < edges_of_.size(); ++v)
            if (edges_of_[v] > 0) active_.nodes.push_back(static_cast<std::int32_t>(v));
        share_mass();
        return std::move(active_);
    }

private:
    const Levels& levels_;
    const Selection& selection_;
    std::span<const LevelProperties> properties_;
    Active active_;
    std::vector<int> edges_of_;  // how many a node's mass is the mean of
    std::vector<char> touched_;  // by a refined triangle

    bool refined(int level, std::int32_t f) const {
        return level < levels_.finest() && selection_.is_refined(level, f);
    }
    // Whether the triangle beyond a half-edge is finer, or coarser.
    bool finer_beyond(int level, std::int32_t h) const {
        const std::int32_t twin = levels_.meshes[level].twin[h];
        return twin >= 0 && selection_.exists(level, twin / 3) && refined(level, twin / 3);
    }

    void gather_level(int level, const std::vector<std::int32_t>& now,
                      std::vector<std::int32_t>& finer) {
        const HalfEdges& mesh = levels_.meshes[level];
        finer.clear();
        for (const std::int32_t f : now) {
            if (refined(level, f)) {
                for (std::int32_t part = 4 * f; part < 4 * f + 4; ++part) finer.push_back(part);
                for (const std::int32_t v : mesh.triangles[f]) touched_[v] = 1;
                for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h)
                    touched_[levels_.midpoint(level, h)] = 1;
                continue;
            }
            for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) add_side(level, h);
            draw(level, f);
        }
    }

    // The triangle beyond: of the same level, finer, coarser or none. The first
    // is visited for both sides, the one with the smaller half-edge adds the spring.
    void add_side(int level, std::int32_t h) {
        const HalfEdges& mesh = levels_.meshes[level];
        const std::int32_t twin = mesh.twin[h], a = mesh.from(h), b = mesh.to(h);
        const bool beside = twin >= 0 && selection_.exists(level, twin / 3);
        const bool finer = finer_beyond(level, h);
        if (beside && !finer && twin < h) return;
        const double share = beside && !finer ? 1 : 0.5;
        const LevelProperties& p = properties_[level];
        active_.springs.push_back({a, b, (levels_.rest[a] - levels_.rest[b]).norm(),
                                   share * p.stiffness, share * p.damping});
        if (finer) {  // the finer side's two edges count for mass, not this one
            active_.hanging.push_back({.node = levels_.midpoint(level, h), .a = a, .b = b});
            return;
        }
        for (const std::int32_t v : {a, b}) {  // [Choi05, eq. 7]
            active_.mass[v] += p.mass;
            ++edges_of_[v];
        }
    }

    void draw(int level, std::int32_t f) {
        const Triangle& t = levels_.meshes[level].triangles[f];
        Triangle m{};
        std::array<bool, 3> hangs{};
        for (int i = 0; i < 3; ++i) {
            hangs[i] = finer_beyond(level, 3 * f + i);
            if (hangs[i]) m[i] = levels_.midpoint(level, 3 * f + i);
        }
        const auto count = std::count(hangs.begin(), hangs.end(), true);
        ++active_.types[count];
        auto& drawn = active_.drawn;
        if (count == 0) drawn.push_back(t);
        if (count == 3) {
            drawn.insert(
                drawn.end(),
                {{t[0], m[0], m[2]}, {t[1], m[1], m[0]}, {t[2], m[2], m[1]}, {m[0], m[1], m[2]}});
        }
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            if (count == 1 && hangs[i])
                drawn.insert(drawn.end(), {{t[i], m[i], t[k]}, {m[i], t[j], t[k]}});
            if (count == 2 && !hangs[k])  // both other sides meet at corner j
                drawn.insert(drawn.end(),
                             {{m[i], t[j], m[j]}, {t[i], m[i], m[j]}, {t[i], m[j], t[k]}});
        }
        active_.drawn_level.resize(drawn.size(), level);
    }

    void share_mass() {
        double total = 0, kept = 0, changed = 0;
        total = properties_[0].mass * levels_.given();
        for (const std::int32_t v : active_.nodes) {
            active_.mass[v] /= edges_of_[v];
            (touched_[v] ? changed : kept) += active_.mass[v];
        }
        for (const std::int32_t v : active_.nodes)
            if (touched_[v]) active_.mass[v] *= (total - kept) / changed;
        active_.inertia = active_.mass;
        for (std::size_t i = active_.hanging.size(); i-- > 0;) {
            const Hanging& h = active_.hanging[i];
            active_.inertia[h.a] += active_.inertia[h.node] / 2;
            active_.inertia[h.b] += active_.inertia[h.node] / 2;
            active_.inertia[h.node] = 0;
        }
    }
};

// Beyond, an edge points back to where it came from and no turn is the least.
constexpr double kOpposite = 1e-6;

}  // namespace

Vec3 turned_offset(const Hanging& h, const Vec3& edge) {
    const Vec3 u = edge.normalized(), w = h.edge.cross(u);
    const double c = h.edge.dot(u);
    if (!(1 + c > kOpposite)) return h.offset;
    return c * h.offset + w.cross(h.offset) + w.dot(h.offset) / (1 + c) * w;
}

// With o x, u0 x as matrices and P = (1 - u u^T) / |b - a|,
// J = (o u0^T - (o x)(u0 x) + (w . o (u0 x) + w (o^T (u0 x))) / (1 + c)
//      - w . o / (1 + c)^2 w u0^T) P
Vec3 turned_by(const Hanging& h, const Vec3& edge, const Vec3& change) {
    const double length = edge.norm();
    const Vec3 &o = h.offset, &from = h.edge, u = edge / length, w = from.cross(u);
    const double c1 = 1 + from.dot(u), wo = w.dot(o);
    if (!(c1 > kOpposite)) return Vec3::Zero();
    const Vec3 q = (change - u.dot(change) * u) / length, across = from.cross(q);
    const double along = from.dot(q);
    return along * o - o.cross(across) + wo / c1 * across +
           (o.dot(across) / c1 - wo * along / (c1 * c1)) * w;
}

Vec3 couple_of(const Hanging& h, const Vec3& edge, const Vec3& f) {
    const double length = edge.norm();
    const Vec3 &o = h.offset, &from = h.edge, u = edge / length, w = from.cross(u);
    const double c1 = 1 + from.dot(u), wo = w.dot(o), wf = w.dot(f);
    if (!(c1 > kOpposite)) return Vec3::Zero();
    const Vec3 by_u = (o.dot(f) - wo * wf / (c1 * c1)) * from - from.cross(o.cross(f)) +
                      wo / c1 * f.cross(from) + wf / c1 * o.cross(from);
    return (by_u - u.dot(by_u) * u) / length;
}

Active make_active(const Levels& levels, const Selection& selection,
                   std::span<const LevelProperties> properties) {
    return Gathering(levels, selection, properties).run();
}

}  // namespace myotet::membrane
