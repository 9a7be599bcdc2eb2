// SPDX-License-Identifier: Apache-2.0
#include "Activation/SplineBasis.h"

#include <algorithm>
#include <cmath>

#include "Activation/Require.h"

namespace myotet::activation {
namespace {

std::vector<double> combine(const Eigen::MatrixXd& coefficients, int first,
                            const std::array<double, 4>& shares) {
    const Eigen::VectorXd sum =
        coefficients.middleCols<4>(first) * Eigen::Map<const Eigen::Vector4d>(shares.data());
    return {sum.data(), sum.data() + sum.size()};
}

}  // namespace

void SplineBasis::validate() const {
    require(std::isfinite(begin), "begin", begin, "it must be a time in s");
    require(end > begin && std::isfinite(end), "end", end, "it must be a time after begin");
    require(intervals > 0, "intervals", intervals, "it must be positive");
}

// Of u from 0 to 1 in an interval h long:
//     (1 - u)^3, 3 u^3 - 6 u^2 + 4, -3 u^3 + 3 u^2 + 3 u + 1, u^3, each over 6.
SplineBasis::Local SplineBasis::at(double time) const {
    const double h = spacing(), place = (time - begin) / h;
    const int first = std::clamp(static_cast<int>(std::floor(place)), 0, intervals - 1);
    const double u = place - first, v = 1 - u, h2 = h * h;
    return {first,
            {v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
             (3 * v * v * v - 6 * v * v + 4) / 6, u * u * u / 6},
            {-v * v / (2 * h), (3 * u * u - 4 * u) / (2 * h), -(3 * v * v - 4 * v) / (2 * h),
             u * u / (2 * h)},
            {v / h2, (3 * u - 2) / h2, (3 * v - 2) / h2, u / h2}};
}

std::vector<double> ActivationCurves::activations(double time) const {
    const SplineBasis::Local local = basis.at(time);
    return combine(coefficients, local.first, local.value);
}

std::vector<double> ActivationCurves::rates(double time) const {
    const SplineBasis::Local local = basis.at(time);
    return combine(coefficients, local.first, local.slope);
}

}  // namespace myotet::activation
