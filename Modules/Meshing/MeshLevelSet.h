// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "Core/Progress.h"
#include "Core/TetMesh.h"
#include "LevelSet/LevelSet.h"
#include "Meshing/Physics.h"
#include "Meshing/Select.h"

namespace myotet::meshing {

/// Longest edge allowed around a point of local coordinates, mm.
using SizingFunction = std::function<double(const Vec3&)>;

/// How a candidate's boundary is brought onto the surface [Teran05, sec. 7, 8].
enum class Compression {
    springs,       ///< as a body of edge and altitude springs
    fem,           ///< as a neo-Hookean body of finite elements
    optimization,  ///< node by node, for the shape of the elements
};

/// How a level set becomes tetrahedra.
struct Options {
    double edge_length = 0;           ///< target edge on the surface, mm; must be positive
    double interior_edge_length = 0;  ///< how coarse the inside may grow, mm; 0: 4x edge_length
    double smallest_edge_length =
        0;                        ///< how fine thin or curved parts may get, mm; 0: edge_length / 8
    double curvature_factor = 0;  ///< refine where edge > factor / (|k1| + |k2|); 0: off
    double thickness_factor = 1.0;  ///< refine where edge > factor * local thickness; 0: off
    int components = 1;             ///< connected pieces that phi < 0 has; 0: not known, keep all
    double volume = 0;              ///< volume that the mesh shall have, mm^3; 0: as phi says
    /// Refine where the finished surface is farther from phi = 0 than this part of
    /// the edge length, then select and compress again; 0: off.
    double distance_factor = 0.08;
    int distance_rounds = 3;  ///< times that this may be done
    /// Refine, twice at most, where a few elements of the finished mesh lie beyond this. A
    /// round costs half as much again as all before. Off with distance_factor, in drafts and
    /// by physics alone.
    double aspect_ratio = 4.2;
    /// Stop after the lattice fits when it has fewer or more tetrahedra than these;
    /// 0: no bound. The mesh is then valid but not finished.
    std::int64_t least_tets = 0, most_tets = 0;
    /// A uniform lattice without green tetrahedra: the edge length everywhere, nothing
    /// refined, and the surface's distance gives way to the worst elements.
    bool uniform = false;
    /// Fast: the promises are kept, the worst elements are not worked on.
    bool draft = false;
    /// In order, each beginning where the one before ended; physics first, once.
    std::vector<Compression> compression = {Compression::optimization};
    /// Other than repaired, of what mesh_level_set promises only positive tetrahedra are
    /// kept; the mesh may be in pieces.
    Topology topology = Topology::repaired;
    SizingFunction sizing = {};  ///< empty: none
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// The same options with what `uniform` and `draft` mean written into the others.
[[nodiscard]] Options spelled_out(Options options);

/// Where the time went and what was done on the way.
struct Summary {
    double edge_length = 0;  ///< lattice edge used at the surface, mm
    int levels = 0;          ///< red levels below the coarsest
    int selection_passes = 0;
    int distance_rounds = 0;  ///< times the lattice was refined for the surface distance
    int fault_rounds = 0;     ///< times it was refined at faults of the finished mesh
    std::int64_t candidate_tets = 0;
    bool out_of_bounds = false;           ///< stopped for Options::least_tets or most_tets
    std::vector<PhysicsSummary> physics;  ///< one for each compression by springs or elements
    double volume_offset = 0;             ///< isovalue that the surface was fitted to, mm
    double seconds_lattice = 0, seconds_select = 0, seconds_compress = 0;
    std::vector<std::string> notes;  ///< what a user should know, a sentence each
};

struct Result {
    TetMesh mesh;  ///< local coordinates, mm; labels empty
    Summary summary;
};

/// Meshes the inside of one connected level set: lattice, candidate,
/// compression [Teran05, sec. 3-6, 8]. The mesh is one component, positive,
/// its boundary a manifold, with no tetrahedron of four boundary nodes and no
/// interior edge between two boundary nodes.
/// Throws InputError (options), MeshError, ResourceError, Interrupted.
[[nodiscard]] Result mesh_level_set(const levelset::LevelSet& phi, const Options& asked,
                                    ProgressSink& progress);

/// About how many tetrahedra a call would make, from volume and surface alone.
[[nodiscard]] double forecast_tets(double volume, double area, const Options& options);

}  // namespace myotet::meshing
