// SPDX-License-Identifier: Apache-2.0
#include "MeshFiles/Npz.h"

#include <array>
#include <bit>
#include <set>
#include <string_view>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"

namespace myotet::meshfiles {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie");

// The check sum of zip archives, a byte at a time: the polynomial 0xEDB88320, reflected.
std::uint32_t crc32(std::string_view bytes) {
    static const std::array<std::uint32_t, 256> table = [] {
        std::array<std::uint32_t, 256> t{};
        for (std::uint32_t i = 0; i < 256; ++i) {
            t[i] = i;
            for (int k = 0; k < 8; ++k) t[i] = (t[i] & 1 ? 0xEDB88320u : 0u) ^ (t[i] >> 1);
        }
        return t;
    }();
    std::uint32_t crc = 0xFFFFFFFFu;
    for (const char c : bytes)
        crc = table[(crc ^ static_cast<unsigned char>(c)) & 255] ^ (crc >> 8);
    return ~crc;
}

template <class... Numbers>
void put(std::string& out, Numbers... numbers) {
    (out.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
}

// Magic, version, the header's length, a dictionary padded so that numbers begin at 64 bytes.
std::string npy(const NpzArray& array) {
    std::string body;
    const char* kind = std::holds_alternative<std::vector<double>>(array.values) ? "<f8" : "<i4";
    const std::size_t count = std::visit(
        [&](const auto& v) {
            body.assign(reinterpret_cast<const char*>(v.data()), v.size() * sizeof v[0]);
            return v.size();
        },
        array.values);
    if (array.columns == 0 || count % array.columns != 0)
        throw MeshError("array '" + array.name + "' has " + std::to_string(count) +
                        " numbers, which are no whole rows of " + std::to_string(array.columns));
    const std::string rows = std::to_string(count / array.columns);
    std::string header =
        std::string("{'descr': '") + kind + "', 'fortran_order': False, 'shape': (" + rows +
        (array.columns == 1 ? ",)" : ", " + std::to_string(array.columns) + ")") + ", }";
    constexpr std::size_t kBefore = 10, kAligned = 64;
    header.append((kAligned - (kBefore + header.size() + 1) % kAligned) % kAligned, ' ');
    header += '\n';
    std::string out("\x93NUMPY\x01\x00", 8);
    put(out, static_cast<std::uint16_t>(header.size()));
    return out + header + body;
}

// What an entry's own header and the archive's directory say alike: version 2.0, no flags,
// stored, the first of January 1980, check sum and sizes, length of the name, nothing more.
void put_facts(std::string& out, const std::string& name, const std::string& bytes) {
    const auto size = static_cast<std::uint32_t>(bytes.size());
    put(out, std::uint16_t{20}, std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0},
        std::uint16_t{0x21}, crc32(bytes), size, size, static_cast<std::uint16_t>(name.size()),
        std::uint16_t{0});
}

}  // namespace

void write_npz(std::span<const NpzArray> arrays, const std::filesystem::path& file) {
    std::string out, directory;
    std::set<std::string> names;
    for (const NpzArray& array : arrays) {
        if (array.name.empty() || !names.insert(array.name).second)
            throw MeshError("arrays of an .npz need names, each its own; '" + array.name +
                            "' is none");
        const std::string name = array.name + ".npy", bytes = npy(array);
        if (out.size() + bytes.size() > 0xFFFF0000u)
            throw ResourceError(file.string() + ": an .npz of more than 4 GB is not written");
        put(directory, std::uint32_t{0x02014b50}, std::uint16_t{20});
        put_facts(directory, name, bytes);
        put(directory, std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0}, std::uint32_t{0},
            static_cast<std::uint32_t>(out.size()));
        directory += name;
        put(out, std::uint32_t{0x04034b50});
        put_facts(out, name, bytes);
        out += name + bytes;
    }
    const auto at = static_cast<std::uint32_t>(out.size());
    const auto count = static_cast<std::uint16_t>(arrays.size());
    out += directory;
    put(out, std::uint32_t{0x06054b50}, std::uint16_t{0}, std::uint16_t{0}, count, count,
        static_cast<std::uint32_t>(directory.size()), at, std::uint16_t{0});
    write_atomically(file, out);
}

}  // namespace myotet::meshfiles
