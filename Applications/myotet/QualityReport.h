// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "MeshFiles/NamedMesh.h"
#include "MeshReport.h"

namespace myotet::app {

/// What there is to say of one face set of a surface.
struct FacesReport {
    std::string name;
    std::size_t vertices = 0, triangles = 0;
    quality::SurfaceShape shape;
    std::vector<std::string> broken_promises;  ///< empty: a manifold, with or without boundary
};

/// What there is to say of a mesh that is at hand: of its tissues by label
/// value, or, where it has no tetrahedra, of its face sets; `whole` is all of
/// them together, which is no manifold where interfaces meet.
struct QualityReport {
    std::vector<TissueReport> tissues;
    std::vector<FacesReport> faces;
    FacesReport whole;
};
[[nodiscard]] QualityReport measure(const meshfiles::NamedMesh& mesh);

/// The same as JSON and as a table for people.
[[nodiscard]] std::string to_json(const std::string& file, const QualityReport& report);
[[nodiscard]] std::string to_table(const QualityReport& report);

}  // namespace myotet::app
