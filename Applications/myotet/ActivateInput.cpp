// SPDX-License-Identifier: Apache-2.0
#include "ActivateInput.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "Contraction/KeyFrames.h"
#include "Core/Text.h"
#include "ExitCodes.h"
#include "Skeleton/ReadOsim.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

using skeleton::Model;
using skeleton::Table;

constexpr double kKeyFrameStep = 0.01;  // s
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string in_its_unit(const skeleton::Coordinate& coordinate, double value) {
    return coordinate.rotational ? rounded(value / kDegree) + " degrees" : rounded(value) + " mm";
}

void leave_out_disabled(Model& model, std::vector<std::string>& notes) {
    std::vector<std::string> disabled;
    std::erase_if(model.muscles, [&](const skeleton::Muscle& muscle) {
        if (muscle.disabled) disabled.push_back(muscle.name);
        return muscle.disabled;
    });
    if (!disabled.empty()) notes.push_back("disabled muscles are left out: " + list_of(disabled));
}

void tell_excursions(const Model& model, const skeleton::Trajectory& trajectory,
                     std::vector<std::string>& warnings) {
    for (const skeleton::Excursion& out : trajectory.excursions) {
        const skeleton::Coordinate& coordinate = model.coordinates[out.coordinate];
        warnings.push_back("the motion takes " + coordinate.name + " to " +
                           in_its_unit(coordinate, out.value) + " at " + rounded(out.time) +
                           " s, " + in_its_unit(coordinate, out.beyond) +
                           " beyond the range that the model gives it");
    }
}

std::vector<double> times_of(const ActivateJobOptions& options,
                             const skeleton::Trajectory& trajectory) {
    const bool part = options.to > options.from;
    const double first = part ? options.from : trajectory.times.front(),
                 last = part ? options.to : trajectory.times.back();
    if (first < trajectory.times.front() || last > trajectory.times.back())
        throw InputError(options.motion.string() + ": the motion lies between " +
                         rounded(trajectory.times.front()) + " and " +
                         rounded(trajectory.times.back()) + " s, but " + rounded(first) + " to " +
                         rounded(last) + " s is asked for");
    std::vector<double> times;
    const double step = options.step > 0 ? options.step : trajectory.at_rest ? kKeyFrameStep : 0;
    if (step == 0) {
        for (const double time : trajectory.times)
            if (time >= first && time <= last) times.push_back(time);
        return times;
    }
    const auto count = static_cast<std::size_t>(std::floor((last - first) / step + 1e-9));
    for (std::size_t i = 0; i <= count; ++i)
        times.push_back(std::min(last, first + static_cast<double>(i) * step));
    return times;
}

// A column a muscle, by its name and an ending; muscles without one have none.
activation::MuscleTable muscle_table(const Table& table, const Model& model,
                                     const std::string& ending, bool& any) {
    activation::MuscleTable made;
    std::vector<int> column;
    for (const skeleton::Muscle& muscle : model.muscles) {
        column.push_back(skeleton::find_column(table, muscle.name + ending));
        any = any || column.back() >= 0;
    }
    made.times = table.times;
    for (const auto& row : table.rows) {
        std::vector<double> values;
        for (const int c : column)
            values.push_back(c < 0 ? kNone : row[static_cast<std::size_t>(c)]);
        made.rows.push_back(std::move(values));
    }
    return made;
}

void check_activations(const activation::MuscleTable& table, const Model& model,
                       const fs::path& file) {
    for (std::size_t t = 0; t < table.rows.size(); ++t)
        for (std::size_t m = 0; m < table.rows[t].size(); ++m)
            if (table.rows[t][m] < 0 || table.rows[t][m] > 1)
                throw InputError(file.string() + ": " + model.muscles[m].name + " is " +
                                 rounded(table.rows[t][m]) + " at " + rounded(table.times[t]) +
                                 " s, but activations are from 0 to 1; divide it by its most");
}

void read_bounds(const ActivateJobOptions& options, const Model& model,
                 activation::SharingOptions& sharing) {
    if (options.bounds.empty()) return;
    const Table table = skeleton::read_table(options.bounds);
    bool any = false;
    sharing.lowest = muscle_table(table, model, "_min", any);
    sharing.highest = muscle_table(table, model, "_max", any);
    if (!any)
        throw InputError(options.bounds.string() +
                         ": no column bounds a muscle of the model; name columns after muscles, "
                         "such as " +
                         model.muscles.front().name + "_min and " + model.muscles.front().name +
                         "_max");
    check_activations(sharing.lowest, model, options.bounds);
    check_activations(sharing.highest, model, options.bounds);
    for (std::size_t t = 0; t < table.rows.size(); ++t)
        for (std::size_t m = 0; m < model.muscles.size(); ++m)
            if (sharing.lowest.rows[t][m] > sharing.highest.rows[t][m])
                throw InputError(options.bounds.string() + ": the least activation of " +
                                 model.muscles[m].name + " is above its most at " +
                                 rounded(table.times[t]) + " s");
}

