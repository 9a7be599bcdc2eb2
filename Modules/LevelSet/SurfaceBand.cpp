// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/SurfaceBand.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Core/Wide.h"
#include "LevelSet/CutEdges.h"

namespace myotet::levelset {
namespace {

using Corners = std::array<Vec3, 3>;  // in samples

constexpr int kSide = Band::kSide;
constexpr std::size_t kGrain = 16;
// A triangle is halved until it reaches over no more blocks than this along an axis.
constexpr int kMostBlocks = 2;

// A sample inside is at least this deep, in spacings: zero would be outside.
constexpr float kLeast = 1e-6F;

// Samples measured at once.
constexpr int kLanes = 4;

Corners corners_of(const TriMesh& surface, const Band& band, std::size_t triangle) {
    Corners c;
    for (int i = 0; i < 3; ++i)
        c[i] = (surface.points[surface.triangles[triangle][i]] - band.origin) / band.spacing;
    return c;
}

/// A triangle near a block.
struct Meeting {
    std::size_t slot;
    std::int32_t triangle;
    friend auto operator<=>(const Meeting&, const Meeting&) = default;
};

/// Adds the blocks with samples nearer than `reach` to the triangle, and some more.
void meet(const Band& band, const Corners& c, double reach, std::int32_t triangle,
          std::vector<Meeting>& meetings) {
    Index3 low, high;
    bool wide = false;
    for (int a = 0; a < 3; ++a) {
        const auto [least, most] = std::minmax({c[0][a], c[1][a], c[2][a]});
        low[a] = static_cast<int>(std::ceil(least - reach)) / kSide;
        high[a] = static_cast<int>(std::floor(most + reach)) / kSide;
        wide |= most - least > kMostBlocks * kSide;
    }
    if (wide) {
        int longest = 0;
        for (int i = 1; i < 3; ++i)
            if ((c[(i + 1) % 3] - c[i]).squaredNorm() >
                (c[(longest + 1) % 3] - c[longest]).squaredNorm())
                longest = i;
        const Vec3 &a = c[longest], &b = c[(longest + 1) % 3], &other = c[(longest + 2) % 3];
        const Vec3 middle = 0.5 * (a + b);
        meet(band, {a, middle, other}, reach, triangle, meetings);
        meet(band, {middle, b, other}, reach, triangle, meetings);
        return;
    }
    for (int k = low[2]; k <= high[2]; ++k)
        for (int j = low[1]; j <= high[1]; ++j)
            for (int i = low[0]; i <= high[0]; ++i)
                meetings.push_back({band.slot({i, j, k}), triangle});
}

/// Sorted by block, each pair once.
std::vector<Meeting> find_meetings(const TriMesh& surface, const Band& band, double reach) {
    std::vector<Meeting> meetings;
    meetings.reserve(4 * surface.triangles.size());
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        meet(band, corners_of(surface, band, t), reach, static_cast<std::int32_t>(t), meetings);
    std::ranges::sort(meetings);
    meetings.erase(std::unique(meetings.begin(), meetings.end()), meetings.end());
    return meetings;
}

/// A triangle as its distances need it: about its first corner, in units of a sample.
struct Measured {
    double a[3], edge[3][3], per_edge2[3];  // per_edge2: 0 for an edge without length
    double normal[3], inward[3][3];         // unit, or 0; in the plane, off each edge
    double from[3][3];                      // where each edge begins
};

Measured measured(const Corners& c) {
    Measured m{};
    Vec3 n = (c[1] - c[0]).cross(c[2] - c[0]);
    const double length = n.norm();
    n = length > 0 ? Vec3(n / length) : Vec3::Zero();
    for (int d = 0; d < 3; ++d) m.normal[d] = n[d];
    for (int e = 0; e < 3; ++e) {
        const Vec3 along = c[(e + 1) % 3] - c[e], in = n.cross(along);
        const double squared = along.squaredNorm();
        m.per_edge2[e] = squared > 0 ? 1 / squared : 0;
        for (int d = 0; d < 3; ++d) {
            m.edge[e][d] = along[d];
            m.inward[e][d] = in[d];
            m.from[e][d] = c[e][d];
        }
    }
    return m;
}

/// Lowers the squared distances of kLanes samples in a row, the first at x, y, z.
MYOTET_WIDE void lower_row(const Measured& m, double x, double y, double z, double* squared) {
    double plane[kLanes], edges[kLanes], outside[kLanes];
    for (int i = 0; i < kLanes; ++i) {
        const double h = (x + i - m.from[0][0]) * m.normal[0] + (y - m.from[0][1]) * m.normal[1] +
                         (z - m.from[0][2]) * m.normal[2];
        plane[i] = h * h;
        edges[i] = std::numeric_limits<double>::max();
        outside[i] = 0;
    }
    for (int e = 0; e < 3; ++e)
        for (int i = 0; i < kLanes; ++i) {
            const double px = x + i - m.from[e][0], py = y - m.from[e][1], pz = z - m.from[e][2];
            const double in = px * m.inward[e][0] + py * m.inward[e][1] + pz * m.inward[e][2];
            outside[i] = in > 0 ? outside[i] : 1;
            double t = (px * m.edge[e][0] + py * m.edge[e][1] + pz * m.edge[e][2]) * m.per_edge2[e];
            t = t > 0 ? t : 0;
            t = t < 1 ? t : 1;
            const double dx = px - t * m.edge[e][0], dy = py - t * m.edge[e][1],
                         dz = pz - t * m.edge[e][2];
            const double d = dx * dx + dy * dy + dz * dz;
            edges[i] = d < edges[i] ? d : edges[i];
        }
    for (int i = 0; i < kLanes; ++i) {
        const double d = outside[i] > 0 ? edges[i] : plane[i];
        squared[i] = d < squared[i] ? d : squared[i];
    }
}

/// Unsigned distances and cut edges of one block.
class BlockFiller {
public:
    BlockFiller(const TriMesh& surface, const Band& band) : surface_(surface), band_(band) {}

