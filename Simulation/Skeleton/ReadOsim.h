// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "Skeleton/Model.h"

namespace myotet::skeleton {

/// Reads an OpenSim model, file versions 1.9 to 4, whose metres and kilograms become
/// millimetres and tonnes; the README says what of it. What moves or pulls and is not taken
/// into account gets a sentence in Model::notes; pictures and markers do not.
/// Throws IoError when the file cannot be read, InputError "file:12: ..." for XML that is
/// none, a body, coordinate or wrap object that is named and not there, a joint, function
/// or wrap object of a kind that is not known, bodies that hang on each other in a circle.
[[nodiscard]] Model read_osim(const std::filesystem::path& file);

}  // namespace myotet::skeleton
