// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Contraction/Measure.h"
#include "Report/Picture.h"

namespace myotet::app {

inline constexpr std::size_t kSheetPictures = 12;
inline constexpr const char* kSheetFile = "pictures/contraction.png";

/// The box around all bodies at rest and all bones wherever the scene takes them at output
/// times, a little larger: the same for each frame, so that pictures do not jump.
[[nodiscard]] Box box_of_run(const contraction::Scene& scene, const contraction::Model& model,
                             std::span<const TriMesh> bones);

/// A frame from the patient's front and, to its right, from the patient's left; muscles and
/// tendons coloured by fibre stretch from 0.6 to 1.4, bodies without fibres grey, bones ivory.
[[nodiscard]] report::Picture frame_picture(const contraction::Moment& frame,
                                            std::span<const TriMesh> bones, const Box& fit);

/// Writes pictures/frame_0000.png, by the frame's number, into a folder of results. Throws
/// IoError.
void write_picture(const report::Picture& picture, const std::filesystem::path& folder,
                   std::size_t number);

/// Writes a sheet, pictures/contraction.png: up to kSheetPictures of the pictures of `frames`
/// frames, the first, the last and evenly between. Pictures that are not there, of frames before a
/// checkpoint that were not drawn then, are left out. Returns the pictures that are there,
/// the sheet last, relative to the folder. Throws IoError.
[[nodiscard]] std::vector<std::filesystem::path> write_contact_sheet(
    const std::filesystem::path& folder, std::size_t frames, const char* sheet = kSheetFile);

}  // namespace myotet::app
