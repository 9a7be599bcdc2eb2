// SPDX-License-Identifier: Apache-2.0
#include "Contraction/FitActivation.h"

#include <algorithm>
#include <cmath>

#include "Contraction/Words.h"
#include "Core/Errors.h"

namespace myotet::contraction {
namespace {

using activation::SplineBasis;
using skeleton::Table;

constexpr double kSample = 0.01;   // s, between points of an activation
constexpr double kInterval = 0.2;  // s, about what a muscle can follow
constexpr int kMostIntervals = 5;  // each costs an evaluation for its derivative

void require(bool holds, const std::string& what, double value, const std::string& rule) {
    if (!holds) throw InputError(what + " is " + rounded(value) + ", but " + rule);
}

// The columns of a table that a history has, by their place there.
std::vector<std::size_t> places_of(const Table& table, const std::vector<Column>& columns) {
    std::vector<std::string> known;
    for (std::size_t c = 1; c < columns.size(); ++c) known.push_back(columns[c].name);
    std::vector<std::size_t> places;
    for (const std::string& column : table.columns) {
        const std::string name = column.substr(0, column.find(" ["));  // as history.csv has units
        const auto found = std::ranges::find(known, name);
        if (found == known.end())
            throw InputError("'" + name + "' is no quantity of the scene's history; it has " +
                             list_of(known));
        places.push_back(static_cast<std::size_t>(found - known.begin()) + 1);
    }
    return places;
}

double value_of(const History& history, std::size_t column, double time) {
    const auto& rows = history.rows;
    const auto after =
        std::ranges::upper_bound(rows, time, {}, [](const auto& row) { return row[0]; });
    if (after == rows.begin()) return rows.front()[column];
    if (after == rows.end()) return rows.back()[column];
    const auto& before = *(after - 1);
    const double part = (time - before[0]) / ((*after)[0] - before[0]);
    return (1 - part) * before[column] + part * (*after)[column];
}

Curve curve_of(const SplineBasis& basis, const std::vector<double>& coefficients) {
    Curve curve;
    const int count = static_cast<int>(std::ceil(basis.end / kSample - 1e-9));
    for (int i = 0; i <= count; ++i) {
        const double time = std::min(basis.end, i * kSample);
        const SplineBasis::Local local = basis.at(time);
        double value = 0;
        for (std::size_t k = 0; k < local.value.size(); ++k)
            value += local.value[k] * coefficients[static_cast<std::size_t>(local.first) + k];
        curve.times.push_back(time);
        curve.values.push_back(std::clamp(value, 0.0, 1.0));
    }
    return curve;
}

// What the scene says at each spline's middle.
std::vector<double> first_guess(const SplineBasis& basis, const Curve& activation) {
    std::vector<double> coefficients;
    for (int i = 0; i < basis.count(); ++i) {
        const double middle = basis.begin + (i - 1) * basis.spacing();
        coefficients.push_back(
            std::clamp(value_at(activation, std::clamp(middle, basis.begin, basis.end)), 0.0, 1.0));
    }
    return coefficients;
}

std::vector<FittedQuantity> quantities_of(const Table& target) {
    std::vector<FittedQuantity> quantities;
    for (std::size_t q = 0; q < target.columns.size(); ++q) {
        double most = 0;
        for (const auto& row : target.rows) most = std::max(most, std::abs(row[q]));
        if (!(most > 0))
            throw InputError("'" + target.columns[q] +
                             "' is 0 at all times, so that there is nothing to follow");
        quantities.push_back({target.columns[q], most});
    }
    return quantities;
}

// The scene with one activation after the other.
class Runs {
public:
    Runs(Scene& scene, Model& model, std::size_t body, const Table& target,
         const ProgressSink& progress)
        : scene_(scene),
          model_(model),
          body_(body),
          target_(target),
          progress_(progress),
          places_(places_of(target, history_columns(scene, model))) {}

    // Differences from the target, by its rows, in parts of `size`.
    activation::Evaluation evaluate(const Curve& activation, const std::vector<double>& size) {
        scene_.bodies[body_].activation = activation;
        Trial trial = try_scene(scene_, model_, {}, progress_);
        if (trial.interrupted) progress_.check();
        activation::Evaluation told;
        told.message = trial.message;
        if (!trial.completed) return told;
        double squares = 0;
        for (std::size_t t = 0; t < target_.times.size(); ++t)
            for (std::size_t q = 0; q < places_.size(); ++q) {
                const double is = value_of(trial.history, places_[q], target_.times[t]);
                told.residuals.push_back((is - target_.rows[t][q]) / size[q]);
                squares += told.residuals.back() * told.residuals.back();
            }
        if (best.rows.empty() || squares < least_) {
            least_ = squares;
            best = std::move(trial.history);
        }
        return told;
    }

    History best;

private:
    Scene& scene_;
    Model& model_;
    std::size_t body_;
    const Table& target_;
    const ProgressSink& progress_;
    std::vector<std::size_t> places_;  // of the quantities in the history
    double least_ = 0;
};

void find_misfits(const Table& target, const std::vector<double>& size, ActivationFit& made) {
    const std::vector<double>& left = made.fit.residuals;
    for (std::size_t i = 0; i < left.size(); ++i) {
        const double error = left[i] * size[i % size.size()];
        made.quantities[i % size.size()].misfit += error * error;
    }
    for (FittedQuantity& quantity : made.quantities)
        quantity.misfit = std::sqrt(quantity.misfit / static_cast<double>(target.times.size()));
}

}  // namespace

void ActivationFitOptions::validate() const {
    require(intervals >= 0, "number of intervals", intervals, "it must not be negative");
    require(evaluations > 0, "number of evaluations", evaluations, "it must be positive");
    require(goal > 0 && std::isfinite(goal), "goal", goal, "it must be positive");
}

ActivationFit fit_activation(Scene& scene, Model& model, std::size_t body, const Table& target,
                             const ActivationFitOptions& options, ProgressSink& progress) {
    options.validate();
    Runs runs(scene, model, body, target, progress);
    if (target.times.front() < 0 || target.times.back() > scene.time.end)
        throw InputError("its times go from " + rounded(target.times.front()) + " to " +
                         rounded(target.times.back()) + " s, but the scene from 0 to " +
                         rounded(scene.time.end) + " s; cut it, or let the scene be longer");
    ActivationFit made{.quantities = quantities_of(target)};
    const int chosen = static_cast<int>(std::ceil(scene.time.end / kInterval));
    made.basis = {
        0, scene.time.end,
        options.intervals > 0 ? options.intervals : std::clamp(chosen, 1, kMostIntervals)};
    std::vector<double> size;
    for (const FittedQuantity& quantity : made.quantities)
        size.push_back(options.goal * quantity.most);
    activation::ExpensiveOptions search;
    search.lowest.assign(made.basis.count(), 0);
    search.highest.assign(made.basis.count(), 1);
    search.evaluations = options.evaluations;
    search.goal = 1;  // residuals are in parts of the goal
    made.fit = activation::fit_expensive(
        [&](const std::vector<double>& c) { return runs.evaluate(curve_of(made.basis, c), size); },
        first_guess(made.basis, scene.bodies[body].activation), search, progress);
    made.activation = curve_of(made.basis, made.fit.coefficients);
    made.history = std::move(runs.best);
    find_misfits(target, size, made);
    return made;
}

}  // namespace myotet::contraction
