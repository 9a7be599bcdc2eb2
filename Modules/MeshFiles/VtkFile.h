// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "MeshFiles/Numbers.h"
#include "MeshFiles/VtkBytes.h"

namespace pugi {
class xml_document;
class xml_node;
}  // namespace pugi

namespace myotet::meshfiles {

/// The tags of one of VTK's XML files, and the numbers of an array when they are asked for.
/// Throws InputError, naming file and line, where the file is damaged or of another kind than
/// is asked for, IoError where it is cut short. `content` and `file` must outlive it.
class VtkFile {
public:
    /// `type`: of the grid, the tag that holds the pieces.
    VtkFile(std::string_view content, const std::filesystem::path& file, const char* type);
    ~VtkFile();
    VtkFile(const VtkFile&) = delete;
    VtkFile& operator=(const VtkFile&) = delete;

    [[nodiscard]] pugi::xml_node grid() const;

    /// The array of this name, or none.
    [[nodiscard]] static pugi::xml_node find(const pugi::xml_node& holder, const char* name);
    /// The array of this name, which must be there.
    [[nodiscard]] pugi::xml_node array(const pugi::xml_node& holder, const char* name) const;
    [[nodiscard]] static bool is_array(const pugi::xml_node& node);
    [[nodiscard]] std::vector<double> reals(const pugi::xml_node& array) const;
    [[nodiscard]] std::vector<std::int64_t> integers(const pugi::xml_node& array) const;
    /// Texts end with a zero; none when there is no such array.
    [[nodiscard]] std::vector<std::string> texts(const char* name) const;
    /// The count that a tag's attribute says; `otherwise` where it says none.
    [[nodiscard]] std::int64_t number(const pugi::xml_node& node, const char* name,
                                      std::optional<std::int64_t> otherwise = {}) const;
    void require(const pugi::xml_node& node, bool holds, const char* defect) const {
        if (!holds) refuse(node, defect);
    }
    [[noreturn]] void refuse(const pugi::xml_node& node, const std::string& defect) const;

private:
    std::string split_from_appended();
    void parse(std::string tags);
    void read_storage(const pugi::xml_node& root);
    template <class Value, std::size_t N>
    Value one_of(const pugi::xml_node& node, const char* name,
                 const std::pair<std::string_view, Value> (&known)[N]) const;
    [[nodiscard]] NumberKind kind_of(const pugi::xml_node& array) const;
    [[nodiscard]] bool is_text(const pugi::xml_node& array) const;
    [[nodiscard]] std::string bytes_of(const pugi::xml_node& array) const;
    template <class Number>
    std::vector<Number> parsed(const pugi::xml_node& array) const;
    template <class Number>
    Number to_number(const pugi::xml_node& node, std::string_view word) const;
    [[noreturn]] void fail(std::ptrdiff_t offset, const std::string& defect) const;

    std::string_view content_;
    const std::filesystem::path& file_;
    std::string_view appended_;  ///< all after the '_'
    bool appended_in_base64_ = true;
    VtkStorage storage_;
    std::string tags_;
    std::unique_ptr<pugi::xml_document> document_;  ///< points into tags_
    const char* type_;
};

}  // namespace myotet::meshfiles
