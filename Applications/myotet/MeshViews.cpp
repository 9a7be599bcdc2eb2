// SPDX-License-Identifier: Apache-2.0
#include "MeshViews.h"

#include <algorithm>

#include "Core/Errors.h"
#include "Core/Sha256.h"
#include "MeshFiles/MeshFiles.h"
#include "Outputs.h"
#include "Quality/Quality.h"
#include "Report/ColourMap.h"
#include "Report/Draw.h"
#include "Report/Sides.h"
#include "Segmentation/ReadLabels.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

constexpr int kFileSide = 960;  // pixels of pictures that are files

bool holds(const fs::path& file, meshfiles::Holds what) {
    return std::ranges::any_of(meshfiles::formats(), [&](const meshfiles::Format& format) {
        return format.holds == what && file.extension() == format.extension;
    });
}

// Of the files that a tissue was written to the first with tetrahedra, else the first surface.
void read_mesh_of(const RunJson& tissue, const fs::path& folder, TissueView& view) {
    const std::vector<std::string> files = texts_of(tissue, "files");
    for (const meshfiles::Holds what : {meshfiles::Holds::tetrahedra, meshfiles::Holds::surface})
        for (const std::string& name : files) {
            if (!holds(name, what)) continue;
            const fs::path file = file_in(folder, name);
            if (what == meshfiles::Holds::tetrahedra) {
                view.mesh = meshfiles::read_mesh(file).mesh;
                view.surface = boundary_surface(view.mesh);
            } else {
                view.surface = meshfiles::read_surface(file);
            }
            return;
        }
}

segmentation::ReadOptions reading_of(const RunJson& options) {
    segmentation::ReadOptions reading;
    const auto given = [&](const char* key) {
        return options.contains(key) ? text_of(options, key) : "";
    };
    const std::string orientation = given("orientation");
    if (orientation == "sform") reading.orientation = segmentation::Orientation::sform;
    if (orientation == "qform") reading.orientation = segmentation::Orientation::qform;
    reading.one_hot = given("one_hot") == "yes";
    return reading;
}

void read_scan_of(const RunJson& run, MeshViews& views) {
    const fs::path input = text_of(run, "input");
    const std::string left_out = "; slices are left out.";
    if (!segmentation::is_label_file(input)) {
        views.no_scan = "The input, " + input.string() + ", is a surface and has no slices.";
        return;
    }
    if (std::error_code failed; !fs::is_regular_file(input, failed)) {
        views.no_scan = "The scan, " + input.string() + ", is not there any more" + left_out;
        return;
    }
    try {
        if (sha256_of_file(input) != text_of(run, "input_sha256"))
            views.no_scan =
                "The scan, " + input.string() + ", has changed since it was meshed" + left_out;
        else
            views.layers = segmentation::read_labels(input, reading_of(run.at("options"))).layers;
    } catch (const Error& failure) {
        views.no_scan =
            "The scan cannot be read any more (" + std::string(failure.what()) + ")" + left_out;
    }
}

// The boundary of the tetrahedra behind a plane, as seen along `direction`.
TriMesh opened_surface(const TetMesh& mesh, const Vec3& middle, const Vec3& direction) {
    TetMesh behind{.points = mesh.points};
    for (const Tet& t : mesh.tets) {
        Vec3 centre = Vec3::Zero();
        for (const std::int32_t n : t) centre += 0.25 * mesh.points[n];
        if ((centre - middle).dot(direction) >= 0) behind.tets.push_back(t);
    }
    return boundary_surface(behind);
}

struct Look {
    const char *stem, *caption;
    Vec3 direction, up;
};

// A picture as high and wide as what it shows, within limits.
report::Picture draw_shapes(const std::vector<report::Shape>& shapes, const Look& look,
                            const Box& box, int side) {
    constexpr double kSlimmest = 0.55, kRoom = 0.03;  // for the letters at the sides
    report::View view{.direction = look.direction, .up = look.up, .fit = box};
    view.fit.min.array() -= kRoom * box.extent().maxCoeff();
    view.fit.max.array() += kRoom * box.extent().maxCoeff();
    const Vec3 extent = box.extent();
    const double wide = look.direction.cross(look.up).cwiseAbs().dot(extent);
    const double high = look.up.cwiseAbs().dot(extent);
    const double longest = std::max({wide, high, 1e-9});
    view.width = static_cast<int>(side * std::clamp(wide / longest, kSlimmest, 1.0));
    view.height = static_cast<int>(side * std::clamp(high / longest, kSlimmest, 1.0));
    report::Picture picture = report::draw(shapes, view);
    report::draw_sides(picture, report::sides_of(look.direction, look.up));
    return picture;
}

}  // namespace

