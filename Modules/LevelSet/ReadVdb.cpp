// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/ReadVdb.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include "Core/Errors.h"
#include "LevelSet/Band.h"
#include "LevelSet/CsgTable.h"
#include "LevelSet/Redistance.h"
#include "LevelSet/VdbFormat.h"

namespace myotet::levelset {
namespace {

constexpr int kSide = Band::kSide;
static_assert(kSide == VdbGrid::kLeafSide);
// Half width of the band, in voxels: what is kept of it at most; at least,
// without distances made anew; at least, to hold both ends of each cut edge.
constexpr double kWidest = 4, kWideEnough = 3, kNarrowest = 1;
// Slope of the samples next to the surface, in the median: what CSG and filters
// leave is well within, another unit is without.
constexpr double kLeastSlope = 0.75, kMostSlope = 1.25;
// From one sample to the next across the surface, in voxels: twice what a distance
// does, as where the band is one voxel wide.
constexpr double kHighestJump = 2.1;
constexpr double kCubic = 1e-4;  // of a voxel's side: far above rounding, far below a voxel

std::string number(double value) {
    std::ostringstream out;
    out.precision(4);
    out << value;
    return out.str();
}

/// A grid of the file, and how errors name it.
struct Source {
    const VdbGrid& grid;
    std::string where;

    [[noreturn]] void refuse(const std::string& sentence) const {
        throw InputError(where + sentence);
    }
    [[nodiscard]] std::string text(const std::string& key) const {
        const auto found = grid.text.find(key);
        return found == grid.text.end() ? std::string() : found->second;
    }
    [[nodiscard]] std::optional<std::int32_t> label() const {
        const auto found = grid.whole.find("label");
        return found == grid.whole.end() ? std::nullopt : std::optional(found->second);
    }
};

std::vector<VdbGrid> read_grids(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored))
        throw IoError(file.string() + ": there is no such file; check its name and folder");
    std::ifstream in(file, std::ios::binary);
    std::ostringstream content;
    content << in.rdbuf();
    if (!in && !content.view().empty())
        throw IoError(file.string() + ": cannot be read; check its permissions");
    try {
        return parse_vdb(content.view());
    } catch (const InputError& error) {
        throw IoError(file.string() + ": is no OpenVDB file, or damaged or cut short: " +
                      error.what() + "; write it again");
    }
}

/// The level sets among the grids; the others are warnings.
std::vector<Source> choose(const std::vector<VdbGrid>& grids, const std::filesystem::path& file,
                           std::vector<std::string>& warnings) {
    std::vector<Source> chosen;
    for (const VdbGrid& grid : grids) {
        Source source{grid, file.string() + ": grid '"};
        source.where += source.text("name") + "': ";
        const std::string kind = source.text("class");
        if (grid.has_samples && kind == "level set")
            chosen.push_back(std::move(source));
        else
            warnings.push_back(source.where +
                               "is left out, it is no level set of 32-bit numbers of its own but " +
                               (kind.empty() ? "of no class" : "a " + kind) + ", " + grid.type);
    }
    if (chosen.empty())
        throw InputError(warnings.empty() ? file.string() + ": holds no grid; a level set is needed"
                                          : warnings.front() + "; the file holds no level set");
    return chosen;
}

double millimetres_per(const Source& source, const std::string& unit) {
    if (unit == "mm") return 1;
    if (unit == "cm") return 10;
    if (unit == "m") return 1000;
    source.refuse("its unit is '" + unit + "'; mm, cm and m are read");
}

std::string unit_of(const Source& source, const std::string& asked) {
    const std::string said = source.text("units");
    if (!said.empty() && !asked.empty())
        source.refuse("says its unit itself, '" + said + "'; leave --input-unit out");
    return !said.empty() ? said : !asked.empty() ? asked : "mm";
}

/// How the grid's lattice lies in the patient: cubes of one side, turned and moved.
struct Lattice {
    double spacing = 0;     ///< mm
    bool mirrored = false;  ///< its first axis counts backwards, for a right-handed frame
    Frame frame;
};

Lattice lattice_of(const Source& source, double scale) {
    const VdbGrid& grid = source.grid;
    if (!grid.linear)
        source.refuse("its voxels are a frustum's (" + grid.map_type +
                      "), which is no linear transform; resample it to cubic voxels");
    Mat3 axes;
    for (int a = 0; a < 3; ++a) axes.col(a) = scale * grid.axes[a];
    Vec3 origin = scale * grid.origin;
    if (source.text("SPACE") == "RAS") {
        axes.topRows<2>() *= -1;
        origin.head<2>() *= -1;
    }
    const Vec3 sides = axes.colwise().norm();
    Lattice lattice{.spacing = sides.mean()};
    lattice.mirrored = axes.determinant() < 0;
    if (lattice.mirrored) axes.col(0) *= -1;
    const double h = lattice.spacing;
    const Mat3 cubic = axes.transpose() * axes / (h * h) - Mat3::Identity();
    if (!(h > 0 && std::isfinite(h) && origin.allFinite() &&
          cubic.cwiseAbs().maxCoeff() < 2 * kCubic))
        source.refuse("its voxels are no cubes (sides of " + number(sides[0]) + ", " +
                      number(sides[1]) + " and " + number(sides[2]) +
                      " mm, or sheared); resample it to cubic voxels");
    lattice.frame.rotation =
        Eigen::Quaterniond(Mat3(axes / h)).normalized().toRotationMatrix();  // free of rounding
    lattice.frame.origin = origin;
    return lattice;
}

