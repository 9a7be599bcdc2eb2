// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/OsimFrames.h"

#include <algorithm>

namespace myotet::skeleton {
namespace {

/// Paths like folders': `..` goes up, one that begins with / does not depend on the owner.
std::string joined(const std::string& owner, const std::string& named) {
    std::string path = named.starts_with('/') ? named : owner + "/" + named;
    std::vector<std::string> parts;
    for (std::size_t from = 0; from < path.size();) {
        const std::size_t end = std::min(path.find('/', from), path.size());
        const std::string part = path.substr(from, end - from);
        from = end + 1;
        if (part == ".." && !parts.empty()) parts.pop_back();
        if (!part.empty() && part != "." && part != "..") parts.push_back(part);
    }
    path.clear();
    for (const std::string& part : parts) path += "/" + part;
    return path;
}

}  // namespace

void OsimFrames::add(const std::string& path, const XmlElement& element, int body) {
    if (!by_path_.emplace(path, frames_.size()).second)
        file_.refuse(element, "there are two of this name (" + path + "); rename one");
    frames_.push_back({path, &element, body});
    for (const XmlElement* part : OsimFile::objects(element, "components"))
        if (part->kind == "PhysicalOffsetFrame") add(path + "/" + file_.name(*part), *part, -1);
}

const OsimFrames::Frame& OsimFrames::frame(const XmlElement& at, const std::string& named,
                                           const std::string& owner) const {
    if (named.empty()) file_.refuse(at, "names no body or frame; write the name of one");
    const std::string last = last_part(named);
    for (const std::string& path :
         {joined(owner, named), "/bodyset/" + last, last == "ground" ? "/ground" : std::string{}})
        if (const auto found = by_path_.find(path); found != by_path_.end())
            return frames_[found->second];
    const Frame* only = nullptr;
    for (const Frame& candidate : frames_) {
        if (!candidate.path.ends_with("/" + last)) continue;
        if (only)
            file_.refuse(at, "names '" + named + "', which may be " + only->path + " or " +
                                 candidate.path + "; write its whole path");
        only = &candidate;
    }
    if (!only)
        file_.refuse(
            at, "names '" + named + "', but the model has no such body or frame; correct the name");
    return *only;
}

OsimPlace OsimFrames::place(const Frame& start) const {
    Pose pose;
    const Frame* at = &start;
    for (std::size_t steps = 0; steps <= frames_.size(); ++steps) {
        if (at->body >= 0) return {at->body, pose};
        const XmlElement& offset = *at->element;
        pose = pose_of(file_.vector(offset, "translation", Vec3::Zero()),
                       file_.vector(offset, "orientation", Vec3::Zero())) *
               pose;
        at = &frame(offset, file_.word(offset, "socket_parent"), at->path);
    }
    file_.refuse(*start.element,
                 "is offset from frames that are offset from it, in a circle; let one of them "
                 "hang on a body");
}

OsimPlace OsimFrames::find(const XmlElement& at, const std::string& named,
                           const std::string& owner) const {
    return place(frame(at, named, owner));
}

}  // namespace myotet::skeleton
