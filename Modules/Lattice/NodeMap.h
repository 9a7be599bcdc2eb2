// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "Core/Geometry.h"

namespace myotet::lattice {

/// Integer coordinates to node numbers: an open-addressing hash table.
/// Coordinates lie in [0, 2^21). Reading from several threads is safe while
/// nobody inserts.
class NodeMap {
public:
    NodeMap() : slots_(1u << 12) {}

    /// The node at these coordinates, or -1.
    [[nodiscard]] std::int32_t find(const Index3& c) const {
        const std::uint64_t key = pack(c);
        for (std::size_t i = hash(key);; ++i) {
            const Slot& s = slots_[i & (slots_.size() - 1)];
            if (s.key == key) return s.node;
            if (s.key == kEmpty) return -1;
        }
    }

    /// The node at these coordinates; `fresh` becomes one when there was none.
    std::int32_t find_or_insert(const Index3& c, std::int32_t fresh) {
        if (2 * (count_ + 1) > slots_.size()) grow();
        const std::uint64_t key = pack(c);
        for (std::size_t i = hash(key);; ++i) {
            Slot& s = slots_[i & (slots_.size() - 1)];
            if (s.key == key) return s.node;
            if (s.key == kEmpty) {
                s = {key, fresh};
                ++count_;
                return fresh;
            }
        }
    }

private:
    static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
    struct Slot {
        std::uint64_t key = kEmpty;
        std::int32_t node = -1;
    };

    static std::uint64_t pack(const Index3& c) {
        return static_cast<std::uint64_t>(c[0]) | static_cast<std::uint64_t>(c[1]) << 21 |
               static_cast<std::uint64_t>(c[2]) << 42;
    }
    // Fibonacci hashing after folding the high coordinate down.
    [[nodiscard]] std::size_t hash(std::uint64_t key) const {
        key ^= key >> 29;
        key *= 0x9E3779B97F4A7C15ull;
        return static_cast<std::size_t>(key >> 24) & (slots_.size() - 1);
    }
    void grow() {
        std::vector<Slot> old(slots_.size() * 2);
        old.swap(slots_);
        for (const Slot& s : old)
            if (s.key != kEmpty) {
                std::size_t i = hash(s.key);
                while (slots_[i & (slots_.size() - 1)].key != kEmpty) ++i;
                slots_[i & (slots_.size() - 1)] = s;
            }
    }

    std::vector<Slot> slots_;
    std::size_t count_ = 0;
};

}  // namespace myotet::lattice
