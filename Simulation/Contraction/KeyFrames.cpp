// SPDX-License-Identifier: Apache-2.0
#include "Contraction/KeyFrames.h"

#include <cmath>

#include "Contraction/Keys.h"
#include "Contraction/Words.h"
#include "Core/Errors.h"

namespace myotet::contraction {
namespace fs = std::filesystem;

namespace {

using Kind = YamlTree::Kind;

double number_of(const YamlTree& scalar, const std::string& name, const fs::path& file) {
    const auto value = scalar.kind == Kind::scalar ? to_number(scalar.text) : std::nullopt;
    if (!value || !std::isfinite(*value))
        refuse(file, scalar.line,
               "'" + name + "' is '" + scalar.text.substr(0, 60) +
                   "' but must be a number: s, degrees or m");
    return *value;
}

// The row of a key; what only the first key names is held.
std::vector<double> row_of(const YamlTree& key, const fs::path& file,
                           const skeleton::Table& table) {
    std::vector<double> row;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        const std::string& name = table.columns[c];
        const auto entry =
            std::ranges::find(key.entries, name, &decltype(key.entries)::value_type::first);
        if (entry != key.entries.end())
            row.push_back(number_of(entry->second, name, file));
        else
            row.push_back(table.rows.front()[c]);
    }
    return row;
}

void check_names(const YamlTree& key, const fs::path& file, const std::vector<std::string>& told) {
    for (const auto& [name, value] : key.entries)
        if (name != "time" && std::ranges::find(told, name) == told.end())
            refuse(file, value.key_line,
                   "the first key does not name '" + name +
                       "', so that where it begins is not known" + known_are(name, told));
}

// A coordinate of several keys stands in each: a gap could mean anything.
void check_gaps(const std::vector<YamlTree>& keys, const fs::path& file,
                const std::vector<std::string>& told) {
    for (const std::string& name : told) {
        const YamlTree *with = nullptr, *without = nullptr;
        for (std::size_t k = 1; k < keys.size(); ++k) {
            const auto& entries = keys[k].entries;
            const bool has =
                std::ranges::find(entries, name,
                                  &std::decay_t<decltype(entries)>::value_type::first) !=
                entries.end();
            (has ? with : without) = &keys[k];
        }
        if (with && without)
            refuse(file, without->line,
                   "this key does not say where '" + name +
                       "' is, but others do; name it in each key, or in the first alone to hold "
                       "it");
    }
}

}  // namespace

bool is_key_frames(const fs::path& file) {
    return file.extension() == ".yaml" || file.extension() == ".yml";
}

skeleton::Table read_key_frames(const YamlTree& keys, const fs::path& file) {
    if (keys.kind != Kind::list || keys.items.empty())
        refuse(file, keys.line,
               "'keys' must be a list of postures, '- {time: 0, elbow_flexion: 10}'");
    skeleton::Table table;
    table.in_degrees = true;
    for (const YamlTree& key : keys.items) {
        if (key.kind != Kind::map)
            refuse(file, key.line, "a key must be a map, '{time: 0, elbow_flexion: 10}'");
        if (table.columns.empty())
            for (const auto& [name, value] : key.entries)
                if (name != "time") table.columns.push_back(name);
        check_names(key, file, table.columns);
        const Keys of(key, file, "a key", [&] {
            std::vector<std::string> known = table.columns;
            known.emplace_back("time");
            return known;
        }());
        const double time = of.number("time", {-1e6, 1e6, true, "a time in s"});
        if (!table.times.empty() && !(time > table.times.back()))
            refuse(file, key.line,
                   "the key at " + shown(time) + " s follows the one at " +
                       shown(table.times.back()) + " s, but times must ascend; sort the keys");
        table.rows.push_back(row_of(key, file, table));
        table.times.push_back(time);
    }
    if (table.columns.empty())
        refuse(file, keys.line,
               "the first key names no coordinate; write '{time: 0, NAME: DEGREES}'");
    check_gaps(keys.items, file, table.columns);
    return table;
}

MotionRows read_motion_rows(const fs::path& file) {
    if (is_key_frames(file)) return {read_key_frames(file), skeleton::key_framed()};
    MotionRows rows{skeleton::read_table(file), {}};
    if (rows.table.times.size() < 3) rows.smooth.degree = 3;
    return rows;
}

skeleton::Trajectory trajectory_of(const MotionRows& rows, const skeleton::Model& model,
                                   const fs::path& file) {
    try {
        return skeleton::make_trajectory(rows.table, model, rows.smooth);
    } catch (const InputError& error) {
        throw InputError(file.string() + ": " + error.what());
    }
}

skeleton::Table read_key_frames(const fs::path& file) {
    const YamlTree tree = repair::read_yaml(file);
    const Keys keys(tree, file, "a motion", {"myotet_motion", "title", "keys"});
    if (keys.number("myotet_motion", {1, 1, true, "1, the only version there is"}) != 1)
        refuse(file, tree.line, "'myotet_motion' must be 1");
    skeleton::Table table =
        read_key_frames(keys.require("keys", "a list of postures at times"), file);
    if (keys.has("title")) table.title = keys.word("title", "a line of text").name;
    return table;
}

}  // namespace myotet::contraction
