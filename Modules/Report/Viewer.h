// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "Core/TetMesh.h"
#include "Report/Picture.h"

namespace myotet::report {

/// A quantity that bodies may be coloured by, and the values of the first and last colour.
struct ViewedQuantity {
    std::string name;  ///< text, with its unit
    double least = 0, most = 1;
};

/// Values of a quantity on a body.
struct ViewedValues {
    std::size_t quantity = 0;  ///< of ViewedScene::quantities
    enum class At { points, tets } at = At::tets;
    /// By time; one where they do not change. A number a point or tetrahedron; one that is not
    /// finite: none there.
    std::vector<std::vector<double>> times;
};

/// What is switched on and off as one: tetrahedra or, where there are none, a surface.
struct ViewedBody {
    std::string name;  ///< text
    Colour colour{};
    TetMesh mesh;
    TriMesh surface;                         ///< looked at when `mesh` has no tetrahedra
    std::vector<std::vector<Vec3>> moments;  ///< the points at each time; empty: they stay
    std::vector<ViewedValues> values;
    /// By time, a direction a tetrahedron, zero: none; empty: no fibres.
    std::vector<std::vector<Vec3>> fibres;
};

/// All that a viewer shows.
struct ViewedScene {
    std::vector<ViewedBody> bodies;
    std::vector<ViewedQuantity> quantities;
    std::vector<double> times;       ///< s; empty: nothing moves
    std::vector<std::string> notes;  ///< texts below the view
};

/// Whether this build holds the viewer's program.
[[nodiscard]] bool has_viewer();

/// The viewer with its data, as an element of a page; one viewer a page. Coordinates are
/// rounded to a 65 535th of a body's box, values to 254 steps between the limits of their
/// quantity, fibres to 3 000 a body. Without the program, a sentence that says so; without
/// bodies, the notes.
/// Throws InputError when values or moments are not as many as points or tetrahedra.
[[nodiscard]] std::string viewer_html(const ViewedScene& scene);

}  // namespace myotet::report
