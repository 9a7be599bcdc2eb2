// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Skeleton.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "Core/Errors.h"
#include "OsimKit.h"

namespace myotet::skeleton {
namespace {

using ::testing::HasSubstr;

// Of a few hundred sums and products, relative.
constexpr double kRounding = 1e-11;
constexpr double kGravity = 9806.65;  // mm/s^2

Freedom linear(const Vec3& axis, int coordinate) {
    Freedom freedom{axis.normalized(), {}, coordinate};
    freedom.function.kind = FunctionKind::linear;
    freedom.function.coefficients = {1, 0};
    return freedom;
}

Body bar(double mass, const Vec3& center, const Vec3& moments) {
    return {"bar", mass, center, moments.asDiagonal()};
}

Model empty_model() {
    Model model;
    model.bodies.resize(1);
    model.gravity = {0, -kGravity, 0};
    return model;
}

void add(Model& model, const Body& body, Joint joint) {
    joint.child = static_cast<int>(model.bodies.size());
    model.bodies.push_back(body);
    model.joints.push_back(joint);
}

/// A chain of bars of length l along -y, each turning about z.
Model pendulum(int bars, double l) {
    Model model = empty_model();
    for (int i = 0; i < bars; ++i) {
        Joint pin;
        pin.parent = i;
        if (i > 0) pin.in_parent.translation = {0, -l, 0};
        pin.rotations[2] = linear(Vec3::UnitZ(), i);
        add(model, bar(2e-3, {0, -0.6 * l, 0}, {15, 1, 15.5}), pin);
        model.coordinates.push_back({"angle" + std::to_string(i)});
    }
    return model;
}

/// A tree of joints with turns and shifts that are functions, also nonlinear ones.
Model crooked() {
    Model model = pendulum(1, 300);
    model.coordinates.resize(4);
    model.coordinates[3].rotational = false;
    Joint knee;
    knee.parent = 1;
    knee.in_parent = {Eigen::AngleAxisd(0.4, Vec3(1, 2, 0).normalized()).toRotationMatrix(),
                      Vec3(5, -300, 2)};
    knee.in_child = {Eigen::AngleAxisd(-0.2, Vec3(0, 1, 1).normalized()).toRotationMatrix(),
                     Vec3(1, 2, 3)};
    knee.rotations[0] = linear({0.1, 0.2, 1}, 1);
    knee.rotations[1] = {Vec3::UnitY(), simm_spline({-1, 0, 1, 2}, {0.2, 0, 0.1, 0.3}), 1};
    knee.rotations[2] = {Vec3::UnitX(), constant_function(0.3), -1};
    knee.translations[0] = {Vec3::UnitX(), natural_spline({-1, 0, 2}, {-4, 1, 7}), 1};
    knee.translations[1] = linear(Vec3::UnitY(), 3);
    add(model, bar(1e-3, {10, -120, 4}, {11, 2, 12}), knee);
    Joint side;
    side.parent = 1;
    side.rotations[1] = linear(Vec3(1, 1, 0), 2);
    add(model, bar(0.5e-3, {30, 20, -10}, {1, 1, 1}), side);
    return model;
}

const std::vector<double> kValues{0.3, 0.6, -0.4, 7}, kSpeeds{1.2, -2, 0.7, 30},
    kAccelerations{5, 3, -8, 200};

TEST(Skeleton, APendulumNeedsItsClosedForm) {
    const double l = 300, c = 0.6 * l, m = 2e-3;
    Skeleton skeleton(pendulum(1, l));
    for (const double q : {-2.0, 0.0, 0.7, 1.5}) {
        const std::vector<double> values{q}, speeds{3.0}, accelerations{-4.0};
        const auto forces = skeleton.inverse_dynamics(values, speeds, accelerations);
        const double expected = (15.5 + m * c * c) * -4.0 + m * kGravity * c * std::sin(q);
        EXPECT_NEAR(forces[0], expected, kRounding * 1e4);
    }
}

// [Craig, Introduction to Robotics, sec. 6.7], with moments of inertia.
TEST(Skeleton, ADoublePendulumNeedsItsClosedForm) {
    const double l = 300, c = 0.6 * l, m = 2e-3, i = 15.5, a = 0.4, b = -1.1;
    const double va = 2, vb = -3, aa = 5, ab = 7;
    Skeleton skeleton(pendulum(2, l));
    const auto forces = skeleton.inverse_dynamics(
        std::vector<double>{a, b}, std::vector<double>{va, vb}, std::vector<double>{aa, ab});
    const double coupling = m * l * c;
    const double m11 = 2 * i + m * c * c + m * (l * l + c * c + 2 * l * c * std::cos(b));
    const double m12 = i + m * c * c + coupling * std::cos(b), m22 = i + m * c * c;
    const double g2 = m * kGravity * c * std::sin(a + b);
    const double g1 = m * kGravity * (c + l) * std::sin(a) + g2;
    const double h = coupling * std::sin(b);
    EXPECT_NEAR(forces[0], m11 * aa + m12 * ab - h * (2 * va * vb + vb * vb) + g1, kRounding * 1e4);
    EXPECT_NEAR(forces[1], m12 * aa + m22 * ab + h * va * va + g2, kRounding * 1e4);
}

TEST(Skeleton, FreeFallNeedsNoForce) {
    Model model = empty_model();
    Joint free;
    for (int i = 0; i < 3; ++i) {
        free.rotations[static_cast<std::size_t>(i)] = linear(Vec3::Unit(i), i);
        free.translations[static_cast<std::size_t>(i)] = linear(Vec3::Unit(i), 3 + i);
    }
    add(model, bar(2e-3, Vec3::Zero(), {3, 3, 3}), free);
    model.coordinates.resize(6);
    Skeleton skeleton(model);
    const auto forces = skeleton.inverse_dynamics(std::vector<double>{0.1, 0.2, 0.3, 4, 5, 6},
                                                  std::vector<double>{0, 0, 0, 100, 200, 300},
                                                  std::vector<double>{0, 0, 0, 0, -kGravity, 0});
    for (const double force : forces) EXPECT_NEAR(force, 0, kRounding * 100);
}

TEST(Skeleton, RatesAreDifferencesOfPoses) {
    constexpr double kStep = 1e-5, kDifferences = 1e-5;  // h^2 by third derivatives near 1e4
    const Model model = crooked();
    Skeleton skeleton(model);
    skeleton.place(kValues);
    const auto here = skeleton.poses();
    const auto rates = skeleton.rates();
    for (std::size_t c = 0; c < kValues.size(); ++c) {
        auto moved = kValues;
        moved[c] += kStep;
        skeleton.place(moved);
        const auto after = skeleton.poses();
        moved[c] -= 2 * kStep;
        skeleton.place(moved);
        for (std::size_t b = 0; b < model.bodies.size(); ++b) {
            const Pose& before = skeleton.poses()[b];
            const Vec3 shift = (after[b].translation - before.translation) / (2 * kStep);
            const Mat3 spin =
                (after[b].rotation - before.rotation) / (2 * kStep) * here[b].rotation.transpose();
            EXPECT_NEAR((rates[c][b].shift - shift).norm(), 0, kDifferences * 300);
            EXPECT_NEAR((rates[c][b].turning - Vec3(spin(2, 1), spin(0, 2), spin(1, 0))).norm(), 0,
                        kDifferences);
        }
    }
}

double kinetic_energy(Skeleton& skeleton, const Model& model, const std::vector<double>& values,
                      const std::vector<double>& speeds) {
    skeleton.place(values);
    const auto rates = skeleton.rates();
    double energy = 0;
    for (std::size_t b = 1; b < model.bodies.size(); ++b) {
        Vec3 turning = Vec3::Zero(), shift = Vec3::Zero();
        for (std::size_t c = 0; c < speeds.size(); ++c) {
            turning += speeds[c] * rates[c][b].turning;
            shift += speeds[c] * rates[c][b].shift;
        }
        const Body& body = model.bodies[b];
        const Mat3& r = skeleton.poses()[b].rotation;
        const Vec3 center = shift + turning.cross(r * body.mass_center);
        energy += 0.5 * body.mass * center.squaredNorm() +
                  0.5 * turning.dot(r * body.inertia * r.transpose() * turning);
    }
    return energy;
}

double potential_energy(Skeleton& skeleton, const Model& model, const std::vector<double>& values) {
    skeleton.place(values);
    double energy = 0;
    for (std::size_t b = 1; b < model.bodies.size(); ++b)
        energy -= model.bodies[b].mass *
                  model.gravity.dot(skeleton.poses()[b](model.bodies[b].mass_center));
    return energy;
}

// Power is the change of energy: sum of force times speed = d(T + V)/dt, whatever the functions
// of the joints.
TEST(Skeleton, ForcesDoTheWorkThatEnergyGains) {
    const Model model = crooked();
    Skeleton skeleton(model);
    const double h = 1e-5;
    const auto energy = [&](double t) {
        auto q = kValues, v = kSpeeds;
        for (std::size_t c = 0; c < q.size(); ++c) {
            q[c] += t * kSpeeds[c] + t * t / 2 * kAccelerations[c];
            v[c] += t * kAccelerations[c];
        }
        return kinetic_energy(skeleton, model, q, v) + potential_energy(skeleton, model, q);
    };
    const auto forces = skeleton.inverse_dynamics(kValues, kSpeeds, kAccelerations);
    double power = 0;
    for (std::size_t c = 0; c < forces.size(); ++c) power += forces[c] * kSpeeds[c];
    const double gained = (energy(h) - energy(-h)) / (2 * h);
    // h^2 times third derivatives of energy, and rounding of energy over h.
    EXPECT_NEAR(power, gained, 1e-6 * std::abs(gained));
}

// At rest forces are the slope of the potential: each coordinate alone.
TEST(Skeleton, ForcesAtRestAreTheSlopeOfThePotential) {
    const Model model = crooked();
    Skeleton skeleton(model);
    const std::vector<double> still(4, 0.0);
    const auto forces = skeleton.inverse_dynamics(kValues, still, still);
    const double h = 1e-4;
    for (std::size_t c = 0; c < 4; ++c) {
        auto up = kValues, down = kValues;
        up[c] += h;
        down[c] -= h;
        const double slope =
            (potential_energy(skeleton, model, up) - potential_energy(skeleton, model, down)) /
            (2 * h);
        EXPECT_NEAR(forces[c], slope, 1e-6 * std::abs(slope) + 1e-6);
    }
}

// M is symmetric: the force along a by acceleration of b is that along b by a.
TEST(Skeleton, MassesCoupleBothWays) {
    Skeleton skeleton(crooked());
    const std::vector<double> still(4, 0.0);
    const auto weight = skeleton.inverse_dynamics(kValues, still, still);
    Eigen::Matrix4d mass;
    for (int c = 0; c < 4; ++c) {
        std::vector<double> unit(4, 0.0);
        unit[static_cast<std::size_t>(c)] = 1;
        const auto forces = skeleton.inverse_dynamics(kValues, still, unit);
        for (int r = 0; r < 4; ++r)
            mass(r, c) = forces[static_cast<std::size_t>(r)] - weight[static_cast<std::size_t>(r)];
    }
    EXPECT_NEAR((mass - mass.transpose()).norm(), 0, kRounding * mass.norm() * 100);
    EXPECT_EQ(Eigen::LLT<Eigen::Matrix4d>(mass).info(), Eigen::Success);
}

// The whole model and gravity moved together: the same forces.
TEST(Skeleton, ForcesDoNotDependOnWhereTheGroundLooks) {
    Model model = crooked();
    const auto before = Skeleton(model).inverse_dynamics(kValues, kSpeeds, kAccelerations);
    const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
    model.gravity = turn * model.gravity;
    model.joints[0].in_parent = Pose{turn, {50, -70, 900}} * model.joints[0].in_parent;
    const auto after = Skeleton(model).inverse_dynamics(kValues, kSpeeds, kAccelerations);
    for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(after[c], before[c], kRounding * 1e5);
}

TEST(Skeleton, BeginsAtRestAndMovesWithItsModelsOwner) {
    Model model = pendulum(1, 300);
    model.coordinates[0].at_rest = 0.5;
    Skeleton first(model);
    EXPECT_NEAR(first.poses()[1].rotation(1, 0), std::sin(0.5), kRounding);
    const Skeleton second = std::move(first);
    EXPECT_NEAR(second.poses()[1].rotation(1, 0), std::sin(0.5), kRounding);
}

// Joints without coordinates hold; coordinates that no joint follows need no force.
TEST(Skeleton, HeldBodiesAndIdleCoordinates) {
    Model model = pendulum(1, 300);
    Joint weld;
    weld.parent = 1;
    weld.rotations[0] = {Vec3::UnitX(), constant_function(0.3), -1};
    weld.rotations[1] = {Vec3::UnitY(), constant_function(0.2), -1};
    weld.translations[1] = {Vec3::UnitY(), constant_function(-40), -1};
    add(model, bar(0, Vec3::Zero(), Vec3::Zero()), weld);
    model.coordinates.push_back({"idle"});
    Skeleton skeleton(model);
    skeleton.place(std::vector<double>{0, 9});
    const Mat3 expected =
        (Eigen::AngleAxisd(0.3, Vec3::UnitX()) * Eigen::AngleAxisd(0.2, Vec3::UnitY()))
            .toRotationMatrix();
    EXPECT_NEAR((skeleton.poses()[2].rotation - expected).norm(), 0, kRounding);
    EXPECT_NEAR(skeleton.poses()[2].translation.y(), -40, kRounding * 100);
    const std::vector<double> two{0.1, 0.2};
    EXPECT_EQ(skeleton.inverse_dynamics(two, two, two)[1], 0);
    EXPECT_EQ(skeleton.rates()[1][2].shift.norm(), 0);
}

std::string refusal(const Model& model) {
    try {
        const Skeleton skeleton(model);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no refusal";
}

TEST(Skeleton, ModelsThatCannotBeAreRefused) {
    Model model = pendulum(2, 300);
    model.bodies[1].inertia.diagonal() = Vec3(1, 1, 100);
    EXPECT_THAT(refusal(model), HasSubstr("no mass can have"));
    model.bodies[1].inertia.diagonal() = Vec3(1, 1, 1);
    model.bodies[1].mass = 0;
    EXPECT_THAT(refusal(model), HasSubstr("inertia but no mass"));
    model.bodies[1].mass = std::nan("");
    EXPECT_THAT(refusal(model), HasSubstr("not finite"));
    model = pendulum(2, 300);
    std::swap(model.joints[0], model.joints[1]);
    EXPECT_THAT(refusal(model), HasSubstr("sort the joints"));
    model = pendulum(2, 300);
    model.joints[1].rotations[2].coordinate = 0;
    EXPECT_THAT(refusal(model), HasSubstr("'angle0'"));
    model = pendulum(1, 300);
    model.joints[0].rotations[0].axis = Vec3::UnitZ();
    EXPECT_THAT(refusal(model), HasSubstr("parallel"));
    model.joints[0].rotations[0].axis = Vec3(0, 2, 0);
    EXPECT_THAT(refusal(model), HasSubstr("unit vector"));
    Skeleton skeleton(pendulum(1, 300));
    EXPECT_THROW(skeleton.place(std::vector<double>{std::nan("")}), InputError);
}

}  // namespace
}  // namespace myotet::skeleton
