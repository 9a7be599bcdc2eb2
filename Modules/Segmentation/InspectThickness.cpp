// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/InspectThickness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Core/Parallel.h"

namespace myotet::segmentation {
namespace {

// A plain slope gains at least 0.8 of each step along its best neighbour, the
// middle of a wedge of opening angle 2 a gains sin(a): half of the step parts
// the middle of what is thin from slopes and from the corners of boxes.
constexpr float kGain = 0.5F;
// Columns worked on together, so that a cache line is used whole.
constexpr int kColumns = 16;

/// Distances inside the box around all labels.
struct DistanceBox {
    Index3 min{0, 0, 0}, size{0, 0, 0};
    Vec3 spacing = Vec3::Ones();
    std::vector<float> values;  ///< i fastest; 0 in the background, mm

    [[nodiscard]] std::size_t offset(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * size[1] + j) * size[0] + i;
    }
};

DistanceBox box_of_labels(const RunMap& map, const Vec3& spacing) {
    DistanceBox box;
    box.spacing = spacing;
    Index3 max{-1, -1, -1};
    box.min = map.size;
    for (const RunComponent& c : map.components)
        for (int a = 0; a < 3 && c.value != 0; ++a) {
            box.min[a] = std::min(box.min[a], c.min[a]);
            max[a] = std::max(max[a], c.max[a]);
        }
    for (int a = 0; a < 3; ++a) box.size[a] = std::max(0, max[a] - box.min[a] + 1);
    box.values.assign(static_cast<std::size_t>(box.size[0]) * box.size[1] * box.size[2], 0);
    return box;
}

/// Squared distances along i to the ends of each run.
void measure_rows(const RunMap& map, DistanceBox& box) {
    const auto step = static_cast<float>(box.spacing[0]);
    parallel_for(0, box.size[2], 1, [&](std::size_t first, std::size_t last) {
        for (int k = static_cast<int>(first); k < static_cast<int>(last); ++k)
            for (int j = 0; j < box.size[1]; ++j) {
                const std::size_t row = map.row(box.min[1] + j, box.min[2] + k);
                float* out = box.values.data() + box.offset(0, j, k) - box.min[0];
                for (std::int32_t r = map.row_start[row]; r < map.row_start[row + 1]; ++r) {
                    const Run& run = map.runs[r];
                    if (map.components[run.component].value == 0) continue;
                    for (int i = run.first; i <= run.last; ++i) {
                        const float d =
                            step * static_cast<float>(std::min(i - run.first, run.last - i) + 1);
                        out[i] = d * d;
                    }
                }
            }
    });
}

/// Columns of one axis side by side along i, as the cache likes them.
struct Columns {
    int length = 0;
    std::vector<float> distance;       ///< kColumns columns, one after another
    std::vector<std::int32_t> labels;  ///< the same

    explicit Columns(int n)
        : length(n), distance(std::size_t{kColumns} * n), labels(distance.size()) {}
};

/// Squared distances of one column: between two changes of value nothing else counts.
void measure_column(std::span<const std::int32_t> labels, std::span<float> distance, double step) {
    for (std::size_t at = 0; at < labels.size();) {
        const std::size_t first = at;
        while (at < labels.size() && labels[at] == labels[first]) ++at;
        if (labels[first] != 0) squared_distances(distance.subspan(first, at - first), step);
    }
}

/// Takes axis 1 or 2 into account, `count` columns from (i, other) on.
void measure_columns(const LabelVolume& volume, DistanceBox& box, int axis, int i, int other,
                     Columns& work) {
    const int count = std::min(kColumns, box.size[0] - i), n = work.length;
    const auto at = [&](int m) { return axis == 1 ? Index3{i, m, other} : Index3{i, other, m}; };
    for (int m = 0; m < n; ++m) {
        const Index3 p = at(m);
        const std::size_t from = box.offset(p[0], p[1], p[2]);
        const std::size_t label_from =
            volume.offset(box.min[0] + p[0], box.min[1] + p[1], box.min[2] + p[2]);
        for (int c = 0; c < count; ++c) {
            work.distance[c * n + m] = box.values[from + c];
            work.labels[c * n + m] = volume.values[label_from + c];
        }
    }
    for (int c = 0; c < count; ++c)
        measure_column({work.labels.data() + c * n, static_cast<std::size_t>(n)},
                       {work.distance.data() + c * n, static_cast<std::size_t>(n)},
                       box.spacing[axis]);
    for (int m = 0; m < n; ++m) {
        const Index3 p = at(m);
        float* to = box.values.data() + box.offset(p[0], p[1], p[2]);
        for (int c = 0; c < count; ++c) to[c] = work.distance[c * n + m];
    }
}

void measure_axis(const LabelVolume& volume, DistanceBox& box, int axis) {
    parallel_for(0, box.size[3 - axis], 4, [&](std::size_t first, std::size_t last) {
        Columns work(box.size[axis]);
        for (int other = static_cast<int>(first); other < static_cast<int>(last); ++other)
            for (int i = 0; i < box.size[0]; i += kColumns)
                measure_columns(volume, box, axis, i, other, work);
    });
}

DistanceBox distances(const LabelVolume& volume, const RunMap& map) {
    DistanceBox box = box_of_labels(map, volume.spacing());
    measure_rows(map, box);
    measure_axis(volume, box, 1);
    measure_axis(volume, box, 2);
    parallel_for(0, box.values.size(), 1 << 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) box.values[n] = std::sqrt(box.values[n]);
    });
    return box;
}

