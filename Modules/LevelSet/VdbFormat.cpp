// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/VdbFormat.h"

#include <openvdb/io/Compression.h>
#include <openvdb/io/io.h>
#include <openvdb/math/Transform.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <set>
#include <sstream>

#include "Core/Errors.h"

namespace myotet::levelset {
namespace {

static_assert(std::endian::native == std::endian::little, "the format's numbers");

constexpr std::string_view kFloatTree = "Tree_float_5_4_3", kHalf = "_HalfFloat";
constexpr std::uint32_t kFirstFormat = openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION;

[[noreturn]] void fail(const std::string& sentence) { throw InputError(sentence); }

/// What is left of the file.
class Cursor {
public:
    explicit Cursor(std::string_view bytes) : all_(bytes) {}

    std::string_view bytes(std::size_t count) {
        if (count > all_.size() - at_)
            fail("it ends where " + std::to_string(count) + " more bytes should follow byte " +
                 std::to_string(at_));
        at_ += count;
        return all_.substr(at_ - count, count);
    }
    template <class T>
    T number() {
        T value;
        std::memcpy(&value, bytes(sizeof value).data(), sizeof value);
        return value;
    }
    std::string text() { return std::string(bytes(number<std::uint32_t>())); }

    [[nodiscard]] std::size_t at() const { return at_; }
    [[nodiscard]] std::string_view rest() const { return all_.substr(at_); }
    void go_on_at(std::int64_t place) {
        if (place < static_cast<std::int64_t>(at_) ||
            place > static_cast<std::int64_t>(all_.size()))
            fail("a grid's end, byte " + std::to_string(place) + ", lies not behind byte " +
                 std::to_string(at_) + " in the file");
        at_ = static_cast<std::size_t>(place);
    }

private:
    std::string_view all_;
    std::size_t at_ = 0;
};

struct Metadata {
    std::map<std::string, std::string> text;
    std::map<std::string, std::int32_t> whole;
};

Metadata read_metadata(Cursor& in) {
    Metadata metadata;
    const auto count = in.number<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::string name = in.text(), type = in.text();
        const std::string value = in.text();  // any type's bytes come behind their number
        if (type == "string") metadata.text[name] = value;
        std::int32_t number = 0;
        if (type != "int32" || value.size() != sizeof number) continue;
        std::memcpy(&number, value.data(), sizeof number);
        metadata.whole[name] = number;
    }
    return metadata;
}

/// OpenVDB knows its kinds of maps; none is longer than a kilobyte.
void read_transform(Cursor& in, VdbGrid& grid) {
    constexpr std::size_t kLongest = 4096;
    std::istringstream map{std::string(in.rest().substr(0, kLongest))};
    map.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    openvdb::io::setCurrentVersion(map);
    openvdb::math::Transform transform;
    try {
        transform.read(map);
        (void)in.bytes(static_cast<std::size_t>(map.tellg()));
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        fail("its transform cannot be read (" + std::string(error.what()) + ")");
    }
    grid.linear = transform.isLinear();
    grid.map_type = transform.mapType();
    if (!grid.linear) return;
    // OpenVDB multiplies rows from the left: the transpose of the usual matrix.
    const openvdb::math::Mat4d m = transform.baseMap()->getAffineMap()->getMat4();
    for (int a = 0; a < 3; ++a) grid.axes[a] = Vec3(m(a, 0), m(a, 1), m(a, 2));
    grid.origin = Vec3(m(3, 0), m(3, 1), m(3, 2));
}

/// One bit a child or a value of a node.
struct Mask {
    std::string_view bytes;
    [[nodiscard]] bool operator[](std::size_t i) const {
        return static_cast<unsigned char>(bytes[i / 8]) >> i % 8 & 1;
    }
    [[nodiscard]] std::size_t count() const {
        std::size_t bits = 0;
        for (const char byte : bytes)
            bits += static_cast<std::size_t>(std::popcount(static_cast<unsigned char>(byte)));
        return bits;
    }
};

Mask read_mask(Cursor& in, int log2_side) {
    return {in.bytes((std::size_t{1} << 3 * log2_side) / 8)};
}

/// How a grid's numbers are packed.
struct Packing {
    std::uint32_t compression = 0;
    bool half = false;
};

/// The size that goes before a packed chunk; none is positive but one of packed bytes.
std::string unpacked(Cursor& in, std::size_t size, const Packing& packing) {
    const bool blosc = packing.compression & openvdb::io::COMPRESS_BLOSC;
    if (!blosc && !(packing.compression & openvdb::io::COMPRESS_ZIP))
        return std::string(in.bytes(size));
    const std::string_view chunk = in.rest();
    const auto count = in.number<std::int64_t>();
    if (count <= 0) {
        if (count != -static_cast<std::int64_t>(size))
            fail("a chunk before byte " + std::to_string(in.at()) + " has another size than its " +
                 std::to_string(size) + " bytes");
        return std::string(in.bytes(size));
    }
    const std::string_view packed = in.bytes(static_cast<std::size_t>(count));
    // Blosc takes the packed size from its own header, which it does not check.
    constexpr std::size_t kBloscHeader = 16, kPackedSize = 12;
    if (blosc) {
        std::uint32_t said = 0;
        if (packed.size() >= kBloscHeader)
            std::memcpy(&said, packed.data() + kPackedSize, sizeof said);
        if (said != packed.size()) fail("a chunk's two sizes do not agree");
    }
    std::istringstream stream{std::string(chunk.substr(0, sizeof count + packed.size()))};
    std::string made(size, '\0');
    try {
        if (blosc)
            openvdb::io::bloscFromStream(stream, made.data(), size);
        else
            openvdb::io::unzipFromStream(stream, made.data(), size);
    } catch (const std::exception& error) {
        fail("a chunk before byte " + std::to_string(in.at()) + " cannot be unpacked (" +
             error.what() + ")");
    }
    return made;
}

std::vector<float> read_numbers(Cursor& in, std::size_t count, const Packing& packing) {
    std::vector<float> numbers(count);
    if (packing.half) {
        if (count == 0) return numbers;  // nothing is written, not even a size
        std::vector<openvdb::math::half> halves(count);
        const std::string bytes = unpacked(in, count * sizeof halves[0], packing);
        std::memcpy(halves.data(), bytes.data(), bytes.size());
        std::ranges::copy(halves, numbers.begin());
    } else {
        const std::string bytes = unpacked(in, count * sizeof numbers[0], packing);
        std::memcpy(numbers.data(), bytes.data(), bytes.size());
    }
    return numbers;
}

/// All values of a node: the active ones as they stand there, where the others
/// are left out, these by one or two numbers and a mask.
std::vector<float> read_values(Cursor& in, const Mask& active, float background,
                               const Packing& packing) {
    using namespace openvdb::io;
    const std::size_t size = 8 * active.bytes.size();
    const auto form = in.number<std::int8_t>();
    if (form < NO_MASK_OR_INACTIVE_VALS || form > NO_MASK_AND_ALL_VALS)
        fail("byte " + std::to_string(in.at() - 1) + " names no form of a node's values");
    float inactive[2] = {form == NO_MASK_OR_INACTIVE_VALS ? background : -background, background};
    const bool two = form == MASK_AND_TWO_INACTIVE_VALS;
    if (form == NO_MASK_AND_ONE_INACTIVE_VAL || form == MASK_AND_ONE_INACTIVE_VAL || two)
        inactive[0] = in.number<float>();
    if (two) inactive[1] = in.number<float>();
    std::optional<Mask> second;
    if (form == MASK_AND_NO_INACTIVE_VALS || form == MASK_AND_ONE_INACTIVE_VAL || two)
        second = Mask{in.bytes(active.bytes.size())};
    if (!(packing.compression & COMPRESS_ACTIVE_MASK) || form == NO_MASK_AND_ALL_VALS)
        return read_numbers(in, size, packing);
    const std::size_t there = active.count();
    const std::vector<float> numbers = read_numbers(in, there, packing);
    if (there == size) return numbers;
    std::vector<float> values(size);
    for (std::size_t i = 0, next = 0; i < size; ++i)
        values[i] = active[i] ? numbers[next++] : inactive[second && (*second)[i]];
    return values;
}

/// The nodes below the root, and which of their voxels lie in leaves.
class Topology {
public:
    Topology(Cursor& in, const Packing& packing, VdbGrid& grid)
        : in_(in), packing_(packing), grid_(grid) {}

