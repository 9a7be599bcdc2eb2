// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/PointLaw.h"

#include "Elasticity/Materials.h"
#include "LawKit.h"

namespace myotet::elasticity {
namespace {

TEST(OneLaw, IsTheSameForEveryTetrahedron) {
    const NeoHookean rubber{lame_from(0.1, 0.45)};
    const OneLaw<NeoHookean> one(rubber);
    const PointLaw& law = one;
    for (const Mat3& F : kit::deformations())
        for (const std::size_t t : {0u, 7u}) {
            EXPECT_EQ(law.energy(t, F), rubber.energy(F));
            EXPECT_EQ(law.stress(t, F), rubber.stress(F));
            EXPECT_EQ(law.tangent(t, F), rubber.tangent(F));
        }
}

}  // namespace
}  // namespace myotet::elasticity