void read_emg(const ActivateJobOptions& options, const Model& model,
              activation::SharingOptions& sharing) {
    if (options.emg.empty()) return;
    bool any = false;
    sharing.measured = muscle_table(skeleton::read_table(options.emg), model, "", any);
    if (!any)
        throw InputError(options.emg.string() +
                         ": no column has the name of a muscle of the model, such as " +
                         model.muscles.front().name);
    check_activations(sharing.measured, model, options.emg);
    sharing.distribution.tracking = options.tracking;
}

double strength_in(const std::string& word, const std::string& text) {
    const auto strength = to_number(text);
    if (!strength || !(*strength > 0) || !std::isfinite(*strength))
        throw UsageError("--reserves: '" + word +
                         "' names no strength above 0; write NAME=STRENGTH or STRENGTH, in N mm "
                         "for angles and N for lengths");
    return *strength;
}

// Rows are synergies, numbered in the first column; columns are muscles' shares in them.
void read_synergies(const ActivateJobOptions& options, Model& model,
                    activation::SharingOptions& sharing) {
    if (options.synergies.empty()) return;
    bool any = false;
    const activation::MuscleTable table =
        muscle_table(skeleton::read_table(options.synergies), model, "", any);
    if (!any)
        throw InputError(options.synergies.string() +
                         ": no column has the name of a muscle of the model, such as " +
                         model.muscles.front().name);
    Eigen::MatrixXd& shares = sharing.distribution.synergies;
    shares.setZero(static_cast<Eigen::Index>(model.muscles.size()),
                   static_cast<Eigen::Index>(table.rows.size()));
    for (Eigen::Index s = 0; s < shares.cols(); ++s)
        for (Eigen::Index m = 0; m < shares.rows(); ++m) {
            const double share =
                table.rows[static_cast<std::size_t>(s)][static_cast<std::size_t>(m)];
            if (share < 0)
                throw InputError(options.synergies.string() + ": " +
                                 model.muscles[static_cast<std::size_t>(m)].name + " has " +
                                 rounded(share) + " in synergy " + std::to_string(s + 1) +
                                 ", but shares are not negative");
            if (!std::isnan(share)) shares(m, s) = share;
        }
    // What no synergy drives is relaxed, and so may be the others.
    for (skeleton::Muscle& muscle : model.muscles) muscle.lowest_activation = 0;
}

std::size_t coordinate_of(const Model& model, const std::string& name, const std::string& option) {
    std::vector<std::string> known;
    for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
        known.push_back(model.coordinates[c].name);
        if (known.back() == name) return c;
    }
    throw UsageError(option + ": the model has no coordinate '" + name + "'; it has " +
                     list_of(known));
}

std::vector<double> read_reserves(const std::vector<std::string>& words, const Model& model) {
    std::vector<double> strength(model.coordinates.size(), 0);
    for (const std::string& word : words) {
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos) {
            strength.assign(strength.size(), strength_in(word, word));
            continue;
        }
        const std::size_t c = coordinate_of(model, word.substr(0, equals), "--reserves");
        strength[c] = strength_in(word, word.substr(equals + 1));
    }
    return strength;
}

}  // namespace

ActivateInput read_activate_input(const ActivateJobOptions& options) {
    ActivateInput input;
    input.model = skeleton::read_osim(options.model);
    input.warnings = input.model.notes;
    leave_out_disabled(input.model, input.notes);
    if (input.model.muscles.empty())
        throw InputError(options.model.string() + ": has no muscle that could be activated");

    contraction::MotionRows rows = contraction::read_motion_rows(options.motion);
    if (options.cutoff_hz > 0 && contraction::is_key_frames(options.motion))
        throw UsageError("--cutoff filters measured motion; key frames are smooth by themselves");
    rows.smooth.cutoff_hz = options.cutoff_hz;
    input.trajectory = contraction::trajectory_of(rows, input.model, options.motion);
    input.notes.insert(input.notes.end(), input.trajectory.notes.begin(),
                       input.trajectory.notes.end());
    tell_excursions(input.model, input.trajectory, input.warnings);
    input.times = times_of(options, input.trajectory);

    activation::SharingOptions& sharing = input.sharing;
    sharing.distribution.criterion = options.criterion;
    sharing.distribution.exponent = options.exponent;
    sharing.distribution.reserves = read_reserves(options.reserves, input.model);
    sharing.held.assign(input.model.coordinates.size(), false);
    for (const std::string& name : options.held)
        sharing.held[coordinate_of(input.model, name, "--hold")] = true;
    sharing.tendons = options.tendons;
    sharing.passive = options.passive;
    sharing.force_velocity = !options.still;
    read_bounds(options, input.model, sharing);
    read_emg(options, input.model, sharing);
    read_synergies(options, input.model, sharing);
    return input;
}

}  // namespace myotet::app
