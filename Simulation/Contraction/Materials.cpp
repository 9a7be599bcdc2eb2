// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Materials.h"

#include <algorithm>

#include "Contraction/Keys.h"
#include "Core/Errors.h"

namespace myotet::contraction {
namespace fs = std::filesystem;

namespace {

using Kind = YamlTree::Kind;

std::vector<std::string> known_keys() {
    std::vector<std::string> keys{"myotet_material", "constants"};
    for (const muscle::ChoiceInfo& choice : muscle::all_choices()) keys.emplace_back(choice.name);
    return keys;
}

// Turns what a material refuses into a sentence with file and line.
template <class Change>
void at_line(const fs::path& file, int line, Change&& change) {
    try {
        change();
    } catch (const InputError& error) {
        refuse(file, line, error.what());
    }
}

std::vector<std::string> models_in(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none))
        if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

muscle::TissueMaterial read_material(const fs::path& file) {
    const YamlTree tree = repair::read_yaml(file);
    const Keys keys(tree, file, "a material", known_keys());
    if (keys.number("myotet_material", {1, 1, true, "1, the only version there is"}) != 1)
        refuse(file, tree.line, "'myotet_material' must be 1");
    muscle::TissueMaterial material;
    // The curve decides which constants there are, so choices come first.
    for (const muscle::ChoiceInfo& choice : muscle::all_choices()) {
        const std::string name(choice.name);
        if (!keys.has(name)) continue;
        const Named word = keys.word(name, "a word");
        at_line(file, word.line, [&] { muscle::set_choice(material, name, word.name); });
    }
    if (const YamlTree* constants = keys.find("constants")) {
        if (constants->kind != Kind::map)
            refuse(file, constants->line, "'constants' must be a map, name: number");
        for (const auto& [name, value] : constants->entries) {
            const double number = keys.number_in(value, name, {});
            at_line(file, value.line, [&, key = name] {
                if (number != 0) muscle::set_constant(material, key, number);
            });
        }
    }
    at_line(file, tree.line, [&] { material.validate(); });
    return material;
}

fs::path set_of(const Scene& scene, const Material& material, const fs::path& folder) {
    const fs::path model = material.model.name;
    return model.extension() == ".yaml" ? scene.file.parent_path() / model
                                        : folder / (material.model.name + ".yaml");
}

muscle::TissueMaterial material_of(const Scene& scene, const Material& material,
                                   const fs::path& folder) {
    const std::string& model = material.model.name;
    const fs::path file = set_of(scene, material, folder);
    if (!fs::exists(file)) {
        if (fs::path(model).extension() == ".yaml")
            refuse(scene, material.model.line, "there is no file " + file.string());
        refuse(scene, material.model.line,
               "there is no model '" + model + "'" + known_are(model, models_in(folder)) +
                   "; or name a file of your own that ends in .yaml");
    }
    muscle::TissueMaterial made = read_material(file);
    for (const Constant& constant : material.constants)
        at_line(scene.file, constant.line,
                [&] { muscle::set_constant(made, constant.name, constant.value); });
    at_line(scene.file, material.model.line, [&] { made.validate(); });
    return made;
}

}  // namespace myotet::contraction
