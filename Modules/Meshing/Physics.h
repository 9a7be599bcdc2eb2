// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "Core/Progress.h"
#include "Core/TetMesh.h"
#include "LevelSet/LevelSet.h"

namespace myotet::meshing {

/// What the mesh is made of while it is compressed.
enum class Material {
    springs,   ///< along edges and altitudes [Teran05, sec. 7.1]
    elements,  ///< neo-Hookean linear tetrahedra [Teran05, sec. 7.2]
};

struct PhysicsOptions {
    Material material = Material::elements;
    double isovalue = 0;  ///< the surface is phi = isovalue, mm
    /// Poisson's ratio of elements: compressible, so that shapes rather than
    /// volumes are kept.
    double poisson = 0.2;
    /// Of the critical damping: quick to rest, without oscillation.
    double damping_ratio = 0.7;
    /// Stiffness of the pull on boundary nodes beside that of an edge.
    double pull = 2;
    /// Steps with forces, and with velocities, at most.
    int force_steps = 120, velocity_steps = 80;
    /// Ends when no boundary node is farther from the surface than this part of
    /// the median boundary edge.
    double tolerance = 0.01;
};

/// How a compression ended.
struct PhysicsSummary {
    std::string status = "not run";  ///< "surface fits", "stopped improving", "out of steps"
    int force_steps = 0, velocity_steps = 0;
    int halvings = 0;          ///< of the time step, where an element would have inverted
    double mean_distance = 0;  ///< of boundary nodes, in median boundary edges
    double max_distance = 0;
};

/// Physics-based compression [Teran05, sec. 7]: the candidate is the rest shape of
/// an elastic body whose boundary nodes are first pulled, then moved, along
/// their mean face normals in proportion to phi; tangential motion is free.
/// Strain of altitudes is limited to 50 %, its rate to 10 % a step. The mesh
/// must be positive and stays so: no element is pressed below 15 % of its volume.
///
/// Time is fictitious: nodes get the masses with which sound crosses every
/// element in the same time, so that small elements do not shorten the step.
/// Cost: about 2 us a tetrahedron and step. Same bytes on any number of threads.
/// Throws Interrupted.
PhysicsSummary compress_by_physics(TetMesh& mesh, const levelset::LevelSet& phi,
                                   const PhysicsOptions& options, ProgressSink& progress);

}  // namespace myotet::meshing
