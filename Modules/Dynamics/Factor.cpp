// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/Factor.h"

#include <openblas_config.h>
#include <suitesparse/cholmod.h>

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"

extern "C" void openblas_set_num_threads(int);

namespace myotet::dynamics {
namespace {

constexpr double kShifts[] = {0, 1e-3, 1e-2, 1e-1, 1};

}  // namespace

// Unknowns are the coordinates of free nodes, node by node.
struct Factor::Impl {
    cholmod_common common{};
    cholmod_sparse* matrix = nullptr;  // lower triangle
    cholmod_factor* factor = nullptr;
    cholmod_dense *solution = nullptr, *work = nullptr, *work2 = nullptr;
    std::vector<std::int32_t> number;  // of a node among the free ones, or -1
    std::vector<std::int32_t> node;    // of a number
    double shift = 0;
    bool ready = false;

    Impl() {
        cholmod_start(&common);
        common.print = 0;
        common.supernodal = CHOLMOD_SUPERNODAL;
        common.final_ll = 1;
        common.quick_return_if_not_posdef = 1;
    }
    ~Impl() {
        cholmod_free_dense(&solution, &common);
        cholmod_free_dense(&work, &common);
        cholmod_free_dense(&work2, &common);
        cholmod_free_sparse(&matrix, &common);
        cholmod_free_factor(&factor, &common);
        cholmod_finish(&common);
    }
    void check() const {
        if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
            throw ResourceError("there is not enough memory for a sparse factor of " +
                                std::to_string(node.size()) +
                                " nodes; choose iterative solves, or a coarser mesh");
    }
    void number_nodes(const std::vector<char>& held) {
        number.assign(held.size(), -1);
        for (std::size_t n = 0; n < held.size(); ++n)
            if (!held[n]) {
                number[n] = static_cast<std::int32_t>(node.size());
                node.push_back(static_cast<std::int32_t>(n));
            }
    }
    std::vector<int> order(const BlockMatrix& K);
    void lay_out(const BlockMatrix& K);
    void fill(const BlockMatrix& K, double s);
    bool analyze(const BlockMatrix& K, const std::vector<char>& held);
};

// Nested dissection of the nodes' graph, then each node's three coordinates together.
std::vector<int> Factor::Impl::order(const BlockMatrix& K) {
    const std::size_t count = node.size();
    std::size_t entries = 0;
    for (const std::int32_t n : node)
        for (std::size_t i = K.row_start[n]; i < K.row_start[n + 1]; ++i)
            entries += number[K.column[i]] > number[n];
    cholmod_sparse* graph =
        cholmod_allocate_sparse(count, count, entries, 1, 1, -1, CHOLMOD_PATTERN, &common);
    check();
    auto* start = static_cast<int*>(graph->p);
    auto* row = static_cast<int*>(graph->i);
    int used = 0;
    for (std::size_t c = 0; c < count; ++c) {
        start[c] = used;
        for (std::size_t i = K.row_start[node[c]]; i < K.row_start[node[c] + 1]; ++i)
            if (number[K.column[i]] > static_cast<int>(c)) row[used++] = number[K.column[i]];
    }
    start[count] = used;
    std::vector<int> of_nodes(count);
    const int done = cholmod_metis(graph, nullptr, 0, 1, of_nodes.data(), &common);
    cholmod_free_sparse(&graph, &common);
    check();
    if (!done)
        for (std::size_t i = 0; i < count; ++i) of_nodes[i] = static_cast<int>(i);
    std::vector<int> all;
    for (const int n : of_nodes)
        for (int d = 0; d < 3; ++d) all.push_back(3 * n + d);
    return all;
}

// The pattern of the lower triangle, rows of a column in increasing order.
void Factor::Impl::lay_out(const BlockMatrix& K) {
    std::size_t entries = 0;
    for (const std::int32_t n : node)
        for (std::size_t i = K.row_start[n]; i < K.row_start[n + 1]; ++i) {
            const int m = number[K.column[i]];
            entries += m == number[n] ? 6 : m > number[n] ? 9 : 0;
        }
    const std::size_t size = 3 * node.size();
    matrix = cholmod_allocate_sparse(size, size, entries, 1, 1, -1, CHOLMOD_REAL, &common);
    check();
    auto* start = static_cast<int*>(matrix->p);
    auto* row = static_cast<int*>(matrix->i);
    int used = 0;
    for (std::size_t c = 0; c < node.size(); ++c)
        for (int d = 0; d < 3; ++d) {
            start[3 * c + d] = used;
            for (std::size_t i = K.row_start[node[c]]; i < K.row_start[node[c] + 1]; ++i) {
                const int m = number[K.column[i]];
                if (m < static_cast<int>(c)) continue;
                for (int e = m == static_cast<int>(c) ? d : 0; e < 3; ++e) row[used++] = 3 * m + e;
            }
        }
    start[size] = used;
}

void Factor::Impl::fill(const BlockMatrix& K, double s) {
    auto* value = static_cast<double*>(matrix->x);
    for (std::size_t c = 0; c < node.size(); ++c)
        for (int d = 0; d < 3; ++d)
            for (std::size_t i = K.row_start[node[c]]; i < K.row_start[node[c] + 1]; ++i) {
                const int m = number[K.column[i]];
                if (m < static_cast<int>(c)) continue;
                const bool diagonal = m == static_cast<int>(c);
                // K is symmetric: column d of the block is row d of it.
                for (int e = diagonal ? d : 0; e < 3; ++e)
                    *value++ = K.value[i](d, e) +
                               (diagonal && e == d ? s * std::abs(K.value[i](d, d)) : 0);
            }
}

bool Factor::Impl::analyze(const BlockMatrix& K, const std::vector<char>& held) {
    if (factor) return true;
    if (matrix) return false;
    number_nodes(held);
    if (node.empty()) return false;
    lay_out(K);
    std::vector<int> permutation = order(K);
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = 1;
    factor = cholmod_analyze_p(matrix, permutation.data(), nullptr, 0, &common);
    check();
    return factor != nullptr;
}

FactorCost Factor::analyze(const BlockMatrix& K, const std::vector<char>& held) {
    if (!impl_->analyze(K, held)) return {};
    return {impl_->common.fl, impl_->common.lnz};
}

Factor::Factor() : impl_(std::make_unique<Impl>()) {}
Factor::~Factor() = default;

bool Factor::ready() const { return impl_->ready; }
double Factor::shift() const { return impl_->shift; }

bool Factor::compute(const BlockMatrix& K, const std::vector<char>& held) {
    Impl& my = *impl_;
    openblas_set_num_threads(1);
    my.ready = false;
    if (!my.analyze(K, held)) return false;
    // The factorisation lets through what is not a number.
    const auto finite = [](const Mat3& block) { return block.allFinite(); };
    if (!std::all_of(K.value.begin(), K.value.end(), finite)) return false;
    for (const double s : kShifts) {
        my.fill(K, s);
        my.common.status = CHOLMOD_OK;
        cholmod_factorize(my.matrix, my.factor, &my.common);
        my.check();
        my.shift = s;
        my.ready = my.common.status == CHOLMOD_OK && my.factor->minor == my.factor->n;
        if (my.ready) return true;
    }
    return false;
}

void Factor::apply(const NodeVectors& r, NodeVectors& z) const {
    Impl& my = *impl_;
    cholmod_dense right{};
    std::vector<double> numbers(3 * my.node.size());
    for (std::size_t i = 0; i < my.node.size(); ++i)
        for (int d = 0; d < 3; ++d) numbers[3 * i + d] = r[my.node[i]][d];
    right.nrow = right.d = right.nzmax = numbers.size();
    right.ncol = 1;
    right.x = numbers.data();
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, my.factor, &right, nullptr, &my.solution, nullptr, &my.work,
                   &my.work2, &my.common);
    my.check();
    z.assign(r.size(), Vec3::Zero());
    const auto* solved = static_cast<const double*>(my.solution->x);
    for (std::size_t i = 0; i < my.node.size(); ++i)
        z[my.node[i]] = Vec3(solved[3 * i], solved[3 * i + 1], solved[3 * i + 2]);
}

}  // namespace myotet::dynamics
