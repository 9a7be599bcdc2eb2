// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/LowPass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Core/Errors.h"

namespace myotet::skeleton {
namespace {

using std::numbers::pi;

constexpr double kRounding = 1e-10;
constexpr LowPass kSixHertz{.cutoff_hz = 6, .dt = 0.01, .padding = 50};

TEST(LowPass, WhatIsConstantStays) {
    const auto out = filter(kSixHertz, std::vector<double>(100, 3.5));
    ASSERT_EQ(out.size(), 200u);
    for (const double value : out) EXPECT_NEAR(value, 3.5, kRounding);
}

// What the filter begins with dies out within the padding: by exp(-pi 6 Hz 0.5 s), 1e-4.
TEST(LowPass, WhatIsStraightStaysInsideThePadding) {
    constexpr double kBeginning = 1e-4;
    std::vector<double> line;
    for (int i = 0; i < 100; ++i) line.push_back(3 - 0.1 * i);
    const auto out = filter(kSixHertz, line);
    for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(out[50 + i], line[i], kBeginning);
}

// Forwards and backwards: |H|^2 = 1 / (1 + (tan(pi f dt) / tan(pi fc dt))^6), without delay.
TEST(LowPass, WavesKeepTheirPhaseAndLoseAmplitudeAsButterworthSays) {
    for (const double hz : {1.0, 3.0, 6.0, 12.0, 25.0}) {
        std::vector<double> wave;
        for (int i = 0; i < 4000; ++i) wave.push_back(std::cos(2 * pi * hz * 0.01 * (i - 2000)));
        const auto out = filter({.cutoff_hz = 6, .dt = 0.01, .padding = 0}, wave);
        const double gain =
            1 / (1 + std::pow(std::tan(pi * hz * 0.01) / std::tan(pi * 6 * 0.01), 6));
        for (std::size_t i = 1900; i < 2100; ++i) EXPECT_NEAR(out[i], gain * wave[i], kRounding);
    }
}

TEST(LowPass, BackwardsIsTheSame) {
    std::vector<double> signal, reversed;
    for (int i = 0; i < 300; ++i) signal.push_back(std::sin(0.001 * i * i));
    reversed.assign(signal.rbegin(), signal.rend());
    const LowPass wide{.cutoff_hz = 6, .dt = 0.01, .padding = 299};
    const auto out = filter(wide, signal), back = filter(wide, reversed);
    // The two passes change places: only the ends, far away, tell them apart.
    for (std::size_t i = 299; i < 599; ++i) EXPECT_NEAR(out[i], back[out.size() - 1 - i], 1e-9);
}

TEST(LowPass, WrongOptionsAreRefused) {
    const std::vector<double> signal(10, 1.0), short_one(3, 1.0);
    EXPECT_THROW((void)filter({.cutoff_hz = 0, .dt = 0.01}, signal), InputError);
    EXPECT_THROW((void)filter({.cutoff_hz = 50, .dt = 0.01}, signal), InputError);
    EXPECT_THROW((void)filter({.cutoff_hz = std::nan(""), .dt = 0.01}, signal), InputError);
    EXPECT_THROW((void)filter({.cutoff_hz = 6, .dt = 0.01, .padding = 10}, signal), InputError);
    EXPECT_THROW((void)filter({.cutoff_hz = 6, .dt = 0.01}, short_one), InputError);
}

}  // namespace
}  // namespace myotet::skeleton
