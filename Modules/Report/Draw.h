// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "Core/TetMesh.h"
#include "Report/Picture.h"

namespace myotet::report {

/// A surface to be drawn; open ones are seen from both sides.
struct Shape {
    TriMesh surface;  ///< LPS, mm
    /// |F| numbers to be shown by colour, or none; NaN: this triangle has the shape's colour.
    std::vector<double> values;
    Colour colour{0.8, 0.8, 0.8};
};

/// From where shapes are looked at, and how.
struct View {
    Vec3 direction = Vec3::UnitY();  ///< the way one looks, of any length: from the front
    Vec3 up = Vec3::UnitZ();         ///< what is up in the picture; not along the direction
    int width = 480, height = 640;   ///< pixels
    double least = 0, most = 1;      ///< values of the ends of the colour map
    std::string values_name;         ///< above the colour bar
    std::string title;               ///< above the picture
    Box fit;                         ///< shown wholly; empty: the box around all shapes
};

/// Draws shapes as seen from far away (parallel rays), on white, with a light behind the
/// viewer, a title, and a colour bar where a shape has values. Of what lies behind one
/// another the nearer is drawn, of equally near triangles the first. The same bytes on any
/// number of threads.
///
/// A point x is drawn at (right . x, up . x) and is direction . x away; a triangle of unit
/// normal n is as bright as a + (1 - a) |n . direction| (Lambert's law, ambient light
/// a = 0.35). Depths are compared in a buffer [Catmull74] at 3 x 3 samples a pixel, whose mean is
/// the pixel; a sample is in a triangle where its three edge functions have one sign
/// [Pineda88].
///
/// Throws InputError when view or shapes break a rule: directions of no length or along one
/// another, sides that are not from 64 pixels to kLongestSide, a range without extent,
/// values that are not one a triangle, an index out of range, a point or box that is not
/// finite or beyond 1e9 mm.
/// Cost: triangles, and samples times the layers above them; 24 bytes a point, 100 a triangle.
[[nodiscard]] Picture draw(std::span<const Shape> shapes, const View& view);

}  // namespace myotet::report
