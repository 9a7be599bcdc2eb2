// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Partition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "Core/Parallel.h"
#include "LevelSet/Flow.h"
#include "LevelSet/HoldVoxels.h"
#include "LevelSet/Measure.h"
#include "LevelSet/Offsets.h"
#include "LevelSet/Places.h"

namespace myotet::levelset {
namespace {

constexpr std::size_t kGrain = 16;
constexpr int kSide = Band::kSide;

constexpr int kCells = 8;  // of volumes, a block
using Part = std::array<float, kCells>;

// The cell of volumes that a cell of samples belongs to.
int part_of(int i, int j, int k) {
    constexpr int half = kSide / kVolumeStep;
    static_assert(half * half * half == kCells);
    return (k / kVolumeStep * half + j / kVolumeStep) * half + i / kVolumeStep;
}

Seams::Corners corners_at(const Patch& phi, int i, int j, int k) {
    const int at = (k * kPatchSide + j) * kPatchSide + i;
    constexpr int y = kPatchSide, z = kPatchSide * kPatchSide;
    return {phi[at],     phi[at + 1],     phi[at + y],     phi[at + y + 1],
            phi[at + z], phi[at + z + 1], phi[at + z + y], phi[at + z + y + 1]};
}

void make_partitioned(const PlaceValues& values, std::size_t n, Patch& out) {
    for (int i = 0; i < values.samples(); ++i)
        out[i] = partitioned(values.phi[n][i], values.smallest[i], values.second[i]);
}

// Bit i of row 9 k + j: the sample is inside.
using Signs = std::array<unsigned, kPatchSide * kPatchSide>;

Signs signs_of(const Patch& phi) {
    Signs signs;
    for (int row = 0; row < kPatchSide * kPatchSide; ++row) {
        signs[row] = 0;
        for (int i = 0; i < kPatchSide; ++i)
            signs[row] |= static_cast<unsigned>(phi[row * kPatchSide + i] < 0) << i;
    }
    return signs;
}

// Volume of a partitioned region in each part of a place, mm^3, seams left out.
Part inside_parts(const Patch& phi, double sample_volume) {
    const Signs signs = signs_of(phi);
    std::array<double, kCells> sum{};
    for (int k = 0; k < kSide; ++k)
        for (int j = 0; j < kSide; ++j) {
            const unsigned* row = signs.data() + k * kPatchSide + j;
            const unsigned any = row[0] | row[1] | row[kPatchSide] | row[kPatchSide + 1];
            const unsigned all = row[0] & row[1] & row[kPatchSide] & row[kPatchSide + 1];
            for (int i = 0; any != 0 && i < kSide; ++i) {
                if (!(any >> i & 3u)) continue;
                sum[part_of(i, j, k)] +=
                    (all >> i & 3u) == 3u ? 1.0 : inside_fraction(corners_at(phi, i, j, k));
            }
        }
    Part part;
    for (int c = 0; c < kCells; ++c) part[c] = static_cast<float>(sum[c] * sample_volume);
    return part;
}

// What the seams of a place add to that, for each of its regions; whether there
// are any.
bool add_seams(const PlaceValues& values, double spacing, std::span<Part> extra) {
    std::fill(extra.begin(), extra.end(), Part{});
    if (values.count < 3) return false;
    const double sample_volume = std::pow(spacing, 3);
    PlaceSeams seams;
    find_seams(values, spacing, seams);
    Patch phi;
    for (std::size_t n = 0; n < values.count && !seams.cells.empty(); ++n) {
        make_partitioned(values, n, phi);
        for (std::size_t s = 0; s < seams.cells.size(); ++s) {
            if (seams.cells[s].region != static_cast<int>(n)) continue;
            const int cell = seams.cells[s].cell;
            const int i = cell % kSide, j = cell / kSide % kSide, k = cell / (kSide * kSide);
            extra[n][part_of(i, j, k)] +=
                static_cast<float>(sample_volume * (inside_fraction(seams.of(s)) -
                                                    inside_fraction(corners_at(phi, i, j, k))));
        }
    }
    return !seams.cells.empty();
}

// The measured volumes, those of the seams apart: these take longer to find,
// and hardly change while the regions do, but for specks that consist of them.
struct Volumes {
    std::vector<Part> part, extra;  // as Places::region
    std::vector<char> speck;        // per region
    std::vector<char> seamed;       // per place: may have seams