    void fill(std::span<const Meeting> meetings, const Index3& block, float* distances,
              std::uint8_t* cuts) {
        for (int a = 0; a < 3; ++a) {
            first_[a] = block[a] * kSide;
            last_[a] = first_[a] + kSide - 1;
        }
        const double reach = band_.width / band_.spacing;
        std::fill(std::begin(squared_), std::end(squared_), reach * reach);
        for (const Meeting& meeting : meetings) {
            const Corners c = corners_of(surface_, band_, meeting.triangle);
            lower(c, reach);
            for_each_cut_edge(snap(c), first_, last_, [&](int axis, const Index3& low) {
                cuts[index(low)] |= static_cast<std::uint8_t>(1 << axis);
            });
        }
        for (int n = 0; n < Band::kSize; ++n)
            distances[n] =
                std::min(static_cast<float>(std::sqrt(squared_[n]) * band_.spacing), band_.width);
    }

private:
    [[nodiscard]] int index(const Index3& s) const {
        return ((s[2] - first_[2]) * kSide + s[1] - first_[1]) * kSide + s[0] - first_[0];
    }
    void lower(const Corners& c, double reach) {
        Index3 low, high;
        for (int a = 0; a < 3; ++a) {
            const auto [least, most] = std::minmax({c[0][a], c[1][a], c[2][a]});
            low[a] = std::max(first_[a], static_cast<int>(std::ceil(least - reach)));
            high[a] = std::min(last_[a], static_cast<int>(std::floor(most + reach)));
        }
        const Measured m = measured(c);
        for (int k = low[2]; k <= high[2]; ++k)
            for (int j = low[1]; j <= high[1]; ++j)
                for (int i = low[0]; i <= high[0]; i += kLanes) {
                    const int from = std::min(i, last_[0] + 1 - kLanes);
                    lower_row(m, from, j, k, squared_ + index({from, j, k}));
                }
    }

    const TriMesh& surface_;
    const Band& band_;
    Index3 first_{}, last_{};
    double squared_[Band::kSize];
};

/// From the corner of the table through everything that no cut edge parts from it.
class OutsideFlood {
public:
    OutsideFlood(const Band& band, const std::vector<std::uint8_t>& cuts)
        : band_(band),
          cuts_(cuts),
          reached(cuts.size(), 0),
          reached_block(band.block_of.size(), 0) {}

    void run() {
        reach_block({0, 0, 0});
        while (!blocks_.empty() || !samples_.empty()) {
            if (!samples_.empty()) {
                const std::size_t at = samples_.back();
                samples_.pop_back();
                leave_sample(at);
            } else {
                const Index3 b = blocks_.back();
                blocks_.pop_back();
                leave_block(b);
            }
        }
    }

private:
    const Band& band_;
    const std::vector<std::uint8_t>& cuts_;
    std::vector<Index3> blocks_;  // not stored, reached, to be left
    std::vector<std::size_t> samples_;

public:
    std::vector<std::uint8_t> reached;        ///< per sample
    std::vector<std::uint8_t> reached_block;  ///< per slot, where no block is stored

private:
    static constexpr int kStride[3] = {1, kSide, kSide* kSide};

