// SPDX-License-Identifier: Apache-2.0
// The MSH 4.1 format, Gmsh reference manual, section "MSH file format".
#include <algorithm>
#include <set>

#include "MeshFiles/RawMesh.h"
#include "MeshFiles/TextWriter.h"

namespace myotet::meshfiles {
namespace {

/// Numbers as words.
class TextSink {
public:
    static constexpr int kKind = 0;
    void integer(std::int32_t i) { out.add(i, ' '); }
    void size(std::size_t n) { out.add(n, ' '); }
    void real(double x) { out.add(x, ' '); }
    void end_record() { out.add('\n'); }
    void end_section() {}
    TextWriter out;
};

/// Numbers as the machine stores them.
class BinarySink {
public:
    static constexpr int kKind = 1;
    void integer(std::int32_t i) { put(i); }
    void size(std::size_t n) { put(std::uint64_t{n}); }
    void real(double x) { put(x); }
    void end_record() {}
    void end_section() { out.add('\n'); }
    TextWriter out;

private:
    template <class Number>
    void put(Number number) {
        out.add(std::string_view(reinterpret_cast<const char*>(&number), sizeof number));
    }
};

constexpr int kSurface = 2, kVolume = 3, kTriangle = 2, kTetrahedron = 4;

/// A piece of the mesh that has a tag: a face set or a label.
struct Entity {
    int dimension = 0;
    std::int32_t tag = 0;
    std::string name;
    Box box;
    std::vector<std::int32_t> nodes;     ///< those that belong to no earlier entity
    std::vector<std::int32_t> bounding;  ///< tags of the surfaces around a volume
};

std::vector<Entity> entities_of(const NamedMesh& mesh) {
    std::vector<Entity> entities;
    std::vector<bool> taken(mesh.mesh.points.size(), false);
    const auto take = [&](Entity& entity, std::int32_t node) {
        entity.box.include(mesh.mesh.points[node]);
        if (!taken[node]) entity.nodes.push_back(node);
        taken[node] = true;
    };
    for (const FaceSet& set : mesh.faces) {
        Entity& entity = entities.emplace_back(Entity{kSurface, set.tag, set.name, {}, {}, {}});
        for (const Triangle& t : set.triangles)
            for (const std::int32_t node : t) take(entity, node);
    }
    const auto names = part_names(mesh);
    for (const auto& [label, tets] : tets_by_label(mesh.mesh)) {
        Entity& entity = entities.emplace_back(Entity{kVolume, label, names.at(label), {}, {}, {}});
        for (const std::int32_t t : tets)
            for (const std::int32_t node : mesh.mesh.tets[t]) take(entity, node);
    }
    // Nodes that nothing uses must lie somewhere.
    for (std::size_t n = 0; n < taken.size(); ++n)
        if (!taken[n]) entities.back().nodes.push_back(static_cast<std::int32_t>(n));
    for (Entity& entity : entities) std::ranges::sort(entity.nodes);
    return entities;
}

void find_bounding_surfaces(const NamedMesh& mesh, std::vector<Entity>& entities) {
    std::set<std::pair<std::int32_t, std::int32_t>> touching;  // label, surface tag
    const auto label_at = [&](std::int32_t slot) {
        return mesh.mesh.labels.empty() ? 1 : mesh.mesh.labels[slot / 4];
    };
    const auto sides = sides_of(mesh);
    for (std::size_t s = 0; s < sides.size(); ++s)
        for (const FaceSides& side : sides[s])
            for (const std::int32_t slot : {side.inside, side.behind})
                if (slot >= 0) touching.emplace(label_at(slot), mesh.faces[s].tag);
    for (Entity& entity : entities)
        for (const auto& [label, tag] : touching)
            if (entity.dimension == kVolume && entity.tag == label) entity.bounding.push_back(tag);
}

template <class Sink>
void write_entities(Sink& sink, const std::vector<Entity>& entities) {
    sink.out.line("$Entities");
    const auto surfaces =
        static_cast<std::size_t>(std::ranges::count(entities, kSurface, &Entity::dimension));
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{0}, surfaces, entities.size() - surfaces})
        sink.size(count);
    sink.end_record();
    for (const Entity& entity : entities) {
        sink.integer(entity.tag);
        for (const Vec3& corner : {entity.box.min, entity.box.max})
            for (int a = 0; a < 3; ++a) sink.real(corner[a]);
        sink.size(1);
        sink.integer(entity.tag);
        sink.size(entity.bounding.size());
        for (const std::int32_t tag : entity.bounding) sink.integer(tag);
        sink.end_record();
    }
    sink.end_section();
    sink.out.line("$EndEntities");
}

