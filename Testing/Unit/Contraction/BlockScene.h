// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "Contraction/Run.h"
#include "Core/Errors.h"
#include "Support/ReferenceCase.h"
#include "Support/TemporaryFolder.h"

namespace myotet::contraction::test {

namespace fs = std::filesystem;
using testing::read_bytes;

/// A muscle along z: 4 x 4 x 12 mm in 120 tetrahedra, its fibres along it.
inline const Vec3 kSize(4, 4, 12);
inline constexpr double kArea = 16, kVolume = 192;  // mm^2, mm^3
inline constexpr double kSigmaMax = 0.3;            // MPa, of teran2003_muscle

/// What a scene of the block says; the lower end is fixed, the upper one as `upper` says.
struct BlockText {
    std::string material = "teran2003_muscle";
    std::string fibres = "{from: laplace}";
    std::string elements = "patches";
    std::string activation = "[[0, 0], [0.5, 1], [1, 0]]";
    std::string upper = "to: fixed, plane: {point: [0, 0, 12], normal: [0, 0, 1], within: 0.1}";
    std::string time = "end: 1, step: 0.25";
    std::string more;  ///< further keys of the scene
};

inline std::string text_of(const BlockText& b) {
    return "bodies:\n  muscle:\n    mesh: block.vtu\n    material: " + b.material +
           "\n    fibres: " + b.fibres + "\n    elements: " + b.elements +
           "\n    activation: " + b.activation +
           "\nattachments:\n  - {body: muscle, to: fixed, plane: {point: [0, 0, 0], normal: "
           "[0, 0, 1], within: 0.1}, end: origin}\n  - {body: muscle, " +
           b.upper + ", end: insertion}\ntime: {" + b.time + "}\n" + b.more;
}

/// A box's surface, outward.
inline TriMesh box_surface(const Vec3& low, const Vec3& high) {
    TetMesh block = myotet::test::five_tet_block(high - low, {2, 2, 2});
    for (Vec3& p : block.points) p += low;
    return boundary_surface(block);
}

/// A scene with all that it names.
struct Loaded {
    Scene scene;
    std::vector<TriMesh> bones;
    Model model;
};

/// Stops within the step that begins at this part of the run, after it was asked once.
class StopAfter final : public ProgressSink {
public:
    explicit StopAfter(double part) : part_(part) {}
    void report(std::string_view, double done) override { reached_ = done >= part_; }
    void warn(std::string_view) override {}
    void note(std::string_view) override {}
    [[nodiscard]] bool interrupted() const override { return reached_ && asked_++ > 0; }

private:
    double part_;
    bool reached_ = false;
    mutable std::atomic<int> asked_ = 0;
};

/// A folder with the block's mesh and a scene of it.
struct BlockFolder {
    BlockFolder() { write_block(myotet::test::five_tet_block(kSize, {2, 2, 6})); }
    void write_block(const TetMesh& mesh, const std::map<std::int32_t, std::string>& names = {}) {
        meshfiles::write_vtu(mesh, names, folder / "block.vtu");
    }
    Loaded load_text(const std::string& text) const {
        testing::write_bytes(folder / "scene.yaml", text);
        Loaded loaded;
        loaded.scene = read_scene(folder / "scene.yaml");
        SceneShapes shapes;
        for (const Body& body : loaded.scene.bodies)
            shapes.bodies.push_back(meshfiles::read_mesh(body.mesh));
        for (const Bone& bone : loaded.scene.bones) {
            loaded.bones.push_back(meshfiles::read_surface(bone.surface));
            shapes.bones.push_back(bone_of_surface(bone.name, loaded.bones.back()));
        }
        shapes.bone_surfaces = loaded.bones;
        SilentProgress silent;
        loaded.model = build_model(loaded.scene, std::move(shapes), MYOTET_MATERIALS_DIR, silent);
        return loaded;
    }
    Loaded load(const BlockText& text) const { return load_text(text_of(text)); }

    [[nodiscard]] fs::path out() const { return folder / "out"; }
    RunSummary run(Loaded& loaded, RunOptions options, ProgressSink& progress) const {
        if (options.folder.empty()) options.folder = out();
        return run_scene(loaded.scene, loaded.model, loaded.bones, options, progress);
    }
    /// To the end.
    RunSummary run(Loaded& loaded, const RunOptions& options = {}) const {
        SilentProgress silent;
        RunSummary summary = run(loaded, options, silent);
        EXPECT_TRUE(summary.completed) << summary.message;
        return summary;
    }
    RunSummary run(const BlockText& text) const {
        Loaded loaded = load(text);
        return run(loaded);
    }
    /// What a text is refused for, after the file's name: "12: ...".
    std::string refusal_of(const std::string& text) const {
        const std::string file = (folder / "scene.yaml").string() + ":";
        try {
            (void)load_text(text);
        } catch (const InputError& error) {
            const std::string said = error.what();
            EXPECT_EQ(said.substr(0, file.size()), file);
            return said.substr(std::min(file.size(), said.size()));
        }
        return "no refusal";
    }
    std::string refusal(const BlockText& text) const { return refusal_of(text_of(text)); }

    testing::TemporaryFolder folder;
};

/// A column of a history.
inline std::vector<double> column(const History& history, const std::string& name) {
    const auto found = std::ranges::find(history.columns, name, &Column::name);
    EXPECT_NE(found, history.columns.end()) << name;
    std::vector<double> values;
    if (found == history.columns.end()) return values;
    for (const auto& row : history.rows) values.push_back(row[found - history.columns.begin()]);
    return values;
}

/// All files of a folder and their bytes, by their names in it.
inline std::map<std::string, std::string> contents(const fs::path& folder) {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            all[fs::relative(entry.path(), folder).string()] = read_bytes(entry.path());
    return all;
}

}  // namespace myotet::contraction::test
