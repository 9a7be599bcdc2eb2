// SPDX-License-Identifier: Apache-2.0
#include "Meshing/Select.h"

#include <algorithm>

#include "Core/Errors.h"
#include "Meshing/Selection.h"

namespace myotet::meshing {
namespace {

using lattice::RedGreenLattice;
using lattice::RedTet;

// Nodes with three faces are only wished away: enveloping one may make others,
// so the wish is heard in the first rounds and then given up.
constexpr int kWishRounds = 3;

// Red tetrahedra that hold a troubled edge, or any edge at a troubled or left-out
// node.
std::vector<RedTet> reds_at(const Selection& selection, const lattice::LatticeMesh& mesh,
                            const Trouble& trouble) {
    std::vector<char> node(selection.node_count(), 0);
    for (const std::int32_t n : trouble.nodes) node[n] = 1;
    for (const std::int32_t n : trouble.left_out) node[n] = 2;
    std::vector<RedTet> reds;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const Tet& tet = mesh.tets[t];
        bool hit = false;
        for (int i = 0; i < 4 && !hit; ++i) {
            hit = node[tet[i]] == 2 || (node[tet[i]] == 1 && selection.in_mesh(t));
            for (int j = i + 1; j < 4 && !hit; ++j)
                hit = selection.in_mesh(t) && trouble.holds_edge(tet[i], tet[j]);
        }
        if (hit) reds.push_back(mesh.red[t]);
    }
    return reds;
}

Candidate compact(const RedGreenLattice& lattice, const Selection& selection,
                  const lattice::LatticeMesh& mesh) {
    Candidate c;
    std::vector<std::int32_t> number(lattice.node_count(), -1);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        if (!selection.in_mesh(t)) continue;
        Tet tet = mesh.tets[t];
        for (std::int32_t& n : tet) {
            if (number[n] < 0) {
                number[n] = static_cast<std::int32_t>(c.mesh.points.size());
                c.mesh.points.push_back(lattice.position(n));
            }
            n = number[n];
        }
        c.mesh.tets.push_back(tet);
        c.red.push_back(mesh.red[t]);
    }
    return c;
}

}  // namespace

Candidate select_candidate(RedGreenLattice& lattice, const SelectOptions& options,
                           ProgressSink& progress) {
    int passes = 0;
    for (int pass = 0;; ++pass) {
        progress.check();
        const lattice::LatticeMesh mesh = lattice.mesh();
        Selection selection(mesh.tets, lattice.values(),
                            [&](std::int32_t n) { return lattice.position(n); });
        if (options.topology == Topology::inside)
            selection.select_inside();
        else
            selection.envelop_inside();
        ++passes;
        if (options.topology != Topology::repaired) {
            Candidate c = compact(lattice, selection, mesh);
            c.passes = passes;
            return c;
        }
        if (pass < options.refinement_passes) {
            // First pass of the paper: bisect what is wrong, select anew.
            const Trouble trouble = selection.examine(false);
            if (!trouble.empty()) {
                const std::vector<RedTet> reds = reds_at(selection, mesh, trouble);
                if (lattice.refine(reds) > 0) {
                    lattice.close();
                    continue;
                }
            }
        }
        // Later passes: envelop more nodes. Every node is added at most once, so
        // this ends.
        std::size_t added = 0, bridges = 0;
        for (int round = 0;; ++round) {
            ++passes;
            progress.check();
            const Trouble trouble =
                selection.examine(options.avoid_three_faces && round < kWishRounds);
            if (!trouble.empty()) {
                const std::size_t more = selection.envelop(trouble);
                added += more;
                if (more > 0) continue;
                if (!trouble.only_wishes)
                    throw MeshError(
                        "the candidate's topology cannot be repaired inside the lattice; ask "
                        "for a shorter edge length");
            }
            if (!selection.join_pieces(options.components)) break;
            ++bridges;
        }
        Candidate c = compact(lattice, selection, mesh);
        c.passes = passes;
        c.nodes_added = added;
        c.bridges = bridges;
        return c;
    }
}

}  // namespace myotet::meshing
