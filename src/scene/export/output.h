// SPDX-License-Identifier: MIT
// What every export shares: a text that grows, files beside it, and what the format cannot say, counted.
#pragma once
#include <filesystem>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/scene.h"

namespace luxel {

struct ExportedView {
    Camera camera;
    int width = 640, height = 480; // pixels
};

struct ExportOutput {
    const Scene& scene;
    std::filesystem::path folder; // of the files
    std::string stem;             // that their names begin with: letters, digits, '-', '_'
    std::string text;

    ExportOutput(const Scene& s, const std::filesystem::path& file);
    template <class... Args> void add(fmt::format_string<Args...> format, Args&&... args) {
        fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
    }
    // Once for each thing that it is true of. "normal maps: left out"
    void note(const std::string& sentence);
    void note_origin(); // where positions are about another origin than the files'
    // "normal maps: left out (3 times)", in the order of their first notes.
    std::vector<std::string> approximated() const;

private:
    std::vector<std::pair<std::string, int>> notes_;
};

// Which meshes and materials are drawn: a file may hold more than its scene shows.
struct UsedParts {
    std::vector<bool> meshes, materials;
};
UsedParts used_parts(const Scene& scene);

inline bool emits(const Material& material) { return material.emission != glm::vec3(0.0f); }

} // namespace luxel
