// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "Repair/Fields.h"
#include "Repair/Workshop.h"

namespace myotet::repair {
namespace {

using Names = std::vector<std::string>;

// The tissues that are there when a step begins, and what the step does to them.
class NameCheck {
public:
    NameCheck(const Recipe& recipe, const Scene& scene) : recipe_(recipe) {
        for (const Tissue& tissue : scene.tissues) there_.push_back(tissue.name);
        has_reader_ = static_cast<bool>(scene.read_surface);
    }

    void step(const Step& step) {
        step_ = &step;
        std::visit([&](const auto& task) { check(task); }, step.task);
    }

private:
    void need(const std::string& name) const {
        const auto count = std::count(there_.begin(), there_.end(), name);
        if (count == 0)
            refuse("'" + name + "' is no tissue of this scan" + remedy_for(name, there_));
        if (count > 1)
            refuse("'" + name + "' is the name of " + std::to_string(count) +
                   " tissues; give them names of their own");
    }
    void need(const Names& names) const {
        for (const std::string& name : names) need(name);
    }
    void need_or_all(const Names& names) const {
        if (names.size() == 1 && names.front() == "all") return;
        need(names);
    }
    void need(const Operand& operand) const {
        if (const auto* tissue = std::get_if<TissueName>(&operand)) need(tissue->name);
        if (const auto* solid = std::get_if<Solid>(&operand); solid && !solid->relative_to.empty())
            need(solid->relative_to);
        if (std::holds_alternative<SurfaceFile>(operand) && !has_reader_)
            refuse("a surface file cannot be read here");
    }
    void add(const NewTissue& tissue) {
        if (std::count(there_.begin(), there_.end(), tissue.name) > 0)
            refuse("'" + tissue.name + "' is a tissue already; give the new one another name");
        there_.push_back(tissue.name);
    }
    void lose(const std::string& name) { std::erase(there_, name); }

    void check(const Combine& task) {
        need(task.tissue);
        need(task.with);
        need(task.takes_from);
        if (task.into) add(*task.into);
        const auto* other = std::get_if<TissueName>(&task.with);
        if (other && other->name == task.tissue)
            refuse("'" + task.tissue + "' is combined with itself; name another tissue");
        if (other && task.how == Combination::unite) lose(other->name);
    }
    void check(const Create& task) {
        need(task.from);
        need(task.takes_from);
        add(task.tissue);
    }
    void check(const Reshape& task) {
        need_or_all(task.tissues);
        need(task.takes_from);
    }
    void check(const KeepLargest& task) { need_or_all(task.tissues); }
    void check(const DropIslands& task) { need_or_all(task.tissues); }
    void check(const FillCavities& task) {
        need_or_all(task.tissues);
        need(task.takes_from);
    }
    void check(const Clip& task) { need_or_all(task.tissues); }
    void check(const Join& task) {
        need(task.tissue);
        need(task.bridge.takes_from);
    }
    void check(const Grow& task) {
        need(task.tissue);
        need(task.until_it_touches);
        need(task.bridge.takes_from);
        if (task.into) add(*task.into);
    }
    void check(const Priority& task) { need(task.tissues); }

    [[noreturn]] void refuse(const std::string& why) const { refuse_step(recipe_, *step_, why); }

    const Recipe& recipe_;
    const Step* step_ = nullptr;
    Names there_;
    bool has_reader_ = false;
};

}  // namespace

void check_names(const Recipe& recipe, const Scene& scene) {
    NameCheck check(recipe, scene);
    for (const Step& step : recipe.steps) check.step(step);
}

}  // namespace myotet::repair
