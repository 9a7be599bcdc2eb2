// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Skeleton/Function.h"
#include "Skeleton/OsimFile.h"

namespace myotet::skeleton {

/// The function that an element such as `<SimmSpline>` is, in the units of the file.
/// Throws InputError for one of a kind that is not read.
[[nodiscard]] Function read_function(const OsimFile& file, const XmlElement& element);

/// The function that a property of an element is: `<SimmSpline name="function">`, or in
/// `<function>`; nullptr: there is none.
[[nodiscard]] const XmlElement* find_function(const XmlElement& of, std::string_view property);

}  // namespace myotet::skeleton
