// SPDX-License-Identifier: Apache-2.0
// The stages of meshing on a torus of three sizes: tetrahedra per second of
// processor time (all threads) and of wall time.
#include <benchmark/benchmark.h>

#include <cmath>

#include "Meshing/Compress.h"
#include "Meshing/MeshLevelSet.h"
#include "Meshing/Refine.h"
#include "Meshing/Select.h"
#include "Support/AnalyticLevelSet.h"

namespace {

using namespace myotet;

double torus(const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 30, p.z()) - 12; }

const levelset::LevelSet& level_set() {
    static const levelset::LevelSet phi = support::sample_level_set(support::cube(48), 0.5, torus);
    return phi;
}

// Edge lengths in hundredths of a mm; each step has about four times the tetrahedra.
meshing::Options options(const benchmark::State& state, bool adaptive) {
    meshing::Options o{.edge_length = 0.01 * static_cast<double>(state.range(0))};
    if (!adaptive) {
        o.interior_edge_length = o.edge_length;
        o.thickness_factor = 0;
        o.distance_factor = 0;
    }
    return o;
}

void report(benchmark::State& state, std::size_t tets) {
    state.counters["tets"] = static_cast<double>(tets);
    state.counters["tets_per_s"] = benchmark::Counter(
        static_cast<double>(tets), benchmark::Counter::kIsIterationInvariantRate);
}

void lattice_and_selection(benchmark::State& state, bool adaptive) {
    const meshing::Options o = options(state, adaptive);
    const meshing::LevelPlan plan = meshing::plan_levels(o);
    SilentProgress quiet;
    std::size_t tets = 0;
    for (auto _ : state) {
        auto lattice = meshing::build_lattice(level_set(), o, plan, quiet);
        tets = meshing::select_candidate(lattice, {}, quiet).mesh.tets.size();
    }
    report(state, tets);
}
void BM_LatticeAndSelectionUniform(benchmark::State& s) { lattice_and_selection(s, false); }
void BM_LatticeAndSelectionAdaptive(benchmark::State& s) { lattice_and_selection(s, true); }

void BM_Compression(benchmark::State& state) {
    const meshing::Options o = options(state, true);
    SilentProgress quiet;
    auto lattice = meshing::build_lattice(level_set(), o, meshing::plan_levels(o), quiet);
    const TetMesh candidate = meshing::select_candidate(lattice, {}, quiet).mesh;
    for (auto _ : state) {
        TetMesh mesh = candidate;
        meshing::fit_surface(mesh, level_set(), quiet);
        benchmark::DoNotOptimize(meshing::polish(mesh, level_set(), {}, quiet));
    }
    report(state, candidate.tets.size());
}

void BM_WholeMesh(benchmark::State& state) {
    const meshing::Options o = options(state, true);
    SilentProgress quiet;
    std::size_t tets = 0;
    for (auto _ : state) tets = meshing::mesh_level_set(level_set(), o, quiet).mesh.tets.size();
    report(state, tets);
}

#define MYOTET_SIZES                    \
    ->Arg(400)                          \
        ->Arg(250)                      \
        ->Arg(150)                      \
        ->Unit(benchmark::kMillisecond) \
        ->MeasureProcessCPUTime()       \
        ->UseRealTime()
BENCHMARK(BM_LatticeAndSelectionUniform) MYOTET_SIZES;
BENCHMARK(BM_LatticeAndSelectionAdaptive) MYOTET_SIZES;
BENCHMARK(BM_Compression) MYOTET_SIZES;
BENCHMARK(BM_WholeMesh) MYOTET_SIZES;

}  // namespace
