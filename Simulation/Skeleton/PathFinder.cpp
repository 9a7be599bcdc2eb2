// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/PathFinder.h"

#include <algorithm>
#include <optional>

namespace myotet::skeleton {
namespace {

// Rounds of adding a contact and tightening, a wrap.
constexpr int kRounds = 8;
// Sweeps over the contacts, and how little they move in the last, of the path's size.
constexpr int kSweeps = 500;
constexpr double kStill = 1e-12;
// A torus may be touched at both ends of a line across it.
constexpr int kMostTouches = 2;

bool is_there(const PathPoint& point, std::span<const double> values) {
    if (!point.condition) return true;
    const double value = values[point.condition->coordinate];
    return value >= point.condition->lowest && value <= point.condition->highest;
}

Vec3 location_of(const PathPoint& point, std::span<const double> values) {
    if (!point.moving) return point.location;
    Vec3 location;
    for (int i = 0; i < 3; ++i) {
        const PathPoint::Moving& m = (*point.moving)[i];
        location[i] = evaluate(m.location, m.coordinate < 0 ? 0 : values[m.coordinate]).value;
    }
    return location;
}

}  // namespace

std::vector<PlacedPoint> place_points(const Muscle& muscle, std::span<const Pose> bodies,
                                      std::span<const double> values) {
    std::vector<PlacedPoint> placed;
    placed.reserve(muscle.points.size());
    for (std::size_t i = 0; i < muscle.points.size(); ++i) {
        const PathPoint& point = muscle.points[i];
        if (!is_there(point, values)) continue;
        placed.push_back({static_cast<int>(i), bodies[point.body](location_of(point, values))});
    }
    return placed;
}

PathFinder::PathFinder(const Model& model, const Muscle& muscle, std::span<const Pose> bodies,
                       std::span<const double> values)
    : model_(model),
      muscle_(muscle),
      points_(place_points(muscle, bodies, values)),
      inside_(muscle.wraps.size(), 0),
      missed_(muscle.wraps.size(), 0),
      made_room_(muscle.wraps.size(), 0) {
    for (std::size_t i = 1; i < points_.size(); ++i)
        scale_ += (points_[i].at - points_[i - 1].at).norm();
    const int last = static_cast<int>(muscle.points.size()) - 1;
    tools_.reserve(muscle.wraps.size());
    for (const PathWrap& wrap : muscle.wraps) {
        const WrapObject& object = model.wrap_objects[wrap.object];
        tools_.push_back({&object, WrapSurface(object), bodies[object.body] * object.in_body,
                          wrap.first < 0 ? 0 : wrap.first,
                          wrap.last < 0 ? last : std::min(wrap.last, last)});
        scale_ = std::max(scale_, tools_.back().surface.size());
    }
}

std::size_t PathFinder::place_of(int begin, int end) const {
    std::size_t place = 0;
    while (place + 1 < points_.size() &&
           (points_[place].index != begin || points_[place + 1].index != end))
        ++place;
    return place;
}

bool PathFinder::has_piece(int begin, int end) const {
    return place_of(begin, end) + 1 < points_.size();
}

void PathFinder::recall(const PathMemory& memory) {
    for (const Contact& contact : memory.contacts)
        if (tools_[contact.wrap].object->active && has_piece(contact.begin, contact.end))
            contacts_.push_back(contact);
    for (const PathMemory::Pass& pass : memory.passes)
        if (has_piece(pass.begin, pass.end)) passes_.push_back(pass);
}

PathFinder::Straight PathFinder::around(std::size_t contact) const {
    const Contact& c = contacts_[contact];
    Straight piece{contact, place_of(c.begin, c.end), {}, {}, true, true};
    piece.from = points_[piece.place].at;
    piece.to = points_[piece.place + 1].at;
    if (contact > 0 && contacts_[contact - 1].begin == c.begin) {
        const Contact& before = contacts_[contact - 1];
        piece.from = tools_[before.wrap].pose(before.memory.contact.last.at);
        piece.from_point = false;
    }
    if (contact + 1 < contacts_.size() && contacts_[contact + 1].begin == c.begin) {
        const Contact& after = contacts_[contact + 1];
        piece.to = tools_[after.wrap].pose(after.memory.contact.first.at);
        piece.to_point = false;
    }
    return piece;
}

std::vector<PathFinder::Straight> PathFinder::straight_pieces() const {
    std::vector<Straight> pieces;
    std::size_t contact = 0;
    for (std::size_t place = 0; place + 1 < points_.size(); ++place) {
        Straight piece{contact, place, points_[place].at, points_[place + 1].at, true, true};
        for (; contact < contacts_.size() && contacts_[contact].begin == points_[place].index;
             ++contact) {
            const Contact& c = contacts_[contact];
            const Pose& pose = tools_[c.wrap].pose;
            piece.to = pose(c.memory.contact.first.at);
            piece.to_point = false;
            pieces.push_back(piece);
            piece = {contact + 1,           place, pose(c.memory.contact.last.at),
                     points_[place + 1].at, false, true};
        }
        pieces.push_back(piece);
    }
    return pieces;
}

Wrap PathFinder::try_wrap(int wrap, const Straight& piece, const WrapMemory& before) const {
    const Tool& tool = tools_[wrap];
    return find_wrap(*tool.object, tool.surface, tool.pose.to_rest(piece.from),
                     tool.pose.to_rest(piece.to), before);
}

int PathFinder::count(int wrap) const {
    return static_cast<int>(std::count_if(contacts_.begin(), contacts_.end(),
                                          [&](const Contact& c) { return c.wrap == wrap; }));
}

/// Wraps anew between the neighbours; false when the contact is lost.
bool PathFinder::act(std::size_t contact, double& moved) {
    Contact& c = contacts_[contact];
    const Tool& tool = tools_[c.wrap];
    const Straight piece = around(contact);
    const Wrap wrap = try_wrap(c.wrap, piece, c.memory);
    if (wrap.touch != WrapTouch::touching) {
        inside_[c.wrap] |= wrap.touch == WrapTouch::inside;
        keep_side(c.wrap, piece, wrap.side);
        contacts_.erase(contacts_.begin() + static_cast<std::ptrdiff_t>(contact));
        return false;
    }
    moved = std::max({moved, (wrap.contact.first.at - c.memory.contact.first.at).norm(),
                      (wrap.contact.last.at - c.memory.contact.last.at).norm()});
    c.memory = {true, wrap.side, wrap.contact, tool.pose.to_rest(piece.from),
                tool.pose.to_rest(piece.to)};
    return true;
}

/// By Gauss and Seidel, there and back.
void PathFinder::tighten() {
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        double moved = 0;
        bool coupled = false;
        for (std::size_t n = 0; n < contacts_.size();) {
            const std::size_t contact = sweep % 2 == 0 ? n : contacts_.size() - 1 - n;
            const Straight piece = around(contact);
            coupled |= !piece.from_point || !piece.to_point;
            const bool last = !act(contact, moved);
            if (last)
                moved = scale_;
            else
                ++n;
        }
        loose_ = coupled && !(moved < kStill * scale_);
        if (!loose_) return;
    }
}

