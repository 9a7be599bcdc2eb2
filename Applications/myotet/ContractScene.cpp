// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iterator>

#include "ContractFrames.h"
#include "Core/Errors.h"
#include "Core/Text.h"
#include "Report/ColourMap.h"
#include "Report/Decimate.h"
#include "Text.h"
#include "ViewerScenes.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

using report::ViewedBody;
using report::ViewedQuantity;
using report::ViewedScene;
using report::ViewedValues;

constexpr std::size_t kMostMoments = 60;
constexpr double kMostBytes = 2.4e7;               // of all moments before they are packed
constexpr std::size_t kMostBoneTriangles = 20000;  // of one bone
constexpr double kQuantile = 0.99;                 // the last colour begins here
constexpr report::Colour kBone{0.9, 0.86, 0.74};
constexpr std::size_t kActivation = 0, kStretch = 1, kStress = 2;

// sqrt(3/2 s : s), s the deviator of the stress (R. von Mises 1913).
double mises_stress(const double* stress) {
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> sigma(stress);
    const Mat3 deviator = sigma - sigma.trace() / 3 * Mat3::Identity();
    return std::sqrt(1.5 * deviator.squaredNorm());
}

// The tetrahedra and nodes of one body of a frame.
struct Part {
    std::vector<std::int32_t> tets, points;
};

std::vector<Part> parts_of(const TetMesh& mesh, const std::vector<double>& body, std::size_t bodies,
                           const fs::path& folder) {
    if (body.size() != mesh.tets.size())
        throw InputError(folder.string() +
                         ": the first frame has not a body a tetrahedron; make "
                         "the results again");
    std::vector<Part> parts(bodies);
    std::vector<std::vector<char>> used(bodies, std::vector<char>(mesh.points.size(), 0));
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const double b = body[t];
        if (!(b >= 0 && b < static_cast<double>(bodies)))
            throw InputError(folder.string() + ": tetrahedron " + std::to_string(t) +
                             " of the frames is of a body that report.json does not name; make "
                             "the results again");
        parts[static_cast<std::size_t>(b)].tets.push_back(static_cast<std::int32_t>(t));
        for (const std::int32_t n : mesh.tets[t]) used[static_cast<std::size_t>(b)][n] = 1;
    }
    for (std::size_t b = 0; b < bodies; ++b)
        for (std::size_t n = 0; n < mesh.points.size(); ++n)
            if (used[b][n]) parts[b].points.push_back(static_cast<std::int32_t>(n));
    return parts;
}

TetMesh mesh_of(const TetMesh& whole, const Part& part) {
    TetMesh mesh;
    std::vector<std::int32_t> now(whole.points.size(), -1);
    for (const std::int32_t n : part.points) {
        now[n] = static_cast<std::int32_t>(mesh.points.size());
        mesh.points.push_back(whole.points[n]);
    }
    for (const std::int32_t t : part.tets) {
        Tet corners = whole.tets[t];
        for (std::int32_t& corner : corners) corner = now[corner];
        mesh.tets.push_back(corners);
    }
    return mesh;
}

// Frames are of one mesh, unless a file was changed.
void require_same_mesh(const ContractFrame& frame, const TetMesh& mesh, const fs::path& folder) {
    const std::size_t tets = mesh.tets.size();
    if (frame.points.size() != mesh.points.size() || frame.body.size() != tets ||
        frame.activation.size() != tets || frame.stretch.size() != tets ||
        frame.fibre.size() != 3 * tets || frame.stress.size() != 9 * tets)
        throw InputError(folder.string() + ": the frame at " + shown(frame.time) +
                         " s has another mesh than the first one; make the results again");
}

// What of a frame concerns one body.
void add_moment(const ContractFrame& frame, const Part& part, ViewedBody& body) {
    std::vector<Vec3> points, fibres;
    for (const std::int32_t n : part.points) points.push_back(frame.points[n]);
    std::vector<double> activations, stretches, stresses;
    for (const std::int32_t t : part.tets) {
        const double* fibre = &frame.fibre[3 * static_cast<std::size_t>(t)];
        fibres.emplace_back(fibre[0], fibre[1], fibre[2]);
        const bool fibred = fibres.back() != Vec3::Zero();
        activations.push_back(fibred ? frame.activation[t] : NAN);
        stretches.push_back(fibred ? frame.stretch[t] : NAN);
        stresses.push_back(mises_stress(&frame.stress[9 * static_cast<std::size_t>(t)]));
    }
    body.moments.push_back(std::move(points));
    body.fibres.push_back(std::move(fibres));
    body.values[kActivation].times.push_back(std::move(activations));
    body.values[kStretch].times.push_back(std::move(stretches));
    body.values[kStress].times.push_back(std::move(stresses));
}

