// SPDX-License-Identifier: MIT
#include "scene/obj.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <streambuf>
#include <string_view>
#include <unordered_map>

#include <tiny_obj_loader.h>

#include "core/error.h"
#include "core/file.h"
#include "scene/load_texture.h"
#include "scene/mesh_attributes.h"
#include "scene/obj_material.h"
#include "scene/obj_normals.h"
#include "scene/obj_statements.h"
#include "scene/printable.h"
#include "scene/validate.h"

namespace luxel {
namespace {

constexpr std::uint64_t max_obj_bytes = std::uint64_t(2) << 30;
constexpr std::size_t max_face_corners = 1024;

// Reads a stream from memory: the library never opens a file itself.
class MemoryStream : private std::streambuf, public std::istream {
public:
    explicit MemoryStream(std::span<std::uint8_t> bytes) : std::istream(this) {
        char* first = reinterpret_cast<char*>(bytes.data());
        setg(first, first, first + bytes.size());
    }
};

// mtllib lines, resolved beneath the OBJ's folder.
class FolderMaterials : public tinyobj::MaterialReader {
public:
    FolderMaterials(const Folder& folder, const std::string& name) : folder_(folder), name_(name) {}

    bool operator()(const std::string& file, std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* names, std::string* warning, std::string* error) override {
        auto bytes = folder_.read(obj_path(file), max_obj_bytes);
        if (!bytes) {
            missing.push_back(fmt::format("{}: no material library \"{}\"", name_, printable(file)));
            return false;
        }
        statements.read({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, left_out);
        MemoryStream stream(*bytes);
        tinyobj::LoadMtl(names, materials, &stream, warning, error);
        return true;
    }

    std::vector<std::string> missing;
    MtlStatements statements;
    LeftOut left_out;

private:
    const Folder& folder_;
    const std::string& name_;
};

// What the library does not refuse itself: it reads "nan" as 0 and an
// overflowing index as another one, and cuts a polygon into triangles in time
// quadratic in its corners. It reads "s on" as a group without number, which is
// none: that is rewritten in place.
void check_line(std::string_view line, std::size_t number, const std::string& name, LeftOut& left_out) {
    const std::string_view kind = next_word(line);
    if (kind == "v" || kind == "vn" || kind == "vt") {
        for (std::string_view word = next_word(line); !word.empty() && word[0] != '#'; word = next_word(line))
            if (word.find_first_of("0123456789") == word.npos)
                fail(Fault::bad_input, "{}: line {}: \"{}\" is not a finite number", name, number,
                     printable(word));
    } else if (kind == "f") {
        std::size_t corners = 0;
        for (std::string_view word = next_word(line); !word.empty(); word = next_word(line), ++corners)
            for (std::size_t i = 0, digits = 0; i < word.size(); ++i) {
                digits = word[i] >= '0' && word[i] <= '9' ? digits + 1 : 0;
                if (digits > 9) fail(Fault::bad_input, "{}: line {}: an index is too large", name, number);
            }
        if (corners > max_face_corners)
            fail(Fault::bad_input, "{}: line {}: a face with more than {} corners", name, number,
                 max_face_corners);
    } else if (kind != "s" && kind != "o" && kind != "g" && kind != "usemtl" && kind != "mtllib" &&
               kind != "l" && kind != "p" && !kind.empty() && kind[0] != '#') {
        left_out.add(kind);
    }
}

void check_lines(std::span<std::uint8_t> bytes, const std::string& name, LeftOut& left_out) {
    char* const begin = reinterpret_cast<char*>(bytes.data());
    std::string_view text(begin, bytes.size());
    for (std::size_t number = 1; !text.empty(); ++number) {
        std::string_view line = next_line(text);
        check_line(line, number, name, left_out);
        if (next_word(line) != "s") continue;
        if (const std::string_view group = next_word(line); group == "on") {
            char* at = begin + (group.data() - begin);
            at[0] = '1', at[1] = ' ';
        }
    }
}

struct Source {
    std::string name;
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    MtlStatements statements;
    LeftOut left_out;
    std::vector<std::string> warnings;
};

Source read_source(const std::filesystem::path& path, const Folder& folder) {
    Source source;
    source.name = printable(path.string(), longest_path);
    std::vector<std::uint8_t> text = read_file(path, max_obj_bytes);
    if (text.empty()) fail(Fault::bad_input, "{}: the file is empty", source.name);
    FolderMaterials reader(folder, source.name);
    check_lines(text, source.name, reader.left_out);

    MemoryStream stream(text);
    std::string warning, error;
    const bool read = tinyobj::LoadObj(&source.attributes, &source.shapes, &source.materials, &warning,
                                       &error, &stream, &reader, true, false);
    if (!read) {
        error = printable(error.substr(0, error.find('\n')));
        fail(Fault::bad_input, "{}: {}", source.name, error.empty() ? "not a valid OBJ file" : error);
    }
    source.warnings = std::move(reader.missing);
    source.statements = std::move(reader.statements), source.left_out = std::move(reader.left_out);
    add_missing_normals(source.attributes, source.shapes);
    return source;
}

// Corners that agree in position, normal and texture coordinate are one vertex.
class MeshBuilder {
public:
    MeshBuilder(const Source& source, const std::string& name, int material) : source_(source) {
        mesh_.name = name;
        mesh_.material = material;
    }

    void add_corner(const tinyobj::index_t& corner) {
        const auto [entry, added] = vertices_.try_emplace(Key{corner}, std::uint32_t(mesh_.positions.size()));
        if (added) add_vertex(corner);
        mesh_.indices.push_back(entry->second);
    }

