// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Measure.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "Fibres/Laplace.h"
#include "Quality/Quality.h"

namespace myotet::contraction {
namespace {

// Of the corners, where they are at rest and now.
Mat3 gradient_of(const BodyModel& body, std::size_t t, const std::vector<Vec3>& x) {
    const Tet& n = body.mesh.mesh.tets[t];
    Mat3 rest, now;
    for (int c = 0; c < 3; ++c) {
        rest.col(c) = body.mesh.mesh.points[n[c + 1]] - body.mesh.mesh.points[n[0]];
        now.col(c) = x[body.first_node + n[c + 1]] - x[body.first_node + n[0]];
    }
    return now * rest.inverse();
}

bool is_contractile(const BodyModel& body, std::size_t point) { return body.law->contracts(point); }

// A point of each tetrahedron: of linear elements and patches its own.
std::size_t point_of(const BodyModel& body, std::size_t t) {
    return body.nodes == body.mesh.mesh.points.size() ? t : 4 * t;
}

std::vector<std::int32_t> corners_at(const Scene& scene, const Model& model, std::size_t b,
                                     End end) {
    std::vector<std::int32_t> nodes;
    const auto first = static_cast<std::int32_t>(model.bodies[b].first_node);
    const auto corners = static_cast<std::int32_t>(model.bodies[b].mesh.mesh.points.size());
    for (const HeldGroup& group : model.held) {
        if (group.body != b || scene.attachments[group.attachment].end != end) continue;
        for (const std::int32_t n : group.nodes)
            if (n - first < corners) nodes.push_back(n - first);
    }
    return nodes;
}

Vec3 middle(const std::vector<std::int32_t>& nodes, std::size_t first, const std::vector<Vec3>& x) {
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t n : nodes) sum += x[first + n];
    return sum / static_cast<double>(std::max<std::size_t>(1, nodes.size()));
}

Architecture of_body(const Scene& scene, const Model& model, std::size_t b) {
    const BodyModel& body = model.bodies[b];
    const auto origin = corners_at(scene, model, b, End::origin);
    const auto insertion = corners_at(scene, model, b, End::insertion);
    if (body.greatest_tension == 0 || origin.empty() || insertion.empty()) return {};
    const auto potential = fibres::laplace_potential(body.mesh.mesh, origin, insertion);
    const std::vector<Vec3> slope = fibres::gradients(body.mesh.mesh, potential);
    Architecture made;
    double along = 0, flux = 0;
    for (std::size_t t = 0; t < slope.size(); ++t) {
        flux += body.volumes[t] * slope[t].squaredNorm();
        if (!is_contractile(body, point_of(body, t))) continue;
        made.volume += body.volumes[t];
        along += body.volumes[t] * slope[t].norm();
    }
    made.fibre_length = along / flux;
    made.pcsa = made.volume / made.fibre_length;
    made.force = body.greatest_tension * made.pcsa;
    return made;
}

struct Shape {
    double volume = 0, stretch = 0, aspect_ratio = 0, least_J = HUGE_VAL;
};

Shape shape_of(const BodyModel& body, const std::vector<Vec3>& x) {
    Shape shape;
    double fibred = 0;
    for (std::size_t t = 0; t < body.volumes.size(); ++t) {
        const Mat3 F = gradient_of(body, t, x);
        const double J = F.determinant();
        shape.volume += J * body.volumes[t];
        shape.least_J = std::min(shape.least_J, J);
        const Tet& n = body.mesh.mesh.tets[t];
        const std::size_t first = body.first_node;
        shape.aspect_ratio = std::max(
            shape.aspect_ratio,
            quality::measure(x[first + n[0]], x[first + n[1]], x[first + n[2]], x[first + n[3]])
                .aspect_ratio);
        if (body.fibres.empty() || !is_contractile(body, point_of(body, t))) continue;
        fibred += body.volumes[t];
        shape.stretch += body.volumes[t] * (F * body.fibres[t]).norm();
    }
    shape.stretch = fibred > 0 ? shape.stretch / fibred : 1;
    return shape;
}

// sigma = P F^T / J, of each tetrahedron the mean over its points by what they stand for; of
// a group's pressure all is at the tetrahedra themselves.
std::vector<Mat3> cauchy_stresses(const BodyModel& body) {
    const elasticity::Points& points = body.elastic->points();
    const bool grouped = points.groups.size() > 0;
    std::vector<Mat3> sigma(body.volumes.size(), Mat3::Zero());
    for (std::size_t q = 0; q < points.size(); ++q) {
        double all = 0;
        for (const std::int32_t t : points.tets(q)) all += body.volumes[t];
        const double share = points.volume[q] / all;
        const Mat3& F = body.elastic->gradients()[q];
        const Mat3 P = share * body.elastic->law_stress(q) +
                       (grouped ? 1 : share) * body.elastic->volume_stress(q);
        for (const std::int32_t t : points.tets(q)) sigma[t] += P * F.transpose() / F.determinant();
    }
    return sigma;
}

}  // namespace

std::vector<Architecture> architecture(const Scene& scene, const Model& model) {
    std::vector<Architecture> all;
    for (std::size_t b = 0; b < model.bodies.size(); ++b) all.push_back(of_body(scene, model, b));
    return all;
}

