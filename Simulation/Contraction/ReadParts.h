// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "Contraction/Keys.h"
#include "Contraction/Scene.h"

namespace myotet::contraction {

/// Parts of a scene from their trees; see read_scene.
[[nodiscard]] std::vector<Body> read_bodies(const YamlTree& tree, const std::filesystem::path& file,
                                            const Time& time);
[[nodiscard]] std::vector<Material> read_materials(const YamlTree& tree,
                                                   const std::filesystem::path& file,
                                                   const Time& time);
[[nodiscard]] std::vector<Bone> read_bones(const YamlTree& tree, const std::filesystem::path& file);
[[nodiscard]] std::vector<Attachment> read_attachments(const YamlTree& tree,
                                                       const std::filesystem::path& file);

/// Reads `skeleton` and gives the bones that go with its bodies their motion: at 0 s they
/// are where their meshes are, so that the scan shows the posture of that time. Sampled at
/// the scene's steps and between them, at least every 5 ms.
void move_bones(const YamlTree& tree, const std::filesystem::path& file, Scene& scene);

/// Reads what drives a body's fibres: `activation`, or `excitation` with `rise` and `fall`,
/// and `force_velocity`. Refuses each of them where there are no fibres.
void read_drive(const Keys& keys, const Time& time, Body& body);

/// The file of tetrahedra that `mesh` names.
[[nodiscard]] std::filesystem::path existing_mesh(const Keys& keys);

/// Adds models that bodies use by their own names, and refuses what contradicts
/// itself between the parts.
void join_parts(Scene& scene);

/// What is fixed in space goes by this name.
inline constexpr const char* kFixed = "fixed";

}  // namespace myotet::contraction
