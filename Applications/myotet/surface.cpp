// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "CommandLine.h"
#include "Commands.h"
#include "Console.h"
#include "SurfaceJob.h"

namespace myotet::app {
namespace {

struct Arguments {
    SurfaceJobOptions job;
    Talk talk;
};

void add_shape_options(CLI::App& command, SurfaceJobOptions& job) {
    command
        .add_option("--edge-length", job.edge_length,
                    "edge length where the surface is flat enough, mm (default: as myotet mesh; "
                    "of a mesh: its own; of a level set: two of its samples)")
        ->check(kPositive)
        ->type_name("MM");
    command
        .add_option("--smallest-edge-length", job.smallest_edge_length,
                    "how short edges may get where the surface bends, mm (default: a quarter of "
                    "the edge length, but half the level sets' spacing at least)")
        ->check(kPositive)
        ->type_name("MM");
    command
        .add_option("--trim", job.trim,
                    "discard what lies inside this solid: a closed surface, a mesh or a level set "
                    "(file), a tissue of the scan or of --repair's recipe (name or value), or "
                    "x,y,z,nx,ny,nz, all behind the plane through (x,y,z) whose normal (nx,ny,nz) "
                    "points to what is kept")
        ->type_name("SOLID");
    command.add_option("--trim-offset", job.trim_offset, "grow the trimming solid by this, mm")
        ->type_name("MM");
    command
        .add_option("--pieces", job.pieces,
                    "keep only this many pieces, the largest, of what trimming leaves of each "
                    "connected part (default: all)")
        ->check(CLI::Range(1, 1 << 30))
        ->type_name("N");
}

void add_options(CLI::App& command, Arguments& a) {
    add_scan_options(command, a.job.scan);
    command.get_option("INPUT")->description(
        "labels (.nii .nii.gz .nrrd .seg.nrrd .mha .mhd, DICOM SEG .dcm), a closed surface (.obj "
        ".off .stl .ply .vtp), a tetrahedral mesh (.vtu .msh .feb .inp .bdf .nas .xdmf .mesh) or a "
        "level set (.vdb)");
    command.add_option("-o,--output", a.job.output, "folder for the results")
        ->required()
        ->type_name("FOLDER");
    add_level_set_options(command, a.job.level_sets);
    add_shape_options(command, a.job);
    command
        .add_option("--spacing", a.job.level_sets.spacing,
                    "distance between samples of the level sets, mm (default: from the voxels)")
        ->check(kPositive)
        ->type_name("MM");
    command.add_option("--format", a.job.format, "format of the surfaces")
        ->check(CLI::IsMember({"stl", "ply", "obj", "vtp", "vtk"}))
        ->capture_default_str();
    add_threads_option(command, a.job.threads);
    add_talk_options(command, a.talk);
}

ExitCode run(const Arguments& a) {
    const Verbosity verbosity = a.talk.verbosity();
    set_up_log(verbosity);
    SurfaceReport report;
    {
        ConsoleProgress progress(verbosity);
        report = run_surface_job(a.job, progress);
    }
    std::cout << (a.talk.json ? to_json(report) : to_table(report)) << std::flush;
    ExitCode code = ExitCode::done;
    for (const SurfaceTissue& tissue : report.tissues)
        for (const std::string& sentence : tissue.broken_promises) {
            log_error("label " + std::to_string(tissue.tissue.label) + ": " + sentence);
            code = ExitCode::broken_promise;
        }
    log_info("results are in " + a.job.output.string());
    return code;
}

}  // namespace

void add_surface(CLI::App& program, ExitCode& code) {
    CLI::App* command = program.add_subcommand(
        "surface",
        "well-shaped triangle meshes of a scan's tissues, a closed surface, a tetrahedral mesh or "
        "a level set, trimmed where asked");
    const auto arguments = std::make_shared<Arguments>();
    add_options(*command, *arguments);
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace myotet::app