    void read() {
        (void)in_.number<std::int32_t>();  // how many buffers there are: one
        grid_.background = in_.number<float>();
        const auto tiles = in_.number<std::uint32_t>(), children = in_.number<std::uint32_t>();
        constexpr std::size_t kTile = 3 * sizeof(std::int32_t) + sizeof(float) + sizeof(bool);
        (void)in_.bytes(kTile * tiles);
        std::set<Index3> seen;
        for (std::uint32_t i = 0; i < children; ++i) {
            Index3 low;
            for (int& x : low) x = in_.number<std::int32_t>();
            // Far enough from the ends of what an index can say.
            constexpr int kSide = 1 << (kLower + kUpper + kLeaf), kFarthest = 1 << 30;
            for (const int x : low)
                if (x % kSide != 0 || x < -kFarthest || x > kFarthest)
                    fail("a node begins at voxel " + std::to_string(x) + ", where none can begin");
            if (!seen.insert(low).second) fail("two nodes begin at one voxel");
            read_node(low, kUpper, kLower + kLeaf);
        }
    }

private:
    static constexpr int kUpper = 5, kLower = 4, kLeaf = 3;  // log2 of children along an axis

    void read_node(const Index3& low, int log2_side, int log2_child) {
        const Mask children = read_mask(in_, log2_side), active = read_mask(in_, log2_side);
        (void)read_values(in_, active, grid_.background, packing_);  // tiles: far from the surface
        const std::size_t size = std::size_t{1} << 3 * log2_side, mask = (1 << log2_side) - 1;
        for (std::size_t n = 0; n < size; ++n) {
            if (!children[n]) continue;
            const std::size_t at[3] = {n >> 2 * log2_side, n >> log2_side & mask, n & mask};
            Index3 child = low;
            for (int a = 0; a < 3; ++a) child[a] += static_cast<int>(at[a] << log2_child);
            if (log2_child > kLeaf) {
                read_node(child, kLower, kLeaf);
            } else {
                (void)read_mask(in_, kLeaf);  // stands once more before the values
                grid_.leaves.push_back(child);
            }
        }
    }

