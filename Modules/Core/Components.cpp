// SPDX-License-Identifier: Apache-2.0
#include "Core/Components.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "Core/Errors.h"

namespace myotet {
namespace {

/// Voxels of the label that follow one another along i.
struct Run {
    int first = 0, last = 0;  // inclusive, relative to the box
    std::int32_t parent = 0;  // union-find; the root is the set's first run
};

/// Runs of the whole box; row r = k * size[1] + j holds [row_start[r], row_start[r + 1]).
struct Runs {
    std::vector<Run> runs;
    std::vector<std::int32_t> row_start;
};

std::int32_t find_root(std::vector<Run>& runs, std::int32_t i) {
    while (runs[i].parent != i) {
        runs[i].parent = runs[runs[i].parent].parent;
        i = runs[i].parent;
    }
    return i;
}

void check_box(const LabelVolume& volume, const Index3& box_min, const Index3& box_max) {
    for (int a = 0; a < 3; ++a)
        if (!(0 <= box_min[a] && box_min[a] <= box_max[a] && box_max[a] < volume.size[a]))
            throw InputError("the box [" + std::to_string(box_min[a]) + ", " +
                             std::to_string(box_max[a]) + "] along axis " + std::to_string(a) +
                             " must lie within the volume's " + std::to_string(volume.size[a]) +
                             " voxels; pass the label's own index box");
}

Runs find_runs(const LabelVolume& volume, std::int32_t label, const Components& box) {
    Runs found;
    found.row_start.reserve(static_cast<std::size_t>(box.size[1]) * box.size[2] + 1);
    for (int k = 0; k < box.size[2]; ++k)
        for (int j = 0; j < box.size[1]; ++j) {
            found.row_start.push_back(static_cast<std::int32_t>(found.runs.size()));
            const std::int32_t* row =
                volume.values.data() +
                volume.offset(box.origin[0], box.origin[1] + j, box.origin[2] + k);
            for (int i = 0; i < box.size[0];) {
                if (row[i] != label) {
                    ++i;
                    continue;
                }
                const int first = i;
                while (i < box.size[0] && row[i] == label) ++i;
                const auto self = static_cast<std::int32_t>(found.runs.size());
                found.runs.push_back({first, i - 1, self});
            }
        }
    found.row_start.push_back(static_cast<std::int32_t>(found.runs.size()));
    return found;
}

/// Joins the runs of two neighbouring rows that share a face.
void join_rows(Runs& all, std::size_t row_a, std::size_t row_b) {
    std::int32_t a = all.row_start[row_a], b = all.row_start[row_b];
    const std::int32_t end_a = all.row_start[row_a + 1], end_b = all.row_start[row_b + 1];
    std::vector<Run>& runs = all.runs;
    while (a < end_a && b < end_b) {
        if (runs[a].first <= runs[b].last && runs[b].first <= runs[a].last) {
            const std::int32_t ra = find_root(runs, a), rb = find_root(runs, b);
            runs[std::max(ra, rb)].parent = std::min(ra, rb);
        }
        (runs[a].last < runs[b].last ? a : b) += 1;
    }
}

/// Box and size of every set, in the order of first voxels; `number_of` receives
/// each run's number.
std::vector<ComponentBox> measure(Runs& all, const Components& box,
                                  std::vector<std::int32_t>& number_of) {
    std::vector<ComponentBox> components;
    number_of.assign(all.runs.size(), -1);
    for (std::size_t row = 0; row + 1 < all.row_start.size(); ++row) {
        const int j = box.origin[1] + static_cast<int>(row % box.size[1]);
        const int k = box.origin[2] + static_cast<int>(row / box.size[1]);
        for (std::int32_t r = all.row_start[row]; r < all.row_start[row + 1]; ++r) {
            const std::int32_t root = find_root(all.runs, r);
            const Index3 first{box.origin[0] + all.runs[r].first, j, k};
            const Index3 last{box.origin[0] + all.runs[r].last, j, k};
            if (number_of[root] < 0) {
                number_of[root] = static_cast<std::int32_t>(components.size());
                components.push_back({0, first, last});
            }
            number_of[r] = number_of[root];
            ComponentBox& c = components[number_of[r]];
            c.voxels += last[0] - first[0] + 1;
            for (int a = 0; a < 3; ++a) {
                c.min[a] = std::min(c.min[a], first[a]);
                c.max[a] = std::max(c.max[a], last[a]);
            }
        }
    }
    return components;
}

}  // namespace

Components label_components(const LabelVolume& volume, std::int32_t label, const Index3& box_min,
                            const Index3& box_max) {
    check_box(volume, box_min, box_max);
    Components result;
    result.origin = box_min;
    for (int a = 0; a < 3; ++a) result.size[a] = box_max[a] - box_min[a] + 1;

    Runs all = find_runs(volume, label, result);
    const std::size_t rows_j = result.size[1], rows = all.row_start.size() - 1;
    for (std::size_t row = 0; row < rows; ++row) {
        if (row % rows_j != 0) join_rows(all, row - 1, row);
        if (row >= rows_j) join_rows(all, row - rows_j, row);
    }

    std::vector<std::int32_t> number_of;
    const std::vector<ComponentBox> found = measure(all, result, number_of);
    std::vector<std::int32_t> order(found.size()), rank(found.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        return found[a].voxels > found[b].voxels;
    });
    for (std::size_t n = 0; n < order.size(); ++n) {
        rank[order[n]] = static_cast<std::int32_t>(n);
        result.components.push_back(found[order[n]]);
    }

    result.number.assign(rows * result.size[0], -1);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::int32_t r = all.row_start[row]; r < all.row_start[row + 1]; ++r)
            std::fill(result.number.begin() + row * result.size[0] + all.runs[r].first,
                      result.number.begin() + row * result.size[0] + all.runs[r].last + 1,
                      rank[number_of[r]]);
    return result;
}

}  // namespace myotet