/// The way to a voxel near by.
struct Step {
    int i, j, k;
    float gain;  ///< what that voxel must lie deeper by, mm
};

/// To the 26 neighbours, across faces first: on a slope one of them settles it.
/// Where voxels are longer one way, also as far as that along the others, so
/// that no direction is missing.
std::vector<Step> neighbour_steps(const Vec3& spacing) {
    std::vector<Step> steps;
    const Eigen::Array3i far =
        (spacing.maxCoeff() * spacing.cwiseInverse()).array().round().cast<int>();
    for (int k = -1; k <= 1; ++k)
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const Eigen::Array3i near(i, j, k);
                if ((near == 0).all()) continue;
                for (const Eigen::Array3i& n : {near, Eigen::Array3i(near * far)}) {
                    const double length = (spacing.array() * n.cast<double>()).matrix().norm();
                    steps.push_back({n[0], n[1], n[2], kGain * static_cast<float>(length)});
                    if ((far == 1).all()) break;
                }
            }
    std::ranges::stable_sort(
        steps, {}, [](const Step& s) { return std::abs(s.i) + std::abs(s.j) + std::abs(s.k); });
    return steps;
}

/// Looks at voxels of the box with their surroundings.
class Middle {
public:
    Middle(const LabelVolume& volume, const DistanceBox& box)
        : volume_(volume), box_(box), steps_(neighbour_steps(box.spacing)) {}

    [[nodiscard]] bool is_medial(int i, int j, int k) const {
        const std::int32_t label = volume_.values[volume_offset(i, j, k)];
        const float here = box_.values[box_.offset(i, j, k)];
        return std::ranges::none_of(steps_, [&](const Step& s) {
            return distance(label, i + s.i, j + s.j, k + s.k) >= here + s.gain;
        });
    }

    /// The ball ends between its own voxels and the others': half a voxel before
    /// their centres across the wall, at half of the way at the least. Among the
    /// axes along which distances fall to both sides, the one that allows least.
    [[nodiscard]] float radius(int i, int j, int k) const {
        const float here = box_.values[box_.offset(i, j, k)];
        float least = std::numeric_limits<float>::infinity();
        for (int a = 0; a < 3; ++a)
            least =
                std::min(least, peak({i, j, k}, a) - 0.5F * static_cast<float>(box_.spacing[a]));
        if (!std::isfinite(least))
            least = here - 0.5F * static_cast<float>(box_.spacing.maxCoeff());
        return std::max(least, 0.5F * here);
    }