    void reach_block(const Index3& b) {
        if (std::uint8_t& flag = reached_block[band_.slot(b)]; !std::exchange(flag, 1))
            blocks_.push_back(b);
    }
    void reach_sample(std::size_t at) {
        if (!std::exchange(reached[at], 1)) samples_.push_back(at);
    }
    // Through the whole of a face: what is not stored is cut nowhere.
    void leave_block(const Index3& b) {
        for (int a = 0; a < 3; ++a)
            for (const int step : {-1, 1}) {
                Index3 to = b;
                to[a] += step;
                if (to[a] < 0 || to[a] >= band_.blocks[a]) continue;
                const std::int32_t number = band_.find(to);
                if (number < 0) {
                    reach_block(to);
                    continue;
                }
                const int u = kStride[(a + 1) % 3], v = kStride[(a + 2) % 3];
                const int face = step > 0 ? 0 : (kSide - 1) * kStride[a];
                for (int j = 0; j < kSide; ++j)
                    for (int i = 0; i < kSide; ++i)
                        reach_sample(static_cast<std::size_t>(number) * Band::kSize + face + i * u +
                                     j * v);
            }
    }
    void leave_sample(std::size_t at) {
        const std::size_t block = at / Band::kSize;
        const auto n = static_cast<int>(at % Band::kSize);
        for (int a = 0; a < 3; ++a) {
            const int place = n / kStride[a] % kSide;
            const auto bit = static_cast<std::uint8_t>(1 << a);
            if (!(cuts_[at] & bit)) {
                if (place < kSide - 1)
                    reach_sample(at + kStride[a]);
                else
                    enter(block, a, 1, at - static_cast<std::size_t>((kSide - 1) * kStride[a]));
            }
            if (place > 0) {
                if (!(cuts_[at - kStride[a]] & bit)) reach_sample(at - kStride[a]);
            } else {
                enter(block, a, -1, at + static_cast<std::size_t>((kSide - 1) * kStride[a]));
            }
        }
    }
    // Into the next block; `twin` is the sample of this one at the same place.
    void enter(std::size_t block, int a, int step, std::size_t twin) {
        Index3 to = band_.position[block];
        to[a] += step;
        const std::int32_t number = band_.find(to);
        if (number < 0) {
            reach_block(to);
            return;
        }
        const std::size_t at = static_cast<std::size_t>(number) * Band::kSize + twin % Band::kSize;
        if (step < 0 && cuts_[at] & 1 << a) return;
        reach_sample(at);
    }
};

}  // namespace

Band empty_band(const TriMesh& surface, double spacing, double half_width) {
    Box box;
    for (const Triangle& t : surface.triangles)
        for (const std::int32_t v : t) box.include(surface.points[v]);
    // Outside the band, two coarse cells and one block remain on every side.
    const double margin = (std::ceil(half_width) + 2 * kSide) * spacing;
    Band band;
    band.spacing = spacing;
    band.width = static_cast<float>(half_width * spacing);
    band.origin = box.min - Vec3::Constant(margin);
    for (int a = 0; a < 3; ++a)
        band.blocks[a] =
            static_cast<int>(std::ceil((box.extent()[a] + 2 * margin) / (kSide * spacing)));
    band.block_of.assign(static_cast<std::size_t>(band.blocks[0]) * band.blocks[1] * band.blocks[2],
                         Band::kOutside);
    return band;
}

Band surface_band(const TriMesh& surface, double spacing, double half_width,
                  ProgressSink& progress) {
    Band band = empty_band(surface, spacing, half_width);
    const std::vector<Meeting> meetings = find_meetings(surface, band, half_width);
    progress.check();
    std::vector<std::size_t> start;
    for (std::size_t m = 0; m < meetings.size(); ++m) {
        const std::size_t slot = meetings[m].slot;
        if (m > 0 && slot == meetings[m - 1].slot) continue;
        start.push_back(m);
        band.block_of[slot] = static_cast<std::int32_t>(band.position.size());
        const auto [nx, ny, nz] = band.blocks;
        band.position.push_back({static_cast<int>(slot % nx), static_cast<int>(slot / nx % ny),
                                 static_cast<int>(slot / nx / ny)});
    }
    start.push_back(meetings.size());

    band.values.resize(band.position.size() * Band::kSize);
    std::vector<std::uint8_t> cuts(band.values.size(), 0);
    parallel_for(0, band.position.size(), kGrain, [&](std::size_t first, std::size_t last) {
        progress.check();
        BlockFiller filler(surface, band);
        for (std::size_t b = first; b < last; ++b)
            filler.fill(std::span(meetings).subspan(start[b], start[b + 1] - start[b]),
                        band.position[b], band.block(static_cast<std::int32_t>(b)),
                        cuts.data() + b * Band::kSize);
    });

    OutsideFlood flood(band, cuts);
    flood.run();
    const float least = kLeast * static_cast<float>(spacing);
    for (std::size_t at = 0; at < band.values.size(); ++at)
        if (!flood.reached[at]) band.values[at] = -std::max(band.values[at], least);
    for (std::size_t slot = 0; slot < band.block_of.size(); ++slot)
        if (band.block_of[slot] < 0 && !flood.reached_block[slot])
            band.block_of[slot] = Band::kInside;
    return band;
}

}  // namespace myotet::levelset
