// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "MeshFiles/MeshFiles.h"
#include "Support/TemporaryFolder.h"

namespace myotet::meshfiles {
namespace {

TEST(VtkLegacy, numbers_are_big_endian_after_their_headings) {
    const testing::TemporaryFolder folder;
    TriMesh mesh;
    mesh.points = {{1, 0, 0}, {0, 2, 0}, {0, 0, 0.5}};
    mesh.triangles = {{0, 1, 2}};
    write_vtk(mesh, folder / "one.vtk");
    const std::string bytes = testing::read_bytes(folder / "one.vtk");
    const std::string points = "POINTS 3 double\n", polygons = "\nPOLYGONS 1 4\n";
    const std::size_t first = bytes.find(points) + points.size();
    // 1.0 is 3ff0000000000000, 2.0 is 4000000000000000, 0.5 is 3fe0000000000000.
    EXPECT_EQ(bytes.substr(first, 8), std::string("\x3f\xf0\0\0\0\0\0\0", 8));
    EXPECT_EQ(bytes.substr(first + 4 * 8, 8), std::string("\x40\0\0\0\0\0\0\0", 8));
    EXPECT_EQ(bytes.substr(first + 8 * 8, 8), std::string("\x3f\xe0\0\0\0\0\0\0", 8));
    EXPECT_EQ(bytes.substr(first + 9 * 8, polygons.size()), polygons);
    EXPECT_EQ(bytes.substr(first + 9 * 8 + polygons.size()),
              std::string("\0\0\0\3\0\0\0\0\0\0\0\1\0\0\0\2\n", 17));
    EXPECT_NE(bytes.find("SPACE=LPS; UNIT=mm"), std::string::npos);
}

}  // namespace
}  // namespace myotet::meshfiles