/// Of a leaf in blocks; a mirrored axis counts from the other side.
Index3 block_of(const Index3& leaf, const Lattice& lattice) {
    const int i = leaf[0] / kSide;
    return {lattice.mirrored ? -1 - i : i, leaf[1] / kSide, leaf[2] / kSide};
}

/// The table of blocks, with an empty one on every side.
Band lay_blocks(const Source& source, const Lattice& lattice, double max_memory) {
    Index3 low, high;
    low.fill(std::numeric_limits<int>::max());
    high.fill(std::numeric_limits<int>::min());
    const std::vector<Index3>& leaves = source.grid.leaves;
    for (const Index3& leaf : leaves)
        for (int a = 0; a < 3; ++a) {
            const int at = block_of(leaf, lattice)[a];
            low[a] = std::min(low[a], at - 1);
            high[a] = std::max(high[a], at + 1);
        }
    if (leaves.empty()) source.refuse("has no samples; a narrow band about the surface is needed");
    // As measured for level sets of surfaces: 9 kB at the peak for a block, 25
    // bytes for a coarse sample, of which a block has eight.
    constexpr double kBytesPerBlock = 9000, kBytesPerPlace = 25 * 8;
    Band band;
    double places = 1;
    for (int a = 0; a < 3; ++a) {
        places *= high[a] - double(low[a]) + 1;
        band.blocks[a] = high[a] - low[a] + 1;
        band.origin[a] = lattice.spacing * kSide * double(low[a]);
    }
    const double bytes =
        kBytesPerPlace * places + kBytesPerBlock * static_cast<double>(leaves.size());
    if (!(bytes <= max_memory))
        throw ResourceError(source.where + "its box of " + number(places) +
                            " blocks would need about " + number(bytes / 1e9) + " GB where " +
                            number(max_memory / 1e9) +
                            " GB are allowed; take away what lies far from the rest, or resample "
                            "it to larger voxels");
    if (lattice.mirrored) band.origin[0] += lattice.spacing;  // sample i is the file's -1 - i
    band.spacing = lattice.spacing;
    band.block_of.assign(static_cast<std::size_t>(places), Band::kOutside);
    for (const Index3& leaf : leaves) {
        Index3 at = block_of(leaf, lattice);
        for (int a = 0; a < 3; ++a) at[a] -= low[a];
        band.block_of[band.slot(at)] = static_cast<std::int32_t>(band.position.size());
        band.position.push_back(at);
    }
    return band;
}

void copy_samples(const Source& source, const Lattice& lattice, double scale, Band& band) {
    band.values.resize(source.grid.values.size());
    const float* from = source.grid.values.data();  // k fastest
    for (std::size_t leaf = 0; leaf < source.grid.leaves.size(); ++leaf) {
        const Index3& low = source.grid.leaves[leaf];
        float* to = band.block(static_cast<std::int32_t>(leaf));  // i fastest
        for (int i = 0; i < kSide; ++i)
            for (int j = 0; j < kSide; ++j)
                for (int k = 0; k < kSide; ++k) {
                    const float v = *from++;
                    if (!std::isfinite(v))
                        source.refuse("the value of voxel (" + std::to_string(low[0] + i) + ", " +
                                      std::to_string(low[1] + j) + ", " +
                                      std::to_string(low[2] + k) +
                                      ") is no finite number; repair or write it again");
                    to[(k * kSide + j) * kSide + (lattice.mirrored ? kSide - 1 - i : i)] =
                        std::clamp(static_cast<float>(scale * v), -band.width, band.width);
                }
    }
}

/// How the samples on either side of the surface change.
struct Slopes {
    double median = 0;  ///< |grad phi| by central differences; 0: there is no surface
    double jump = 0;    ///< the largest from one to the next, in spacings
};

Slopes slopes_of(const Band& band) {
    Slopes slopes;
    std::vector<double> found;
    constexpr int n = kSide + 2;
    std::array<float, n * n * n> v;
    for (const Index3& b : band.position) {
        gather(band, b, 1, 1, v.data());
        for (int k = 1; k <= kSide; ++k)
            for (int j = 1; j <= kSide; ++j)
                for (int i = 1; i <= kSide; ++i) {
                    const int at = (k * n + j) * n + i;
                    bool cut = false;
                    Vec3 gradient;
                    for (int a = 0, step = 1; a < 3; ++a, step *= n) {
                        const double ahead = v[at + step] - v[at];
                        if ((v[at] < 0) != (v[at + step] < 0)) {
                            cut = true;
                            slopes.jump = std::max(slopes.jump, std::abs(ahead) / band.spacing);
                        }
                        gradient[a] = (v[at + step] - v[at - step]) / (2 * band.spacing);
                    }
                    if (cut) found.push_back(gradient.norm());
                }
    }
    if (found.empty()) return slopes;
    const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
    std::nth_element(found.begin(), middle, found.end());
    slopes.median = *middle;
    return slopes;
}

