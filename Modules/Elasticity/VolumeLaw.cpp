// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/VolumeLaw.h"

#include <cmath>
#include <limits>

namespace myotet::elasticity {

double VolumeLaw::energy(double J) const {
    if (bulk == 0) return 0;
    if (form == VolumeForm::squared) return 0.5 * bulk * (J - 1) * (J - 1);
    if (!(J > 0)) return std::numeric_limits<double>::infinity();
    const double log_J = std::log(J);
    if (form == VolumeForm::log_and_square) return 0.25 * bulk * (J * J - 2 * log_J - 1);
    return 0.5 * bulk * log_J * log_J;
}

double VolumeLaw::pressure(double J) const {
    switch (form) {
        case VolumeForm::squared:
            return bulk * (J - 1);
        case VolumeForm::log_and_square:
            return 0.5 * bulk * (J - 1 / J);
        case VolumeForm::log_squared:
            break;
    }
    return bulk * std::log(J) / J;
}

double VolumeLaw::slope(double J) const {
    switch (form) {
        case VolumeForm::squared:
            return bulk;
        case VolumeForm::log_and_square:
            return 0.5 * bulk * (1 + 1 / (J * J));
        case VolumeForm::log_squared:
            break;
    }
    return bulk * (1 - std::log(J)) / (J * J);
}

}  // namespace myotet::elasticity
