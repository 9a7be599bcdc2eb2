// SPDX-License-Identifier: Apache-2.0
#include "PressJob.h"

#include <algorithm>
#include <cmath>

#include "Contraction/Run.h"
#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Core/Sha256.h"
#include "Core/Stopwatch.h"
#include "Costs.h"
#include "Machine.h"
#include "MeshFiles/Series.h"
#include "Outputs.h"
#include "Pictures.h"
#include "PressFrames.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

constexpr const char* kSheet = "pictures/press.png";

/// What the rooms refuse, with the file that it stands in.
template <class Act>
auto of_file(const fs::path& file, const Act& act) {
    try {
        return act();
    } catch (const InputError& error) {
        throw InputError(file.string() + ": " + error.what());
    }
}

/// All that a run needs.
struct Prepared {
    PressPlan plan;
    Organ organ;
    membrane::Levels levels;
    membrane::Loads loads;
    membrane::Options options;
};

Prepared prepare(const PressJobOptions& asked, ProgressSink& progress) {
    Prepared made;
    made.plan = read_press_plan(asked.tool, data_folder() / "walls");
    OrganOptions organ = asked.organ;
    organ.hold_to = made.plan.hold.tissues;
    organ.hold_within = made.plan.hold.within;
    made.organ = find_organ(organ, progress);
    progress.check();
    made.levels = of_file(asked.organ.scan.input,
                          [&] { return membrane::make_levels(made.organ.surface, asked.levels); });
    membrane::Options& options = made.options;
    options.wall = made.plan.wall;
    if (made.organ.lumen && !made.plan.thickness_stated)
        options.wall.thickness = made.organ.lumen->thickness;
    if (!asked.shape) options.wall.shape_stiffness = 0;
    options.criteria = made.plan.criteria;
    options.levels = asked.levels;
    options.detail = asked.levels == 0 ? membrane::Detail::coarse
                     : asked.adapt     ? membrane::Detail::adaptive
                                       : membrane::Detail::refined;
    options.duration = made.plan.end;
    options.interval = made.plan.history;
    of_file(asked.tool, [&] {
        options.validate();
        made.loads = place_loads(made.plan, made.organ.surface, made.levels, made.organ.near);
        return 0;
    });
    of_file(asked.tool, [&] {
        made.loads.validate(made.levels);
        return 0;
    });
    return made;
}

/// What is written while the run goes on.
class Writing {
public:
    Writing(const Prepared& prepared, const fs::path& folder, OutputFolder& out,
            PressReport& report)
        : prepared_(prepared), folder_(folder), out_(out), report_(report) {
        auto& columns = report.history.columns;
        columns = {{"time", "s"}};
        for (const ToolPlan& tool : prepared.plan.tools) {
            columns.push_back({tool.name + "_force", "N"});
            columns.push_back({tool.name + "_displacement", "mm"});
            for (const char* axis : {"_x", "_y", "_z"}) columns.push_back({tool.name + axis, "mm"});
        }
        for (const PatchPlan& patch : prepared.plan.patches) {
            columns.push_back({patch.name + "_force", "N"});
            columns.push_back({patch.name + "_displacement", "mm"});
        }
        columns.insert(columns.end(), {{"nodes", ""}, {"springs", ""}, {"volume", "mm^3"}});
        if (prepared.organ.lumen) columns.push_back({"lumen_volume", "mm^3"});
        columns.insert(columns.end(), {{"pressure", "MPa"},
                                       {"energy", "N mm"},
                                       {"largest_displacement", "mm"},
                                       {"mass", "t"}});
    }

    void watch(const membrane::View& view) {
        if (report_.history.rows.empty()) {
            contraction::remove_numbered(folder_ / "frames", ".vtu");
            contraction::remove_numbered(folder_ / "tools", ".vtp");
            contraction::remove_numbered(folder_ / "pictures", ".png");
        }
        add_row(view.moment);
        report_.reached = view.moment.time;
        const double rounding = 1e-9 * prepared_.plan.end;
        const double due = static_cast<double>(frames_.size()) * prepared_.plan.every;
        const bool last = view.moment.time >= prepared_.plan.end - rounding;
        if (view.moment.time >= due - rounding || last) write_frame(view);
    }

    void finish() {
        std::vector<contraction::TimedFile> files;
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            files.push_back({*frames_[i].arrays.time, frame_name(i)});
            report_.files.push_back(frame_name(i));
            for (std::size_t t = 0; t < frames_[i].tools.size(); ++t) {
                files.push_back({*frames_[i].arrays.time, tool_name(t, i)});
                report_.files.push_back(tool_name(t, i));
            }
        }
        out_.write("press.pvd", [&](const fs::path& file) { contraction::write_pvd(files, file); });
        out_.write("history.csv",
                   [&](const fs::path& file) { write_history(report_.history, file); });
        report_.files.insert(report_.files.end(), {"press.pvd", "history.csv"});
        report_.frames = frames_.size();
    }

    void draw(ProgressSink& progress) {
        PressView view = view_of(prepared_.loads);
        view.most = 0;
        for (const PressFrame& frame : frames_) {
            for (const Vec3& p : frame.surface.points) view.fit.include(p);
            view.points.insert(view.points.end(), frame.surface.points.begin(),
                               frame.surface.points.end());
            const auto& moved = frame.arrays.points[3].values;
            for (std::size_t i = 0; i < moved.size(); i += 3)
                view.most = std::max(view.most, Vec3(moved[i], moved[i + 1], moved[i + 2]).norm());
        }
        constexpr double kRoom = 1e-3, kLeastScale = 0.01;  // mm; so that flat ones have a box
        view.fit.min.array() -= kRoom;
        view.fit.max.array() += kRoom;
        view.most = std::max(view.most, kLeastScale);
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            progress.check();
            out_.write(picture_name(i), [&](const fs::path& file) {
                report::write_png(frame_picture(frames_[i], view), file);
            });
        }
        out_.write(kSheet, [&](const fs::path&) {
            for (const fs::path& file : write_contact_sheet(folder_, frames_.size(), kSheet))
                report_.files.push_back(file.generic_string());
        });
    }

