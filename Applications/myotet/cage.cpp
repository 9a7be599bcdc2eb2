// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "CageJob.h"
#include "CommandLine.h"
#include "Commands.h"
#include "Console.h"

namespace myotet::app {
namespace {

struct Arguments {
    CageJobOptions job;
    Talk talk;
};

void add_cage_options(CLI::App& command, cage::Options& cage) {
    CLI::Option* cell = command
                            .add_option("--cell", cage.cell,
                                        "width of the lattice's cells, mm (default: by --tets)")
                            ->check(kPositive)
                            ->type_name("MM");
    command.add_option("--tets", cage.tets, "choose cells for about this many tetrahedra")
        ->check(CLI::Range(std::int64_t{24}, std::int64_t{1} << 30))
        ->excludes(cell)
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option("--offset-ratio", cage.offset_ratio,
                    "boundary nodes end within this part of a cell of the surface; smaller is "
                    "closer, with worse shapes")
        ->check(kPositive)
        ->type_name("R")
        ->capture_default_str();
    command
        .add_option("--angle", cage.angle_deg,
                    "smallest dihedral angle to be content with, degrees; what is left goes into "
                    "a closer fit")
        ->check(CLI::Range(1.0, 60.0))
        ->type_name("DEG")
        ->capture_default_str();
    command
        .add_option("--max-angle", cage.max_angle_deg,
                    "largest dihedral angle to be content with, degrees (default: 180 less "
                    "1/0.7 of --angle)")
        ->check(CLI::Range(90.0, 179.0))
        ->type_name("DEG");
    command
        .add_option("--max-aspect-ratio", cage.max_aspect_ratio,
                    "longest edge by shortest altitude to be content with (default: 105 over "
                    "--angle)")
        ->check(CLI::Range(1.5, 1000.0))
        ->type_name("RATIO");
    command
        .add_option("--tries", cage.tries,
                    "lattices to try, the first as it is, the others turned and shifted; the best "
                    "is taken, also when stopped (Ctrl-C) before all are done")
        ->check(CLI::Range(1, 1 << 20))
        ->type_name("N")
        ->capture_default_str();
    command.add_option("--seed", cage.seed, "of turns and shifts")
        ->type_name("S")
        ->capture_default_str();
}

void add_options(CLI::App& command, Arguments& a) {
    SurfaceJobOptions& source = a.job.source;
    add_scan_options(command, source.scan);
    command.get_option("INPUT")->description(
        "a closed surface (.obj .off .stl .ply .vtp), labels (.nii .nii.gz .nrrd .seg.nrrd .mha "
        ".mhd, DICOM SEG .dcm), a level set (.vdb) or a tetrahedral mesh (.vtu .msh .feb .inp .bdf "
        ".nas .xdmf .mesh)");
    command.add_option("-o,--output", source.output, "folder for the results")
        ->required()
        ->type_name("FOLDER");
    add_cage_options(command, a.job.cage);
    command.add_flag("--write-unreached", a.job.write_unreached,
                     "write the best cage even when some of its boundary nodes stay farther from "
                     "the surface than asked");
    command
        .add_option("--format", a.job.formats,
                    "formats of the cage: vtu, msh, feb, inp, bdf, nas, xdmf, mesh (default: vtu)")
        ->delimiter(',')
        ->check(CLI::IsMember({"vtu", "msh", "feb", "inp", "bdf", "nas", "xdmf", "mesh"}))
        ->type_name("LIST");
    add_level_set_options(command, source.level_sets);
    command
        .add_option("--spacing", source.level_sets.spacing,
                    "distance between samples of the level sets, mm (default: from the voxels)")
        ->check(kPositive)
        ->type_name("MM");
    add_threads_option(command, source.threads);
    add_talk_options(command, a.talk);
}

ExitCode run(const Arguments& a) {
    const Verbosity verbosity = a.talk.verbosity();
    set_up_log(verbosity);
    CageReport report;
    {
        ConsoleProgress progress(verbosity);
        report = run_cage_job(a.job, progress);
    }
    std::cout << (a.talk.json ? to_json(report) : to_table(report)) << std::flush;
    ExitCode code = report.stopped ? ExitCode::interrupted : ExitCode::done;
    for (const CageTissue& tissue : report.tissues) {
        const std::string who = "label " + std::to_string(tissue.tissue.label) + ": ";
        if (!tissue.cage.reached()) {
            log_error(who + "the offset was not reached; " +
                      (a.job.write_unreached
                           ? "the best cage was written all the same"
                           : "nothing was written, ask for the best cage by --write-unreached"));
            code = ExitCode::not_converged;
        }
        for (const std::string& sentence : tissue.broken_promises) {
            log_error(who + sentence);
            code = ExitCode::broken_promise;
        }
    }
    log_info("results are in " + a.job.source.output.string());
    return code;
}

}  // namespace

void add_cage(CLI::App& program, ExitCode& code) {
    CLI::App* command = program.add_subcommand(
        "cage",
        "coarse tetrahedral meshes that enclose a surface and stay close to it, and where its "
        "points lie in them");
    const auto arguments = std::make_shared<Arguments>();
    add_options(*command, *arguments);
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace myotet::app
