// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Switch.h"

namespace myotet::membrane {

namespace {

class Placing {
public:
    Placing(const Levels& levels, const Active& before, Motion& motion)
        : levels_(levels), motion_(motion), known_(motion.x.size(), 0) {
        for (const std::int32_t v : before.nodes) known_[v] = 1;
    }

    void bring(std::int32_t v) {
        if (known_[v]) return;
        const auto [a, b] = levels_.ends_of(v);
        const Stencil& stencil = levels_.stencil(v);
        Vec3 at = Vec3::Zero();
        for (std::size_t i = 0; i < stencil.vertices.size(); ++i)
            at += stencil.weights[i] * place(stencil.vertices[i]);
        motion_.x[v] = at;
        motion_.v[v] = 0.5 * (motion_.v[a] + motion_.v[b]);
        known_[v] = 1;
    }

private:
    const Levels& levels_;
    Motion& motion_;
    std::vector<char> known_;

    // Of a vertex not in use: beside the middle of its edge as at rest.
    Vec3 place(std::int32_t v) const {
        if (known_[v]) return motion_.x[v];
        const auto [a, b] = levels_.ends_of(v);
        return levels_.rest[v] + 0.5 * (place(a) - levels_.rest[a] + place(b) - levels_.rest[b]);
    }
};

}  // namespace

void switch_to(const Levels& levels, const Active& before, Active& after, Motion& motion) {
    Placing placing(levels, before, motion);
    for (const std::int32_t v : after.nodes) placing.bring(v);
    for (Hanging& h : after.hanging) {
        h.offset = motion.x[h.node] - 0.5 * (motion.x[h.a] + motion.x[h.b]);
        h.edge = (motion.x[h.b] - motion.x[h.a]).normalized();
    }
    follow(after, motion);
}

}  // namespace myotet::membrane
