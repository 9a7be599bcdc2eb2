// SPDX-License-Identifier: Apache-2.0
// Whatever VTK's writers write, we read; whatever becomes of it, nothing breaks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkShortArray.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "Core/Errors.h"
#include "MeshFiles/RawMesh.h"
#include "MeshFiles/RawSurface.h"
#include "NamedMeshes.h"
#include "Support/TemporaryFolder.h"

namespace myotet::meshfiles {
namespace {

using myotet::testing::read_bytes;
using myotet::testing::TemporaryFolder;
using ::testing::HasSubstr;

/// One way in which VTK writes.
struct Way {
    int mode = vtkXMLWriter::Appended;
    int compressor = vtkXMLWriter::NONE;
    bool base64 = false, big_endian = false, wide_headers = true;
};

std::vector<Way> all_ways() {
    std::vector<Way> ways;
    for (const bool big : {false, true})
        for (const bool wide : {false, true}) {
            ways.push_back({vtkXMLWriter::Ascii, vtkXMLWriter::NONE, false, big, wide});
            for (const int compressor :
                 {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4, vtkXMLWriter::LZMA}) {
                ways.push_back({vtkXMLWriter::Binary, compressor, true, big, wide});
                ways.push_back({vtkXMLWriter::Appended, compressor, true, big, wide});
                ways.push_back({vtkXMLWriter::Appended, compressor, false, big, wide});
            }
        }
    return ways;
}

/// The order and width of the bytes change nothing in what can be damaged, and
/// LZMA, which is slow to begin with, is damaged in one way only.
std::vector<Way> ways_to_damage() {
    std::vector<Way> ways = all_ways();
    std::erase_if(ways, [](const Way& way) {
        return way.big_endian || !way.wide_headers ||
               (way.compressor == vtkXMLWriter::LZMA && way.base64);
    });
    return ways;
}

template <class Writer>
std::string written(vtkDataSet& data, const Way& way) {
    vtkNew<Writer> writer;
    writer->SetInputData(&data);
    writer->SetDataMode(way.mode);
    writer->SetCompressorType(way.compressor);
    writer->SetEncodeAppendedData(way.base64);
    writer->SetByteOrder(way.big_endian ? vtkXMLWriter::BigEndian : vtkXMLWriter::LittleEndian);
    writer->SetHeaderType(way.wide_headers ? vtkXMLWriter::UInt64 : vtkXMLWriter::UInt32);
    if (way.compressor != vtkXMLWriter::NONE) writer->SetBlockSize(32);  // several blocks an array
    writer->WriteToOutputStringOn();
    EXPECT_EQ(writer->Write(), 1);
    return writer->GetOutputString();
}

void add_facts(vtkDataSet& data) {
    vtkNew<vtkStringArray> space, names;
    space->SetName("SPACE");
    space->InsertNextValue("RAS");
    names->SetName("label_names");
    names->InsertNextValue("7=biceps");
    names->InsertNextValue("12=M. triceps <longum> & more");
    data.GetFieldData()->AddArray(space);
    data.GetFieldData()->AddArray(names);
}

vtkNew<vtkPoints> points_of(const std::vector<Vec3>& places) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Vec3& p : places) points->InsertNextPoint(p.data());
    return points;
}

/// The tetrahedra of three_tets and a triangle, which is no part of the mesh.
vtkNew<vtkUnstructuredGrid> grid() {
    const TetMesh mesh = three_tets().mesh;
    vtkNew<vtkUnstructuredGrid> data;
    data->SetPoints(points_of(mesh.points));
    vtkNew<vtkShortArray> labels;
    labels->SetName("label");
    const vtkIdType triangle[] = {0, 1, 2};
    data->InsertNextCell(VTK_TRIANGLE, 3, triangle);
    labels->InsertNextValue(99);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const std::vector<vtkIdType> corners(mesh.tets[t].begin(), mesh.tets[t].end());
        data->InsertNextCell(VTK_TETRA, 4, corners.data());
        labels->InsertNextValue(static_cast<short>(mesh.labels[t]));
    }
    data->GetCellData()->AddArray(labels);
    add_facts(*data);
    return data;
}

/// A quadrilateral, a triangle and a strip of two triangles.
vtkNew<vtkPolyData> sheet() {
    vtkNew<vtkPolyData> data;
    data->SetPoints(points_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 1}, {2, 1, 1}}));
    vtkNew<vtkCellArray> polygons, strips;
    const vtkIdType quad[] = {0, 1, 2, 3}, triangle[] = {1, 4, 2}, strip[] = {4, 5, 2, 3};
    polygons->InsertNextCell(4, quad);
    polygons->InsertNextCell(3, triangle);
    strips->InsertNextCell(4, strip);
    data->SetPolys(polygons);
    data->SetStrips(strips);
    add_facts(*data);
    return data;
}

NamedMesh read_vtu_text(const std::string& content) {
    return checked(parse_vtu(content, "a.vtu"), "a.vtu");
}

