// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "Core/Progress.h"
#include "Membrane/Contact.h"
#include "Membrane/Criteria.h"

namespace myotet::membrane {

enum class Detail {
    coarse,    ///< the given surface all the time
    refined,   ///< the finest level all the time
    adaptive,  ///< starts as given; refined and simplified by the criteria
};

struct Options {
    Wall wall;
    Criteria criteria;
    int levels = 1;  ///< of refinement
    Detail detail = Detail::adaptive;
    double duration = 1;     ///< s
    double interval = 0.01;  ///< between two moments of the history, s
    /// Part of the largest stable step that is taken.
    double safety = 0.8;
    /// A stable step must be at least this, s; below, the wall is too stiff or too
    /// light for an explicit method.
    double smallest_step = 1e-7;

    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// A line of the history.
struct Moment {
    double time = 0;                         ///< s
    std::vector<double> patch_displacement;  ///< a patch: mean by shares of the force, mm
    std::vector<Touch> tools;                ///< a tool: where it is, and what it touches
    double largest_displacement = 0;         ///< of a node in use, mm
    double volume = 0;                       ///< of a closed cavity, mm^3
    double pressure = 0;                     ///< of the cavity, MPa
    double mass = 0;                         ///< t
    double energy = 0;                       ///< N mm
    std::size_t nodes = 0, springs = 0;      ///< in use
};

enum class Status {
    finished,
    unstable,  ///< energy came from nowhere even at the smallest step tried
    sunk,      ///< a tool driven by forces found no resistance; see place_of
};

struct Result {
    Status status = Status::finished;
    std::string message;
    std::vector<Moment> history;
    TriMesh final_surface;  ///< as drawn; points of all levels, those not in use at rest
    std::int64_t steps = 0, evaluations = 0, rejected = 0;
    std::int64_t spring_evaluations = 0;  ///< springs summed over force evaluations
    std::int64_t switches = 0;            ///< looks after which triangles changed
    /// Energy that switches changed, sum of magnitudes, N mm.
    double switched_energy = 0;
};

/// A moment with all that there is then; for the call alone.
struct View {
    const Moment& moment;
    const Body& body;          ///< levels, nodes in use, triangles as drawn
    const Motion& motion;      ///< points of the finest level
    const NodeForces& forces;  ///< at the same points
};

/// Receives each moment of the history.
using Observer = std::function<void(const View&)>;

/// A hollow organ, a surface of springs, under loads [Choi05]: fourth-order
/// Runge-Kutta, the step halved with every level in use [Choi05, eq. 9].
///
/// Energy watch: after each step, energy that loads have not brought and that is
/// more than a hundredth of the most there was makes the step be done again in
/// halves; when ten halvings do not help the run ends as `unstable`.
///
/// The same bytes each time; one thread. Throws InputError (surface, options,
/// loads, a wall so stiff that the stable step is below the smallest),
/// Interrupted.
[[nodiscard]] Result simulate(const TriMesh& surface, const Options& options, const Loads& loads,
                              ProgressSink& progress, const Observer& observer = {});

/// The same with levels at hand: options.levels is not looked at.
[[nodiscard]] Result simulate(Levels levels, const Options& options, const Loads& loads,
                              ProgressSink& progress, const Observer& observer = {});

}  // namespace myotet::membrane
