// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/OsimFunctions.h"

#include "OsimKit.h"

namespace myotet::skeleton {
namespace {

using ::testing::HasSubstr;

constexpr double kRounding = 1e-12;

/// The elbow's shift along x by a function, mm at an angle.
SmallModel shifted_by(const std::string& function) {
    SmallModel small;
    const std::string spline =
        "<SimmSpline name=\"function\"><x>0 1 2</x><y>0 0.005 0.004</y></SimmSpline>";
    small.elbow_axes.replace(small.elbow_axes.find(spline), spline.size(), function);
    return small;
}
double shift(const std::string& function, double angle) {
    const Model model = read(shifted_by(function));
    return evaluate(model.joints[1].translations[0].function, angle).value;
}

TEST(OsimFunctions, KindsMeanWhatTheirNamesSay) {
    EXPECT_NEAR(shift("<Constant name=\"function\"><value>0.02</value></Constant>", 1), 20,
                kRounding);
    EXPECT_NEAR(shift("<LinearFunction name=\"function\"><coefficients>2 1</coefficients>"
                      "</LinearFunction>",
                      3),
                7000, kRounding);
    EXPECT_NEAR(shift("<PolynomialFunction name=\"function\"><coefficients>1 2 3</coefficients>"
                      "</PolynomialFunction>",
                      2),
                11000, kRounding);
    EXPECT_NEAR(shift("<Sine name=\"function\"><amplitude>2</amplitude><omega>3</omega>"
                      "<phase>0.5</phase><offset>1</offset></Sine>",
                      0.7),
                1000 * (2 * std::sin(2.6) + 1), 1e-9);
    EXPECT_NEAR(shift("<PiecewiseLinearFunction name=\"function\"><x>0 1 3</x><y>0 2 3</y>"
                      "</PiecewiseLinearFunction>",
                      4),
                3500, 1e-9);
    EXPECT_NEAR(shift("<MultiplierFunction name=\"function\"><function><Constant><value>2</value>"
                      "</Constant></function><scale>0.25</scale></MultiplierFunction>",
                      4),
                500, kRounding);
    // In the manner of older files.
    EXPECT_NEAR(shift("<function><Constant name=\"\"><value>0.5</value></Constant></function>", 1),
                500, kRounding);
}

TEST(OsimFunctions, SplinesAreThoseOfSimm) {
    const std::string points = "<x>0 1 2 4 5</x><y>0 1 8 64 125</y>";
    // The cubic that the points lie on, which a natural spline would miss.
    for (const std::string kind : {"SimmSpline", "NaturalCubicSpline", "natCubicSpline"})
        EXPECT_NEAR(shift("<" + kind + " name=\"function\">" + points + "</" + kind + ">", 3),
                    27000, 1e-8);
    const std::string gcv =
        "<GCVSpline name=\"function\"><half_order>2</half_order>"
        "<error_variance>0</error_variance>" +
        points + "</GCVSpline>";
    EXPECT_NEAR(shift(gcv, 3),
                1000 * evaluate(natural_spline({0, 1, 2, 4, 5}, {0, 1, 8, 64, 125}), 3).value,
                1e-8);
}

TEST(OsimFunctions, OthersAreRefusedByName) {
    const auto why = [](const std::string& function) { return refusal(shifted_by(function)); };
    EXPECT_THAT(why("<StepFunction name=\"function\"/>"), HasSubstr("(<StepFunction> 'function')"));
    EXPECT_THAT(why("<GCVSpline name=\"function\"><half_order>3</half_order></GCVSpline>"),
                HasSubstr("<half_order> 2"));
    EXPECT_THAT(why("<Constant name=\"function\"/>"), HasSubstr("has no <value>"));
    EXPECT_THAT(why("<SimmSpline name=\"function\"><x>0 1</x></SimmSpline>"), HasSubstr("no <y>"));
    EXPECT_THAT(why("<SimmSpline name=\"function\"><x>0 0</x><y>0 1</y></SimmSpline>"),
                HasSubstr("0 follows 0"));
    EXPECT_THAT(why("<SimmSpline name=\"function\"><x>0 1 2</x><y>0 1</y></SimmSpline>"),
                HasSubstr("3 and 2"));
    EXPECT_THAT(why("<LinearFunction name=\"function\"/>"), HasSubstr("<coefficients>"));
    EXPECT_THAT(why("<PolynomialFunction name=\"function\"><coefficients/></PolynomialFunction>"),
                HasSubstr("at least one"));
    EXPECT_THAT(why("<MultiplierFunction name=\"function\"><scale>2</scale></MultiplierFunction>"),
                HasSubstr("multiplies no <function>"));
}

}  // namespace
}  // namespace myotet::skeleton
