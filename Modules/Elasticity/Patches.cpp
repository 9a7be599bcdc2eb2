// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "Core/Errors.h"
#include "Elasticity/Points.h"

namespace myotet::elasticity {
namespace {

// Grows patches of neighbours one after the other, in the order of the tetrahedra. The
// next one of a patch brings the fewest new nodes; of those, the one with most faces in it.
class Patches {
public:
    Patches(const TetMesh& mesh, int size)
        : mesh_(mesh),
          behind_(face_neighbours(mesh.tets)),
          size_(static_cast<std::size_t>(size)),
          patch_of_(mesh.tets.size(), -1) {
        for (std::size_t t = 0; t < mesh.tets.size(); ++t)
            if (patch_of_[t] < 0) grow(static_cast<std::int32_t>(t));
        for (std::size_t p = 0; p < members_.size(); ++p) dissolve(p);
    }

    // Patches in the order of their first tetrahedra, none empty.
    [[nodiscard]] std::vector<std::vector<std::int32_t>> members() && {
        std::erase_if(members_, [](const auto& patch) { return patch.empty(); });
        for (auto& patch : members_) std::sort(patch.begin(), patch.end());
        return std::move(members_);
    }

private:
    [[nodiscard]] bool alike(std::int32_t t, std::int32_t u) const {
        return mesh_.labels.empty() || mesh_.labels[t] == mesh_.labels[u];
    }
    void take(std::int32_t t, std::int32_t patch) {
        patch_of_[t] = patch;
        members_[patch].push_back(t);
    }
    void grow(std::int32_t seed) {
        const auto patch = static_cast<std::int32_t>(members_.size());
        members_.emplace_back();
        take(seed, patch);
        std::vector<std::int32_t> nodes(mesh_.tets[seed].begin(), mesh_.tets[seed].end());
        const auto is_new = [&](std::int32_t n) {
            return std::find(nodes.begin(), nodes.end(), n) == nodes.end();
        };
        while (members_[patch].size() < size_) {
            std::array<std::int32_t, 3> best{5, 0, -1};  // new nodes, minus faces, tetrahedron
            for (const std::int32_t t : members_[patch])
                for (const std::int32_t u : behind_[t]) {
                    if (u < 0 || patch_of_[u] >= 0 || !alike(t, u)) continue;
                    const auto fresh =
                        std::count_if(mesh_.tets[u].begin(), mesh_.tets[u].end(), is_new);
                    const auto faces = std::count_if(
                        behind_[u].begin(), behind_[u].end(),
                        [&](std::int32_t w) { return w >= 0 && patch_of_[w] == patch; });
                    best = std::min(best, {static_cast<std::int32_t>(fresh),
                                           -static_cast<std::int32_t>(faces), u});
                }
            if (best[2] < 0) return;
            take(best[2], patch);
            for (const std::int32_t n : mesh_.tets[best[2]])
                if (is_new(n)) nodes.push_back(n);
        }
    }
    // What is less than half a patch goes to its smallest neighbours.
    void dissolve(std::size_t patch) {
        if (2 * members_[patch].size() >= size_) return;
        std::vector<std::int32_t> left;
        for (const std::int32_t t : members_[patch]) {
            std::int32_t to = -1;
            for (const std::int32_t u : behind_[t]) {
                if (u < 0 || !alike(t, u) || patch_of_[u] == static_cast<std::int32_t>(patch))
                    continue;
                if (to < 0 || members_[patch_of_[u]].size() < members_[to].size())
                    to = patch_of_[u];
            }
            if (to < 0)
                left.push_back(t);
            else
                take(t, to);
        }
        members_[patch] = std::move(left);
    }

    const TetMesh& mesh_;
    std::vector<Tet> behind_;
    std::size_t size_;
    std::vector<std::int32_t> patch_of_;
    std::vector<std::vector<std::int32_t>> members_;
};

// The point of a patch: mean of the gradients of its tetrahedra, which come first among
// the points.
void add_mean(const std::vector<std::int32_t>& patch, double share, Points& points) {
    double volume = 0;
    for (const std::int32_t t : patch) volume += points.groups.volume[t];
    const std::size_t first = points.node.size();
    for (const std::int32_t t : patch)
        for (std::size_t i = points.start[t]; i < points.start[t + 1]; ++i) {
            const std::int32_t n = points.node[i];
            const Vec3 part = points.groups.volume[t] / volume * points.gradient[i];
            const auto found = std::find(points.node.begin() + static_cast<std::ptrdiff_t>(first),
                                         points.node.end(), n);
            if (found == points.node.end()) {
                points.node.push_back(n);
                points.gradient.push_back(part);
            } else {
                points.gradient[found - points.node.begin()] += part;
            }
        }
    points.start.push_back(points.node.size());
    points.volume.push_back(share * volume);
    points.tet.insert(points.tet.end(), patch.begin(), patch.end());
    points.tet_start.push_back(points.tet.size());
}

}  // namespace

void PatchOptions::validate() const {
    if (!(size >= 1 && size <= 64))
        throw InputError("size of a patch is " + std::to_string(size) +
                         ", but it must be 1 to 64 tetrahedra");
    if (!(mean_share >= 0 && mean_share < 1))
        throw InputError("share of a patch's mean is " + std::to_string(mean_share) +
                         ", but it must be at least 0 and below 1");
}

Points patch_points(const TetMesh& rest, const PatchOptions& options) {
    options.validate();
    Points points = linear_points(rest);
    const auto patches = Patches(rest, options.size).members();
    const auto tets = static_cast<std::uint32_t>(points.size());
    // In the order of the tetrahedra while means are taken, then in that of the groups.
    const std::vector<double> volume = points.volume;
    points.groups.volume = volume;
    if (options.mean_share > 0)
        for (const auto& patch : patches) add_mean(patch, options.mean_share, points);
    points.groups.volume.clear();
    for (const auto& patch : patches) {
        for (const std::int32_t t : patch) {
            points.groups.point.push_back(static_cast<std::uint32_t>(t));
            points.groups.volume.push_back(volume[t]);
        }
        points.groups.start.push_back(points.groups.point.size());
        points.groups.law.push_back(static_cast<std::uint32_t>(patch.front()));
    }
    for (std::uint32_t t = 0; t < tets; ++t) points.volume[t] *= 1 - options.mean_share;
    return points;
}

}  // namespace myotet::elasticity
