// SPDX-License-Identifier: Apache-2.0
// Own parser, because HDF5 1.10 reads past the end of some damaged files. It
// knows what HDF5 writes by default: superblock 0 or 1, groups of symbol tables,
// object headers 1, contiguous numbers ("HDF5 File Format Specification",
// version 1; offsets below are that document's).
#include <algorithm>
#include <fstream>
#include <optional>

#include "Core/Errors.h"
#include "MeshFiles/Hdf5.h"
#include "MeshFiles/Numbers.h"

namespace myotet::meshfiles {
namespace {

constexpr std::uint64_t kNowhere = ~std::uint64_t{0};
/// More parts of headers and groups than this no file of tables has: the parts
/// of a damaged one may name each other without end.
constexpr int kMostParts = 10'000;

/// Bytes of a file with numbers in them, little end first.
class Bytes {
public:
    Bytes(std::string bytes, const std::string& where) : bytes_(std::move(bytes)), where_(where) {}
    [[nodiscard]] std::uint64_t number(std::size_t at, std::size_t size) const {
        const std::string_view found = text(at, size);
        std::uint64_t value = 0;
        for (std::size_t i = size; i-- > 0;)
            value = value << 8 | static_cast<unsigned char>(found[i]);
        return value;
    }
    [[nodiscard]] std::string_view text(std::size_t at, std::size_t size) const {
        if (at > bytes_.size() || size > bytes_.size() - at)
            throw InputError(where_ +
                             "has a part that is too short; the file is damaged, write it again");
        return std::string_view(bytes_).substr(at, size);
    }
    [[nodiscard]] std::size_t size() const { return bytes_.size(); }

private:
    std::string bytes_;
    const std::string& where_;
};

/// What an object header says.
struct Header {
    std::optional<std::uint64_t> tree, heap;  ///< of a group
    std::vector<std::uint64_t> shape;         ///< of a dataset
    bool has_shape = false, contiguous = false, big_endian = false;
    std::optional<NumberKind> kind;
    std::uint64_t address = kNowhere, size = 0;
};

std::optional<NumberKind> kind_of(int type, bool has_sign, std::uint64_t size) {
    const int places[] = {1, 2, 4, 8};
    const auto place = std::ranges::find(places, static_cast<int>(size)) - places;
    if (type == 1 && (size == 4 || size == 8))
        return size == 4 ? NumberKind::float32 : NumberKind::float64;
    if (type != 0 || place == 4 || size > 8) return {};
    return static_cast<NumberKind>(2 * place + (has_sign ? 0 : 1));
}

std::uint64_t width_of(NumberKind kind) {
    if (kind == NumberKind::float32 || kind == NumberKind::float64)
        return kind == NumberKind::float32 ? 4 : 8;
    return 1u << (static_cast<int>(kind) / 2);
}

class Hdf5File {
public:
    Hdf5File(const std::filesystem::path& file, const std::string& where)
        : where_(where), in_(file, std::ios::binary | std::ios::ate) {
        size_ = in_ ? static_cast<std::uint64_t>(in_.tellg()) : 0;
        if (!in_ || std::filesystem::is_directory(file))
            throw IoError(where_ +
                          "cannot be read; keep the .h5 beside its .xdmf, or write both again");
        const Bytes start = bytes(0, 96);
        const std::uint64_t version = start.number(8, 1);
        if (start.text(0, 8) != "\x89HDF\r\n\x1a\n" || version > 1 || start.number(13, 1) != 8 ||
            start.number(14, 1) != 8)
            fail("is not in a file that HDF5 wrote in its oldest format, the only one read");
        root_ = start.number(version == 0 ? 64 : 68, 8);
        if (start.number(version == 0 ? 24 : 28, 8) != 0)
            fail("does not begin where its file does");
    }

