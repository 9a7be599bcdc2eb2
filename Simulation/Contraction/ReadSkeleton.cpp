// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "Contraction/KeyFrames.h"
#include "Contraction/ReadParts.h"
#include "Contraction/Words.h"
#include "Skeleton/ReadOsim.h"
#include "Skeleton/Skeleton.h"
#include "Skeleton/Trajectory.h"

namespace myotet::contraction {
namespace fs = std::filesystem;

namespace {

constexpr Range kShift{-1e6, 1e6, true, "a length in mm"};
constexpr Range kAngle{-3600, 3600, true, "an angle in degrees"};
// Between keys a bone goes straight and turns evenly: of a turn of 200 degrees in a second
// about a joint 300 mm away that takes 0.01 mm off.
constexpr double kBetweenKeys = 0.005;  // s
constexpr double kMostKeys = 200000;
constexpr double kDegree = std::numbers::pi / 180;

// From the model's ground to the patient.
Pose read_place(const YamlTree& tree, const fs::path& file) {
    const Keys keys(tree, file, "'place'", {"translation", "rotation"});
    Pose place;
    if (keys.has("translation")) place.translation = keys.point("translation", kShift);
    if (const YamlTree* rotation = keys.find("rotation")) {
        const Keys turn(*rotation, file, "a rotation", {"axis", "angle_deg"});
        const double angle = turn.number("angle_deg", kAngle) * kDegree;
        place.rotation = Eigen::AngleAxisd(angle, turn.direction("axis")).toRotationMatrix();
    }
    return place;
}

KeyFrame key_of(double time, const Pose& moved, const Vec3& centre) {
    const Eigen::AngleAxisd turn(moved.rotation);
    KeyFrame key;
    key.time = time;
    key.centre = centre;
    key.translation = moved(centre) - centre;
    if (turn.angle() != 0) {
        key.axis = turn.axis();
        key.angle_deg = turn.angle() / kDegree;
    }
    return key;
}

struct Mover {
    skeleton::Model model;
    skeleton::Trajectory trajectory;
    Pose place;
};

Mover read_mover(const Keys& keys, const fs::path& file, Scene& scene) {
    Mover mover;
    scene.skeleton.model = keys.existing_file("model");
    mover.model = skeleton::read_osim(scene.skeleton.model);
    MotionRows rows;
    if (keys.one_of({"motion", "keys"}) == "keys") {
        rows = {read_key_frames(*keys.find("keys"), file), skeleton::key_framed()};
    } else {
        scene.skeleton.motion = keys.existing_file("motion");
        rows = read_motion_rows(scene.skeleton.motion);
    }
    mover.trajectory = trajectory_of(rows, mover.model,
                                     scene.skeleton.motion.empty() ? file : scene.skeleton.motion);
    if (!(mover.trajectory.times.front() <= 0 && mover.trajectory.times.back() >= scene.time.end) &&
        !mover.trajectory.at_rest)
        keys.refuse(*keys.find("motion"),
                    "the motion lies between " + shown(mover.trajectory.times.front()) + " and " +
                        shown(mover.trajectory.times.back()) +
                        " s, but the scene takes it from 0 to " + shown(scene.time.end) + " s");
    if (const YamlTree* place = keys.find("place")) mover.place = read_place(*place, file);
    return mover;
}

// Bodies of the bones that go with one; -1: none.
std::vector<int> bodies_of(const Scene& scene, const skeleton::Model& model) {
    std::vector<std::string> names;
    for (const skeleton::Body& body : model.bodies) names.push_back(body.name);
    std::vector<int> bodies;
    for (const Bone& bone : scene.bones) {
        const auto found = std::ranges::find(names, bone.body.name);
        if (!bone.body.name.empty() && found == names.end())
            refuse(scene, bone.body.line,
                   "the skeleton has no body '" + bone.body.name + "'" +
                       known_are(bone.body.name, names));
        bodies.push_back(bone.body.name.empty() ? -1 : static_cast<int>(found - names.begin()));
    }
    return bodies;
}

// Where a body's joint is in its own frame: it turns about that.
Vec3 joint_in(const skeleton::Model& model, int body) {
    for (const skeleton::Joint& joint : model.joints)
        if (joint.child == body) return joint.in_child.translation;
    return Vec3::Zero();
}

}  // namespace

void move_bones(const YamlTree& tree, const fs::path& file, Scene& scene) {
    const Keys keys(tree, file, "'skeleton'", {"model", "motion", "keys", "place"});
    scene.skeleton.line = tree.key_line;
    const Mover mover = read_mover(keys, file, scene);
    const std::vector<int> bodies = bodies_of(scene, mover.model);
    skeleton::Skeleton skeleton(mover.model);
    const auto poses_at = [&](double time) {
        skeleton.place(skeleton::at(mover.trajectory, time).values);
        return skeleton.poses();
    };
    const std::vector<Pose> rest = poses_at(0);
    const double steps = std::ceil(scene.time.end / scene.time.step - 1e-9);
    const double parts = std::clamp(std::ceil(scene.time.step / kBetweenKeys), 1.0,
                                    std::max(1.0, std::floor(kMostKeys / steps)));
    const auto count = static_cast<int>(steps * parts);
    for (int k = 1; k <= count; ++k) {
        const double time = std::min(scene.time.end, k * scene.time.step / parts);
        const std::vector<Pose> now = poses_at(time);
        for (std::size_t b = 0; b < scene.bones.size(); ++b) {
            if (bodies[b] < 0) continue;
            // P X(t) X(0)^-1 P^-1, P the model's place, X the body's.
            const Pose& at_rest = rest[bodies[b]];
            const Pose moved =
                mover.place * (now[bodies[b]] * at_rest.inverse()) * mover.place.inverse();
            const Vec3 centre = mover.place(at_rest(joint_in(mover.model, bodies[b])));
            Motion& motion = scene.bones[b].motion;
            if (motion.keys.empty()) motion.keys.push_back(key_of(0, Pose{}, centre));
            motion.keys.push_back(key_of(time, moved, centre));
        }
    }
}

}  // namespace myotet::contraction
