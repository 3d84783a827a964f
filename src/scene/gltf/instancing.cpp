// SPDX-License-Identifier: MIT
#include "scene/gltf/instancing.h"

#include <cmath>

#include "scene/gltf/accessor.h"
#include "scene/gltf/mesh_table.h"

namespace luxel::gltf {
namespace {

bool finite(const Place& place) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(place.transform[c][r])) return false;
    return true;
}

} // namespace

std::vector<Place> read_instances(Document& document, const Value& extension, const Place& node) {
    const Value attributes = extension["attributes"], translation = attributes["TRANSLATION"],
                rotation = attributes["ROTATION"], scale = attributes["SCALE"];
    std::uint64_t count = 0;
    for (const Value& v : {translation, rotation, scale}) {
        if (!v) continue;
        const std::uint64_t elements = accessor_count(document, v);
        if (count != 0 && elements != count) v.fail("has {} elements for {} instances", elements, count);
        count = elements;
    }
    if (count == 0) {
        document.warn("EXT_mesh_gpu_instancing without TRANSLATION, ROTATION and SCALE shows the mesh once");
        return {node};
    }
    if (count > max_instances)
        fail(Fault::resource, "{}: more than {} instances", document.name(), max_instances);

    document.charge(count, sizeof(Place));
    std::vector<glm::vec3> translations(translation ? 0 : count, glm::vec3(0.0f)),
        scales(scale ? 0 : count, glm::vec3(1.0f));
    std::vector<glm::vec4> rotations(rotation ? 0 : count, glm::vec4(0, 0, 0, 1));
    if (translation) translations = read_vec3(document, translation);
    if (rotation) rotations = read_vec4(document, rotation);
    if (scale) scales = read_vec3(document, scale);
    std::vector<Place> places;
    for (std::size_t i = 0; i < std::size_t(count); ++i) {
        const bool turned = glm::length(rotations[i]) > 1e-6f;
        const Place place =
            node * trs(glm::dvec3(translations[i]), glm::dvec4(rotations[i]), glm::dvec3(scales[i]));
        if (turned && finite(place))
            places.push_back(place);
        else
            document.warn("an instance without a finite place is left out");
    }
    return places;
}

} // namespace luxel::gltf
