// SPDX-License-Identifier: Apache-2.0
#include "PressPlan.h"

#include <algorithm>
#include <cmath>

#include "Contraction/Keys.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

using contraction::Keys;
using contraction::kSeconds;
using contraction::kSecondsOrZero;
using contraction::Named;
using repair::kCoordinate;
using repair::kLength;
using repair::kLengthOrZero;
using repair::Range;
using repair::YamlTree;
using Kind = YamlTree::Kind;

constexpr double kTonnePerCubicMm = 1e-12;  // in a kg/m^3
constexpr Range kModulus{0, 1e6, false, "a modulus in MPa above 0"};
constexpr Range kDensity{0, 1e5, false, "a density in kg/m^3 above 0"};
constexpr Range kPerDepth{0, 1e6, false, "a pressure a depth in MPa/mm above 0"};
constexpr Range kPerDepthOrZero{0, 1e6, true, "a pressure a depth in MPa/mm of at least 0"};
constexpr Range kRate{0, 1e6, true, "a rate in 1/s of at least 0"};
constexpr Range kForce{0, 1e6, true, "a force in N of at least 0"};
constexpr Range kForcePart{-1e6, 1e6, true, "a force in N"};
constexpr Range kDepth{-1e4, 1e4, true, "a depth in mm, below 0 before the first touch"};
constexpr Range kPressure{-1e3, 1e3, true, "a pressure in MPa"};
constexpr Range kBulk{0, 1e6, true, "a modulus in MPa of at least 0"};
constexpr Range kAcceleration{-1e8, 1e8, true, "an acceleration in mm/s^2"};
constexpr Range kPoint{0, 2e9, true, "a point's number, from 0"};

const std::vector<std::string> kWallKeys{
    "thickness",          "young", "density_kg_m3",    "damping_time", "shape_stiffness",
    "shape_damping_time", "drag",  "contact_stiffness"};

bool read_wall_constants(const Keys& keys, membrane::Wall& wall) {
    wall.thickness = keys.number_or("thickness", kLength, wall.thickness);
    wall.young = keys.number_or("young", kModulus, wall.young);
    if (keys.has("density_kg_m3"))
        wall.density = kTonnePerCubicMm * keys.number("density_kg_m3", kDensity);
    wall.damping_time = keys.number_or("damping_time", kSecondsOrZero, wall.damping_time);
    wall.shape_stiffness = keys.number_or("shape_stiffness", kPerDepthOrZero, wall.shape_stiffness);
    wall.shape_damping_time =
        keys.number_or("shape_damping_time", kSecondsOrZero, wall.shape_damping_time);
    wall.drag = keys.number_or("drag", kRate, wall.drag);
    wall.contact_stiffness =
        keys.number_or("contact_stiffness", kPerDepthOrZero, wall.contact_stiffness);
    return keys.has("thickness");
}

std::vector<std::string> materials_in(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none))
        if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    return names;
}

void read_material(const Keys& from, const fs::path& walls, PressPlan& plan) {
    const Named name = from.word("material", "the name of a wall's material");
    const bool own = fs::path(name.name).extension() == ".yaml";
    const fs::path file =
        own ? from.file().parent_path() / name.name : walls / (name.name + ".yaml");
    if (std::error_code ignored; !fs::is_regular_file(file, ignored))
        from.refuse(name.line, "there is no material '" + name.name + "'" +
                                   contraction::known_are(name.name, materials_in(walls)) +
                                   "; or name a file of your own that ends in .yaml");
    plan.material = name.name;
    const YamlTree tree = repair::read_yaml(file);
    std::vector<std::string> known = kWallKeys;
    known.emplace_back("myotet_wall");
    const Keys keys(tree, file, "a wall's material", known);
    (void)keys.number("myotet_wall", {1, 1, true, "1, the only version there is"});
    (void)read_wall_constants(keys, plan.wall);
}

