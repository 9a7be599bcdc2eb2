// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace myotet::fuzz {

/// An input is one byte whose lowest four bits choose the ending of the file's
/// name, then the bytes of a file. `.h5` is read through a sound `.xdmf`, and
/// `.xdmf` has a sound `.h5` beside it.
inline constexpr std::array<const char*, 13> kMeshEndings{".msh", ".feb",  ".inp", ".bdf", ".mesh",
                                                          ".vtu", ".xdmf", ".h5",  ".obj", ".off",
                                                          ".stl", ".ply",  ".vtp"};

/// The names of a sound pair of files.
inline constexpr const char* kPair = "mesh.xdmf";
inline constexpr const char* kPairNumbers = "mesh.h5";

}  // namespace myotet::fuzz
