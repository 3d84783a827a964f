// SPDX-License-Identifier: MIT
// The binary part of a glTF file and what points into it.
#pragma once
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace luxel::gltf_export {

using Json = nlohmann::ordered_json;

enum class ViewOf { vertices = 34962, indices = 34963, picture = 0 };

class Buffer {
public:
    std::string bytes;
    Json views = Json::array(), accessors = Json::array();

    std::size_t add_view(std::span<const std::byte> data, ViewOf what);
    // With its bounds, which positions must have.
    template <int N> std::size_t add(const std::vector<glm::vec<N, float>>& values, bool bounds = false) {
        Json accessor = {{"bufferView", add_view(std::as_bytes(std::span(values)), ViewOf::vertices)},
                         {"componentType", 5126},
                         {"count", values.size()},
                         {"type", N == 2   ? "VEC2"
                                  : N == 3 ? "VEC3"
                                           : "VEC4"}};
        if (bounds) {
            glm::vec<N, float> least = values.at(0), most = values.at(0);
            for (const auto& value : values) least = glm::min(least, value), most = glm::max(most, value);
            for (int i = 0; i < N; ++i)
                accessor["min"].push_back(least[i]), accessor["max"].push_back(most[i]);
        }
        accessors.push_back(std::move(accessor));
        return accessors.size() - 1;
    }
    std::size_t add(const std::vector<std::uint32_t>& indices);
};

} // namespace luxel::gltf_export