private:
    const Prepared& prepared_;
    const fs::path& folder_;
    OutputFolder& out_;
    PressReport& report_;
    std::vector<PressFrame> frames_;

    static std::string numbered(const std::string& stem, std::size_t number, const char* end) {
        return stem + "_" + meshfiles::frame_digits(number) + end;
    }
    static std::string frame_name(std::size_t number) {
        return numbered("frames/frame", number, ".vtu");
    }
    static std::string picture_name(std::size_t number) {
        return numbered("pictures/frame", number, ".png");
    }
    [[nodiscard]] std::string tool_name(std::size_t tool, std::size_t number) const {
        return numbered("tools/" + prepared_.plan.tools[tool].name, number, ".vtp");
    }

    void add_row(const membrane::Moment& m) {
        std::vector<double> row{m.time};
        for (const membrane::Touch& touch : m.tools)
            row.insert(row.end(), {touch.force.norm(), touch.displacement, touch.place.x(),
                                   touch.place.y(), touch.place.z()});
        for (std::size_t p = 0; p < m.patch_displacement.size(); ++p) {
            const membrane::PatchForce& patch = prepared_.loads.patches[p];
            row.push_back(membrane::strength_at(patch, m.time) * patch.force.norm());
            row.push_back(m.patch_displacement[p]);
        }
        row.insert(row.end(),
                   {static_cast<double>(m.nodes), static_cast<double>(m.springs), m.volume});
        if (report_.history.rows.empty()) start_volume_ = m.volume;
        // The wall itself keeps its volume.
        if (prepared_.organ.lumen)
            row.push_back(prepared_.organ.lumen->volume + m.volume - start_volume_);
        row.insert(row.end(), {m.pressure, m.energy, m.largest_displacement, m.mass});
        report_.history.rows.push_back(std::move(row));
    }

    void write_frame(const membrane::View& view) {
        const std::size_t number = frames_.size();
        PressFrame frame = frame_of(view, prepared_.organ.label);
        out_.write(frame_name(number), [&](const fs::path& file) {
            meshfiles::write_vtu(frame.surface, {{prepared_.organ.label, prepared_.organ.name}},
                                 frame.arrays, file);
        });
        for (std::size_t t = 0; t < frame.tools.size(); ++t)
            out_.write(tool_name(t, number), [&](const fs::path& file) {
                meshfiles::write_vtp(frame.tools[t], {}, file);
            });
        frames_.push_back(std::move(frame));
    }

    double start_volume_ = 0;
};

PressReport describe(const PressJobOptions& asked, const Prepared& made) {
    PressReport report;
    report.input = asked.organ.scan.input.string();
    report.input_sha256 = made.organ.scan.sha256;
    report.tool = asked.tool.string();
    report.tool_sha256 = sha256_of_file(asked.tool);
    report.output = asked.output.string();
    report.title = made.plan.title;
    report.name = made.organ.name;
    report.label = made.organ.label;
    report.adapt = asked.adapt;
    report.shape = asked.shape;
    report.levels = asked.levels;
    report.threads = thread_count();
    report.edge_length = made.organ.edge_length;
    report.area = membrane::area(made.organ.surface);
    report.end = made.plan.end;
    report.held = made.loads.held.size();
    for (const membrane::HalfEdges& mesh : made.levels.meshes) {
        report.nodes_of_level.push_back(static_cast<std::size_t>(mesh.vertex_count));
        report.springs_of_level.push_back(mesh.edges.size());
    }
    report.wall = made.options.wall;
    report.thickness_measured = made.organ.lumen && !made.plan.thickness_stated;
    report.material = made.plan.material;
    report.lumen = made.organ.lumen;
    report.notes = made.organ.notes;
    report.warnings = made.organ.scan.warnings;
    return report;
}

}  // namespace

PressReport run_press_job(const PressJobOptions& options, ProgressSink& progress) {
    const ThreadLimit limit(options.threads);
    OutputFolder out(options.output);
    Stopwatch watch;
    progress.report("organ", 0);
    Prepared prepared = prepare(options, progress);
    PressReport report = describe(options, prepared);
    for (const std::string& note : report.notes) progress.note(note);
    report.seconds["organ"] = watch.lap();

    Writing writing(prepared, options.output, out, report);
    const membrane::Result result = of_file(options.tool, [&] {
        return membrane::simulate(std::move(prepared.levels), prepared.options, prepared.loads,
                                  progress,
                                  [&](const membrane::View& view) { writing.watch(view); });
    });
    writing.finish();
    report.status = result.status;
    report.message = result.message;
    report.steps = result.steps;
    report.evaluations = result.evaluations;
    report.rejected = result.rejected;
    report.switches = result.switches;
    report.switched_energy = result.switched_energy;
    report.seconds["press"] = watch.lap();
    if (options.pictures) writing.draw(progress);
    report.seconds["pictures"] = watch.lap();
    note_costs(report);
    write_report(out, report);
    out.keep();
    return report;
}

}  // namespace myotet::app
