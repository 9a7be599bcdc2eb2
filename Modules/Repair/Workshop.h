// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "LevelSet/Csg.h"
#include "Repair/Apply.h"

namespace myotet::repair {

/// The scene while a recipe is worked through: tissues as bands, made when a
/// step first asks for them, and the log.
class Workshop {
public:
    Workshop(const Recipe& recipe, Scene& scene, ProgressSink& progress);

    void begin(const Step& step);
    /// Forgets bands of tissues that no step has changed, and tells what the step
    /// did; of several tissues only those that it changed.
    void end();
    /// Gives changed tissues their regions.
    void finish();

    [[noreturn]] void refuse(const std::string& why) const;
    [[nodiscard]] int find(const std::string& name) const;
    /// Numbers of these tissues; "all" names all.
    [[nodiscard]] std::vector<int> find_all(const std::vector<std::string>& names) const;
    [[nodiscard]] const std::string& name(int tissue) const { return scene_.tissues[tissue].name; }
    [[nodiscard]] const levelset::Band& band(int tissue);
    [[nodiscard]] levelset::CsgLattice lattice() const { return lattice_; }
    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] const Recipe& recipe() const { return recipe_; }
    [[nodiscard]] ProgressSink& progress() { return progress_; }
    [[nodiscard]] double spacing() const { return lattice_.spacing; }

    /// Other tissues whose samples may reach into `box`, but for `without`.
    [[nodiscard]] std::vector<int> near(const Box& box, const std::vector<int>& without) const;
    [[nodiscard]] std::vector<const levelset::Band*> bands(const std::vector<int>& tissues);

    /// `form` as far as the other tissues allow, `givers` apart.
    [[nodiscard]] levelset::Band yield(int tissue, const levelset::Band& form,
                                       const std::vector<int>& givers);
    /// Gives a tissue this form and logs what that added and removed; givers
    /// lose what it gained. Refuses to empty a tissue.
    void replace(int tissue, levelset::Band form, const std::vector<int>& givers = {},
                 const std::string& note = {});
    /// An empty tissue; replace() gives it its form.
    [[nodiscard]] int add(const NewTissue& tissue);
    /// Takes a tissue out of the scene, its substance having gone elsewhere.
    void absorb(int tissue);

    std::vector<StepReport> log;

private:
    struct State {
        std::optional<levelset::Band> band;
        Box box;  ///< that its samples cover
        bool gone = false;
    };
    void settle_into(Tissue& tissue, const levelset::Band& band);
    void record(int tissue, double added, double removed, const std::string& note);

    const Recipe& recipe_;
    Scene& scene_;
    ProgressSink& progress_;
    levelset::CsgLattice lattice_;
    std::vector<State> states_;
    std::vector<StepReport> done_;  ///< by the current step
    const Step* step_ = nullptr;
};

/// Refuses a recipe that names tissues which are not there when their step
/// comes.
void check_names(const Recipe& recipe, const Scene& scene);

/// "recipe.yaml, step 3 (line 12): " and why.
[[noreturn]] void refuse_step(const Recipe& recipe, const Step& step, const std::string& why);

}  // namespace myotet::repair
