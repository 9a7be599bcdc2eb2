// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "Contraction/Scene.h"
#include "Core/Errors.h"
#include "Support/TemporaryFolder.h"

namespace myotet::contraction {

/// A folder with files that scenes may name, and a scene in it.
struct SceneFolder {
    SceneFolder() {
        for (const char* name : {"arm.nii.gz", "names.txt", "biceps.vtu", "humerus.vtu",
                                 "radius.stl", "fibres.nii.gz", "solid.bspline"})
            testing::write_bytes(folder / name, name);
        testing::write_bytes(folder / "emg.csv", "time,biceps,b\n0,0,0.5\n1,0.8,0.25\n");
        testing::write_bytes(folder / "recipe.yaml", "steps:\n  - clip: biceps\n");
    }
    Scene read(const std::string& text) const {
        testing::write_bytes(folder / "scene.yaml", text);
        return read_scene(folder / "scene.yaml");
    }
    /// What a text is refused for, after the file's name: "12: ...".
    std::string refusal(const std::string& text) const {
        try {
            (void)read(text);
        } catch (const Error& error) {
            const std::string said = error.what(), file = (folder / "scene.yaml").string() + ":";
            EXPECT_EQ(said.substr(0, file.size()), file) << text;
            return said.substr(std::min(file.size(), said.size()));
        }
        return "no refusal";
    }
    testing::TemporaryFolder folder;
};

}  // namespace myotet::contraction
