// SPDX-License-Identifier: Apache-2.0
#include "Activation/MuscleMotion.h"

#include <set>

#include "Skeleton/Path.h"
#include "Skeleton/Skeleton.h"

namespace myotet::activation {
namespace {

using skeleton::Model;

// Follows the muscles of a model from one time to the next.
class Follower {
public:
    explicit Follower(const Model& model)
        : model_(model), skeleton_(model), memory_(model.muscles.size()) {}

    void add(const skeleton::Instant& now, MuscleMotion& motion) {
        motion.torques.push_back(
            skeleton_.inverse_dynamics(now.values, now.speeds, now.accelerations));
        const auto rates = skeleton_.rates();
        const std::size_t muscles = model_.muscles.size(), coordinates = model_.coordinates.size();
        std::vector<double> lengths(muscles), speeds(muscles, 0.0);
        Eigen::MatrixXd arms(coordinates, muscles);
        for (std::size_t m = 0; m < muscles; ++m) {
            const skeleton::Muscle& muscle = model_.muscles[m];
            const skeleton::Path path =
                skeleton::find_path(model_, muscle, skeleton_.poses(), now.values, memory_[m]);
            for (const int object : path.inside) inside_.insert({static_cast<int>(m), object});
            for (const int object : path.missed) missed_.insert({static_cast<int>(m), object});
            const std::vector<double> slopes =
                skeleton::length_rates(model_, muscle, path, skeleton_.poses(), now.values, rates);
            lengths[m] = path.length;
            // dL/dt = sum_c dL/dq_c dq_c/dt
            for (std::size_t c = 0; c < coordinates; ++c) {
                arms(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(m)) = -slopes[c];
                speeds[m] += slopes[c] * now.speeds[c];
            }
        }
        motion.lengths.push_back(std::move(lengths));
        motion.speeds.push_back(std::move(speeds));
        motion.arms.push_back(std::move(arms));
    }
    [[nodiscard]] std::vector<std::string> notes() const {
        std::vector<std::string> sentences;
        for (const auto& [muscle, object] : inside_)
            sentences.push_back(
                "muscle " + model_.muscles[muscle].name + " has a point inside the wrap object " +
                model_.wrap_objects[object].name + " at times, which it then runs through");
        for (const auto& [muscle, object] : missed_)
            sentences.push_back("muscle " + model_.muscles[muscle].name +
                                " has no taut path over the wrap object " +
                                model_.wrap_objects[object].name +
                                " at times, and then runs through it");
        return sentences;
    }

private:
    const Model& model_;
    skeleton::Skeleton skeleton_;
    std::vector<skeleton::PathMemory> memory_;       // a muscle
    std::set<std::pair<int, int>> inside_, missed_;  // muscle, wrap object
};

}  // namespace

MuscleMotion follow_muscles(const Model& model, const skeleton::Trajectory& trajectory,
                            std::span<const double> times, bool still, ProgressSink& progress) {
    constexpr std::size_t kTell = 256;
    MuscleMotion motion;
    motion.times.assign(times.begin(), times.end());
    Follower follower(model);
    for (std::size_t t = 0; t < times.size(); ++t) {
        if (t % kTell == 0) {
            progress.report("inverse dynamics",
                            static_cast<double>(t) / static_cast<double>(times.size()));
            progress.check();
        }
        skeleton::Instant now = skeleton::at(trajectory, times[t]);
        if (still) {
            now.speeds.assign(now.speeds.size(), 0);
            now.accelerations.assign(now.accelerations.size(), 0);
        }
        follower.add(now, motion);
    }
    motion.notes = follower.notes();
    return motion;
}

}  // namespace myotet::activation
