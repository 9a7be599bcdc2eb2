// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>

#include "Contraction/ReadParts.h"
#include "MeshFiles/MeshFiles.h"

namespace myotet::contraction {
namespace fs = std::filesystem;

namespace {

using Kind = YamlTree::Kind;

constexpr Range kPennation{-60, 60, true, "an angle from -60 to 60 degrees"};

Fibres read_fibres(const YamlTree& tree, const fs::path& file) {
    Keys keys(tree, file, "fibres", {"from", "pennation_deg", "file", "direction"});
    (void)keys.require("from", "laplace, bspline, image or constant");
    Fibres fibres;
    fibres.from = keys.choice_or("from", FibreSource::none,
                                 {{"laplace", FibreSource::laplace},
                                  {"bspline", FibreSource::bspline},
                                  {"image", FibreSource::image},
                                  {"constant", FibreSource::constant}});
    switch (fibres.from) {
        case FibreSource::laplace:
            keys.only("fibres from laplace", {"from", "pennation_deg"});
            fibres.pennation_deg = keys.number_or("pennation_deg", kPennation, 0);
            break;
        case FibreSource::bspline:
            keys.only("fibres from bspline", {"from", "file"});
            fibres.file = keys.existing_file_or_none("file");
            break;
        case FibreSource::image:
            keys.only("fibres from image", {"from", "file"});
            fibres.file = keys.existing_file("file");
            break;
        default:
            keys.only("constant fibres", {"from", "direction"});
            fibres.direction = keys.direction("direction");
    }
    return fibres;
}

std::vector<MaterialOf> read_materials_of(const Keys& keys, const std::vector<Named>& tissues) {
    constexpr const char* kRule = "the name of a material";
    const YamlTree& tree = keys.require("material", kRule);
    if (tree.kind != Kind::map) return {{"", keys.word("material", kRule)}};
    std::vector<std::string> known;
    for (const Named& tissue : tissues) known.push_back(tissue.name);
    std::vector<MaterialOf> materials;
    for (const auto& [tissue, value] : tree.entries) {
        if (!known.empty() && std::ranges::find(known, tissue) == known.end())
            keys.refuse(value.key_line,
                        "'" + tissue + "' is no tissue of this body" + known_are(tissue, known));
        materials.push_back({tissue, keys.word_in(value, tissue, kRule)});
    }
    for (const std::string& tissue : known)
        if (!tree.entries.empty() &&
            std::ranges::count(materials, tissue, &MaterialOf::tissue) == 0)
            keys.refuse(tree.key_line, "'material' names none for '" + tissue +
                                           "', but every tissue of the body needs one; add it");
    if (materials.empty()) keys.refuse_value(tree, "material", kRule);
    return materials;
}

Body read_body(const std::string& name, const YamlTree& tree, const fs::path& file,
               const Time& time) {
    const Keys keys(tree, file, "the body '" + name + "'",
                    {"mesh", "tissues", "material", "fibres", "elements", "activation",
                     "excitation", "rise", "fall", "force_velocity"});
    Body body;
    body.name = name;
    body.line = tree.key_line;
    if (keys.one_of({"mesh", "tissues"}) == "mesh") {
        body.mesh = existing_mesh(keys);
    } else {
        body.tissues = keys.words("tissues", "a tissue's name or label value, or a list of them");
    }
    body.materials = read_materials_of(keys, body.tissues);
    if (const YamlTree* fibres = keys.find("fibres")) body.fibres = read_fibres(*fibres, file);
    body.elements = keys.choice_or("elements", body.elements,
                                   {{"linear", Elements::linear},
                                    {"patches", Elements::patches},
                                    {"quadratic", Elements::quadratic}});
    read_drive(keys, time, body);
    return body;
}

Material read_material(const std::string& name, const YamlTree& tree, const fs::path& file,
                       const Time& time) {
    constexpr Range kDensity{0, 1e5, false, "a density in kg/m^3 above 0"};
    constexpr Range kViscosity{0, 1e6, true, "a viscosity in MPa s of at least 0"};
    constexpr double kTonnePerCubicMm = 1e-12;  // of a kg/m^3
    constexpr Range kFinite{-1e300, 1e300, true, "a finite number"};
    const Keys keys(tree, file, "the material '" + name + "'",
                    {"model", "density_kg_m3", "viscosity", "constants"});
    Material material;
    material.name = name;
    material.model = keys.word("model", "the name of a model, such as blemker2005_muscle");
    if (keys.has("density_kg_m3"))
        material.density = kTonnePerCubicMm * keys.number("density_kg_m3", kDensity);
    material.viscosity = keys.number_or("viscosity", kViscosity, material.viscosity);
    if (material.viscosity > 0 && time.scheme == Scheme::quasi_static)
        keys.refuse(*keys.find("viscosity"),
                    "'viscosity' resists motion, of which quasi-static knows none; leave it out, "
                    "or choose a 'scheme' with inertia");
    const YamlTree* constants = keys.find("constants");
    if (!constants) return material;
    if (constants->kind != Kind::map)
        keys.refuse_value(*constants, "constants", "a map of names and numbers");
    for (const auto& [constant, value] : constants->entries)
        material.constants.push_back(
            {constant, keys.number_in(value, constant, kFinite), value.key_line});
    return material;
}

}  // namespace

fs::path existing_mesh(const Keys& keys) {
    const fs::path file = keys.existing_file("mesh");
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return std::tolower(c); });
    for (const meshfiles::Format& format : meshfiles::formats())
        if (format.holds == meshfiles::Holds::tetrahedra && extension == format.extension)
            return file;
    keys.refuse_value(*keys.find("mesh"), "mesh", "a file of tetrahedra, such as .vtu or .msh");
}

std::vector<Body> read_bodies(const YamlTree& tree, const fs::path& file, const Time& time) {
    if (tree.kind != Kind::map || tree.entries.empty())
        refuse(file, tree.line,
               "'bodies' must be a map of at least one body, 'biceps: {mesh: FILE, ...}'");
    std::vector<Body> bodies;
    for (const auto& [name, body] : tree.entries)
        bodies.push_back(read_body(name, body, file, time));
    return bodies;
}

std::vector<Material> read_materials(const YamlTree& tree, const fs::path& file, const Time& time) {
    if (tree.kind != Kind::map)
        refuse(file, tree.line, "'materials' must be a map, 'belly: {model: blemker2005_muscle}'");
    std::vector<Material> materials;
    for (const auto& [name, material] : tree.entries)
        materials.push_back(read_material(name, material, file, time));
    return materials;
}

}  // namespace myotet::contraction