    [[nodiscard]] bool is_one_thick(int i, int j, int k) const {
        const std::int32_t label = volume_.values[volume_offset(i, j, k)];
        for (int a = 0; a < 3; ++a) {
            const Index3 e{a == 0, a == 1, a == 2};
            if (distance(label, i - e[0], j - e[1], k - e[2]) == 0 &&
                distance(label, i + e[0], j + e[1], k + e[2]) == 0)
                return true;
        }
        return false;
    }

private:
    /// Distances that rise and fall by the same `drop` a voxel along an axis
    /// meet in (here + higher neighbour + drop) / 2; infinite where they do not
    /// fall to both sides.
    [[nodiscard]] float peak(const Index3& at, int axis) const {
        const auto [i, j, k] = at;
        const std::int32_t label = volume_.values[volume_offset(i, j, k)];
        const Index3 e{axis == 0, axis == 1, axis == 2};
        const auto along = [&](int n) {
            return distance(label, i + n * e[0], j + n * e[1], k + n * e[2]);
        };
        const float here = along(0);
        const int up = along(1) >= along(-1) ? 1 : -1;  // where the higher neighbour lies
        const float drop = std::min(here - along(-up), along(up) - along(2 * up));
        const bool falls = here >= along(up) && (drop > 0 || along(up) == 0);
        return falls ? 0.5F * (here + along(up) + std::max(drop, 0.0F))
                     : std::numeric_limits<float>::infinity();
    }
    [[nodiscard]] std::size_t volume_offset(int i, int j, int k) const {
        return volume_.offset(box_.min[0] + i, box_.min[1] + j, box_.min[2] + k);
    }
    /// 0 where the label is another one.
    [[nodiscard]] float distance(std::int32_t label, int i, int j, int k) const {
        if (i < 0 || j < 0 || k < 0 || i >= box_.size[0] || j >= box_.size[1] || k >= box_.size[2])
            return 0;
        return volume_.values[volume_offset(i, j, k)] == label ? box_.values[box_.offset(i, j, k)]
                                                               : 0;
    }

    const LabelVolume& volume_;
    const DistanceBox& box_;
    const std::vector<Step> steps_;
};

struct Slice {
    std::vector<MedialVoxel> medial;
    std::vector<std::int32_t> one_thick;  ///< components, once a voxel
};

void look_at_run(const Middle& middle, const DistanceBox& box, const Run& run, int j, int k,
                 Slice& slice) {
    for (int x = run.first; x <= run.last; ++x) {
        const int i = x - box.min[0];
        if (middle.is_medial(i, j, k))
            slice.medial.push_back({run.component, middle.radius(i, j, k)});
        if (middle.is_one_thick(i, j, k)) slice.one_thick.push_back(run.component);
    }
}

Slice look_at_slice(const Middle& middle, const RunMap& map, const DistanceBox& box, int k) {
    Slice slice;
    for (int j = 0; j < box.size[1]; ++j) {
        const std::size_t row = map.row(box.min[1] + j, box.min[2] + k);
        for (std::int32_t r = map.row_start[row]; r < map.row_start[row + 1]; ++r)
            if (map.components[map.runs[r].component].value != 0)
                look_at_run(middle, box, map.runs[r], j, k, slice);
    }
    return slice;
}

}  // namespace

void squared_distances(std::span<float> height, double step) {
    // Parabola n has its vertex at vertex[n] and is the lowest from from[n] on.
    thread_local std::vector<int> vertex;
    thread_local std::vector<double> from, base;
    const int n = static_cast<int>(height.size());
    const double w = step * step;
    vertex.assign(1, -1);
    base.assign(1, 0);
    from.assign(1, -std::numeric_limits<double>::infinity());
    for (int q = 0; q <= n; ++q) {
        const double h = q < n ? height[q] : 0;
        double meet = 0;
        while (true) {
            const int v = vertex.back();
            meet = 0.5 * ((h - base.back()) / (w * (q - v)) + q + v);
            if (meet > from.back()) break;
            vertex.pop_back(), base.pop_back(), from.pop_back();
        }
        vertex.push_back(q), base.push_back(h), from.push_back(meet);
    }
    std::size_t lowest = 0;
    for (int x = 0; x < n; ++x) {
        while (lowest + 1 < from.size() && from[lowest + 1] < x) ++lowest;
        const double d = x - vertex[lowest];
        height[x] = static_cast<float>(base[lowest] + w * d * d);
    }
}

Thickness measure_thickness(const LabelVolume& volume, const RunMap& map) {
    const DistanceBox box = distances(volume, map);
    const Middle middle(volume, box);
    std::vector<Slice> slices(box.size[2]);
    parallel_for(0, slices.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k)
            slices[k] = look_at_slice(middle, map, box, static_cast<int>(k));
    });
    Thickness result;
    result.one_voxel_thick.assign(map.components.size(), 0);
    for (const Slice& slice : slices) {
        result.medial.insert(result.medial.end(), slice.medial.begin(), slice.medial.end());
        for (const std::int32_t c : slice.one_thick) ++result.one_voxel_thick[c];
    }
    return result;
}

}  // namespace myotet::segmentation
