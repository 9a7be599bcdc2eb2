// SPDX-License-Identifier: Apache-2.0
#include "Play/RunPlay.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "Contraction/Run.h"
#include "Core/Errors.h"
#include "MeshFiles/Series.h"

namespace myotet::play {
namespace fs = std::filesystem;

namespace {

// Output times are met to this part of a step.
constexpr double kSameTime = 1e-6;

// Wall and processor time from lap to lap.
class Clock {
public:
    struct Lap {
        double wall = 0, processor = 0;
    };
    Lap lap() {
        const auto now = std::chrono::steady_clock::now();
        const std::clock_t used = std::clock();
        const Lap lap{std::chrono::duration<double>(now - now_).count(),
                      static_cast<double>(used - used_) / CLOCKS_PER_SEC};
        now_ = now;
        used_ = used;
        return lap;
    }

private:
    std::chrono::steady_clock::time_point now_ = std::chrono::steady_clock::now();
    std::clock_t used_ = std::clock();
};

fs::path numbered(const char* stem, std::size_t frame, const char* extension) {
    return fs::path("frames") / (stem + ("_" + meshfiles::frame_digits(frame)) + extension);
}

std::map<std::int32_t, std::string> names_of(const World& world) {
    std::map<std::int32_t, std::string> names;
    for (const Body& body : world.bodies)
        names.emplace(static_cast<std::int32_t>(names.size() + 1), body.name);
    for (const Ball& ball : world.balls)
        names.emplace(static_cast<std::int32_t>(names.size() + 1), ball.name);
    return names;
}

void append(TriMesh& whole, const TriMesh& part) {
    const auto first = static_cast<std::int32_t>(whole.points.size());
    whole.points.insert(whole.points.end(), part.points.begin(), part.points.end());
    for (const Triangle& t : part.triangles)
        whole.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

const std::vector<contraction::Column> kColumns = {{"time", "s"},
                                                   {"kinetic_energy", "mJ"},
                                                   {"elastic_energy", "mJ"},
                                                   {"weight_energy", "mJ"},
                                                   {"contact_energy", "mJ"},
                                                   {"total_energy", "mJ"},
                                                   {"deepest", "mm"},
                                                   {"touching", ""},
                                                   {"press", "N"},
                                                   {"smallest_volume_ratio", ""},
                                                   {"iterations", ""}};

// What the run has written and measured.
class Recorder {
public:
    Recorder(const PlayScene& scene, const World& world, const RunPlayOptions& options,
             PlaySummary& summary)
        : scene_(scene), world_(world), options_(options), summary_(summary) {
        summary_.history.columns = kColumns;
    }

    // After a step, or at the start.
    void record(Stepper& stepper, const State& state, const StepReport& step) {
        const double deepest = stepper.deepest(state);
        const double ratio = stepper.smallest_volume_ratio(state);
        const Energies& e = step.energies;
        summary_.deepest = std::max(summary_.deepest, deepest);
        summary_.smallest_volume_ratio = std::min(summary_.smallest_volume_ratio, ratio);
        if (!(ratio > 0)) summary_.inverted += count_inverted(state);
        if (summary_.history.rows.empty())
            summary_.first = e;
        else
            summary_.greatest_gain =
                std::max(summary_.greatest_gain, e.total() - summary_.last.total());
        summary_.last = e;
        summary_.history.rows.push_back({state.time, e.kinetic, e.elastic, e.weight, e.contact,
                                         e.total(), deepest, double(step.touching), step.press,
                                         ratio, double(step.iterations)});
    }
    void frame_if_due(const State& state, const std::vector<TriMesh>& details) {
        const double due = static_cast<double>(times_.size()) * scene_.every;
        if (state.time < due - kSameTime * scene_.step) return;
        const std::size_t number = times_.size();
        write_cages(state, options_.folder / numbered("cages", number, ".vtu"));
        write_surfaces(state, details, options_.folder / numbered("surfaces", number, ".vtp"));
        times_.push_back(state.time);
        if (options_.watch) options_.watch({number, state.time, world_, state, details});
    }
    void finish() {
        std::vector<contraction::TimedFile> files;
        for (std::size_t i = 0; i < times_.size(); ++i)
            for (const fs::path& name :
                 {numbered("cages", i, ".vtu"), numbered("surfaces", i, ".vtp")}) {
                files.push_back({times_[i], name});
                summary_.files.push_back(name);
            }
        summary_.frames = times_.size();
        contraction::write_pvd(files, options_.folder / kPlayCollection);
        contraction::write_history(summary_.history, options_.folder / kPlayHistory);
        summary_.files.emplace_back(kPlayCollection);
        summary_.files.emplace_back(kPlayHistory);
    }

private:
    std::size_t count_inverted(const State& state) const {
        std::size_t count = 0;
        for (const Body& body : world_.bodies)
            for (const Tet& t : body.tets)
                count += !(
                    signed_volume(state.x[t[0]], state.x[t[1]], state.x[t[2]], state.x[t[3]]) > 0);
        return count;
    }
    void write_cages(const State& state, const fs::path& file) const {
        TetMesh all;
        meshfiles::MeshArrays arrays;
        arrays.time = state.time;
        meshfiles::NamedArray velocity{"velocity", 3, {}};
        for (std::size_t b = 0; b < world_.bodies.size(); ++b) {
            const Body& body = world_.bodies[b];
            TetMesh mesh = mesh_of(body, state.x);
            mesh.labels.assign(mesh.tets.size(), static_cast<std::int32_t>(b + 1));
            myotet::append(all, mesh);
            for (std::int32_t n = body.first_node; n < body.first_node + body.nodes; ++n)
                for (int a = 0; a < 3; ++a) velocity.values.push_back(state.v[n][a]);
        }
        arrays.points.push_back(std::move(velocity));
        meshfiles::write_vtu(all, names_of(world_), arrays, file);
    }
    void write_surfaces(const State& state, const std::vector<TriMesh>& details,
                        const fs::path& file) const {
        TriMesh all;
        for (const TriMesh& detail : details) append(all, detail);
        for (const Ball& ball : world_.balls)
            append(all, surface_of_ball(state.x[ball.node], ball.radius));
        meshfiles::write_vtp(all, {}, file);
    }

    const PlayScene& scene_;
    const World& world_;
    const RunPlayOptions& options_;
    PlaySummary& summary_;
    std::vector<double> times_;
};

void make_folder(const fs::path& folder) {
    std::error_code failed;
    fs::create_directories(folder / "frames", failed);
    if (failed) throw IoError(folder.string() + ": cannot make the folder: " + failed.message());
    contraction::remove_numbered(folder / "frames", ".vtu");
    contraction::remove_numbered(folder / "frames", ".vtp");
}

// Room for the details, which are then only moved.
std::vector<TriMesh> details_at_rest(const World& world) {
    std::vector<TriMesh> details;
    for (const Body& body : world.bodies) details.push_back(detail_of(body, world.rest));
    return details;
}

void move_details(const World& world, const State& state, std::vector<TriMesh>& details) {
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const Body& body = world.bodies[b];
        if (body.detail.points.empty())
            details[b] = detail_of(body, state.x);
        else
            cage::deform(body.embedding,
                         {state.x.data() + body.first_node, static_cast<std::size_t>(body.nodes)},
                         details[b].points);
    }
}

void add(const StepReport& step, const Clock::Lap& lap, PlaySummary& summary) {
    ++summary.steps;
    summary.unsettled_steps += !step.settled;
    summary.iterations += step.iterations;
    summary.linear_iterations += step.linear_iterations;
    summary.seconds += lap.wall;
    summary.processor_seconds += lap.processor;
    summary.worst_frame = std::max(summary.worst_frame, lap.wall);
    summary.worst_processor = std::max(summary.worst_processor, lap.processor);
}

}  // namespace

TriMesh surface_of_ball(const Vec3& centre, double radius) {
    constexpr int kRings = 16, kAround = 32;
    TriMesh ball;
    ball.points.emplace_back(centre + Vec3(0, 0, radius));
    for (int i = 1; i < kRings; ++i)
        for (int j = 0; j < kAround; ++j) {
            const double polar = M_PI * i / kRings, around = 2 * M_PI * j / kAround;
            ball.points.emplace_back(centre + radius * Vec3(std::sin(polar) * std::cos(around),
                                                            std::sin(polar) * std::sin(around),
                                                            std::cos(polar)));
        }
    ball.points.emplace_back(centre - Vec3(0, 0, radius));
    const auto at = [](int ring, int j) { return 1 + (ring - 1) * kAround + j % kAround; };
    const auto last = static_cast<std::int32_t>(ball.points.size() - 1);
    for (int j = 0; j < kAround; ++j) {
        ball.triangles.push_back({0, at(1, j), at(1, j + 1)});
        for (int i = 1; i + 1 < kRings; ++i) {
            ball.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            ball.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
        ball.triangles.push_back({at(kRings - 1, j), last, at(kRings - 1, j + 1)});
    }
    return ball;
}

PlaySummary run_play(const PlayScene& scene, World& world, const RunPlayOptions& options,
                     ProgressSink& progress) {
    make_folder(options.folder);
    PlaySummary summary;
    Recorder recorder(scene, world, options, summary);
    Stepper stepper(world, options.step);
    State state = stepper.start();
    std::vector<TriMesh> details = details_at_rest(world);
    recorder.record(stepper, state, {.settled = true, .energies = stepper.energies(state)});
    recorder.frame_if_due(state, details);
    const auto steps = static_cast<int>(std::ceil(scene.end / scene.step - kSameTime));
    for (int i = 0; i < steps && !summary.interrupted; ++i) {
        Clock clock;
        const StepReport step = stepper.step(scene.step, state);
        move_details(world, state, details);
        add(step, clock.lap(), summary);
        state.time = (i + 1) * scene.step;
        recorder.record(stepper, state, step);
        recorder.frame_if_due(state, details);
        progress.report("playing", static_cast<double>(i + 1) / steps);
        summary.interrupted = progress.interrupted();
    }
    summary.reached = state.time;
    summary.completed = !summary.interrupted;
    summary.message = summary.completed ? "played to the end" : "interrupted";
    recorder.finish();
    return summary;
}

}  // namespace myotet::play
