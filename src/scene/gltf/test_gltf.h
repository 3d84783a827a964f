// SPDX-License-Identifier: MIT
// Small glTF files made by tests.
#pragma once
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "scene/gltf/gltf.h"
#include "support/temporary_folder.h"

namespace luxel::testing {

// A file with one triangle, (0,0,0) (1,0,0) (0,1,0), and a node that shows it; tests change `json` and
// `bytes` at will.
struct TestGltf {
    nlohmann::json json = {{"asset", {{"version", "2.0"}}},
                           {"nodes", {{{"mesh", 0}}}},
                           {"meshes", {{{"primitives", {{{"attributes", nlohmann::json::object()}}}}}}},
                           {"scenes", {{{"nodes", {0}}}}},
                           {"scene", 0}};
    std::vector<std::uint8_t> bytes;
    TemporaryFolder folder;

    TestGltf() { primitive()["attributes"]["POSITION"] = add_vectors<3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}); }

    nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }
    nlohmann::json& attributes() { return primitive()["attributes"]; }
    // Material 0, used by the triangle.
    nlohmann::json& material() {
        primitive()["material"] = 0;
        return json["materials"][0];
    }

    int add_view(const void* data, std::size_t size) {
        while (bytes.size() % 4 != 0) bytes.push_back(0);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
        const auto* first = static_cast<const std::uint8_t*>(data);
        bytes.insert(bytes.end(), first, first + size);
        return int(json["bufferViews"].size()) - 1;
    }
    template <class T>
    int add_accessor(const std::vector<T>& values, std::size_t count, const char* type, int component) {
        const int view = add_view(values.data(), values.size() * sizeof(T));
        json["accessors"].push_back(
            {{"bufferView", view}, {"count", count}, {"type", type}, {"componentType", component}});
        return int(json["accessors"].size()) - 1;
    }
    template <int N> int add_vectors(const std::vector<glm::vec<N, float>>& values) {
        return add_accessor(values, values.size(), N == 2 ? "VEC2" : N == 3 ? "VEC3" : "VEC4", 5126);
    }
    nlohmann::json& accessor(int index) { return json["accessors"][std::size_t(index)]; }

    std::filesystem::path save() {
        if (!bytes.empty() && !json.contains("buffers")) {
            json["buffers"] = {{{"uri", "scene.bin"}, {"byteLength", bytes.size()}}};
            folder.add("scene.bin", std::span<const std::uint8_t>(bytes));
        }
        return folder.add("scene.gltf", std::string_view(json.dump()));
    }
    std::vector<std::uint8_t> glb() {
        json["buffers"] = {{{"byteLength", bytes.size()}}};
        std::string text = json.dump();
        while (text.size() % 4 != 0) text += ' ';
        while (bytes.size() % 4 != 0) bytes.push_back(0);
        std::vector<std::uint8_t> file;
        const auto word = [&file](std::size_t value) {
            for (int i = 0; i < 4; ++i) file.push_back(std::uint8_t(value >> (8 * i)));
        };
        word(0x46546c67), word(2), word(12 + 8 + text.size() + 8 + bytes.size());
        word(text.size()), word(0x4e4f534a);
        file.insert(file.end(), text.begin(), text.end());
        word(bytes.size()), word(0x004e4942);
        file.insert(file.end(), bytes.begin(), bytes.end());
        return file;
    }
    Scene load(const LoadOptions& options = {}) { return load_gltf(save(), options); }
};

// The sentence of the error that `load` throws; fails the test when it throws none or one of another fault.
template <class Load> std::string sentence(Fault fault, Load&& load) {
    try {
        load();
    } catch (const Error& error) {
        EXPECT_EQ(int(error.fault()), int(fault)) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    ADD_FAILURE() << "no error";
    return {};
}

#define EXPECT_CONTAINS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

} // namespace luxel::testing