TEST(VtkRead, UnstructuredGridsOfEveryWay) {
    const NamedMesh mesh = three_tets();
    for (const Way& way : all_ways()) {
        const NamedMesh back = read_vtu_text(written<vtkXMLUnstructuredGridWriter>(*grid(), way));
        ASSERT_EQ(back.mesh.points.size(), mesh.mesh.points.size());
        for (std::size_t p = 0; p < back.mesh.points.size(); ++p)  // RAS became LPS
            for (int a = 0; a < 3; ++a)
                EXPECT_DOUBLE_EQ(back.mesh.points[p][a], (a < 2 ? -1 : 1) * mesh.mesh.points[p][a]);
        EXPECT_EQ(back.mesh.tets, mesh.mesh.tets);
        EXPECT_EQ(back.mesh.labels, mesh.mesh.labels);
        EXPECT_EQ(back.names.at(12), "M. triceps <longum> & more");
    }
}

TEST(VtkRead, PolyDataOfEveryWay) {
    for (const Way& way : all_ways()) {
        const RawSurface back = parse_vtp(written<vtkXMLPolyDataWriter>(*sheet(), way), "a.vtp");
        EXPECT_EQ(back.space, "RAS");
        ASSERT_EQ(back.points.size(), 6u);
        EXPECT_EQ(back.points[5], Vec3(2, 1, 1));
        const std::vector<std::array<std::int64_t, 3>> triangles{
            {0, 1, 2}, {0, 2, 3}, {1, 4, 2}, {4, 5, 2}, {2, 5, 3}};
        EXPECT_EQ(back.triangles, triangles);
    }
}

/// Law: whatever byte is changed, a mesh comes out that holds together, or an Error.
TEST(VtkRead, ChangedBytesNeverBreakAnything) {
    for (const Way& way : ways_to_damage()) {
        const std::string whole = written<vtkXMLUnstructuredGridWriter>(*grid(), way);
        for (std::size_t at = 0; at < whole.size(); ++at)
            for (const int pattern : {0x15, 0x80}) {
                std::string damaged = whole;
                damaged[at] = static_cast<char>(damaged[at] ^ pattern);
                try {
                    const NamedMesh back = read_vtu_text(damaged);
                    for (const Tet& t : back.mesh.tets)
                        for (const std::int32_t n : t)
                            ASSERT_LT(static_cast<std::size_t>(n), back.mesh.points.size());
                } catch (const Error&) {
                }
            }
    }
}

TEST(VtkRead, ChangedBytesOfSurfacesNeverBreakAnything) {
    const auto count = static_cast<std::int64_t>(sheet()->GetNumberOfPoints());
    for (const Way& way : ways_to_damage()) {
        const std::string whole = written<vtkXMLPolyDataWriter>(*sheet(), way);
        for (std::size_t at = 0; at < whole.size(); ++at)
            for (const int pattern : {0x15, 0x80}) {
                std::string damaged = whole;
                damaged[at] = static_cast<char>(damaged[at] ^ pattern);
                try {
                    const RawSurface back = parse_vtp(damaged, "a.vtp");
                    for (const auto& t : back.triangles)
                        for (const std::int64_t n : t) ASSERT_TRUE(n >= 0 && n < count);
                } catch (const Error&) {
                }
            }
    }
}

/// Law: a file that is cut short anywhere before its last sign is refused.
TEST(VtkRead, CutFilesAreRefused) {
    for (const Way& way : ways_to_damage()) {
        std::string whole = written<vtkXMLUnstructuredGridWriter>(*grid(), way);
        whole.erase(whole.find_last_not_of(" \n") + 1);
        for (std::size_t length = 0; length < whole.size(); length += 7)
            EXPECT_THROW((void)parse_vtu(whole.substr(0, length), "a.vtu"), Error) << length;
        EXPECT_THROW((void)parse_vtu(whole.substr(0, whole.size() - 1), "a.vtu"), Error);
    }
}

/// Several pieces are one mesh; headers and data may be base64 texts of their own.
const char* const kPieces =
    R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">
<UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="1">
<Points><DataArray type="Float32" NumberOfComponents="3">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity">0 1 2 3</DataArray>
<DataArray type="Int8" Name="offsets" format="binary">AQAAAA==BA==</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells>
</Piece>
<Piece NumberOfPoints="0" NumberOfCells="0"/>
<Piece NumberOfPoints="4" NumberOfCells="1">
<CellData><DataArray type="Float64" Name="label" NumberOfComponents="2">7 8</DataArray></CellData>
<Points><DataArray type="Float32" NumberOfComponents="3">5 0 0 6 0 0 5 1 0 5 0 1</DataArray></Points>
<Cells><DataArray type="UInt16" Name="connectivity">0 1 2 3</DataArray>
<DataArray type="UInt64" Name="offsets">4</DataArray>
<DataArray type="UInt8" Name="types">10</DataArray></Cells>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";