void read_wall(const Keys& top, const fs::path& walls, PressPlan& plan) {
    const YamlTree* tree = top.find("wall");
    if (!tree) return;
    std::vector<std::string> known = kWallKeys;
    known.emplace_back("material");
    const Keys keys(*tree, plan.file, "'wall'", known);
    if (keys.has("material")) read_material(keys, walls, plan);
    plan.thickness_stated = read_wall_constants(keys, plan.wall);
}

const std::vector<YamlTree>& list_at(const Keys& keys, const std::string& key,
                                     const std::string& rule) {
    const YamlTree& tree = keys.require(key, rule);
    if (tree.kind != Kind::list || tree.items.empty()) keys.refuse_value(tree, key, rule);
    return tree.items;
}

/// Rows of numbers, the first of each a time later than the row's before.
std::vector<std::vector<double>> read_rows(const Keys& keys, const std::string& key,
                                           std::size_t columns, const Range& range,
                                           const std::string& rule) {
    std::vector<std::vector<double>> rows;
    for (const YamlTree& item : list_at(keys, key, rule)) {
        if (item.kind != Kind::list || item.items.size() != columns)
            keys.refuse(item, "a row of '" + key + "' must be " + rule);
        std::vector<double> row{keys.number_in(item.items[0], key, kSecondsOrZero)};
        for (std::size_t i = 1; i < columns; ++i)
            row.push_back(keys.number_in(item.items[i], key, range));
        if (!rows.empty() && !(row[0] > rows.back()[0]))
            keys.refuse(item, "'" + key + "' has times that do not ascend: " + shown(row[0]) +
                                  " s after " + shown(rows.back()[0]) + " s; sort its rows");
        rows.push_back(std::move(row));
    }
    return rows;
}

Approach read_approach(const Keys& keys) {
    Approach approach{.way = keys.direction("direction"), .towards = {}};
    if (keys.has("towards")) approach.towards = keys.point("towards", kCoordinate);
    return approach;
}

std::string name_of(const Keys& keys, const std::string& otherwise) {
    if (!keys.has("name")) return otherwise;
    const Named name = keys.word("name", "a name for the columns of history.csv");
    if (name.name.find_first_of(",;\"[] \t") != std::string::npos)
        keys.refuse(name.line, "'name' is '" + name.name +
                                   "' but must be without blanks, commas, quotes and brackets");
    return name.name;
}

void read_drive(const Keys& keys, ToolPlan& plan) {
    membrane::Tool& tool = plan.tool;
    const std::string drive = keys.one_of({"depth", "force", "path"});
    if (drive == "path") {
        if (keys.has("towards"))
            keys.refuse(*keys.find("towards"),
                        "'towards' means nothing beside 'path', which says where the tool is; "
                        "leave it out");
        for (const auto& row :
             read_rows(keys, "path", 4, kCoordinate, "a list of [time in s, x, y, z in mm]"))
            tool.places.push_back({row[0], Vec3(row[1], row[2], row[3])});
        if (tool.shape == membrane::Tool::Shape::plane) tool.normal = keys.direction("direction");
        return;
    }
    plan.approach = read_approach(keys);
    tool.way = tool.normal = plan.approach->way;
    if (drive == "depth") {
        for (const auto& row :
             read_rows(keys, "depth", 2, kDepth, "a list of [time in s, depth in mm]"))
            plan.depths.push_back({row[0], row[1]});
        return;
    }
    for (const auto& row :
         read_rows(keys, "force", 2, kForce, "a list of [time in s, force in N of at least 0]"))
        tool.forces.push_back({row[0], row[1]});
}

ToolPlan read_tool(const YamlTree& tree, const fs::path& file, const std::string& otherwise) {
    using Shape = membrane::Tool::Shape;
    const Keys keys(
        tree, file, "a tool",
        {"name", "shape", "radius", "direction", "towards", "depth", "force", "path", "stiffness"});
    ToolPlan plan;
    plan.line = tree.line;
    plan.name = name_of(keys, otherwise);
    membrane::Tool& tool = plan.tool;
    (void)keys.require("shape", "sphere or plane");
    tool.shape = keys.choice_or("shape", Shape::sphere,
                                {{"sphere", Shape::sphere}, {"plane", Shape::plane}});
    if (tool.shape == Shape::sphere)
        tool.radius = keys.number("radius", kLength);
    else if (const YamlTree* radius = keys.find("radius"))
        keys.refuse(*radius, "'radius' is of a sphere, but the tool is a plane; leave it out");
    read_drive(keys, plan);
    tool.stiffness = keys.number_or("stiffness", kPerDepth, tool.stiffness);
    return plan;
}

