// SPDX-License-Identifier: Apache-2.0
// Own parser, because VTK 9.1's ends the program on some damaged files.
#include "MeshFiles/VtkFile.h"

#include <algorithm>
#include <charconv>
#include <pugixml.hpp>

#include "Core/Errors.h"
#include "Core/Text.h"
#include "MeshFiles/RawMesh.h"

namespace myotet::meshfiles {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

}  // namespace

VtkFile::VtkFile(std::string_view content, const std::filesystem::path& file, const char* type)
    : content_(content),
      file_(file),
      document_(std::make_unique<pugi::xml_document>()),
      type_(type) {
    parse(split_from_appended());
    const pugi::xml_node root = document_->child("VTKFile");
    if (!root) fail(0, "begins no VTKFile");
    const std::string_view said = root.attribute("type").value();
    if (said != type)
        refuse(root, "is of type '" + std::string(said) + "', but " + type + " is needed");
    read_storage(root);
}

VtkFile::~VtkFile() = default;

pugi::xml_node VtkFile::grid() const { return document_->child("VTKFile").child(type_); }

/// The tags without the bytes that may follow them, which are kept.
std::string VtkFile::split_from_appended() {
    const std::size_t tag = content_.find("<AppendedData");
    if (tag == std::string_view::npos) return std::string(content_);
    const std::size_t begin = content_.find('>', tag);
    const std::size_t end = content_.rfind("</AppendedData");
    if (begin == std::string_view::npos || end == std::string_view::npos || end < begin)
        throw IoError(file_.string() +
                      ": ends before its <AppendedData> does; the file is cut short, copy or "
                      "export it again");
    appended_ = content_.substr(begin + 1, end - begin - 1);
    const std::size_t mark = appended_.find_first_not_of(kBlank);
    if (mark == std::string_view::npos || appended_[mark] != '_')
        fail(static_cast<std::ptrdiff_t>(tag), "begins an <AppendedData> without its '_'");
    appended_.remove_prefix(mark + 1);
    return std::string(content_.substr(0, begin + 1)).append(content_.substr(end));
}

void VtkFile::parse(std::string tags) {
    tags_ = std::move(tags);
    const auto result = document_->load_buffer_inplace(tags_.data(), tags_.size(),
                                                       pugi::parse_default, pugi::encoding_utf8);
    if (!result)
        fail(result.offset, std::string("is not valid XML (") + result.description() + ")");
}

void VtkFile::read_storage(const pugi::xml_node& root) {
    using Compressor = VtkStorage::Compressor;
    static constexpr std::pair<std::string_view, Compressor> kCompressors[] = {
        {"", Compressor::none},
        {"vtkZLibDataCompressor", Compressor::zlib},
        {"vtkLZ4DataCompressor", Compressor::lz4},
        {"vtkLZMADataCompressor", Compressor::lzma}};
    static constexpr std::pair<std::string_view, std::size_t> kHeaders[] = {
        {"", 4}, {"UInt32", 4}, {"UInt64", 8}};
    static constexpr std::pair<std::string_view, bool> kOrders[] = {
        {"", false}, {"LittleEndian", false}, {"BigEndian", true}};
    static constexpr std::pair<std::string_view, bool> kEncodings[] = {
        {"", true}, {"base64", true}, {"raw", false}};
    storage_.compressor = one_of(root, "compressor", kCompressors);
    storage_.header_bytes = one_of(root, "header_type", kHeaders);
    storage_.big_endian = one_of(root, "byte_order", kOrders);
    appended_in_base64_ = one_of(root.child("AppendedData"), "encoding", kEncodings);
}

template <class Value, std::size_t N>
Value VtkFile::one_of(const pugi::xml_node& node, const char* name,
                      const std::pair<std::string_view, Value> (&known)[N]) const {
    const std::string_view said = node.attribute(name).value();
    for (const auto& [word, value] : known)
        if (word == said) return value;
    fail(node.offset_debug(),
         "says " + std::string(name) + "=\"" + std::string(said) + "\", which is not known");
}

NumberKind VtkFile::kind_of(const pugi::xml_node& array) const {
    static constexpr std::pair<std::string_view, NumberKind> kKinds[] = {
        {"Int8", NumberKind::int8},       {"UInt8", NumberKind::uint8},
        {"Int16", NumberKind::int16},     {"UInt16", NumberKind::uint16},
        {"Int32", NumberKind::int32},     {"UInt32", NumberKind::uint32},
        {"Int64", NumberKind::int64},     {"UInt64", NumberKind::uint64},
        {"Float32", NumberKind::float32}, {"Float64", NumberKind::float64}};
    return one_of(array, "type", kKinds);
}

