// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "Skeleton/OsimFile.h"

namespace myotet::skeleton {

/// A place in a body.
struct OsimPlace {
    int body = 0;
    Pose in_body;
};

/// The frames of a model: its ground, its bodies, and frames offset from others. They go by
/// paths such as /ground, /bodyset/humerus or /jointset/elbow/humerus_offset.
class OsimFrames {
public:
    explicit OsimFrames(const OsimFile& file) : file_(file) {}

    /// A frame of its own: `body`; -1: one that is offset from another, as `element` says.
    /// And the frames among its `<components>`.
    void add(const std::string& path, const XmlElement& element, int body);

    /// The place that an element of the path `owner` names: by a path, by one from the
    /// owner's on, or by what ends a path. Throws InputError when there is none or more than
    /// one, or when frames are offset from each other in a circle.
    [[nodiscard]] OsimPlace find(const XmlElement& at, const std::string& named,
                                 const std::string& owner) const;

    struct Frame {
        std::string path;
        const XmlElement* element = nullptr;
        int body = -1;
    };
    /// In the order in which they were added.
    [[nodiscard]] const std::vector<Frame>& all() const { return frames_; }
    [[nodiscard]] OsimPlace place(const Frame& frame) const;

private:
    [[nodiscard]] const Frame& frame(const XmlElement& at, const std::string& named,
                                     const std::string& owner) const;

    const OsimFile& file_;
    std::vector<Frame> frames_;
    std::map<std::string, std::size_t> by_path_;
};

}  // namespace myotet::skeleton
