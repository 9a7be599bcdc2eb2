// SPDX-License-Identifier: Apache-2.0
#include "Fibres/Laplace.h"

#include <Eigen/Sparse>
#include <algorithm>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Elasticity/LinearTet.h"
#include "Fibres/Gaps.h"

namespace myotet::fibres {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr std::size_t kGrain = 4096;
// Of the residual: dead ends, where the gradient is small, need the digits.
constexpr double kTolerance = 1e-13;
constexpr int kMostIterations = 20000;
// A gradient below this share of the mean one is what solving leaves.
constexpr double kVanishing = 1e-8;

// Marks of nodes.
constexpr std::int32_t kUnused = -1, kOrigin = -2, kInsertion = -3;

void mark(std::span<const std::int32_t> nodes, std::int32_t as, const char* set,
          std::vector<std::int32_t>& number) {
    if (nodes.empty())
        throw InputError(std::string("the ") + set + " has no nodes; name at least one");
    for (const std::int32_t node : nodes) {
        const bool exists = node >= 0 && static_cast<std::size_t>(node) < number.size();
        const auto where = [&] { return std::string(set) + " node " + std::to_string(node); };
        if (!exists || number[node] == kUnused)
            throw InputError(where() + " is no corner of a tetrahedron; choose among those");
        if (number[node] != as && (number[node] == kOrigin || number[node] == kInsertion))
            throw InputError(where() +
                             " also belongs to the other attachment; a node may have one");
        number[node] = as;
    }
}

/// Equation of each node, from 0, or what it is instead.
std::vector<std::int32_t> number_nodes(const TetMesh& mesh, std::span<const std::int32_t> origin,
                                       std::span<const std::int32_t> insertion) {
    std::vector<std::int32_t> number(mesh.points.size(), kUnused);
    for (const Tet& t : mesh.tets)
        for (const std::int32_t node : t) number[node] = 0;
    mark(origin, kOrigin, "origin", number);
    mark(insertion, kInsertion, "insertion", number);
    std::int32_t next = 0;
    for (std::int32_t& n : number)
        if (n == 0) n = next++;
    return number;
}

void require_attached(const TetMesh& mesh, const std::vector<std::int32_t>& number) {
    std::vector<std::int32_t> part;
    const int parts = count_components(mesh.tets, mesh.points.size(), &part);
    std::vector<char> has(2 * static_cast<std::size_t>(parts), 0);
    std::vector<std::size_t> size(static_cast<std::size_t>(parts), 0);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const auto p = static_cast<std::size_t>(part[t]);
        ++size[p];
        for (const std::int32_t node : mesh.tets[t]) {
            if (number[node] == kOrigin) has[2 * p] = 1;
            if (number[node] == kInsertion) has[2 * p + 1] = 1;
        }
    }
    for (std::size_t p = 0; p < size.size(); ++p)
        if (!has[2 * p] || !has[2 * p + 1])
            throw MeshError("a connected part of " + std::to_string(size[p]) +
                            " tetrahedra has no " + (has[2 * p] ? "insertion" : "origin") +
                            " node; attach it there or leave it out");
}

struct System {
    SparseMatrix matrix;
    Eigen::VectorXd right;
};

/// K_ij = sum of V grad N_i . grad N_j over the tetrahedra; what fixed nodes have goes to
/// the right hand side.
System assemble(const TetMesh& mesh, const std::vector<std::int32_t>& number) {
    const Eigen::Index unknowns = *std::max_element(number.begin(), number.end()) + 1;
    System system{SparseMatrix(unknowns, unknowns), Eigen::VectorXd::Zero(unknowns)};
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(16 * mesh.tets.size());
    for (const Tet& t : mesh.tets) {
        const elasticity::RestTet rest =
            elasticity::rest_tet(elasticity::corners_of(t, mesh.points));
        Eigen::Matrix<double, 4, 3> gradient;
        gradient.bottomRows<3>() = rest.inverse_edges;
        gradient.row(0) = -rest.inverse_edges.colwise().sum();
        const Eigen::Matrix4d K = rest.volume * gradient * gradient.transpose();
        for (int i = 0; i < 4; ++i) {
            const std::int32_t row = number[t[i]];
            if (row < 0) continue;
            for (int j = 0; j < 4; ++j) {
                const std::int32_t column = number[t[j]];
                if (column >= 0) entries.emplace_back(row, column, K(i, j));
                if (column == kInsertion) system.right[row] -= K(i, j);
            }
        }
    }
    system.matrix.setFromTriplets(entries.begin(), entries.end());
    return system;
}

/// False where rounding made the matrix lose its definiteness.
bool solve_by_factors(const System& system, Eigen::VectorXd& x) {
    const Eigen::SimplicialLDLT<SparseMatrix> factors(system.matrix);
    if (factors.info() != Eigen::Success) return false;
    x = factors.solve(system.right);
    return x.allFinite();
}

