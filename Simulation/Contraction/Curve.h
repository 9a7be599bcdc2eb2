// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "Muscle/ActivationDynamics.h"

namespace myotet::contraction {

/// A quantity over time: straight between its points, and before the first and
/// after the last as there.
struct Curve {
    std::vector<double> times;   ///< s, ascending; at least one
    std::vector<double> values;  ///< one a time
};

[[nodiscard]] inline Curve constant_curve(double value) { return {{0}, {value}}; }

/// Cost: O(log n).
[[nodiscard]] double value_at(const Curve& curve, double time);

/// Adds a point to an activation, which is a number from 0 to 1; one that
/// leaves this range by rounding (1e-6) is put back. Returns what is wrong with
/// the point, as the end of a sentence, or nothing when it was added.
[[nodiscard]] std::string add_activation(Curve& curve, double time, double value);

/// The longest excitation that follow() takes, s: 60 MB.
inline constexpr double kLongestExcitation = 3600;

/// The activation that an excitation leads to until `end`, s, with a point a millisecond:
/// solved exactly for the excitation at each millisecond's middle, an error of second order
/// in that time. It is 0 at time 0, or at the excitation's first point where that is before.
[[nodiscard]] Curve follow(const Curve& excitation, const muscle::ActivationDynamics& dynamics,
                           double end);

/// Reads an activation from a column of a table:
/// - .csv: a line of column names, then numbers; commas, semicolons or tabs.
///   The first column is the time, s.
/// - .sto, .mot (OpenSim): a header until `endheader`, a line of column names,
///   then numbers; tabs or spaces. The first column is `time`, s.
/// A column goes by its name, by the last part of its name without
/// `/activation` (`/forceset/biclong/activation` is `biclong`), or by its number
/// from 1, the time being 1. Other columns are not looked at.
/// Throws IoError when the file cannot be read, InputError with the line when
/// the column is not there or not the only one, a number is none or not finite,
/// times do not ascend, or rows are missing.
[[nodiscard]] Curve read_activation(const std::filesystem::path& file, const std::string& column);

}  // namespace myotet::contraction
