// SPDX-License-Identifier: Apache-2.0
#include "CommandLine.h"

#include <map>

namespace myotet::app {

void add_talk_options(CLI::App& command, Talk& talk) {
    command.add_flag("--json", talk.json, "print report.json instead of the table");
    auto* quiet = command.add_flag("--quiet", talk.quiet, "say nothing but errors and the result");
    command.add_flag("--verbose", talk.verbose, "say more about what is done")->excludes(quiet);
}

void add_threads_option(CLI::App& command, int& threads) {
    command.add_option("--threads", threads, "threads to use (default: all there are)")
        ->check(CLI::Range(1, 4096))
        ->type_name("N");
}

void add_no_flag(CLI::App& command, const std::string& name, bool& wanted,
                 const std::string& what) {
    command.add_flag_callback(
        name, [&wanted] { wanted = false; }, what);
}

void add_read_options(CLI::App& command, segmentation::ReadOptions& options) {
    using segmentation::Orientation;
    static const std::map<std::string, Orientation> orientations = {{"sform", Orientation::sform},
                                                                    {"qform", Orientation::qform}};
    command
        .add_option("--names", options.names,
                    "table of label names (default: looked for in and beside the input)")
        ->type_name("TABLE");
    command
        .add_option("--orientation", options.orientation,
                    "which transform of a NIfTI file places its voxels: sform or qform "
                    "(default: the sform, refused where they disagree)")
        ->transform(one_of(orientations))
        ->type_name("FORM");
    command.add_flag("--one-hot", options.one_hot,
                     "a 4D file holds a volume of 0 and 1 for each label");
}

void add_scan_options(CLI::App& command, ScanOptions& options) {
    command
        .add_option("INPUT", options.input,
                    "labels (.nii .nii.gz .nrrd .seg.nrrd .mha .mhd, DICOM SEG .dcm) or a closed "
                    "surface (.obj .off .stl .ply .vtp)")
        ->required()
        ->type_name("FILE");
    command
        .add_option("--labels", options.labels,
                    "only these, by value, name or layer:value: 3,7,biceps,1:4 (default: all "
                    "but 0)")
        ->type_name("LIST");
    add_read_options(command, options.reading);
    command
        .add_option("--close-gaps", options.close_gaps,
                    "give unlabelled slits and pockets between tissues, up to this wide, to the "
                    "nearest of them, mm (default: 0, none)")
        ->check(kNotNegative)
        ->type_name("MM");
    command
        .add_option("--input-unit", options.input_unit,
                    "what a surface file's numbers mean: mm, cm or m (default: mm)")
        ->check(CLI::IsMember({"mm", "cm", "m"}));
    command.add_flag("--heal", options.heal,
                     "close cracks and holes of a surface file by winding numbers, and say how "
                     "much was guessed (default: an open surface is refused)");
}

void add_level_set_options(CLI::App& command, LevelSetChoices& choices) {
    command
        .add_option("--smooth", choices.smooth,
                    "how far smoothing may move a sharp voxel corner, mm (default: from the "
                    "voxels; 0: none)")
        ->check(kNotNegative)
        ->type_name("MM");
    using levelset::Smoothing;
    static const std::map<std::string, Smoothing> kinds = {{"curvature", Smoothing::curvature},
                                                           {"constrained", Smoothing::constrained},
                                                           {"none", Smoothing::none}};
    command
        .add_option("--smoothing", choices.smoothing,
                    "curvature: motion by mean curvature; constrained: the same, but no voxel's "
                    "centre changes sides; none: the voxels' staircase (default: curvature)")
        ->transform(one_of(kinds))
        ->type_name("KIND");
    command
        .add_option("--repair", choices.repair,
                    "recipe (YAML) of steps that join, cut, grow or fill tissues before they "
                    "are used")
        ->type_name("RECIPE");
}

void add_page_option(CLI::App& command, bool& wanted) {
    add_no_flag(command, "--no-report", wanted,
                "make no report.html, the page that shows the results (default: it is made)");
}

}  // namespace myotet::app
