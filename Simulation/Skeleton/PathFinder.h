// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Skeleton/Path.h"

namespace myotet::skeleton {

/// A point of the muscle that is there, in ground.
struct PlacedPoint {
    int index = 0;
    Vec3 at = Vec3::Zero();
};

/// Of those points that are there at these values of the coordinates.
[[nodiscard]] std::vector<PlacedPoint> place_points(const Muscle& muscle,
                                                    std::span<const Pose> bodies,
                                                    std::span<const double> values);

/// A path between points that are there, while objects are added to it and lift off it.
class PathFinder {
public:
    PathFinder(const Model& model, const Muscle& muscle, std::span<const Pose> bodies,
               std::span<const double> values);

    /// Takes up contacts and sides as remembered.
    void recall(const PathMemory& memory);
    /// Adds contacts and drops them until the path is taut over all objects.
    void find();
    void remember(PathMemory& memory) const;
    [[nodiscard]] Path path() const;

private:
    using Contact = PathMemory::Contact;
    /// A wrap with its object as placed.
    struct Tool {
        const WrapObject* object;
        WrapSurface surface;
        Pose pose;
        int first, last;  ///< places of points between which it acts
    };
    /// A straight piece: after how many contacts it comes, its ends.
    struct Straight {
        std::size_t after;
        std::size_t place;  ///< of the point of the path before it
        Vec3 from, to;
        bool from_point, to_point;  ///< its ends are points of the muscle
    };
    /// How a wrap would act on a straight piece.
    struct Candidate {
        Straight piece;
        Wrap wrap;
        double longer = 0;
    };

    [[nodiscard]] std::size_t place_of(int begin, int end) const;
    [[nodiscard]] bool has_piece(int begin, int end) const;
    [[nodiscard]] std::vector<Straight> straight_pieces() const;
    [[nodiscard]] Straight around(std::size_t contact) const;
    [[nodiscard]] bool act(std::size_t contact, double& moved);
    void tighten();
    [[nodiscard]] bool add(int wrap);
    void look_through(int wrap);
    [[nodiscard]] bool make_room(int wrap);
    [[nodiscard]] std::vector<PathMemory::Pass>::iterator pass_of(int wrap, const Straight& piece);
    void keep_side(int wrap, const Straight& piece, const Vec3& side);
    void insert(int wrap, const Candidate& candidate);
    [[nodiscard]] Wrap try_wrap(int wrap, const Straight& piece, const WrapMemory& before) const;
    [[nodiscard]] int count(int wrap) const;

    const Model& model_;
    const Muscle& muscle_;
    std::vector<PlacedPoint> points_;
    std::vector<Tool> tools_;
    std::vector<Contact> contacts_;
    std::vector<PathMemory::Pass> passes_;
    std::vector<char> inside_, missed_, made_room_;
    double scale_ = 0;    ///< of the path, mm
    bool loose_ = false;  ///< contacts did not come to rest
};

}  // namespace myotet::skeleton