    /// The dataset at a path of names.
    Header find(std::string_view path) {
        std::uint64_t address = root_;
        while (true) {
            const std::size_t from = path.find_first_not_of('/');
            if (from == std::string_view::npos) return header_at(address);
            path.remove_prefix(from);
            const std::string_view name = path.substr(0, path.find('/'));
            path.remove_prefix(name.size());
            const Header group = header_at(address);
            if (!group.tree || !group.heap) fail("is sought in what is no group");
            const Bytes heap = bytes(*group.heap, 32);
            require_mark(heap, "HEAP");
            const auto found =
                entry_in_tree(*group.tree, bytes(heap.number(24, 8), heap.number(8, 8)), name, 256);
            if (!found)
                throw IoError(where_ +
                              "is not there; keep the .h5 beside its .xdmf, or write both again");
            address = *found;
        }
    }

    /// All its numbers; their bytes are as many as its shape says.
    std::string numbers_of(const Header& dataset) {
        const std::uint64_t rows = dataset.shape[0],
                            columns = dataset.shape.size() == 1 ? 1 : dataset.shape[1];
        if (rows == 0) return {};
        const std::uint64_t row = columns * width_of(*dataset.kind);
        if (dataset.size % row != 0 || dataset.size / row != rows)
            fail("has not as many numbers as its shape says");
        return std::string(bytes(dataset.address, dataset.size).text(0, dataset.size));
    }
    [[noreturn]] void fail(const std::string& defect) const {
        throw InputError(where_ + defect + "; the file is damaged or not a mesh, write it again");
    }

private:
    Bytes bytes(std::uint64_t at, std::uint64_t size) {
        if (at > size_ || size > size_ - at)
            throw IoError(where_ +
                          "lies behind the end of its file; the file is cut short, copy or "
                          "write it again");
        std::string found(size, '\0');
        in_.seekg(static_cast<std::streamoff>(at));
        if (!in_.read(found.data(), static_cast<std::streamsize>(size)))
            throw IoError(where_ + "cannot be read");
        return {std::move(found), where_};
    }
    void require_mark(const Bytes& part, std::string_view mark) {
        if (part.text(0, 4) != mark) fail("has a part without its mark " + std::string(mark));
        if (++parts_ > kMostParts) fail("has too many parts");
    }

    /// III.A.1: a B-tree of names; `above`: the level of its parent.
    std::optional<std::uint64_t> entry_in_tree(std::uint64_t address, const Bytes& names,
                                               std::string_view name, std::uint64_t above) {
        const Bytes node = bytes(address, 24);
        require_mark(node, "TREE");
        const std::uint64_t level = node.number(5, 1), count = node.number(6, 2);
        if (level >= above) fail("has a list of names that goes in circles");
        const Bytes entries = bytes(address + 24, 16 * count);
        for (std::uint64_t e = 0; e < count; ++e) {
            const std::uint64_t child = entries.number(16 * e + 8, 8);
            const auto found = level == 0 ? entry_in_node(child, names, name)
                                          : entry_in_tree(child, names, name, level);
            if (found) return found;
        }
        return {};
    }
    /// III.B, III.C: 40 bytes an entry, the name's place first, then the object's.
    std::optional<std::uint64_t> entry_in_node(std::uint64_t address, const Bytes& names,
                                               std::string_view name) {
        const Bytes head = bytes(address, 8);
        require_mark(head, "SNOD");
        const std::uint64_t count = head.number(6, 2);
        const Bytes entries = bytes(address + 8, 40 * count);
        for (std::uint64_t e = 0; e < count; ++e) {
            const std::uint64_t place = entries.number(40 * e, 8);
            if (place < names.size() && names.size() - place > name.size() &&
                names.text(place, name.size()) == name && names.number(place + name.size(), 1) == 0)
                return entries.number(40 * e + 8, 8);
        }
        return {};
    }

