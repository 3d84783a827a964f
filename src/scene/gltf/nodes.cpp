// SPDX-License-Identifier: MIT
#include "scene/gltf/nodes.h"

#include "scene/gltf/camera_light.h"
#include "scene/gltf/extensions.h"
#include "scene/gltf/instancing.h"
#include "scene/gltf/mesh_table.h"
#include "scene/recenter.h"

namespace luxel::gltf {
namespace {

// A node that the scene reaches.
struct Reached {
    std::size_t node;
    Place place;
    bool visible; // by KHR_node_visibility of the node and of those above it
    bool shown;   // false: of no scene, for the sake of joints alone
};

// Places of the nodes. Each is reached at most once: a second visit is a cycle or a second parent.
class Tree {
public:
    explicit Tree(Document& document)
        : document_(document), nodes_(document.root()["nodes"]), visited_(nodes_.size(), false) {
        push_roots();
        walk();
        if (document.root()["skins"].size() == 0) return;
        for (const std::size_t root : parentless())
            if (!visited_[root]) push(root, {}, true, false);
        walk();
    }

    const std::vector<Reached>& reached() const { return reached_; }
    std::vector<glm::dmat4> world() const {
        std::vector<glm::dmat4> all(nodes_.size(), glm::dmat4(1.0));
        for (const Reached& r : reached_) all[r.node] = r.place.transform;
        return all;
    }

private:
    void push(std::size_t index, const Place& parent, bool visible, bool shown) {
        visited_[index] = true;
        pending_.push_back({index, parent, visible, shown});
    }

    // In reverse, so that the stack gives them back in the file's order.
    void push_all(const Value& references, const Reached& parent) {
        for (std::size_t i = references.size(); i-- > 0;) {
            const Value reference = references.at(i);
            const std::size_t index = reference.index(nodes_.size(), "node");
            if (visited_[index]) reference.fail("node {} is reached twice (a cycle or two parents)", index);
            push(index, parent.place, parent.visible, parent.shown);
        }
    }

    // The default scene's roots, or every node without a parent.
    void push_roots() {
        const Value root = document_.root(), scenes = root["scenes"];
        if (scenes.size() > 0) {
            const std::size_t index = root["scene"] ? root["scene"].index(scenes.size(), "scene") : 0;
            return push_all(scenes.at(index)["nodes"], {0, {}, true, true});
        }
        const std::vector<std::size_t> roots = parentless();
        for (std::size_t i = roots.size(); i-- > 0;) push(roots[i], {}, true, true);
    }

    std::vector<std::size_t> parentless() const {
        std::vector<bool> child(nodes_.size(), false);
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            const Value children = nodes_.at(i)["children"];
            for (std::size_t k = 0; k < children.size(); ++k)
                child[children.at(k).index(nodes_.size(), "node")] = true;
        }
        std::vector<std::size_t> roots;
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            if (!child[i]) roots.push_back(i);
        return roots;
    }

    void walk() {
        while (!pending_.empty()) {
            Reached next = pending_.back();
            pending_.pop_back();
            const Value node = nodes_.at(next.node);
            next.place = next.place * local_place(node);
            next.visible = next.visible && node["extensions"]["KHR_node_visibility"]["visible"].flag(true);
            push_all(node["children"], next);
            reached_.push_back(next);
        }
    }

    Document& document_;
    Value nodes_;
    std::vector<bool> visited_;
    std::vector<Reached> pending_, reached_;
};

// What nodes show, at first in the file's own coordinates and in double precision.
class Reader {
public:
    Reader(Document& document, Scene& scene, const LoadOptions& options)
        : document_(document), scene_(scene), options_(options), tree_(document), world_(tree_.world()),
          skins_(document, world_), meshes_(document, scene, skins_) {}

    void run() {
        for (const Reached& r : tree_.reached())
            if (r.shown) read(document_.root()["nodes"].at(r.node), r);
        place();
    }

private:
    void read(const Value& node, const Reached& r) {
        warn_of_extensions(document_, node, Bearer::node);
        if (node["camera"])
            if (const auto camera = read_camera(document_, node, r.place.transform)) {
                scene_.cameras.push_back(*camera);
                camera_places_.emplace_back(r.place.transform[3]);
            }
        if (!r.visible) return;
        if (node["mesh"]) {
            const Value instancing = node["extensions"]["EXT_mesh_gpu_instancing"];
            for (const Place& place :
                 instancing ? read_instances(document_, instancing, r.place) : std::vector<Place>{r.place})
                meshes_.add_instances(node, place);
        }
        if (node["extensions"]["KHR_lights_punctual"]) {
            scene_.lights.push_back(read_light(document_, node, r.place.transform, options_.lights));
            light_places_.emplace_back(r.place.transform[3]);
        }
    }

    // Into single precision, less the origin that suits the scene.
    void place() {
        std::vector<Bounds> boxes(scene_.meshes.size());
        for (std::size_t m = 0; m < boxes.size(); ++m)
            for (const glm::vec3& p : scene_.meshes[m].positions) boxes[m].add(p);
        const std::vector<glm::dmat4>& transforms = meshes_.transforms();
        DoubleBounds bounds;
        for (std::size_t i = 0; i < transforms.size(); ++i)
            bounds.add(boxes[std::size_t(scene_.instances[i].mesh)], transforms[i]);
        scene_.origin = origin_of(bounds);
        const auto local = [this](const glm::dvec3& p) { return glm::vec3(p - scene_.origin); };
        for (std::size_t i = 0; i < transforms.size(); ++i) {
            scene_.instances[i].transform = glm::mat4(transforms[i]);
            scene_.instances[i].transform[3] = glm::vec4(local(glm::dvec3(transforms[i][3])), 1.0f);
        }
        for (std::size_t i = 0; i < camera_places_.size(); ++i)
            scene_.cameras[i].position = local(camera_places_[i]);
        for (std::size_t i = 0; i < light_places_.size(); ++i)
            scene_.lights[i].position = local(light_places_[i]);
    }

    Document& document_;
    Scene& scene_;
    const LoadOptions& options_;
    Tree tree_;
    std::vector<glm::dmat4> world_;
    SkinTable skins_;
    MeshTable meshes_;
    std::vector<glm::dvec3> camera_places_, light_places_;
};

} // namespace

void read_nodes(Document& document, Scene& scene, const LoadOptions& options) {
    Reader(document, scene, options).run();
}

} // namespace luxel::gltf
