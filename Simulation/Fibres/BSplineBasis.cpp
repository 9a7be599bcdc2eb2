// SPDX-License-Identifier: Apache-2.0
#include "Fibres/BSplineBasis.h"

#include <algorithm>

namespace myotet::fibres {
namespace {

/// Knot i in units of a span: 0 .. 0, 1, 2, .., spans .. spans.
double knot(int degree, int count, int i) { return std::clamp(i - degree, 0, count - degree); }

}  // namespace

Basis basis_at(int degree, int count, double t) {
    const int spans = count - degree;
    const double s = std::clamp(t, 0.0, 1.0) * spans;
    Basis basis;
    basis.first = std::min(static_cast<int>(s), spans - 1);
    const int span = basis.first + degree;  // knot(span) <= s <= knot(span + 1)
    const auto u = [&](int i) { return knot(degree, count, i); };
    // N_i,p = (s - u_i) / (u_i+p - u_i) N_i,p-1 + (u_i+p+1 - s) / (u_i+p+1 - u_i+1) N_i+1,p-1
    basis.value[0] = 1;
    for (int p = 1; p <= degree; ++p) {
        if (p == degree) {
            // N'_i,p = p N_i,p-1 / (u_i+p - u_i) - p N_i+1,p-1 / (u_i+p+1 - u_i+1)
            for (int r = 0; r < p; ++r) {
                const double rate =
                    p * spans * basis.value[r] / (u(span + r + 1) - u(span + r + 1 - p));
                basis.slope[r] -= rate;
                basis.slope[r + 1] += rate;
            }
        }
        double carried = 0;
        for (int r = 0; r < p; ++r) {
            const double right = u(span + r + 1) - s, left = s - u(span + r + 1 - p);
            const double share = basis.value[r] / (right + left);
            basis.value[r] = carried + right * share;
            carried = left * share;
        }
        basis.value[p] = carried;
    }
    return basis;
}

double greville(int degree, int count, int control) {
    double sum = 0;
    for (int i = 1; i <= degree; ++i) sum += knot(degree, count, control + i);
    return sum / (degree * (count - degree));
}

}  // namespace myotet::fibres