    [[nodiscard]] float at(std::size_t n, int c) const { return part[n][c] + extra[n][c]; }
};

std::vector<char> find_specks(std::span<const double> total, double spacing) {
    constexpr double kSamples = 100;
    std::vector<char> speck;
    for (const double t : total) speck.push_back(t > 0 && t < kSamples * std::pow(spacing, 3));
    return speck;
}

void measure_seams(const std::vector<RegionBand>& regions, const Places& places,
                   std::span<const double> offset, Volumes& volumes) {
    parallel_for(0, places.places.size(), kGrain, [&](std::size_t first, std::size_t last) {
        PlaceValues values;
        for (std::size_t p = first; p < last; ++p) {
            const Place& place = places.places[p];
            if (place.last - place.first < 3 || !volumes.seamed[p]) continue;
            load_place(regions, places, place, offset, 1, values);
            const auto extra = std::span(volumes.extra).subspan(place.first, values.count);
            volumes.seamed[p] = add_seams(values, regions[0].band.spacing, extra);
        }
    });
}

// The volume of every region, mm^3; only places with a region that `moved` are
// measured again.
std::vector<double> measure(const std::vector<RegionBand>& regions, const Places& places,
                            std::span<const double> offset, const std::vector<char>& moved,
                            Volumes& volumes) {
    const double sample_volume = std::pow(regions[0].band.spacing, 3);
    parallel_for(0, places.places.size(), kGrain, [&](std::size_t first, std::size_t last) {
        PlaceValues values;
        Patch phi;
        for (std::size_t p = first; p < last; ++p) {
            const Place& place = places.places[p];
            const auto* here = places.region.data();
            if (std::none_of(here + place.first, here + place.last,
                             [&](int r) { return moved[r] != 0; }))
                continue;
            load_place(regions, places, place, offset, 1, values);
            for (std::size_t n = 0; n < values.count; ++n) {
                make_partitioned(values, n, phi);
                volumes.part[place.first + n] = inside_parts(phi, sample_volume);
            }
            if (std::any_of(here + place.first, here + place.last,
                            [&](int r) { return volumes.speck[r] != 0; }))
                add_seams(values, regions[0].band.spacing,
                          std::span(volumes.extra).subspan(place.first, values.count));
        }
    });
    std::vector<double> volume = places.full;
    for (std::size_t i = 0; i < places.region.size(); ++i)
        for (int c = 0; c < kCells; ++c) volume[places.region[i]] += volumes.at(i, c);
    return volume;
}

// The seams of every region, found before their samples change.
std::vector<Seams> all_seams(const std::vector<RegionBand>& regions, const Places& places,
                             std::span<const double> offset) {
    std::vector<PlaceSeams> found(places.places.size());
    parallel_for(0, found.size(), kGrain, [&](std::size_t first, std::size_t last) {
        PlaceValues values;
        for (std::size_t p = first; p < last; ++p) {
            const Place& place = places.places[p];
            if (place.last - place.first < 3) continue;
            load_place(regions, places, place, offset, 1, values);
            find_seams(values, regions[0].band.spacing, found[p]);
        }
    });
    std::vector<Seams> seams(regions.size());
    for (std::size_t p = 0; p < found.size(); ++p) {
        const Place& place = places.places[p];
        for (std::size_t n = 0; n < found[p].cells.size(); ++n) {
            const PlaceSeams::Cell& cell = found[p].cells[n];
            const int r = places.region[place.first + cell.region];
            const Index3 block = local_block(regions[r], place.block);
            const auto pieces = found[p].of(n);
            seams[r].cell.push_back({block[0] * kSide + cell.cell % kSide,
                                     block[1] * kSide + cell.cell / kSide % kSide,
                                     block[2] * kSide + cell.cell / (kSide * kSide)});
            seams[r].first.push_back(static_cast<std::uint32_t>(seams[r].piece.size()));
            seams[r].piece.insert(seams[r].piece.end(), pieces.begin(), pieces.end());
        }
    }
    return seams;
}

void apply(std::vector<RegionBand>& regions, const Places& places, std::span<const double> offset) {
    parallel_for(0, places.places.size(), kGrain, [&](std::size_t first, std::size_t last) {
        PlaceValues values;
        for (std::size_t p = first; p < last; ++p) {
            const Place& place = places.places[p];
            load_place(regions, places, place, offset, 0, values);
            for (std::size_t n = 0; n < values.count; ++n) {
                RegionBand& r = regions[places.region[place.first + n]];
                const std::int32_t number = r.band.find(local_block(r, place.block));
                if (number < 0) continue;
                float* out = r.band.block(number);
                for (int i = 0; i < Band::kSize; ++i)
                    out[i] = std::clamp(
                        partitioned(values.phi[n][i], values.smallest[i], values.second[i]),
                        -r.band.width, r.band.width);
            }
        }
    });
}

}  // namespace

std::vector<SharedWall> shared_walls(const RegionMap& map, const Vec3& face_area) {
    std::map<std::pair<int, int>, double> area;
    const auto face = [&](int a, int b, int axis) {
        if (a != b) area[{std::min(a, b), std::max(a, b)}] += face_area[axis];
    };
    // One layer outside on the low side, so that walls on the volume's border count.
    for (int k = -1; k < map.size[2]; ++k)
        for (int j = -1; j < map.size[1]; ++j)
            for (int i = -1; i < map.size[0]; ++i) {
                const int own = map.owner_at(i, j, k);
                face(own, map.owner_at(i + 1, j, k), 0);
                face(own, map.owner_at(i, j + 1, k), 1);
                face(own, map.owner_at(i, j, k + 1), 2);
            }
    std::vector<SharedWall> walls;
    for (const auto& [pair, sum] : area) walls.push_back({pair.first, pair.second, sum});
    return walls;
}

namespace {

// Each region gains what it misses near each place, were the partition made now.
void restore_cells(std::vector<RegionBand>& regions, const Places& places,
                   const WantedVolumes& wanted, Volumes& volumes) {
    const std::vector<double> none(regions.size(), 0.0);
    measure(regions, places, none, std::vector<char>(regions.size(), 1), volumes);
    std::vector<CellVolumes> missing = wanted.cells;
    for (const Place& place : places.places)
        for (std::size_t n = place.first; n < place.last; ++n) {
            const int r = places.region[n];
            const std::int32_t block = regions[r].band.find(local_block(regions[r], place.block));
            if (block < 0) continue;
            for (int c = 0; c < kCells; ++c) missing[r][block][c] -= volumes.at(n, c);
        }
    parallel_for(0, regions.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t r = first; r < last; ++r) {
            restore_volume(regions[r].band, missing[r], wanted.radius);
            apply_locks(regions[r].band, {regions[r].locks, regions[r].lock_unit});
        }
    });
}

