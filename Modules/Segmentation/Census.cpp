// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/Census.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "Core/Errors.h"
#include "Segmentation/TextHeader.h"

namespace myotet::segmentation {
namespace {

// So many suggestions help, more confuse.
constexpr std::size_t kSuggestions = 3;

struct Tally {
    LabelCount count;
    std::array<double, 3> index_sum{0, 0, 0};  // exact: whole numbers below 2^53
};

/// Counts `length` voxels from (i, j, k) on along i.
void add_run(Tally& tally, int i, int j, int k, int length) {
    LabelCount& c = tally.count;
    const Index3 first{i, j, k}, last{i + length - 1, j, k};
    for (int a = 0; a < 3; ++a) {
        c.min[a] = c.voxels == 0 ? first[a] : std::min(c.min[a], first[a]);
        c.max[a] = c.voxels == 0 ? last[a] : std::max(c.max[a], last[a]);
        tally.index_sum[a] += 0.5 * (static_cast<double>(first[a]) + last[a]) * length;
    }
    c.voxels += length;
}

/// Least number of letters to insert, delete or replace.
std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
        }
    }
    return row[b.size()];
}

/// The labels nearest to a name, those that contain it first.
std::string nearest_names(std::span<const LabelVolume> layers, std::span<const LabelCount> counts,
                          const std::string& asked) {
    std::vector<std::pair<std::size_t, std::string>> ranked;
    for (const LabelCount& c : counts) {
        const std::string name = layers[c.layer].name_of(c.value), lower = lower_case(name);
        const bool contains = lower.find(asked) != std::string::npos;
        ranked.emplace_back(contains ? 0 : 1 + edit_distance(lower, asked),
                            std::to_string(c.value) + " " + name);
    }
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string text;
    for (std::size_t n = 0; n < std::min(kSuggestions, ranked.size()); ++n)
        text += (n ? ", " : "") + ranked[n].second;
    return text;
}

/// What a word of the user says when it is no name.
struct Number {
    std::optional<int> layer;
    std::int32_t value = 0;
};

/// "4" or "1:4".
std::optional<Number> parse_number(const std::string& word) {
    Number number;
    const char *at = word.data(), *end = at + word.size();
    if (const std::size_t colon = word.find(':'); colon != std::string::npos) {
        int layer = 0;
        const auto [stop, error] = std::from_chars(at, at + colon, layer);
        if (error != std::errc() || stop != at + colon) return std::nullopt;
        number.layer = layer;
        at += colon + 1;
    }
    const auto [stop, error] = std::from_chars(at, end, number.value);
    if (error != std::errc() || stop != end) return std::nullopt;
    return number;
}

std::string value_range(std::span<const LabelCount> counts) {
    if (counts.empty()) return "none";
    const auto [low, high] = std::ranges::minmax(counts, {}, &LabelCount::value);
    return std::to_string(low.value) + " to " + std::to_string(high.value);
}

/// Marks the labels with which one word of the user agrees.
void match(std::span<const LabelVolume> layers, std::span<const LabelCount> counts,
           const std::string& word, std::vector<char>& chosen) {
    const std::optional<Number> number = parse_number(word);
    const std::string lower = lower_case(word);
    bool found = false;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const LabelCount& c = counts[i];
        const bool agrees =
            number ? c.value == number->value && (!number->layer || c.layer == *number->layer)
                   : lower_case(layers[c.layer].name_of(c.value)) == lower;
        if (agrees) {
            found = true;
            chosen[i] = 1;
        }
    }
    if (found) return;
    if (number)
        throw InputError("the label " + word + " has no voxels in the volume, whose labels are " +
                         value_range(counts) + "; ask for one that it holds");
    for (const LabelVolume& volume : layers)
        for (const auto& [named, label] : volume.names)
            if (lower_case(label.name) == lower)
                throw InputError(
                    "the label '" + word + "' (" + std::to_string(named) +
                    ") is in the name table but has no voxels in the volume; leave it out");
    throw InputError("no label is called '" + word + "'; the nearest are " +
                     nearest_names(layers, counts, lower));
}

}  // namespace

std::vector<LabelCount> count_labels(const LabelVolume& volume) {
    std::unordered_map<std::int32_t, Tally> tallies;
    std::int32_t current = 0;
    Tally* tally = nullptr;
    for (int k = 0; k < volume.size[2]; ++k)
        for (int j = 0; j < volume.size[1]; ++j) {
            const std::int32_t* row = volume.values.data() + volume.offset(0, j, k);
            for (int i = 0; i < volume.size[0];) {
                const std::int32_t value = row[i];
                const int first = i;
                while (i < volume.size[0] && row[i] == value) ++i;
                if (value == 0) continue;
                if (!tally || value != current) tally = &tallies[current = value];
                add_run(*tally, first, j, k, i - first);
            }
        }
    std::vector<LabelCount> counts;
    for (auto& [value, t] : tallies) {
        t.count.value = value;
        const Vec3 mean = Vec3(t.index_sum[0], t.index_sum[1], t.index_sum[2]) /
                          static_cast<double>(t.count.voxels);
        t.count.centroid = volume.index_to_lps * mean;
        counts.push_back(t.count);
    }
    std::sort(counts.begin(), counts.end(),
              [](const LabelCount& a, const LabelCount& b) { return a.value < b.value; });
    return counts;
}

std::vector<LabelCount> count_labels(std::span<const LabelVolume> layers) {
    std::vector<LabelCount> all;
    for (std::size_t layer = 0; layer < layers.size(); ++layer)
        for (LabelCount& count : count_labels(layers[layer])) {
            count.layer = static_cast<int>(layer);
            all.push_back(count);
        }
    return all;
}

std::vector<LabelCount> choose_labels(std::span<const LabelVolume> layers,
                                      std::span<const LabelCount> counts,
                                      const std::string& asked) {
    if (trimmed(asked).empty()) return {counts.begin(), counts.end()};
    std::vector<char> chosen(counts.size(), 0);
    for (std::size_t at = 0; at <= asked.size();) {
        const std::size_t comma = std::min(asked.find(',', at), asked.size());
        const std::string word(trimmed(std::string_view(asked).substr(at, comma - at)));
        if (!word.empty()) match(layers, counts, word, chosen);
        at = comma + 1;
    }
    std::vector<LabelCount> found;
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (chosen[i]) found.push_back(counts[i]);
    if (found.empty())
        throw InputError("'" + asked + "' names no label; give values or names apart by commas");
    return found;
}

}  // namespace myotet::segmentation