void PathFinder::insert(int wrap, const Candidate& candidate) {
    const Tool& tool = tools_[wrap];
    const Straight& piece = candidate.piece;
    Contact contact{wrap, points_[piece.place].index, points_[piece.place + 1].index, {}};
    contact.memory = {true, candidate.wrap.side, candidate.wrap.contact,
                      tool.pose.to_rest(piece.from), tool.pose.to_rest(piece.to)};
    contacts_.insert(contacts_.begin() + static_cast<std::ptrdiff_t>(piece.after), contact);
}

std::vector<PathMemory::Pass>::iterator PathFinder::pass_of(int wrap, const Straight& piece) {
    const int begin = points_[piece.place].index;
    return std::find_if(passes_.begin(), passes_.end(), [&](const PathMemory::Pass& pass) {
        return pass.wrap == wrap && pass.begin == begin;
    });
}

void PathFinder::keep_side(int wrap, const Straight& piece, const Vec3& side) {
    const auto pass = pass_of(wrap, piece);
    if (pass != passes_.end())
        pass->side = side;
    else if (side.squaredNorm() > 0)
        passes_.push_back({wrap, points_[piece.place].index, points_[piece.place + 1].index, side});
}

/// Notes whether straight pieces other than those beside its contact run through an object
/// or end inside.
void PathFinder::look_through(int wrap) {
    const Tool& tool = tools_[wrap];
    inside_[wrap] = missed_[wrap] = 0;
    if (!tool.object->active) return;
    WrapMemory before;
    if (tool.surface.is_torus()) before.side = Vec3::UnitZ();
    for (const Straight& piece : straight_pieces()) {
        const int begin = points_[piece.place].index, end = points_[piece.place + 1].index;
        if (begin < tool.first || end > tool.last) continue;
        const auto touched = [&](std::size_t contact, bool point) {
            return !point && contacts_[contact].wrap == wrap;
        };
        const bool beside =
            touched(piece.after - 1, piece.from_point) || touched(piece.after, piece.to_point);
        if (beside && !tool.surface.is_torus()) continue;
        const Wrap tried = try_wrap(wrap, piece, before);
        missed_[wrap] |= tried.pierced;
        inside_[wrap] |= tried.touch == WrapTouch::inside;
    }
}

