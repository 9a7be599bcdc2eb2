// SPDX-License-Identifier: Apache-2.0
#include "FitJob.h"

#include <algorithm>
#include <cmath>

#include "Core/AtomicFile.h"
#include "Core/Parallel.h"
#include "Core/Stopwatch.h"
#include "Core/Text.h"
#include "ExitCodes.h"
#include "Machine.h"
#include "Outputs.h"
#include "SceneShapes.h"
#include "Skeleton/Table.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

using activation::SplineBasis;
using contraction::Curve;
using contraction::History;
using contraction::Scene;
using skeleton::Table;

constexpr double kSample = 0.01;   // s, of activation.sto
constexpr double kInterval = 0.2;  // s, of the spline, about what a muscle can follow
constexpr int kMostIntervals = 5;  // each costs an evaluation for its derivative

std::size_t body_of(const Scene& scene, const contraction::Model& model, const std::string& name) {
    std::vector<std::string> muscles;
    std::vector<std::size_t> found;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        if (!(model.bodies[b].greatest_tension > 0)) continue;
        muscles.push_back(scene.bodies[b].name);
        if (name.empty() || name == muscles.back()) found.push_back(b);
    }
    if (found.size() == 1) return found.front();
    if (muscles.empty())
        throw InputError(scene.file.string() + ": has no muscle whose activation could be fitted");
    throw UsageError("--body: " +
                     (name.empty() ? "the scene has several muscles; name one of "
                                   : "'" + name + "' is no muscle of the scene; it has ") +
                     list_of(muscles));
}

// The columns of a table that a history has, by their place there.
std::vector<std::size_t> quantities_of(const Table& table, const History& history,
                                       const fs::path& file) {
    std::vector<std::string> known;
    for (std::size_t c = 1; c < history.columns.size(); ++c)
        known.push_back(history.columns[c].name);
    std::vector<std::size_t> places;
    for (const std::string& column : table.columns) {
        const std::string name = column.substr(0, column.find(" ["));  // as history.csv has units
        const auto found = std::ranges::find(known, name);
        if (found == known.end())
            throw InputError(file.string() + ": '" + name +
                             "' is no quantity of the scene's history; it has " + list_of(known));
        places.push_back(static_cast<std::size_t>(found - known.begin()) + 1);
    }
    return places;
}

double value_at(const History& history, std::size_t column, double time) {
    const auto& rows = history.rows;
    const auto after =
        std::ranges::upper_bound(rows, time, {}, [](const auto& row) { return row[0]; });
    if (after == rows.begin()) return rows.front()[column];
    if (after == rows.end()) return rows.back()[column];
    const auto& a = *(after - 1);
    const double part = (time - a[0]) / ((*after)[0] - a[0]);
    return (1 - part) * a[column] + part * (*after)[column];
}

// Seeks the activation; holds what each evaluation needs.
class Fitter {
public:
    Fitter(const FitJobOptions& options, FitReport& report, ProgressSink& progress)
        : options_(options), report_(report), progress_(progress) {}

    void prepare() {
        scene_ = contraction::read_scene(options_.scene);
        target_ = skeleton::read_table(options_.target);
        LoadedShapes loaded = load_shapes(scene_, progress_);
        progress_.check();
        model_ = contraction::build_model(scene_, std::move(loaded.shapes),
                                          data_folder() / "materials", progress_);
        report_.warnings = model_.warnings;
        report_.warnings.insert(report_.warnings.end(), loaded.notes.begin(), loaded.notes.end());
        body_ = body_of(scene_, model_, options_.body);
        History named;
        named.columns = contraction::history_columns(scene_, model_);
        places_ = quantities_of(target_, named, options_.target);
        check_times();
        const double end = scene_.time.end;
        const int chosen = static_cast<int>(std::ceil(end / kInterval));
        basis_ = {
            0, end,
            options_.intervals > 0 ? options_.intervals : std::clamp(chosen, 1, kMostIntervals)};
        find_sizes();
        describe();
    }

    void fit() {
        activation::ExpensiveOptions search;
        search.lowest.assign(basis_.count(), 0);
        search.highest.assign(basis_.count(), 1);
        search.evaluations = options_.evaluations;
        search.goal = 1;  // residuals are in parts of the goal
        report_.fit =
            activation::fit_expensive([this](const std::vector<double>& c) { return evaluate(c); },
                                      first_guess(), search, progress_);
        const std::vector<double>& left = report_.fit.residuals;
        report_.misfit.assign(places_.size(), 0);
        for (std::size_t i = 0; i < left.size(); ++i) {
            const double error = left[i] * size_[i % places_.size()];
            report_.misfit[i % places_.size()] += error * error;
        }
        for (double& sum : report_.misfit)
            sum = std::sqrt(sum / static_cast<double>(target_.times.size()));
    }

