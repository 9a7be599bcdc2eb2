// SPDX-License-Identifier: Apache-2.0
#include "Quality/LabelDistance.h"

#include <cmath>

#include "Core/Parallel.h"

namespace myotet::quality {
namespace {

constexpr std::size_t kGrain = 512;

class Staircase {
public:
    Staircase(const LabelVolume& labels, std::int32_t label, double limit)
        : labels_(labels),
          label_(label),
          limit_(limit),
          spacing_(labels.spacing()),
          to_index_(labels.index_to_lps.inverse()) {}

    // From a point to the nearest voxel that differs, in this label, from the voxel it is in. Of
    // voxels r away along an axis none is nearer than r - 1 of the smallest spacing.
    [[nodiscard]] double distance(const Vec3& point) const {
        const Vec3 x = to_index_ * point;
        const Vec3 size(labels_.size[0], labels_.size[1], labels_.size[2]);
        const double reach = limit_ / spacing_.minCoeff() + 1;
        if (!((x.array() > -reach).all() && (x.array() < size.array() + reach).all()))
            return limit_;
        const Index3 at{static_cast<int>(std::lround(x[0])), static_cast<int>(std::lround(x[1])),
                        static_cast<int>(std::lround(x[2]))};
        const bool inside = is_label(at[0], at[1], at[2]);
        double best = limit_ * limit_;
        for (int r = 1;; ++r) {
            const double nearest = (r - 1) * spacing_.minCoeff();
            if (nearest * nearest >= best) return std::sqrt(best);
            search_shell(x, at, r, inside, best);
        }
    }

private:
    [[nodiscard]] bool is_label(int i, int j, int k) const {
        const Index3& n = labels_.size;
        if (i < 0 || j < 0 || k < 0 || i >= n[0] || j >= n[1] || k >= n[2]) return false;
        return labels_.values[labels_.offset(i, j, k)] == label_;
    }
    void search_shell(const Vec3& x, const Index3& at, int r, bool inside, double& best) const {
        for (int k = at[2] - r; k <= at[2] + r; ++k)
            for (int j = at[1] - r; j <= at[1] + r; ++j) {
                const bool on_face = std::abs(k - at[2]) == r || std::abs(j - at[1]) == r;
                for (int i = at[0] - r; i <= at[0] + r; i += on_face ? 1 : 2 * r) {
                    const double d = squared_distance(x, i, j, k);
                    if (d < best && is_label(i, j, k) != inside) best = d;
                }
            }
    }
    [[nodiscard]] double squared_distance(const Vec3& x, int i, int j, int k) const {
        const Vec3 away = ((x - Vec3(i, j, k)).cwiseAbs().array() - 0.5).max(0.0).matrix();
        return away.cwiseProduct(spacing_).squaredNorm();
    }

    const LabelVolume& labels_;
    std::int32_t label_;
    double limit_;
    Vec3 spacing_;
    Eigen::Affine3d to_index_;
};

}  // namespace

std::vector<double> distance_to_label(const LabelVolume& labels, std::int32_t label,
                                      std::span<const Vec3> points, double limit) {
    const Staircase staircase(labels, label, limit);
    std::vector<double> distances(points.size());
    parallel_for(0, points.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) distances[p] = staircase.distance(points[p]);
    });
    return distances;
}

}  // namespace myotet::quality
