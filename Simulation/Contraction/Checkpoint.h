// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace myotet::contraction {

/// Where a simulation stands, to go on from there.
struct Checkpoint {
    std::string fingerprint;  ///< of the scene and its inputs, as fingerprint(Scene) says
    double time = 0;          ///< s
    std::map<std::string, std::vector<double>> reals;
    std::map<std::string, std::vector<std::int64_t>> integers;

    /// The array of this name. Throws InputError when there is none or it has
    /// another length.
    [[nodiscard]] const std::vector<double>& reals_of(const std::string& name,
                                                      std::size_t length) const;
    [[nodiscard]] const std::vector<std::int64_t>& integers_of(const std::string& name,
                                                               std::size_t length) const;
};

/// Writes a checkpoint, bit for bit: "MYOTETCP", version, byte order, the
/// fingerprint, time, arrays with their names and lengths, and the SHA-256 of
/// all that. Throws IoError.
void write_checkpoint(const Checkpoint& checkpoint, const std::filesystem::path& file);

/// Reads one back. Throws IoError when it cannot be read or is cut short or
/// damaged, InputError when it is no checkpoint, of another version or byte
/// order, or belongs to another fingerprint than this.
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& file,
                                         const std::string& fingerprint);

}  // namespace myotet::contraction
