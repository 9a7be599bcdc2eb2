// SPDX-License-Identifier: Apache-2.0
#include "Muscle/Parts.h"

#include <array>
#include <cmath>

namespace myotet::muscle {
namespace {

// Below w = 1 + kNear a series: its terms fall by the factor kNear / 2, and beyond it the
// closed form of the curvature loses less than 1e-13 to cancellation.
constexpr double kNear = 0.02;
constexpr int kTerms = 10;

// acosh(1 + t)^2 = 4 asinh(sqrt(t / 2))^2 = sum_n c_n t^n, n >= 1,
// c_1 = 2, c_(n+1) = -c_n n^2 / ((n + 1) (2 n + 1)).
constexpr std::array<double, kTerms> kSeries = [] {
    std::array<double, kTerms> c{2};
    for (int n = 1; n < kTerms; ++n)
        c[n] = -c[n - 1] * n * n / (static_cast<double>(n + 1) * (2 * n + 1));
    return c;
}();

// w of FibreShear and its derivatives; half = 1 / (2 J sqrt(I4)) is in all of them.
struct AcrossFibres {
    double half, ratio;  // ratio = I5 / I4
    double w, by_I1, by_I4, by_I5, by_J;
    explicit AcrossFibres(const Invariants& I)
        : half(1 / (2 * I.J * std::sqrt(I.I4))),
          ratio(I.I5 / I.I4),
          w((I.I1 * I.I4 - I.I5) * half),
          by_I1(I.I4 * half),
          by_I4(0.5 * (I.I1 + ratio) * half),
          by_I5(-half),
          by_J(-w / I.J) {}
};

// The active part of a fibre's pull when fully active, its integral over x and its slope.
// Within a step its strength is that of the step's beginning, and the speed decides.
double speed_of(const Drive& drive, double x) { return (x - drive.begun) / drive.seconds; }

double active_energy(const ActiveCurve& active, const Drive& drive, double x) {
    if (!drive.force_velocity) return active.integral(x);
    return active.value(drive.begun) * drive.seconds *
           drive.force_velocity->integral(speed_of(drive, x));
}

double active_pull(const ActiveCurve& active, const Drive& drive, double x) {
    if (!drive.force_velocity) return active.value(x);
    return active.value(drive.begun) * drive.force_velocity->value(speed_of(drive, x));
}

double active_rise(const ActiveCurve& active, const Drive& drive, double x) {
    if (!drive.force_velocity) return active.slope(x);
    return active.value(drive.begun) / drive.seconds *
           drive.force_velocity->slope(speed_of(drive, x));
}

// The exponent of 1 / J in an isochoric stretch.
constexpr double kThird = 1.0 / 3;

}  // namespace

double MooneyRivlin::energy(const Invariants& I) const {
    const double scale = I.inverse_cube_root_J * I.inverse_cube_root_J;
    return C1 * (scale * I.I1 - 3) + C2 * (scale * scale * I.I2 - 3);
}

void MooneyRivlin::add_derivatives(const Invariants& I, Slopes& slopes) const {
    const double scale = I.inverse_cube_root_J * I.inverse_cube_root_J;
    const double by_I1 = C1 * scale, by_I2 = C2 * scale * scale;
    slopes.I1 += by_I1;
    slopes.I2 += by_I2;
    slopes.J -= (2 * by_I1 * I.I1 + 4 * by_I2 * I.I2) / (3 * I.J);
}

void MooneyRivlin::add_derivatives(const Invariants& I, Slopes& slopes,
                                   Curvatures& curvatures) const {
    add_derivatives(I, slopes);
    const double scale = I.inverse_cube_root_J * I.inverse_cube_root_J;
    const double by_I1 = C1 * scale, by_I2 = C2 * scale * scale;
    curvatures.I1_J -= 2 * by_I1 / (3 * I.J);
    curvatures.I2_J -= 4 * by_I2 / (3 * I.J);
    curvatures.J_J += (10 * by_I1 * I.I1 + 28 * by_I2 * I.I2) / (9 * I.J * I.J);
}

SquaredAcosh squared_acosh(double w) {
    const double t = w - 1;
    if (t < kNear) {
        SquaredAcosh sum{};
        for (int n = kTerms; n > 0; --n) {  // Horner's rule for all three
            const double c = kSeries[n - 1];
            sum.value = (sum.value + c) * t;
            sum.slope = sum.slope * t + n * c;
            if (n > 1) sum.curvature = sum.curvature * t + n * (n - 1) * c;
        }
        return sum;
    }
    // B = acosh w, B' = 1 / sqrt(w^2 - 1), B'' = -w B'^3
    const double square = (w - 1) * (w + 1), root = std::sqrt(square);
    const double angle = std::log(w + root);
    const double slope = 2 * angle / root;
    return {angle * angle, slope, (2 - w * slope) / square};
}

double FibreShear::energy(const Invariants& I) const {
    return G1 * (I.I5 / (I.I4 * I.I4) - 1) + G2 * squared_acosh(AcrossFibres(I).w).value;
}

void FibreShear::add_derivatives(const Invariants& I, Slopes& slopes) const {
    const AcrossFibres across(I);
    const double pull = G2 * squared_acosh(across.w).slope, along = G1 / (I.I4 * I.I4);
    slopes.I1 += pull * across.by_I1;
    slopes.I4 += pull * across.by_I4 - 2 * along * across.ratio;
    slopes.I5 += pull * across.by_I5 + along;
    slopes.J += pull * across.by_J;
}

void FibreShear::add_derivatives(const Invariants& I, Slopes& slopes,
                                 Curvatures& curvatures) const {
    const AcrossFibres across(I);
    const SquaredAcosh h = squared_acosh(across.w);
    const double inverse_I4 = 1 / I.I4, inverse_J = 1 / I.J;
    const double pull = G2 * h.slope, bend = G2 * h.curvature;
    const double along = G1 * inverse_I4 * inverse_I4;
    slopes.I1 += pull * across.by_I1;
    slopes.I4 += pull * across.by_I4 - 2 * along * across.ratio;
    slopes.I5 += pull * across.by_I5 + along;
    slopes.J += pull * across.by_J;
    // w and its first derivatives fall as 1 / J: each one's derivative by J is minus itself
    // over J, that of dw/dJ minus twice.
    const double with_J = bend * across.by_J - pull * inverse_J;
    curvatures.I1_I1 += bend * across.by_I1 * across.by_I1;
    curvatures.I1_I4 += bend * across.by_I1 * across.by_I4 + 0.5 * pull * across.half;
    curvatures.I1_I5 += bend * across.by_I1 * across.by_I5;
    curvatures.I1_J += with_J * across.by_I1;
    curvatures.I4_I4 += bend * across.by_I4 * across.by_I4 -
                        0.25 * pull * across.half * (I.I1 + 3 * across.ratio) * inverse_I4 +
                        6 * along * across.ratio * inverse_I4;
    curvatures.I4_I5 +=
        bend * across.by_I4 * across.by_I5 + (0.5 * pull * across.half - 2 * along) * inverse_I4;
    curvatures.I4_J += with_J * across.by_I4;
    curvatures.I5_I5 += bend * across.by_I5 * across.by_I5;
    curvatures.I5_J += with_J * across.by_I5;
    curvatures.J_J += (bend * across.by_J - 2 * pull * inverse_J) * across.by_J;
}

double FibreTension::energy(double stretch, const Drive& drive) const {
    const double x = stretch / optimal_stretch;
    double sum = by_area ? passive.integral_over_stretch(x) : passive.integral(x);
    if (active) sum += drive.activation * active_energy(*active, drive, x);
    return stress * sum;
}

double FibreTension::value(double stretch, const Drive& drive) const {
    const double x = stretch / optimal_stretch;
    double pull = passive.value(x);
    if (by_area) pull /= x;
    if (active) pull += drive.activation * active_pull(*active, drive, x);
    return stress / optimal_stretch * pull;
}

double FibreTension::slope(double stretch, const Drive& drive) const {
    const double x = stretch / optimal_stretch;
    double rise = passive.slope(x);
    if (by_area) rise = (rise - passive.value(x) / x) / x;
    if (active) rise += drive.activation * active_rise(*active, drive, x);
    return stress / (optimal_stretch * optimal_stretch) * rise;
}

double Fibres::stretch(const Invariants& I) const {
    return (isochoric ? I.inverse_cube_root_J : 1) * std::sqrt(I.I4);
}

double Fibres::energy(const Invariants& I, const Drive& drive) const {
    return tension.energy(stretch(I), drive);
}

// l = J^(-k) sqrt(I4), k = 1/3 or 0:  dl/dI4 = l / (2 I4),  dl/dJ = -k l / J
void Fibres::add_derivatives(const Invariants& I, const Drive& drive, Slopes& slopes) const {
    const double l = stretch(I), work = tension.value(l, drive) * l;
    slopes.I4 += work / (2 * I.I4);
    if (isochoric) slopes.J -= kThird * work / I.J;
}

// With W' = dW/dl and m = l W', n = l^2 W'' of the fibre:
//     d2W/dI4^2 = (n - m) / (4 I4^2),  d2W/dI4 dJ = -k (n + m) / (2 I4 J),
//     d2W/dJ^2 = (k^2 n + k (k + 1) m) / J^2
void Fibres::add_derivatives(const Invariants& I, const Drive& drive, Slopes& slopes,
                             Curvatures& curvatures) const {
    const double l = stretch(I), m = tension.value(l, drive) * l;
    const double n = tension.slope(l, drive) * l * l;
    slopes.I4 += m / (2 * I.I4);
    curvatures.I4_I4 += (n - m) / (4 * I.I4 * I.I4);
    if (!isochoric) return;
    slopes.J -= kThird * m / I.J;
    curvatures.I4_J -= kThird * (n + m) / (2 * I.I4 * I.J);
    curvatures.J_J += kThird * (kThird * n + (kThird + 1) * m) / (I.J * I.J);
}

}  // namespace myotet::muscle
