// SPDX-License-Identifier: Apache-2.0
#include "Report/Decimate.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricClustering.h>

#include <algorithm>
#include <cmath>

namespace myotet::report {
namespace {

// Triangles that a surface has in each cell of the grid that it goes through, about.
constexpr double kTrianglesPerCell = 2;

double area_of(const TriMesh& surface) {
    double area = 0;
    for (const auto& [a, b, c] : surface.triangles)
        area += 0.5 * (surface.points[b] - surface.points[a])
                          .cross(surface.points[c] - surface.points[a])
                          .norm();
    return area;
}

}  // namespace

TriMesh decimated(const TriMesh& surface, std::size_t triangles) {
    if (surface.triangles.size() <= triangles) return surface;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    Box box;
    for (const Vec3& p : surface.points) {
        points->InsertNextPoint(p.data());
        box.include(p);
    }
    vtkNew<vtkCellArray> cells;
    for (const auto& [a, b, c] : surface.triangles) {
        const vtkIdType corners[] = {a, b, c};
        cells->InsertNextCell(3, corners);
    }
    vtkNew<vtkPolyData> fine;
    fine->SetPoints(points);
    fine->SetPolys(cells);

    const double cell =
        std::sqrt(area_of(surface) * kTrianglesPerCell / static_cast<double>(triangles));
    vtkNew<vtkQuadricClustering> clustering;
    clustering->AutoAdjustNumberOfDivisionsOff();
    const auto divisions = [&](int axis) {
        return std::max(1, static_cast<int>(std::ceil(box.extent()[axis] / cell)));
    };
    clustering->SetNumberOfDivisions(divisions(0), divisions(1), divisions(2));
    clustering->UseInputPointsOff();
    clustering->CopyCellDataOff();
    clustering->SetInputData(fine);
    clustering->Update();

    TriMesh coarse;
    vtkPolyData* made = clustering->GetOutput();
    for (vtkIdType i = 0; i < made->GetNumberOfPoints(); ++i)
        coarse.points.emplace_back(made->GetPoint(i));
    vtkNew<vtkIdList> corners;
    vtkCellArray* polygons = made->GetPolys();
    polygons->InitTraversal();
    while (polygons->GetNextCell(corners))
        if (corners->GetNumberOfIds() == 3)
            coarse.triangles.push_back({static_cast<std::int32_t>(corners->GetId(0)),
                                        static_cast<std::int32_t>(corners->GetId(1)),
                                        static_cast<std::int32_t>(corners->GetId(2))});
    return coarse;
}

}  // namespace myotet::report
