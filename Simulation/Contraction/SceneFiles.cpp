// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "Contraction/Materials.h"
#include "Contraction/Words.h"
#include "Core/Sha256.h"
#include "MeshFiles/MeshFiles.h"
#include "Repair/Recipe.h"

namespace myotet::contraction {
namespace fs = std::filesystem;

namespace {

/// Surfaces that a recipe's steps add or take away.
std::vector<fs::path> surfaces_of(const repair::Recipe& recipe) {
    std::vector<fs::path> files;
    for (const repair::Step& step : recipe.steps) {
        const repair::Operand* operand = nullptr;
        if (const auto* combine = std::get_if<repair::Combine>(&step.task))
            operand = &combine->with;
        if (const auto* create = std::get_if<repair::Create>(&step.task)) operand = &create->from;
        const auto* surface = operand ? std::get_if<repair::SurfaceFile>(operand) : nullptr;
        if (surface) files.push_back(recipe.file.parent_path() / surface->file);
    }
    return files;
}

}  // namespace

std::int32_t find_label(const Scene& scene, const Named& tissue,
                        const std::map<std::int32_t, std::string>& names) {
    std::vector<std::int32_t> found;
    std::vector<std::string> known;
    for (const auto& [label, name] : names) {
        known.push_back(name.empty() ? std::to_string(label) : name);
        if (name == tissue.name) found.push_back(label);
    }
    if (found.size() > 1)
        refuse(scene, tissue.line,
               "the tissue '" + tissue.name + "' may be label " + std::to_string(found[0]) +
                   " or label " + std::to_string(found[1]) + "; give the value instead");
    if (found.size() == 1) return found.front();
    for (const auto& [label, name] : names)
        if (std::to_string(label) == tissue.name) return label;
    refuse(scene, tissue.line,
           "there is no tissue '" + tissue.name + "'" + known_are(tissue.name, known));
}

std::vector<fs::path> input_files(const Scene& scene, const fs::path& materials) {
    std::vector<fs::path> files;
    const auto add = [&](const fs::path& file) {
        if (!file.empty() && std::ranges::find(files, file) == files.end()) files.push_back(file);
    };
    const auto add_mesh = [&](const fs::path& mesh) {
        if (mesh.empty()) return;
        for (const fs::path& file : meshfiles::files_of(mesh)) add(file);
    };
    add(scene.file);
    if (scene.labels) {
        add(scene.labels->file);
        add(scene.labels->names);
        add(scene.labels->repair);
        if (!scene.labels->repair.empty())
            for (const fs::path& file : surfaces_of(repair::read_recipe(scene.labels->repair)))
                add(file);
    }
    for (const Body& body : scene.bodies) {
        add_mesh(body.mesh);
        add(body.fibres.file);
        add(body.activation_file);
    }
    for (const Material& material : scene.materials) add(set_of(scene, material, materials));
    add(scene.skeleton.model);
    add(scene.skeleton.motion);
    for (const Bone& bone : scene.bones) {
        add_mesh(bone.mesh);
        add(bone.surface);
    }
    return files;
}

std::string fingerprint(const Scene& scene, const fs::path& materials) {
    std::string sums;
    for (const fs::path& file : input_files(scene, materials)) sums += sha256_of_file(file);
    return sha256(sums);
}

}  // namespace myotet::contraction
