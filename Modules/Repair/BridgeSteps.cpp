// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "Core/Text.h"
#include "LevelSet/CsgMeasure.h"
#include "LevelSet/CsgPieces.h"
#include "LevelSet/CsgTable.h"
#include "Repair/Bridges.h"
#include "Repair/Steps.h"

namespace myotet::repair {
namespace {

using levelset::Band;

// A ball whose centre lies this near is as thick as the tissue is there.
constexpr double kLocal = 5;  // mm
// Thinner than three samples across, a bridge would come apart.
constexpr double kThinnest = 1.5;  // samples

std::string mm(double value) { return formatted("%.3g", value); }

std::string lps(const Vec3& local, const Workshop& shop) {
    const Vec3 p = shop.scene().frame.to_lps(local);
    return formatted("[%.1f, %.1f, %.1f]", p.x(), p.y(), p.z());
}

std::string join_names(const std::vector<int>& tissues, const Workshop& shop) {
    std::string text;
    for (const int t : tissues) text += (text.empty() ? "" : ", ") + shop.name(t);
    return text;
}

// What a bridge may not and what it may pass through.
struct Surroundings {
    std::vector<int> walls, givers;
};

Surroundings surroundings(const Bridge& bridge, std::vector<int> ends, Workshop& shop) {
    Surroundings around;
    around.givers = shop.find_all(bridge.takes_from);
    Box box;
    for (const int t : ends) {
        const Box inside = levelset::inside_box(shop.band(t));
        box.include(inside.min);
        box.include(inside.max);
    }
    ends.insert(ends.end(), around.givers.begin(), around.givers.end());
    around.walls = shop.near(box, ends);
    return around;
}

RouteTask route_task(const Band& from, const Band& to, const Bridge& bridge,
                     const Surroundings& around, Workshop& shop) {
    RouteTask task{.from = from,
                   .to = to,
                   .walls = shop.bands(around.walls),
                   .passables = shop.bands(around.givers),
                   .within = bridge.within};
    const double widest = levelset::kCsgWidth * shop.spacing();
    task.clearance = bridge.clearance >= 0 ? std::min(bridge.clearance, widest) : widest;
    return task;
}

// Finds the way or says why there is none.
Route require_route(const RouteTask& task, const Surroundings& around, Workshop& shop) {
    const Route route = smoothed(find_route(task, shop.progress()), task);
    if (!route.points.empty() && route.length <= task.within) return route;
    const double gap = gap_between(task.from, task.to);
    std::string why = "the gap is " + mm(gap) + " mm straight across";
    if (!route.points.empty())
        why += " and " + mm(route.length) + " mm on the way around other tissues";
    why += ", but 'within' allows " + mm(task.within);
    if (route.points.empty() && !route.blocked_by.empty()) {
        std::vector<int> names;
        for (const int w : route.blocked_by) names.push_back(around.walls[w]);
        shop.refuse("no free way leads across the gap of " + mm(gap) +
                    " mm: " + join_names(names, shop) +
                    " lie in it; name them in takes_from, or move " + "'from' and 'to'");
    }
    shop.refuse(why + "; raise it if a bridge that long is right");
}

double thickness(double wished, const Ball& ball, const Workshop& shop) {
    return wished > 0 ? wished : std::max(ball.radius, kThinnest * shop.spacing());
}

// Pieces of `form` that hold nothing of `core` are taken away: what other
// tissues cut off from it.
Band connected(const Band& form, const Band& core) {
    const Band whole = levelset::framed(form, 1);
    const levelset::Pieces pieces = levelset::find_pieces(whole, levelset::Side::inside);
    std::vector<char> loose = levelset::pieces_meeting(whole, pieces, core);
    for (char& mark : loose) mark = !mark;
    if (std::count(loose.begin(), loose.end(), 1) == 0) return form;
    return levelset::flip_pieces(whole, pieces, loose);
}

// One way of growing, from the route on.
struct Growth {
    const Grow& task;
    int tissue, goal;
    int into;     ///< the tissue that receives it, or -1
    double area;  ///< over which they touch already, mm^2
    const Surroundings& around;
    std::vector<Vec3> path;
    Ball begin, end;  ///< inside the tissue and inside its goal

