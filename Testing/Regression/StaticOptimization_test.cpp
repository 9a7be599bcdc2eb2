// SPDX-License-Identifier: Apache-2.0
// Beside OpenSim's own results for its arm of two joints and six muscles: inverse dynamics
// and muscle force distribution under the assumptions with which those were made.
// MYOTET_PLOTS=FOLDER makes it draw FOLDER/arm26.png.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "Activation/Sharing.h"
#include "Report/Chart.h"
#include "Skeleton/ReadOsim.h"

namespace myotet {
namespace {

namespace fs = std::filesystem;
using activation::Demand;
using skeleton::Table;

constexpr double kFilter = 6;         // Hz, as the reference's set-up says
constexpr double kMoment = 0.005;     // asked, of the range; measured 0.0005
constexpr double kActivation = 0.02;  // asked; measured 0.006
constexpr double kGain = 5e-4;        // measured 2.3e-4
// At 0.5 s: activations within 0.004 times gains of 360 to 900 N. What remains is a moment arm
// at the shoulder that OpenSim finds 1.2 % longer, around an ellipsoid.
constexpr double kForce = 1.5;  // N

const fs::path kFolder =
    fs::path(MYOTET_SHARED_DIR) / "data/opensim/core/Applications/Analyze/tests/resources";

class StaticOptimization : public ::testing::Test {
protected:
    void SetUp() override {
        if (!fs::exists(kFolder)) GTEST_SKIP() << kFolder << " is not here";
        model_ = skeleton::read_osim(kFolder / "arm26.osim");
        const auto trajectory =
            skeleton::make_trajectory(skeleton::read_table(kFolder / "arm26_InverseKinematics.mot"),
                                      model_, {.cutoff_hz = kFilter});
        activations_ = reference("StaticOptimization_activation");
        forces_ = reference("StaticOptimization_force");
        SilentProgress silent;
        motion_ = activation::follow_muscles(model_, trajectory, activations_.times, false, silent);
    }
    static Table reference(const std::string& what) {
        return skeleton::read_table(kFolder / ("std_arm26_" + what + ".sto"));
    }
    // No passive force, and gains as OpenSim's second version had them.
    [[nodiscard]] std::vector<Demand> demands() const {
        std::vector<activation::SkeletonUnit> units = activation::units_of(model_);
        activation::SharingOptions options;
        std::vector<Demand> all = activation::demands_of(model_, units, motion_, options);
        for (std::size_t m = 0; m < units.size(); ++m) {
            muscle::ThelenShape shape{.passive_form = muscle::ThelenPassive::everywhere};
            for (const auto& [name, value] : model_.muscles[m].shape) {
                if (name == "KshapeActive") shape.KshapeActive = value;
                if (name == "KshapePassive") shape.KshapePassive = value;
                if (name == "FmaxMuscleStrain") shape.FmaxMuscleStrain = value;
                if (name == "FmaxTendonStrain") shape.FmaxTendonStrain = value;
                if (name == "Af") shape.Af = value;
                if (name == "Flen") shape.Flen = value;
            }
            units[m].unit.curves = muscle::thelen2003_curves(shape);
            for (std::size_t t = 0; t < all.size(); ++t) {
                all[t].gains[m] = muscle::isokinetic_gain(units[m].unit, motion_.lengths[t][m],
                                                          motion_.speeds[t][m]);
                all[t].passive[m] = 0;
                all[t].lowest[m] = 1e-5;  // their least control
            }
        }
        return all;
    }

