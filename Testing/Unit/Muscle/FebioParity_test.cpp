// SPDX-License-Identifier: Apache-2.0
// Material points solved by FEBio 4.11, and how far the laws here are from them.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "MuscleKit.h"

namespace myotet::muscle {
namespace {

// FEBio's regularisation near w = 1 is off by 2e-5, and its points were solved to about
// 1e-5; 0.01 % is what is asked for.
constexpr double kParity = 1e-4;
// Pa. Where the stress is zero FEBio has up to 2e-6 of it left in these files: its sides are
// free to rounding of bulk, 1e7 Pa.
constexpr double kFloor = 1e-5;
constexpr double kPascal = 1e6;  // in a MPa

using Row = std::vector<std::string>;
std::vector<Row> read_rows(const std::string& name) {
    std::ifstream file(std::string(MYOTET_SHARED_DIR) + "/research/febio/a/" + name);
    std::vector<Row> rows;
    std::string line;
    std::getline(file, line);  // columns' names
    while (std::getline(file, line)) {
        std::istringstream text(line);
        Row& row = rows.emplace_back();
        for (std::string cell; std::getline(text, cell, ',');) row.push_back(cell);
    }
    return rows;
}

kit::Bound material_of(const std::string& name, double activation) {
    TissueMaterial m;
    if (name == "B10") m = kit::febio_muscle(1);
    if (name == "B14") m = kit::febio_muscle(1.4);
    if (name == "T") m = kit::febio_mixture();
    if (name == "TEN") m = kit::febio_tendon();
    // "trans iso Mooney-Rivlin": its fibres are the tendon's up to a stretch of 1.03.
    if (name == "TIMR")
        m = {.fibres = FibreCurve::blemker_tendon,
             .fibre_stretch = FibreStretch::isochoric,
             .C1 = 13.85,
             .bulk = 100,
             .L1 = 2.07,
             .L2 = 61.44,
             .linear_stretch = 1.03};
    return {make_tissue(m), Vec3::UnitZ(), activation};
}

Mat3 cauchy(const kit::Bound& law, const Mat3& F) {
    return kPascal * kit::whole_stress(law, F) * F.transpose() / F.determinant();
}

class Worst {
public:
    void see(double ours, double theirs, const std::string& where) {
        EXPECT_NEAR(ours, theirs, kParity * std::abs(theirs) + kFloor) << where;
        ++points_;
        if (std::abs(theirs) < kFloor) return;
        largest_ = std::max(largest_, std::abs(ours - theirs) / std::abs(theirs));
    }
    ~Worst() {
        std::cout << "[ measured ] " << points_ << " stresses, largest relative difference "
                  << largest_ << "\n";
    }

private:
    int points_ = 0;
    double largest_ = 0;
};

TEST(FebioParity, UniaxialStressWithFreeSides) {
    const std::vector<Row> rows = read_rows("a_uniaxial.csv");
    if (rows.empty()) GTEST_SKIP() << "the reference files are not there";
    EXPECT_EQ(rows.size(), 570u);
    Worst worst;
    for (const Row& row : rows) {
        const double stretch = std::stod(row[2]), stress = std::stod(row[3]);
        const double J = std::stod(row[4]);
        if (row[0] == "TIMR" && stretch / std::cbrt(J) > 1.03) continue;  // another straight part
        const kit::Bound law = material_of(row[0], std::stod(row[1]));
        const double side = std::sqrt(J / stretch);
        const Mat3 F = kit::relax(law, Vec3(side, side, stretch).asDiagonal(), {0, 1});
        const std::string where = row[0] + " " + row[1] + " at " + row[2];
        worst.see(cauchy(law, F)(2, 2), stress, where);
        EXPECT_NEAR(F.determinant(), J, 1e-6) << where;
    }
}

TEST(FebioParity, SimpleShearAndBiaxialStretch) {
    const std::vector<Row> rows = read_rows("a_shear_biax.csv");
    if (rows.empty()) GTEST_SKIP() << "the reference files are not there";
    EXPECT_EQ(rows.size(), 360u);
    Worst worst;
    const std::map<std::string, std::pair<int, int>> shears = {
        {"shear_fs", {2, 0}}, {"shear_sf", {0, 2}}, {"shear_st", {0, 1}}};
    for (const Row& row : rows) {
        const kit::Bound law = material_of(row[0], std::stod(row[1]));
        const double by = std::stod(row[3]);
        Mat3 F = Mat3::Identity();
        if (row[2] == "biax")
            F = kit::relax(law, Vec3(by, 1 / (by * by), by).asDiagonal(), {1});
        else
            F(shears.at(row[2]).first, shears.at(row[2]).second) = by;
        const Mat3 sigma = cauchy(law, F);
        const double ours[] = {sigma(0, 0), sigma(1, 1), sigma(2, 2),
                               sigma(0, 1), sigma(1, 2), sigma(0, 2)};
        for (int i = 0; i < 6; ++i)
            worst.see(ours[i], std::stod(row[4 + i]),
                      row[0] + " " + row[1] + " " + row[2] + " " + row[3] + " component " +
                          std::to_string(i));
    }
}

}  // namespace
}  // namespace myotet::muscle