// Finds the offsets that give each region its total, the seams' volumes being
// held; returns how often it moved any. `moved` says what to measure first.
int match_totals(const std::vector<RegionBand>& regions, const Places& places,
                 std::span<const SharedWall> walls, std::span<const double> total,
                 std::vector<char> moved, Volumes& volumes, PartitionSummary& summary) {
    constexpr int kMostIterations = 12, kTries = 4;
    constexpr double kGoodEnough = 1e-3;
    const std::size_t count = regions.size();
    const double spacing = regions[0].band.spacing;
    std::vector<double> before(count), asked(count, 0.0);
    std::vector<double> answer(count, 1.0);  // volume gained for volume asked
    for (int iterations = 0;; ++iterations) {
        const auto now = measure(regions, places, summary.offset, moved, volumes);
        std::vector<double> missing(count, 0.0);
        summary.largest_error = 0;
        for (std::size_t r = 1; r < count; ++r) {
            // Nothing is left of a speck that fell between the samples.
            if (!(now[r] > 0) && summary.iterations + iterations >= kTries) continue;
            const double error = std::abs(total[r] - now[r]) / total[r];
            summary.largest_error = std::max(summary.largest_error, error);
            // Small regions answer less than their walls' area promises.
            if (iterations > 0 && std::abs(asked[r]) > 1e-3 * total[r])
                answer[r] = std::clamp((now[r] - before[r]) / asked[r], 0.25, 1.5);
            if (error > kGoodEnough) missing[r] = (total[r] - now[r]) / answer[r];
        }
        if (summary.largest_error < kGoodEnough ||
            summary.iterations + iterations == kMostIterations)
            return iterations;
        const auto change = offsets_for(missing, walls);
        for (std::size_t r = 1; r < count; ++r) {
            const double last = summary.offset[r];
            // Interfaces must stay well inside the bands.
            summary.offset[r] = std::clamp(last + change[r], -spacing, spacing);
            moved[r] = std::abs(summary.offset[r] - last) > 1e-4 * spacing;
            if (!moved[r]) summary.offset[r] = last;
        }
        moved[0] = 0;
        before = now;
        asked = missing;
    }
}

