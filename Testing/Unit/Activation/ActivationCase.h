// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "Activation/Instant.h"

namespace myotet::activation {

/// Muscles on both sides of each coordinate, and torques that activations somewhere between
/// the bounds make. mm, N.
inline Instant random_instant(std::mt19937& random, int coordinates, int muscles) {
    std::uniform_real_distribution<double> unit(0, 1), both(-1, 1);
    Instant instant;
    instant.arms.resize(coordinates, muscles);
    for (int i = 0; i < muscles; ++i) {
        instant.gains.push_back(100 + 900 * unit(random));
        instant.passive.push_back(20 * unit(random));
        for (int c = 0; c < coordinates; ++c) instant.arms(c, i) = 40 * both(random);
    }
    const auto count = static_cast<std::size_t>(coordinates);
    instant.torques.assign(count, 0);
    for (int i = 0; i < muscles; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const double force = instant.passive[at] + instant.gains[at] * unit(random);
        for (int c = 0; c < coordinates; ++c)
            instant.torques[static_cast<std::size_t>(c)] += instant.arms(c, i) * force;
    }
    return instant;
}

}  // namespace myotet::activation
