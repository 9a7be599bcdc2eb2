// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "Contraction/Keys.h"
#include "MeshFiles/MeshFiles.h"
#include "Play/PlayScene.h"

namespace myotet::play {
namespace fs = std::filesystem;

namespace {

using contraction::Keys;
using contraction::kSeconds;
using contraction::kSecondsOrZero;
using repair::kCoordinate;
using repair::kLength;
using repair::kLengthOrZero;
using repair::Range;
using repair::YamlTree;
using Kind = YamlTree::Kind;

constexpr double kTonnePerCubicMm = 1e-12;  // of a kg/m^3
constexpr double kTonne = 1e-3;             // of a kg
constexpr Range kShift{-1e5, 1e5, true, "a length in mm"};
constexpr Range kSpeed{-1e6, 1e6, true, "a speed in mm/s"};
constexpr Range kAngle{-3600, 3600, true, "an angle in degrees"};
constexpr Range kAcceleration{-1e8, 1e8, true, "an acceleration in mm/s^2"};
constexpr Range kDensity{0, 1e5, false, "a density in kg/m^3 above 0"};
constexpr Range kMass{0, 1e6, false, "a mass in kg above 0"};
constexpr Range kModulus{0, 1e6, false, "a Young's modulus in MPa above 0"};
constexpr Range kPoisson{0, 0.499, true, "a Poisson's ratio from 0 to 0.499"};
constexpr Range kPerDepth{0, 1e6, false, "a pressure a depth in MPa/mm above 0"};
constexpr Range kFriction{0, 10, true, "a coefficient from 0 to 10"};

Mat3 read_rotation(const YamlTree& tree, const fs::path& file) {
    const Keys keys(tree, file, "a rotation", {"axis", "angle_deg"});
    const Vec3 axis = keys.direction("axis");
    return Eigen::AngleAxisd(keys.number("angle_deg", kAngle) * M_PI / 180, axis)
        .toRotationMatrix();
}

Place read_place(const YamlTree& tree, const fs::path& file) {
    const Keys keys(tree, file, "a place", {"translation", "rotation", "velocity"});
    Place place;
    if (keys.has("translation")) place.pose.translation = keys.point("translation", kShift);
    if (const YamlTree* turn = keys.find("rotation"))
        place.pose.rotation = read_rotation(*turn, file);
    if (keys.has("velocity")) place.velocity = keys.point("velocity", kSpeed);
    return place;
}

NearPlane read_near_plane(const YamlTree& tree, const fs::path& file, const std::string& place) {
    const Keys keys(tree, file, place, {"point", "normal", "within"});
    return {keys.point("point", kCoordinate), keys.direction("normal"),
            keys.number("within", kLengthOrZero), tree.key_line > 0 ? tree.key_line : tree.line};
}

SoftMaterial read_soft(const YamlTree& tree, const fs::path& file) {
    const Keys keys(tree, file, "'soft'", {"young", "poisson"});
    SoftMaterial soft;
    soft.young = keys.number("young", kModulus);
    soft.poisson = keys.number_or("poisson", kPoisson, soft.poisson);
    return soft;
}

contraction::Curve read_activation(const Keys& keys, SceneMuscle& muscle, const std::string& name) {
    constexpr const char* kRule =
        "a number from 0 to 1, a list of [time, value], or {file: FILE, muscle: NAME}";
    const YamlTree& tree = *keys.find("activation");
    if (tree.kind == Kind::map) {
        const Keys from(tree, keys.file(), "an activation", {"file", "muscle"});
        muscle.activation_file = from.existing_file("file");
        return contraction::read_activation(
            muscle.activation_file,
            from.has("muscle") ? from.word("muscle", "a column's name or number").name : name);
    }
    contraction::Curve curve;
    const auto add = [&](const YamlTree& at, double time, double value) {
        const std::string wrong = contraction::add_activation(curve, time, value);
        if (!wrong.empty()) keys.refuse(at, "in 'activation' " + wrong);
    };
    if (tree.kind != Kind::list) {
        add(tree, 0, keys.number("activation", {0, 1, true, kRule}));
        return curve;
    }
    for (const YamlTree& row : tree.items) {
        if (row.kind != Kind::list || row.items.size() != 2)
            keys.refuse_value(row, "activation", kRule);
        add(row, keys.number_in(row.items[0], "activation", {-1e6, 1e6, true, "a time in s"}),
            keys.number_in(row.items[1], "activation", {0, 1, true, "a value from 0 to 1"}));
    }
    if (curve.times.empty()) keys.refuse_value(tree, "activation", kRule);
    return curve;
}

SceneMuscle read_muscle(const Keys& keys, const std::string& name) {
    SceneMuscle muscle;
    muscle.model = keys.word("muscle", "the name of a model, such as teran2003_muscle");
    Keys fibres(keys.require("fibres", "{from: laplace, origin: PLANE, insertion: PLANE}"),
                keys.file(), "fibres", {"from", "direction", "origin", "insertion"});
    (void)fibres.require("from", "laplace or constant");
    if (fibres.choice_or("from", true, {{"laplace", true}, {"constant", false}})) {
        fibres.only("fibres from laplace", {"from", "origin", "insertion"});
        constexpr const char* kRule = "{point: [x, y, z], normal: [x, y, z], within: mm}";
        muscle.origin = read_near_plane(fibres.require("origin", kRule), keys.file(), "an origin");
        muscle.insertion =
            read_near_plane(fibres.require("insertion", kRule), keys.file(), "an insertion");
    } else {
        fibres.only("constant fibres", {"from", "direction"});
        muscle.direction = fibres.direction("direction");
    }
    if (keys.has("activation")) muscle.activation = read_activation(keys, muscle, name);
    muscle.patches = keys.choice_or("elements", true, {{"patches", true}, {"linear", false}});
    return muscle;
}

fs::path file_of(const Keys& keys, const std::string& key, meshfiles::Holds holds,
                 const char* rule) {
    const fs::path file = keys.existing_file(key);
    const std::string extension = lower(file.extension().string());
    for (const meshfiles::Format& format : meshfiles::formats())
        if (format.holds == holds && extension == format.extension) return file;
    if (holds == meshfiles::Holds::surface && meshfiles::is_surface_file(file)) return file;
    keys.refuse_value(*keys.find(key), key, rule);
}

// Bodies at several places are numbered from 1.
void read_places(const Keys& keys, SceneBody& body) {
    if (!keys.has("places") && !keys.has("place")) return;
    const YamlTree& tree = *keys.find(keys.one_of({"place", "places"}));
    if (!keys.has("places")) {
        body.places = {read_place(tree, keys.file())};
        return;
    }
    if (tree.kind != Kind::list || tree.items.empty())
        keys.refuse_value(tree, "places", "a list of places, '- {translation: [0, 0, 50]}'");
    body.places.clear();
    for (const YamlTree& item : tree.items) body.places.push_back(read_place(item, keys.file()));
}

SceneBody read_body(const std::string& name, const YamlTree& tree, const fs::path& file) {
    Keys keys(tree, file, "the body '" + name + "'",
              {"cage", "surface", "soft", "muscle", "fibres", "activation", "elements",
               "density_kg_m3", "place", "places", "hold"});
    SceneBody body;
    body.name = name;
    body.line = tree.key_line;
    body.cage = file_of(keys, "cage", meshfiles::Holds::tetrahedra,
                        "a file of tetrahedra, such as .vtu or .msh");
    if (keys.has("surface"))
        body.surface = file_of(keys, "surface", meshfiles::Holds::surface,
                               "a file of a surface, such as .stl or .obj");
    if (keys.one_of({"soft", "muscle"}) == "muscle") {
        body.muscle = read_muscle(keys, name);
        body.density = MuscleMaterial{}.density;
    } else {
        keys.only("a soft body",
                  {"cage", "surface", "soft", "density_kg_m3", "place", "places", "hold"});
        body.soft = read_soft(*keys.find("soft"), file);
        body.density = SoftMaterial{}.density;
    }
    if (keys.has("density_kg_m3"))
        body.density = kTonnePerCubicMm * keys.number("density_kg_m3", kDensity);
    if (body.soft) body.soft->density = body.density;
    read_places(keys, body);
    if (const YamlTree* hold = keys.find("hold")) {
        if (hold->kind != Kind::list)
            keys.refuse_value(*hold, "hold",
                              "a list, '- {point: [x, y, z], normal: [x, y, z], within: mm}'");
        for (const YamlTree& item : hold->items)
            body.hold.push_back(read_near_plane(item, file, "a plane whose nodes are held"));
    }
    return body;
}

// A list of {time, translation}, from where it stands.
contraction::Motion read_motion(const YamlTree& tree, const Keys& keys) {
    if (tree.kind != Kind::list || tree.items.empty())
        keys.refuse_value(tree, "motion", "a list of {time: s, translation: [x, y, z]}");
    contraction::Motion motion{{contraction::KeyFrame{}}};
    for (const YamlTree& item : tree.items) {
        const Keys at(item, keys.file(), "a key frame", {"time", "translation"});
        contraction::KeyFrame key;
        key.time = at.number("time", kSeconds);
        key.translation = at.point("translation", kShift);
        if (!(key.time > motion.keys.back().time))
            keys.refuse(item, "the key at " + shown(key.time) + " s follows the one at " +
                                  shown(motion.keys.back().time) +
                                  " s, but times must ascend; sort the keys");
        motion.keys.push_back(key);
    }
    return motion;
}

Box read_box(const YamlTree& tree, const fs::path& file, const std::string& place) {
    const Keys keys(tree, file, place, {"min", "max"});
    const Box box{keys.point("min", kCoordinate), keys.point("max", kCoordinate)};
    if (!(box.min.array() < box.max.array()).all())
        keys.refuse(tree, "'min' must be less than 'max' along each axis; exchange them");
    return box;
}

// A bin's floor and four walls; it is open upwards.
void add_bin(const Obstacle& bin, const Box& box, std::vector<Obstacle>& to) {
    for (int side = 0; side < 5; ++side) {
        Obstacle wall = bin;
        const int axis = side == 0 ? 2 : (side - 1) / 2;
        const bool low = side == 0 || side % 2 == 1;
        wall.form = Form::plane;
        wall.box = box;
        wall.point = low ? box.min : box.max;
        wall.normal = low ? Vec3(Vec3::Unit(axis)) : Vec3(-Vec3::Unit(axis));
        constexpr const char* names[] = {"floor", "wall_low_x", "wall_high_x", "wall_low_y",
                                         "wall_high_y"};
        wall.name = bin.name + "_" + names[side];
        to.push_back(std::move(wall));
    }
}

void read_obstacle(const std::string& name, const YamlTree& tree, const fs::path& file,
                   std::vector<Obstacle>& to) {
    const Keys keys(tree, file, "the obstacle '" + name + "'",
                    {"plane", "box", "bin", "sphere", "motion"});
    const std::string form = keys.one_of({"plane", "box", "bin", "sphere"});
    const YamlTree& shape = *keys.find(form);
    Obstacle obstacle;
    obstacle.name = name;
    if (const YamlTree* motion = keys.find("motion")) obstacle.motion = read_motion(*motion, keys);
    if (form == "plane") {
        const Keys plane(shape, file, "a plane", {"point", "normal"});
        obstacle.point = plane.point("point", kCoordinate);
        obstacle.normal = plane.direction("normal");
    } else if (form == "sphere") {
        const Keys sphere(shape, file, "a sphere", {"centre", "radius"});
        obstacle.form = Form::sphere;
        obstacle.point = sphere.point("centre", kCoordinate);
        obstacle.radius = sphere.number("radius", kLength);
    } else {
        const Box box = read_box(shape, file, "a " + form);
        if (form == "bin") {
            add_bin(obstacle, box, to);
            return;
        }
        obstacle.form = Form::box;
        obstacle.box = box;
    }
    to.push_back(std::move(obstacle));
}

SceneBall read_ball(const std::string& name, const YamlTree& tree, const fs::path& file) {
    const Keys keys(tree, file, "the ball '" + name + "'",
                    {"centre", "radius", "mass_kg", "density_kg_m3", "velocity"});
    SceneBall ball;
    ball.name = name;
    ball.centre = keys.point("centre", kCoordinate);
    ball.radius = keys.number("radius", kLength);
    if (keys.one_of({"mass_kg", "density_kg_m3"}) == "mass_kg")
        ball.mass = kTonne * keys.number("mass_kg", kMass);
    else
        ball.mass = kTonnePerCubicMm * keys.number("density_kg_m3", kDensity) * 4 / 3 * M_PI *
                    std::pow(ball.radius, 3);
    if (keys.has("velocity")) ball.velocity = keys.point("velocity", kSpeed);
    return ball;
}

SceneContact read_contact(const YamlTree& tree, const fs::path& file) {
    const Keys keys(tree, file, "'contact'", {"gap", "stiffness", "friction"});
    SceneContact contact;
    if (keys.has("gap")) contact.gap = keys.number("gap", kLength);
    if (keys.has("stiffness")) contact.stiffness = keys.number("stiffness", kPerDepth);
    contact.friction = keys.number_or("friction", kFriction, contact.friction);
    return contact;
}

void read_time(const YamlTree& tree, const fs::path& file, PlayScene& scene) {
    const Keys keys(tree, file, "'time'", {"end", "step", "iterations"});
    scene.end = keys.number("end", kSeconds);
    scene.step = keys.number_or("step", kSeconds, std::min(scene.step, scene.end));
    if (!(scene.step <= scene.end))
        keys.refuse(*keys.find("step"), "'step' is " + shown(scene.step) +
                                            " s, but the time ends at " + shown(scene.end) +
                                            " s; make the step shorter");
    const double iterations =
        keys.number_or("iterations", {1, 1000, true, "a whole number from 1 to 1000"}, 8);
    if (iterations != std::floor(iterations))
        keys.refuse_value(*keys.find("iterations"), "iterations", "a whole number from 1 to 1000");
    scene.iterations = static_cast<int>(iterations);
}

void read_output(const YamlTree& tree, const fs::path& file, PlayScene& scene) {
    const Keys keys(tree, file, "'output'", {"every", "view"});
    scene.every = keys.number_or("every", kSeconds, scene.every);
    if (!(scene.every >= scene.step))
        keys.refuse(*keys.find("every"), "'every' is " + shown(scene.every) +
                                             " s, but a step takes " + shown(scene.step) +
                                             " s; write 'every' at least as long");
    scene.view = keys.choice_or("view", scene.view,
                                {{"front", std::string("front")},
                                 {"back", std::string("back")},
                                 {"left", std::string("left")},
                                 {"right", std::string("right")}});
}

// Calls read(name, tree) for each entry.
template <class Read>
void each_named(const Keys& keys, const std::string& key, const std::string& form,
                const Read& read) {
    const YamlTree* tree = keys.find(key);
    if (!tree) return;
    if (tree->kind != Kind::map || tree->entries.empty())
        keys.refuse(tree->line, "'" + key + "' must be a map of at least one, '" + form + "'");
    for (const auto& [name, part] : tree->entries) read(name, part);
}

}  // namespace

PlayScene read_play_scene(const fs::path& file) {
    const YamlTree tree = repair::read_yaml(file);
    const Keys keys(
        tree, file, "the scene",
        {"title", "bodies", "obstacles", "balls", "contact", "gravity", "time", "output"});
    PlayScene scene;
    scene.file = file;
    if (keys.has("title")) scene.title = keys.word("title", "a line of text").name;
    (void)keys.require("bodies", "what deforms, by name");
    each_named(keys, "bodies", "cushion: {cage: FILE, soft: {young: 0.05}}",
               [&](const std::string& name, const YamlTree& part) {
                   scene.bodies.push_back(read_body(name, part, file));
               });
    each_named(keys, "obstacles", "floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}",
               [&](const std::string& name, const YamlTree& part) {
                   read_obstacle(name, part, file, scene.obstacles);
               });
    each_named(keys, "balls", "shot: {centre: [0, 0, 100], radius: 5, mass_kg: 0.01}",
               [&](const std::string& name, const YamlTree& part) {
                   scene.balls.push_back(read_ball(name, part, file));
               });
    if (const YamlTree* part = keys.find("contact")) scene.contact = read_contact(*part, file);
    if (keys.has("gravity")) scene.gravity = keys.point("gravity", kAcceleration);
    read_time(keys.require("time", "{end: s, step: s}"), file, scene);
    scene.every = scene.step;
    if (const YamlTree* part = keys.find("output")) read_output(*part, file, scene);
    return scene;
}

}  // namespace myotet::play
