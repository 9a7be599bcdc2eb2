// SPDX-License-Identifier: Apache-2.0
#include "Muscle/TissueMaterial.h"

#include <gmock/gmock.h>

#include "Core/Errors.h"
#include "MuscleKit.h"

namespace myotet::muscle {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

TEST(TissueMaterial, NamedSetsAreValidAndComplete) {
    for (const std::string& name : kit::kSets) {
        const TissueMaterial material = kit::read_set(name);
        EXPECT_NO_THROW(material.validate()) << name;
        std::ifstream file(std::string(MYOTET_SOURCE_DIR) + "/Data/materials/" + name + ".yaml");
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        for (const ConstantInfo& info : constants_of(material))
            EXPECT_THAT(text, HasSubstr("\n  " + std::string(info.name) + ": ")) << name;
        for (const ChoiceInfo& info : all_choices())
            EXPECT_THAT(text, HasSubstr("\n" + std::string(info.name) + ": ")) << name;
    }
}

TEST(TissueMaterial, ReferenceMusclesAreTheNamedSet) {
    const TissueMaterial set = kit::read_set("blemker2005_muscle");
    for (const ConstantInfo& info : constants_of(set))
        EXPECT_EQ(constant(set, info.name), constant(kit::febio_muscle(1.4), info.name));
}

TEST(TissueMaterial, ConstantsAreSetByNameAndOthersRefusedWithTheList) {
    TissueMaterial material;
    set_choice(material, "fibres", "teran_muscle");
    for (const ConstantInfo& info : constants_of(material)) {
        set_constant(material, info.name, 0.125);
        EXPECT_EQ(constant(material, info.name), 0.125);
        EXPECT_FALSE(info.unit.empty() || info.meaning.empty());
    }
    EXPECT_EQ(material.sigma_max, 0.125);
    EXPECT_THAT([&] { set_constant(material, "sigma", 1); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("'sigma'"), HasSubstr("sigma_max"),
                                                HasSubstr("teran_muscle"), Not(HasSubstr("L1")))));
    EXPECT_THROW(set_constant(material, "L1", 1), InputError) << "muscle has no such constant";
    EXPECT_EQ(all_constants().size(), 12u);
}

TEST(TissueMaterial, ChoicesAreSetByWordAndOthersRefusedWithTheList) {
    TissueMaterial material;
    set_choice(material, "fibres", "blemker_tendon");
    set_choice(material, "fibre_stretch", "isochoric");
    set_choice(material, "volume", "squared");
    EXPECT_EQ(material.fibres, FibreCurve::blemker_tendon);
    EXPECT_EQ(material.fibre_stretch, FibreStretch::isochoric);
    EXPECT_EQ(material.volume, elasticity::VolumeForm::squared);
    EXPECT_THAT([&] { set_choice(material, "fibres", "blemker"); },
                ThrowsMessage<InputError>(HasSubstr("none, blemker_muscle, teran_muscle")));
    EXPECT_THAT([&] { set_choice(material, "fiber", "none"); },
                ThrowsMessage<InputError>(HasSubstr("fibres, fibre_stretch, volume")));
}

TEST(TissueMaterial, RefusesWhatHasNoMeaning) {
    const auto refused = [](const char* set, const char* name, double value) {
        TissueMaterial material = kit::read_set(set);
        set_constant(material, name, value);
        EXPECT_THAT([&] { material.validate(); }, ThrowsMessage<InputError>(HasSubstr(name)));
    };
    for (const double value : {-1.0, std::nan(""), 1e300})
        for (const ConstantInfo& info : constants_of(kit::read_set("teran2003_muscle")))
            refused("teran2003_muscle", info.name.data(), value);
    for (const char* name : {"bulk", "sigma_max", "P1", "P2", "optimal_stretch"})
        refused("blemker2005_muscle", name, 0);
    for (const char* name : {"bulk", "L1", "L2", "linear_stretch"})
        refused("teran2003_tendon", name, 0);
    refused("blemker2005_muscle", "linear_stretch", 1.39);  // its optimum is 1.4
    refused("teran2003_tendon", "L2", 500);
    TissueMaterial none{.bulk = 1};
    EXPECT_THROW(none.validate(), InputError) << "nothing resists shear";
    none.C1 = 0.1;
    EXPECT_NO_THROW(none.validate());
    none.P1 = 0.1;
    EXPECT_THROW(none.validate(), InputError) << "would do nothing";
}

TEST(IllPosed, IsFibreStretchWithoutVolumeAndWithoutAMatrix) {
    TissueMaterial material = kit::read_set("blemker2005_muscle");
    EXPECT_THAT(ill_posed(material), HasSubstr("matrix"));
    material.C1 = 0.01;
    EXPECT_EQ(ill_posed(material), "");
    material.C1 = 0;
    material.fibre_stretch = FibreStretch::full;
    EXPECT_EQ(ill_posed(material), "");
    EXPECT_EQ(ill_posed(kit::read_set("teran2003_muscle")), "");
    EXPECT_EQ(ill_posed(TissueMaterial{.fibre_stretch = FibreStretch::isochoric}), "");
}

}  // namespace
}  // namespace myotet::muscle
