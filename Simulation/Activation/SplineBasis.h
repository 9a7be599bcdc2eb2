// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace myotet::activation {

/// Cubic B-splines of a time on equal intervals [de Boor 1978, ch. IX]. Every curve of them is
/// twice smooth and stays between its least and its largest coefficient.
struct SplineBasis {
    double begin = 0, end = 1;  ///< s
    int intervals = 1;

    [[nodiscard]] int count() const { return intervals + 3; }
    [[nodiscard]] double spacing() const { return (end - begin) / intervals; }

    /// The four splines that are not zero at a time and their derivatives, 1/s and 1/s^2.
    struct Local {
        int first = 0;
        std::array<double, 4> value, slope, bend;
    };
    /// Before the first and after the last time the pieces there go on.
    [[nodiscard]] Local at(double time) const;
    /// Throws InputError.
    void validate() const;
};

/// Activations of muscles over time.
struct ActivationCurves {
    SplineBasis basis;
    Eigen::MatrixXd coefficients;  ///< (muscle, spline)

    [[nodiscard]] std::vector<double> activations(double time) const;
    [[nodiscard]] std::vector<double> rates(double time) const;  ///< 1/s
};

}  // namespace myotet::activation
