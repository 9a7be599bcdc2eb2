// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Skeleton.h"

#include <algorithm>
#include <string>

#include "Core/Errors.h"
#include "Core/Text.h"

// The library is built with its checks, on which the layout of its states depends: seen
// without them here, they would be torn.
#undef NDEBUG

namespace SimTK {
/// Simbody 3.7's indices compare with numbers, which C++20 takes both ways round: two of them
/// would be ambiguous without this.
template <class Index>
requires requires(const Index& index) { index.isValidExtended(); }
bool operator==(const Index& a, const Index& b) { return int(a) == int(b); }
}  // namespace SimTK

#include <Simbody.h>

namespace myotet::skeleton {
namespace {

SimTK::Vec3 to_simbody(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 from_simbody(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }

SimTK::Transform to_simbody(const Pose& pose) {
    SimTK::Mat33 r;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) r(i, j) = pose.rotation(i, j);
    return {SimTK::Rotation(r, true), to_simbody(pose.translation)};
}

Pose from_simbody(const SimTK::Transform& x) {
    Pose pose;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) pose.rotation(i, j) = x.R()[i][j];
    pose.translation = from_simbody(x.p());
    return pose;
}

/// Ours is about the mass center, Simbody's about the body's origin.
SimTK::MassProperties mass_of(const Body& body) {
    const Vec3& c = body.mass_center;
    const Mat3 i =
        body.inertia + body.mass * (c.squaredNorm() * Mat3::Identity() - c * c.transpose());
    const auto wrong = [&](const char* why) {
        throw InputError("the body '" + body.name + "' " + why);
    };
    if (!(body.mass >= 0) || !c.allFinite() || !i.allFinite())
        wrong("has a mass less than 0, or one, a mass center or an inertia that is not finite");
    if (body.mass == 0 && !body.inertia.isZero(0))
        wrong("has inertia but no mass; give it mass, or take its inertia away");
    const double slop = 1e-8 * i.trace();  // of files that round, half of Simbody's
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, d = (a + 2) % 3;
        if (!(i(a, a) <= i(b, b) + i(d, d) + slop) || !(2 * std::abs(i(b, d)) <= i(a, a) + slop))
            wrong(
                "has moments of inertia that no mass can have, one being more than the other two "
                "together or a product too large; correct them");
    }
    return {body.mass, to_simbody(c),
            SimTK::Inertia(i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2))};
}

/// A freedom's function as Simbody asks for it.
class CoordinateFunction : public SimTK::Function {
public:
    explicit CoordinateFunction(const skeleton::Function& function, bool constant)
        : function_(function), constant_(constant) {}

    SimTK::Real calcValue(const SimTK::Vector& x) const override { return at(x).value; }
    SimTK::Real calcDerivative(const SimTK::Array_<int>& order,
                               const SimTK::Vector& x) const override {
        const FunctionValue value = at(x);
        return order.size() == 1 ? value.slope : value.bend;
    }
    int getArgumentSize() const override { return constant_ ? 0 : 1; }
    int getMaxDerivativeOrder() const override { return 2; }

private:
    [[nodiscard]] FunctionValue at(const SimTK::Vector& x) const {
        return evaluate(function_, constant_ ? 0 : x[0]);
    }
    skeleton::Function function_;
    bool constant_;
};

const Freedom& freedom_of(const Joint& joint, std::size_t i) {
    return i < 3 ? joint.rotations[i] : joint.translations[i - 3];
}

/// The coordinates that a joint's freedoms follow, each once.
std::vector<int> coordinates_of(const Joint& joint) {
    std::vector<int> found;
    for (std::size_t i = 0; i < 6; ++i) {
        const int coordinate = freedom_of(joint, i).coordinate;
        if (coordinate >= 0 && std::ranges::find(found, coordinate) == found.end())
            found.push_back(coordinate);
    }
    return found;
}

/// What Simbody would stop the program for.
void check(const Model& model, const Joint& joint) {
    const auto wrong = [&](const std::string& why) {
        throw InputError("the joint '" + joint.name + "' " + why);
    };
    const auto is_body = [&](int b) { return b >= 0 && std::size_t(b) < model.bodies.size(); };
    if (!is_body(joint.parent) || !is_body(joint.child)) wrong("joins bodies that are not there");
    for (const Pose& pose : {joint.in_parent, joint.in_child})
        if (!pose.rotation.allFinite() || !pose.translation.allFinite())
            wrong("has a frame that is not finite");
    for (std::size_t i = 0; i < 6; ++i) {
        const Vec3& axis = freedom_of(joint, i).axis;
        const Vec3& next = freedom_of(joint, i < 3 ? (i + 1) % 3 : 3 + (i + 1) % 3).axis;
        constexpr double kUnit = 1e-6, kParallel = 1e-5;  // sine of the angle
        if (!(std::abs(axis.norm() - 1) < kUnit)) wrong("has an axis that is no unit vector");
        if (!(axis.cross(next).norm() > kParallel))
            wrong("has parallel axes; let its turns and its shifts span three directions each");
        if (freedom_of(joint, i).coordinate >= static_cast<int>(model.coordinates.size()))
            wrong("follows a coordinate that is not there");
    }
}

