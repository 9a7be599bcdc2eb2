// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/OsimFile.h"

#include <cmath>

#include "Core/Text.h"

namespace myotet::skeleton {

OsimFile::OsimFile(const std::filesystem::path& file) : file_(file), root_(read_xml(file)) {
    model_ = root_.kind == "Model" ? &root_ : child(root_, "Model");
    if (!model_)
        refuse(root_,
               "holds no <Model>, so it is no OpenSim model; give the .osim file, not that of a "
               "tool, a set or a scale");
    for (const XmlElement* at : {static_cast<const XmlElement*>(&root_), model_})
        if (const XmlElement* defaults = child(*at, "defaults"))
            for (const XmlElement& kind : defaults->children) defaults_[kind.kind] = &kind;
}

void OsimFile::refuse(const XmlElement& at, const std::string& why) const {
    const std::string name = at.name.empty() ? "" : " '" + at.name + "'";
    myotet::refuse(file_, at.line, "(<" + at.kind + ">" + name + ") " + why);
}

const XmlElement* OsimFile::child(const XmlElement& of, std::string_view kind) {
    for (const XmlElement& element : of.children)
        if (element.kind == kind) return &element;
    return nullptr;
}

const XmlElement* OsimFile::defaults(const XmlElement& of) const {
    const auto found = defaults_.find(of.kind);
    return found == defaults_.end() ? nullptr : found->second;
}

const XmlElement* OsimFile::property(const XmlElement& of, std::string_view kind) const {
    if (const XmlElement* own = child(of, kind)) return own;
    const XmlElement* all = defaults(of);
    return all ? child(*all, kind) : nullptr;
}

const XmlElement* OsimFile::property(const XmlElement& of,
                                     std::initializer_list<std::string_view> kinds) const {
    for (const std::string_view kind : kinds)
        if (const XmlElement* found = property(of, kind)) return found;
    return nullptr;
}

std::vector<const XmlElement*> OsimFile::objects(const XmlElement& of, std::string_view set) {
    std::vector<const XmlElement*> found;
    for (const XmlElement& list : of.children) {
        if (list.kind != set) continue;
        const XmlElement* inner = child(list, "objects");
        for (const XmlElement& object : (inner ? *inner : list).children)
            if (object.kind != "groups") found.push_back(&object);
    }
    return found;
}

const XmlElement& OsimFile::needed(const XmlElement& of, std::string_view kind) const {
    const XmlElement* found = property(of, kind);
    if (!found) refuse(of, "has no <" + std::string(kind) + ">; add it");
    return *found;
}

std::string OsimFile::word(const XmlElement& of, std::string_view kind) const {
    const XmlElement* found = property(of, kind);
    return found ? found->text : "";
}

bool OsimFile::flag(const XmlElement& of, std::string_view kind, bool otherwise) const {
    const XmlElement* found = property(of, kind);
    if (!found) return otherwise;
    const std::string said = lower(found->text);
    if (said == "true" || said == "1") return true;
    if (said == "false" || said == "0") return false;
    refuse(*found, "is '" + found->text.substr(0, 40) + "'; write true or false");
}

double OsimFile::number(const XmlElement& of, std::string_view kind,
                        std::optional<double> otherwise) const {
    if (otherwise && !property(of, kind)) return *otherwise;
    return number_in(needed(of, kind));
}

Vec3 OsimFile::vector(const XmlElement& of, std::string_view kind,
                      const std::optional<Vec3>& otherwise) const {
    if (otherwise && !property(of, kind)) return *otherwise;
    const auto v = numbers(needed(of, kind), 3);
    return {v[0], v[1], v[2]};
}

std::vector<double> OsimFile::bounds(const XmlElement& element) const {
    std::vector<double> found;
    for (const std::string& word : words_of(element.text)) {
        const auto value = to_number(word);
        if (!value || std::isnan(*value))
            refuse(element, "holds '" + word.substr(0, 40) +
                                "' where a number should stand; write it as 0.5 or 5e-1");
        found.push_back(*value);
    }
    return found;
}

std::vector<double> OsimFile::numbers(const XmlElement& element) const {
    std::vector<double> found = bounds(element);
    for (const double value : found)
        if (!std::isfinite(value))
            refuse(element, "holds '" + shown(value) + "', but must be finite; correct it");
    return found;
}

std::vector<double> OsimFile::numbers(const XmlElement& element, std::size_t count) const {
    std::vector<double> found = numbers(element);
    if (found.size() != count)
        refuse(element, "holds " + std::to_string(found.size()) + " numbers where " +
                            std::to_string(count) + " belong; correct it");
    return found;
}

double OsimFile::number_in(const XmlElement& element) const { return numbers(element, 1)[0]; }

const std::string& OsimFile::name(const XmlElement& element) const {
    if (element.name.empty()) refuse(element, "has no name; give it one, name=\"...\"");
    return element.name;
}

std::vector<std::string> words_of(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r\n\v\f,";
    std::vector<std::string> words;
    for (std::size_t from = text.find_first_not_of(kBlank); from != std::string_view::npos;
         from = text.find_first_not_of(kBlank)) {
        text.remove_prefix(from);
        words.emplace_back(text.substr(0, text.find_first_of(kBlank)));
        text.remove_prefix(words.back().size());
    }
    return words;
}

std::string last_part(std::string_view path) {
    while (path.ends_with('/')) path.remove_suffix(1);
    return std::string(path.substr(path.rfind('/') + 1));
}

Pose pose_of(const Vec3& metres, const Vec3& angles) {
    const Eigen::AngleAxisd x(angles.x(), Vec3::UnitX()), y(angles.y(), Vec3::UnitY()),
        z(angles.z(), Vec3::UnitZ());
    return {(x * y * z).toRotationMatrix(), kMillimetres * metres};
}

}  // namespace myotet::skeleton