PatchPlan read_patch(const YamlTree& tree, const fs::path& file, const std::string& otherwise) {
    const Keys keys(
        tree, file, "a patch",
        {"name", "centre", "direction", "towards", "radius", "force", "from", "until", "ramp"});
    PatchPlan plan;
    plan.line = tree.line;
    plan.name = name_of(keys, otherwise);
    membrane::PatchForce& patch = plan.patch;
    patch.radius = keys.number("radius", kLength);
    if (keys.one_of({"centre", "direction"}) == "centre") {
        patch.centre = keys.point("centre", kCoordinate);
        patch.force = keys.point("force", kForcePart);
    } else {
        plan.approach = read_approach(keys);
        patch.force = keys.number("force", kForce) * plan.approach->way;
    }
    patch.from = keys.number_or("from", kSecondsOrZero, 0);
    patch.until = keys.number("until", kSecondsOrZero);
    patch.ramp = keys.number_or("ramp", kSecondsOrZero, 0);
    if (!(patch.until >= patch.from))
        keys.refuse(*keys.find("until"), "'until' is " + shown(patch.until) +
                                             " s, but the patch presses from " + shown(patch.from) +
                                             " s; make it later");
    return plan;
}

HoldPlan read_hold(const YamlTree& tree, const fs::path& file) {
    const Keys keys(tree, file, "'hold'", {"rims", "points", "balls", "tissues", "within"});
    HoldPlan hold;
    hold.line = tree.key_line;
    hold.rims = keys.choice_or("rims", false, {{"true", true}, {"false", false}});
    if (keys.has("points"))
        for (const YamlTree& item : list_at(keys, "points", "a list of points' numbers, from 0")) {
            const double number = keys.number_in(item, "points", kPoint);
            if (number != std::floor(number)) keys.refuse_value(item, "points", kPoint.rule);
            hold.points.push_back(static_cast<std::int32_t>(number));
        }
    if (keys.has("balls"))
        for (const YamlTree& item : list_at(keys, "balls", "a list of {centre, radius}")) {
            const Keys ball(item, file, "a ball", {"centre", "radius"});
            hold.balls.push_back(
                {ball.point("centre", kCoordinate), ball.number("radius", kLength)});
        }
    if (keys.has("tissues"))
        for (const Named& name : keys.words("tissues", "a label's name or value, or a list"))
            hold.tissues.push_back(name.name);
    if (!hold.tissues.empty()) hold.within = keys.number("within", kLength);
    if (const YamlTree* within = keys.find("within"); within && hold.tissues.empty())
        keys.refuse(*within,
                    "'within' is the distance from 'tissues', but none are named; leave it out");
    return hold;
}

void read_criteria(const YamlTree& tree, const fs::path& file, membrane::Criteria& criteria) {
    constexpr Range kTraction{0, 1e6, false, "a pressure in MPa above 0"};
    constexpr Range kSpeed{0, 1e9, false, "a speed in mm/s above 0"};
    constexpr Range kCurvature{0, 1e3, false, "a curvature in 1/mm above 0"};
    constexpr Range kPart{0, 0.999, false, "a number above 0 and below 1"};
    constexpr Range kRings{0, 100, true, "a whole number from 0 to 100"};
    const Keys keys(
        tree, file, "'criteria'",
        {"traction", "speed", "curvature", "reach", "release", "calm", "rings", "interval"});
    criteria.traction = keys.number_or("traction", kTraction, criteria.traction);
    criteria.speed = keys.number_or("speed", kSpeed, criteria.speed);
    criteria.curvature = keys.number_or("curvature", kCurvature, criteria.curvature);
    criteria.reach = keys.number_or("reach", kLengthOrZero, criteria.reach);
    criteria.release = keys.number_or("release", kPart, criteria.release);
    criteria.calm = keys.number_or("calm", kSecondsOrZero, criteria.calm);
    const double rings = keys.number_or("rings", kRings, criteria.rings);
    if (rings != std::floor(rings)) keys.refuse_value(*keys.find("rings"), "rings", kRings.rule);
    criteria.rings = static_cast<int>(rings);
    criteria.interval = keys.number_or("interval", kSeconds, criteria.interval);
}

