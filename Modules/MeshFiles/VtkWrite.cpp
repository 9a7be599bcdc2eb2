// SPDX-License-Identifier: Apache-2.0
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "MeshFiles/MeshFiles.h"

namespace myotet::meshfiles {
namespace {

void add_text(vtkDataSet& grid, const char* name, const std::string& text) {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    array->InsertNextValue(text);
    grid.GetFieldData()->AddArray(array);
}

vtkNew<vtkPoints> make_points(const std::vector<Vec3>& positions) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(positions.size()));
    for (std::size_t i = 0; i < positions.size(); ++i)
        points->SetPoint(static_cast<vtkIdType>(i), positions[i].data());
    return points;
}

/// Elements of N corners each.
template <std::size_t N>
vtkNew<vtkCellArray> make_cells(const std::vector<std::array<std::int32_t, N>>& elements) {
    vtkNew<vtkTypeInt32Array> offsets, corners;
    offsets->SetNumberOfValues(static_cast<vtkIdType>(elements.size() + 1));
    corners->SetNumberOfValues(static_cast<vtkIdType>(N * elements.size()));
    for (std::size_t e = 0; e <= elements.size(); ++e)
        offsets->SetValue(static_cast<vtkIdType>(e), static_cast<std::int32_t>(N * e));
    for (std::size_t e = 0; e < elements.size(); ++e)
        for (std::size_t i = 0; i < N; ++i)
            corners->SetValue(static_cast<vtkIdType>(N * e + i), elements[e][i]);
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets, corners);
    return cells;
}

void set_labels(vtkUnstructuredGrid& grid, const TetMesh& mesh) {
    vtkNew<vtkTypeInt32Array> labels;
    labels->SetName("label");
    labels->SetNumberOfValues(static_cast<vtkIdType>(mesh.tets.size()));
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        labels->SetValue(static_cast<vtkIdType>(t), mesh.labels.empty() ? 0 : mesh.labels[t]);
    grid.GetCellData()->AddArray(labels);
}

/// Frame, unit and label names, as field data.
void add_facts(vtkDataSet& data, const std::map<std::int32_t, std::string>& label_names) {
    add_text(data, "SPACE", "LPS");
    add_text(data, "units", "mm");
    vtkNew<vtkStringArray> names;
    names->SetName("label_names");
    for (const auto& [value, name] : label_names)
        names->InsertNextValue(std::to_string(value) + "=" + name);
    data.GetFieldData()->AddArray(names);
}

/// Throws MeshError unless `arrays` can stand at `count` points or cells.
void check_arrays(const std::vector<NamedArray>& arrays, std::size_t count,
                  std::set<std::string> taken, const std::filesystem::path& file) {
    for (const NamedArray& array : arrays) {
        const auto refuse = [&](const std::string& why) {
            throw MeshError(file.string() + ": the array '" + array.name + "' " + why);
        };
        if (array.name.empty() || !taken.insert(array.name).second)
            refuse("has no name or one that is taken; give each a name of its own");
        if (array.components < 1 ||
            array.values.size() != count * static_cast<std::size_t>(array.components))
            refuse("has " + std::to_string(array.values.size()) + " values, but " +
                   std::to_string(array.components) + " for each of " + std::to_string(count) +
                   " are needed");
        const auto bad = std::ranges::find_if_not(
            array.values, [](double value) { return std::isfinite(value); });
        if (bad != array.values.end())
            refuse("holds " + std::to_string(*bad) + " at " +
                   std::to_string((bad - array.values.begin()) / array.components) +
                   " (from 0), which is not a finite number");
    }
}

void add_arrays(vtkFieldData& data, const std::vector<NamedArray>& arrays) {
    for (const NamedArray& array : arrays) {
        vtkNew<vtkDoubleArray> numbers;
        numbers->SetName(array.name.c_str());
        numbers->SetNumberOfComponents(array.components);
        numbers->SetNumberOfTuples(static_cast<vtkIdType>(
            array.values.size() / static_cast<std::size_t>(array.components)));
        std::ranges::copy(array.values, numbers->GetPointer(0));
        data.AddArray(numbers);
    }
}

template <class Writer>
void write_xml(vtkDataSet& data, const std::filesystem::path& file) {
    write_atomically(file, [&](const std::filesystem::path& temporary) {
        vtkNew<Writer> writer;
        vtkNew<vtkCallbackCommand> hear;  // an observed error is not printed
        writer->AddObserver(vtkCommand::ErrorEvent, hear);
        vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // but logged all the same
        writer->SetInputData(&data);
        writer->SetFileName(temporary.c_str());
        writer->SetDataModeToAppended();
        writer->EncodeAppendedDataOff();
        writer->SetCompressorTypeToZLib();
        writer->SetHeaderTypeToUInt64();
        if (writer->Write() != 1 || writer->GetErrorCode() != vtkErrorCode::NoError)
            throw IoError(file.string() + ": cannot be written (" +
                          vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()) +
                          "); check that the folder exists, may be written to and has space left");
    });
}

}  // namespace

void write_vtu(const TetMesh& mesh, const std::map<std::int32_t, std::string>& label_names,
               const std::filesystem::path& file) {
    write_vtu(mesh, label_names, MeshArrays{}, file);
}

void write_vtu(const TetMesh& mesh, const std::map<std::int32_t, std::string>& label_names,
               const MeshArrays& arrays, const std::filesystem::path& file) {
    if (!mesh.labels.empty() && mesh.labels.size() != mesh.tets.size())
        throw MeshError(file.string() + ": the mesh has " + std::to_string(mesh.labels.size()) +
                        " labels for " + std::to_string(mesh.tets.size()) +
                        " tetrahedra; give one label each or none");
    check_arrays(arrays.points, mesh.points.size(), {}, file);
    check_arrays(arrays.cells, mesh.tets.size(), {"label"}, file);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(make_points(mesh.points));
    grid->SetCells(VTK_TETRA, make_cells(mesh.tets));
    set_labels(*grid, mesh);
    add_arrays(*grid->GetPointData(), arrays.points);
    add_arrays(*grid->GetCellData(), arrays.cells);
    add_facts(*grid, label_names);
    if (arrays.time) add_arrays(*grid->GetFieldData(), {{"TimeValue", 1, {*arrays.time}}});
    write_xml<vtkXMLUnstructuredGridWriter>(*grid, file);
}

void write_vtu(const TriMesh& surface, const std::map<std::int32_t, std::string>& label_names,
               const MeshArrays& arrays, const std::filesystem::path& file) {
    check_arrays(arrays.points, surface.points.size(), {}, file);
    check_arrays(arrays.cells, surface.triangles.size(), {}, file);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(make_points(surface.points));
    grid->SetCells(VTK_TRIANGLE, make_cells(surface.triangles));
    add_arrays(*grid->GetPointData(), arrays.points);
    add_arrays(*grid->GetCellData(), arrays.cells);
    add_facts(*grid, label_names);
    if (arrays.time) add_arrays(*grid->GetFieldData(), {{"TimeValue", 1, {*arrays.time}}});
    write_xml<vtkXMLUnstructuredGridWriter>(*grid, file);
}

void write_vtp(const TriMesh& surface, const std::map<std::int32_t, std::string>& label_names,
               const std::filesystem::path& file) {
    vtkNew<vtkPolyData> data;
    data->SetPoints(make_points(surface.points));
    data->SetPolys(make_cells(surface.triangles));
    add_facts(*data, label_names);
    write_xml<vtkXMLPolyDataWriter>(*data, file);
}

}  // namespace myotet::meshfiles
