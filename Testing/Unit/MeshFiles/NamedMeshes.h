// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MeshFiles/MeshFiles.h"

namespace myotet::meshfiles {

/// Three tetrahedra in a row: label 12, then two of label 7 in between and
/// beyond, so that the numbers of the file are not in the order of the labels.
inline NamedMesh three_tets() {
    TetMesh mesh{{{0, 0, 0},
                  {1, 0, 0},
                  {0, 1, 0},
                  {0.1, 1.0 / 3, 1.5},
                  {0.1, 0.2, -1},
                  {-1.25e-5, -4, -123.456789012345}},
                 {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 5, 4}},
                 {12, 7, 12}};
    return with_named_boundary(std::move(mesh),
                               {{7, "biceps"}, {12, "M. triceps, caput <longum> & more"}});
}

}  // namespace myotet::meshfiles