    /// IV.A.1.a: messages, which may go on elsewhere.
    Header header_at(std::uint64_t address) {
        const Bytes prefix = bytes(address, 16);
        if (prefix.number(0, 1) != 1) fail("has a header of an unknown version");
        struct Block {
            std::uint64_t at, size;
        };
        std::vector<Block> blocks{{address + 16, prefix.number(8, 4)}};
        Header header;
        for (std::size_t b = 0; b < blocks.size(); ++b) {
            if (++parts_ > kMostParts) fail("has too many parts");
            const Bytes block = bytes(blocks[b].at, blocks[b].size);
            for (std::size_t at = 0; at + 8 <= block.size();) {
                const std::uint64_t type = block.number(at, 2), size = block.number(at + 2, 2);
                if ((block.number(at + 4, 1) & 2) != 0) fail("shares parts of its header");
                const Bytes message(std::string(block.text(at + 8, size)), where_);
                if (type == 0x10)
                    blocks.push_back({message.number(0, 8), message.number(8, 8)});
                else
                    take(message, type, header);
                at += 8 + size;
            }
        }
        return header;
    }
    /// IV.A.2: dataspace, datatype, data layout and symbol table.
    void take(const Bytes& message, std::uint64_t type, Header& header) const {
        if (type == 1) {
            const std::uint64_t first = message.number(0, 1) == 1 ? 8 : 4;
            for (std::uint64_t d = 0; d < message.number(1, 1); ++d)
                header.shape.push_back(message.number(first + 8 * d, 8));
            header.has_shape = true;
        } else if (type == 3) {
            const std::uint64_t bits = message.number(1, 1);
            header.big_endian = (bits & 1) != 0;
            header.kind = kind_of(static_cast<int>(message.number(0, 1) & 15), (bits & 8) != 0,
                                  message.number(4, 4));
        } else if (type == 8 && message.number(0, 1) >= 3) {
            header.contiguous = message.number(1, 1) == 1;
            if (!header.contiguous) return;
            header.address = message.number(2, 8);
            header.size = message.number(10, 8);
        } else if (type == 0x11) {
            header.tree = message.number(0, 8);
            header.heap = message.number(8, 8);
        }
    }

    const std::string& where_;
    std::ifstream in_;
    std::uint64_t size_ = 0, root_ = 0;
    int parts_ = 0;
};

struct Found {
    std::string bytes;
    NumberKind kind = NumberKind::float64;
    bool big_endian = false;
};
Found read_dataset(const std::filesystem::path& file, const std::string& dataset,
                   std::int64_t columns) {
    const std::string where = file.string() + ": dataset '" + dataset + "' ";
    Hdf5File in(file, where);
    const Header header = in.find(dataset);
    if (!header.has_shape || !header.kind || !header.contiguous)
        in.fail("holds no numbers of at most 64 bits that lie one after another");
    const auto rank = header.shape.size();
    if ((rank != 1 && rank != 2) ||
        (rank == 1 ? 1 : header.shape[1]) != static_cast<std::uint64_t>(columns))
        in.fail("has not " + std::to_string(columns) + " columns");
    return {in.numbers_of(header), *header.kind, header.big_endian};
}

}  // namespace

std::vector<double> read_reals(const std::filesystem::path& file, const std::string& dataset,
                               std::int64_t columns) {
    const Found found = read_dataset(file, dataset, columns);
    return reals_in(found.bytes, found.kind, found.big_endian);
}

std::vector<std::int64_t> read_integers(const std::filesystem::path& file,
                                        const std::string& dataset, std::int64_t columns) {
    const Found found = read_dataset(file, dataset, columns);
    if (found.kind == NumberKind::float32 || found.kind == NumberKind::float64)
        throw InputError(file.string() + ": dataset '" + dataset +
                         "' holds real numbers where integers are needed; the file is damaged or "
                         "not a mesh, write it again");
    return integers_in(found.bytes, found.kind, found.big_endian);
}

}  // namespace myotet::meshfiles