/// Where a joint without coordinates holds its child's frame in the parent's.
Pose held(const Joint& joint) {
    Pose pose;
    for (const Freedom& shift : joint.translations)
        pose.translation += evaluate(shift.function, 0).value * shift.axis;
    for (const Freedom& turn : joint.rotations)
        pose.rotation =
            pose.rotation * Eigen::AngleAxisd(evaluate(turn.function, 0).value, turn.axis);
    return pose;
}

}  // namespace

struct Skeleton::Impl {
    explicit Impl(const Model& model);

    void add_joint(const Model& model, const Joint& joint);
    void set(std::span<const double> values);
    [[nodiscard]] SimTK::Vector to_speeds(std::span<const double> numbers) const;
    [[nodiscard]] SimTK::Vector_<SimTK::SpatialVec> weights() const;

    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter{system};
    SimTK::State state;
    std::vector<SimTK::MobilizedBodyIndex> bodies;  ///< one a body of the model
    /// [coordinate]: the joint's body and which of its own coordinates it is; not valid for
    /// one that moves nothing.
    std::vector<std::pair<SimTK::MobilizedBodyIndex, int>> coordinates;
    std::vector<int> slots;  ///< [coordinate] among the speeds of Simbody; -1: none
    SimTK::Vec3 gravity;
    std::vector<Pose> poses;
};

Skeleton::Impl::Impl(const Model& model)
    : bodies(model.bodies.size()),
      coordinates(model.coordinates.size()),
      slots(model.coordinates.size(), -1),
      gravity(to_simbody(model.gravity)),
      poses(model.bodies.size()) {
    bodies[0] = matter.Ground().getMobilizedBodyIndex();
    for (const Joint& joint : model.joints) add_joint(model, joint);
    system.realizeTopology();
    state = system.getDefaultState();
    system.realizeModel(state);
    for (std::size_t c = 0; c < slots.size(); ++c)
        if (coordinates[c].first.isValid())
            slots[c] = matter.getMobilizedBody(coordinates[c].first).getFirstUIndex(state) +
                       coordinates[c].second;
}

void Skeleton::Impl::add_joint(const Model& model, const Joint& joint) {
    check(model, joint);
    const auto parent_index = static_cast<std::size_t>(joint.parent);
    const auto child_index = static_cast<std::size_t>(joint.child);
    if (!bodies[parent_index].isValid() || bodies[child_index].isValid())
        throw InputError("the joint '" + joint.name +
                         "' stands before the one that moves its parent, or moves a body that "
                         "another moves; sort the joints from the ground outwards");
    SimTK::MobilizedBody& parent = matter.updMobilizedBody(bodies[parent_index]);
    const SimTK::Body::Rigid body(mass_of(model.bodies[child_index]));
    const auto own = coordinates_of(joint);
    for (const int c : own)
        if (coordinates[static_cast<std::size_t>(c)].first.isValid())
            throw InputError("the coordinate '" +
                             model.coordinates[static_cast<std::size_t>(c)].name +
                             "' moves two joints; give each joint its own");
    if (own.empty()) {
        bodies[child_index] = SimTK::MobilizedBody::Weld(
            parent, to_simbody(joint.in_parent * held(joint)), body, to_simbody(joint.in_child));
        return;
    }
    SimTK::Array_<const SimTK::Function*> functions;
    SimTK::Array_<SimTK::Array_<int>> arguments(6);
    SimTK::Array_<SimTK::Vec3> axes;
    for (std::size_t i = 0; i < 6; ++i) {
        const Freedom& freedom = freedom_of(joint, i);
        functions.push_back(new CoordinateFunction(freedom.function, freedom.coordinate < 0));
        axes.push_back(to_simbody(freedom.axis));
        const auto which = std::ranges::find(own, freedom.coordinate) - own.begin();
        if (freedom.coordinate >= 0)
            arguments[static_cast<int>(i)].push_back(static_cast<int>(which));
    }
    bodies[child_index] = SimTK::MobilizedBody::FunctionBased(
        parent, to_simbody(joint.in_parent), body, to_simbody(joint.in_child),
        static_cast<int>(own.size()), functions, arguments, axes);
    for (std::size_t i = 0; i < own.size(); ++i)
        coordinates[static_cast<std::size_t>(own[i])] = {bodies[child_index], static_cast<int>(i)};
}

