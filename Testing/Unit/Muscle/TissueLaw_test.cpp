// SPDX-License-Identifier: Apache-2.0
#include "Muscle/TissueLaw.h"

#include <gmock/gmock.h>

#include "Core/Errors.h"
#include "MuscleKit.h"

namespace myotet::muscle {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const TissueMaterial kFat{.C1 = 0.001, .bulk = 1};
const Vec3 kAlong = Vec3(2, 1, -2) / 3;

std::vector<TissueMaterial> some_materials() {
    return {kFat, kit::read_set("teran2003_muscle"), kit::read_set("teran2003_tendon")};
}

TEST(TissueLaw, IsEachPointsOwnMaterialFibreAndActivation) {
    const auto materials = some_materials();
    const Vec3 none = Vec3::Constant(std::nan(""));
    TissueLaw law(materials, {1, 0, 2, 1}, {Vec3::UnitX(), none, kAlong, kAlong});
    law.set_activation(std::vector<double>{0.25, 0.5, 0.75, 0});
    law.set_activation(3, 1);
    const std::uint32_t of[] = {1, 0, 2, 1};
    const Vec3 fibres[] = {Vec3::UnitX(), none, kAlong, kAlong};
    const double activation[] = {0.25, 0.5, 0.75, 1};
    for (const Mat3& F : kit::law_kit::deformations())
        for (std::size_t p = 0; p < 4; ++p) {
            const Tissue tissue = make_tissue(materials[of[p]]);
            EXPECT_EQ(law.energy(p, F), tissue.energy(F, fibres[p], activation[p]));
            EXPECT_EQ(law.stress(p, F), tissue.stress(F, fibres[p], activation[p]));
            EXPECT_EQ(law.tangent(p, F), tissue.tangent(F, fibres[p], activation[p]));
            EXPECT_TRUE(law.tangent(p, F).allFinite());
            EXPECT_EQ(law.volume(p).bulk, materials[of[p]].bulk);
            EXPECT_EQ(law.activation()[p], activation[p]);
        }
}

TEST(TissueLaw, RelaxedAtFirstAndStressFreeThen) {
    const TissueLaw law(some_materials(), {1, 0, 2}, std::vector<Vec3>(3, kAlong));
    for (std::size_t p = 0; p < 3; ++p) {
        EXPECT_EQ(law.activation()[p], 0);
        EXPECT_NEAR(law.stress(p, Mat3::Identity()).norm(), 0, 1e-15);
    }
}

TEST(TissueLaw, RefusesPointsThatMakeNoSense) {
    const auto materials = some_materials();
    const auto build = [&](std::uint32_t material, const Vec3& fibre) {
        return TissueLaw(materials, {0, material}, {Vec3::Zero(), fibre});
    };
    EXPECT_NO_THROW(build(1, kAlong));
    EXPECT_NO_THROW(build(0, Vec3::Constant(std::nan(""))));
    EXPECT_THAT([&] { build(3, kAlong); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("point 1"), HasSubstr("3"))));
    EXPECT_THAT([&] { build(1, 1.1 * kAlong); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("point 1"), HasSubstr("1.1"))));
    EXPECT_THROW(build(2, Vec3::Zero()), InputError);
    EXPECT_THROW(build(2, Vec3::Constant(std::nan(""))), InputError);
    EXPECT_THROW(TissueLaw(materials, {1, 1}, {kAlong}), InputError);
    EXPECT_THROW(TissueLaw(std::vector<TissueMaterial>(1), {0}, {kAlong}), InputError);
}

TEST(TissueLaw, RefusesActivationBeyondOneAndKeepsWhatWas) {
    TissueLaw law(some_materials(), {1, 1}, {kAlong, kAlong});
    law.set_activation(std::vector<double>{0.1, 0.2});
    for (const double wrong : {-0.01, 1.01, std::nan("")}) {
        EXPECT_THAT(
            [&] {
                law.set_activation(std::vector<double>{0.5, wrong});
            },
            ThrowsMessage<InputError>(HasSubstr("point 1")));
        EXPECT_THROW(law.set_activation(0, wrong), InputError);
    }
    EXPECT_THROW(law.set_activation(std::vector<double>{0.5}), InputError);
    EXPECT_EQ(law.activation()[0], 0.1);
    EXPECT_EQ(law.activation()[1], 0.2);
}

TEST(TissueLaw, AlmostUnitFibresAreMadeSo) {
    const TissueLaw law(some_materials(), {1}, {(1 + 5e-7) * kAlong});
    const TissueLaw exact(some_materials(), {1}, {kAlong});
    const Mat3 F = Vec3(1.1, 0.9, 1.2).asDiagonal();
    EXPECT_NEAR(law.energy(0, F), exact.energy(0, F), 1e-16);
}

}  // namespace
}  // namespace myotet::muscle
