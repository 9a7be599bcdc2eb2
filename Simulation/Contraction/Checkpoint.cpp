// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Checkpoint.h"

#include <cstring>
#include <string_view>

#include "Contraction/Words.h"
#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "Core/Sha256.h"

namespace myotet::contraction {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view kMagic = "MYOTETCP";
constexpr std::uint32_t kVersion = 1;
constexpr std::uint32_t kByteOrder = 0x01020304;
constexpr std::size_t kSumLength = 64;  // of SHA-256 in hexadecimal digits

template <class Number>
void put(std::string& bytes, Number number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

template <class Number>
void put(std::string& bytes, const std::map<std::string, std::vector<Number>>& arrays) {
    put(bytes, static_cast<std::uint64_t>(arrays.size()));
    for (const auto& [name, values] : arrays) {
        put(bytes, static_cast<std::uint64_t>(name.size()));
        bytes += name;
        put(bytes, static_cast<std::uint64_t>(values.size()));
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number));
    }
}

[[noreturn]] void fail_damaged(const fs::path& file) {
    throw IoError(file.string() +
                  ": is cut short or damaged; go on from another checkpoint, or begin again");
}

/// Takes bytes from the front of what is left.
struct Bytes {
    std::string_view left;
    const fs::path& file;

    std::string_view take(std::uint64_t count) {
        if (count > left.size()) fail_damaged(file);
        const std::string_view taken = left.substr(0, count);
        left.remove_prefix(count);
        return taken;
    }
    template <class Number>
    Number number() {
        Number value{};
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    template <class Number>
    std::map<std::string, std::vector<Number>> arrays() {
        std::map<std::string, std::vector<Number>> all;
        for (auto count = number<std::uint64_t>(); count > 0; --count) {
            const std::string name(take(number<std::uint64_t>()));
            const auto length = number<std::uint64_t>();
            if (length > left.size() / sizeof(Number)) fail_damaged(file);
            std::vector<Number>& values = all[name];
            values.resize(length);
            const std::string_view raw = take(length * sizeof(Number));
            if (length > 0) std::memcpy(values.data(), raw.data(), raw.size());
        }
        return all;
    }
};

void check_kind(Bytes& bytes) {
    const std::string name = bytes.file.string();
    if (!bytes.left.starts_with(kMagic))
        throw InputError(name + ": is no checkpoint of Myotet; name one that it wrote");
    bytes.take(kMagic.size());
    const auto version = bytes.number<std::uint32_t>();
    const auto order = bytes.number<std::uint32_t>();
    if (order != kByteOrder)
        throw InputError(name + ": was written on a machine of another byte order; go on there");
    if (version != kVersion)
        throw InputError(name + ": is a checkpoint of version " + std::to_string(version) +
                         ", but this Myotet reads " + std::to_string(kVersion) +
                         "; go on with the Myotet that wrote it");
}

template <class Number>
const std::vector<Number>& array_of(const std::map<std::string, std::vector<Number>>& arrays,
                                    const std::string& name, std::size_t length) {
    const auto found = arrays.find(name);
    if (found == arrays.end())
        throw InputError("the checkpoint has no array '" + name + "'; begin again without it");
    if (found->second.size() != length)
        throw InputError("the checkpoint's array '" + name + "' has " +
                         std::to_string(found->second.size()) + " numbers, but " +
                         std::to_string(length) + " are needed; begin again without it");
    return found->second;
}

}  // namespace

const std::vector<double>& Checkpoint::reals_of(const std::string& name, std::size_t length) const {
    return array_of(reals, name, length);
}

const std::vector<std::int64_t>& Checkpoint::integers_of(const std::string& name,
                                                         std::size_t length) const {
    return array_of(integers, name, length);
}

void write_checkpoint(const Checkpoint& checkpoint, const fs::path& file) {
    MYOTET_CHECK(checkpoint.fingerprint.size() == kSumLength, "a fingerprint is a SHA-256");
    std::string bytes(kMagic);
    put(bytes, kVersion);
    put(bytes, kByteOrder);
    bytes += checkpoint.fingerprint;
    put(bytes, checkpoint.time);
    put(bytes, checkpoint.reals);
    put(bytes, checkpoint.integers);
    bytes += sha256(bytes);
    write_atomically(file, bytes);
}

Checkpoint read_checkpoint(const fs::path& file, const std::string& fingerprint) {
    const std::string content = read_whole(file);
    Bytes bytes{content, file};
    check_kind(bytes);
    if (bytes.left.size() < 2 * kSumLength) fail_damaged(file);
    const std::size_t whole = content.size() - kSumLength;
    if (sha256(std::string_view(content).substr(0, whole)) != content.substr(whole))
        fail_damaged(file);
    bytes.left.remove_suffix(kSumLength);
    Checkpoint checkpoint;
    checkpoint.fingerprint = bytes.take(kSumLength);
    if (checkpoint.fingerprint != fingerprint)
        throw InputError(file.string() +
                         ": belongs to another scene, or the scene or a file that it reads was "
                         "changed since; put them back as they were, or begin again without the "
                         "checkpoint");
    checkpoint.time = bytes.number<double>();
    checkpoint.reals = bytes.arrays<double>();
    checkpoint.integers = bytes.arrays<std::int64_t>();
    if (!bytes.left.empty()) fail_damaged(file);
    return checkpoint;
}

}  // namespace myotet::contraction
