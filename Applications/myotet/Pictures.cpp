// SPDX-License-Identifier: Apache-2.0
#include "Pictures.h"

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"
#include "Core/Text.h"
#include "MeshFiles/Series.h"
#include "Report/Draw.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

constexpr double kRoomToBulge = 0.04;  // around the box at rest, of its diagonal
constexpr double kLeastStretch = 0.6, kMostStretch = 1.4;
constexpr report::Colour kIvory{1.0, 0.97, 0.87};
constexpr report::Colour kGrey{0.7, 0.7, 0.7};
constexpr int kSheetColumns = 3;
constexpr int kWidth = 480, kHeight = 600;  // of one view, pixels

std::string time_title(const char* from, std::optional<double> time) {
    return formatted("%s, t = %.3f s", from, time.value_or(0));
}

const std::vector<double>& values_of(const contraction::Moment& frame, const char* name) {
    const auto& cells = frame.arrays.cells;
    const auto found =
        std::ranges::find(cells, name, [](const meshfiles::NamedArray& a) { return a.name; });
    MYOTET_CHECK(found != cells.end(), std::string("a frame has the array ") + name);
    return found->values;
}

// The boundary of all bodies with the stretch of the tetrahedra behind it.
report::Shape bodies_of(const contraction::Moment& frame) {
    const std::vector<double>& stretch = values_of(frame, "fiber_stretch");
    const std::vector<double>& fibre = values_of(frame, "fiber");
    const std::vector<Tet>& tets = frame.mesh.tets;
    const std::vector<Tet> neighbours = face_neighbours(tets);
    report::Shape shape{.surface = {.points = frame.mesh.points}, .colour = kGrey};
    for (std::size_t t = 0; t < tets.size(); ++t) {
        const bool fibred = fibre[3 * t] != 0 || fibre[3 * t + 1] != 0 || fibre[3 * t + 2] != 0;
        for (int face = 0; face < 4; ++face) {
            if (neighbours[t][face] >= 0) continue;
            shape.surface.triangles.push_back(face_of(tets[t], face));
            shape.values.push_back(fibred ? stretch[t] : std::nan(""));
        }
    }
    return shape;
}

fs::path picture_name(std::size_t number) {
    return fs::path("pictures") / ("frame_" + meshfiles::frame_digits(number) + ".png");
}

// Up to `most` of `count` numbers from 0, the first, the last and evenly between.
std::vector<std::size_t> spread(std::size_t count, std::size_t most) {
    std::vector<std::size_t> chosen;
    const std::size_t n = std::min(count, most);
    for (std::size_t i = 0; i < n; ++i)
        chosen.push_back(n == 1 ? 0 : (i * (count - 1) + (n - 1) / 2) / (n - 1));
    return chosen;
}

}  // namespace

Box box_of_run(const contraction::Scene& scene, const contraction::Model& model,
               std::span<const TriMesh> bones) {
    Box box;
    for (const contraction::BodyModel& body : model.bodies)
        for (const Vec3& p : body.mesh.mesh.points) box.include(p);
    const auto outputs = static_cast<std::size_t>(std::ceil(scene.time.end / scene.output.every));
    for (std::size_t b = 0; b < bones.size(); ++b)
        for (std::size_t i = 0; i <= outputs; ++i) {
            const double time =
                std::min(scene.time.end, static_cast<double>(i) * scene.output.every);
            const Pose pose = contraction::pose_at(scene.bones[b].motion, time);
            for (const Vec3& p : bones[b].points) box.include(pose(p));
        }
    const Vec3 room = Vec3::Constant(kRoomToBulge * box.diagonal());
    box.min -= room;
    box.max += room;
    return box;
}

report::Picture frame_picture(const contraction::Moment& frame, std::span<const TriMesh> bones,
                              const Box& fit) {
    std::vector<report::Shape> shapes{bodies_of(frame)};
    for (const TriMesh& bone : bones) shapes.push_back({.surface = bone, .colour = kIvory});
    report::View view{.width = kWidth,
                      .height = kHeight,
                      .least = kLeastStretch,
                      .most = kMostStretch,
                      .values_name = "fibre stretch",
                      .fit = fit};
    // In LPS the front is -y and the patient's left +x.
    view.direction = Vec3::UnitY();
    view.title = time_title("front", frame.arrays.time);
    const report::Picture front = report::draw(shapes, view);
    view.direction = -Vec3::UnitX();
    view.title = time_title("left side", frame.arrays.time);
    const report::Picture pictures[] = {front, report::draw(shapes, view)};
    return report::tile(pictures, 2);
}

void write_picture(const report::Picture& picture, const fs::path& folder, std::size_t number) {
    std::error_code failed;
    fs::create_directories(folder / "pictures", failed);
    if (failed)
        throw IoError((folder / "pictures").string() + ": cannot make the folder (" +
                      failed.message() + "); check its rights, or use --no-pictures");
    report::write_png(picture, folder / picture_name(number));
}

std::vector<fs::path> write_contact_sheet(const fs::path& folder, std::size_t frames,
                                          const char* sheet) {
    std::vector<fs::path> there;
    for (std::size_t i = 0; i < frames; ++i)
        if (fs::exists(folder / picture_name(i))) there.push_back(picture_name(i));
    if (there.empty()) return there;
    std::vector<report::Picture> chosen;
    for (const std::size_t i : spread(there.size(), kSheetPictures))
        chosen.push_back(report::read_png(folder / there[i]));
    report::write_png(report::tile(chosen, kSheetColumns), folder / sheet);
    there.emplace_back(sheet);
    return there;
}

}  // namespace myotet::app
