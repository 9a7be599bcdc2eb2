// SPDX-License-Identifier: Apache-2.0
#include "InputKind.h"

#include <algorithm>
#include <cctype>

#include "ExitCodes.h"
#include "MeshFiles/MeshFiles.h"
#include "Segmentation/ReadLabels.h"

namespace myotet::app {

InputKind kind_of(const std::filesystem::path& file) {
    if (segmentation::is_label_file(file)) return InputKind::labels;
    if (meshfiles::is_surface_file(file)) return InputKind::surface;
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return std::tolower(c); });
    if (extension == ".vdb") return InputKind::level_set;
    const bool holds = std::ranges::any_of(meshfiles::formats(), [&](const auto& format) {
        return format.extension == extension && format.holds == meshfiles::Holds::tetrahedra;
    });
    return holds ? InputKind::tetrahedra : InputKind::unknown;
}

std::vector<std::string> label_options_given(const ScanOptions& options) {
    std::vector<std::string> given;
    if (!options.labels.empty()) given.emplace_back("--labels");
    if (!options.reading.names.empty()) given.emplace_back("--names");
    if (options.reading.orientation != segmentation::Orientation::agreed)
        given.emplace_back("--orientation");
    if (options.reading.one_hot) given.emplace_back("--one-hot");
    if (options.close_gaps > 0) given.emplace_back("--close-gaps");
    return given;
}

void refuse_options(const std::vector<std::string>& options, const std::filesystem::path& file,
                    const std::string& what) {
    if (options.empty()) return;
    std::string list;
    for (std::size_t i = 0; i < options.size(); ++i)
        list += (i == 0 ? "" : i + 1 == options.size() ? " and " : ", ") + options[i];
    throw UsageError(list + ": " + file.string() + " is " + what + "; leave the option" +
                     (options.size() > 1 ? "s" : "") + " out");
}

}  // namespace myotet::app
