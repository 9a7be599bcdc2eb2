// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/InspectRuns.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "Core/Errors.h"

namespace myotet::segmentation {
namespace {

using Values = std::vector<std::int32_t>;

/// While components are found, `component` is the union-find parent: a set's
/// root is its first run.
std::int32_t find_root(std::vector<Run>& runs, std::int32_t i) {
    while (runs[i].component != i) {
        runs[i].component = runs[runs[i].component].component;
        i = runs[i].component;
    }
    return i;
}

/// Runs of every row, each a set of its own, and their values.
Values find_runs(const LabelVolume& volume, RunMap& map) {
    Values values;
    const int n = volume.size[0];
    const std::size_t rows = static_cast<std::size_t>(volume.size[1]) * volume.size[2];
    map.row_start.reserve(rows + 1);
    for (std::size_t r = 0; r < rows; ++r) {
        if (map.runs.size() > static_cast<std::size_t>(std::numeric_limits<int>::max() - n))
            throw ResourceError(
                "the volume falls into more runs of equal voxels than can be numbered; it looks "
                "like noise rather than labels");
        map.row_start.push_back(static_cast<std::int32_t>(map.runs.size()));
        const std::int32_t* row = volume.values.data() + r * n;
        for (int i = 0; i < n;) {
            const int first = i;
            while (i < n && row[i] == row[first]) ++i;
            map.runs.push_back({first, i - 1, static_cast<std::int32_t>(map.runs.size())});
            values.push_back(row[first]);
        }
    }
    map.row_start.push_back(static_cast<std::int32_t>(map.runs.size()));
    return values;
}

/// Calls touch(a, b, faces) for every run a of one row and b of another that lie side by side.
template <class Touch>
void each_overlap(const RunMap& map, std::size_t row_a, std::size_t row_b, Touch&& touch) {
    std::int32_t a = map.row_start[row_a], b = map.row_start[row_b];
    const std::int32_t end_a = map.row_start[row_a + 1], end_b = map.row_start[row_b + 1];
    while (a < end_a && b < end_b) {
        const Run &ra = map.runs[a], &rb = map.runs[b];
        const int faces = std::min(ra.last, rb.last) - std::max(ra.first, rb.first) + 1;
        if (faces > 0) touch(a, b, faces);
        const int last_a = ra.last, last_b = rb.last;
        if (last_a <= last_b) ++a;
        if (last_b <= last_a) ++b;
    }
}

/// The same for all neighbouring rows, with the axis that the faces lie across.
template <class Touch>
void each_overlap(const RunMap& map, Touch&& touch) {
    for (int k = 0; k < map.size[2]; ++k)
        for (int j = 0; j < map.size[1]; ++j)
            for (const int axis : {1, 2}) {
                if ((axis == 1 ? j : k) == 0) continue;
                const std::size_t before = axis == 1 ? map.row(j - 1, k) : map.row(j, k - 1);
                each_overlap(map, before, map.row(j, k),
                             [&](auto a, auto b, int faces) { touch(a, b, faces, axis); });
            }
}

void join_equal(RunMap& map, const Values& values) {
    each_overlap(map, [&](std::int32_t a, std::int32_t b, int, int) {
        if (values[a] != values[b]) return;
        const std::int32_t ra = find_root(map.runs, a), rb = find_root(map.runs, b);
        map.runs[std::max(ra, rb)].component = std::min(ra, rb);
    });
}

void include(RunComponent& c, const Index3& first, const Index3& last) {
    for (int a = 0; a < 3; ++a) {
        c.min[a] = c.voxels == 0 ? first[a] : std::min(c.min[a], first[a]);
        c.max[a] = c.voxels == 0 ? last[a] : std::max(c.max[a], last[a]);
    }
    c.voxels += last[0] - first[0] + 1;
}

/// Numbers the sets by their first run and measures them.
void number_components(RunMap& map, const Values& values) {
    // All roots first: afterwards a run's `component` is no parent any more.
    for (std::int32_t r = 0; r < static_cast<std::int32_t>(map.runs.size()); ++r)
        map.runs[r].component = find_root(map.runs, r);
    std::vector<std::int32_t> number(map.runs.size(), -1);
    std::int32_t r = 0;
    for (int k = 0; k < map.size[2]; ++k)
        for (int j = 0; j < map.size[1]; ++j)
            for (; r < map.row_start[map.row(j, k) + 1]; ++r) {
                Run& run = map.runs[r];
                std::int32_t& n = number[run.component];
                if (n < 0) {
                    n = static_cast<std::int32_t>(map.components.size());
                    map.components.push_back({.value = values[r]});
                }
                run.component = n;
                include(map.components[n], {run.first, j, k}, {run.last, j, k});
            }
}

void find_contacts(RunMap& map) {
    std::unordered_map<std::uint64_t, std::array<std::int64_t, 3>> faces_of;
    const auto count = [&](std::int32_t run_a, std::int32_t run_b, int faces, int axis) {
        const std::uint64_t a = map.runs[run_a].component, b = map.runs[run_b].component;
        if (a != b) faces_of[std::min(a, b) << 32 | std::max(a, b)][axis] += faces;
    };
    each_overlap(map, count);
    for (std::size_t row = 0; row + 1 < map.row_start.size(); ++row)
        for (std::int32_t r = map.row_start[row]; r + 1 < map.row_start[row + 1]; ++r)
            count(r, r + 1, 1, 0);
    map.contacts.reserve(faces_of.size());
    for (const auto& [key, faces] : faces_of)
        map.contacts.push_back({static_cast<std::int32_t>(key >> 32),
                                static_cast<std::int32_t>(key & 0xFFFFFFFF), faces});
    std::ranges::sort(map.contacts, [](const RunContact& x, const RunContact& y) {
        return x.a != y.a ? x.a < y.a : x.b < y.b;
    });
}

}  // namespace

RunMap map_runs(const LabelVolume& volume) {
    RunMap map;
    map.size = volume.size;
    const Values values = find_runs(volume, map);
    join_equal(map, values);
    number_components(map, values);
    find_contacts(map);
    return map;
}

}  // namespace myotet::segmentation
