// SPDX-License-Identifier: Apache-2.0
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "MeshFiles/MeshFiles.h"

namespace myotet::meshfiles {
namespace {

void add_text(vtkUnstructuredGrid& grid, const char* name, const std::string& text) {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    array->InsertNextValue(text);
    grid.GetFieldData()->AddArray(array);
}

void set_tets(vtkUnstructuredGrid& grid, const TetMesh& mesh) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        points->SetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
    grid.SetPoints(points);

    vtkNew<vtkTypeInt32Array> offsets, corners;
    offsets->SetNumberOfValues(static_cast<vtkIdType>(mesh.tets.size() + 1));
    corners->SetNumberOfValues(static_cast<vtkIdType>(4 * mesh.tets.size()));
    for (std::size_t t = 0; t <= mesh.tets.size(); ++t)
        offsets->SetValue(static_cast<vtkIdType>(t), static_cast<std::int32_t>(4 * t));
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        for (int i = 0; i < 4; ++i)
            corners->SetValue(static_cast<vtkIdType>(4 * t + i), mesh.tets[t][i]);
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets, corners);
    grid.SetCells(VTK_TETRA, cells);
}

void set_labels(vtkUnstructuredGrid& grid, const TetMesh& mesh) {
    vtkNew<vtkTypeInt32Array> labels;
    labels->SetName("label");
    labels->SetNumberOfValues(static_cast<vtkIdType>(mesh.tets.size()));
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        labels->SetValue(static_cast<vtkIdType>(t), mesh.labels.empty() ? 0 : mesh.labels[t]);
    grid.GetCellData()->AddArray(labels);
}

}  // namespace

void write_vtu(const TetMesh& mesh, const std::map<std::int32_t, std::string>& label_names,
               const std::filesystem::path& file) {
    if (!mesh.labels.empty() && mesh.labels.size() != mesh.tets.size())
        throw MeshError(file.string() + ": the mesh has " + std::to_string(mesh.labels.size()) +
                        " labels for " + std::to_string(mesh.tets.size()) +
                        " tetrahedra; give one label each or none");
    vtkNew<vtkUnstructuredGrid> grid;
    set_tets(*grid, mesh);
    set_labels(*grid, mesh);
    add_text(*grid, "SPACE", "LPS");
    add_text(*grid, "units", "mm");
    vtkNew<vtkStringArray> names;
    names->SetName("label_names");
    for (const auto& [value, name] : label_names)
        names->InsertNextValue(std::to_string(value) + "=" + name);
    grid->GetFieldData()->AddArray(names);

    write_atomically(file, [&](const std::filesystem::path& temporary) {
        vtkNew<vtkXMLUnstructuredGridWriter> writer;
        vtkNew<vtkCallbackCommand> hear;  // an observed error is not printed
        writer->AddObserver(vtkCommand::ErrorEvent, hear);
        vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // but logged all the same
        writer->SetInputData(grid);
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

}  // namespace myotet::meshfiles
