// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>

#include "SceneFolder.h"

namespace myotet::contraction::bad {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// What stands at a place of a scene that is sound but for it.
struct Parts {
    std::string labels, body = "mesh: biceps.vtu", material = "belly";
    std::string more;  ///< of the body
    std::string materials = "belly: {model: blemker2005_muscle}";
    std::string bones = "radius: {surface: radius.stl}";
    std::string attachment = "body: biceps, to: radius, within: 2, end: origin";
    std::string attachments;  ///< besides the two
    std::string contact;
    std::string time = "end: 1, step: 0.1";
    std::string rest;
};

/// Lines: bodies 2 to 6, materials 8, bones 10, attachments 12 and 13, time 14.
inline std::string text_of(const Parts& p) {
    return "bodies:\n  biceps:\n    " + p.body + "\n    material: " + p.material +
           "\n    fibres: {from: laplace}\n    " + p.more + "\nmaterials:\n  " + p.materials +
           "\nbones:\n  " + p.bones + "\nattachments:\n  - {" + p.attachment +
           "}\n  - {body: biceps, to: fixed, node_set: top, end: insertion}\ntime: {" + p.time +
           "}\n" + p.attachments + p.labels + p.contact + p.rest;
}

inline std::string refusal(const Parts& parts) { return SceneFolder().refusal(text_of(parts)); }

}  // namespace myotet::contraction::bad
