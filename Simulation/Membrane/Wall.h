// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Membrane/Levels.h"

namespace myotet::membrane {

/// How springs of finer levels are as stiff as those of the given surface.
enum class Stiffening {
    same_modulus,  ///< the same constant: a lattice of springs then keeps its modulus
    by_mass,       ///< [Choi05, eq. 8]: 2^l times the ratio of unit masses, about half a level
};

/// What a hollow organ's wall is made of.
struct Wall {
    double thickness = 3;        ///< mm
    double young = 0.03;         ///< MPa; soft, as stomach
    double density = 1.05e-9;    ///< t/mm^3; muscle
    double damping_time = 1e-4;  ///< damping over stiffness of springs, s
    /// Of shape-preserving springs, per area of the wall, MPa/mm; 0: none.
    double shape_stiffness = 1e-4;
    double shape_damping_time = 1e-2;  ///< their damping over their stiffness, s
    double drag = 5;                   ///< force against velocity over mass, 1/s
    /// Of the wall against itself where it faced itself at rest, pressure over depth,
    /// MPa/mm; 0: it passes through itself, and no time goes into looking.
    double contact_stiffness = 0;
    Stiffening stiffening = Stiffening::same_modulus;

    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// Area of the wall that a tonne of it has, mm^2/t.
[[nodiscard]] inline double area_of_mass(const Wall& wall) {
    return 1 / (wall.thickness * wall.density);
}

/// What all nodes and springs of one level have.
struct LevelProperties {
    double mass = 0;       ///< of a node, t
    double stiffness = 0;  ///< of a spring between two triangles, N/mm
    double damping = 0;    ///< of a spring, N s/mm
};

/// A level each. The total mass is area, thickness and density of the given
/// surface; a node has its share, M_refine = sum M_coarse / N_refine
/// [Choi05, eq. 6]. A triangular lattice of springs k has Young's modulus
/// 2 k / sqrt(3) per thickness and Poisson's ratio 1/3, so
/// k = sqrt(3)/2 E thickness on every level, or from there by [Choi05, eq. 8];
/// damping follows stiffness.
[[nodiscard]] std::vector<LevelProperties> level_properties(const Levels& levels, const Wall& wall);

/// Area of a surface, mm^2.
[[nodiscard]] double area(const TriMesh& surface);

}  // namespace myotet::membrane
