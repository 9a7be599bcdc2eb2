// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <vector>

#include "PathShapes.h"
#include "Skeleton/ReadOsim.h"

namespace myotet::skeleton {
namespace {

// Central differences over this step err by its square and by lengths' rounding over it; mm/rad.
constexpr double kStep = 1e-5, kDifference = 1e-4;
// Muscles' points move by no more than this, mm a radian.
constexpr double kReach = 400;
// Poses of a sweep from one end of the coordinates' ranges to the other.
constexpr int kPoses = 1000;
// Near first contact the moment arm has a kink: so many poses of a sweep may miss it.
constexpr int kKinks = 8;

const std::filesystem::path kFile =
    std::filesystem::path(MYOTET_SHARED_DIR) / "data/opensim/models/Arm26/arm26.osim";

class PathArm26 : public testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(kFile)) GTEST_SKIP() << "needs " << kFile;
        model_ = read_osim(kFile);
        skeleton_ = std::make_unique<Skeleton>(model_);
    }
    /// Along a slanted way through both ranges: the shoulder turns up to 90 degrees.
    [[nodiscard]] std::vector<double> pose(double share) const {
        return {-0.5 + 2 * share, 0.02 + 2.2 * (share < 0.5 ? 2 * share : 2 - 2 * share)};
    }
    [[nodiscard]] double length(const Muscle& muscle, const std::vector<double>& values,
                                PathMemory memory) {
        skeleton_->place(values);
        return find_path(model_, muscle, skeleton_->poses(), values, memory).length;
    }

    Model model_;
    std::unique_ptr<Skeleton> skeleton_;
};

TEST_F(PathArm26, MomentArmsAreDifferencesAndLengthsDoNotJump) {
    for (const Muscle& muscle : model_.muscles) {
        SCOPED_TRACE(muscle.name);
        PathMemory memory;
        double before = 0;
        int missed = 0;
        for (int n = 0; n <= kPoses; ++n) {
            std::vector<double> values = pose(static_cast<double>(n) / kPoses);
            skeleton_->place(values);
            const Path path = find_path(model_, muscle, skeleton_->poses(), values, memory);
            const std::vector<double> rates =
                length_rates(model_, muscle, path, skeleton_->poses(), values, skeleton_->rates());
            const double moved = 6.4 / kPoses;
            if (n > 0) {
                EXPECT_LT(std::abs(path.length - before), kReach * moved) << n;
            }
            before = path.length;
            for (std::size_t q = 0; q < values.size(); ++q) {
                std::vector<double> less = values, more = values;
                less[q] -= kStep;
                more[q] += kStep;
                const double difference =
                    (length(muscle, more, memory) - length(muscle, less, memory)) / (2 * kStep);
                missed += !(std::abs(difference - rates[q]) < kDifference);
            }
        }
        EXPECT_LE(missed, kKinks);
    }
}

TEST_F(PathArm26, NoPathEntersAnObjectItWraps) {
    for (const Muscle& muscle : model_.muscles) {
        SCOPED_TRACE(muscle.name);
        PathMemory memory;
        for (int n = 0; n <= 100; ++n) {
            const std::vector<double> values = pose(n / 100.0);
            skeleton_->place(values);
            const auto& bodies = skeleton_->poses();
            const Path path = find_path(model_, muscle, bodies, values, memory);
            for (const PathWrap& wrap : muscle.wraps) {
                const WrapObject& object = model_.wrap_objects[wrap.object];
                const bool on = std::any_of(path.nodes.begin(), path.nodes.end(),
                                            [&](auto& node) { return node.around == wrap.object; });
                if (!on) continue;
                const WrapSurface surface(object);
                const Pose pose = bodies[object.body] * object.in_body;
                for (const Vec3& at : drawn(model_, path, bodies, 0.5))
                    EXPECT_GT(surface.height(pose.to_rest(at)), -kSkinDepth) << object.name;
            }
        }
    }
}

}  // namespace
}  // namespace myotet::skeleton
