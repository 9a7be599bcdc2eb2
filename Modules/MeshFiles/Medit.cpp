// SPDX-License-Identifier: Apache-2.0
// The .mesh format: P. Frey (2001), MEDIT: an interactive mesh visualization
// software, INRIA RT-0253.
#include "MeshFiles/NamedComments.h"
#include "MeshFiles/RawMesh.h"
#include "MeshFiles/TextWriter.h"
#include "MeshFiles/TokenReader.h"

namespace myotet::meshfiles {

std::string medit_text(const NamedMesh& mesh) {
    TextWriter out;
    out.line("MeshVersionFormatted 2\n# ", kFacts);
    for (const auto& [label, name] : part_names(mesh)) out.line("# label ", label, '=', name);
    std::size_t triangles = 0;
    for (const FaceSet& set : mesh.faces) {
        out.line("# faces ", set.tag, '=', set.name);
        triangles += set.triangles.size();
    }
    out.line("Dimension 3\nVertices\n", mesh.mesh.points.size());
    for (const Vec3& p : mesh.mesh.points) out.line(p[0], ' ', p[1], ' ', p[2], " 0");
    if (triangles > 0) out.line("Triangles\n", triangles);
    for (const FaceSet& set : mesh.faces)
        for (const Triangle& t : set.triangles)
            out.line(t[0] + 1, ' ', t[1] + 1, ' ', t[2] + 1, ' ', set.tag);
    out.line("Tetrahedra\n", mesh.mesh.tets.size());
    for (std::size_t t = 0; t < mesh.mesh.tets.size(); ++t) {
        const Tet& c = mesh.mesh.tets[t];
        out.line(c[0] + 1, ' ', c[1] + 1, ' ', c[2] + 1, ' ', c[3] + 1, ' ',
                 mesh.mesh.labels.empty() ? 1 : mesh.mesh.labels[t]);
    }
    out.line("End");
    return out.text();
}

namespace {

class MeditReader {
public:
    MeditReader(std::string_view content, const std::filesystem::path& file)
        : in_(content, file, '#'), said_(read_comments(content, '#')) {
        mesh_.space = said_.space;
        mesh_.names.insert(said_.labels.begin(), said_.labels.end());
    }

    RawMesh read() {
        if (in_.word() != "MeshVersionFormatted") in_.fail("is not MeshVersionFormatted");
        (void)in_.number<int>("the version");
        for (std::string_view word = in_.word(); word != "End"; word = in_.word()) {
            if (word.empty()) in_.fail_short();
            read_keyword(word);
        }
        return std::move(mesh_);
    }

private:
    /// Keywords and how many whole numbers each of their items has; they are
    /// passed over.
    static int numbers_of_passed(std::string_view keyword) {
        static constexpr std::pair<std::string_view, int> kPassed[] = {{"Edges", 3},
                                                                       {"Corners", 1},
                                                                       {"RequiredVertices", 1},
                                                                       {"Ridges", 1},
                                                                       {"RequiredEdges", 1},
                                                                       {"RequiredTriangles", 1},
                                                                       {"Normals", 3},
                                                                       {"NormalAtVertices", 2},
                                                                       {"Tangents", 3},
                                                                       {"TangentAtVertices", 2}};
        for (const auto& [name, count] : kPassed)
            if (name == keyword) return count;
        return 0;
    }
    std::int64_t count() {
        constexpr std::int64_t kShortestItem = 2;  // a digit and a blank
        return in_.require_room(in_.number<std::int64_t>("a number of items"), kShortestItem);
    }
    std::int64_t integer() { return in_.number<std::int64_t>("a whole number"); }

    void read_keyword(std::string_view keyword) {
        if (keyword == "Dimension") {
            if (integer() != 3) in_.fail("is of no mesh in three dimensions");
        } else if (keyword == "Vertices") {
            read_vertices();
        } else if (keyword == "Triangles") {
            read_triangles();
        } else if (keyword == "Tetrahedra") {
            read_tets();
        } else if (const int numbers = numbers_of_passed(keyword); numbers > 0) {
            const std::int64_t items = count();
            for (std::int64_t i = 0; i < items * numbers; ++i) (void)in_.number<double>("a number");
        } else {
            in_.fail("begins '" + std::string(keyword.substr(0, 40)) + "', which is not read");
        }
    }
    void read_vertices() {
        const std::int64_t items = count();
        for (std::int64_t i = 1; i <= items; ++i) {
            Vec3 p;
            for (int a = 0; a < 3; ++a) p[a] = in_.number<double>("a coordinate");
            mesh_.add_point(i, p);
            (void)in_.number<double>("a vertex's reference");
        }
    }
    void read_triangles() {
        const std::int64_t items = count();
        for (std::int64_t i = 0; i < items; ++i) {
            const std::int64_t a = integer(), b = integer(), c = integer(), tag = integer();
            RawMesh::Faces& set = mesh_.faces_tagged(tag);
            if (set.triangles.empty())
                if (const auto name = said_.faces.find(tag); name != said_.faces.end())
                    set.name = name->second;
            set.triangles.push_back({a, b, c});
        }
    }
    void read_tets() {
        const std::int64_t items = count();
        for (std::int64_t i = 1; i <= items; ++i) {
            const std::int64_t a = integer(), b = integer(), c = integer(), d = integer();
            mesh_.add_tet(i, integer(), {a, b, c, d});
        }
    }

    TokenReader in_;
    NamedComments said_;
    RawMesh mesh_;
};

}  // namespace

RawMesh parse_medit(std::string_view content, const std::filesystem::path& file) {
    return MeditReader(content, file).read();
}

}  // namespace myotet::meshfiles