    [[nodiscard]] Table activations() const {
        Table table{.title = report_.fit.status == activation::Status::converged
                                 ? "activation fitted to a target"
                                 : "activation fitted to a target: best found, not converged",
                    .columns = {report_.body}};
        const Curve curve = curve_of(report_.fit.coefficients);
        table.times = curve.times;
        for (const double value : curve.values) table.rows.push_back({value});
        return table;
    }
    [[nodiscard]] const History& best() const { return best_; }

private:
    void check_times() const {
        if (target_.times.front() < 0 || target_.times.back() > scene_.time.end)
            throw InputError(options_.target.string() + ": its times go from " +
                             rounded(target_.times.front()) + " to " +
                             rounded(target_.times.back()) + " s, but the scene from 0 to " +
                             rounded(scene_.time.end) + " s; cut it, or let the scene be longer");
    }

    // An error of this size counts 1.
    void find_sizes() {
        for (std::size_t q = 0; q < places_.size(); ++q) {
            double most = 0, least = 0;
            for (const auto& row : target_.rows) {
                most = std::max(most, row[q]);
                least = std::min(least, row[q]);
            }
            report_.most.push_back(std::max(most, -least));
            if (!(report_.most.back() > 0))
                throw InputError(options_.target.string() + ": '" + target_.columns[q] +
                                 "' is 0 at all times, so that there is nothing to follow");
            size_.push_back(options_.goal * report_.most.back());
        }
    }

    void describe() {
        report_.scene = options_.scene.string();
        report_.target = options_.target.string();
        report_.output = options_.output.string();
        report_.fingerprint = model_.fingerprint;
        report_.body = scene_.bodies[body_].name;
        report_.quantities = target_.columns;
        report_.begin = target_.times.front();
        report_.end = target_.times.back();
        report_.basis = basis_;
        for (const std::string& warning : report_.warnings) progress_.warn(warning);
    }

    // What the scene says at each spline's middle.
    [[nodiscard]] std::vector<double> first_guess() const {
        std::vector<double> coefficients;
        for (int i = 0; i < basis_.count(); ++i) {
            const double middle = basis_.begin + (i - 1) * basis_.spacing();
            const double value = contraction::value_at(
                scene_.bodies[body_].activation, std::clamp(middle, basis_.begin, basis_.end));
            coefficients.push_back(std::clamp(value, 0.0, 1.0));
        }
        return coefficients;
    }

    [[nodiscard]] Curve curve_of(const std::vector<double>& coefficients) const {
        Curve curve;
        const int count = static_cast<int>(std::ceil(basis_.end / kSample - 1e-9));
        for (int i = 0; i <= count; ++i) {
            const double time = std::min(basis_.end, i * kSample);
            const SplineBasis::Local local = basis_.at(time);
            double value = 0;
            for (std::size_t k = 0; k < local.value.size(); ++k)
                value += local.value[k] * coefficients[static_cast<std::size_t>(local.first) + k];
            curve.times.push_back(time);
            curve.values.push_back(std::clamp(value, 0.0, 1.0));
        }
        return curve;
    }

    activation::Evaluation evaluate(const std::vector<double>& coefficients) {
        scene_.bodies[body_].activation = curve_of(coefficients);
        const contraction::Trial trial = contraction::try_scene(scene_, model_, {}, progress_);
        if (trial.interrupted) progress_.check();
        activation::Evaluation told;
        told.message = trial.message;
        if (!trial.completed) return told;
        double squares = 0;
        for (std::size_t t = 0; t < target_.times.size(); ++t)
            for (std::size_t q = 0; q < places_.size(); ++q) {
                const double is = value_at(trial.history, places_[q], target_.times[t]);
                told.residuals.push_back((is - target_.rows[t][q]) / size_[q]);
                squares += told.residuals.back() * told.residuals.back();
            }
        if (best_.rows.empty() || squares < least_) {
            least_ = squares;
            best_ = trial.history;
        }
        return told;
    }

    const FitJobOptions& options_;
    FitReport& report_;
    ProgressSink& progress_;
    Scene scene_;
    contraction::Model model_;
    Table target_;
    std::size_t body_ = 0;
    std::vector<std::size_t> places_;  // of the quantities in the history
    std::vector<double> size_;         // of a quantity's usual error
    SplineBasis basis_;
    History best_;
    double least_ = 0;
};

}  // namespace

FitReport run_fit_job(const FitJobOptions& options, ProgressSink& progress) {
    const ThreadLimit limit(options.threads);
    FitReport report;
    OutputFolder out(options.output);
    Stopwatch watch;
    Fitter fitter(options, report, progress);
    fitter.prepare();
    report.seconds["preparation"] = watch.lap();
    fitter.fit();
    report.seconds["fit"] = watch.lap();
    report.peak_memory = peak_memory();
    report.processor_seconds = processor_seconds();
    if (report.fit.status != activation::Status::infeasible) {
        report.files = {"activation.sto", "history.csv"};
        out.write("activation.sto", [&](const fs::path& file) {
            skeleton::write_table(fitter.activations(), "from 0 to 1", file);
        });
        out.write("history.csv",
                  [&](const fs::path& file) { contraction::write_history(fitter.best(), file); });
    }
    report.files.emplace_back("report.json");
    out.write("report.json",
              [&](const fs::path& file) { write_atomically(file, to_json(report)); });
    out.keep();
    return report;
}

}  // namespace myotet::app