// Every so many of the frames, and the last.
std::vector<std::size_t> chosen_frames(std::size_t count, const TetMesh& mesh) {
    const double bytes =
        6.0 * static_cast<double>(mesh.points.size()) + 3.0 * static_cast<double>(mesh.tets.size());
    const double most = std::clamp(kMostBytes / bytes, 2.0, static_cast<double>(kMostMoments));
    const auto step = static_cast<std::size_t>(std::ceil(static_cast<double>(count) / most));
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < count; i += step) chosen.push_back(i);
    if (chosen.back() + 1 != count) chosen.push_back(count - 1);
    return chosen;
}

// The surface at rest, moved as its points move from frame to frame; false: they are not the
// same points.
bool add_bone(const std::string& name, const ContractFrames& frames,
              const std::vector<std::size_t>& chosen, ViewedScene& scene) {
    using Columns = Eigen::Matrix3Xd;
    const auto columns = [](const std::vector<Vec3>& points) {
        Columns made(3, static_cast<Eigen::Index>(points.size()));
        for (std::size_t p = 0; p < points.size(); ++p)
            made.col(static_cast<Eigen::Index>(p)) = points[p];
        return made;
    };
    ViewedBody bone{.name = name, .colour = kBone};
    Columns rest;
    for (const std::size_t frame : chosen) {
        const TriMesh surface = frames.bone(name, frame);
        if (surface.points.empty()) return false;
        const Columns now = columns(surface.points);
        if (bone.moments.empty()) {
            rest = now;
            bone.surface = report::decimated(surface, kMostBoneTriangles);
        }
        if (now.cols() != rest.cols()) return false;
        const Eigen::Affine3d moved(Eigen::Matrix4d(Eigen::umeyama(rest, now, false)));
        std::vector<Vec3> points;
        for (const Vec3& p : bone.surface.points) points.push_back(moved * p);
        bone.moments.push_back(std::move(points));
    }
    scene.bodies.push_back(std::move(bone));
    return true;
}

// The values of a quantity of all bodies at all times.
std::vector<double> all_values(const ViewedScene& scene, std::size_t quantity) {
    std::vector<double> all;
    for (const ViewedBody& body : scene.bodies)
        for (const ViewedValues& values : body.values)
            if (values.quantity == quantity)
                for (const std::vector<double>& numbers : values.times)
                    std::ranges::copy_if(numbers, std::back_inserter(all),
                                         [](double number) { return std::isfinite(number); });
    return all;
}

double quantile(std::vector<double>& values, double share) {
    if (values.empty()) return 0;
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

// The limits of colours, over all bodies and times.
std::vector<ViewedQuantity> limits_of(const ViewedScene& scene) {
    std::vector<double> stretches = all_values(scene, kStretch);
    std::vector<double> stresses = all_values(scene, kStress);
    return {{"activation", 0, 1},
            {"fibre stretch", quantile(stretches, 1 - kQuantile), quantile(stretches, kQuantile)},
            {"stress (von Mises), MPa", 0, quantile(stresses, kQuantile)}};
}

void add_bodies(const RunJson& run, const TetMesh& first, const std::vector<Part>& parts,
                ViewedScene& scene) {
    for (std::size_t b = 0; b < parts.size(); ++b) {
        ViewedBody body{.name = text_of(run.at("bodies")[b], "name"),
                        .colour = report::distinct_colour(b),
                        .mesh = mesh_of(first, parts[b])};
        for (const std::size_t quantity : {kActivation, kStretch, kStress})
            body.values.push_back(
                {.quantity = quantity, .at = ViewedValues::At::tets, .times = {}});
        scene.bodies.push_back(std::move(body));
    }
}

}  // namespace

ViewedScene contraction_scene(const RunJson& run, const fs::path& folder) {
    ViewedScene made;
    const ContractFrames frames(run, folder);
    if (frames.count() == 0) {
        made.notes.emplace_back("No frames were written.");
        return made;
    }
    TetMesh mesh{.points = {}, .tets = frames.tets()};
    std::vector<Part> parts;
    std::vector<std::size_t> chosen{0};
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const ContractFrame frame = frames.frame(chosen[i]);
        if (i == 0) {
            mesh.points = frame.points;
            chosen = chosen_frames(frames.count(), mesh);
            parts = parts_of(mesh, frame.body, run.at("bodies").size(), folder);
            add_bodies(run, mesh, parts, made);
        }
        require_same_mesh(frame, mesh, folder);
        made.times.push_back(frame.time);
        for (std::size_t b = 0; b < parts.size(); ++b) add_moment(frame, parts[b], made.bodies[b]);
    }
    made.quantities = limits_of(made);
    for (const std::string& bone : frames.bones())
        if (!add_bone(bone, frames, chosen, made))
            made.notes.push_back("The bone " + bone +
                                 " has not the same points in each frame and "
                                 "is left out.");
    if (chosen.size() < frames.count())
        made.notes.push_back("The view has " + std::to_string(chosen.size()) + " of " +
                             std::to_string(frames.count()) + " frames.");
    made.notes.emplace_back(
        "Colours of stress end at its 99th percentile, those of stretch at the 1st and the 99th. "
        "Bones of more than 20 000 triangles are decimated for the view.");
    return made;
}

}  // namespace myotet::app
