// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "Skeleton/Model.h"
#include "Skeleton/Spline.h"
#include "Skeleton/Table.h"

namespace myotet::skeleton {

struct TrajectoryOptions {
    /// Motion that is faster is filtered out, forwards and backwards by a Butterworth filter of
    /// third order; 0: none. Measured motion needs it, 6 Hz being usual for gait: noise
    /// grows with the square of its frequency in accelerations.
    double cutoff_hz = 0;
    int degree = 5;  ///< of the splines, 3 or 5; accelerations are smooth with 5
    SplineEnds ends = SplineEnds::natural;

    void validate() const;
};

/// For postures set by hand. The splines begin and end at rest, for a motion that begins from
/// a held posture has no speed there: with natural ends it would start with a jerk, and
/// inertia with a force that no muscle can follow. Cubic, since of all motions through the
/// frames these need the least acceleration, and swing least beyond the frames.
[[nodiscard]] inline TrajectoryOptions key_framed() {
    return {.degree = 3, .ends = SplineEnds::at_rest};
}

/// The farthest that a coordinate goes out of its range.
struct Excursion {
    int coordinate = 0;
    double time = 0;    ///< s
    double value = 0;   ///< rad or mm
    double beyond = 0;  ///< by how much, rad or mm
};

/// The motion of a model's coordinates.
struct Trajectory {
    std::vector<double> times;  ///< of the table's rows, s; the motion lies between them
    /// One a coordinate: of the time. Functions are what the table does not tell.
    std::vector<std::variant<Spline, Function>> coordinates;
    bool at_rest = false;               ///< before and after, it is held as it begins and ends
    std::vector<Excursion> excursions;  ///< at the rows; the caller says what they mean
    /// A sentence for a column that is no coordinate's, for coordinates that the table does
    /// not tell and for locked ones that it moves.
    std::vector<std::string> notes;
};

/// The motion of a table whose columns are coordinates of the model (find_column): angles in
/// rad, or degrees when the table says so, lengths in m. Coordinates that it does not tell
/// follow their prescribed function or keep their default; a single row is held. Locked
/// coordinates move as the table says. To filter, rows that do not stand at equal times are
/// first taken at the shortest distance of two of them, from a spline, and each end is
/// continued by half the rows, turned about its point.
/// Throws InputError when no column is a coordinate's, two columns are one coordinate's, the
/// cutoff is not below half the rows' frequency, or there are too few rows (4 to filter, 3
/// for degree 5 with natural ends).
[[nodiscard]] Trajectory make_trajectory(const Table& table, const Model& model,
                                         const TrajectoryOptions& options);

/// Values (rad, mm), speeds and accelerations of the coordinates at a time.
struct Instant {
    std::vector<double> values, speeds, accelerations;
};

/// Before the first and after the last time: the trajectory there, held when it is at rest.
[[nodiscard]] Instant at(const Trajectory& trajectory, double time);

}  // namespace myotet::skeleton
