// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Simulate.h"

#include <algorithm>
#include <cmath>

#include "Membrane/Require.h"
#include "Membrane/RungeKutta.h"
#include "Membrane/Switch.h"

namespace myotet::membrane {

namespace {

class Run {
public:
    Run(Levels levels, const Options& options, const Loads& loads)
        : options_(options), loads_(loads), levels_(std::move(levels)) {
        loads.validate(levels_);
        properties_ = level_properties(levels_, options.wall);
        fixed_ = fixed_vertices(levels_, loads);
        check_stiffness();
        motion_.x = levels_.rest;
        motion_.v.assign(levels_.rest.size(), Vec3::Zero());
        const bool refined = options.detail == Detail::refined;
        selection_ = wholly_refined(levels_, refined ? levels_.finest() : 0);
        active_ = make_active(levels_, selection_, properties_);
        switch_to(levels_, active_, active_, motion_);
        prepare();
        first_step_ = std::ldexp(step_, active_.finest);
        clearance_ = least_clearance(levels_);
    }

    Result run(ProgressSink& progress, const Observer& observer) {
        std::int64_t looks = 0, lines = 0;
        double next_look = 0, next_line = 0;
        const double rounding = 1e-9 * options_.duration;
        while (result_.status == Status::finished) {
            if (motion_.time >= next_look - rounding) {
                if (options_.detail == Detail::adaptive) look_and_adapt();
                look_for_facing_walls();
                next_look = static_cast<double>(++looks) * options_.criteria.interval;
            }
            if (motion_.time >= next_line - rounding) {
                write_line(observer);
                next_line = static_cast<double>(++lines) * options_.interval;
                progress.report("membrane", std::min(1.0, motion_.time / options_.duration));
                progress.check();
            }
            if (motion_.time >= options_.duration - rounding || result_.status != Status::finished)
                break;
            go(std::min({next_line, next_look, options_.duration}));
        }
        result_.final_surface = {motion_.x, active_.drawn};
        return std::move(result_);
    }

private:
    const Options& options_;
    const Loads& loads_;
    Levels levels_;
    std::vector<LevelProperties> properties_;
    std::vector<char> fixed_;
    Selection selection_{levels_};
    Active active_;
    Body body_{levels_, options_.wall, loads_, active_};
    Motion motion_;
    Watch watch_;
    Stepper stepper_;
    double step_ = 0, first_step_ = 0, clearance_ = 0;
    Result result_;

    void check_stiffness() {
        const bool coarse = options_.detail == Detail::coarse;
        const Active finest = make_active(
            levels_, wholly_refined(levels_, coarse ? 0 : levels_.finest()), properties_);
        Body body{levels_, options_.wall, loads_, finest};
        membrane::prepare(body);
        const double step = options_.safety * stable_step(body);
        require(step >= options_.smallest_step, "the stable step in s", step,
                "must be at least smallest_step; make the wall softer, heavier or less damped");
    }

    void prepare() {
        membrane::prepare(body_);
        // [Choi05, eq. 9], from the step at the given surface's level.
        step_ = options_.safety * stable_step(body_);
        if (first_step_ > 0) step_ = std::min(step_, std::ldexp(first_step_, -active_.finest));
        stepper_.prepare(body_, fixed_, motion_);
        ++result_.evaluations;
        result_.spring_evaluations += static_cast<std::int64_t>(active_.springs.size());
    }

    void look_and_adapt() {
        look(options_.criteria, body_, motion_, stepper_.forces().pressing, watch_);
        if (!adapt(options_.criteria, levels_, watch_, motion_.time, selection_)) return;
        const double before = stepper_.energy();
        Active after = make_active(levels_, selection_, properties_);
        switch_to(levels_, active_, after, motion_);
        active_ = std::move(after);
        body_.facing = {};  // of triangles that may be gone
        prepare();
        result_.switched_energy += std::abs(stepper_.energy() - before);
        ++result_.switches;
    }