    // No texture coordinates unless all corners have them.
    Mesh finish(const Material& material) {
        if (!all_uvs_) mesh_.texcoords[0].clear();
        repair_normals(mesh_);
        if (material.normal_texture.texture >= 0) make_tangents(mesh_, 0, material.normal_texture.transform);
        return std::move(mesh_);
    }

private:
    struct Key {
        tinyobj::index_t corner;
        bool operator==(const Key& o) const {
            return corner.vertex_index == o.corner.vertex_index &&
                   corner.normal_index == o.corner.normal_index &&
                   corner.texcoord_index == o.corner.texcoord_index;
        }
    };
    struct Hash {
        std::size_t operator()(const Key& k) const {
            std::uint64_t h = std::uint32_t(k.corner.vertex_index);
            h = h * 0x9e3779b97f4a7c15ull + std::uint32_t(k.corner.normal_index);
            h = h * 0x9e3779b97f4a7c15ull + std::uint32_t(k.corner.texcoord_index);
            return std::size_t(h ^ (h >> 29));
        }
    };

    // Entry `index` of a flat array of N floats each; the library does not check
    // indices.
    template <int N>
    glm::vec<N, float> fetch(const std::vector<float>& values, int index, const char* what) const {
        if (index < 0 || std::size_t(index) >= values.size() / N)
            fail(Fault::bad_input, "{}: object \"{}\": {} {} is out of range, there are {}", source_.name,
                 mesh_.name, what, std::int64_t(index) + 1, values.size() / N);
        glm::vec<N, float> v;
        for (int c = 0; c < N; ++c) v[c] = values[std::size_t(index) * N + std::size_t(c)];
        for (int c = 0; c < N; ++c)
            if (!std::isfinite(v[c]))
                fail(Fault::bad_input, "{}: {} {} is not finite", source_.name, what,
                     std::int64_t(index) + 1);
        return v;
    }

    void add_vertex(const tinyobj::index_t& corner) {
        const auto& a = source_.attributes;
        mesh_.positions.push_back(fetch<3>(a.vertices, corner.vertex_index, "vertex"));
        // Only beside a vertex out of range, which is an error soon.
        const bool none = corner.normal_index < 0;
        mesh_.normals.push_back(none ? glm::vec3(0.0f) : fetch<3>(a.normals, corner.normal_index, "normal"));
        all_uvs_ = all_uvs_ && corner.texcoord_index >= 0;
        if (all_uvs_) {
            // OBJ counts v from the bottom of the image, scenes from the top.
            const glm::vec2 uv = fetch<2>(a.texcoords, corner.texcoord_index, "texture coordinate");
            mesh_.texcoords[0].push_back({uv.x, 1.0f - uv.y});
        }
        // Vertex colors are an extension; they are stored only when every vertex
        // has one.
        if (a.colors.size() == a.vertices.size() && !a.colors.empty())
            mesh_.colors.push_back(glm::vec4(fetch<3>(a.colors, corner.vertex_index, "color"), 1.0f));
    }

    const Source& source_;
    Mesh mesh_;
    std::unordered_map<Key, std::uint32_t, Hash> vertices_;
    bool all_uvs_ = true;
};

// One mesh per material of the shape, in the order in which the faces name
// them.
void add_shape(Scene& scene, const Source& source, const tinyobj::shape_t& shape) {
    const std::string name = printable(shape.name);
    const int default_material = int(scene.materials.size()) - 1;
    std::vector<MeshBuilder> builders;
    std::vector<int> builder_of(scene.materials.size(), -1), materials;
    for (std::size_t face = 0; face * 3 + 2 < shape.mesh.indices.size(); ++face) {
        int material = face < shape.mesh.material_ids.size() ? shape.mesh.material_ids[face] : -1;
        if (material < 0 || material > default_material) material = default_material;
        int& builder = builder_of[std::size_t(material)];
        if (builder < 0) {
            builder = int(builders.size());
            builders.emplace_back(source, name, material);
            materials.push_back(material);
        }
        for (std::size_t k = 0; k < 3; ++k)
            builders[std::size_t(builder)].add_corner(shape.mesh.indices[face * 3 + k]);
    }
    for (std::size_t i = 0; i < builders.size(); ++i) {
        Instance instance;
        instance.name = name;
        instance.mesh = int(scene.meshes.size());
        scene.instances.push_back(std::move(instance));
        scene.meshes.push_back(builders[i].finish(scene.materials[std::size_t(materials[i])]));
    }
}

} // namespace

Scene load_obj(const std::filesystem::path& path, const LoadOptions& options) {
    const Folder folder(path.has_parent_path() ? path.parent_path() : ".");
    Source source = read_source(path, folder);

    Scene scene;
    scene.name = path.stem().string();
    scene.warnings = std::move(source.warnings);
    if (options.strict && !scene.warnings.empty()) fail(Fault::bad_input, "{}", scene.warnings.front());
    read_obj_materials(scene, source.materials, source.statements, source.left_out, folder, source.name,
                       options);
    std::size_t skipped = 0;
    for (const tinyobj::shape_t& shape : source.shapes) {
        add_shape(scene, source, shape);
        skipped += shape.lines.num_line_vertices.size() + shape.points.indices.size();
    }
    if (skipped > 0)
        scene.warnings.push_back(fmt::format("{}: {} points and lines are not drawn", source.name, skipped));
    if (const std::string sentence = source.left_out.sentence(); !sentence.empty())
        scene.warnings.push_back(source.name + ": " + sentence);
    validate_scene(scene, source.name);
    return scene;
}

} // namespace luxel
