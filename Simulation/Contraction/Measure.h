// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Contraction/Solve.h"
#include "Contraction/TimeSeries.h"
#include "MeshFiles/MeshFiles.h"

namespace myotet::contraction {

/// What a muscle's geometry lets expect of it.
struct Architecture {
    double volume = 0;        ///< of its contractile tetrahedra, mm^3
    double fibre_length = 0;  ///< mean of the lines of the Laplace field through them, mm
    double pcsa = 0;          ///< physiological cross-section, volume / fibre_length, mm^2
    double force = 0;         ///< sigma_max * pcsa: what it pulls fully active, N
};

/// Of each body; zeros where it has no muscle, or not an origin and an insertion. With the
/// Laplace field phi, the mean over its flux lines of their length within the muscle is
///   integral over the muscle of |grad phi| / integral over the body of |grad phi|^2.
[[nodiscard]] std::vector<Architecture> architecture(const Scene& scene, const Model& model);

/// Columns of a history: time, then of each body its activation, volume, mean fibre stretch,
/// worst aspect ratio and smallest det F, its length (from the middle of its origin to that
/// of its insertion, where it has both), then of each attachment the force with which the
/// body pulls there and its moment about the attachment's middle, of each contact
/// the sum of its forces, its area and how deep it sinks in beyond its gap, then the step's
/// iterations of Newton's method.
[[nodiscard]] std::vector<Column> history_columns(const Scene& scene, const Model& model);

/// A row of them at the present time.
[[nodiscard]] std::vector<double> history_row(const Scene& scene, const Model& model,
                                              const Simulation& simulation, int iterations);

/// All bodies in one mesh, where their nodes are now, and arrays: at nodes `displacement`,
/// mm; at tetrahedra `body` (from 0), `activation`, `fiber` (unit, where it is now; zero
/// without fibres), `fiber_stretch`, `J`, `cauchy_stress` (MPa, 9 components).
struct Moment {
    TetMesh mesh;
    std::map<std::int32_t, std::string> names;
    meshfiles::MeshArrays arrays;
};
[[nodiscard]] Moment make_frame(const Model& model, const Simulation& simulation);

}  // namespace myotet::contraction