void read_times(const Keys& top, PressPlan& plan) {
    constexpr double kFrames = 20, kLinesAFrame = 10;  // when not said
    const Keys time(top.require("time", "{end: S}"), plan.file, "'time'", {"end"});
    plan.end = time.number("end", kSeconds);
    plan.every = plan.end / kFrames;
    const YamlTree* output = top.find("output");
    if (output) {
        const Keys keys(*output, plan.file, "'output'", {"every", "history"});
        plan.every = keys.number_or("every", kSeconds, plan.every);
        plan.history = keys.number_or("history", kSeconds, plan.every / kLinesAFrame);
        const double lines = plan.every / plan.history;
        constexpr double kWhole = 1e-6;
        if (!(std::round(lines) >= 1 && std::abs(lines - std::round(lines)) < kWhole))
            keys.refuse(*output, "a frame comes every " + shown(plan.every) +
                                     " s, but a line of the history every " + shown(plan.history) +
                                     " s; make 'every' a whole multiple of 'history'");
        return;
    }
    plan.history = plan.every / kLinesAFrame;
}

/// Names of columns, each once.
void check_names(const PressPlan& plan) {
    std::vector<std::string> taken;
    const auto take = [&](const std::string& name, int line) {
        if (std::ranges::find(taken, name) != taken.end())
            refuse(plan.file, line, "two tools or patches are named '" + name + "'; rename one");
        taken.push_back(name);
    };
    for (const ToolPlan& tool : plan.tools) take(tool.name, tool.line);
    for (const PatchPlan& patch : plan.patches) take(patch.name, patch.line);
}

}  // namespace

PressPlan read_press_plan(const fs::path& file, const fs::path& walls) {
    const YamlTree tree = repair::read_yaml(file);
    PressPlan plan;
    plan.file = file;
    const Keys keys(tree, plan.file, "a tool's file",
                    {"title", "wall", "tools", "patches", "hold", "gravity", "cavity", "time",
                     "output", "criteria"});
    if (keys.has("title")) plan.title = keys.word("title", "a text").name;
    read_wall(keys, walls, plan);
    const auto numbered = [](const char* name, std::size_t before) {
        return before == 0 ? std::string(name) : name + ("_" + std::to_string(before + 1));
    };
    if (keys.has("tools"))
        for (const YamlTree& item : list_at(keys, "tools", "a list of tools"))
            plan.tools.push_back(read_tool(item, plan.file, numbered("tool", plan.tools.size())));
    if (keys.has("patches"))
        for (const YamlTree& item : list_at(keys, "patches", "a list of patches"))
            plan.patches.push_back(
                read_patch(item, plan.file, numbered("patch", plan.patches.size())));
    check_names(plan);
    if (const YamlTree* hold = keys.find("hold")) plan.hold = read_hold(*hold, plan.file);
    if (keys.has("gravity")) plan.gravity = keys.point("gravity", kAcceleration);
    if (const YamlTree* tree_of_cavity = keys.find("cavity")) {
        const Keys cavity(*tree_of_cavity, plan.file, "'cavity'", {"pressure", "bulk"});
        plan.pressure = cavity.number_or("pressure", kPressure, 0);
        plan.bulk = cavity.number_or("bulk", kBulk, 0);
    }
    read_times(keys, plan);
    if (const YamlTree* criteria = keys.find("criteria"))
        read_criteria(*criteria, plan.file, plan.criteria);
    return plan;
}

}  // namespace myotet::app