bool VtkFile::is_text(const pugi::xml_node& array) const {
    static constexpr std::pair<std::string_view, bool> kFormats[] = {
        {"", true}, {"ascii", true}, {"binary", false}, {"appended", false}};
    return one_of(array, "format", kFormats);
}

std::string VtkFile::bytes_of(const pugi::xml_node& array) const {
    const std::string where = file_.string() + ": line " +
                              std::to_string(line_at(content_, array.offset_debug())) +
                              ": array '" + array.attribute("Name").value() + "'";
    if (std::string_view(array.attribute("format").value()) == "binary")
        return vtk_array_bytes(array.text().get(), true, storage_, where);
    const auto offset = static_cast<std::size_t>(number(array, "offset"));
    require(array, offset <= appended_.size(), "lies behind the end of the file");
    return vtk_array_bytes(appended_.substr(offset), appended_in_base64_, storage_, where);
}

template <class Number>
Number VtkFile::to_number(const pugi::xml_node& node, std::string_view word) const {
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size())
        refuse(node, "holds '" + std::string(word.substr(0, 40)) + "' where a number should stand");
    return value;
}

template <class Number>
std::vector<Number> VtkFile::parsed(const pugi::xml_node& array) const {
    std::vector<Number> numbers;
    std::string_view text = array.text().get();
    for (std::size_t from = text.find_first_not_of(kBlank); from != std::string_view::npos;
         from = text.find_first_not_of(kBlank)) {
        text.remove_prefix(from);
        const std::string_view word = text.substr(0, text.find_first_of(kBlank));
        numbers.push_back(to_number<Number>(array, word));
        text.remove_prefix(word.size());
    }
    return numbers;
}

pugi::xml_node VtkFile::find(const pugi::xml_node& holder, const char* name) {
    return holder.find_child([&](const pugi::xml_node& node) {
        return is_array(node) && std::string_view(node.attribute("Name").value()) == name;
    });
}

pugi::xml_node VtkFile::array(const pugi::xml_node& holder, const char* name) const {
    const pugi::xml_node found = find(holder, name);
    if (!found) refuse(holder, "has no array '" + std::string(name) + "'");
    return found;
}

bool VtkFile::is_array(const pugi::xml_node& node) {
    const std::string_view tag = node.name();
    return tag == "DataArray" || tag == "Array";
}

std::vector<double> VtkFile::reals(const pugi::xml_node& array) const {
    const NumberKind kind = kind_of(array);
    return is_text(array) ? parsed<double>(array)
                          : reals_in(bytes_of(array), kind, storage_.big_endian);
}

std::vector<std::int64_t> VtkFile::integers(const pugi::xml_node& array) const {
    const NumberKind kind = kind_of(array);
    require(array, kind != NumberKind::float32 && kind != NumberKind::float64,
            "holds real numbers where integers are needed");
    return is_text(array) ? parsed<std::int64_t>(array)
                          : integers_in(bytes_of(array), kind, storage_.big_endian);
}

std::vector<std::string> VtkFile::texts(const char* name) const {
    const pugi::xml_node found = find(grid().child("FieldData"), name);
    if (std::string_view(found.attribute("type").value()) != "String") return {};
    std::string bytes;
    if (is_text(found))
        for (const std::int64_t letter : parsed<std::int64_t>(found))
            bytes.push_back(static_cast<char>(letter));
    else
        bytes = bytes_of(found);
    std::vector<std::string> texts;
    for (std::size_t from = 0; from < bytes.size();) {
        const std::size_t end = std::min(bytes.find('\0', from), bytes.size());
        texts.push_back(bytes.substr(from, end - from));
        from = end + 1;
    }
    return texts;
}

std::int64_t VtkFile::number(const pugi::xml_node& node, const char* name,
                             std::optional<std::int64_t> otherwise) const {
    const std::string_view said = trimmed(node.attribute(name).value());
    std::int64_t value = otherwise.value_or(-1);
    if (!said.empty()) value = to_number<std::int64_t>(node, said);
    if (value < 0)
        refuse(node, "says " + std::string(name) + "=\"" + std::string(said) +
                         "\", but a count is needed");
    return value;
}

void VtkFile::refuse(const pugi::xml_node& node, const std::string& defect) const {
    fail(node.offset_debug(), "(<" + std::string(node.name()) + ">) " + defect);
}

void VtkFile::fail(std::ptrdiff_t offset, const std::string& defect) const {
    throw InputError(file_.string() + ": line " + std::to_string(line_at(content_, offset)) + " " +
                     defect +
                     "; the file is damaged or of a kind that is not read, export it again");
}

}  // namespace myotet::meshfiles
