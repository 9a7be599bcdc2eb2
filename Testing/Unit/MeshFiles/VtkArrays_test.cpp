// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <limits>

#include "Core/Errors.h"
#include "MeshFiles/MeshFiles.h"
#include "MeshFiles/VtuArrays.h"
#include "Support/TemporaryFolder.h"

namespace myotet::meshfiles {
namespace {

using myotet::testing::read_bytes;
using myotet::testing::TemporaryFolder;
using ::testing::HasSubstr;

TetMesh two_tets() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.2, -1}},
            {{0, 1, 2, 3}, {0, 2, 1, 4}},
            {7, 12}};
}

/// Numbers that no two places share, and that have no short text.
std::vector<double> numbers(std::size_t count) {
    std::vector<double> all;
    for (std::size_t i = 0; i < count; ++i) all.push_back(-1e-3 / (3.0 + static_cast<double>(i)));
    return all;
}

MeshArrays moment() {
    MeshArrays arrays;
    arrays.points = {{"displacement", 3, numbers(15)}, {"pressure", 1, numbers(5)}};
    arrays.cells = {{"fiber", 3, numbers(6)},
                    {"activation", 1, {0, 1}},
                    {"cauchy_stress", 9, numbers(18)},
                    {"J", 1, numbers(2)}};
    arrays.time = 0.35;
    return arrays;
}

void expect_same(vtkFieldData& data, const NamedArray& array) {
    auto* found = vtkDoubleArray::SafeDownCast(data.GetAbstractArray(array.name.c_str()));
    ASSERT_NE(found, nullptr) << array.name;
    EXPECT_EQ(found->GetNumberOfComponents(), array.components) << array.name;
    const double* first = found->GetPointer(0);
    EXPECT_EQ(std::vector<double>(first, first + found->GetNumberOfValues()), array.values);
}

TEST(VtuArrays, VtkReadsThemBackBitForBit) {
    const TemporaryFolder folder;
    const std::string file = folder / "a.vtu";
    write_vtu(two_tets(), {{7, "biceps"}}, moment(), file);
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    vtkUnstructuredGrid& grid = *reader->GetOutput();
    for (const NamedArray& array : moment().points) expect_same(*grid.GetPointData(), array);
    for (const NamedArray& array : moment().cells) expect_same(*grid.GetCellData(), array);
    expect_same(*grid.GetFieldData(), {"TimeValue", 1, {0.35}});
    EXPECT_NE(grid.GetCellData()->GetAbstractArray("label"), nullptr);
    EXPECT_NE(grid.GetFieldData()->GetAbstractArray("SPACE"), nullptr);
}

TEST(VtuArrays, OfTrianglesToo) {
    const TemporaryFolder folder;
    const std::string file = folder / "wall.vtu";
    const TriMesh wall{two_tets().points, {{0, 1, 2}, {0, 2, 4}, {1, 2, 3}}};
    MeshArrays arrays;
    arrays.points = {{"displacement", 3, numbers(15)}};
    arrays.cells = {{"label", 1, {4, 4, 4}}, {"level", 1, {0, 1, 1}}};
    arrays.time = 0.5;
    write_vtu(wall, {{4, "stomach"}}, arrays, file);
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    vtkUnstructuredGrid& grid = *reader->GetOutput();
    ASSERT_EQ(grid.GetNumberOfCells(), 3);
    EXPECT_EQ(grid.GetCellType(1), VTK_TRIANGLE);
    EXPECT_EQ(grid.GetCell(1)->GetPointId(2), 4);
    expect_same(*grid.GetPointData(), arrays.points[0]);
    for (const NamedArray& array : arrays.cells) expect_same(*grid.GetCellData(), array);
    expect_same(*grid.GetFieldData(), {"TimeValue", 1, {0.5}});
    arrays.cells[1].values.pop_back();
    EXPECT_THROW(write_vtu(wall, {}, arrays, file), MeshError);
}

