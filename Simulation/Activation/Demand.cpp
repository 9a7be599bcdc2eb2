// SPDX-License-Identifier: Apache-2.0
#include "Activation/Demand.h"

#include <cmath>

#include "Activation/Require.h"

namespace myotet::activation {

void Demand::validate() const {
    const auto finite = [](double x) { return std::isfinite(x); };
    const auto pull = [](double x) { return x >= 0 && std::isfinite(x); };
    const std::size_t m = coordinates(), n = muscles();
    require_each(torques, m, "torques", "it must be finite", finite);
    require_each(gains, n, "gains", "it must be a pull in N, not a push", pull);
    require(arms.rows() == static_cast<Eigen::Index>(m), "arms.rows()",
            static_cast<double>(arms.rows()), "it must be the number of coordinates");
    require(arms.cols() == static_cast<Eigen::Index>(n), "arms.cols()",
            static_cast<double>(arms.cols()), "it must be the number of muscles");
    require(arms.allFinite(), "arms", std::nan(""), "each must be finite");
    if (!passive.empty()) require_each(passive, n, "passive", "it must be finite", finite);
    if (!lowest.empty()) require_each(lowest, n, "lowest", "it must not be negative", pull);
    if (!highest.empty()) require_each(highest, n, "highest", "it must not be negative", pull);
    for (std::size_t i = 0; i < n; ++i) {
        const double low = lowest.empty() ? 0 : lowest[i], high = highest.empty() ? 1 : highest[i];
        require(low <= high, "lowest[" + std::to_string(i) + "]", low,
                "it must not be more than highest, " + std::to_string(high));
    }
    const auto known = [](double x) { return !std::isinf(x); };
    if (!measured.empty())
        require_each(measured, n, "measured", "it must be finite, or NaN: unknown", known);
}

std::string to_string(Status status) {
    switch (status) {
        case Status::converged:
            return "converged";
        case Status::infeasible:
            return "infeasible";
        case Status::not_converged:
            return "not converged";
    }
    return {};
}

}  // namespace myotet::activation
