// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/SliceShape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace myotet::levelset {
namespace {

constexpr double kFar = 1e9;
constexpr int kMargin = 4;  // pixels around sections that have a distance of their own
// Volume of half a slice under 1 - gamma t^2: 2 / (3 sqrt(gamma)) = 1 / 2.
constexpr double kBlunt = 16.0 / 9.0;
// The steepest shrinking that a cap goes on with: a tip that the last slice only touches.
constexpr double kSteepest = 100;
// The steepest slope at a slice, in rises to the next: an ellipsoid's last one
// has about twice, and up to three times the cubic does not swing beyond its ends.
constexpr double kSteep = 2;
// Sections that share less than this part of the smaller one are met along
// their own direction; those that share kWell or more straight across.
constexpr double kPoorly = 0.4, kWell = 0.8;

// What the sections of a slice give to the maps, with maps made once only.
class Builder {
public:
    Builder(const RegionMap& map, RegionMap::Owner owner, int axis, const Vec3& plane_spacing)
        : sections_(find_sections(map, owner, axis)), scan_slices_(map.size[axis]) {
        const auto axes = slice_axes(axis);
        spacing_ = {plane_spacing[axes[0]], plane_spacing[axes[1]]};
        shape_.axis = axis;
        shape_.thickness = plane_spacing[axis];
        shape_.pixel = std::min(spacing_[0], spacing_[1]);
        shape_.first_gap = sections_.first_slice - 1;
        by_slice_.resize(sections_.slices + 2);
        for (std::size_t n = 0; n < sections_.sections.size(); ++n)
            by_slice_[sections_.sections[n].slice - shape_.first_gap].push_back(
                static_cast<int>(n));
    }

    SliceShape build() {
        for (int gap = 0; gap <= sections_.slices; ++gap) {
            shape_.gaps.push_back(shape_.pieces.size());
            add_caps(by_slice_[gap], true);
            add_caps(by_slice_[gap + 1], false);
            add_links(by_slice_[gap]);
        }
        shape_.gaps.push_back(shape_.pieces.size());
        return std::move(shape_);
    }

private:
    int map_of(std::vector<int> which) {
        if (which.empty()) return -1;
        std::sort(which.begin(), which.end());
        which.erase(std::unique(which.begin(), which.end()), which.end());
        const auto [it, fresh] = numbers_.emplace(which, static_cast<int>(shape_.maps.size()));
        if (fresh)
            shape_.maps.push_back(slice_distances(sections_.mask_of(which, kMargin), spacing_));
        return it->second;
    }

    // The sections that these lie on, or that lie on these.
    std::vector<int> beyond(const std::vector<int>& which, bool above) const {
        std::vector<int> out;
        for (const int n : which) {
            const auto& next = above ? sections_.sections[n].above : sections_.sections[n].below;
            out.insert(out.end(), next.begin(), next.end());
        }
        return out;
    }

    // (area / length)^2, to which a section's squared radius is in proportion,
    // be it round or long; the length from its moments. 0 for none.
    double squared_radius(const std::vector<int>& which) const {
        double area = 0;
        Point2 centre{0, 0};
        for (const int n : which) {
            const Section& s = sections_.sections[n];
            area += static_cast<double>(s.area);
            for (int a = 0; a < 2; ++a) centre[a] += static_cast<double>(s.area) * s.centre[a];
        }
        if (!(area > 0)) return 0;
        double xx = 1.0 / 12, xy = 0, yy = xx;  // of a pixel
        for (const int n : which) {
            const Section& s = sections_.sections[n];
            const double share = static_cast<double>(s.area) / area;
            const double x = s.centre[0] - centre[0] / area, y = s.centre[1] - centre[1] / area;
            xx += share * (s.spread[0] + x * x);
            xy += share * (s.spread[1] + x * y);
            yy += share * (s.spread[2] + y * y);
        }
        xx *= spacing_[0] * spacing_[0], xy *= spacing_[0] * spacing_[1];
        yy *= spacing_[1] * spacing_[1];
        const double longest = 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
        return area * area / longest;
    }

    // The cap beyond one side of sections, from their other side.
    SliceCap cap_beyond(const std::vector<int>& which, bool above) const {
        const auto before = beyond(which, !above);
        return cap_of(squared_radius(which), squared_radius(before),
                      squared_radius(beyond(before, !above)));
    }

