// SPDX-License-Identifier: MIT
#include "scene/gltf/nodes.h"

#include <cmath>
#include <numbers>

#include <glm/gtc/quaternion.hpp>

#include "scene/gltf/mesh_table.h"

namespace luxel::gltf {
namespace {

glm::mat4 local_transform(const Value& node) {
    if (const Value matrix = node["matrix"]) {
        glm::mat4 m;
        matrix.numbers({&m[0][0], 16});
        const glm::vec4 last_row(m[0][3], m[1][3], m[2][3], m[3][3] - 1.0f);
        if (glm::length(last_row) > 1e-4f) matrix.fail("is not affine");
        m[0][3] = m[1][3] = m[2][3] = 0.0f, m[3][3] = 1.0f;
        return m;
    }
    const glm::vec3 translation = node["translation"].vec<3>(glm::vec3(0.0f));
    const glm::vec4 r = node["rotation"].vec<4>(glm::vec4(0, 0, 0, 1));
    const glm::vec3 scale = node["scale"].vec<3>(glm::vec3(1.0f));
    const float length = glm::length(r);
    if (!(length > 1e-6f)) node["rotation"].fail("is no rotation");
    const glm::mat3 rotation = glm::mat3_cast(glm::quat(r.w, r.x, r.y, r.z) * (1.0f / length));
    return glm::mat4(glm::vec4(rotation[0] * scale.x, 0.0f), glm::vec4(rotation[1] * scale.y, 0.0f),
                     glm::vec4(rotation[2] * scale.z, 0.0f), glm::vec4(translation, 1.0f));
}

void check_transform(const Value& node, const glm::mat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) node.fail("its place in the world is not finite");
}

// The unit world direction of a node's axis; zero when the node is scaled to nothing.
glm::vec3 axis(const glm::mat4& world, glm::vec3 local) {
    const glm::vec3 v = glm::mat3(world) * local;
    const float length = glm::length(v);
    return length > 0.0f && std::isfinite(length) ? v / length : glm::vec3(0.0f);
}

void add_camera(Document& document, Scene& scene, const Value& node, const glm::mat4& world) {
    const Value json = document.resolve("cameras", node["camera"]);
    const std::string& type = json["type"].text();
    if (type == "orthographic") return document.warn("an orthographic camera is left out");
    if (type != "perspective") json["type"].fail("\"{}\" is not a camera type", printable(type));

    const Value lens = json["perspective"];
    Camera camera;
    camera.name = printable(node["name"].text(json["name"].text("").c_str()));
    camera.position = glm::vec3(world[3]);
    camera.forward = axis(world, {0, 0, -1});
    camera.up = axis(world, {0, 1, 0});
    if (glm::length(glm::cross(camera.forward, camera.up)) < 1e-6f)
        return document.warn("a camera that is scaled to nothing is left out");
    camera.yfov = lens["yfov"].number();
    camera.near = lens["znear"].number();
    camera.far = lens["zfar"].number(std::max(camera.far, camera.near * 2.0f));
    if (!(camera.yfov > 0.0f && camera.yfov < std::numbers::pi_v<float>))
        lens["yfov"].fail("is not within 0 to pi");
    if (!(camera.near > 0.0f && camera.near < camera.far))
        lens.fail("znear and zfar do not enclose a depth range");
    scene.cameras.push_back(camera);
}

void add_light(Document& document, Scene& scene, const Value& node, const glm::mat4& world) {
    const Value lights = document.root()["extensions"]["KHR_lights_punctual"]["lights"];
    const Value reference = node["extensions"]["KHR_lights_punctual"]["light"];
    const Value json = lights.at(reference.index(lights.size(), "light"));
    const std::string& type = json["type"].text();

    shared::Light light{};
    light.position = glm::vec3(world[3]);
    light.direction = axis(world, {0, 0, -1});
    if (light.direction == glm::vec3(0.0f)) light.direction = {0, 0, -1};
    light.intensity = json["color"].vec<3>(glm::vec3(1.0f)) * json["intensity"].number(1.0f);
    if (glm::any(glm::lessThan(light.intensity, glm::vec3(0.0f))))
        json.fail("its color or intensity is negative");
    light.range = json["range"].number(0.0f);
    if (light.range < 0.0f) json["range"].fail("is negative");

    if (type == "directional")
        light.type = shared::LIGHT_DIRECTIONAL;
    else if (type == "point")
        light.type = shared::LIGHT_POINT;
    else if (type == "spot") {
        const Value cone = json["spot"];
        const float inner = cone["innerConeAngle"].number(0.0f);
        const float outer = cone["outerConeAngle"].number(std::numbers::pi_v<float> / 4.0f);
        if (!(inner >= 0.0f && inner <= outer && outer <= std::numbers::pi_v<float> / 2.0f + 1e-5f))
            json.fail("its cone angles are not 0 <= inner <= outer <= pi/2");
        light.type = shared::LIGHT_SPOT;
        light.cos_inner = std::cos(inner);
        light.cos_outer = std::cos(outer);
    } else {
        json["type"].fail("\"{}\" is not a light type", printable(type));
    }
    scene.lights.push_back(light);
}

// Each node at most once: a second visit is a cycle or a second parent.
class Walk {
public:
    Walk(Document& document, Scene& scene)
        : document_(document), scene_(scene), meshes_(document, scene), nodes_(document.root()["nodes"]),
          visited_(nodes_.size(), false) {}

