// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "Elasticity/VolumeLaw.h"

namespace myotet::muscle {

/// By which curve fibres pull, stretched by l; x = l / optimal_stretch.
enum class FibreCurve {
    none,            ///< no fibres: isotropic tissue
    blemker_muscle,  ///< P1 (exp(P2 (x - 1)) - 1), and active: parabolas with kinks
    teran_muscle,    ///< P1 (exp(P2 (x - 1)) - P2 (x - 1) - 1), and active: without kinks
    blemker_tendon,  ///< Cauchy stress L1 (exp(L2 (l - 1)) - 1)
    teran_tendon,    ///< nominal stress L1 (exp(L2 (l - 1)) - L2 (l - 1) - 1), no kink
};

/// Of which stretch the curve is.
enum class FibreStretch {
    full,       ///< |F a0|
    isochoric,  ///< |F a0| J^(-1/3): pulling fibres do not compress the tissue
};

/// What a tissue is made of. A constant that is 0 is not given; only those that its curve
/// uses may be, see constants_of(). Sets with names, and where they come from, are in
/// Data/materials. Formulas: Muscle/Parts.h and Muscle/Curves.h.
struct TissueMaterial {
    FibreCurve fibres = FibreCurve::none;
    FibreStretch fibre_stretch = FibreStretch::full;
    elasticity::VolumeForm volume = elasticity::VolumeForm::log_squared;

    double C1 = 0, C2 = 0;       ///< MPa, Mooney-Rivlin matrix
    double G1 = 0, G2 = 0;       ///< MPa, shear along and across fibres
    double bulk = 0;             ///< MPa, resistance to a change of volume
    double sigma_max = 0;        ///< MPa, greatest active stress of undeformed area
    double optimal_stretch = 1;  ///< l where that is; 1: as in the scan
    double P1 = 0, P2 = 0;       ///< passive curve of muscle, a part of sigma_max
    double L1 = 0;               ///< MPa, tendon
    double L2 = 0;               ///< tendon
    double linear_stretch = 0;   ///< l from which the passive curve or tendon is straight

    /// Throws InputError naming the constant, its value and the rule, also where a
    /// constant is given that would do nothing.
    void validate() const;
};

/// A constant as users know it.
struct ConstantInfo {
    std::string_view name, unit, meaning;
};
/// All there are, and those that this material uses: its curve decides.
[[nodiscard]] std::vector<ConstantInfo> all_constants();
[[nodiscard]] std::vector<ConstantInfo> constants_of(const TissueMaterial& material);

/// Sets one constant by its name; its curve must have been chosen before. Throws InputError
/// that lists the names known where this one is not, or is not used with the curve.
void set_constant(TissueMaterial& material, std::string_view name, double value);
/// Throws InputError as set_constant does.
[[nodiscard]] double constant(const TissueMaterial& material, std::string_view name);

/// A choice among words: fibres, fibre_stretch, volume.
struct ChoiceInfo {
    std::string_view name;
    std::span<const std::string_view> words;
};
[[nodiscard]] std::span<const ChoiceInfo> all_choices();
/// Sets one by its name and word, such as "fibres", "teran_muscle". Throws InputError that
/// lists the names or words known.
void set_choice(TissueMaterial& material, std::string_view name, std::string_view word);

/// Says in a sentence why equilibria of a tissue of this material need not exist or be
/// unique, or nothing: fibres that pull by their isochoric stretch without a matrix between
/// them. That stretch is not convex in F and J, and where the active curve is flat or falls
/// nothing else resists stretch along the fibres.
[[nodiscard]] std::string ill_posed(const TissueMaterial& material);

}  // namespace myotet::muscle