    skeleton::Model model_;
    activation::MuscleMotion motion_;
    Table activations_, forces_;
};

double cell(const Table& table, std::size_t row, const std::string& name) {
    return table.rows[row][static_cast<std::size_t>(skeleton::find_column(table, name))];
}

TEST_F(StaticOptimization, MomentsOfTheMotion) {
    const Table moments = reference("InverseDynamics");
    ASSERT_EQ(moments.rows.size(), motion_.times.size());
    for (std::size_t c = 0; c < 2; ++c) {
        const std::string name = model_.coordinates[c].name + "_moment";
        double least = HUGE_VAL, most = -HUGE_VAL, worst = 0;
        for (std::size_t t = 0; t < moments.rows.size(); ++t) {
            const double theirs = 1000 * cell(moments, t, name);  // N mm
            least = std::min(least, theirs);
            most = std::max(most, theirs);
            worst = std::max(worst, std::abs(motion_.torques[t][c] - theirs));
        }
        EXPECT_GT(most - least, 1000);
        EXPECT_LT(worst / (most - least), kMoment) << name;
    }
}

TEST_F(StaticOptimization, GainsAreTheirs) {
    const auto all = demands();
    for (std::size_t t = 0; t < all.size(); ++t)
        for (std::size_t m = 0; m < model_.muscles.size(); ++m) {
            const std::string& name = model_.muscles[m].name;
            const double theirs = cell(forces_, t, name) / cell(activations_, t, name);
            EXPECT_NEAR(all[t].gains[m] / theirs, 1, kGain) << name << " at row " << t;
        }
}

// Ours solid, theirs dashed.
void draw(const skeleton::Model& model, const Table& theirs,
          const std::vector<activation::Distribution>& ours, const fs::path& folder) {
    report::Chart chart{
        .title = "arm26: activations, dashed black: OpenSim's", .x_label = "time, s", .columns = 3};
    for (std::size_t m = 0; m < model.muscles.size(); ++m) {
        report::Line own{.name = "", .x = theirs.times, .colour = 0};
        report::Line reference{
            .name = "", .x = theirs.times, .style = report::LineStyle::dashed, .colour = 6};
        for (std::size_t t = 0; t < theirs.times.size(); ++t) {
            own.y.push_back(ours[t].activations[m]);
            reference.y.push_back(cell(theirs, t, model.muscles[m].name));
        }
        report::Panel panel{.title = model.muscles[m].name, .y_label = "activation"};
        const double most = *std::ranges::max_element(reference.y);
        panel.y_range = most > 0.05 ? report::Range{-0.01, 0.25} : report::Range{-0.0012, 0.03};
        panel.lines = {std::move(own), std::move(reference)};
        chart.panels.push_back(std::move(panel));
    }
    report::write_png(report::draw_chart(chart, {.panel_width = 320, .panel_height = 220}),
                      folder / "arm26.png");
}

TEST_F(StaticOptimization, ActivationsAndForces) {
    SilentProgress silent;
    const auto ours = activation::distribute(demands(), {}, silent);
    for (std::size_t t = 0; t < ours.size(); ++t) {
        ASSERT_EQ(ours[t].status, activation::Status::converged) << ours[t].message;
        for (std::size_t m = 0; m < model_.muscles.size(); ++m)
            EXPECT_NEAR(ours[t].activations[m], cell(activations_, t, model_.muscles[m].name),
                        kActivation)
                << model_.muscles[m].name << " at row " << t;
    }
    const std::size_t half = 60;
    ASSERT_NEAR(motion_.times[half], 0.5, 1e-5);
    const std::map<std::string, double> told{{"TRIlong", 0.008}, {"TRIlat", 18.75},
                                             {"TRImed", 17.04},  {"BIClong", 74.06},
                                             {"BICshort", 6.42}, {"BRA", 0.34}};
    for (std::size_t m = 0; m < model_.muscles.size(); ++m)
        EXPECT_NEAR(ours[half].forces[m], told.at(model_.muscles[m].name), kForce)
            << model_.muscles[m].name;
    if (const char* folder = std::getenv("MYOTET_PLOTS")) draw(model_, activations_, ours, folder);
}

// What the program would say with OpenSim's assumptions since its third version, and with
// what those leave out: the same motion needs more of some muscles, since the relaxed ones
// resist.
TEST_F(StaticOptimization, PassiveForceAndTendonsMatter) {
    SilentProgress silent;
    activation::SharingOptions bare{.tendons = activation::Tendons::rigid, .passive = false};
    const auto without = activation::share(model_, motion_, bare, silent);
    const auto with = activation::share(model_, motion_, {}, silent);
    ASSERT_EQ(without.status, activation::Status::converged) << without.message;
    ASSERT_EQ(with.status, activation::Status::converged) << with.message;
    double most_without = 0, most_with = 0;
    for (std::size_t t = 0; t < with.at.size(); ++t) {
        most_without = std::max(most_without, without.at[t].activations[1]);
        most_with = std::max(most_with, with.at[t].activations[1]);
    }
    EXPECT_EQ(model_.muscles[1].name, "TRIlat");
    EXPECT_NEAR(most_without, 0.150, 0.01);
    EXPECT_NEAR(most_with, 0.350, 0.02);
}

}  // namespace
}  // namespace myotet
