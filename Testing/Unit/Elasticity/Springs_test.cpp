// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/Springs.h"

#include "LawKit.h"

namespace myotet::elasticity {
namespace {

const Spring kSpring{2.5, 0.3, 1.4};

std::vector<Corners> some_tets() {
    std::vector<Corners> all;
    for (const Mat3& F : kit::deformations()) all.push_back(kit::moved(kit::some_tet(), F));
    return all;
}

TEST(Altitude, LengthIsThreeVolumesOverTheBase) {
    for (const Corners& x : some_tets())
        for (const Altitude& h : altitudes_of(x)) {
            const Triangle f = face_of({0, 1, 2, 3}, h.apex);
            const double area = 0.5 * (x[f[1]] - x[f[0]]).cross(x[f[2]] - x[f[0]]).norm();
            EXPECT_NEAR(h.length, 3 * signed_volume(x[0], x[1], x[2], x[3]) / area, 1e-12);
            Vec3 foot = Vec3::Zero();
            double sum = 0;
            for (const int c : f) {
                foot += h.weight[c] * x[c];
                sum += h.weight[c];
            }
            EXPECT_NEAR(sum, 1, 1e-12);
            EXPECT_LT((foot + h.length * h.normal - x[h.apex]).norm(), 1e-12);
        }
}

TEST(Altitude, SpringPullsTogetherWhatIsTooLongAndPushesApartWhatIsTooShort) {
    const Corners x = kit::some_tet();
    const Altitude h = altitude_of(x, 3);
    EXPECT_LT(h.spread(1)[3].dot(h.normal), 0);
    EXPECT_GT(h.spread(-1)[3].dot(h.normal), 0);
    for (const Corners& y : some_tets())
        for (const Altitude& k : altitudes_of(y)) kit::expect_no_push(y, k.spread(1), 10);
}

TEST(Altitude, ForceIsMinusTheGradientOfTheSpringsEnergy) {
    for (const Corners& x : some_tets())
        for (int apex = 0; apex < 4; ++apex) {
            const Altitude h = altitude_of(x, apex);
            const double pull =
                kSpring.stiffness / kSpring.rest_length * (h.length - kSpring.rest_length);
            const Corners f = h.spread(pull);
            for (int i = 0; i < 4; ++i)
                for (int a = 0; a < 3; ++a) {
                    Corners up = x, down = x;
                    up[i][a] += kit::kStep;
                    down[i][a] -= kit::kStep;
                    const double slope = (spring_energy(kSpring, altitude_of(up, apex).length) -
                                          spring_energy(kSpring, altitude_of(down, apex).length)) /
                                         (2 * kit::kStep);
                    EXPECT_NEAR(f[i][a], -slope, 1e-6 * (1 + std::abs(pull)));
                }
        }
}

TEST(Altitude, DampingDampsAndNothingElse) {
    for (const Corners& x : some_tets())
        for (const Altitude& h : altitudes_of(x))
            kit::expect_damping(x, [&](const Corners& v) {
                return h.spread(kSpring.damping / kSpring.rest_length * h.rate(v));
            });
}

TEST(Altitude, RateIsThatOfTheLength) {
    std::mt19937 random(8);
    const Corners x = kit::some_tet(), v = kit::random_velocities(random);
    for (int apex = 0; apex < 4; ++apex) {
        Corners later = x, before = x;
        for (int i = 0; i < 4; ++i) {
            later[i] += kit::kStep * v[i];
            before[i] -= kit::kStep * v[i];
        }
        const double slope =
            (altitude_of(later, apex).length - altitude_of(before, apex).length) / (2 * kit::kStep);
        EXPECT_NEAR(altitude_of(x, apex).rate(v), slope, 1e-8);
    }
}

TEST(AltitudeStress, ActsAsTheSpringsDo) {
    const std::array<double, 4> pulls = {0.3, -1, 2, 0.7};
    for (const Corners& x : some_tets()) {
        Corners springs;
        springs.fill(Vec3::Zero());
        for (const Altitude& h : altitudes_of(x)) {
            const Corners f = h.spread(pulls[h.apex]);
            for (int i = 0; i < 4; ++i) springs[i] += f[i];
        }
        const Corners stress = cauchy_forces(x, altitude_stress(x, pulls));
        for (int i = 0; i < 4; ++i) EXPECT_LT((springs[i] - stress[i]).norm(), 1e-11);
    }
}

TEST(EdgeForce, IsMinusTheGradientOfTheEnergyAlongTheEdge) {
    const Vec3 a(0.2, 0, 1), b(1, 2, -1);
    const auto [fa, fb] = edge_force(kSpring, a, b);
    EXPECT_LT((fa + fb).norm(), kit::kRounding);
    EXPECT_LT(fa.cross(b - a).norm(), kit::kRounding * 100);
    EXPECT_GT(fa.dot(b - a), 0) << "too long: pulled together";
    const Vec3 along = (b - a).normalized();
    const double slope = (spring_energy(kSpring, (b - a).norm() + kit::kStep) -
                          spring_energy(kSpring, (b - a).norm() - kit::kStep)) /
                         (2 * kit::kStep);
    EXPECT_NEAR(fb.dot(along), -slope, 1e-8);
}

TEST(MakeSpring, SoundSpeedDoesNotDependOnTheMesh) {
    // A chain of springs carries waves at l_o sqrt(k / (l_o m)), whatever l_o.
    const double c = 7, density = 2;
    for (const double length : {1.0, 0.5, 0.01}) {
        const double mass = density * length;
        const Spring s = make_spring(mass, mass, length, c, 0);
        EXPECT_NEAR(length * std::sqrt(s.stiffness / (length * mass)), c, 1e-12);
    }
    // The lighter end decides: the harmonic mean.
    EXPECT_LT(make_spring(1, 1e9, 1, c, 0).stiffness, 2.001 * make_spring(1, 1, 1, c, 0).stiffness);
}

TEST(ChooseAltitudes, ShortestAloneAndCompressedAlone) {
    const Corners x = kit::some_tet();
    const auto altitudes = altitudes_of(x);
    std::array<Spring, 4> springs;
    for (int i = 0; i < 4; ++i) springs[i].rest_length = altitudes[i].length;
    EXPECT_EQ(choose_altitudes(altitudes, springs, AltitudeChoice::all), 15u);
    EXPECT_EQ(choose_altitudes(altitudes, springs, AltitudeChoice::compressed), 0u);
    springs[2].rest_length = 1.2 * altitudes[2].length;
    EXPECT_EQ(choose_altitudes(altitudes, springs, AltitudeChoice::compressed), 4u);
    const unsigned shortest = choose_altitudes(altitudes, springs, AltitudeChoice::shortest);
    for (int i = 0; i < 4; ++i)
        for (const Altitude& h : altitudes)
            EXPECT_TRUE(shortest != 1u << i || altitudes[i].length <= h.length);
    EXPECT_TRUE(shortest == 1 || shortest == 2 || shortest == 4 || shortest == 8);
}

}  // namespace
}  // namespace myotet::elasticity