bool solve_by_gradients(const System& system, Eigen::VectorXd& x) {
    Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper,
                             Eigen::IncompleteCholesky<double>>
        solver;
    solver.setTolerance(kTolerance);
    solver.setMaxIterations(kMostIterations);
    solver.compute(system.matrix);
    if (solver.info() != Eigen::Success) return false;
    x = solver.solve(system.right);
    return solver.info() == Eigen::Success && x.allFinite();
}

}  // namespace

void LaplaceOptions::validate() const {
    pennation.validate();
    if (most_factored < 0)
        throw InputError("most_factored is " + std::to_string(most_factored) +
                         ", but it must not be negative");
}

std::vector<double> laplace_potential(const TetMesh& mesh,
                                      std::span<const std::int32_t> origin_nodes,
                                      std::span<const std::int32_t> insertion_nodes,
                                      const LaplaceOptions& options) {
    options.validate();
    require_positive(mesh);
    const std::vector<std::int32_t> number = number_nodes(mesh, origin_nodes, insertion_nodes);
    require_attached(mesh, number);
    const System system = assemble(mesh, number);
    Eigen::VectorXd x(system.right.size());
    if (x.size() > 0) {
        const bool small = x.size() <= options.most_factored;
        if (!(small ? solve_by_factors(system, x) : solve_by_gradients(system, x)))
            throw MeshError(
                "the potential from origin to insertion cannot be solved for: the mesh has "
                "tetrahedra that are all but flat; improve it");
    }
    std::vector<double> potential(mesh.points.size(), 0.0);
    for (std::size_t n = 0; n < potential.size(); ++n)
        potential[n] = number[n] >= 0 ? x[number[n]] : (number[n] == kInsertion ? 1.0 : 0.0);
    return potential;
}

std::vector<Vec3> gradients(const TetMesh& mesh, std::span<const double> potential) {
    std::vector<Vec3> gradient(mesh.tets.size());
    parallel_for(0, gradient.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Tet& t = mesh.tets[i];
            const elasticity::RestTet rest =
                elasticity::rest_tet(elasticity::corners_of(t, mesh.points));
            const double p = potential[t[0]];
            gradient[i] = rest.inverse_edges.transpose() *
                          Vec3(potential[t[1]] - p, potential[t[2]] - p, potential[t[3]] - p);
        }
    });
    return gradient;
}

std::vector<Vec3> averaged_at_nodes(const TetMesh& mesh, const std::vector<Vec3>& gradient) {
    std::vector<Vec3> sum(mesh.points.size(), Vec3::Zero());
    std::vector<double> weight(mesh.points.size(), 0.0);
    for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
        const auto& [a, b, c, d] = mesh.tets[i];
        const auto& x = mesh.points;
        const double v = signed_volume(x[a], x[b], x[c], x[d]);
        for (const std::int32_t node : mesh.tets[i]) {
            sum[node] += v * gradient[i];
            weight[node] += v;
        }
    }
    std::vector<Vec3> averaged(gradient.size(), Vec3::Zero());
    for (std::size_t i = 0; i < mesh.tets.size(); ++i)
        for (const std::int32_t node : mesh.tets[i]) averaged[i] += 0.25 / weight[node] * sum[node];
    return averaged;
}

FibreField laplace_fibres(const TetMesh& mesh, std::span<const std::int32_t> origin_nodes,
                          std::span<const std::int32_t> insertion_nodes,
                          const LaplaceOptions& options) {
    const std::vector<double> potential =
        laplace_potential(mesh, origin_nodes, insertion_nodes, options);
    const std::vector<Vec3> gradient = gradients(mesh, potential);
    FibreField fibres{options.average_gradients ? averaged_at_nodes(mesh, gradient) : gradient, {}};
    double least = 0;
    for (const Vec3& g : gradient)
        least += kVanishing * g.norm() / static_cast<double>(gradient.size());
    for (std::size_t t = 0; t < gradient.size(); ++t) {
        Vec3& v = fibres.direction[t];
        const bool vanishes = !(gradient[t].norm() > least && v.norm() > least);
        v = vanishes ? Vec3(Vec3::Zero()) : Vec3(v.normalized());
    }
    if (const std::size_t filled = fill_gaps(mesh, fibres.direction); filled > 0)
        fibres.notes.push_back("the gradient vanishes in " + std::to_string(filled) + " of " +
                               std::to_string(mesh.tets.size()) +
                               " tetrahedra, which take their neighbours' direction");
    if (options.pennation.angle_deg == 0) return fibres;
    const std::size_t left = pennate(mesh, potential, options.pennation, fibres.direction);
    if (left > 0)
        fibres.notes.push_back(std::to_string(left) +
                               " tetrahedra lie on the aponeurosis and keep the line of action");
    return fibres;
}

}  // namespace myotet::fibres
