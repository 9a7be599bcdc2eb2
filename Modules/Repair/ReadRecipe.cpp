// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>

#include "Core/Errors.h"
#include "Repair/Fields.h"
#include "Repair/ReadSolid.h"
#include "Repair/Recipe.h"

namespace myotet::repair {
namespace {

using Task = decltype(Step::task);

// Labels are 32 bit; what lies above 2^24 is not kept by single precision files.
constexpr int kLargestLabel = 1 << 24;

std::optional<NewTissue> read_into(Fields& step) {
    if (!step.has("into")) {
        if (step.has("label")) step.refuse("'label' needs 'into', the new tissue's name");
        return {};
    }
    return NewTissue{step.word("into"), step.count_or("label", 1, kLargestLabel, 0)};
}

Combine read_combine(Fields& step, const std::string& what, Combination how) {
    Combine task;
    task.how = how;
    task.tissue = step.word(what);
    task.with = read_operand(step, "with");
    task.blend = step.number_or("blend", kLengthOrZero, 0);
    if (how == Combination::unite)
        task.takes_from = step.names_or_none("takes_from");
    else
        task.into = read_into(step);
    return task;
}

Create read_create(Fields& step) {
    Create task;
    task.tissue = {step.word("create"), step.count_or("label", 1, kLargestLabel, 0)};
    task.from = read_operand(step, "from");
    task.takes_from = step.names_or_none("takes_from");
    return task;
}

Reshape read_offset(Fields& step) {
    Reshape task;
    task.how = Change::offset;
    task.tissues = step.names("offset");
    task.by = step.number("by", {-1e3, 1e3, true, "a distance in mm, negative to shrink"});
    if (task.by == 0) step.refuse("'by' is 0, which changes nothing; leave the step out");
    task.takes_from = step.names_or_none("takes_from");
    return task;
}

Reshape read_open_close(Fields& step, const std::string& what, Change how) {
    Reshape task;
    task.how = how;
    task.tissues = step.names(what);
    task.by = step.number("by", {0, 1e3, false, "a distance in mm above 0"});
    if (how == Change::close) task.takes_from = step.names_or_none("takes_from");
    return task;
}

FillCavities read_fill(Fields& step) {
    FillCavities task;
    task.tissues = step.names("fill_cavities");
    task.under = step.number_or("under", kVolume, task.under);
    task.takes_from = step.names_or_none("takes_from");
    return task;
}

Bridge read_bridge(Fields& step) {
    Bridge bridge;
    bridge.within = step.number("within", kLength);
    if (step.has("radius")) bridge.radius = step.pair("radius", kLength);
    bridge.blend = step.number_or("blend", kLengthOrZero, bridge.blend);
    bridge.clearance = step.number_or("clearance", kLengthOrZero, bridge.clearance);
    bridge.takes_from = step.names_or_none("takes_from");
    return bridge;
}

Grow read_grow(Fields& step) {
    Grow task;
    task.tissue = step.word("grow");
    task.until_it_touches = step.word("until_it_touches");
    if (task.tissue == task.until_it_touches)
        step.refuse("'until_it_touches' is the tissue itself; name another");
    task.bridge = read_bridge(step);
    task.over = step.number_or("over", kArea, 0);
    task.from = step.point_if("from");
    task.to = step.point_if("to");
    task.into = read_into(step);
    return task;
}

Priority read_priority(Fields& step) {
    Priority task{step.names("priority")};
    if (task.tissues.size() < 2) step.refuse("'priority' needs at least two tissues, first wins");
    return task;
}

using Reader = std::function<Task(Fields&)>;

const std::vector<std::pair<std::string, Reader>>& step_readers() {
    static const std::vector<std::pair<std::string, Reader>> readers{
        {"union", [](Fields& s) { return read_combine(s, "union", Combination::unite); }},
        {"intersection",
         [](Fields& s) { return read_combine(s, "intersection", Combination::intersect); }},
        {"difference",
         [](Fields& s) { return read_combine(s, "difference", Combination::subtract); }},
        {"create", [](Fields& s) { return read_create(s); }},
        {"offset", [](Fields& s) { return read_offset(s); }},
        {"open", [](Fields& s) { return read_open_close(s, "open", Change::open); }},
        {"close", [](Fields& s) { return read_open_close(s, "close", Change::close); }},
        {"keep_largest",
         [](Fields& s) {
             return KeepLargest{s.names("keep_largest"), s.count_or("count", 1, 1'000'000, 1)};
         }},
        {"drop_islands",
         [](Fields& s) {
             return DropIslands{s.names("drop_islands"), s.number("under", kVolume)};
         }},
        {"fill_cavities", [](Fields& s) { return read_fill(s); }},
        {"clip",
         [](Fields& s) {
             return Clip{s.names("clip"), s.number_or("margin", kLengthOrZero, 0)};
         }},
        {"join",
         [](Fields& s) {
             return Join{s.word("join"), read_bridge(s)};
         }},
        {"grow", [](Fields& s) { return read_grow(s); }},
        {"priority", [](Fields& s) { return read_priority(s); }},
    };
    return readers;
}

Step read_step(const YamlTree& tree, int number, const std::filesystem::path& file) {
    Step step;
    step.number = number;
    step.line = tree.line;
    Fields fields(tree, file.string() + ", step " + std::to_string(number) + " (line " +
                            std::to_string(tree.line) + ")");
    const std::pair<std::string, Reader>* chosen = nullptr;
    std::vector<std::string> words;
    for (const auto& reader : step_readers()) {
        words.push_back(reader.first);
        const bool here = std::any_of(tree.entries.begin(), tree.entries.end(),
                                      [&](const auto& e) { return e.first == reader.first; });
        if (here && chosen)
            fields.refuse("'" + chosen->first + "' and '" + reader.first +
                          "' are two steps; begin the second with a '-' of its own");
        if (here) chosen = &reader;
    }
    if (!chosen) {
        const std::string found = tree.entries.empty() ? "" : tree.entries.front().first;
        fields.refuse("'" + found + "' is no step" + remedy_for(found, words));
    }
    step.what = chosen->first;
    step.task = chosen->second(fields);
    fields.finish();
    return step;
}

}  // namespace

Recipe read_recipe(const std::filesystem::path& file) {
    const YamlTree tree = read_yaml(file);
    Fields top(tree, file.string());
    Recipe recipe;
    recipe.file = file;
    (void)top.word_or("about", "");
    const int version = top.count_or("myotet_recipe", 1, 1'000'000, 1);
    if (version != 1)
        top.refuse("'myotet_recipe' is " + std::to_string(version) +
                   ", but this version of Myotet reads 1");
    const YamlTree& steps = top.require("steps");
    top.finish();
    if (steps.kind != YamlTree::Kind::list || steps.items.empty())
        top.refuse("'steps' must be a list of at least one step, each begun with a '-'");
    for (const YamlTree& item : steps.items)
        recipe.steps.push_back(read_step(item, static_cast<int>(recipe.steps.size()) + 1, file));
    return recipe;
}

}  // namespace myotet::repair