MeshViews read_views(const RunJson& run, const fs::path& folder, ProgressSink& progress) {
    MeshViews views;
    for (const RunJson& tissue : run.at("tissues")) {
        progress.check();
        TissueView view{.layer = tissue.at("layer").get<int>(),
                        .label = tissue.at("label").get<std::int32_t>(),
                        .name = text_of(tissue, "name"),
                        .colour = report::distinct_colour(views.tissues.size())};
        read_mesh_of(tissue, folder, view);
        for (const Vec3& p : view.surface.points) views.box.include(p);
        views.tissues.push_back(std::move(view));
    }
    read_scan_of(run, views);
    return views;
}

std::vector<NamedPicture> whole_pictures(const MeshViews& views, int side) {
    // In LPS the front is -y, the patient's left +x.
    const Vec3 left = Vec3::UnitX(), back = Vec3::UnitY(), above = Vec3::UnitZ();
    const Look looks[] = {{"front", "from the front", back, above},
                          {"left", "from the left", -left, above},
                          {"back", "from behind", -back, above},
                          {"above", "from above", -above, -back}};
    const Look cuts[] = {{"front_cut", "cut open, from the front", back, above},
                         {"left_cut", "cut open, from the left", -left, above}};
    std::vector<NamedPicture> pictures;
    if (views.box.empty()) return pictures;
    std::vector<report::Shape> shapes;
    for (const TissueView& tissue : views.tissues)
        shapes.push_back({.surface = tissue.surface, .values = {}, .colour = tissue.colour});
    for (const Look& look : looks)
        pictures.push_back({look.stem, look.caption, draw_shapes(shapes, look, views.box, side)});
    const bool solid = std::ranges::any_of(
        views.tissues, [](const TissueView& tissue) { return !tissue.mesh.tets.empty(); });
    for (const Look& look : cuts) {
        if (!solid) break;
        for (std::size_t t = 0; t < shapes.size(); ++t)
            shapes[t].surface =
                opened_surface(views.tissues[t].mesh, views.box.centre(), look.direction);
        pictures.push_back({look.stem, look.caption, draw_shapes(shapes, look, views.box, side)});
    }
    return pictures;
}

report::Picture tissue_picture(const TissueView& tissue, int side, Opened opened) {
    Box box;
    for (const Vec3& p : tissue.surface.points) box.include(p);
    const Look front{"", "", Vec3::UnitY(), Vec3::UnitZ()};
    const TriMesh surface = opened == Opened::yes
                                ? opened_surface(tissue.mesh, box.centre(), front.direction)
                                : tissue.surface;
    return draw_shapes({{.surface = surface, .values = {}, .colour = tissue.colour}}, front, box,
                       side);
}

void write_pictures(const MeshViews& views, const fs::path& folder) {
    const fs::path pictures = folder / "pictures";
    std::error_code failed;
    fs::create_directories(pictures, failed);
    if (failed)
        throw IoError(pictures.string() + ": cannot make the folder (" + failed.message() +
                      "); check its rights");
    for (const NamedPicture& one : whole_pictures(views, kFileSide))
        report::write_png(one.picture, pictures / ("whole_" + one.stem + ".png"));
    for (const TissueView& tissue : views.tissues) {
        if (tissue.surface.triangles.empty()) continue;
        const std::string stem = file_stem(tissue.layer, tissue.label, tissue.name);
        report::write_png(tissue_picture(tissue, kFileSide, Opened::no),
                          pictures / (stem + ".png"));
        if (!tissue.mesh.tets.empty())
            report::write_png(tissue_picture(tissue, kFileSide, Opened::yes),
                              pictures / (stem + "_cut.png"));
    }
}

ShapeHistograms shape_histograms(const MeshViews& views) {
    ShapeHistograms histograms;
    for (const TissueView& tissue : views.tissues)
        for (const Tet& t : tissue.mesh.tets) {
            const std::vector<Vec3>& x = tissue.mesh.points;
            const quality::Shape shape = quality::measure(x[t[0]], x[t[1]], x[t[2]], x[t[3]]);
            histograms.smallest.add(shape.min_dihedral_deg);
            histograms.largest.add(shape.max_dihedral_deg);
            histograms.aspect.add(shape.aspect_ratio);
        }
    return histograms;
}

}  // namespace myotet::app