    // Walls that are farther apart than what has moved can bring together are not looked for.
    void look_for_facing_walls() {
        if (options_.wall.contact_stiffness == 0) return;
        constexpr double kSpare = 1;  // mm
        double moved = 0, speed = 0;
        for (const std::int32_t i : active_.nodes) {
            moved = std::max(moved, (motion_.x[i] - levels_.rest[i]).squaredNorm());
            speed = std::max(speed, motion_.v[i].squaredNorm());
        }
        const bool before = !body_.facing.nodes.empty();
        const double margin = kSpare + 2 * options_.criteria.interval * std::sqrt(speed);
        body_.facing = {};
        if (2 * std::sqrt(moved) + 2 * options_.wall.thickness + margin > clearance_)
            body_.facing = find_facing(levels_, options_.wall, active_, motion_.x, margin);
        if (before || !body_.facing.nodes.empty()) prepare();
    }

    // In equal steps; one that brings energy from nowhere is halved.
    void go(double until) {
        constexpr int kHalvings = 10;
        int halvings = 0;
        while (motion_.time < until) {
            const double left = until - motion_.time;
            const double parts = std::max(1.0, std::ceil(left / std::ldexp(step_, -halvings)));
            const bool kept = stepper_.step(body_, parts > 1 ? left / parts : left, motion_);
            result_.evaluations += 4;
            result_.spring_evaluations += 4 * static_cast<std::int64_t>(active_.springs.size());
            if (kept) {
                ++result_.steps;
                if (parts == 1) motion_.time = until;
                continue;
            }
            ++result_.rejected;
            if (++halvings <= kHalvings) continue;
            result_.status = Status::unstable;
            result_.message = "at " + std::to_string(motion_.time) +
                              " s energy grew without work of the loads even at a step of " +
                              std::to_string(1e6 * left / parts) +
                              " microseconds; lower the forces or the stiffness of tools";
            return;
        }
    }

    void say_sunk(std::size_t tool) {
        if (result_.status != Status::finished) return;
        result_.status = Status::sunk;
        result_.message = "at " + std::to_string(motion_.time) + " s tool " + std::to_string(tool) +
                          " is in the wall by its radius and the wall does not bear its force; "
                          "lower the force, or give a larger sphere or a stiffer contact";
    }

    void write_line(const Observer& observer) {
        Moment m;
        m.time = motion_.time;
        m.nodes = active_.nodes.size();
        m.springs = active_.springs.size();
        m.volume = cavity_volume(body_, motion_.x);
        m.pressure = cavity_pressure(body_, m.volume);
        m.energy = stepper_.energy();
        for (const std::int32_t i : active_.nodes) {
            m.mass += active_.mass[i];
            m.largest_displacement =
                std::max(m.largest_displacement, (motion_.x[i] - levels_.rest[i]).norm());
        }
        for (const auto& shares : body_.patches) {
            Vec3 mean = Vec3::Zero();
            for (const auto& [i, share] : shares) mean += share * (motion_.x[i] - levels_.rest[i]);
            m.patch_displacement.push_back(mean.norm());
        }
        for (const Tool& tool : loads_.tools) {
            m.tools.push_back(touch_of(tool, body_, motion_));
            if (m.tools.back().sunk) say_sunk(m.tools.size() - 1);
        }
        if (observer) observer({m, body_, motion_, stepper_.forces()});
        result_.history.push_back(std::move(m));
    }
};

}  // namespace

void Options::validate() const {
    wall.validate();
    criteria.validate();
    const auto positive = [](const char* field, double value, const char* rule) {
        require(std::isfinite(value) && value > 0, field, value, rule);
    };
    positive("duration", duration, "must be a time in s above 0");
    positive("interval", interval, "must be a time in s above 0");
    positive("smallest_step", smallest_step, "must be a time in s above 0");
    require(safety > 0 && safety <= 1, "safety", safety, "must be above 0 and at most 1");
}

Result simulate(const TriMesh& surface, const Options& options, const Loads& loads,
                ProgressSink& progress, const Observer& observer) {
    return simulate(make_levels(surface, options.levels), options, loads, progress, observer);
}

Result simulate(Levels levels, const Options& options, const Loads& loads, ProgressSink& progress,
                const Observer& observer) {
    options.validate();
    return Run(std::move(levels), options, loads).run(progress, observer);
}

}  // namespace myotet::membrane