    void run() {
        push_roots();
        while (!pending_.empty()) {
            const Pending next = pending_.back();
            pending_.pop_back();
            visit(next);
        }
    }

private:
    struct Pending {
        std::size_t node;
        glm::mat4 parent;
    };

    void push(const Value& reference, const glm::mat4& parent) {
        const std::size_t index = reference.index(nodes_.size(), "node");
        if (visited_[index]) reference.fail("node {} is reached twice (a cycle or two parents)", index);
        visited_[index] = true;
        pending_.push_back({index, parent});
    }

    // In reverse, so that the stack gives them back in the file's order.
    void push_all(const Value& references, const glm::mat4& parent) {
        for (std::size_t i = references.size(); i-- > 0;) push(references.at(i), parent);
    }

    // The default scene, else the first; a file without scenes shows its parentless nodes.
    void push_roots() {
        const Value root = document_.root(), scenes = root["scenes"];
        if (scenes.size() > 0) {
            const std::size_t index = root["scene"] ? root["scene"].index(scenes.size(), "scene") : 0;
            return push_all(scenes.at(index)["nodes"], glm::mat4(1.0f));
        }
        std::vector<bool> child(nodes_.size(), false);
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            const Value children = nodes_.at(i)["children"];
            for (std::size_t k = 0; k < children.size(); ++k)
                child[children.at(k).index(nodes_.size(), "node")] = true;
        }
        for (std::size_t i = nodes_.size(); i-- > 0;) {
            if (child[i]) continue;
            visited_[i] = true;
            pending_.push_back({i, glm::mat4(1.0f)});
        }
    }

    void visit(const Pending& pending) {
        const Value node = nodes_.at(pending.node);
        const glm::mat4 world = pending.parent * local_transform(node);
        check_transform(node, world);
        push_all(node["children"], world);
        if (node["mesh"]) meshes_.add_instances(node, world);
        if (node["camera"]) add_camera(document_, scene_, node, world);
        if (node["extensions"]["KHR_lights_punctual"]) add_light(document_, scene_, node, world);
        if (node["extensions"]["EXT_mesh_gpu_instancing"])
            document_.warn("EXT_mesh_gpu_instancing is not supported, one instance is shown");
    }

    Document& document_;
    Scene& scene_;
    MeshTable meshes_;
    Value nodes_;
    std::vector<bool> visited_;
    std::vector<Pending> pending_;
};

} // namespace

void read_nodes(Document& document, Scene& scene) { Walk(document, scene).run(); }

} // namespace luxel::gltf