TEST(VtuArrays, TheMeshIsReadAsWithoutThem) {
    const TemporaryFolder folder;
    write_vtu(two_tets(), {{7, "biceps"}}, moment(), folder / "a.vtu");
    const NamedMesh back = read_mesh(folder / "a.vtu");
    EXPECT_EQ(back.mesh.points, two_tets().points);
    EXPECT_EQ(back.mesh.tets, two_tets().tets);
    EXPECT_EQ(back.mesh.labels, two_tets().labels);
    EXPECT_EQ(back.names.at(7), "biceps");
}

TEST(VtuArrays, SameArraysSameBytesAndNoneAsBefore) {
    const TemporaryFolder folder;
    write_vtu(two_tets(), {}, moment(), folder / "a.vtu");
    write_vtu(two_tets(), {}, moment(), folder / "b.vtu");
    EXPECT_EQ(read_bytes(folder / "a.vtu"), read_bytes(folder / "b.vtu"));
    write_vtu(two_tets(), {}, folder / "c.vtu");
    write_vtu(two_tets(), {}, MeshArrays{}, folder / "d.vtu");
    EXPECT_EQ(read_bytes(folder / "c.vtu"), read_bytes(folder / "d.vtu"));
}

TEST(VtuArrays, AreReadBackBitForBit) {
    const TemporaryFolder folder;
    write_vtu(two_tets(), {{7, "biceps"}}, moment(), folder / "a.vtu");
    const MeshArrays back = read_vtu_arrays(folder / "a.vtu"), written = moment();
    EXPECT_EQ(back.time, written.time);
    const auto expect_all = [](const std::vector<NamedArray>& found,
                               const std::vector<NamedArray>& wanted) {
        ASSERT_EQ(found.size(), wanted.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(found[i].name, wanted[i].name);
            EXPECT_EQ(found[i].components, wanted[i].components);
            EXPECT_EQ(found[i].values, wanted[i].values);
        }
    };
    expect_all(back.points, written.points);
    expect_all(back.cells, written.cells);
    write_vtu(two_tets(), {}, folder / "b.vtu");
    EXPECT_FALSE(read_vtu_arrays(folder / "b.vtu").time);
    EXPECT_TRUE(read_vtu_arrays(folder / "b.vtu").cells.empty());
}

TEST(VtuArrays, OfADamagedFileAreRefused) {
    const TemporaryFolder folder;
    write_vtu(two_tets(), {}, moment(), folder / "a.vtu");
    std::string bytes = read_bytes(folder / "a.vtu");
    const std::string components = "NumberOfComponents=\"9\"";
    const std::size_t at = bytes.find(components);
    ASSERT_NE(at, std::string::npos);
    bytes.replace(at, components.size(), "NumberOfComponents=\"8\"");
    testing::write_bytes(folder / "b.vtu", bytes);
    EXPECT_THROW((void)read_vtu_arrays(folder / "b.vtu"), InputError);
    EXPECT_THROW((void)read_vtu_arrays(folder / "gone.vtu"), IoError);
}

std::string refusal(const MeshArrays& arrays) {
    const TemporaryFolder folder;
    try {
        write_vtu(two_tets(), {}, arrays, folder / "a.vtu");
    } catch (const MeshError& error) {
        EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
        return error.what();
    }
    return "no refusal";
}

TEST(VtuArrays, WhatDoesNotFitIsRefused) {
    EXPECT_THAT(refusal({.points = {{"u", 3, numbers(14)}}}),
                HasSubstr("'u' has 14 values, but 3 for each of 5 are needed"));
    EXPECT_THAT(refusal({.cells = {{"J", 0, {}}}}), HasSubstr("'J' has 0 values"));
    EXPECT_THAT(refusal({.cells = {{"label", 1, numbers(2)}}}), HasSubstr("taken"));
    EXPECT_THAT(refusal({.cells = {{"J", 1, numbers(2)}, {"J", 1, numbers(2)}}}),
                HasSubstr("taken"));
    EXPECT_THAT(refusal({.cells = {{"", 1, numbers(2)}}}), HasSubstr("no name"));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(refusal({.points = {{"u", 1, {0, 1, 2, nan, 4}}}}), HasSubstr("nan at 3 (from 0)"));
}

}  // namespace
}  // namespace myotet::meshfiles