std::vector<Column> history_columns(const Scene& scene, const Model& model) {
    std::vector<Column> columns{{"time", "s"}};
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
        const std::string& name = scene.bodies[b].name;
        columns.push_back({name + "_activation", ""});
        columns.push_back({name + "_volume", "mm^3"});
        columns.push_back({name + "_fiber_stretch", ""});
        columns.push_back({name + "_max_aspect_ratio", ""});
        columns.push_back({name + "_min_J", ""});
        if (!corners_at(scene, model, b, End::origin).empty() &&
            !corners_at(scene, model, b, End::insertion).empty())
            columns.push_back({name + "_length", "mm"});
    }
    std::map<std::string, int> times;
    for (const HeldGroup& group : model.held) {
        const Attachment& attachment = scene.attachments[group.attachment];
        std::string name =
            attachment.body + "_at_" + (attachment.bone.empty() ? "fixed" : attachment.bone);
        if (const int again = ++times[name]; again > 1) name += "_" + std::to_string(again);
        for (const char* part : {"_force_x", "_force_y", "_force_z", "_force"})
            columns.push_back({name + part, "N"});
        for (const char* part : {"_moment_x", "_moment_y", "_moment_z"})
            columns.push_back({name + part, "N mm"});
    }
    for (const Contact& contact : scene.contacts) {
        const std::string name = contact.a + "_on_" + contact.b;
        columns.push_back({name + "_contact_force", "N"});
        columns.push_back({name + "_contact_area", "mm^2"});
        columns.push_back({name + "_max_penetration", "mm"});
    }
    columns.push_back({"newton_iterations", ""});
    return columns;
}

std::vector<double> history_row(const Scene& scene, const Model& model,
                                const Simulation& simulation, int iterations) {
    const std::vector<Vec3>& x = simulation.positions();
    std::vector<double> row{simulation.time()};
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
        const BodyModel& body = model.bodies[b];
        const Shape shape = shape_of(body, x);
        row.insert(row.end(), {simulation.activation(b), shape.volume, shape.stretch,
                               shape.aspect_ratio, shape.least_J});
        const auto origin = corners_at(scene, model, b, End::origin);
        const auto insertion = corners_at(scene, model, b, End::insertion);
        if (!origin.empty() && !insertion.empty())
            row.push_back(
                (middle(insertion, body.first_node, x) - middle(origin, body.first_node, x))
                    .norm());
    }
    for (const HeldGroup& group : model.held) {
        const Vec3 centre = middle(group.nodes, 0, x);
        Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
        for (const std::int32_t n : group.nodes) {
            force += simulation.forces()[n];
            moment += (x[n] - centre).cross(simulation.forces()[n]);
        }
        row.insert(row.end(), {force.x(), force.y(), force.z(), force.norm(), moment.x(),
                               moment.y(), moment.z()});
    }
    for (const ContactReport& contact : simulation.contacts())
        row.insert(row.end(), {contact.total, contact.area, contact.max_depth});
    row.push_back(iterations);
    return row;
}

Moment make_frame(const Model& model, const Simulation& simulation) {
    Moment frame;
    const std::vector<Vec3>& x = simulation.positions();
    meshfiles::NamedArray displacement{"displacement", 3, {}}, index{"body", 1, {}},
        activation{"activation", 1, {}}, fibre{"fiber", 3, {}}, stretch{"fiber_stretch", 1, {}},
        volume{"J", 1, {}}, stress{"cauchy_stress", 9, {}};
    const auto put = [](const auto& m, std::vector<double>& to) {
        for (Eigen::Index i = 0; i < m.rows(); ++i)
            for (Eigen::Index j = 0; j < m.cols(); ++j) to.push_back(m(i, j));
    };
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
        const BodyModel& body = model.bodies[b];
        TetMesh now = body.mesh.mesh;
        for (std::size_t n = 0; n < now.points.size(); ++n) {
            now.points[n] = x[body.first_node + n];
            put(now.points[n] - body.mesh.mesh.points[n], displacement.values);
        }
        const std::vector<Mat3> sigma = cauchy_stresses(body);
        for (std::size_t t = 0; t < now.tets.size(); ++t) {
            const Mat3 F = gradient_of(body, t, x);
            const Vec3 along = body.fibres.empty() ? Vec3(Vec3::Zero()) : Vec3(F * body.fibres[t]);
            index.values.push_back(static_cast<double>(b));
            activation.values.push_back(
                is_contractile(body, point_of(body, t)) ? simulation.activation(b) : 0);
            put(body.fibres.empty() ? along : Vec3(along.normalized()), fibre.values);
            stretch.values.push_back(body.fibres.empty() ? 1 : along.norm());
            volume.values.push_back(F.determinant());
            put(sigma[t], stress.values);
        }
        append(frame.mesh, now);
        frame.names.insert(body.mesh.names.begin(), body.mesh.names.end());
    }
    frame.arrays.points = {std::move(displacement)};
    frame.arrays.cells = {std::move(index),   std::move(activation), std::move(fibre),
                          std::move(stretch), std::move(volume),     std::move(stress)};
    frame.arrays.time = simulation.time();
    return frame;
}

}  // namespace myotet::contraction
