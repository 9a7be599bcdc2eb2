// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "Contraction/ContactBody.h"
#include "Contraction/ContactBone.h"
#include "Contraction/Scene.h"

namespace myotet::contraction {

/// One side of a contact of a scene: nodes of a body, and what they must stay out of.
struct ContactSide {
    std::size_t contact = 0;  ///< in Scene::contacts
    ContactNodes nodes;       ///< among all nodes
    ContactField other;
    std::int32_t bone = -1;  ///< in Scene::bones; -1: the other is a body
    std::vector<Tet> tets;   ///< of the other body, among all nodes
};

/// All contacts of a scene while it is solved.
class SceneContacts {
public:
    /// The scene must outlive it; `rest` are all nodes.
    SceneContacts(const Scene& scene, const std::vector<ContactSide>& sides,
                  const std::vector<Vec3>& rest);

    [[nodiscard]] std::vector<dynamics::Potential*> potentials() const;
    /// Moves the bones to where they are.
    void set_time(double time);
    /// Looks which nodes are near which bodies; true when that changed.
    bool update_pairs(const std::vector<Vec3>& x);
    void forget();  ///< of each side
    /// Of each contact of the scene, both sides together.
    [[nodiscard]] std::vector<ContactReport> reports() const;

private:
    struct Side {
        std::size_t contact = 0;
        std::int32_t bone = -1;
        std::unique_ptr<BoneContact> with_bone;
        std::unique_ptr<BodyContact> with_body;
    };
    const Scene& scene_;
    std::vector<Side> sides_;
};

}  // namespace myotet::contraction