    struct Result {
        Band form;
        levelset::Contact touch;
        MiddleLine line;
    };
    // `before` is the tissue, or as much of it as lies around the bridge.
    [[nodiscard]] Result with(const std::array<double, 2>& radius, const Band& before,
                              Workshop& shop) const {
        Result made;
        // Deep enough to be cut off flat, but not out at the other side.
        made.line = middle_line(path, begin, radius, std::min(radius[1], end.radius));
        const Band bridge = swept(made.line, shop.lattice());
        if (into >= 0) {
            made.form = shop.yield(into, bridge, around.givers);
        } else {
            made.form = connected(
                shop.yield(tissue, levelset::unite(before, bridge, blend(radius)), around.givers),
                before);
        }
        made.touch = levelset::contact(made.form, shop.band(goal));
        return made;
    }
    [[nodiscard]] Result with(const std::array<double, 2>& radius, Workshop& shop) const {
        return with(radius, shop.band(tissue), shop);
    }
    [[nodiscard]] double blend(const std::array<double, 2>& radius) const {
        return task.bridge.blend >= 0 ? task.bridge.blend : 0.5 * radius[0];
    }
    // The area with these radii, from the neighbourhood of the bridge alone.
    [[nodiscard]] double touched(const std::array<double, 2>& radius, Workshop& shop) const {
        if (into >= 0) return with(radius, shop).touch.area;
        Box box;
        for (const Vec3& p : path) box.include(p);
        box.include(begin.centre);
        const Vec3 margin = Vec3::Constant(2 * std::max(radius[0], radius[1]) + blend(radius) +
                                           2 * levelset::kCsgWidth * shop.spacing());
        const Band before =
            levelset::cropped(shop.band(tissue), {box.min - margin, box.max + margin});
        const double elsewhere = area - levelset::contact(before, shop.band(goal)).area;
        return with(radius, before, shop).touch.area + elsewhere;
    }
};

// Widens the end until it touches over the area asked for, and little more.
Growth::Result grown_enough(const Growth& growth, std::array<double, 2> radius, Workshop& shop) {
    constexpr double kWider = 1.3, kWidest = 6;  // a step, and in all
    constexpr int kHalvings = 3;
    const double over = growth.task.over, widest = kWidest * radius[1];
    if (over > 0) {
        double low = radius[1], high = low;
        const auto enough = [&](double end) {
            return growth.touched({radius[0], end}, shop) >= over;
        };
        if (!enough(high)) {
            do {
                low = high;
                high *= kWider;
            } while (high < widest && !enough(high));
            for (int i = 0; i < kHalvings; ++i) {
                const double middle = 0.5 * (low + high);
                (enough(middle) ? high : low) = middle;
            }
        }
        radius[1] = high;
    }
    Growth::Result made = growth.with(radius, shop);
    if (made.touch.area > 0 && made.touch.area >= over) return made;
    shop.refuse("'" + shop.name(growth.tissue) + "' would touch '" + shop.name(growth.goal) +
                "' over " + mm(made.touch.area) + " mm^2 only, " + mm(over) +
                " are asked for; name tissues that may give way in takes_from, choose another "
                "place with 'to', or ask for less with 'over'");
}

std::string describe(const Growth::Result& made, const std::string& across, int goal,
                     const Workshop& shop) {
    return "bridge of " + mm(made.line.length) + " mm " + across + ", radius " +
           mm(made.line.radius.front()) + " to " + mm(made.line.radius.back()) + " mm; touches " +
           shop.name(goal) + " over " + mm(made.touch.area) + " mm^2 about " +
           lps(made.touch.centre, shop);
}

}  // namespace

void run(const Grow& task, Workshop& shop) {
    const int tissue = shop.find(task.tissue), goal = shop.find(task.until_it_touches);
    const levelset::Contact now = levelset::contact(shop.band(tissue), shop.band(goal));
    if (now.area > 0 && now.area >= task.over) {
        if (task.into)
            shop.refuse("'" + task.tissue + "' touches '" + task.until_it_touches +
                        "' already; nothing would be in '" + task.into->name + "'");
        shop.replace(tissue, shop.band(tissue), {},
                     "touches " + shop.name(goal) + " already over " + mm(now.area) + " mm^2");
        return;
    }
    const Surroundings around = surroundings(task.bridge, {tissue, goal}, shop);
    RouteTask search = route_task(shop.band(tissue), shop.band(goal), task.bridge, around, shop);
    if (task.from) search.begin = shop.scene().frame.to_local(*task.from);
    if (task.to) search.end = shop.scene().frame.to_local(*task.to);
    // Where they touch already, that place is made wider.
    if (now.area > 0 && !search.begin) search.begin = now.centre;
    const Route route = require_route(search, around, shop);
    const int into = task.into ? shop.add(*task.into) : -1;
    Growth growth{task, tissue, goal, into, now.area, around, route.points, {}, {}};
    growth.begin = ball_near(shop.band(tissue), growth.path.front(), kLocal);
    growth.end = ball_near(shop.band(goal), growth.path.back(), kLocal);
    std::array<double, 2> radius;
    radius[0] = thickness(task.bridge.radius[0], growth.begin, shop);
    radius[1] = task.bridge.radius[1] > 0 ? task.bridge.radius[1] : radius[0];
    Growth::Result made = grown_enough(growth, radius, shop);
    const std::string across = now.area > 0 ? "where they touched over " + mm(now.area) + " mm^2"
                                            : "across a gap of " + mm(route.length) + " mm";
    const std::string note = describe(made, across, goal, shop);
    shop.replace(into >= 0 ? into : tissue, std::move(made.form), around.givers, note);
}

namespace {

// A band of one of its pieces, and of all others.
struct Parted {
    Band largest, others;
};

Parted part(const Band& band, const levelset::Pieces& pieces) {
    std::vector<char> first(pieces.volume.size(), 0), rest(pieces.volume.size(), 1);
    first[0] = 1;
    rest[0] = 0;
    return {levelset::flip_pieces(band, pieces, rest), levelset::flip_pieces(band, pieces, first)};
}

// Joins the largest piece to the one nearest to it.
Band bridged(const Join& task, int tissue, const Band& band, const levelset::Pieces& pieces,
             Workshop& shop, std::string& note) {
    const Parted parts = part(band, pieces);
    const Surroundings around = surroundings(task.bridge, {tissue}, shop);
    const RouteTask search = route_task(parts.largest, parts.others, task.bridge, around, shop);
    const Route route = require_route(search, around, shop);
    const std::vector<Vec3>& path = route.points;
    const Ball begin = ball_near(parts.largest, path.front(), kLocal);
    const Ball end = ball_near(parts.others, path.back(), kLocal);
    const std::array<double, 2> radius{thickness(task.bridge.radius[0], begin, shop),
                                       thickness(task.bridge.radius[1], end, shop)};
    const MiddleLine line = middle_line(path, begin, radius, end.radius);
    const double blend =
        task.bridge.blend >= 0 ? task.bridge.blend : 0.5 * std::min(radius[0], radius[1]);
    note += (note.empty() ? "joined across " : ", ") + mm(route.length) + " mm at " +
            lps(path[path.size() / 2], shop);
    const Band form = levelset::unite(band, swept(line, shop.lattice()), blend);
    return connected(shop.yield(tissue, form, around.givers), band);
}

}  // namespace

void run(const Join& task, Workshop& shop) {
    const int tissue = shop.find(task.tissue);
    Band form = levelset::framed(shop.band(tissue), 1);
    levelset::Pieces pieces = levelset::find_pieces(form, levelset::Side::inside);
    if (pieces.volume.size() < 2) {
        shop.replace(tissue, shop.band(tissue), {}, "is one piece already");
        return;
    }
    std::string note;
    while (pieces.volume.size() > 1) {
        const std::size_t before = pieces.volume.size();
        shop.progress().check();
        form = levelset::framed(bridged(task, tissue, form, pieces, shop, note), 1);
        pieces = levelset::find_pieces(form, levelset::Side::inside);
        if (pieces.volume.size() >= before)
            shop.refuse("other tissues cut the bridge between two pieces of '" + task.tissue +
                        "'; name them in takes_from, or give it a larger 'radius'");
    }
    shop.replace(tissue, std::move(form), shop.find_all(task.bridge.takes_from), note);
}

}  // namespace myotet::repair
