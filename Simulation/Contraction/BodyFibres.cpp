// SPDX-License-Identifier: Apache-2.0
#include "Contraction/BodyFibres.h"

#include <algorithm>

#include "Contraction/Words.h"
#include "Core/Errors.h"
#include "Fibres/BSplineSolid.h"
#include "Fibres/FitMuscle.h"
#include "Fibres/ImageFibres.h"
#include "Fibres/Laplace.h"
#include "Fibres/SolidFile.h"
#include "Segmentation/ReadVectors.h"

namespace myotet::contraction {
namespace {

// Nodes of one end of a muscle.
std::vector<std::int32_t> nodes_at(const Scene& scene, std::span<const HeldNodes> held, End end) {
    std::vector<std::int32_t> nodes;
    for (const HeldNodes& some : held)
        if (scene.attachments[some.attachment].end == end)
            nodes.insert(nodes.end(), some.nodes.begin(), some.nodes.end());
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

struct Ends {
    std::vector<std::int32_t> origin, insertion;
};

Ends ends_of(const Scene& scene, const Body& body, std::span<const HeldNodes> held) {
    Ends ends{nodes_at(scene, held, End::origin), nodes_at(scene, held, End::insertion)};
    if (ends.origin.empty() || ends.insertion.empty())
        refuse(scene, body.line,
               "fibres of " + body.name +
                   " run from an origin to an insertion; say of its attachments which is which "
                   "('end: origin', 'end: insertion')");
    return ends;
}

fibres::FibreField from_solid(const Scene& scene, const Body& body, const TetMesh& mesh,
                              std::span<const HeldNodes> held) {
    if (!body.fibres.file.empty())
        return fibres::solid_fibres(mesh, fibres::read_solid(body.fibres.file));
    const Ends ends = ends_of(scene, body, held);
    const fibres::MuscleFit fit = fibres::fit_muscle(mesh, ends.origin, ends.insertion);
    fibres::FibreField field = fibres::solid_fibres(mesh, fit.solid);
    field.notes.push_back("the fitted B-spline solid lies " + shown(fit.mean_distance) +
                          " mm from the surface in the mean, " + shown(fit.max_distance) +
                          " mm at most");
    field.notes.insert(field.notes.end(), fit.notes.begin(), fit.notes.end());
    return field;
}

fibres::FibreField from_image(const Scene& scene, const Body& body, const TetMesh& mesh,
                              std::span<const HeldNodes> held) {
    const segmentation::VectorVolume read = segmentation::read_vectors(body.fibres.file);
    fibres::VectorImage image;
    image.size = read.size;
    image.index_to_lps = read.index_to_lps;
    image.vectors = read.vectors;
    fibres::ImageOptions options{nodes_at(scene, held, End::origin),
                                 nodes_at(scene, held, End::insertion)};
    if (options.origin_nodes.empty() || options.insertion_nodes.empty()) options = {};
    return fibres::image_fibres(mesh, image, options);
}

fibres::FibreField field_of(const Scene& scene, const Body& body, const TetMesh& mesh,
                            std::span<const HeldNodes> held) {
    switch (body.fibres.from) {
        case FibreSource::none:
            return {};
        case FibreSource::constant:
            return fibres::constant_fibres(mesh, body.fibres.direction);
        case FibreSource::bspline:
            return from_solid(scene, body, mesh, held);
        case FibreSource::image:
            return from_image(scene, body, mesh, held);
        case FibreSource::laplace:
            break;
    }
    const Ends ends = ends_of(scene, body, held);
    fibres::LaplaceOptions options;
    options.pennation.angle_deg = body.fibres.pennation_deg;
    return fibres::laplace_fibres(mesh, ends.origin, ends.insertion, options);
}

}  // namespace

std::vector<Vec3> find_fibres(const Scene& scene, const Body& body, const TetMesh& mesh,
                              std::span<const HeldNodes> held, std::vector<std::string>& notes) {
    try {
        fibres::FibreField field = field_of(scene, body, mesh, held);
        notes.insert(notes.end(), field.notes.begin(), field.notes.end());
        return std::move(field.direction);
    } catch (const MeshError& error) {
        refuse(scene, body.line, "fibres of " + body.name + ": " + error.what());
    }
}

}  // namespace myotet::contraction