// Offsets and locks become part of the samples.
void bake(std::vector<RegionBand>& regions, std::span<const double> offset) {
    for (std::size_t r = 0; r < regions.size(); ++r) {
        Band& band = regions[r].band;
        const float shift = static_cast<float>(offset[r]);
        for (float& v : band.values)
            if (std::abs(v) < band.width) v = std::clamp(v + shift, -band.width, band.width);
        apply_locks(band, {regions[r].locks, regions[r].lock_unit});
        std::fill(regions[r].locks.begin(), regions[r].locks.end(), std::int8_t{0});
    }
}

}  // namespace

PartitionSummary make_partition(std::vector<RegionBand>& regions, const RegionMap& map,
                                const SharedLattice& lattice, std::span<const SharedWall> walls,
                                const WantedVolumes& wanted, const ProgressSink& progress) {
    constexpr int kRestoring = 3, kMostPasses = 4;
    const Places places = find_places(regions, map, lattice);
    PartitionSummary summary;
    summary.offset.assign(regions.size(), 0.0);
    const std::size_t count = places.region.size();
    Volumes volumes{std::vector<Part>(count), std::vector<Part>(count),
                    find_specks(wanted.total, lattice.spacing),
                    std::vector<char>(places.places.size(), 1)};
    measure_seams(regions, places, summary.offset, volumes);
    for (int round = 0; round < (wanted.cells.empty() ? 0 : kRestoring); ++round) {
        progress.check();
        restore_cells(regions, places, wanted, volumes);
    }
    // Until the totals hold with the seams as they now are.
    for (int pass = 0; pass < kMostPasses; ++pass) {
        progress.check();
        if (pass > 0) measure_seams(regions, places, summary.offset, volumes);
        const int moves =
            match_totals(regions, places, walls, wanted.total,
                         std::vector<char>(regions.size(), pass == 0), volumes, summary);
        summary.iterations += moves;
        if (pass > 0 && moves == 0) break;
    }
    std::vector<double> offset = summary.offset;
    if (wanted.hold_voxels) {
        bake(regions, offset);
        hold_voxels(regions, map, lattice, progress);
        offset.assign(regions.size(), 0.0);
    }
    summary.seams = all_seams(regions, places, offset);
    apply(regions, places, offset);
    return summary;
}

}  // namespace myotet::levelset
