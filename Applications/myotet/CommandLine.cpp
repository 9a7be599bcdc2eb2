// SPDX-License-Identifier: Apache-2.0
#include "CommandLine.h"

#include <map>

namespace myotet::app {

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
        ->transform(CLI::CheckedTransformer(orientations))
        ->type_name("FORM");
    command.add_flag("--one-hot", options.one_hot,
                     "a 4D file holds a volume of 0 and 1 for each label");
}

}  // namespace myotet::app
