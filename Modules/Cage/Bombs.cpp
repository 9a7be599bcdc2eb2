// SPDX-License-Identifier: Apache-2.0
#include "Cage/Bombs.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "Lattice/Patterns.h"

namespace myotet::cage {
namespace {

using Ids = std::vector<std::int32_t>;

/// A thing to be covered: one of these nodes' snowflakes must be whole.
struct Demand {
    Ids nodes;
};

std::vector<Ids> tets_of_nodes(const Sculpture& s) {
    std::vector<Ids> of(s.points.size());
    for (std::size_t t = 0; t < s.tets.size(); ++t)
        for (const std::int32_t n : s.tets[t]) of[n].push_back(static_cast<std::int32_t>(t));
    return of;
}

// Groups of tetrahedra around an edge or a node, joined by faces that hold all of it.
int count_fans(const Sculpture& s, const Ids& around, const Ids& held) {
    Ids left = around;
    int fans = 0;
    while (!left.empty()) {
        ++fans;
        Ids fan{left.back()};
        left.pop_back();
        for (std::size_t i = 0; i < fan.size(); ++i)
            for (int f = 0; f < 4; ++f) {
                if (std::ranges::find(held, s.tets[fan[i]][f]) != held.end()) continue;
                const auto at = std::ranges::find(left, s.neighbours[fan[i]][f]);
                if (at == left.end()) continue;
                fan.push_back(*at);
                left.erase(at);
            }
    }
    return fans;
}

// Nodes whose removed tetrahedra fall into several groups by faces that hold the node: there
// the boundary passes more than once, and splitting does not part all of it.
void find_pinched_nodes(const Sculpture& s, const std::vector<Ids>& around,
                        std::vector<Demand>& pinched) {
    for (std::size_t n = 0; n < around.size(); ++n) {
        Ids removed;
        for (const std::int32_t t : around[n])
            if (!s.kept[t]) removed.push_back(t);
        if (removed.empty() || removed.size() == around[n].size()) continue;
        if (count_fans(s, removed, {static_cast<std::int32_t>(n)}) > 1)
            pinched.push_back({{static_cast<std::int32_t>(n)}});
    }
}

std::vector<Demand> find_pinched(const Sculpture& s) {
    std::map<std::array<std::int32_t, 2>, Ids> around;
    for (std::size_t t = 0; t < s.tets.size(); ++t) {
        if (!s.kept[t]) continue;
        for (const auto& e : lattice::kEdge) {
            const std::int32_t a = s.tets[t][e[0]], b = s.tets[t][e[1]];
            around[{std::min(a, b), std::max(a, b)}].push_back(static_cast<std::int32_t>(t));
        }
    }
    std::vector<Demand> pinched;
    for (const auto& [edge, tets] : around)
        if (count_fans(s, tets, {edge[0], edge[1]}) > 1) pinched.push_back({{edge[0], edge[1]}});
    find_pinched_nodes(s, tets_of_nodes(s), pinched);
    return pinched;
}

/// Branch and bound over the demands of one group.
struct Search {
    const std::vector<Demand>& demands;
    const std::vector<Ids>& missing;  ///< a node: removed tetrahedra around it
    Ids group;                        ///< demands, by number
    std::vector<std::int32_t>& added_times;
    Ids best{};
    std::int64_t best_cost = std::numeric_limits<std::int64_t>::max(), cost = 0, steps = 0;

