// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "Core/TetMesh.h"
#include "Lattice/NodeMap.h"

namespace myotet::lattice {

/// What becomes of a red tetrahedron.
enum class Verdict : std::uint8_t { keep, refine, discard };

/// A red tetrahedron by its level (0 is the coarsest) and number there.
struct RedTet {
    std::int32_t level = 0;
    std::int32_t index = 0;
    bool operator==(const RedTet&) const = default;
};

/// A conforming set of tetrahedra over the lattice's nodes.
struct LatticeMesh {
    std::vector<Tet> tets;
    std::vector<RedTet> red;  ///< |T|: the red tetrahedron that each is or belongs to
};

/// A body-centred cubic lattice with red-green refinement [Teran05, sec. 3-4],
/// on exact integer coordinates, in units of a quarter of the finest cell.
///
/// A red tetrahedron (v0, v1, v2, v3) has its two long edges, of length a (the
/// cell of its level), at v0 v1 and v2 v3, and four short ones of length
/// sqrt(3)/2 a. Red refinement makes eight such tetrahedra of half the size;
/// the inner octahedron is cut along its shortest diagonal, which by this order
/// of nodes always joins the midpoints of the long edges. Green families close
/// the rest: one edge bisected, two opposite ones, or the three of one face;
/// any other pattern is completed to one of these or to a red refinement. Green
/// tetrahedra are never stored: mesh() derives them.
///
/// The node field (for the mesher: phi) is evaluated once at each node.
/// Everything is deterministic; only field evaluation runs on several threads.
class RedGreenLattice {
public:
    using Field = std::function<double(const Vec3&)>;

    /// Covers `box` with cells of size `coarsest_edge` (mm), leaving out
    /// tetrahedra whose four field values all exceed `outside` times the edge.
    /// Throws InputError when the edge is not positive, ResourceError when the
    /// coordinates or the number of cells leave the integers.
    RedGreenLattice(const Box& box, double coarsest_edge, int max_level, double outside,
                    Field field);

    [[nodiscard]] int max_level() const { return max_level_; }
    /// Long edge of a red tetrahedron of a level, mm.
    [[nodiscard]] double edge_length(int level) const;

    [[nodiscard]] std::size_t node_count() const { return coordinates_.size(); }
    [[nodiscard]] Vec3 position(std::int32_t node) const;
    [[nodiscard]] const std::vector<float>& values() const { return values_; }

    /// Red tetrahedra of a level, refined and discarded ones included.
    [[nodiscard]] const std::vector<Tet>& tets(int level) const { return levels_[level].tets; }
    [[nodiscard]] bool is_leaf(RedTet t) const {
        return levels_[t.level].state[t.index] == State::leaf;
    }

    /// Carries out one verdict per tetrahedron of `level`, from number
    /// `first` on; those of non-leaves are passed over. Tetrahedra of the
    /// finest level are kept instead of refined.
    void apply(int level, std::span<const Verdict> verdicts, std::size_t first = 0);
    /// Refines the leaves among these; returns how many were refined.
    std::size_t refine(std::span<const RedTet> tets);
    /// Adds midpoints and refinements until the green patterns conform.
    /// Returns the number of tetrahedra that had to be refined. Only a coarser
    /// tetrahedron is ever forced to refine, so the finest level is never passed.
    std::size_t close();

    /// The conforming mesh: leaves without midpoints, and green families.
    [[nodiscard]] LatticeMesh mesh() const;

private:
    enum class State : std::uint8_t { leaf, refined, discarded };
    struct Level {
        std::vector<Tet> tets;
        std::vector<State> state;
    };

    void cover(double outside);
    void add_tet(int level, const Tet& t);
    std::int32_t node_at(const Index3& c);
    std::int32_t midpoint(std::int32_t a, std::int32_t b);
    [[nodiscard]] std::int32_t find_midpoint(std::int32_t a, std::int32_t b) const;
    void refine_one(RedTet t);
    void evaluate_new_nodes();
    [[nodiscard]] unsigned bisected_edges(const Tet& t, std::array<std::int32_t, 6>& mids) const;
    [[nodiscard]] bool neighbour_too_fine(const Tet& t,
                                          const std::array<std::int32_t, 6>& mids) const;

    Box box_;
    double coarsest_edge_;
    int max_level_;
    Field field_;
    Vec3 origin_;
    double unit_;
    Index3 cells_{0, 0, 0};
    std::vector<Index3> coordinates_;
    std::vector<float> values_;
    std::vector<std::array<std::int32_t, 2>> ends_;  // of the edge a node bisects, or -1
    std::vector<char> touched_;  // nodes near edges bisected since the last sweep
    std::vector<Level> levels_;
    NodeMap map_;
};

}  // namespace myotet::lattice
