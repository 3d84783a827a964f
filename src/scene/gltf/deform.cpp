// SPDX-License-Identifier: MIT
#include "scene/gltf/deform.h"

#include <cmath>

#include "scene/gltf/accessor.h"
#include "scene/gltf/transform.h"
#include "scene/recenter.h"

namespace luxel::gltf {
namespace {

// Adds weight x delta where both the base and the target have the attribute; further components of `base`
// stay.
template <class Base, class Read>
void add_target(Document& document, const Value& delta, float weight, std::vector<Base>& base, Read read) {
    if (!delta || base.empty()) return;
    if (accessor_count(document, delta) != base.size())
        delta.fail("has {} elements for {} vertices", accessor_count(document, delta), base.size());
    const auto values = read(document, delta);
    constexpr int components = std::min(Base::length(), decltype(values)::value_type::length());
    for (std::size_t i = 0; i < base.size(); ++i)
        for (int c = 0; c < components; ++c) base[i][c] += weight * values[i][c];
}

// What moves one vertex: at most four joints from each set of attributes.
struct Influences {
    std::vector<glm::vec4> joints, weights;
};

std::vector<Influences> read_influences(Document& document, const Value& attributes, std::size_t vertices) {
    std::vector<Influences> sets;
    for (int set = 0;; ++set) {
        const Value joints = attributes[fmt::format("JOINTS_{}", set).c_str()],
                    weights = attributes[fmt::format("WEIGHTS_{}", set).c_str()];
        if (!joints || !weights) return sets;
        for (const Value& v : {joints, weights})
            if (accessor_count(document, v) != vertices)
                v.fail("has {} elements for {} vertices", accessor_count(document, v), vertices);
        sets.push_back({read_vec4(document, joints), read_vec4(document, weights)});
    }
}

// The matrix of one vertex; counts weights that had to be mended.
glm::dmat4 blend(const std::vector<Influences>& sets, std::size_t vertex, const Joints& joints,
                 const Value& attributes, std::size_t& mended) {
    glm::dmat4 sum(0.0);
    double total = 0.0;
    bool negative = false;
    for (const Influences& set : sets)
        for (int k = 0; k < 4; ++k) {
            const float joint = set.joints[vertex][k], weight = set.weights[vertex][k];
            if (!(joint >= 0.0f && joint < float(joints.size())))
                attributes.fail("vertex {} moves with joint {} of a skin of {}", vertex, joint,
                                joints.size());
            if (!(weight > 0.0f) || !std::isfinite(weight)) {
                negative = negative || weight != 0.0f;
                continue;
            }
            sum += joints[std::size_t(joint)] * double(weight);
            total += double(weight);
        }

    // Weights of eight or sixteen bits add up to 1 within their rounding only.
    if (negative || std::abs(total - 1.0) > 0.01) ++mended;
    if (total > 0.0) return sum * (1.0 / total);
    return joints[std::size_t(sets[0].joints[vertex][0])];
}

} // namespace

const Joints& SkinTable::joints(std::size_t index) {
    const auto [entry, added] = known_.try_emplace(index);
    if (!added) return entry->second;
    const Value skin = document_.root()["skins"].at(index), list = skin["joints"];
    if (list.size() == 0) skin.fail("has no joints");
    std::vector<glm::dmat4> bind(list.size(), glm::dmat4(1.0));
    if (const Value inverse = skin["inverseBindMatrices"]) {
        const std::vector<glm::mat4> read = read_mat4(document_, inverse);
        if (read.size() < bind.size())
            inverse.fail("has {} matrices for {} joints", read.size(), bind.size());
        for (std::size_t i = 0; i < bind.size(); ++i) bind[i] = glm::dmat4(read[i]);
    }
    for (std::size_t i = 0; i < bind.size(); ++i)
        entry->second.push_back(world_[list.at(i).index(world_.size(), "node")] * bind[i]);
    return entry->second;
}

void morph(Document& document, const Value& primitive, std::span<const float> weights, Mesh& mesh) {
    const Value targets = primitive["targets"];
    if (!weights.empty() && weights.size() != targets.size())
        targets.fail("there are {} weights for {} morph targets", weights.size(), targets.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (weights[i] == 0.0f) continue;
        const Value target = targets.at(i);
        const auto vec3 = [](Document& d, const Value& v) { return read_vec3(d, v); };
        const auto vec2 = [](Document& d, const Value& v) { return read_vec2(d, v); };
        const auto vec4 = [](Document& d, const Value& v) { return read_vec4(d, v, true); };
        add_target(document, target["POSITION"], weights[i], mesh.positions, vec3);
        add_target(document, target["NORMAL"], weights[i], mesh.normals, vec3);
        add_target(document, target["TANGENT"], weights[i], mesh.tangents, vec3);
        add_target(document, target["TEXCOORD_0"], weights[i], mesh.texcoords[0], vec2);
        add_target(document, target["TEXCOORD_1"], weights[i], mesh.texcoords[1], vec2);
        add_target(document, target["COLOR_0"], weights[i], mesh.colors, vec4);
    }
}

bool apply_skin(Document& document, const Value& primitive, const Joints& joints, Mesh& mesh,
                glm::dvec3& offset) {
    const Value attributes = primitive["attributes"];
    const std::size_t vertices = mesh.positions.size();
    const std::vector<Influences> sets = read_influences(document, attributes, vertices);
    if (sets.empty()) return false;
    document.charge(vertices, sizeof(glm::dvec3) + sizeof(char));
    std::vector<glm::dvec3> world(vertices);
    std::vector<char> mirrored(vertices);
    std::size_t mended = 0;
    for (std::size_t i = 0; i < vertices; ++i) {
        const glm::dmat4 m = blend(sets, i, joints, attributes, mended);
        const glm::dmat3 linear(m);
        world[i] = glm::dvec3(m * glm::dvec4(glm::dvec3(mesh.positions[i]), 1.0));
        mirrored[i] = glm::determinant(linear) < 0.0;
        const double side = mirrored[i] ? -1.0 : 1.0;
        if (!mesh.normals.empty()) {
            const glm::dvec3 n = cofactors(linear) * glm::dvec3(mesh.normals[i]) * side;
            const double length = glm::length(n); // of small scales it underflows
            mesh.normals[i] = length > 0.0 ? glm::vec3(n / length) : glm::vec3(0.0f);
        }
        if (!mesh.tangents.empty()) {
            const glm::dvec3 t = linear * glm::dvec3(glm::vec3(mesh.tangents[i]));
            const double length = glm::length(t);
            mesh.tangents[i] = glm::vec4(length > 0.0 ? glm::vec3(t / length) : glm::vec3(0.0f),
                                         mesh.tangents[i].w * float(side));
        }
    }
    if (mended > 0)
        document.warn("joint weights that do not add up to 1 are scaled until they do", int(mended));

    // Front faces are counter-clockwise before the joints move them; mirrored ones are turned around.
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        if (mirrored[mesh.indices[i]] + mirrored[mesh.indices[i + 1]] + mirrored[mesh.indices[i + 2]] >= 2)
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);

    DoubleBounds bounds;
    for (const glm::dvec3& p : world) bounds.add(p);
    offset = origin_of(bounds);
    for (std::size_t i = 0; i < vertices; ++i) mesh.positions[i] = glm::vec3(world[i] - offset);
    return true;
}

} // namespace luxel::gltf
