// SPDX-License-Identifier: Apache-2.0
// VTK XML file formats, "Binary data": an array is its length and its bytes, or
// [blocks][bytes a block][bytes of the last block, 0 when it is full][compressed
// bytes of each] and the blocks. The lengths may be in a base64 text of their own.
#include "MeshFiles/VtkBytes.h"

#include <vtkCallbackCommand.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <array>
#include <vector>

#include "Core/Errors.h"

namespace myotet::meshfiles {
namespace {

constexpr unsigned char kNoDigit = 64;

constexpr std::array<unsigned char, 256> make_base64_digits() {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<unsigned char, 256> digits{};
    digits.fill(kNoDigit);
    for (std::size_t i = 0; i < kDigits.size(); ++i)
        digits[static_cast<unsigned char>(kDigits[i])] = static_cast<unsigned char>(i);
    return digits;
}

/// Bytes one after another, whichever way they are written.
class Source {
public:
    Source(std::string_view from, bool base64, const VtkStorage& storage, const std::string& where)
        : from_(from), base64_(base64), storage_(storage), where_(where) {}

    /// Valid until the next call.
    std::string_view take(std::uint64_t count) {
        if (count > most_left()) fail_short();
        if (base64_) return decode(count);
        const std::string_view taken = from_.substr(0, count);
        from_.remove_prefix(count);
        return taken;
    }
    std::uint64_t length() {
        const std::string_view bytes = take(storage_.header_bytes);
        std::array<unsigned char, 8> raw{};
        std::ranges::copy(bytes, raw.begin());
        if (storage_.big_endian)
            std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(bytes.size()));
        std::uint64_t value = 0;
        for (std::size_t i = raw.size(); i-- > 0;) value = value << 8 | raw[i];
        return value;
    }
    /// More bytes than these cannot follow.
    [[nodiscard]] std::uint64_t most_left() const {
        return base64_ ? ready_.size() + from_.size() / 4 * 3 : from_.size();
    }
    [[noreturn]] void fail_short() const {
        throw IoError(where_ + " ends too early; the file is cut short, copy or export it again");
    }
    [[noreturn]] void fail(const std::string& defect) const {
        throw InputError(where_ + " " + defect + "; the file is damaged, export it again");
    }

private:
    std::string_view decode(std::uint64_t count) {
        taken_.swap(ready_);
        ready_.clear();
        while (taken_.size() < count) decode_group();
        ready_.assign(taken_, count);
        taken_.resize(count);
        return taken_;
    }
    /// Four letters are three bytes; a text's last group may be filled up with =.
    void decode_group() {
        static constexpr auto kDigits = make_base64_digits();
        std::uint32_t bits = 0;
        int digits = 0, fillers = 0;
        while (digits + fillers < 4) {
            if (from_.empty()) fail_short();
            const char letter = from_.front();
            from_.remove_prefix(1);
            if (letter == ' ' || letter == '\n' || letter == '\r' || letter == '\t') continue;
            const unsigned char digit = kDigits[static_cast<unsigned char>(letter)];
            if (letter == '=' && digits >= 2)
                ++fillers;
            else if (digit == kNoDigit || fillers > 0)
                fail("is not in base64");
            else
                bits |= static_cast<std::uint32_t>(digit) << (18 - 6 * digits++);
        }
        for (int i = 0; i < digits - 1; ++i)
            taken_.push_back(static_cast<char>(bits >> (16 - 8 * i) & 0xff));
    }

    std::string_view from_;
    bool base64_;
    const VtkStorage& storage_;
    const std::string& where_;
    std::string taken_, ready_;  ///< decoded: handed out; not yet
};

/// VTK's compressor, which complains to nobody.
template <class Compressor>
std::size_t uncompress(std::string_view from, char* to, std::size_t size) {
    vtkNew<Compressor> compressor;
    vtkNew<vtkCallbackCommand> hear;  // an observed error is not printed
    compressor->AddObserver(vtkCommand::ErrorEvent, hear);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // but logged all the same
    return compressor->Uncompress(reinterpret_cast<const unsigned char*>(from.data()), from.size(),
                                  reinterpret_cast<unsigned char*>(to), size);
}

struct Method {
    std::size_t (*uncompress)(std::string_view, char*, std::size_t);
    std::uint64_t most;  ///< bytes that one compressed byte can stand for
};
Method method_of(VtkStorage::Compressor compressor) {
    if (compressor == VtkStorage::Compressor::lz4) return {uncompress<vtkLZ4DataCompressor>, 256};
    if (compressor == VtkStorage::Compressor::lzma)
        return {uncompress<vtkLZMADataCompressor>, 10'000};
    return {uncompress<vtkZLibDataCompressor>, 1'040};
}

std::string uncompressed(Source& source, const VtkStorage& storage) {
    const Method method = method_of(storage.compressor);
    const std::uint64_t blocks = source.length(), size = source.length(), last = source.length();
    if (blocks > source.most_left() / storage.header_bytes) source.fail_short();
    std::vector<std::uint64_t> stored(blocks);
    for (std::uint64_t& bytes : stored) bytes = source.length();
    std::string bytes;
    for (std::size_t b = 0; b < stored.size(); ++b) {
        const std::string_view block = source.take(stored[b]);
        const std::uint64_t count = b + 1 == stored.size() && last > 0 ? last : size;
        if (count / method.most > block.size() || last > size)
            source.fail("says a length that its bytes cannot have");
        const std::size_t begin = bytes.size();
        bytes.resize(begin + count);
        if (method.uncompress(block, bytes.data() + begin, count) != count)
            source.fail("cannot be uncompressed");
    }
    return bytes;
}

}  // namespace

std::string vtk_array_bytes(std::string_view from, bool base64, const VtkStorage& storage,
                            const std::string& where) {
    Source source(from, base64, storage, where);
    if (storage.compressor != VtkStorage::Compressor::none) return uncompressed(source, storage);
    const std::uint64_t count = source.length();
    return std::string(source.take(count));
}

}  // namespace myotet::meshfiles
