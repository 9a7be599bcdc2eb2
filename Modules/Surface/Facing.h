// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "Surface/Fans.h"
#include "Surface/Field.h"

namespace myotet::surface {

/// A corner of a triangle that is or might be: a point of phi = 0 and the unit
/// normal there.
struct Corner {
    Vec3 point, normal;
};
[[nodiscard]] inline Corner corner_of(const Fans& fans, std::int32_t v) {
    return {fans.points[v], fans.normals[v]};
}

/// Which way a triangle faces. Outward, when its normal is within 78 degrees of the
/// surface's at all three corners; where the corners do not agree, at a sharp edge,
/// the gradient of phi at the triangle's centre decides, within 78 degrees of which
/// it must be. Turned over, when it is against all four.
enum class Facing { outward, sideways, turned_over };
[[nodiscard]] Facing facing(const Field& phi, const Corner& a, const Corner& b, const Corner& c);
[[nodiscard]] Facing facing(const Fans& fans, const Field& phi, const Triangle& t);
[[nodiscard]] bool faces_outward(const Fans& fans, const Field& phi, const Triangle& t);

/// How bad that is. What may not be in a finished mesh weighs more than all else that
/// is wrong about a point: no change may trade it for anything.
inline constexpr int kBroken = 1000;
[[nodiscard]] int weight(Facing facing);

/// Triangles that are to be made around a point, and what is wrong with them.
class Umbrella {
public:
    Umbrella(const Fans& fans, const Field& phi, std::int32_t v, const Corner& at)
        : fans_(fans), phi_(phi), v_(v), at_(at) {}
    /// The triangle (v, b, c), in place of triangle `old`.
    void add(std::int32_t b, std::int32_t c, std::int32_t old);
    /// Instead of which nothing is made.
    void remove(std::int32_t old) { old_.push_back(old); }
    /// How many do not face outward, by weight, of edges between them that turn by
    /// more than 120 degrees, of triangles about watched points that they cross, and
    /// one more when the surface's normal at v is against their mean, as it is on the
    /// far side of a thin sheet.
    [[nodiscard]] int faults() const;

private:
    const Fans& fans_;
    const Field& phi_;
    std::int32_t v_;
    Corner at_;
    std::vector<std::int32_t> old_;
    std::vector<Placed> made_;
    std::vector<Vec3> normals_;
    int faults_ = 0;
};

/// Umbrella::faults of the triangles around point v if it is at `at`; 0: nothing
/// is wrong.
[[nodiscard]] int faults_around(const Fans& fans, const Field& phi, std::int32_t v,
                                const Corner& at);

/// How many triangles about watched points, other meshes' too, cross those that are
/// to be made in place of `old`, these among themselves included; 0 where no corner
/// is watched.
[[nodiscard]] int count_crossings(const Fans& fans, std::span<const Placed> made,
                                  std::span<const std::int32_t> old);

/// Whether v may go to `at`: no more is wrong there than where it is.
[[nodiscard]] bool may_move(const Fans& fans, const Field& phi, std::int32_t v, const Corner& at);

/// Where a point next to `at` comes to rest on phi = 0, on the rim on trim = 0
/// too; nothing where `project` finds nothing.
[[nodiscard]] std::optional<Corner> landing(const Guide& guide, const Vec3& at, double reach,
                                            bool on_rim);
/// Where point v of a mesh comes to rest on its level sets next to `at`.
[[nodiscard]] std::optional<Corner> landing(const Fans& fans, const Guide& guide, std::int32_t v,
                                            const Vec3& at);

}  // namespace myotet::surface