    // Where a capped section is heading, pixels a slice: from the one before, if alike.
    Point2 heading(int section, bool above) const {
        const Section& s = sections_.sections[section];
        const auto& from = above ? s.below : s.above;
        if (from.size() != 1) return {0, 0};
        const Section& last = sections_.sections[from[0]];
        if (last.area > 2 * s.area) return {0, 0};
        const int sign = above ? 1 : -1;
        return {sign * (s.centre[0] - last.centre[0]), sign * (s.centre[1] - last.centre[1])};
    }

    void add_caps(const std::vector<int>& slice, bool above) {
        for (const int n : slice) {
            const Section& s = sections_.sections[n];
            if (!(above ? s.above : s.below).empty()) continue;
            SlicePiece piece;
            (above ? piece.lower : piece.upper) = map_of({n});
            const SliceMap& map = shape_.maps[above ? piece.lower : piece.upper];
            piece.cut = s.slice == (above ? scan_slices_ - 1 : 0) || map.depth < shape_.pixel;
            piece.cap = cap_beyond({n}, above);
            if (!piece.cut) piece.shift = heading(n, above);
            shape_.pieces.push_back(piece);
        }
    }

    // Sections that lie on each other, taken together.
    void add_links(const std::vector<int>& slice) {
        std::vector<int> open = slice;
        while (!open.empty()) {
            std::vector<int> lower{open.back()}, upper;
            open.pop_back();
            for (std::size_t done = 0; done < lower.size(); ++done)
                for (const int up : sections_.sections[lower[done]].above) {
                    if (std::find(upper.begin(), upper.end(), up) != upper.end()) continue;
                    upper.push_back(up);
                    for (const int down : sections_.sections[up].below)
                        if (const auto it = std::find(open.begin(), open.end(), down);
                            it != open.end()) {
                            lower.push_back(down);
                            open.erase(it);
                        }
                }
            if (!upper.empty()) add_link(lower, upper);
        }
    }

    void add_link(const std::vector<int>& lower, const std::vector<int>& upper) {
        SlicePiece piece;
        piece.lower = map_of(lower);
        piece.upper = map_of(upper);
        piece.shift = shift_between(lower, upper);
        const auto below = beyond(lower, false), above = beyond(upper, true);
        piece.below_lower = map_of(below);
        piece.above_upper = map_of(above);
        // A cap's r' = -r_0 beta / 2 a slice.
        if (below.empty() && sections_.sections[lower[0]].slice > 0)
            piece.lower_slope =
                -0.5 * shape_.maps[piece.lower].depth * cap_beyond(lower, false).beta;
        if (above.empty() && sections_.sections[upper[0]].slice + 1 < scan_slices_)
            piece.upper_slope = 0.5 * shape_.maps[piece.upper].depth * cap_beyond(upper, true).beta;
        shape_.pieces.push_back(piece);
    }

    // How far the part moves between the slices, as far as that makes sections
    // meet that hardly overlap.
    Point2 shift_between(const std::vector<int>& lower, const std::vector<int>& upper) const {
        Point2 from{0, 0}, to{0, 0};
        const auto area = [&](const std::vector<int>& which, Point2& centre) {
            std::int64_t sum = 0;
            for (const int n : which) {
                const Section& s = sections_.sections[n];
                sum += s.area;
                for (int a = 0; a < 2; ++a) centre[a] += static_cast<double>(s.area) * s.centre[a];
            }
            for (double& c : centre) c /= static_cast<double>(sum);
            return sum;
        };
        const auto smaller = static_cast<double>(std::min(area(lower, from), area(upper, to)));
        const auto share = [&](std::array<int, 2> by) {
            return static_cast<double>(shared_pixels(sections_, lower, upper, by)) / smaller;
        };
        const double straight = share({0, 0});
        if (straight >= kWell) return {0, 0};
        const Point2 shift{to[0] - from[0], to[1] - from[1]};
        const double moved = share(
            {static_cast<int>(std::lround(shift[0])), static_cast<int>(std::lround(shift[1]))});
        if (moved <= straight) return {0, 0};
        const double w = std::clamp((kWell - straight) / (kWell - kPoorly), 0.0, 1.0);
        return {w * shift[0], w * shift[1]};
    }

