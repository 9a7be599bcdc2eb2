// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Criteria.h"

#include <algorithm>
#include <cmath>

#include "Core/Nearest.h"
#include "Membrane/Contact.h"
#include "Membrane/Require.h"

namespace myotet::membrane {

namespace {

// Marks of a level's vertices, spread over rings of its triangles.
class Marks {
public:
    Marks(const Levels& levels, const Selection& selection) : levels_(levels), sel_(selection) {}

    // Triangles of a level with a vertex of which `is` holds for one in use below.
    template <class Is>
    std::vector<char> near(int level, int rings, const Is& is) const {
        const HalfEdges& mesh = levels_.meshes[level];
        const auto count = static_cast<std::int32_t>(mesh.triangles.size());
        std::vector<char> vertex(mesh.vertex_count, 0), triangle(count, 0);
        for (std::int32_t f = 0; f < count; ++f)
            triangle[f] = static_cast<char>(sel_.exists(level, f) && any_below(level, f, is));
        for (int ring = 0; ring < rings; ++ring) {
            for (std::int32_t f = 0; f < count; ++f)
                for (const std::int32_t v : mesh.triangles[f]) vertex[v] |= triangle[f];
            for (std::int32_t f = 0; f < count; ++f)
                for (const std::int32_t v : mesh.triangles[f]) triangle[f] |= vertex[v];
        }
        return triangle;
    }

private:
    const Levels& levels_;
    const Selection& sel_;

    template <class Is>
    bool any_below(int level, std::int32_t f, const Is& is) const {
        for (const std::int32_t v : levels_.meshes[level].triangles[f])
            if (is(v)) return true;
        if (level == levels_.finest() || !sel_.is_refined(level, f)) return false;
        for (std::int32_t part = 4 * f; part < 4 * f + 4; ++part)
            if (any_below(level + 1, part, is)) return true;
        return false;
    }
};

// Marks the corner of each triangle that a tool is near to which is nearest to it.
void look_ahead(const Criteria& criteria, const Body& body, const Motion& motion, const Tool& tool,
                Watch& watch) {
    const Vec3 at = place_of(tool, body, motion);
    const bool sphere = tool.shape == Tool::Shape::sphere;
    const double within = tool.radius + criteria.reach;
    for (const Triangle& t : body.active.drawn) {
        const Vec3 &a = motion.x[t[0]], &b = motion.x[t[1]], &c = motion.x[t[2]];
        const Vec3 middle = (a + b + c) / 3;
        const double size = std::sqrt(std::max(
            {(a - middle).squaredNorm(), (b - middle).squaredNorm(), (c - middle).squaredNorm()}));
        if (sphere && (middle - at).squaredNorm() > (within + size) * (within + size)) continue;
        const Vec3 to = sphere ? nearest_on_triangle(at, a, b, c).point : at;
        const auto nearer = [&](std::int32_t v, std::int32_t w) {
            return sphere ? (motion.x[v] - to).squaredNorm() < (motion.x[w] - to).squaredNorm()
                          : tool.normal.dot(motion.x[v] - motion.x[w]) < 0;
        };
        const std::int32_t corner = *std::min_element(t.begin(), t.end(), nearer);
        if (!(depth_in(tool, at, sphere ? to : motion.x[corner]).depth > -criteria.reach)) continue;
        watch.hot[corner] = 1;
        watch.calm_from[corner] = motion.time + criteria.calm;
    }
}

}  // namespace

void Criteria::validate() const {
    const auto positive = [](const char* field, double value, const char* rule) {
        require(std::isfinite(value) && value > 0, field, value, rule);
    };
    positive("criteria.traction", traction,
             "must be above 0 MPa: everything would be refined always");
    positive("criteria.speed", speed, "must be above 0 mm/s: everything would be refined always");
    positive("criteria.curvature", curvature,
             "must be above 0 1/mm: everything would be refined always");
    require(std::isfinite(reach) && reach >= 0, "criteria.reach", reach,
            "must be a length in mm, 0 or more");
    positive("criteria.interval", interval, "must be a time in s above 0");
    require(release > 0 && release < 1, "criteria.release", release, "must be between 0 and 1");
    require(std::isfinite(calm) && calm >= 0, "criteria.calm", calm,
            "must be a time in s, 0 or more");
    require(rings >= 0, "criteria.rings", rings, "must be 0 or more");
}

std::vector<double> mean_curvatures(const Active& active, std::span<const Vec3> x) {
    std::vector<Vec3> normal(x.size(), Vec3::Zero());
    for (const auto& [a, b, c] : active.drawn) {
        const Vec3 n = (x[b] - x[a]).cross(x[c] - x[a]);
        for (const std::int32_t v : {a, b, c}) normal[v] += n;
    }
    std::vector<double> sum(x.size(), 0);
    std::vector<int> count(x.size(), 0);
    for (const std::int32_t i : active.nodes) normal[i].stableNormalize();
    for (const Spring& s : active.springs) {
        const Vec3 d = x[s.a] - x[s.b];
        const double square = d.squaredNorm();
        if (!(square > 0)) continue;
        sum[s.a] += 2 * normal[s.a].dot(d) / square;
        sum[s.b] -= 2 * normal[s.b].dot(d) / square;
        ++count[s.a];
        ++count[s.b];
    }
    for (const std::int32_t i : active.nodes)
        if (count[i] > 0) sum[i] /= count[i];
    return sum;
}

void look(const Criteria& criteria, const Body& body, const Motion& motion,
          std::span<const Vec3> pressing, Watch& watch) {
    const Active& active = body.active;
    watch.calm_from.resize(motion.x.size(), 0);
    watch.hot.assign(motion.x.size(), 0);
    const auto now = mean_curvatures(active, motion.x);
    const auto rest = mean_curvatures(active, body.levels.rest);
    const double per_mass = criteria.traction / (body.wall.thickness * body.wall.density);
    for (const std::int32_t i : active.nodes) {
        const double part = std::max({pressing[i].norm() / (per_mass * active.mass[i]),
                                      motion.v[i].norm() / criteria.speed,
                                      std::abs(now[i] - rest[i]) / criteria.curvature});
        watch.hot[i] = static_cast<char>(part > 1);
        if (part > criteria.release) watch.calm_from[i] = motion.time + criteria.calm;
    }
    for (const Tool& tool : body.loads.tools) look_ahead(criteria, body, motion, tool, watch);
}

bool adapt(const Criteria& criteria, const Levels& levels, const Watch& watch, double time,
           Selection& selection) {
    const Selection before = selection;
    const Marks marks(levels, before);
    bool changed = false;
    for (int level = levels.finest() - 1; level >= 0; --level) {
        const auto wanted =
            marks.near(level, criteria.rings, [&](auto v) { return watch.hot[v] != 0; });
        const auto kept =
            marks.near(level, criteria.rings, [&](auto v) { return watch.calm_from[v] > time; });
        for (std::int32_t f = 0; f < static_cast<std::int32_t>(wanted.size()); ++f) {
            if (!before.exists(level, f) || !selection.exists(level, f)) continue;
            if (wanted[f] && !selection.is_refined(level, f)) {
                refine(levels, selection, level, f);
                changed = true;
            } else if (!kept[f] && !wanted[f] && before.is_refined(level, f)) {
                changed |= simplify(levels, selection, level, f);
            }
        }
    }
    return changed;
}

}  // namespace myotet::membrane
