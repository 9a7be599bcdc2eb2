// SPDX-License-Identifier: Apache-2.0
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <exception>
#include <mutex>

#include "Core/Errors.h"
#include "MeshFiles/MeshFiles.h"
#include "MeshFiles/RawMesh.h"
#include "MeshFiles/RawSurface.h"

namespace myotet::meshfiles {
namespace {

/// Keeps what VTK would print.
class Complaints final : public vtkOutputWindow {
public:
    static Complaints* New();
    vtkTypeMacro(Complaints, vtkOutputWindow);
    void DisplayText(const char* text) override {
        const std::lock_guard lock(mutex_);
        said_ += text;
    }
    [[nodiscard]] std::string take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(said_, {});
    }

private:
    std::mutex mutex_;
    std::string said_;
};
vtkStandardNewMacro(Complaints);

/// Collects instead of printing while it lives. VTK has one output window for
/// the whole process, so only one reader runs at a time.
class Listening {
public:
    Listening() : lock_(mutex()), before_(vtkOutputWindow::GetInstance()) {
        vtkOutputWindow::SetInstance(complaints_);
        vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // it prints besides
    }
    ~Listening() { vtkOutputWindow::SetInstance(before_); }
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;
    [[nodiscard]] std::string heard() { return complaints_->take(); }

private:
    static std::mutex& mutex() {
        static std::mutex one_at_a_time;
        return one_at_a_time;
    }
    std::lock_guard<std::mutex> lock_;
    vtkSmartPointer<vtkOutputWindow> before_;
    vtkSmartPointer<Complaints> complaints_ = vtkSmartPointer<Complaints>::New();
};

/// The gist of VTK's many lines: what follows the object's address.
std::string gist(const std::string& said) {
    const std::size_t from = said.find("): ");
    const std::size_t start = from == std::string::npos ? 0 : from + 3;
    return said.substr(start, said.find('\n', start) - start);
}

/// Runs a VTK reader and throws IoError when it complains.
template <class Reader>
auto read_with(const std::filesystem::path& file) {
    Listening listening;
    const auto reader = vtkSmartPointer<Reader>::New();
    reader->SetFileName(file.c_str());
    std::string reason;
    try {
        reader->Update();
        reason = gist(listening.heard());
        if (reason.empty() && reader->GetErrorCode() != 0) reason = "the reader gives no reason";
    } catch (const std::exception& error) {
        reason = error.what();  // a damaged size asks for more memory than there is
    }
    if (!reason.empty())
        throw IoError(file.string() + ": cannot be read whole (" + reason +
                      "); the file is cut short or damaged, copy or export it again");
    return vtkSmartPointer(reader->GetOutput());
}

std::vector<Vec3> points_of(vtkPointSet& set) {
    std::vector<Vec3> points(set.GetNumberOfPoints());
    for (std::size_t i = 0; i < points.size(); ++i)
        set.GetPoint(static_cast<vtkIdType>(i), points[i].data());
    return points;
}

std::string space_of(vtkDataSet& set) {
    auto* said = vtkStringArray::SafeDownCast(set.GetFieldData()->GetAbstractArray("SPACE"));
    return said && said->GetNumberOfValues() > 0 ? std::string(said->GetValue(0)) : "";
}

/// Calls take(number of points, their indices) for each cell, having made sure
/// that VTK's arrays say what they hold.
template <class Take>
void for_each_cell(vtkCellArray* cells, const std::filesystem::path& file, Take&& take) {
    if (!cells) return;
    if (!cells->IsValid())
        throw IoError(
            file.string() +
            ": its cells point past their own list; the file is damaged, export it again");
    for (vtkIdType c = 0; c < cells->GetNumberOfCells(); ++c) {
        vtkIdType count = 0;
        const vtkIdType* indices = nullptr;
        cells->GetCellAtId(c, count, indices);
        take(c, std::span(indices, static_cast<std::size_t>(count)));
    }
}

RawSurface surface_of(vtkPolyData& data, const std::filesystem::path& file) {
    RawSurface surface;
    surface.points = points_of(data);
    surface.space = space_of(data);
    std::vector<std::int64_t> corners;
    for_each_cell(data.GetPolys(), file, [&](vtkIdType, std::span<const vtkIdType> polygon) {
        corners.assign(polygon.begin(), polygon.end());
        surface.add_polygon(corners);
    });
    for_each_cell(data.GetStrips(), file, [&](vtkIdType, std::span<const vtkIdType> strip) {
        for (std::size_t i = 2; i < strip.size(); ++i)  // every other triangle is turned
            surface.triangles.push_back({strip[i - 2 + i % 2], strip[i - 1 - i % 2], strip[i]});
    });
    return surface;
}

std::int32_t label_at(vtkDataArray* labels, vtkIdType cell) {
    return labels ? static_cast<std::int32_t>(labels->GetComponent(cell, 0)) : 0;
}

/// Field array `label_names`: texts `7=biceps`.
std::map<std::int32_t, std::string> names_in(vtkDataSet& data) {
    std::map<std::int32_t, std::string> names;
    auto* said = vtkStringArray::SafeDownCast(data.GetFieldData()->GetAbstractArray("label_names"));
    for (vtkIdType i = 0; said && i < said->GetNumberOfValues(); ++i) {
        std::int64_t value = 0;
        std::string name;
        if (parse_value_name(std::string(said->GetValue(i)), value, name))
            names[static_cast<std::int32_t>(value)] = name;
    }
    return names;
}

}  // namespace

RawSurface read_vtp(const std::filesystem::path& file) {
    const auto data = read_with<vtkXMLPolyDataReader>(file);
    return surface_of(*data, file);
}

TetMesh read_vtu(const std::filesystem::path& file) { return read_named_vtu(file).mesh; }

NamedMesh read_named_vtu(const std::filesystem::path& file) {
    if (!std::filesystem::is_regular_file(file))
        throw IoError(file.string() + ": cannot be read; check its name and permissions");
    const auto data = read_with<vtkXMLUnstructuredGridReader>(file);
    NamedMesh named{.names = names_in(*data)};
    TetMesh& mesh = named.mesh;
    mesh.points = points_of(*data);
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        if (!mesh.points[i].allFinite())
            throw InputError(file.string() + ": point " + std::to_string(i) +
                             " has a coordinate that is not a finite number; repair the mesh");
    vtkDataArray* labels = data->GetCellData()->GetArray("label");
    const auto count = static_cast<vtkIdType>(mesh.points.size());
    for_each_cell(data->GetCells(), file, [&](vtkIdType cell, std::span<const vtkIdType> corners) {
        if (data->GetCellType(cell) != VTK_TETRA || corners.size() != 4) return;
        Tet tet{};
        for (int i = 0; i < 4; ++i) {
            if (!(corners[i] >= 0 && corners[i] < count))
                throw InputError(file.string() + ": cell " + std::to_string(cell) +
                                 " names point " + std::to_string(corners[i]) +
                                 ", but the file has " + std::to_string(count) +
                                 " points; the file is damaged, export it again");
            tet[i] = static_cast<std::int32_t>(corners[i]);
        }
        mesh.tets.push_back(tet);
        mesh.labels.push_back(label_at(labels, cell));
    });
    if (mesh.tets.empty())
        throw InputError(file.string() +
                         ": holds no tetrahedra; a tetrahedral mesh (.vtu) is needed");
    // RAS and LPS differ by half a turn about the third axis.
    if (space_of(*data) == "RAS")
        for (Vec3& p : mesh.points) p = Vec3(-p[0], -p[1], p[2]);
    return named;
}

}  // namespace myotet::meshfiles
