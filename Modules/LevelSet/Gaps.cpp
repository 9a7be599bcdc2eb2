// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Gaps.h"

#include <cmath>
#include <queue>
#include <sstream>
#include <tuple>
#include <vector>

#include "Core/Components.h"
#include "Core/Errors.h"

namespace myotet::levelset {
namespace {

constexpr std::uint8_t kSlit = 1;    // between two tissues nearer than the width
constexpr std::uint8_t kNarrow = 2;  // between any voxels nearer than the width
constexpr double kRounding = 1e-6;

constexpr std::array<Index3, 6> kFaces{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

// One of each pair of opposite directions to the 26 neighbours.
std::vector<Index3> directions() {
    std::vector<Index3> out;
    for (int n = 14; n < 27; ++n) out.push_back({n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1});
    return out;
}

struct Grid {
    const LabelVolume& volume;

    [[nodiscard]] bool holds(const Index3& p) const {
        for (int a = 0; a < 3; ++a)
            if (p[a] < 0 || p[a] >= volume.size[a]) return false;
        return true;
    }
    [[nodiscard]] std::size_t at(const Index3& p) const { return volume.offset(p[0], p[1], p[2]); }
    [[nodiscard]] std::int32_t label(const Index3& p) const { return volume.values[at(p)]; }
};

Index3 step(const Index3& p, const Index3& d) { return {p[0] + d[0], p[1] + d[1], p[2] + d[2]}; }

template <class Body>
void each_voxel(const Index3& size, Body&& body) {
    std::size_t at = 0;
    for (int k = 0; k < size[2]; ++k)
        for (int j = 0; j < size[1]; ++j)
            for (int i = 0; i < size[0]; ++i, ++at) body(Index3{i, j, k}, at);
}

// From each labelled voxel along each direction: short runs of unlabelled
// voxels that end at another labelled one.
std::vector<std::uint8_t> mark_runs(const LabelVolume& volume, double width) {
    std::vector<std::uint8_t> marks(volume.values.size(), 0);
    const Grid grid{volume};
    for (const Index3& d : directions()) {
        const double length = (volume.index_to_lps.linear() * Vec3(d[0], d[1], d[2])).norm();
        const int most = static_cast<int>(std::floor(width / length + kRounding));
        if (most < 1) continue;
        each_voxel(volume.size, [&](const Index3& p, std::size_t at) {
            const std::int32_t from = volume.values[at];
            if (from == 0) return;
            Index3 q = step(p, d);
            int run = 0;
            while (run <= most && grid.holds(q) && grid.label(q) == 0) {
                q = step(q, d);
                ++run;
            }
            if (run == 0 || run > most || !grid.holds(q)) return;
            const std::uint8_t mark =
                grid.label(q) != from ? std::uint8_t{kSlit | kNarrow} : kNarrow;
            for (Index3 r = step(p, d); r != q; r = step(r, d)) marks[grid.at(r)] |= mark;
        });
    }
    return marks;
}

// What is known of one component of unlabelled voxels.
struct Hollow {
    bool enclosed = true;
    bool narrow = true;       // in each of its voxels
    std::int32_t tissue = 0;  // one that bounds it
    bool between = false;     // others do too
};

std::vector<Hollow> study(const LabelVolume& volume, const Components& parts,
                          const std::vector<std::uint8_t>& marks) {
    std::vector<Hollow> hollows(parts.components.size());
    for (std::size_t c = 0; c < hollows.size(); ++c)
        for (int a = 0; a < 3; ++a)
            if (parts.components[c].min[a] == 0 || parts.components[c].max[a] == volume.size[a] - 1)
                hollows[c].enclosed = false;
    const Grid grid{volume};
    each_voxel(volume.size, [&](const Index3& p, std::size_t at) {
        if (parts.number[at] < 0 || !hollows[parts.number[at]].enclosed) return;
        Hollow& hollow = hollows[parts.number[at]];
        hollow.narrow = hollow.narrow && marks[at] & kNarrow;
        for (const Index3& d : kFaces) {
            const std::int32_t label = grid.label(step(p, d));
            if (label == 0) continue;
            hollow.between = hollow.between || (hollow.tissue != 0 && hollow.tissue != label);
            hollow.tissue = label;
        }
    });
    return hollows;
}

void require_width(double width) {
    if (width >= 0 && std::isfinite(width)) return;
    std::ostringstream out;
    out << "width is " << width << " but must be a length in mm, or 0 to close nothing";
    throw InputError(out.str());
}

// Fills `report` and says which voxels are to be closed.
std::vector<char> examine(const LabelVolume& volume, double width, GapReport& report) {
    require_width(width);
    report.width = width;
    const auto marks = mark_runs(volume, width);
    const Components parts = label_components(
        volume, 0, {0, 0, 0}, {volume.size[0] - 1, volume.size[1] - 1, volume.size[2] - 1});
    const auto hollows = study(volume, parts, marks);
    for (std::size_t c = 0; c < hollows.size(); ++c) {
        if (!hollows[c].enclosed) continue;
        ++(hollows[c].between ? report.pockets : report.cavities);
        (hollows[c].between ? report.pocket_voxels : report.cavity_voxels) +=
            parts.components[c].voxels;
    }
    std::vector<char> closed(volume.values.size(), 0);
    for (std::size_t at = 0; at < closed.size(); ++at) {
        if (parts.number[at] < 0) continue;
        const Hollow& hollow = hollows[parts.number[at]];
        closed[at] = marks[at] & kSlit || (hollow.enclosed && hollow.between && hollow.narrow);
        report.narrow_voxels += closed[at];
    }
    const double voxel = volume.voxel_volume();
    report.pocket_volume = static_cast<double>(report.pocket_voxels) * voxel;
    report.cavity_volume = static_cast<double>(report.cavity_voxels) * voxel;
    report.narrow_volume = static_cast<double>(report.narrow_voxels) * voxel;
    return closed;
}

// An offer of a tissue to a voxel: from a labelled voxel to one that a chain of
// faces joins to it.
struct Offer {
    double distance = 0;  // between their centres, mm^2, rounded so that ties are ties
    std::int32_t label = 0;
    std::size_t at = 0;  // of the voxel
    Index3 voxel{0, 0, 0}, from{0, 0, 0};
    [[nodiscard]] auto key() const { return std::tie(distance, label, at, from); }
    bool operator<(const Offer& other) const { return key() > other.key(); }  // nearest on top
};

}  // namespace

GapReport find_gaps(const LabelVolume& volume, double width) {
    GapReport report;
    (void)examine(volume, width, report);
    return report;
}

GapReport close_gaps(LabelVolume& volume, double width) {
    GapReport report;
    std::vector<char> open = examine(volume, width, report);
    if (report.narrow_voxels == 0) return report;
    const Grid grid{volume};
    const Mat3 axes = volume.index_to_lps.linear();
    std::priority_queue<Offer> offers;
    const auto offer = [&](const Index3& to, const Index3& from, std::int32_t label) {
        if (!grid.holds(to) || !open[grid.at(to)]) return;
        const Vec3 off = axes * Vec3(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
        const double distance = std::round(off.squaredNorm() * 1e6);
        offers.push({distance, label, grid.at(to), to, from});
    };
    each_voxel(volume.size, [&](const Index3& p, std::size_t at) {
        if (!open[at]) return;
        for (const Index3& d : kFaces)
            if (const Index3 q = step(p, d); grid.holds(q) && grid.label(q) != 0)
                offer(p, q, grid.label(q));
    });
    while (!offers.empty()) {
        const Offer best = offers.top();
        offers.pop();
        if (!open[best.at]) continue;
        open[best.at] = 0;
        volume.values[best.at] = best.label;
        ++report.gained[best.label];
        for (const Index3& d : kFaces) offer(step(best.voxel, d), best.from, best.label);
    }
    return report;
}

}  // namespace myotet::levelset
