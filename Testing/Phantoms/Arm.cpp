// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "Phantoms/Scene.h"
#include "Phantoms/Shapes.h"

namespace myotet::phantoms {
namespace {

// Sizes follow an adult's right arm: humerus 320 mm long, epicondyles 56 mm
// wide, head 44 mm thick. All in mm.
const Vec3 kHeadCentre(9, 4, 292);
constexpr double kHeadRadius = 22;
// Trochlea and capitulum: a cylinder with round ends about the elbow's axis.
constexpr double kElbowHalfLength = 15, kElbowZ = 2, kElbowRadius = 10;
// Cartilage and joint space, which a scan leaves unlabelled.
constexpr double kJointGap = 2.5;

constexpr std::array<double, 3> kBone{0.89, 0.85, 0.73}, kTendon{0.93, 0.93, 0.82},
    kBiceps{0.76, 0.27, 0.22}, kTriceps{0.66, 0.20, 0.25};

double elbow_axis_distance(const Vec3& p) {
    const double x = std::max(std::abs(p.x()) - kElbowHalfLength, 0.0);
    return Vec3(x, p.y(), p.z() - kElbowZ).norm();
}

bool in_ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& semi_axes) {
    return (p - centre).cwiseQuotient(semi_axes).squaredNorm() <= 1;
}

Loft humerus_shaft() {
    return Loft({{6, 1, 0, 24, 8.5},
                 {20, 2, 0, 28, 8.5},  // epicondyles
                 {45, 1, 0, 17, 9},
                 {80, 0, 0, 11.5, 10},
                 {150, 0, 0, 11, 11},
                 {220, 0, 0, 12, 12},
                 {260, 0, 0, 15, 14.5},
                 {285, -1, 0, 21, 18},  // tubercles
                 {297, -1, 0, 21, 18}},
                8);
}

Loft ulna() {
    return Loft({{-95, 9, 8, 7.5, 7.5},
                 {-60, 8, 9, 8, 9},
                 {-30, 6, 11, 10.5, 12},
                 {-14, 4, 12, 11.5, 13},  // coronoid process
                 {0, 3, 17, 11, 9},
                 {14, 2, 18, 10, 6.5}},  // olecranon
                5);
}

Loft radius() {
    return Loft({{-95, -10, 2, 7.5, 7},
                 {-45, -9, 0, 7.5, 7.5},
                 {-28, -9, -1, 7, 7},  // neck
                 {-20, -9, 0, 10.5, 10.5},
                 {-14, -9, 0, 10.5, 10.5}},  // head
                2.5);
}

Loft biceps() {
    return Loft({{70, 0, -19, 7, 5},
                 {95, 0, -19.5, 17, 13},
                 {130, 0, -19.5, 25, 21},
                 {160, 0, -19, 28, 26},
                 {190, 0, -19.5, 25.5, 23},
                 {215, -1, -19.5, 17, 14},
                 {235, -3, -19, 7, 6}},
                8, 2.5);
}

Loft biceps_tendon_proximal() {
    return Loft({{222, -3, -19, 4.5, 3.5},
                 {245, -3, -19, 4.5, 3.5},
                 {265, -4, -18.5, 4.5, 3.5},
                 {283, -3, -18, 4.5, 3.5},  // in the groove between the tubercles
                 {296, -2, -13, 4, 3.5}},
                3);
}

Loft biceps_tendon_distal() {
    return Loft({{-41, -6, -4.5, 3.5, 3},  // in the radial tuberosity
                 {-25, -6, -14, 4.8, 3.7},
                 {-5, -4, -17.5, 5.2, 3.7},
                 {30, -1, -17.5, 5.5, 3.7},
                 {58, 0, -19, 5.8, 3.8},
                 {85, 0, -19, 5.5, 3.7}},
                3);
}

Loft triceps() {
    return Loft({{55, 1, 19.5, 12, 5},
                 {80, 1, 19.5, 20, 11},
                 {115, 1, 20.5, 27, 18},
                 {155, 1, 22, 30, 20},
                 {195, 1, 21.5, 28, 19.5},
                 {230, 1, 19, 20, 14},
                 {252, 1, 18, 10, 6}},
                8, 2.5);
}

Loft triceps_tendon_proximal() {
    return Loft({{236, 1, 18, 6.5, 3.7}, {261, 1, 18, 7, 3.7}, {282, 1, 16.5, 7, 3.5}}, 3);
}

Loft triceps_tendon_distal() {
    return Loft({{2, 2, 25, 8, 3.4},  // on the olecranon
                 {14, 2, 24, 9, 3.5},
                 {30, 1.5, 21, 10, 3.6},
                 {50, 1, 19.5, 11, 3.8},
                 {80, 1, 19.5, 9, 3.7}},
                3);
}

Tissue make_tissue(std::int32_t label, LabelName name, double true_volume,
                   std::function<bool(const Vec3&)> contains) {
    Tissue tissue;
    tissue.label = label;
    tissue.name = std::move(name);
    tissue.true_volume = true_volume;
    tissue.contains = std::move(contains);
    return tissue;
}

Tissue make_tissue(std::int32_t label, LabelName name, double true_volume, Loft loft) {
    return make_tissue(label, std::move(name), true_volume,
                       [loft = std::move(loft)](const Vec3& p) { return loft.contains(p); });
}

}  // namespace

Scene arm_scene() {
    Scene scene;
    scene.box.min = Vec3(-32, -48, -101);
    scene.box.max = Vec3(34, 49, 315);
    const auto in_humerus = [shaft = humerus_shaft()](const Vec3& p) {
        return elbow_axis_distance(p) <= kElbowRadius ||
               sphere_distance(p, kHeadCentre, kHeadRadius) <= 0 || shaft.contains(p);
    };
    const auto in_forearm = [ulna = ulna(), radius = radius()](const Vec3& p) {
        return elbow_axis_distance(p) > kElbowRadius + kJointGap &&
               (ulna.contains(p) || radius.contains(p) ||
                in_ellipsoid(p, Vec3(-5, -5, -40), Vec3(6, 6, 9)));  // radial tuberosity
    };
    // True volumes: sums over cells of 0.2 mm; a test checks them on a coarser grid.
    std::vector<Tissue>& tissues = scene.tissues;
    tissues.push_back(make_tissue(1, {"humerus", kBone}, 191600, in_humerus));
    tissues.push_back(make_tissue(2, {"radius_ulna", kBone}, 48963, in_forearm));
    tissues.push_back(
        make_tissue(11, {"biceps_tendon_proximal", kTendon}, 3067.3, biceps_tendon_proximal()));
    tissues.push_back(
        make_tissue(12, {"biceps_tendon_distal", kTendon}, 7636.6, biceps_tendon_distal()));
    tissues.push_back(
        make_tissue(21, {"triceps_tendon_proximal", kTendon}, 3176.5, triceps_tendon_proximal()));
    tissues.push_back(
        make_tissue(22, {"triceps_tendon_distal", kTendon}, 8505.7, triceps_tendon_distal()));
    tissues.push_back(make_tissue(20, {"triceps", kTriceps}, 246689, triceps()));
    tissues.push_back(make_tissue(10, {"biceps", kBiceps}, 202615, biceps()));
    return scene;
}

}  // namespace myotet::phantoms
