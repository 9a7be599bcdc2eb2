// SPDX-License-Identifier: Apache-2.0
#include "Activation/UnitsOf.h"

#include <map>

#include "Core/Errors.h"

namespace myotet::activation {
namespace {

// Damping below which OpenSim's muscles have none.
constexpr double kLeastDamping = 0.001;

// Sets numbers that the file has.
class Numbers {
public:
    explicit Numbers(const std::map<std::string, double>& numbers) : numbers_(numbers) {}

    bool set(double& value, const std::string& name) const {
        const auto found = numbers_.find(name);
        if (found == numbers_.end()) return false;
        value = found->second;
        return true;
    }

private:
    const std::map<std::string, double>& numbers_;
};

muscle::ThelenShape thelen_shape(const skeleton::Muscle& muscle) {
    const Numbers file(muscle.shape);
    muscle::ThelenShape shape;
    file.set(shape.KshapeActive, "KshapeActive");
    file.set(shape.KshapePassive, "KshapePassive");
    file.set(shape.FmaxMuscleStrain, "FmaxMuscleStrain");
    file.set(shape.FmaxTendonStrain, "FmaxTendonStrain");
    file.set(shape.Af, "Af");
    file.set(shape.Flen, "Flen");
    file.set(shape.fv_linear_extrap_threshold, "fv_linear_extrap_threshold");
    return shape;
}

muscle::MillardShape millard_shape(const skeleton::Muscle& muscle) {
    const Numbers file(muscle.shape);
    muscle::MillardShape shape;
    const std::string active = "ActiveForceLengthCurve/", passive = "FiberForceLengthCurve/";
    const std::string tendon = "TendonForceLengthCurve/", velocity = "ForceVelocityCurve/";
    file.set(shape.fiber_damping, "fiber_damping");
    if (shape.fiber_damping < kLeastDamping) shape.fiber_damping = 0;
    file.set(shape.min_norm_active_fiber_length, active + "min_norm_active_fiber_length");
    file.set(shape.transition_norm_fiber_length, active + "transition_norm_fiber_length");
    file.set(shape.max_norm_active_fiber_length, active + "max_norm_active_fiber_length");
    file.set(shape.shallow_ascending_slope, active + "shallow_ascending_slope");
    if (shape.fiber_damping == 0 && !muscle.rigid_tendon) {
        shape.minimum_value = 0.1;
        file.set(shape.minimum_value, active + "minimum_value");
    }
    file.set(shape.strain_at_zero_force, passive + "strain_at_zero_force");
    file.set(shape.strain_at_one_norm_force, passive + "strain_at_one_norm_force");
    shape.stiffness_at_one_norm_force =
        2 / (shape.strain_at_one_norm_force - shape.strain_at_zero_force);
    file.set(shape.stiffness_at_low_force, passive + "stiffness_at_low_force");
    file.set(shape.stiffness_at_one_norm_force, passive + "stiffness_at_one_norm_force");
    file.set(shape.passive_curviness, passive + "curviness");
    double& strain = shape.tendon_strain_at_one_norm_force;
    file.set(strain, tendon + "strain_at_one_norm_force");
    shape.tendon_stiffness_at_one_norm_force = 1.375 / strain;
    file.set(shape.tendon_stiffness_at_one_norm_force, tendon + "stiffness_at_one_norm_force");
    file.set(shape.norm_force_at_toe_end, tendon + "norm_force_at_toe_end");
    file.set(shape.tendon_curviness, tendon + "curviness");
    file.set(shape.concentric_slope_at_vmax, velocity + "concentric_slope_at_vmax");
    file.set(shape.concentric_slope_near_vmax, velocity + "concentric_slope_near_vmax");
    file.set(shape.isometric_slope, velocity + "isometric_slope");
    file.set(shape.eccentric_slope_at_vmax, velocity + "eccentric_slope_at_vmax");
    file.set(shape.eccentric_slope_near_vmax, velocity + "eccentric_slope_near_vmax");
    file.set(shape.max_eccentric_velocity_force_multiplier,
             velocity + "max_eccentric_velocity_force_multiplier");
    file.set(shape.concentric_curviness, velocity + "concentric_curviness");
    file.set(shape.eccentric_curviness, velocity + "eccentric_curviness");
    return shape;
}

}  // namespace

SkeletonUnit unit_of(const skeleton::Muscle& muscle, muscle::ThelenPassive form) {
    try {
        SkeletonUnit out;
        out.rigid_tendon = muscle.rigid_tendon;
        out.dynamics = {.rise = muscle.rise, .fall = muscle.fall};
        out.unit = {.strength = muscle.max_isometric_force,
                    .fibre_length = muscle.optimal_fibre_length,
                    .tendon_length = muscle.tendon_slack_length,
                    .pennation = muscle.pennation,
                    .max_speed = muscle.max_speed};
        if (muscle.type == "Thelen2003Muscle") {
            muscle::ThelenShape shape = thelen_shape(muscle);
            shape.passive_form = form;
            out.unit.curves = muscle::thelen2003_curves(shape);
        } else if (muscle.type.starts_with("Millard2012")) {
            out.unit.curves = muscle::millard2012_curves(millard_shape(muscle));
        } else {
            out.note = "muscle " + muscle.name + ": a " + muscle.type +
                       " has curves that are not known here; generic ones take their place";
        }
        out.unit.validate();
        out.dynamics.validate();
        return out;
    } catch (const InputError& error) {
        throw InputError("muscle " + muscle.name + ": " + error.what());
    }
}

std::vector<SkeletonUnit> units_of(const skeleton::Model& model, muscle::ThelenPassive form) {
    std::vector<SkeletonUnit> units;
    for (const skeleton::Muscle& muscle : model.muscles) units.push_back(unit_of(muscle, form));
    return units;
}

}  // namespace myotet::activation
