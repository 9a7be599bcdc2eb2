// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "Skeleton/Model.h"
#include "Skeleton/OsimFile.h"
#include "Skeleton/OsimFrames.h"

namespace myotet::skeleton {

/// A model while its file is read, each part after the ones above it.
struct OsimModel {
    explicit OsimModel(const OsimFile& its_file) : file(its_file), frames(its_file) {}

    const OsimFile& file;
    OsimFrames frames;
    Model model;
    std::map<std::string, int> coordinates;
    /// Kinds of things that are not taken into account, and the names of such.
    std::map<std::string, std::vector<std::string>> ignored;
};

void read_osim_bodies(OsimModel& m);
void read_osim_joints(OsimModel& m);
void read_osim_wraps(OsimModel& m);
void read_osim_muscles(OsimModel& m);

/// The coordinate that a name or path means. Throws InputError at the element.
[[nodiscard]] int find_coordinate(const OsimModel& m, const XmlElement& at,
                                  const std::string& named);

}  // namespace myotet::skeleton