void require_distances(const Source& source, const Band& band) {
    const Slopes slopes = slopes_of(band);
    if (slopes.median == 0) source.refuse("has no surface: no neighbours are inside and outside");
    if (!(slopes.jump <= kHighestJump))
        source.refuse("inside and outside meet " + number(slopes.jump / 2) +
                      " voxels from the surface; a level set whose signs are right beyond its "
                      "narrow band is needed");
    if (!(slopes.median >= kLeastSlope && slopes.median <= kMostSlope))
        source.refuse("its values change by " + number(slopes.median) +
                      " for each unit of length at the surface, so they are no distances in the "
                      "unit of its voxels; make them distances first");
}

/// Signs must not change between a stored block and what lies beside it.
void require_closed(const Source& source, const Band& band) {
    for (const Index3& b : band.position)
        for (int face = 0; face < 6; ++face) {
            const int axis = face / 2, high = face % 2;
            Index3 beside = b;
            beside[axis] += high ? 1 : -1;
            const std::int32_t number = band.find(beside);
            if (number >= 0) continue;
            const float* v = band.block(band.find(b));
            Index3 at;
            at[axis] = high ? kSide - 1 : 0;
            const int p = (axis + 1) % 3, q = (axis + 2) % 3;
            for (at[p] = 0; at[p] < kSide; ++at[p])
                for (at[q] = 0; at[q] < kSide; ++at[q])
                    if ((v[(at[2] * kSide + at[1]) * kSide + at[0]] < 0) !=
                        (number == Band::kInside))
                        source.refuse(
                            "is open: inside and outside meet at the end of its narrow band; a "
                            "closed level set is needed");
        }
}

LevelSet level_set_of(const Source& source, const Lattice& lattice, double scale,
                      double max_memory) {
    const double width = scale * source.grid.background / lattice.spacing;  // voxels
    if (!(width >= kNarrowest && std::isfinite(width)))
        source.refuse("its background, the half width of the narrow band, is " + number(width) +
                      " voxels; at least " + number(kNarrowest) +
                      ", positive outside, is needed: rebuild the level set");
    Band band = lay_blocks(source, lattice, max_memory);
    band.width = static_cast<float>(std::min(width, kWidest) * lattice.spacing);
    copy_samples(source, lattice, scale, band);
    mark_unstored_blocks(band);
    require_closed(source, band);
    require_distances(source, band);
    if (width < kWideEnough) {
        constexpr int kRoom = 2;  // blocks around those that the wider band may fill
        band = refit(framed(band, kRoom), static_cast<float>(kWideEnough * lattice.spacing));
        redistance(band, Seeds::keep_ends, 2);
    }
    return assemble(band);
}

/// Those that the grids say, and the free ones for the others.
std::vector<std::int32_t> labels_of(const std::vector<Source>& sources) {
    std::vector<std::int32_t> labels;
    for (const Source& source : sources)
        if (const auto label = source.label()) {
            if (std::ranges::find(labels, *label) != labels.end())
                source.refuse("its label, " + std::to_string(*label) +
                              ", is that of another grid too; give each its own");
            labels.push_back(*label);
        }
    const std::vector<std::int32_t> said = labels;
    labels.clear();
    std::int32_t next = 1;
    for (const Source& source : sources) {
        const auto label = source.label();
        while (!label && std::ranges::find(said, next) != said.end()) ++next;
        labels.push_back(label ? *label : next++);
    }
    return labels;
}

}  // namespace

VdbFile read_vdb(const std::filesystem::path& file, const std::string& unit, double max_memory) {
    VdbFile made;
    const std::vector<VdbGrid> grids = read_grids(file);
    const std::vector<Source> sources = choose(grids, file, made.warnings);
    const std::vector<std::int32_t> labels = labels_of(sources);
    for (std::size_t s = 0; s < sources.size(); ++s) {
        const Source& source = sources[s];
        const std::string here = unit_of(source, unit);
        if (s == 0) made.unit = here;
        const double scale = millimetres_per(source, here);
        const Lattice lattice = lattice_of(source, scale);
        VdbLevelSet one{.label = labels[s], .name = source.text("name"), .frame = lattice.frame};
        if (one.name.empty()) one.name = file.stem().string();
        one.phi = level_set_of(source, lattice, scale, max_memory);
        made.level_sets.push_back(std::move(one));
    }
    return made;
}

}  // namespace myotet::levelset