SimTK::Vector Skeleton::Impl::to_speeds(std::span<const double> numbers) const {
    MYOTET_CHECK(numbers.size() == slots.size(), "a number a coordinate");
    SimTK::Vector u(matter.getNumMobilities(), 0.0);
    for (std::size_t c = 0; c < slots.size(); ++c) {
        if (!std::isfinite(numbers[c]))
            throw InputError("coordinate " + std::to_string(c + 1) + " is to have " +
                             shown(numbers[c]) + "; give finite values, speeds and accelerations");
        if (slots[c] >= 0) u[slots[c]] = numbers[c];
    }
    return u;
}

void Skeleton::Impl::set(std::span<const double> values) {
    // A joint's coordinates are as many as its speeds, so that both stand in the same order.
    state.updQ() = to_speeds(values);
    system.realize(state, SimTK::Stage::Position);
    for (std::size_t b = 0; b < bodies.size(); ++b)
        poses[b] = from_simbody(matter.getMobilizedBody(bodies[b]).getBodyTransform(state));
}

/// Of each body at its origin.
SimTK::Vector_<SimTK::SpatialVec> Skeleton::Impl::weights() const {
    SimTK::Vector_<SimTK::SpatialVec> forces(matter.getNumBodies(),
                                             SimTK::SpatialVec(SimTK::Vec3(0), SimTK::Vec3(0)));
    for (const auto index : bodies) {
        const SimTK::MobilizedBody& body = matter.getMobilizedBody(index);
        if (body.isGround()) continue;
        const SimTK::Vec3 arm = body.getBodyRotation(state) * body.getBodyMassCenterStation(state);
        const SimTK::Vec3 weight = body.getBodyMass(state) * gravity;
        forces[index] = SimTK::SpatialVec(SimTK::cross(arm, weight), weight);
    }
    return forces;
}

Skeleton::Skeleton(const Model& model) {
    try {
        impl_ = std::make_unique<Impl>(model);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError("the skeleton '" + model.name + "' cannot move as told: " + error.what());
    }
    std::vector<double> at_rest;
    for (const Coordinate& coordinate : model.coordinates) at_rest.push_back(coordinate.at_rest);
    place(at_rest);
}

Skeleton::~Skeleton() = default;
Skeleton::Skeleton(Skeleton&&) noexcept = default;
Skeleton& Skeleton::operator=(Skeleton&&) noexcept = default;

void Skeleton::place(std::span<const double> values) { impl_->set(values); }

const std::vector<Pose>& Skeleton::poses() const { return impl_->poses; }

std::vector<std::vector<BodyRate>> Skeleton::rates() {
    std::vector<std::vector<BodyRate>> rates(impl_->slots.size(),
                                             std::vector<BodyRate>(impl_->bodies.size()));
    SimTK::Vector_<SimTK::SpatialVec> moved;
    for (std::size_t c = 0; c < rates.size(); ++c) {
        if (impl_->slots[c] < 0) continue;
        SimTK::Vector u(impl_->matter.getNumMobilities(), 0.0);
        u[impl_->slots[c]] = 1;
        impl_->matter.multiplyBySystemJacobian(impl_->state, u, moved);
        for (std::size_t b = 0; b < impl_->bodies.size(); ++b) {
            const SimTK::SpatialVec& v = moved[impl_->bodies[b]];
            rates[c][b] = {from_simbody(v[0]), from_simbody(v[1])};
        }
    }
    return rates;
}

std::vector<double> Skeleton::inverse_dynamics(std::span<const double> values,
                                               std::span<const double> speeds,
                                               std::span<const double> accelerations) {
    Impl& m = *impl_;
    m.set(values);
    m.state.updU() = m.to_speeds(speeds);
    m.system.realize(m.state, SimTK::Stage::Velocity);
    SimTK::Vector along;
    m.matter.calcResidualForceIgnoringConstraints(m.state, SimTK::Vector(), m.weights(),
                                                  m.to_speeds(accelerations), along);
    std::vector<double> forces(m.slots.size(), 0);
    for (std::size_t c = 0; c < forces.size(); ++c)
        if (m.slots[c] >= 0) forces[c] = along[m.slots[c]];
    return forces;
}

}  // namespace myotet::skeleton