TEST(VtkRead, PiecesAreOneMesh) {
    const NamedMesh mesh = read_vtu_text(kPieces);
    EXPECT_THAT(mesh.mesh.tets, ::testing::ElementsAre(Tet{0, 1, 2, 3}, Tet{4, 5, 6, 7}));
    EXPECT_THAT(mesh.mesh.labels, ::testing::ElementsAre(0, 7));
    EXPECT_EQ(mesh.mesh.points[5], Vec3(6, 0, 0));
}

std::string complaint(const std::string& from, const std::string& to) {
    std::string text = kPieces;
    const std::size_t at = text.rfind(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    try {
        (void)read_vtu_text(text);
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("a.vtu: "));
        return error.what();
    }
    return "no complaint";
}

TEST(VtkRead, DamageIsNamedWithItsLine) {
    EXPECT_THAT(complaint("<VTKFile", "<Other"), HasSubstr("line 18 is not valid XML"));
    EXPECT_THAT(complaint("UnstructuredGrid\" v", "PolyData\" v"),
                HasSubstr("is of type 'PolyData', but UnstructuredGrid is needed"));
    EXPECT_THAT(complaint("byte_order=\"L", "byte_order=\"M"), HasSubstr("MittleEndian"));
    EXPECT_THAT(complaint("version=", "header_type=\"UInt65\" version="), HasSubstr("UInt65"));
    EXPECT_THAT(complaint("version=", "compressor=\"vtkMyCompressor\" version="),
                HasSubstr("line 1 says compressor=\"vtkMyCompressor\", which is not known"));
    EXPECT_THAT(complaint("\"UInt64\"", "\"UInt63\""), HasSubstr("line 14 says type=\"UInt63\""));
    EXPECT_THAT(complaint(" type=\"UInt64\"", ""), HasSubstr("line 14 says type=\"\""));
    EXPECT_THAT(complaint("\"UInt64\"", "\"Float32\""), HasSubstr("where integers are needed"));
    EXPECT_THAT(complaint("format=\"ascii\"", "format=\"asci\""), HasSubstr("format=\"asci\""));
    EXPECT_THAT(complaint("format=\"ascii\"", "format=\"appended\""), HasSubstr("offset"));
    EXPECT_THAT(complaint("format=\"ascii\"", "format=\"appended\" offset=\"9\""),
                HasSubstr("behind the end"));
    EXPECT_THAT(complaint("format=\"ascii\"", "format=\"binary\""), HasSubstr("ends too early"));
    EXPECT_THAT(complaint("AQAAAA==", "A=AAAA=="), HasSubstr("not in base64"));
    EXPECT_THAT(complaint("=BA==", "=B"), HasSubstr("ends too early"));
}

TEST(VtkRead, NumbersThatDoNotFitAreNamed) {
    EXPECT_THAT(complaint("NumberOfPoints=\"4\"", "NumberOfPoints=\"5\""),
                HasSubstr("three coordinates a point"));
    EXPECT_THAT(complaint("NumberOfPoints=\"4\"", "NumberOfPoints=\"-4\""),
                HasSubstr("a count is needed"));
    EXPECT_THAT(complaint("NumberOfCells=\"1\"", "NumberOfCells=\"2\""),
                HasSubstr("one offset a cell"));
    EXPECT_THAT(complaint("\"UInt64\" Name=\"offsets\">4", "\"UInt64\" Name=\"offsets\">5"),
                HasSubstr("point past their own list"));
    EXPECT_THAT(complaint("\"types\">10", "\"types\">10 10"), HasSubstr("one type a cell"));
    EXPECT_THAT(complaint("\"types\">10", "\"types\">12"), HasSubstr("VTK's type 12"));
    EXPECT_THAT(complaint("\"connectivity\">0 1 2 3", "\"connectivity\">0 1 2 4"),
                HasSubstr("names point 4, but there are 4"));
    EXPECT_THAT(complaint(">7 8<", ">7.5 8<"), HasSubstr("no label of 32 bits"));
    EXPECT_THAT(complaint(">7 8<", ">1e99 8<"), HasSubstr("no label of 32 bits"));
    EXPECT_THAT(complaint(">7 8<", "><"), HasSubstr("one label a cell"));
    EXPECT_THAT(complaint("5 0 0 6", "5 zero 0 6"), HasSubstr("holds 'zero'"));
    EXPECT_THAT(complaint("5 0 0 6", "5 nan 0 6"), HasSubstr("not a finite number"));
}

/// Lengths that ask for more memory than their bytes can stand for are refused
/// before it is taken: here 2^62 bytes in one block.
TEST(VtkRead, LyingLengthsTakeNoMemory) {
    const Way way{vtkXMLWriter::Appended, vtkXMLWriter::ZLIB, false, false, true};
    std::string text = written<vtkXMLUnstructuredGridWriter>(*grid(), way);
    const std::size_t lengths = text.find('_', text.find("<AppendedData")) + 1;
    for (const std::size_t which : {0, 2, 3}) {  // blocks, bytes of the last one, stored bytes
        std::string lie = text;
        lie[lengths + 8 * which + 7] = 0x40;
        EXPECT_THROW((void)parse_vtu(lie, "a.vtu"), Error) << which;
    }
}

}  // namespace
}  // namespace myotet::meshfiles
