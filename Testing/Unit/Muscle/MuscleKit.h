// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>

#include "../Elasticity/LawKit.h"
#include "Muscle/Tissue.h"

namespace myotet::muscle::kit {

namespace law_kit = elasticity::kit;

/// A tissue with its fibre and activation bound: a law as the kit of Elasticity wants it.
struct Bound {
    Tissue tissue;
    Vec3 fibre = Vec3(1, -2, 2) / 3;
    double activation = 0;
    [[nodiscard]] double energy(const Mat3& F) const { return tissue.energy(F, fibre, activation); }
    [[nodiscard]] Mat3 stress(const Mat3& F) const { return tissue.stress(F, fibre, activation); }
    [[nodiscard]] Tangent tangent(const Mat3& F) const {
        return tissue.tangent(F, fibre, activation);
    }
};

/// A set of Data/materials, read without a YAML library: "name: value" a line, a choice or a
/// constant, a comment after '#'.
inline TissueMaterial read_set(const std::string& name) {
    std::ifstream file(std::filesystem::path(MYOTET_SOURCE_DIR) / "Data/materials" /
                       (name + ".yaml"));
    EXPECT_TRUE(file.good()) << name;
    TissueMaterial material;
    std::string line;
    while (std::getline(file, line)) {
        std::istringstream words(line.substr(0, line.find('#')));
        std::string key, value;
        if (!(words >> key >> value) || key == "myotet_material:") continue;
        key.pop_back();  // the colon
        const auto choices = all_choices();
        const bool is_choice = std::any_of(choices.begin(), choices.end(),
                                           [&](const ChoiceInfo& c) { return c.name == key; });
        if (is_choice)
            set_choice(material, key, value);
        else
            set_constant(material, key, std::stod(value));
    }
    return material;
}
inline const std::vector<std::string> kSets = {"blemker2005_muscle", "blemker2005_tendon",
                                               "teran2003_muscle", "teran2003_tendon"};

/// The materials of the reference solutions: FEBio's "muscle material" with an optimum of
/// 1.4 or 1, its fibres in a Mooney-Rivlin matrix, and its "tendon material".
inline TissueMaterial febio_muscle(double optimal_stretch) {
    return {.fibres = FibreCurve::blemker_muscle,
            .fibre_stretch = FibreStretch::isochoric,
            .G1 = 5e-4,
            .G2 = 5e-4,
            .bulk = 10,
            .sigma_max = 0.3,
            .optimal_stretch = optimal_stretch,
            .P1 = 0.05,
            .P2 = 6.6,
            .linear_stretch = 1.4};
}
inline TissueMaterial febio_mixture() {
    TissueMaterial m = febio_muscle(1);
    m.C1 = 0.03;
    m.C2 = 0.01;
    m.G1 = m.G2 = 0;
    m.bulk = 1;
    return m;
}
inline TissueMaterial febio_tendon() {
    return {.fibres = FibreCurve::blemker_tendon,
            .fibre_stretch = FibreStretch::isochoric,
            .G1 = 0.05,
            .G2 = 0.05,
            .bulk = 100,
            .L1 = 2.7,
            .L2 = 46.4,
            .linear_stretch = 1.03};
}

/// First Piola-Kirchhoff stress and its derivative with the part of the volume.
inline Mat3 whole_stress(const Bound& law, const Mat3& F) {
    const double J = F.determinant();
    return law.stress(F) + law.tissue.volume.pressure(J) * J * F.inverse().transpose();
}

/// Changes the diagonal entries `free` of the diagonal F until those of the stress are zero;
/// their derivatives by differences. A small step in the logarithms keeps them positive.
inline Mat3 relax(const Bound& law, Mat3 F, const std::vector<int>& free) {
    const auto count = static_cast<Eigen::Index>(free.size());
    const auto residual = [&](const Mat3& at) {
        const Mat3 P = whole_stress(law, at);
        Eigen::VectorXd r(count);
        for (Eigen::Index i = 0; i < count; ++i) r[i] = P(free[i], free[i]) * at(free[i], free[i]);
        return r;
    };
    for (int iteration = 0; iteration < 100; ++iteration) {
        const Eigen::VectorXd r = residual(F);
        Eigen::MatrixXd slope(count, count);
        for (Eigen::Index i = 0; i < count; ++i) {
            Mat3 up = F, down = F;
            up(free[i], free[i]) *= std::exp(1e-6);
            down(free[i], free[i]) *= std::exp(-1e-6);
            slope.col(i) = (residual(up) - residual(down)) / 2e-6;
        }
        Eigen::VectorXd step = -slope.partialPivLu().solve(r);
        if (step.norm() > 0.1) step *= 0.1 / step.norm();
        for (Eigen::Index i = 0; i < count; ++i) F(free[i], free[i]) *= std::exp(step[i]);
        if (step.norm() < 1e-14) break;
    }
    return F;
}

}  // namespace myotet::muscle::kit