    Cursor& in_;
    const Packing& packing_;
    VdbGrid& grid_;
};

void read_leaves(Cursor& in, const Packing& packing, VdbGrid& grid) {
    grid.values.reserve(grid.leaves.size() * VdbGrid::kLeafSize);
    for (std::size_t leaf = 0; leaf < grid.leaves.size(); ++leaf) {
        const Mask active = read_mask(in, 3);
        const std::vector<float> values = read_values(in, active, grid.background, packing);
        grid.values.insert(grid.values.end(), values.begin(), values.end());
    }
}

VdbGrid read_grid(Cursor& in, bool has_offsets) {
    VdbGrid grid;
    (void)in.text();  // the unique name; the metadata have the user's
    grid.type = in.text();
    const std::string shares = in.text();
    (void)in.number<std::int64_t>();
    (void)in.number<std::int64_t>();
    const auto end = in.number<std::int64_t>();
    Packing packing{.compression = in.number<std::uint32_t>()};
    packing.half = grid.type.ends_with(kHalf);
    if (packing.half) grid.type.resize(grid.type.size() - kHalf.size());
    Metadata metadata = read_metadata(in);
    grid.text = std::move(metadata.text);
    grid.whole = std::move(metadata.whole);
    read_transform(in, grid);
    grid.has_samples = grid.type == kFloatTree && shares.empty();
    if (grid.has_samples) {
        Topology(in, packing, grid).read();
        read_leaves(in, packing, grid);
    } else if (has_offsets) {
        in.go_on_at(end);
    } else if (shares.empty()) {
        fail("a grid of type " + grid.type + " cannot be passed over, as the file says no offsets");
    }
    return grid;
}

}  // namespace

std::vector<VdbGrid> parse_vdb(std::string_view bytes) {
    openvdb::initialize();  // the kinds of transforms
    Cursor in(bytes);
    constexpr std::int64_t kMagic = openvdb::OPENVDB_MAGIC;
    if (bytes.size() < sizeof kMagic || in.number<std::int64_t>() != kMagic)
        fail("it does not begin as an OpenVDB file does");
    const auto format = in.number<std::uint32_t>();
    if (format < kFirstFormat || format > openvdb::OPENVDB_FILE_VERSION)
        fail("its format is " + std::to_string(format) + "; " + std::to_string(kFirstFormat) +
             " to " + std::to_string(openvdb::OPENVDB_FILE_VERSION) + " are read");
    constexpr std::size_t kLibraryVersion = 2 * sizeof(std::uint32_t), kIdentifier = 36;
    (void)in.bytes(kLibraryVersion);
    const bool has_offsets = in.number<char>() != 0;
    (void)in.bytes(kIdentifier);
    (void)read_metadata(in);
    const auto count = in.number<std::int32_t>();
    std::vector<VdbGrid> grids;
    for (std::int32_t i = 0; i < count; ++i) grids.push_back(read_grid(in, has_offsets));
    return grids;
}

}  // namespace myotet::levelset