/// Brings a wrap into contact where it acts.
bool PathFinder::add(int wrap) {
    const Tool& tool = tools_[wrap];
    const int touches = count(wrap);
    if (!tool.object->active) return false;
    if (touches >= (tool.surface.is_torus() ? kMostTouches : 1)) {
        look_through(wrap);
        return false;
    }
    std::optional<Candidate> best;
    inside_[wrap] = missed_[wrap] = 0;
    for (const Straight& piece : straight_pieces()) {
        const int begin = points_[piece.place].index, end = points_[piece.place + 1].index;
        if (begin < tool.first || end > tool.last) continue;
        WrapMemory before;
        const bool whole = piece.from_point && piece.to_point;
        const auto pass = pass_of(wrap, piece);
        if (whole && pass != passes_.end()) before.side = pass->side;
        // A ring that is touched is not to be passed through once more.
        if (touches > 0) before.side = Vec3::UnitZ();
        Candidate candidate{piece, try_wrap(wrap, piece, before)};
        inside_[wrap] |= candidate.wrap.touch == WrapTouch::inside;
        if (whole) keep_side(wrap, piece, candidate.wrap.side);
        missed_[wrap] |= candidate.wrap.pierced && candidate.wrap.touch == WrapTouch::clear;
        if (candidate.wrap.touch != WrapTouch::touching) continue;
        if (touches > 0 && !candidate.wrap.pierced) continue;
        candidate.longer = wrapped_length(candidate.wrap.contact, tool.pose.to_rest(piece.from),
                                          tool.pose.to_rest(piece.to)) -
                           (piece.to - piece.from).norm();
        const bool first = candidate.wrap.pierced;
        if (first || !best || candidate.longer < best->longer) best = candidate;
        if (first) break;
    }
    if (!best) return false;
    insert(wrap, *best);
    inside_[wrap] = missed_[wrap] = 0;
    return true;
}

/// A wrap that cannot act because a contact with another object lies inside its own: the
/// other one leaves it the place, to be added anew.
bool PathFinder::make_room(int wrap) {
    if (!inside_[wrap] || made_room_[wrap] || count(wrap) > 0) return false;
    const Tool& tool = tools_[wrap];
    const auto is_inside = [&](const Contact& c) {
        if (c.begin < tool.first || c.end > tool.last) return false;
        const Pose& pose = tools_[c.wrap].pose;
        const auto height = [&](const Vec3& at) {
            return tool.surface.height(tool.pose.to_rest(pose(at)));
        };
        return c.wrap != wrap &&
               std::min(height(c.memory.contact.first.at), height(c.memory.contact.last.at)) < 0;
    };
    std::vector<Contact> contacts = contacts_;
    if (std::erase_if(contacts_, is_inside) == 0) return false;
    made_room_[wrap] = 1;
    if (add(wrap)) return true;
    contacts_ = std::move(contacts);
    inside_[wrap] = 1;
    return false;
}

void PathFinder::find() {
    const int wraps = static_cast<int>(tools_.size());
    tighten();
    for (int round = 0; round < kRounds * wraps; ++round) {
        bool changed = false;
        for (int wrap = 0; wrap < wraps && !changed; ++wrap) changed = add(wrap) || make_room(wrap);
        if (!changed) return;
        tighten();
    }
    // Some contact is added and lost again and again.
    for (int wrap = 0; wrap < wraps; ++wrap) look_through(wrap);
}

void PathFinder::remember(PathMemory& memory) const {
    memory.contacts = contacts_;
    memory.passes = passes_;
}

Path PathFinder::path() const {
    Path path;
    std::size_t contact = 0;
    const auto add_node = [&](const PathNode& node) {
        if (!path.nodes.empty()) {
            const PathNode& before = path.nodes.back();
            path.length += before.around < 0 ? (node.at - before.at).norm() : before.curve;
        }
        path.nodes.push_back(node);
    };
    path.nodes.reserve(points_.size() + 2 * contacts_.size());
    for (const PlacedPoint& point : points_) {
        add_node({point.at, muscle_.points[point.index].body, point.index});
        for (; contact < contacts_.size() && contacts_[contact].begin == point.index; ++contact) {
            const Contact& c = contacts_[contact];
            const Tool& tool = tools_[c.wrap];
            const int object = muscle_.wraps[c.wrap].object, body = tool.object->body;
            const WrapContact& on = c.memory.contact;
            const Mat3& turn = tool.pose.rotation;
            add_node({tool.pose(on.first.at), body, -1, object, on.curve, turn * on.first.along});
            add_node({tool.pose(on.last.at), body, -1, -1, 0, turn * on.last.along});
        }
    }
    for (std::size_t w = 0; w < tools_.size(); ++w) {
        if (inside_[w]) path.inside.push_back(muscle_.wraps[w].object);
        const bool loose = loose_ && count(static_cast<int>(w)) > 0;
        if (missed_[w] || loose) path.missed.push_back(muscle_.wraps[w].object);
    }
    return path;
}

}  // namespace myotet::skeleton
