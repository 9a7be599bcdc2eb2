// SPDX-License-Identifier: Apache-2.0
#include "Activation/SharedCurves.h"

#include <algorithm>
#include <cmath>

namespace myotet::activation {
namespace {

constexpr double kUsualError = 0.01;  // of the largest torque
constexpr double kLeastError = 1e-3;  // N mm, where all torques are nothing

// Of activation, for slopes by differences: those of elastic tendons leave out what the
// speed of fibres has to do with activation, and fits need exact ones.
constexpr double kStep = 1e-5;

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
    targets.pull = [&](std::size_t t, std::size_t m, double activation) -> Pull {
        const PullOf pull = pulls_at(units, sharing.demands[t], motion, t, options);
        return {pull(m, activation).force,
                (pull(m, activation + kStep).force - pull(m, activation - kStep).force) /
                    (2 * kStep)};
    };
    FitOptions fitting{.spacing = spacing, .effort = 0.3, .excitation_error = 0.01};
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
        std::vector<double> forces, left = motion.torques[t];
        for (std::size_t m = 0; m < units.size(); ++m) {
            forces.push_back(targets.pull(t, m, shared.activations[t][m]).force);
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
