// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Core/Geometry.h"
#include "Skeleton/Xml.h"

namespace myotet::skeleton {

/// The elements of an OpenSim file and what may be asked of them. A property that an element
/// does not have is that of its kind in the file's `<defaults>`. Whatever is no number, not
/// finite or of the wrong count is refused with its line.
class OsimFile {
public:
    explicit OsimFile(const std::filesystem::path& file);
    OsimFile(const OsimFile&) = delete;
    OsimFile& operator=(const OsimFile&) = delete;

    [[nodiscard]] const XmlElement& model() const { return *model_; }

    /// Throws InputError "file:12: (<PinJoint> 'elbow') why".
    [[noreturn]] void refuse(const XmlElement& at, const std::string& why) const;

    /// An element's own child of a kind; nullptr: there is none.
    [[nodiscard]] static const XmlElement* child(const XmlElement& of, std::string_view kind);
    /// What the file says of all elements of its kind; nullptr: nothing.
    [[nodiscard]] const XmlElement* defaults(const XmlElement& of) const;
    /// Its property, or that of its kind's defaults; nullptr: there is none.
    [[nodiscard]] const XmlElement* property(const XmlElement& of, std::string_view kind) const;
    /// The same for properties that went by several names; the first that is there.
    [[nodiscard]] const XmlElement* property(const XmlElement& of,
                                             std::initializer_list<std::string_view> kinds) const;
    /// The objects of a set such as `<BodySet>` or a list such as `<coordinates>`, which need
    /// not be there.
    [[nodiscard]] static std::vector<const XmlElement*> objects(const XmlElement& of,
                                                                std::string_view set);

    [[nodiscard]] std::string word(const XmlElement& of, std::string_view kind) const;
    [[nodiscard]] bool flag(const XmlElement& of, std::string_view kind, bool otherwise) const;
    /// Without `otherwise`, the property must be there.
    [[nodiscard]] double number(const XmlElement& of, std::string_view kind,
                                std::optional<double> otherwise = {}) const;
    [[nodiscard]] Vec3 vector(const XmlElement& of, std::string_view kind,
                              const std::optional<Vec3>& otherwise = {}) const;

    /// The numbers of an element's text.
    [[nodiscard]] std::vector<double> numbers(const XmlElement& element) const;
    [[nodiscard]] std::vector<double> numbers(const XmlElement& element, std::size_t count) const;
    [[nodiscard]] double number_in(const XmlElement& element) const;
    /// As number_in, infinity being one too.
    [[nodiscard]] std::vector<double> bounds(const XmlElement& element) const;
    /// An element's name, which must not be empty.
    [[nodiscard]] const std::string& name(const XmlElement& element) const;

private:
    [[nodiscard]] const XmlElement& needed(const XmlElement& of, std::string_view kind) const;

    std::filesystem::path file_;
    XmlElement root_;
    const XmlElement* model_ = nullptr;
    std::map<std::string, const XmlElement*> defaults_;
};

/// Words between blanks.
[[nodiscard]] std::vector<std::string> words_of(std::string_view text);

/// The last part of a path such as /jointset/elbow/elbow_flexion.
[[nodiscard]] std::string last_part(std::string_view path);

/// Metres, kilograms -> millimetres, tonnes.
inline constexpr double kMillimetres = 1000, kTonnes = 1e-3;

/// Turned about x, then about the turned y, then about the turned z; m to mm.
[[nodiscard]] Pose pose_of(const Vec3& metres, const Vec3& angles);

}  // namespace myotet::skeleton
