// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Partition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "Core/Parallel.h"
#include "LevelSet/Flow.h"
#include "LevelSet/Measure.h"
#include "LevelSet/Offsets.h"

namespace myotet::levelset {
namespace {

constexpr int kSide = Band::kSide;
constexpr int kSamples = kSide + 1;
using Patch = std::array<float, kSamples * kSamples * kSamples>;
constexpr std::size_t kGrain = 16;

// A shared block and the regions whose values count there.
struct Place {
    Index3 block;             // among the shared lattice's
    std::size_t first, last;  // in Places::region
};
struct Places {
    std::vector<Place> places;
    std::vector<int> region;   // ascending within a place
    std::vector<double> full;  // per region: volume of blocks wholly inside, mm^3
};

Index3 local(const RegionBand& r, const Index3& block) {
    return {block[0] - r.first[0], block[1] - r.first[1], block[2] - r.first[2]};
}

struct Key {
    Index3 block;  // k, j, i: sorts in memory order
    int region;
    auto operator<=>(const Key&) const = default;
};

// The region that owns the block's first sample: where it is stored nowhere
// near, it fills the block and is missed otherwise.
int owner_of(const RegionMap& map, const SharedLattice& lattice, const Index3& block) {
    const Vec3 u =
        lattice.local_to_index * (lattice.spacing * kSide * Vec3(block[0], block[1], block[2]));
    return map.owner_at(static_cast<int>(std::lround(u[0])), static_cast<int>(std::lround(u[1])),
                        static_cast<int>(std::lround(u[2])));
}

// A region counts in the blocks it stores, and in the lower neighbours of
// these, whose cells reach one sample into them.
Places find_places(const std::vector<RegionBand>& regions, const RegionMap& map,
                   const SharedLattice& lattice) {
    std::vector<Key> keys;
    for (std::size_t r = 0; r < regions.size(); ++r)
        for (const Index3& p : regions[r].band.position)
            for (int n = 0; n < 8; ++n)
                keys.push_back({{p[2] + regions[r].first[2] - (n >> 2),
                                 p[1] + regions[r].first[1] - (n >> 1 & 1),
                                 p[0] + regions[r].first[0] - (n & 1)},
                                static_cast<int>(r)});
    const auto tidy = [&] {
        std::sort(keys.begin(), keys.end());
        keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    };
    tidy();
    const std::size_t stored = keys.size();
    for (std::size_t i = 0; i < stored; ++i)
        if (i == 0 || keys[i].block != keys[i - 1].block)
            for (int n = 0; n < 8; ++n) {
                const Index3& b = keys[i].block;
                keys.push_back(
                    {b, owner_of(map, lattice,
                                 {b[2] + (n & 1), b[1] + (n >> 1 & 1), b[0] + (n >> 2)})});
            }
    tidy();
    Places out;
    out.full.assign(regions.size(), 0);
    std::vector<std::int64_t> inside(regions.size(), 0);
    for (std::size_t r = 0; r < regions.size(); ++r)
        for (const std::int32_t n : regions[r].band.block_of) inside[r] += n == Band::kInside;
    for (const Key& key : keys) {
        const Index3 block{key.block[2], key.block[1], key.block[0]};
        if (out.places.empty() || out.places.back().block != block)
            out.places.push_back({block, out.region.size(), out.region.size()});
        out.region.push_back(key.region);
        out.places.back().last = out.region.size();
        const RegionBand& r = regions[key.region];
        inside[key.region] -= r.band.find(local(r, block)) == Band::kInside;
    }
    for (std::size_t r = 0; r < regions.size(); ++r)
        out.full[r] = static_cast<double>(inside[r]) * Band::kSize * std::pow(lattice.spacing, 3);
    return out;
}

// Values of one region at a place, with offset and locks.
void load(const RegionBand& region, const Index3& block, float offset, int high, float* out) {
    const Index3 b = local(region, block);
    gather(region.band, b, 0, high, out);
    const int side = kSide + high, count = side * side * side;
    const float width = region.band.width, unit = static_cast<float>(region.lock_unit);
    std::array<std::int8_t, kSamples * kSamples * kSamples> locks;
    gather(
        region.band, region.locks.data(), b, 0, high, [](std::int32_t) { return std::int8_t{0}; },
        locks.data());
    for (int i = 0; i < count; ++i)
        // Beyond the band nothing moves, or interfaces would appear at its edge.
        if (std::abs(out[i]) < width) out[i] = locked(out[i] + offset, locks[i], unit);
}

struct Scratch {
    std::vector<Patch> phi;
    Patch shift;
};

// Loads all regions of a place and what is to be subtracted from them.
void partition_place(const std::vector<RegionBand>& regions, const Places& places,
                     const Place& place, std::span<const double> offset, int high, Scratch& work) {
    const std::size_t count = place.last - place.first;
    if (work.phi.size() < count) work.phi.resize(count);
    const int side = kSide + high, samples = side * side * side;
    Patch second;
    const float wide = regions[0].band.width;
    std::fill_n(work.shift.begin(), samples, wide);
    std::fill_n(second.begin(), samples, wide);
    for (std::size_t n = 0; n < count; ++n) {
        const int r = places.region[place.first + n];
        Patch& phi = work.phi[n];
        load(regions[r], place.block, static_cast<float>(offset[r]), high, phi.data());
        for (int i = 0; i < samples; ++i) {
            const float v = phi[i];
            second[i] = std::min(second[i], std::max(work.shift[i], v));
            work.shift[i] = std::min(work.shift[i], v);
        }
    }
    for (int i = 0; i < samples; ++i) work.shift[i] = 0.5f * (work.shift[i] + second[i]);
}

constexpr int kCells = 8;  // of volumes, a block
using Part = std::array<float, kCells>;

// Volume of the partitioned region in each cell of a place, mm^3.
Part inside_cells(const Patch& phi, const Patch& shift, double sample_volume) {
    constexpr int half = kSide / kVolumeStep;
    static_assert(half * half * half == kCells);
    std::array<double, kCells> sum{};
    for (int k = 0; k < kSide; ++k)
        for (int j = 0; j < kSide; ++j)
            for (int i = 0; i < kSide; ++i) {
                std::array<float, 8> corner;
                for (int c = 0; c < 8; ++c) {
                    const int at =
                        ((k + (c >> 2)) * kSamples + j + (c >> 1 & 1)) * kSamples + i + (c & 1);
                    corner[c] = phi[at] - shift[at];
                }
                sum[(k / kVolumeStep * half + j / kVolumeStep) * half + i / kVolumeStep] +=
                    inside_fraction(corner);
            }
    Part part;
    for (int c = 0; c < kCells; ++c) part[c] = static_cast<float>(sum[c] * sample_volume);
    return part;
}

// The volume of every region, mm^3. `part` keeps what each place holds of each
// region; only places with a region that `moved` are measured again.
std::vector<double> measure(const std::vector<RegionBand>& regions, const Places& places,
                            std::span<const double> offset, const std::vector<char>& moved,
                            std::vector<Part>& part) {
    const double cell = std::pow(regions[0].band.spacing, 3);
    parallel_for(0, places.places.size(), kGrain, [&](std::size_t first, std::size_t last) {
        Scratch work;
        for (std::size_t p = first; p < last; ++p) {
            const Place& place = places.places[p];
            const auto* here = places.region.data();
            if (std::none_of(here + place.first, here + place.last,
                             [&](int r) { return moved[r] != 0; }))
                continue;
            partition_place(regions, places, place, offset, 1, work);
            for (std::size_t n = 0; n < place.last - place.first; ++n)
                part[place.first + n] = inside_cells(work.phi[n], work.shift, cell);
        }
    });
    std::vector<double> volume = places.full;
    for (std::size_t i = 0; i < part.size(); ++i)
        for (const float v : part[i]) volume[places.region[i]] += v;
    return volume;
}

void apply(std::vector<RegionBand>& regions, const Places& places, std::span<const double> offset) {
    parallel_for(0, places.places.size(), kGrain, [&](std::size_t first, std::size_t last) {
        Scratch work;
        for (std::size_t p = first; p < last; ++p) {
            const Place& place = places.places[p];
            partition_place(regions, places, place, offset, 0, work);
            for (std::size_t n = 0; n < place.last - place.first; ++n) {
                RegionBand& r = regions[places.region[place.first + n]];
                const std::int32_t number = r.band.find(local(r, place.block));
                if (number < 0) continue;
                float* out = r.band.block(number);
                for (int i = 0; i < Band::kSize; ++i)
                    out[i] =
                        std::clamp(work.phi[n][i] - work.shift[i], -r.band.width, r.band.width);
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
                   const WantedVolumes& wanted, std::vector<Part>& part) {
    const std::vector<double> none(regions.size(), 0.0);
    measure(regions, places, none, std::vector<char>(regions.size(), 1), part);
    std::vector<CellVolumes> missing = wanted.cells;
    for (const Place& place : places.places)
        for (std::size_t n = place.first; n < place.last; ++n) {
            const int r = places.region[n];
            const std::int32_t block = regions[r].band.find(local(regions[r], place.block));
            if (block < 0) continue;
            for (int c = 0; c < kCells; ++c) missing[r][block][c] -= part[n][c];
        }
    parallel_for(0, regions.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t r = first; r < last; ++r) {
            restore_volume(regions[r].band, missing[r], wanted.radius);
            apply_locks(regions[r].band, {regions[r].locks, regions[r].lock_unit});
        }
    });
}

}  // namespace

PartitionSummary make_partition(std::vector<RegionBand>& regions, const RegionMap& map,
                                const SharedLattice& lattice, std::span<const SharedWall> walls,
                                const WantedVolumes& wanted, const ProgressSink& progress) {
    constexpr int kRestoring = 3, kMostIterations = 12;
    constexpr double kGoodEnough = 1e-3;
    const std::size_t count = regions.size();
    const Places places = find_places(regions, map, lattice);
    std::vector<Part> part(places.region.size());
    for (int round = 0; round < (wanted.cells.empty() ? 0 : kRestoring); ++round) {
        progress.check();
        restore_cells(regions, places, wanted, part);
    }
    PartitionSummary summary;
    summary.offset.assign(count, 0.0);
    std::vector<double> before(count), asked(count, 0.0);
    std::vector<double> answer(count, 1.0);  // volume gained for volume asked
    std::vector<char> moved(count, 1);
    while (true) {
        progress.check();
        const auto now = measure(regions, places, summary.offset, moved, part);
        std::vector<double> missing(count, 0.0);
        summary.largest_error = 0;
        for (std::size_t r = 1; r < count; ++r) {
            const double total = wanted.total[r], error = std::abs(total - now[r]) / total;
            summary.largest_error = std::max(summary.largest_error, error);
            // Small regions answer less than their walls' area promises.
            if (summary.iterations > 0 && std::abs(asked[r]) > 1e-3 * total)
                answer[r] = std::clamp((now[r] - before[r]) / asked[r], 0.25, 1.5);
            if (error > kGoodEnough) missing[r] = (total - now[r]) / answer[r];
        }
        if (summary.largest_error < kGoodEnough || summary.iterations == kMostIterations) break;
        ++summary.iterations;
        const auto change = offsets_for(missing, walls);
        for (std::size_t r = 1; r < count; ++r) {
            const double last = summary.offset[r];
            // Interfaces must stay well inside the bands.
            summary.offset[r] = std::clamp(last + change[r], -lattice.spacing, lattice.spacing);
            moved[r] = std::abs(summary.offset[r] - last) > 1e-4 * lattice.spacing;
            if (!moved[r]) summary.offset[r] = last;
        }
        moved[0] = 0;
        before = now;
        asked = missing;
    }
    apply(regions, places, summary.offset);
    return summary;
}

}  // namespace myotet::levelset
