// SPDX-License-Identifier: Apache-2.0
#include "Report/TetCode.h"

namespace myotet::report {
namespace {

constexpr std::uint32_t kVisited = 0, kOutside = 1, kFresh = 2;

void append_number(std::string& bytes, std::uint32_t number) {
    for (; number >= 128; number >>= 7) bytes += static_cast<char>(128 | (number & 127));
    bytes += static_cast<char>(number);
}

// Numbers points as they come.
class Numbering {
public:
    Numbering(Connections& told, std::size_t point_count) : told_(told), now_(point_count, -1) {}

    // The number that stands for a point, `fresh` for one that is new.
    void tell(std::int32_t point, std::uint32_t fresh, const Guess& guess) {
        const auto count = static_cast<std::int32_t>(told_.points.size());
        if (now_[point] >= 0) {
            append_number(told_.bytes, fresh + static_cast<std::uint32_t>(count - now_[point]));
            return;
        }
        append_number(told_.bytes, fresh);
        now_[point] = count;
        told_.points.push_back(point);
        told_.guesses.push_back(guess);
    }
    [[nodiscard]] std::int32_t now(std::int32_t point) const { return now_[point]; }
    [[nodiscard]] Guess last() const {
        return {.a = static_cast<std::int32_t>(told_.points.size()) - 1};
    }

private:
    Connections& told_;
    std::vector<std::int32_t> now_;
};

class TetTeller {
public:
    TetTeller(const std::vector<Tet>& tets, std::size_t point_count)
        : tets_(tets),
          behind_(face_neighbours(tets)),
          visited_(tets.size(), 0),
          numbering_(told_, point_count) {
        queue_.reserve(3 * tets.size());
    }

    Connections tell() {
        for (std::size_t seed = 0; seed < tets_.size(); ++seed) {
            if (visited_[seed]) continue;
            for (const std::int32_t corner : tets_[seed])
                numbering_.tell(corner, kFresh, numbering_.last());
            add(static_cast<std::int32_t>(seed), tets_[seed], 4);
            for (; next_ < queue_.size(); ++next_) cross(queue_[next_]);
        }
        return std::move(told_);
    }

private:
    // A face of a tetrahedron whose corners are in the order told.
    struct Gate {
        std::int32_t tet, behind;
        Triangle face;
        std::int32_t opposite;
    };

    void add(std::int32_t t, const Tet& corners, int open) {
        visited_[t] = 1;
        told_.elements.push_back(t);
        for (int face = 0; face < open; ++face) {
            const std::int32_t opposite = corners[face];
            int own = 0;
            while (tets_[t][own] != opposite) ++own;
            queue_.push_back({t, behind_[t][own], face_of(corners, face), opposite});
        }
    }
    void cross(const Gate& gate) {
        if (gate.behind < 0) return append_number(told_.bytes, kOutside);
        if (visited_[gate.behind]) return append_number(told_.bytes, kVisited);
        const auto [a, b, c] = gate.face;
        std::int32_t v = a;
        for (const std::int32_t corner : tets_[gate.behind])
            if (corner != a && corner != b && corner != c) v = corner;
        numbering_.tell(v, kFresh,
                        {numbering_.now(a), numbering_.now(b), numbering_.now(c),
                         numbering_.now(gate.opposite)});
        add(gate.behind, {a, b, c, v}, 3);
    }

    const std::vector<Tet>& tets_;
    std::vector<Tet> behind_;
    std::vector<char> visited_;
    Connections told_;
    Numbering numbering_;
    std::vector<Gate> queue_;
    std::size_t next_ = 0;
};

}  // namespace

Connections tell_tets(const std::vector<Tet>& tets, std::size_t point_count) {
    return TetTeller(tets, point_count).tell();
}

Connections tell_triangles(const std::vector<Triangle>& triangles, std::size_t point_count) {
    Connections told;
    Numbering numbering(told, point_count);
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        told.elements.push_back(static_cast<std::int32_t>(f));
        for (const std::int32_t corner : triangles[f]) numbering.tell(corner, 0, numbering.last());
    }
    return told;
}

}  // namespace myotet::report