template <class Sink>
void write_nodes(Sink& sink, const NamedMesh& mesh, const std::vector<Entity>& entities) {
    const std::size_t count = mesh.mesh.points.size();
    sink.out.line("$Nodes");
    for (const std::size_t n : {entities.size(), count, std::size_t{1}, count}) sink.size(n);
    sink.end_record();
    for (const Entity& entity : entities) {
        for (const std::int32_t i : {entity.dimension, entity.tag, 0}) sink.integer(i);
        sink.size(entity.nodes.size());
        sink.end_record();
        for (const std::int32_t node : entity.nodes) {
            sink.size(static_cast<std::size_t>(node) + 1);
            sink.end_record();
        }
        for (const std::int32_t node : entity.nodes) {
            for (int a = 0; a < 3; ++a) sink.real(mesh.mesh.points[node][a]);
            sink.end_record();
        }
    }
    sink.end_section();
    sink.out.line("$EndNodes");
}

template <class Sink, std::size_t N>
void write_element(Sink& sink, std::size_t number, const std::array<std::int32_t, N>& nodes) {
    sink.size(number);
    for (const std::int32_t node : nodes) sink.size(static_cast<std::size_t>(node) + 1);
    sink.end_record();
}

/// Tetrahedra keep their order in their numbers; triangles follow.
template <class Sink>
void write_elements(Sink& sink, const NamedMesh& mesh) {
    const auto parts = tets_by_label(mesh.mesh);
    std::size_t count = mesh.mesh.tets.size(), number = count;
    for (const FaceSet& set : mesh.faces) count += set.triangles.size();
    const auto begin_block = [&](int dimension, std::int32_t tag, int type, std::size_t size) {
        for (const std::int32_t i : {dimension, tag, type}) sink.integer(i);
        sink.size(size);
        sink.end_record();
    };
    sink.out.line("$Elements");
    for (const std::size_t n : {mesh.faces.size() + parts.size(), count, std::size_t{1}, count})
        sink.size(n);
    sink.end_record();
    for (const FaceSet& set : mesh.faces) {
        begin_block(kSurface, set.tag, kTriangle, set.triangles.size());
        for (const Triangle& t : set.triangles) write_element(sink, ++number, t);
    }
    for (const auto& [label, tets] : parts) {
        begin_block(kVolume, label, kTetrahedron, tets.size());
        for (const std::int32_t t : tets)
            write_element(sink, static_cast<std::size_t>(t) + 1, mesh.mesh.tets[t]);
    }
    sink.end_section();
    sink.out.line("$EndElements");
}

template <class Sink>
std::string msh(const NamedMesh& mesh) {
    require_positive_numbers(mesh, "gmsh");
    std::vector<Entity> entities = entities_of(mesh);
    find_bounding_surfaces(mesh, entities);
    Sink sink;
    sink.out.line("$MeshFormat\n4.1 ", Sink::kKind, " 8");
    if (Sink::kKind == BinarySink::kKind) sink.integer(1);  // tells the byte order
    sink.end_section();
    sink.out.line("$EndMeshFormat\n$Comments\n", kFacts, "\n$EndComments");
    sink.out.line("$PhysicalNames\n", entities.size());
    for (const Entity& entity : entities) {
        std::string name = entity.name;
        std::ranges::replace(name, '"', '\'');  // the format has no way to write it
        sink.out.line(entity.dimension, ' ', entity.tag, " \"", name, '"');
    }
    sink.out.line("$EndPhysicalNames");
    write_entities(sink, entities);
    write_nodes(sink, mesh, entities);
    write_elements(sink, mesh);
    return sink.out.text();
}

}  // namespace

std::string gmsh_text(const NamedMesh& mesh) { return msh<TextSink>(mesh); }

std::string gmsh_binary(const NamedMesh& mesh) { return msh<BinarySink>(mesh); }

}  // namespace myotet::meshfiles
