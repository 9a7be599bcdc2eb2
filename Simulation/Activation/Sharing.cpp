// SPDX-License-Identifier: Apache-2.0
#include "Activation/Sharing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace myotet::activation {
namespace {

using muscle::RigidPull;
using skeleton::Model;

// Of muscles whose cross-section is not told: its size moves no share.
constexpr double kSpecificTension = 0.3;  // MPa
// An arm below this moves nothing: what rounding leaves of mm.
constexpr double kNoArm = 1e-9;

// Coordinates that no muscle moves at any time.
std::vector<bool> without_muscles(const Model& model, const MuscleMotion& motion) {
    std::vector<bool> none(model.coordinates.size(), true);
    for (const Eigen::MatrixXd& arms : motion.arms)
        for (Eigen::Index c = 0; c < arms.rows(); ++c)
            if (arms.cols() > 0 && arms.row(c).cwiseAbs().maxCoeff() > kNoArm)
                none[static_cast<std::size_t>(c)] = false;
    return none;
}

// Completes what the caller left to the model.
DistributionOptions completed(const Model& model, const MuscleMotion& motion,
                              const SharingOptions& options, std::vector<std::string>& notes) {
    DistributionOptions made = options.distribution;
    const std::size_t count = model.coordinates.size();
    if (made.reserves.empty()) made.reserves.assign(count, 0);
    const std::vector<bool> idle = without_muscles(model, motion);
    for (std::size_t c = 0; c < count; ++c) {
        const bool held = c < options.held.size() && options.held[c];
        if (!held && !idle[c] && !model.coordinates[c].locked) continue;
        made.reserves[c] = std::numeric_limits<double>::infinity();
        if (idle[c] && !held && !model.coordinates[c].locked)
            notes.push_back("no muscle moves " + model.coordinates[c].name +
                            ": its torque is left to what holds it");
    }
    if (made.criterion == Criterion::stress && made.areas.empty())
        for (const auto& m : model.muscles)
            made.areas.push_back(m.max_isometric_force / kSpecificTension);
    if (made.muscle_names.empty())
        for (const auto& m : model.muscles) made.muscle_names.push_back(m.name);
    if (made.coordinate_names.empty())
        for (const auto& c : model.coordinates) made.coordinate_names.push_back(c.name);
    return made;
}

bool is_elastic(const SkeletonUnit& unit, Tendons tendons) {
    return tendons == Tendons::elastic || (tendons == Tendons::as_modelled && !unit.rigid_tendon);
}

void tell_worst(const MuscleMotion& motion, Sharing& sharing) {
    sharing.status = Status::converged;
    for (std::size_t t = 0; t < sharing.at.size(); ++t) {
        const Distribution& one = sharing.at[t];
        if (one.status == Status::converged) continue;
        if (sharing.status == Status::converged)
            sharing.message = "at " + std::to_string(motion.times[t]) + " s " + one.message;
        if (sharing.status != Status::not_converged) sharing.status = one.status;
    }
}

}  // namespace

std::vector<double> MuscleTable::at(double time) const {
    if (times.empty()) return {};
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    if (after == times.begin()) return rows.front();
    if (after == times.end()) return rows.back();
    const auto i = static_cast<std::size_t>(after - times.begin());
    const double part = (time - times[i - 1]) / (times[i] - times[i - 1]);
    std::vector<double> row(rows[i].size());
    for (std::size_t m = 0; m < row.size(); ++m)
        row[m] = (1 - part) * rows[i - 1][m] + part * rows[i][m];
    return row;
}

std::vector<SkeletonUnit> units_for(const Model& model, const SharingOptions& options) {
    std::vector<SkeletonUnit> units = units_of(model);
    if (!options.passive)
        for (SkeletonUnit& unit : units) {
            unit.unit.curves.passive = [](double) { return muscle::CurvePoint{}; };
            unit.unit.curves.damping = 0;
        }
    return units;
}

std::vector<Demand> demands_of(const Model& model, std::span<const SkeletonUnit> units,
                               const MuscleMotion& motion, const SharingOptions& options) {
    std::vector<Demand> demands;
    for (std::size_t t = 0; t < motion.times.size(); ++t) {
        Demand demand{.torques = motion.torques[t], .arms = motion.arms[t]};
        const std::vector<double> lowest = options.lowest.at(motion.times[t]),
                                  highest = options.highest.at(motion.times[t]);
        demand.measured = options.measured.at(motion.times[t]);
        for (std::size_t m = 0; m < units.size(); ++m) {
            const double speed = options.force_velocity ? motion.speeds[t][m] : 0;
            const RigidPull pull = rigid_pull(units[m].unit, motion.lengths[t][m], speed);
            demand.gains.push_back(pull.gain);
            demand.passive.push_back(pull.passive);
            const skeleton::Muscle& muscle = model.muscles[m];
            double least = muscle.lowest_activation, most = muscle.highest_activation;
            if (!lowest.empty() && !std::isnan(lowest[m])) least = std::max(least, lowest[m]);
            if (!highest.empty() && !std::isnan(highest[m])) most = std::min(most, highest[m]);
            demand.lowest.push_back(least);
            demand.highest.push_back(most);
        }
        demands.push_back(std::move(demand));
    }
    return demands;
}

PullOf pulls_at(std::span<const SkeletonUnit> units, const Demand& demand,
                const MuscleMotion& motion, std::size_t t, const SharingOptions& options) {
    return [=, &demand, &motion, &options](std::size_t m, double activation) -> Pull {
        if (!is_elastic(units[m], options.tendons))
            return {demand.passive[m] + demand.gains[m] * activation, demand.gains[m]};
        const double speed = options.force_velocity ? motion.speeds[t][m] : 0;
        const muscle::ElasticPull pull =
            elastic_pull(units[m].unit, muscle::UnitMotion{.length = motion.lengths[t][m],
                                                           .speed = speed,
                                                           .activation = activation});
        return {pull.force, pull.force_by_activation};
    };
}

Sharing share(const Model& model, const MuscleMotion& motion, const SharingOptions& options,
              ProgressSink& progress) {
    Sharing sharing;
    const std::vector<SkeletonUnit> units = units_for(model, options);
    for (const SkeletonUnit& unit : units)
        if (!unit.note.empty()) sharing.notes.push_back(unit.note);
    const DistributionOptions distribution = completed(model, motion, options, sharing.notes);
    for (const double strength : distribution.reserves)
        sharing.held.push_back(std::isinf(strength));
    sharing.demands = demands_of(model, units, motion, options);
    const bool elastic = std::ranges::any_of(
        units, [&](const SkeletonUnit& unit) { return is_elastic(unit, options.tendons); });
    if (!elastic) {
        sharing.at = distribute(sharing.demands, distribution, progress);
    } else {
        for (std::size_t t = 0; t < sharing.demands.size(); ++t) {
            progress.report("muscle forces",
                            static_cast<double>(t) / static_cast<double>(sharing.demands.size()));
            progress.check();
            sharing.at.push_back(distribute(sharing.demands[t],
                                            pulls_at(units, sharing.demands[t], motion, t, options),
                                            distribution));
        }
    }
    tell_worst(motion, sharing);
    return sharing;
}

}  // namespace myotet::activation
