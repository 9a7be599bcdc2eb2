// SPDX-License-Identifier: Apache-2.0
#include "Muscle/TissueMaterial.h"

#include <algorithm>
#include <array>

#include "Muscle/Require.h"

namespace myotet::muscle {
namespace {

using elasticity::VolumeForm;
using namespace std::string_view_literals;

// An exponential beyond this exponent is out of a double's reach before long.
constexpr double kMostExponent = 500;

bool is_muscle(FibreCurve curve) {
    return curve == FibreCurve::blemker_muscle || curve == FibreCurve::teran_muscle;
}
bool is_tendon(FibreCurve curve) {
    return curve == FibreCurve::blemker_tendon || curve == FibreCurve::teran_tendon;
}

enum class Use { always, with_fibres, in_muscle, in_tendon };
bool used(Use use, FibreCurve curve) {
    switch (use) {
        case Use::with_fibres:
            return curve != FibreCurve::none;
        case Use::in_muscle:
            return is_muscle(curve);
        case Use::in_tendon:
            return is_tendon(curve);
        case Use::always:
            break;
    }
    return true;
}

struct Constant {
    ConstantInfo info;
    double TissueMaterial::*member;
    Use use;
};
using Tissue = TissueMaterial;
constexpr std::array kConstants = {
    Constant{
        {"C1", "MPa", "matrix, first constant of Mooney and Rivlin"}, &Tissue::C1, Use::always},
    Constant{{"C2", "MPa", "matrix, second constant"}, &Tissue::C2, Use::always},
    Constant{{"bulk", "MPa", "resistance to a change of volume"}, &Tissue::bulk, Use::always},
    Constant{{"G1", "MPa", "shear along the fibres"}, &Tissue::G1, Use::with_fibres},
    Constant{{"G2", "MPa", "shear across the fibres"}, &Tissue::G2, Use::with_fibres},
    Constant{{"sigma_max", "MPa", "greatest active stress of undeformed area"},
             &Tissue::sigma_max,
             Use::in_muscle},
    Constant{{"optimal_stretch", "1", "fibre stretch at which active stress is greatest"},
             &Tissue::optimal_stretch,
             Use::in_muscle},
    Constant{{"P1", "1", "passive muscle, factor of the exponential, a part of sigma_max"},
             &Tissue::P1,
             Use::in_muscle},
    Constant{{"P2", "1", "passive muscle, rate of the exponential"}, &Tissue::P2, Use::in_muscle},
    Constant{{"L1", "MPa", "tendon, factor of the exponential"}, &Tissue::L1, Use::in_tendon},
    Constant{{"L2", "1", "tendon, rate of the exponential"}, &Tissue::L2, Use::in_tendon},
    Constant{{"linear_stretch", "1", "fibre stretch from which passive stress is straight"},
             &Tissue::linear_stretch,
             Use::with_fibres},
};

constexpr std::array kCurveWords = {"none"sv, "blemker_muscle"sv, "teran_muscle"sv,
                                    "blemker_tendon"sv, "teran_tendon"sv};
constexpr std::array kStretchWords = {"full"sv, "isochoric"sv};
constexpr std::array kVolumeWords = {"log_squared"sv, "log_and_square"sv, "squared"sv};
constexpr std::array kChoices = {ChoiceInfo{"fibres", kCurveWords},
                                 ChoiceInfo{"fibre_stretch", kStretchWords},
                                 ChoiceInfo{"volume", kVolumeWords}};

template <class List, class NameOf>
std::string joined(const List& list, NameOf&& name_of) {
    std::string text;
    for (const auto& entry : list) {
        if (!text.empty()) text += ", ";
        text += name_of(entry);
    }
    return text;
}

std::string_view word_of(FibreCurve curve) { return kCurveWords[static_cast<std::size_t>(curve)]; }

const Constant& find_constant(const TissueMaterial& material, std::string_view name) {
    for (const Constant& c : kConstants)
        if (c.info.name == name && used(c.use, material.fibres)) return c;
    throw InputError("'" + std::string(name) + "' is no constant of a tissue with fibres '" +
                     std::string(word_of(material.fibres)) + "'; those are " +
                     joined(constants_of(material),
                            [](const ConstantInfo& info) { return std::string(info.name); }));
}

void check_muscle(const TissueMaterial& m) {
    require(m.sigma_max > 0, "sigma_max", m.sigma_max, "muscle needs it positive, in MPa");
    require(m.optimal_stretch > 0, "optimal_stretch", m.optimal_stretch, "it must be positive");
    require(m.P1 > 0, "P1", m.P1, "muscle needs it positive");
    require(m.P2 > 0, "P2", m.P2, "muscle needs it positive");
    require(m.linear_stretch >= m.optimal_stretch, "linear_stretch", m.linear_stretch,
            "it must not be less than optimal_stretch, where passive stress begins");
    require(m.P2 * (m.linear_stretch / m.optimal_stretch) < kMostExponent, "P2", m.P2,
            "times linear_stretch / optimal_stretch it must be less than 500");
}

void check_tendon(const TissueMaterial& m) {
    require(m.L1 > 0, "L1", m.L1, "tendon needs it positive, in MPa");
    require(m.L2 > 0, "L2", m.L2, "tendon needs it positive");
    require(m.linear_stretch >= 1, "linear_stretch", m.linear_stretch,
            "it must be at least 1, where a tendon begins to resist");
    require(m.L2 * m.linear_stretch < kMostExponent, "L2", m.L2,
            "times linear_stretch it must be less than 500");
}

}  // namespace

void TissueMaterial::validate() const {
    static const TissueMaterial kUntouched;
    for (const Constant& c : kConstants) {
        const double value = this->*c.member;
        require(used(c.use, fibres) || value == kUntouched.*c.member, c.info.name, value,
                "a tissue with fibres '" + std::string(word_of(fibres)) +
                    "' does not use it; leave it away or choose other fibres");
        require(value >= 0 && value < 1e12, c.info.name, value,
                "it must be a finite number that is not negative");
    }
    require(bulk > 0, "bulk", bulk, "it must be positive, in MPa");
    if (is_muscle(fibres)) check_muscle(*this);
    if (is_tendon(fibres)) check_tendon(*this);
    require(fibres != FibreCurve::none || C1 + C2 > 0, "C1 + C2", C1 + C2,
            "tissue without fibres needs it positive, in MPa");
}

std::vector<ConstantInfo> all_constants() {
    std::vector<ConstantInfo> all;
    for (const Constant& c : kConstants) all.push_back(c.info);
    return all;
}

std::vector<ConstantInfo> constants_of(const TissueMaterial& material) {
    std::vector<ConstantInfo> some;
    for (const Constant& c : kConstants)
        if (used(c.use, material.fibres)) some.push_back(c.info);
    return some;
}

void set_constant(TissueMaterial& material, std::string_view name, double value) {
    material.*find_constant(material, name).member = value;
}

double constant(const TissueMaterial& material, std::string_view name) {
    return material.*find_constant(material, name).member;
}

std::span<const ChoiceInfo> all_choices() { return kChoices; }

void set_choice(TissueMaterial& material, std::string_view name, std::string_view word) {
    const auto named = [](const ChoiceInfo& info) { return std::string(info.name); };
    const auto same = [](std::string_view text) { return std::string(text); };
    const auto choice = std::find_if(kChoices.begin(), kChoices.end(),
                                     [&](const ChoiceInfo& info) { return info.name == name; });
    if (choice == kChoices.end())
        throw InputError("'" + std::string(name) + "' is no choice of a tissue; those are " +
                         joined(kChoices, named));
    const auto found = std::find(choice->words.begin(), choice->words.end(), word);
    if (found == choice->words.end())
        throw InputError(std::string(name) + " is '" + std::string(word) +
                         "', but it must be one of " + joined(choice->words, same));
    const auto index = found - choice->words.begin();
    if (name == "fibres")
        material.fibres = static_cast<FibreCurve>(index);
    else if (name == "fibre_stretch")
        material.fibre_stretch = static_cast<FibreStretch>(index);
    else
        material.volume = static_cast<VolumeForm>(index);
}

std::string ill_posed(const TissueMaterial& material) {
    const bool pulls = material.fibres != FibreCurve::none;
    if (!pulls || material.fibre_stretch == FibreStretch::full || material.C1 + material.C2 > 0)
        return {};
    return "fibres pull by their isochoric stretch and no matrix is between them (C1 and C2 are "
           "0): equilibria need not exist or be unique; give C1 or C2, or choose the full stretch";
}

}  // namespace myotet::muscle
