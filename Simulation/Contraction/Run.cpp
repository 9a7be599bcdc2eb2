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

// What the run has written, and how it goes on.
class Recorder {
public:
    Recorder(const Scene& scene, const Model& model, std::span<const TriMesh> bones,
             const RunOptions& options, RunSummary& summary)
        : scene_(scene),
          model_(model),
          bones_(bones),
          options_(options),
          summary_(summary),
          files_(files_of(scene, model, options, bones.size())) {
        summary_.history.columns = history_columns(scene, model);
    }

    // Of a run that begins anew.
    void clear() const { files_.clear(); }
    void make_folders() const { files_.make_folders(); }

    // A row, and a frame when it is time for one.
    void record(const Simulation& simulation, int iterations) {
        summary_.history.rows.push_back(history_row(scene_, model_, simulation, iterations));
        const double every = scene_.output.every;
        const double due = static_cast<double>(frames_.size()) * every;
        if (simulation.time() >= due - kSameTime * scene_.time.step) write_frame(simulation);
        write_history(summary_.history, options_.folder / kHistoryFile);
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
    // The frames are all that there will be for now.
    void finish(const Simulation& simulation) {
        summary_.frames = frames_.size();
        if (summary_.history.rows.empty()) return;  // no equilibrium at the start
        files_.gather(make_frame(model_, simulation), bones_, frames_, summary_.completed);
        list_files();
    }
    void list_files() {
        summary_.frames = frames_.size();
        for (fs::path& file : files_.files(frames_.size()))
            summary_.files.push_back(std::move(file));
        for (const char* name : {kHistoryFile, kCheckpointFile}) summary_.files.emplace_back(name);
    }

private:
    static FrameFiles files_of(const Scene& scene, const Model& model, const RunOptions& options,
                               std::size_t bones) {
        // As many as fall due, and the first.
        const auto frames =
            static_cast<std::size_t>(scene.time.end / scene.output.every + kSameTime) + 1;
        FrameFiles::Options files{.folder = options.folder,
                                  .bones = {},
                                  .series = decided(options.series, frames),
                                  .fingerprint = model.fingerprint};
        for (std::size_t b = 0; b < bones; ++b) files.bones.push_back(scene.bones[b].name);
        return FrameFiles(std::move(files));
    }
    void write_frame(const Simulation& simulation) {
        const Moment frame = make_frame(model_, simulation);
        std::vector<TriMesh> moved(bones_.begin(), bones_.end());
        for (std::size_t b = 0; b < moved.size(); ++b) {
            const Pose pose = pose_at(scene_.bones[b].motion, simulation.time());
            for (Vec3& p : moved[b].points) p = pose(p);
        }
        frames_.push_back(simulation.time());
        files_.write(frame, moved, frames_);
        if (options_.watch) options_.watch(frame, moved, frames_.size() - 1);
    }

    const Scene& scene_;
    const Model& model_;
    std::span<const TriMesh> bones_;
    const RunOptions& options_;
    RunSummary& summary_;
    FrameFiles files_;
    std::vector<double> frames_;  // their times
};

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
          fingerprint_(model.fingerprint),
          steps_(scene_steps(scene.time)) {
        summary_.architecture = architecture(scene, model);
    }

    RunSummary run() {
        // What cannot be resumed leaves no folder.
        const int resumed = options_.resume ? resume() : 0;
        const bool was_complete = summary_.completed;
        recorder_.make_folders();
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
        if (was_complete)
            recorder_.list_files();
        else
            recorder_.finish(simulation_);
        return std::move(summary_);
    }

private:
    void tell(int done) { progress_.report("contracting", static_cast<double>(done) / steps_); }
    // The number of the first step, 0 when there is nothing to go on from.
    int start() {
        recorder_.clear();
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
    std::string fingerprint_;
    int steps_;
};

}  // namespace

RunSummary run_scene(const Scene& scene, Model& model, std::span<const TriMesh> bones,
                     const RunOptions& options, ProgressSink& progress) {
    return Runner(scene, model, bones, options, progress).run();
}

}  // namespace myotet::contraction
