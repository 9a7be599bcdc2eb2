// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MeshFiles/MeshFiles.h"

namespace myotet::meshfiles {

/// Reads back what write_vtu was given besides the mesh: the arrays of a .vtu of one piece, all
/// but `label`; texts are passed over. Of a file that holds tetrahedra alone they are in the
/// order of read_vtu's mesh. Throws IoError, InputError when it is damaged or has several pieces.
[[nodiscard]] MeshArrays read_vtu_arrays(const std::filesystem::path& file);

}  // namespace myotet::meshfiles
