// SPDX-License-Identifier: Apache-2.0
#include "Activation/SharedCurves.h"

#include <algorithm>
#include <cmath>

#include "Skeleton/Spline.h"

namespace myotet::activation {
namespace {

constexpr double kUsualError = 0.01;  // of the largest torque
constexpr double kLeastError = 1e-3;  // N mm, where all torques are nothing
// The squares of activations take a part 2 kEffort kUsualError^2 sum a^2 of a torque: even with
// a muscle at its most a fifth of the usual error. Less of them lets muscles work against each
// other for torques that splines cannot follow: of 0.3, arm26 with knots each 0.1 s has 1.8 to
// 2 times the squares that each time on its own needs, of 10 1.1 times.
constexpr double kEffort = 10;
constexpr double kExcitationError = 0.01;  // what may be left of limits

// Parts of a muscle's range, at whose ends its pull is found: of arm26 it is known to some
// 1e-4 of the strength between them, and to 1e-3 where the laws of fibres have kinks.
constexpr int kPulls = 32;

// Pulls as splines of activation, a time and a muscle: fits need exact slopes, and those of
// elastic tendons leave out what the speed of fibres has to do with activation; and the laws
// of fibres have kinks.
class PullSplines {
public:
    PullSplines(const skeleton::Model& model, std::size_t times) : model_(model) {
        splines_.reserve(times * model.muscles.size());
    }

    void add(const PullOf& pull) {
        for (std::size_t m = 0; m < model_.muscles.size(); ++m) {
            const double lowest = model_.muscles[m].lowest_activation,
                         range = model_.muscles[m].highest_activation - lowest;
            std::vector<double> activations, forces;
            for (int k = 0; k <= kPulls; ++k) {
                activations.push_back(lowest + range * k / kPulls);
                forces.push_back(pull(m, activations.back()).force);
            }
            splines_.push_back(
                skeleton::spline_through(activations, forces, 5, skeleton::SplineEnds::natural));
        }
    }

    [[nodiscard]] Pull at(std::size_t time, std::size_t muscle, double activation) const {
        const auto found = evaluate(splines_[time * model_.muscles.size() + muscle], activation);
        return {found.value, found.slope, found.bend};
    }

private:
    const skeleton::Model& model_;
    std::vector<skeleton::Spline> splines_;  ///< [time muscles + muscle]
};

// Without the coordinates whose torque something else holds.
Demand without_held(const Demand& demand, const std::vector<bool>& held) {
    Demand left = demand;
    left.torques.clear();
    const auto count = std::ranges::count(held, false);
    left.arms.resize(count, demand.arms.cols());
    for (std::size_t c = 0; c < held.size(); ++c) {
        if (held[c]) continue;
        left.arms.row(static_cast<Eigen::Index>(left.torques.size())) =
            demand.arms.row(static_cast<Eigen::Index>(c));
        left.torques.push_back(demand.torques[c]);
    }
    return left;
}

double largest_torque(const std::vector<Demand>& demands) {
    double most = 0;
    for (const Demand& demand : demands)
        for (const double torque : demand.torques) most = std::max(most, std::abs(torque));
    return most;
}

}  // namespace

SharedCurves share_by_curves(const skeleton::Model& model, const MuscleMotion& motion,
                             const SharingOptions& options, const Sharing& sharing,
                             double spacing) {
    const std::vector<SkeletonUnit> units = units_for(model, options);
    FitTargets targets{.times = motion.times};
    for (const Demand& demand : sharing.demands)
        targets.demands.push_back(without_held(demand, sharing.held));
    PullSplines splines(model, motion.times.size());
    for (std::size_t t = 0; t < motion.times.size(); ++t)
        splines.add(pulls_at(units, sharing.demands[t], motion, t, options));
    targets.pull = [&splines](std::size_t t, std::size_t m, double activation) {
        return splines.at(t, m, activation);
    };
    FitOptions fitting{.spacing = spacing, .effort = kEffort, .excitation_error = kExcitationError};
    fitting.torque_error = std::max(kLeastError, kUsualError * largest_torque(targets.demands));
    for (std::size_t m = 0; m < units.size(); ++m) {
        fitting.dynamics.push_back(units[m].dynamics);
        fitting.lowest.push_back(model.muscles[m].lowest_activation);
        fitting.highest.push_back(model.muscles[m].highest_activation);
    }
    const CurveFit fit = fit_curves(targets, fitting);

    SharedCurves shared{.fit = fit.summary};
    for (std::size_t t = 0; t < motion.times.size(); ++t) {
        shared.activations.push_back(fit.curves.activations(motion.times[t]));
        const PullOf pull = pulls_at(units, sharing.demands[t], motion, t, options);
        std::vector<double> forces, left = motion.torques[t];
        for (std::size_t m = 0; m < units.size(); ++m) {
            forces.push_back(pull(m, shared.activations[t][m]).force);
            for (std::size_t c = 0; c < left.size(); ++c)
                left[c] -=
                    motion.arms[t](static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(m)) *
                    forces[m];
        }
        for (std::size_t c = 0; c < left.size(); ++c)
            if (sharing.held[c]) left[c] = 0;
        shared.forces.push_back(std::move(forces));
        shared.left.push_back(std::move(left));
    }
    return shared;
}

}  // namespace myotet::activation
