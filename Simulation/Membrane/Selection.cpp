// SPDX-License-Identifier: Apache-2.0
#include "Core/Errors.h"
#include "Membrane/Active.h"

namespace myotet::membrane {

namespace {

// Whether beyond one of the fine half-edges on a triangle's sides lies something refined.
bool finer_beside(const Levels& levels, const Selection& selection, int level,
                  std::int32_t triangle) {
    if (level + 1 >= levels.finest()) return false;
    const HalfEdges& fine = levels.meshes[level + 1];
    for (std::int32_t i = 0; i < 3; ++i)
        for (const std::int32_t h :
             {3 * (4 * triangle + i), 3 * (4 * triangle + (i + 1) % 3) + 2}) {
            const std::int32_t beyond = fine.twin[h];
            if (beyond >= 0 && selection.exists(level + 1, beyond / 3) &&
                selection.is_refined(level + 1, beyond / 3))
                return true;
        }
    return false;
}

}  // namespace

Selection::Selection(const Levels& levels) {
    for (const HalfEdges& mesh : levels.meshes) refined.emplace_back(mesh.triangles.size(), 0);
}

void refine(const Levels& levels, Selection& selection, int level, std::int32_t triangle) {
    MYOTET_CHECK(level < levels.finest() && selection.exists(level, triangle),
                 "a triangle to be refined must be in use");
    if (selection.is_refined(level, triangle)) return;
    for (std::int32_t h = 3 * triangle; level > 0 && h < 3 * triangle + 3; ++h) {
        const std::int32_t beyond = levels.meshes[level].twin[h];
        if (beyond >= 0 && !selection.exists(level, beyond / 3))
            refine(levels, selection, level - 1, beyond / 12);
    }
    selection.refined[level][triangle] = 1;
}

bool simplify(const Levels& levels, Selection& selection, int level, std::int32_t triangle) {
    if (!selection.exists(level, triangle) || !selection.is_refined(level, triangle)) return false;
    for (std::int32_t part = 4 * triangle; part < 4 * triangle + 4; ++part)
        if (level + 1 < levels.finest() && selection.is_refined(level + 1, part)) return false;
    if (finer_beside(levels, selection, level, triangle)) return false;
    selection.refined[level][triangle] = 0;
    return true;
}

Selection wholly_refined(const Levels& levels, int level) {
    Selection selection(levels);
    for (int l = 0; l < level; ++l) selection.refined[l].assign(selection.refined[l].size(), 1);
    return selection;
}

}  // namespace myotet::membrane