    [[nodiscard]] bool covered(const Demand& d) const {
        return std::ranges::any_of(d.nodes, [&](std::int32_t n) {
            return std::ranges::all_of(missing[n],
                                       [&](std::int32_t t) { return added_times[t] > 0; });
        });
    }
    [[nodiscard]] std::int64_t price(std::int32_t n) const {
        return std::ranges::count_if(missing[n],
                                     [&](std::int32_t t) { return added_times[t] == 0; });
    }
    void take(std::int32_t n, int by) {
        for (const std::int32_t t : missing[n]) {
            if (by > 0 && added_times[t] == 0) ++cost;
            added_times[t] += by;
            if (by < 0 && added_times[t] == 0) --cost;
        }
    }
    // The next demand not met, its snowflakes from the cheapest on.
    void run(std::size_t from, Ids& taken) {
        if (cost >= best_cost || (++steps > kSearch && !best.empty())) return;
        while (from < group.size() && covered(demands[group[from]])) ++from;
        if (from == group.size()) {
            best_cost = cost;
            best = taken;
            return;
        }
        std::vector<std::array<std::int64_t, 2>> order;
        for (const std::int32_t n : demands[group[from]].nodes) order.push_back({price(n), n});
        std::ranges::sort(order);
        for (const auto& [price_of_n, node] : order) {
            const auto n = static_cast<std::int32_t>(node);
            take(n, 1);
            taken.push_back(n);
            run(from + 1, taken);
            taken.pop_back();
            take(n, -1);
        }
    }
};

// Demands that share a removed tetrahedron, through any of their nodes, go together.
std::vector<Ids> group_demands(const std::vector<Demand>& demands,
                               const std::vector<Ids>& missing) {
    Ids root(demands.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](std::int32_t d) {
        while (root[d] != d) d = root[d] = root[root[d]];
        return d;
    };
    std::map<std::int32_t, std::int32_t> first;
    for (std::size_t d = 0; d < demands.size(); ++d)
        for (const std::int32_t n : demands[d].nodes)
            for (const std::int32_t t : missing[n]) {
                const auto here = static_cast<std::int32_t>(d);
                const auto [at, fresh] = first.try_emplace(t, here);
                if (!fresh)
                    root[std::max(find(here), find(at->second))] =
                        std::min(find(here), find(at->second));
            }
    std::map<std::int32_t, Ids> groups;
    for (std::size_t d = 0; d < demands.size(); ++d)
        groups[find(static_cast<std::int32_t>(d))].push_back(static_cast<std::int32_t>(d));
    std::vector<Ids> result;
    for (auto& [least, group] : groups) result.push_back(std::move(group));
    return result;
}

void meet_demands(Sculpture& s, const std::vector<Demand>& demands, BombSummary& summary) {
    const std::vector<Ids> around = tets_of_nodes(s);
    std::vector<Ids> missing(s.points.size());
    for (const Demand& d : demands)
        for (const std::int32_t n : d.nodes)
            if (missing[n].empty())
                for (const std::int32_t t : around[n])
                    if (!s.kept[t]) missing[n].push_back(t);
    std::vector<std::int32_t> added_times(s.tets.size(), 0);
    for (const Ids& group : group_demands(demands, missing)) {
        Search search{demands, missing, group, added_times};
        Ids taken;
        search.run(0, taken);
        ++summary.groups;
        summary.greedy += search.steps > kSearch;
        for (const std::int32_t n : search.best)
            for (const std::int32_t t : missing[n]) {
                summary.added_tets += !s.kept[t];
                s.kept[t] = 1;
            }
    }
}

}  // namespace

std::vector<std::int32_t> find_bombs(const Sculpture& s) {
    Ids bombs;
    for (std::size_t t = 0; t < s.tets.size(); ++t) {
        if (!s.kept[t]) continue;
        const auto open = std::ranges::count_if(
            s.neighbours[t], [&](std::int32_t n) { return n < 0 || !s.kept[n]; });
        if (open >= 2) bombs.push_back(static_cast<std::int32_t>(t));
    }
    return bombs;
}

BombSummary defuse(Sculpture& s) {
    BombSummary summary;
    std::vector<Demand> demands;
    for (const std::int32_t t : find_bombs(s)) {
        demands.push_back({{s.tets[t].begin(), s.tets[t].end()}});
        ++summary.bombs;
    }
    // Whole snowflakes hold no bombs, but may touch the rest in a new edge.
    while (!demands.empty() || !(demands = find_pinched(s)).empty()) {
        if (demands.front().nodes.size() < 4)
            summary.pinched += static_cast<std::int64_t>(demands.size());
        meet_demands(s, demands, summary);
        demands.clear();
    }
    return summary;
}

}  // namespace myotet::cage
