// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "Core/TetMesh.h"
#include "Quality/Quality.h"
#include "RunFacts.h"

namespace myotet::app {

/// What the report says about one tissue.
struct TissueReport {
    int layer = 0;
    std::int32_t label = 0;
    std::string name;
    std::int64_t voxels = 0;
    std::optional<levelset::SmoothingReport> smoothing;  ///< of labels
    int components_in = 0, components_out = 0;
    double volume_labels = 0, volume_mesh = 0;  ///< mm^3
    std::size_t vertices = 0, tets = 0;
    double edge_length_asked = 0;  ///< mm
    quality::EdgeLengths surface_edges;
    quality::ShapeSummary shapes;
    quality::Topology topology;
    quality::SurfaceDistance distance;
    std::map<std::string, double> seconds;     ///< by stage
    std::vector<std::string> notes;            ///< what the user should know
    std::vector<std::string> broken_promises;  ///< empty: the mesh is good and was written
    std::vector<std::string> files;
};

/// What the report says about the whole run.
struct RunReport {
    RunFacts run;
    std::vector<TissueReport> tissues;  ///< by layer and label value
};

/// Fills in all that the mesh itself tells: counts, shapes, topology, edges.
void measure(const TetMesh& mesh, TissueReport& report);

/// A sentence for each promise about shapes and topology that does not hold.
[[nodiscard]] std::vector<std::string> broken_promises(const quality::ShapeSummary& shapes,
                                                       const quality::Topology& topology);

/// Measures each label of a mesh that is at hand, by label value.
[[nodiscard]] std::vector<TissueReport> measure_tissues(const TetMesh& mesh);

}  // namespace myotet::app
