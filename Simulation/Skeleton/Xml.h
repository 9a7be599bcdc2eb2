// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace myotet::skeleton {

/// An element of an XML file.
struct XmlElement {
    std::string kind;  ///< its tag
    std::string name;  ///< its attribute `name`
    std::string text;  ///< without blanks on both sides
    int line = 0;
    std::vector<XmlElement> children;
};

/// The root element of a file. Throws IoError when it cannot be read, InputError
/// "file:12: ..." when it is no XML or its elements lie more than 100 deep.
[[nodiscard]] XmlElement read_xml(const std::filesystem::path& file);

}  // namespace myotet::skeleton
