// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Trajectory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Core/Errors.h"
#include "Core/Text.h"
#include "Skeleton/LowPass.h"

namespace myotet::skeleton {
namespace {

constexpr double kMillimetres = 1000;

/// Times as many as values.
struct Samples {
    std::vector<double> times, values;
};

/// A coordinate's values in the table's rows, rad or mm.
std::vector<double> column(const Table& table, int at, const Coordinate& coordinate) {
    const double unit = !coordinate.rotational ? kMillimetres
                        : table.in_degrees     ? std::numbers::pi / 180
                                               : 1;
    std::vector<double> values;
    values.reserve(table.rows.size());
    for (const auto& row : table.rows) values.push_back(unit * row[static_cast<std::size_t>(at)]);
    return values;
}

/// At equal distances, the shortest that two samples have.
Samples resampled(const Samples& samples) {
    const auto& t = samples.times;
    double shortest = t[1] - t[0], longest = shortest;
    for (std::size_t i = 2; i < t.size(); ++i) {
        shortest = std::min(shortest, t[i] - t[i - 1]);
        longest = std::max(longest, t[i] - t[i - 1]);
    }
    // Times are written with about six digits; no filter notices more.
    constexpr double kEqual = 1e-4;
    if (longest <= (1 + kEqual) * shortest) return samples;
    constexpr double kMostSamples = 1e6;
    const double count = std::floor((t.back() - t.front()) / shortest * (1 + 1e-12)) + 1;
    if (!(count <= kMostSamples))
        throw InputError("the motion's rows stand " + shown(shortest) + " s to " + shown(longest) +
                         " s apart, so that it cannot be filtered; give rows at equal times");
    const Spline spline = spline_through(t, samples.values, 5, SplineEnds::natural);
    Samples even;
    for (double i = 0; i < count; ++i) {
        even.times.push_back(t.front() + i * shortest);
        even.values.push_back(evaluate(spline, even.times.back()).value);
    }
    return even;
}

/// Filtered, and continued at both ends, so that a spline's ends are far away.
Samples filtered(const Samples& samples, double cutoff_hz) {
    if (samples.times.size() < 4)
        throw InputError("a motion of " + std::to_string(samples.times.size()) +
                         " rows cannot be filtered; give at least 4, or set no cutoff");
    const Samples even = resampled(samples);
    const std::size_t n = even.times.size();
    LowPass low_pass;
    low_pass.cutoff_hz = cutoff_hz;
    low_pass.dt = (even.times.back() - even.times.front()) / static_cast<double>(n - 1);
    low_pass.padding = n / 2;
    Samples out;
    out.values = filter(low_pass, even.values);
    for (std::size_t i = 0; i < out.values.size(); ++i)
        out.times.push_back(even.times.front() +
                            (static_cast<double>(i) - static_cast<double>(low_pass.padding)) *
                                low_pass.dt);
    return out;
}

std::variant<Spline, Function> course(const Samples& samples, const TrajectoryOptions& options) {
    if (samples.times.size() == 1) return constant_function(samples.values[0]);
    const Samples smooth = options.cutoff_hz > 0 ? filtered(samples, options.cutoff_hz) : samples;
    return spline_through(smooth.times, smooth.values, options.degree, options.ends);
}

FunctionValue value_of(const std::variant<Spline, Function>& course, double time) {
    return std::visit([&](const auto& f) { return evaluate(f, time); }, course);
}

void find_excursions(const Model& model, Trajectory& trajectory) {
    constexpr double kRounding = 1e-6;  // rad, mm: ranges are written with as many digits
    for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
        Excursion farthest;
        farthest.beyond = kRounding;
        for (const double time : trajectory.times) {
            const double value = value_of(trajectory.coordinates[c], time).value;
            const double beyond =
                std::max(model.coordinates[c].lowest - value, value - model.coordinates[c].highest);
            if (beyond > farthest.beyond) farthest = {static_cast<int>(c), time, value, beyond};
        }
        if (farthest.beyond > kRounding) trajectory.excursions.push_back(farthest);
    }
}

void note(Trajectory& trajectory, const std::vector<std::string>& names, const char* what) {
    if (!names.empty()) trajectory.notes.push_back(what + list_of(names));
}

}  // namespace

void TrajectoryOptions::validate() const {
    if (!(cutoff_hz >= 0) || !std::isfinite(cutoff_hz))
        throw InputError("cutoff_hz is " + shown(cutoff_hz) + ", but must be at least 0");
    if (degree != 3 && degree != 5)
        throw InputError("degree is " + std::to_string(degree) + ", but must be 3 or 5");
    if (cutoff_hz > 0 && ends == SplineEnds::at_rest)
        throw InputError(
            "a motion that is filtered does not end at rest where its rows do; leave cutoff_hz 0 "
            "or "
            "take natural ends");
}

Trajectory make_trajectory(const Table& table, const Model& model,
                           const TrajectoryOptions& options) {
    options.validate();
    Trajectory trajectory;
    trajectory.times = table.times;
    trajectory.at_rest = options.ends == SplineEnds::at_rest || table.times.size() == 1;
    std::vector<bool> used(table.columns.size(), false);
    std::vector<std::string> untold, unlocked, known;
    for (const Coordinate& coordinate : model.coordinates) {
        known.push_back(coordinate.name);
        const int at = find_column(table, coordinate.name);
        if (at < 0) {
            trajectory.coordinates.push_back(
                coordinate.prescribed.value_or(constant_function(coordinate.at_rest)));
            if (!coordinate.prescribed) untold.push_back(coordinate.name);
            continue;
        }
        used[static_cast<std::size_t>(at)] = true;
        const Samples samples{table.times, column(table, at, coordinate)};
        constexpr double kStill = 1e-6;  // rad, mm
        const auto moves = [&](double v) { return !(std::abs(v - coordinate.at_rest) <= kStill); };
        if (coordinate.locked && std::ranges::any_of(samples.values, moves))
            unlocked.push_back(coordinate.name);
        trajectory.coordinates.push_back(course(samples, options));
    }
    if (std::ranges::find(used, true) == used.end())
        throw InputError("no column of the motion is a coordinate of the model; name its columns " +
                         list_of(known));
    std::vector<std::string> unused;
    for (std::size_t c = 0; c < used.size(); ++c)
        if (!used[c]) unused.push_back(table.columns[c]);
    note(trajectory, untold,
         "the motion does not tell these coordinates, which keep their default: ");
    note(trajectory, unlocked, "the motion moves these coordinates, which the model locks: ");
    note(trajectory, unused, "these columns of the motion are no coordinates of the model: ");
    find_excursions(model, trajectory);
    return trajectory;
}

Instant at(const Trajectory& trajectory, double time) {
    const double first = trajectory.times.front(), last = trajectory.times.back();
    const bool held = trajectory.at_rest && (time < first || time > last);
    Instant instant;
    for (const auto& course : trajectory.coordinates) {
        const FunctionValue f = value_of(course, std::clamp(time, first, last));
        instant.values.push_back(f.value);
        instant.speeds.push_back(held ? 0 : f.slope);
        instant.accelerations.push_back(held ? 0 : f.bend);
    }
    return instant;
}

}  // namespace myotet::skeleton
