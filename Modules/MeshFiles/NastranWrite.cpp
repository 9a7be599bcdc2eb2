// SPDX-License-Identifier: Apache-2.0
// MSC Nastran quick reference guide: GRID, CTETRA, PSOLID, MAT1, BSURFS, SET1.
#include <charconv>

#include "Core/Errors.h"
#include "MeshFiles/RawMesh.h"
#include "MeshFiles/TextWriter.h"

namespace myotet::meshfiles {
namespace {

constexpr std::size_t kSmall = 8, kLarge = 16;  // characters of a field
constexpr std::string_view kBlanks = "                ";

std::string padded(std::string text, std::size_t width) {
    text.append(kBlanks.substr(0, width - text.size()));
    return text;
}

/// The most digits that 16 characters hold; Nastran wants a decimal point.
std::string real(double x) {
    for (int digits = 17;; --digits) {
        char text[40];
        const auto [end, error] = digits == 17 ? std::to_chars(text, text + sizeof text, x)
                                               : std::to_chars(text, text + sizeof text, x,
                                                               std::chars_format::general, digits);
        std::string said(text, end);
        if (said.find('.') == std::string::npos)
            said.insert(std::min(said.find('e'), said.size()), ".");
        if (said.size() <= kLarge) return padded(said, kLarge);
    }
}

/// Collects one entry: its name, then fields of eight characters.
class Card {
public:
    explicit Card(std::string_view name) : text_(padded(std::string(name), kSmall)) {}
    Card& blank() { return field(""); }
    Card& number(std::int64_t n) {
        const std::string digits = std::to_string(n);
        if (digits.size() > kSmall)
            throw ResourceError("number " + digits +
                                " does not fit into the eight characters of a Nastran field; "
                                "write a smaller mesh or another format");
        return field(digits);
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    Card& field(const std::string& content) {
        if (fields_ > 0 && fields_ % 8 == 0) text_ += "\n" + padded("+", kSmall);
        text_ += padded(content, kSmall);
        ++fields_;
        return *this;
    }
    std::string text_;
    int fields_ = 0;
};

void write_grid(TextWriter& out, const std::vector<Vec3>& points) {
    for (std::size_t n = 0; n < points.size(); ++n) {
        const Vec3& p = points[n];
        out.line("GRID*   ", padded(std::to_string(n + 1), kLarge), kBlanks, real(p[0]), real(p[1]),
                 "*\n*       ", real(p[2]));
    }
}

void write_tets(TextWriter& out, const TetMesh& mesh) {
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        Card card("CTETRA");
        card.number(static_cast<std::int64_t>(t) + 1)
            .number(mesh.labels.empty() ? 1 : mesh.labels[t]);
        for (const std::int32_t node : mesh.tets[t]) card.number(node + 1);
        out.line(card.text());
    }
}

/// The one entry that names faces of solids without adding any stiffness.
void write_faces(TextWriter& out, const NamedMesh& mesh) {
    const auto sides = sides_of(mesh);
    for (std::size_t s = 0; s < sides.size(); ++s) {
        const FaceSet& set = mesh.faces[s];
        out.line("$ faces ", set.tag, '=', set.name);
        Card card("BSURFS");
        card.number(set.tag).blank().blank().blank();
        for (std::size_t f = 0; f < sides[s].size(); ++f) {
            const FaceSides side = sides[s][f];
            card.number((side.inside >= 0 ? side.inside : side.behind) / 4 + 1);
            for (const std::int32_t node : set.triangles[f]) card.number(node + 1);
        }
        out.line(card.text());
    }
}

}  // namespace

std::string nastran_text(const NamedMesh& mesh) {
    require_positive_numbers(mesh, "Nastran");
    TextWriter out;
    out.line("$ ", kFacts, "; units mm, N, s, MPa, tonne\nSOL 101\nCEND\nBEGIN BULK");
    out.line("$ MAT1 is a placeholder, no property of any tissue.");
    out.line("MAT1,1,1.,,.3,1.-9");
    for (const auto& [label, name] : part_names(mesh)) {
        out.line("$ label ", label, '=', name);
        out.line(Card("PSOLID").number(label).number(1).text());
    }
    write_grid(out, mesh.mesh.points);
    write_tets(out, mesh.mesh);
    write_faces(out, mesh);
    for (std::size_t s = 0; s < mesh.nodes.size(); ++s) {
        out.line("$ nodes ", s + 1, '=', mesh.nodes[s].name);
        Card card("SET1");
        card.number(static_cast<std::int64_t>(s) + 1);
        for (const std::int32_t node : mesh.nodes[s].nodes) card.number(node + 1);
        out.line(card.text());
    }
    out.line("ENDDATA");
    return out.text();
}

}  // namespace myotet::meshfiles