    SliceSections sections_;
    int scan_slices_;
    Point2 spacing_{1, 1};
    std::vector<std::vector<int>> by_slice_;  // from the gap below the first slice
    std::map<std::vector<int>, int> numbers_;
    SliceShape shape_;
};

Point2 moved(const Point2& p, const Point2& shift, double times) {
    return {p[0] + times * shift[0], p[1] + times * shift[1]};
}

// Keeps the cubic from swinging beyond its ends by more than a sixth of a pixel.
double limited(double slope, double rise, double pixel) {
    const double most = slope * rise > 0 ? kSteep * std::abs(rise) : std::abs(rise) + pixel;
    return std::clamp(slope, -most, most);
}

double cap_value(const SliceShape& shape, const SlicePiece& piece, const Point2& p, double t) {
    const bool above = piece.lower >= 0;
    const SliceMap& map = shape.maps[above ? piece.lower : piece.upper];
    const double off = above ? t : 1 - t;
    if (piece.cut) return std::max(map.value(p), (off - 0.5) * shape.thickness);
    const double d = map.value(moved(p, piece.shift, -off));
    const double end = piece.cap.end();
    const double over = std::max(0.0, off - end) * shape.thickness;
    return d + map.depth * piece.cap.shrunk(std::min(off, end)) + over;
}

// Cubic Hermite interpolation of the distances that a point sees as it moves
// along with the part.
double link_value(const SliceShape& shape, const SlicePiece& piece, const Point2& p, double t) {
    const Point2 low = moved(p, piece.shift, -t), high = moved(p, piece.shift, 1 - t);
    const double a = shape.maps[piece.lower].value(low);
    const double b = shape.maps[piece.upper].value(high);
    const double rise = b - a;
    double ma = piece.lower_slope, mb = piece.upper_slope;
    if (piece.below_lower >= 0)
        ma = 0.5 * (b - shape.maps[piece.below_lower].value(moved(low, piece.shift, -1)));
    if (piece.above_upper >= 0)
        mb = 0.5 * (shape.maps[piece.above_upper].value(moved(high, piece.shift, 1)) - a);
    ma = limited(ma, rise, shape.pixel);
    mb = limited(mb, rise, shape.pixel);
    const double t2 = t * t, t3 = t2 * t;
    return a + rise * (3 * t2 - 2 * t3) + ma * (t3 - 2 * t2 + t) + mb * (t3 - t2);
}

}  // namespace

double SliceCap::shrunk(double t) const {
    return 1 - std::sqrt(std::max(0.0, 1 - beta * t - gamma * t * t));
}

double SliceCap::end() const {
    if (!(gamma > 0)) return 1 / beta;
    return (std::sqrt(beta * beta + 4 * gamma) - beta) / (2 * gamma);
}

SliceCap cap_of(double squared, double before, double before_that) {
    SliceCap cap;
    if (before > squared) {
        const double last = (before - squared) / squared;
        double bend = before_that > 0 ? last - (before_that - before) / squared : 0;
        bend = std::clamp(bend, -last, last);
        // The slope at the section itself lies half a slice further on.
        cap.beta = std::min(last + 0.5 * bend, kSteepest);
        cap.gamma = std::max(0.0, 0.5 * bend);
    }
    // What would have reached the next slice, which is empty, ends bluntly.
    if (cap.beta + cap.gamma < 1) cap.gamma = kBlunt * (1 - cap.beta);
    return cap;
}

double SliceShape::value(const Vec3& index) const {
    const auto axes = slice_axes(axis);
    const Point2 p{index[axes[0]], index[axes[1]]};
    const double slice = std::floor(index[axis]);
    const double t = index[axis] - slice;
    const double gap = slice - first_gap;
    if (!(gap >= 0 && gap + 1 < static_cast<double>(gaps.size()))) return kFar;
    const auto g = static_cast<std::size_t>(gap);
    double best = kFar;
    for (std::size_t n = gaps[g]; n < gaps[g + 1]; ++n) {
        const SlicePiece& piece = pieces[n];
        const bool capped = piece.lower < 0 || piece.upper < 0;
        best =
            std::min(best, capped ? cap_value(*this, piece, p, t) : link_value(*this, piece, p, t));
    }
    return best;
}

SliceShape slice_shape(const RegionMap& map, RegionMap::Owner owner, int axis,
                       const Vec3& plane_spacing) {
    return Builder(map, owner, axis, plane_spacing).build();
}

int thick_axis(const Vec3& plane_spacing) {
    for (int a = 0; a < 3; ++a)
        if (plane_spacing[a] >= kThickSlices * larger_pixel_side(plane_spacing, a)) return a;
    return -1;
}

double larger_pixel_side(const Vec3& plane_spacing, int axis) {
    const auto axes = slice_axes(axis);
    return std::max(plane_spacing[axes[0]], plane_spacing[axes[1]]);
}

}  // namespace myotet::levelset
