// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Run.h"

#include <algorithm>

#include "Contraction/Words.h"
#include "Core/Errors.h"

namespace myotet::contraction {
namespace fs = std::filesystem;

namespace {

// Output times are met to this part of a step.
constexpr double kSameTime = 1e-6;
// Of a frame's number, at least.
constexpr std::size_t kDigits = 4;

// What the run has written, and how it goes on.
class Recorder {
public:
    Recorder(const Scene& scene, const Model& model, std::span<const TriMesh> bones,
             const RunOptions& options, RunSummary& summary)
        : scene_(scene), model_(model), bones_(bones), options_(options), summary_(summary) {
        summary_.history.columns = history_columns(scene, model);
    }

    // A row, and a frame when it is time for one.
    void record(const Simulation& simulation, int iterations) {
        summary_.history.rows.push_back(history_row(scene_, model_, simulation, iterations));
        const double every = scene_.output.every;
        const double due = static_cast<double>(frames_.size()) * every;
        if (simulation.time() >= due - kSameTime * scene_.time.step) write_frame(simulation);
        write_history(summary_.history, options_.folder / kHistoryFile);
    }
    void write_collection() const {
        std::vector<TimedFile> files;
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            files.push_back({frames_[i], frame_name(i)});
            for (std::size_t b = 0; b < bones_.size(); ++b)
                files.push_back({frames_[i], bone_name(b, i)});
        }
        write_pvd(files, options_.folder / kCollectionFile);
    }
    void save(Checkpoint& checkpoint) const {
        for (const auto& row : summary_.history.rows)
            checkpoint.reals["history"].insert(checkpoint.reals["history"].end(), row.begin(),
                                               row.end());
        checkpoint.reals["frames"] = frames_;
        checkpoint.integers["counts"] = {static_cast<std::int64_t>(summary_.history.rows.size()),
                                         static_cast<std::int64_t>(frames_.size()),
                                         summary_.steps,
                                         summary_.failed_steps,
                                         summary_.iterations,
                                         summary_.linear_iterations,
                                         summary_.factors};
        checkpoint.reals["residual"] = {summary_.residual};
    }
    void load(const Checkpoint& checkpoint) {
        const auto& counts = checkpoint.integers_of("counts", 7);
        const std::size_t width = summary_.history.columns.size();
        const auto rows = static_cast<std::size_t>(counts[0]);
        const std::vector<double>& history = checkpoint.reals_of("history", rows * width);
        for (std::size_t r = 0; r < rows; ++r)
            summary_.history.rows.emplace_back(
                history.begin() + static_cast<std::ptrdiff_t>(r * width),
                history.begin() + static_cast<std::ptrdiff_t>((r + 1) * width));
        frames_ = checkpoint.reals_of("frames", static_cast<std::size_t>(counts[1]));
        summary_.steps = static_cast<int>(counts[2]);
        summary_.failed_steps = static_cast<int>(counts[3]);
        summary_.iterations = static_cast<int>(counts[4]);
        summary_.linear_iterations = static_cast<int>(counts[5]);
        summary_.factors = static_cast<int>(counts[6]);
        summary_.residual = checkpoint.reals_of("residual", 1)[0];
    }
    void list_files() {
        summary_.frames = frames_.size();
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            summary_.files.push_back(frame_name(i));
            for (std::size_t b = 0; b < bones_.size(); ++b)
                summary_.files.push_back(bone_name(b, i));
        }
        if (summary_.history.rows.empty()) return;  // no equilibrium at the start
        for (const char* name : {kCollectionFile, kHistoryFile, kCheckpointFile})
            summary_.files.emplace_back(name);
    }

private:
    static std::string number(std::size_t frame) {
        const std::string digits = std::to_string(frame);
        return std::string(digits.size() < kDigits ? kDigits - digits.size() : 0, '0') + digits;
    }
    static fs::path frame_name(std::size_t frame) {
        return fs::path("frames") / ("frame_" + number(frame) + ".vtu");
    }
    [[nodiscard]] fs::path bone_name(std::size_t bone, std::size_t frame) const {
        return fs::path("bones") / (scene_.bones[bone].name + "_" + number(frame) + ".vtp");
    }
    void write_frame(const Simulation& simulation) {
        const std::size_t number = frames_.size();
        const Moment frame = make_frame(model_, simulation);
        meshfiles::write_vtu(frame.mesh, frame.names, frame.arrays,
                             options_.folder / frame_name(number));
        std::vector<TriMesh> moved(bones_.begin(), bones_.end());
        for (std::size_t b = 0; b < moved.size(); ++b) {
            const Pose pose = pose_at(scene_.bones[b].motion, simulation.time());
            for (Vec3& p : moved[b].points) p = pose(p);
            meshfiles::write_vtp(moved[b], {}, options_.folder / bone_name(b, number));
        }
        frames_.push_back(simulation.time());
        write_collection();
        if (options_.watch) options_.watch(frame, moved, number);
    }

    const Scene& scene_;
    const Model& model_;
    std::span<const TriMesh> bones_;
    const RunOptions& options_;
    RunSummary& summary_;
    std::vector<double> frames_;  // their times
};

