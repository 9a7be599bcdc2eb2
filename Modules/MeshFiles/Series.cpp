// SPDX-License-Identifier: Apache-2.0
#include "MeshFiles/Series.h"

#include <cmath>
#include <set>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "Core/Text.h"
#include "MeshFiles/Hdf5.h"
#include "MeshFiles/RawMesh.h"
#include "MeshFiles/TextWriter.h"

namespace myotet::meshfiles {
namespace fs = std::filesystem;

namespace {

// The quantities of a grid with the places of its points, which come first.
std::vector<SeriesArray> arrays_of(const SeriesGrid& grid) {
    std::vector<SeriesArray> arrays{{kSeriesPoints, 3, true}};
    arrays.insert(arrays.end(), grid.arrays.begin(), grid.arrays.end());
    return arrays;
}

std::size_t elements_of(const SeriesGrid& grid) {
    return grid.tets.empty() ? grid.triangles.size() : grid.tets.size();
}

std::size_t rows_of(const SeriesGrid& grid, const SeriesArray& array) {
    return array.at_points ? grid.points : elements_of(grid);
}

std::string dataset_of(const SeriesGrid& grid, const std::string& name) {
    return grid.name + "_" + name;
}

bool is_plain(std::string_view name) {
    return !name.empty() && name.find_first_not_of(
                                "abcdefghijklmnopqrstuvwxyz"
                                "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                "0123456789_-.") == std::string_view::npos;
}

void check_names(std::span<const SeriesGrid> grids, const fs::path& file) {
    std::set<std::string> names;
    for (const SeriesGrid& grid : grids) {
        std::vector<std::string> datasets{dataset_of(grid, "elements"), dataset_of(grid, "label")};
        for (const SeriesArray& array : arrays_of(grid))
            datasets.push_back(dataset_of(grid, array.name));
        for (const std::string& name : datasets)
            if (!is_plain(name) || !names.insert(name).second)
                throw InputError(file.string() + ": '" + name +
                                 "' cannot name a dataset, it stands twice or has signs other "
                                 "than letters, digits, _, - and .; rename its grid or array");
    }
}

void check_times(std::span<const double> times, const fs::path& file) {
    for (std::size_t t = 0; t < times.size(); ++t)
        if (!std::isfinite(times[t]) || (t > 0 && !(times[t] > times[t - 1])))
            throw InputError(file.string() + ": frame " + std::to_string(t) + " is at " +
                             shown(times[t]) + " s, but times must ascend");
}

std::vector<std::int32_t> corners_of(const SeriesGrid& grid) {
    std::vector<std::int32_t> corners;
    for (const Tet& t : grid.tets) corners.insert(corners.end(), t.begin(), t.end());
    for (const Triangle& t : grid.triangles) corners.insert(corners.end(), t.begin(), t.end());
    return corners;
}

std::string dataset_of(const SeriesGrid& grid, const std::string& name, std::size_t frame) {
    return "frame_" + frame_digits(frame) + "/" + dataset_of(grid, name);
}

std::vector<FrameTable> tables_of(std::span<const SeriesGrid> grids, std::size_t frame,
                                  const SeriesSource& source, const fs::path& heavy) {
    std::vector<FrameTable> tables;
    for (std::size_t g = 0; g < grids.size(); ++g)
        for (const SeriesArray& array : arrays_of(grids[g])) {
            tables.push_back({dataset_of(grids[g], array.name, frame), array.components,
                              source(frame, g, array.name)});
            const std::size_t wanted = rows_of(grids[g], array) * array.components;
            if (tables.back().reals.size() != wanted)
                throw MeshError(heavy.string() + ": " + tables.back().name + " has " +
                                std::to_string(tables.back().reals.size()) +
                                " numbers but must have " + std::to_string(wanted));
        }
    return tables;
}

void write_numbers(std::span<const SeriesGrid> grids, std::size_t frames,
                   const SeriesSource& source, const fs::path& heavy) {
    std::vector<std::vector<std::int32_t>> corners;
    std::vector<Table> tables;
    for (const SeriesGrid& grid : grids) corners.push_back(corners_of(grid));
    for (std::size_t g = 0; g < grids.size(); ++g) {
        tables.push_back(
            {dataset_of(grids[g], "elements"), grids[g].tets.empty() ? 3 : 4, {}, corners[g]});
        if (!grids[g].labels.empty())
            tables.push_back({dataset_of(grids[g], "label"), 1, {}, grids[g].labels});
    }
    write_hdf5(
        tables, frames, [&](std::size_t frame) { return tables_of(grids, frame, source, heavy); },
        heavy);
}

class SeriesText {
public:
    explicit SeriesText(std::string heavy) : heavy_(std::move(heavy)) {}

    void grid(const SeriesGrid& grid, std::size_t frame, std::string_view time) {
        out_.line("        <Grid Name=\"", grid.name, "\" GridType=\"Uniform\">", time);
        for (const auto& [label, name] : grid.label_names)
            out_.line("          <Information Name=\"", label, "\" Value=\"", xml_escaped(name),
                      "\"/>");
        const std::size_t count = elements_of(grid), corners = grid.tets.empty() ? 3 : 4;
        out_.line("          <Topology TopologyType=\"",
                  grid.tets.empty() ? "Triangle" : "Tetrahedron", "\" NumberOfElements=\"", count,
                  "\">");
        item(dataset_of(grid, "elements"), "Int", count, corners);
        out_.line("          </Topology>\n          <Geometry GeometryType=\"XYZ\">");
        item(dataset_of(grid, kSeriesPoints, frame), "Float", grid.points, 3);
        out_.line("          </Geometry>");
        if (!grid.labels.empty()) {
            attribute("label", 1, "Cell");
            item(dataset_of(grid, "label"), "Int", count, 1);
            out_.line("          </Attribute>");
        }
        for (const SeriesArray& array : grid.arrays) {
            attribute(array.name, array.components, array.at_points ? "Node" : "Cell");
            item(dataset_of(grid, array.name, frame), "Float", rows_of(grid, array),
                 array.components);
            out_.line("          </Attribute>");
        }
        out_.line("        </Grid>");
    }
    TextWriter& out() { return out_; }

private:
    void attribute(std::string_view name, int components, std::string_view center) {
        out_.line("          <Attribute Name=\"", name, "\" AttributeType=\"",
                  components == 9   ? "Tensor"
                  : components == 3 ? "Vector"
                                    : "Scalar",
                  "\" Center=\"", center, "\">");
    }
    void item(const std::string& dataset, std::string_view type, std::size_t rows,
              std::size_t columns) {
        out_.add("            <DataItem Dimensions=\"", rows);
        if (columns > 1) out_.add(' ', columns);
        out_.line("\" NumberType=\"", type, "\" Precision=\"4\" Format=\"HDF\">",
                  xml_escaped(heavy_), ":/", dataset, "</DataItem>");
    }
    TextWriter out_;
    std::string heavy_;
};

std::string description(std::span<const SeriesGrid> grids, std::span<const double> times,
                        const fs::path& heavy) {
    SeriesText text(heavy.filename().string());
    TextWriter& out = text.out();
    out.line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n  <!-- ", kFacts,
             " -->\n  <Domain>\n    <Grid Name=\"frames\" GridType=\"Collection\" "
             "CollectionType=\"Temporal\">");
    for (std::size_t t = 0; t < times.size(); ++t) {
        const std::string time = "<Time Value=\"" + shown(times[t]) + "\"/>";
        if (grids.size() == 1) {
            text.grid(grids[0], t, time);
            continue;
        }
        out.line("      <Grid Name=\"frame_", t,
                 "\" GridType=\"Collection\" CollectionType=\"Spatial\">", time);
        for (const SeriesGrid& grid : grids) text.grid(grid, t, "");
        out.line("      </Grid>");
    }
    out.line("    </Grid>\n  </Domain>\n</Xdmf>");
    return out.text();
}

}  // namespace

std::string frame_digits(std::size_t frame) {
    constexpr std::size_t kDigits = 4;
    const std::string digits = std::to_string(frame);
    return std::string(digits.size() < kDigits ? kDigits - digits.size() : 0, '0') + digits;
}

void write_series(std::span<const SeriesGrid> grids, std::span<const double> times,
                  const SeriesSource& source, const fs::path& file) {
    check_names(grids, file);
    check_times(times, file);
    fs::path heavy = file;
    heavy.replace_extension(".h5");
    write_numbers(grids, times.size(), source, heavy);
    write_atomically(file, description(grids, times, heavy));
}

}  // namespace myotet::meshfiles