void make_folders(const RunOptions& options, bool bones) {
    std::error_code failed;
    fs::create_directories(options.folder / "frames", failed);
    if (!failed && bones) fs::create_directories(options.folder / "bones", failed);
    if (failed)
        throw IoError(options.folder.string() + ": cannot make the folder: " + failed.message());
}

void add(const StepSummary& step, RunSummary& summary) {
    summary.steps += step.steps;
    summary.failed_steps += step.failed_steps;
    summary.iterations += step.iterations;
    summary.linear_iterations += step.linear_iterations;
    summary.factors += step.factors;
    summary.residual = std::max(summary.residual, step.residual);
}

SolveOptions with_stop(SolveOptions solve, const ProgressSink& progress) {
    solve.equilibrium.stop = [&progress] { return progress.interrupted(); };
    return solve;
}

class Runner {
public:
    Runner(const Scene& scene, Model& model, std::span<const TriMesh> bones,
           const RunOptions& options, ProgressSink& progress)
        : scene_(scene),
          options_(options),
          progress_(progress),
          simulation_(scene, model, with_stop(options.solve, progress)),
          recorder_(scene, model, bones, options, summary_),
          with_bones_(!bones.empty()),
          fingerprint_(model.fingerprint),
          steps_(scene_steps(scene.time)) {
        summary_.architecture = architecture(scene, model);
    }

    RunSummary run() {
        // What cannot be resumed leaves no folder.
        const int resumed = options_.resume ? resume() : 0;
        make_folders(options_, with_bones_);
        const int first = options_.resume ? resumed : start();
        for (int i = first; first > 0 && i <= steps_; ++i) {
            tell(i - 1);
            const StepSummary step = simulation_.advance(scene_time(scene_.time, i));
            if (step.stopped) {
                summary_.message = "stopped at " + rounded(simulation_.time()) + " s";
                summary_.interrupted = true;
                write_checkpoint(i - 1);
                break;
            }
            add(step, summary_);
            if (!step.converged) {
                summary_.message = step.message;
                break;
            }
            recorder_.record(simulation_, step.iterations);
            if (i % options_.checkpoint_every == 0 || i == steps_) write_checkpoint(i);
            summary_.completed = i == steps_;
        }
        if (summary_.completed) summary_.message = "the end was reached";
        summary_.reached = simulation_.time();
        recorder_.list_files();
        return std::move(summary_);
    }

private:
    void tell(int done) { progress_.report("contracting", static_cast<double>(done) / steps_); }
    // The number of the first step, 0 when there is nothing to go on from.
    int start() {
        remove_numbered(options_.folder / "frames", ".vtu");
        remove_numbered(options_.folder / "bones", ".vtp");
        std::error_code none;
        fs::remove(options_.folder / kCheckpointFile, none);
        const StepSummary step = simulation_.begin();
        add(step, summary_);
        summary_.interrupted = step.stopped;
        summary_.message = "no equilibrium at the start: " + step.message;
        if (!step.converged) return 0;
        recorder_.record(simulation_, step.iterations);
        write_checkpoint(0);
        return 1;
    }
    int resume() {
        const fs::path file = options_.folder / kCheckpointFile;
        if (!fs::exists(file))
            throw InputError(file.string() +
                             " is not there, so that nothing can be resumed; run without --resume");
        const Checkpoint checkpoint = read_checkpoint(file, fingerprint_);
        recorder_.load(checkpoint);
        simulation_.load(checkpoint);
        summary_.resumed_from = checkpoint.time;
        summary_.resumable = true;
        const int done = static_cast<int>(checkpoint.integers_of("step", 1)[0]);
        summary_.completed = done == steps_;
        progress_.note("going on from " + rounded(checkpoint.time) + " s");
        return done + 1;
    }
    void write_checkpoint(int step) {
        summary_.resumable = true;
        Checkpoint checkpoint{.fingerprint = fingerprint_};
        simulation_.save(checkpoint);
        recorder_.save(checkpoint);
        checkpoint.integers["step"] = {step};
        contraction::write_checkpoint(checkpoint, options_.folder / kCheckpointFile);
    }

    const Scene& scene_;
    const RunOptions& options_;
    ProgressSink& progress_;
    RunSummary summary_;
    Simulation simulation_;
    Recorder recorder_;
    bool with_bones_;
    std::string fingerprint_;
    int steps_;
};

}  // namespace

void remove_numbered(const fs::path& folder, const std::string& extension) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        const std::string stem = entry.path().stem().string();
        const std::size_t last = stem.find_last_not_of("0123456789");
        const bool numbered =
            last != std::string::npos && stem[last] == '_' && stem.size() - last > kDigits;
        if (numbered && entry.path().extension() == extension) fs::remove(entry.path(), none);
    }
}

RunSummary run_scene(const Scene& scene, Model& model, std::span<const TriMesh> bones,
                     const RunOptions& options, ProgressSink& progress) {
    return Runner(scene, model, bones, options, progress).run();
}

}  // namespace myotet::contraction
