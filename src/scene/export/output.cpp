// SPDX-License-Identifier: MIT
#include "scene/export/output.h"

#include <algorithm>
#include <cctype>

namespace luxel {
namespace {

std::string file_stem(const std::filesystem::path& file) {
    std::string stem = file.stem().string().substr(0, 80);
    for (char& c : stem)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
    return stem;
}

} // namespace

ExportOutput::ExportOutput(const Scene& s, const std::filesystem::path& file)
    : scene(s), folder(file.parent_path()), stem(file_stem(file)) {}

void ExportOutput::note(const std::string& sentence) {
    const auto known =
        std::find_if(notes_.begin(), notes_.end(), [&](const auto& note) { return note.first == sentence; });
    if (known == notes_.end())
        notes_.emplace_back(sentence, 1);
    else
        ++known->second;
}

void ExportOutput::note_origin() {
    const glm::dvec3 o = scene.origin;
    if (o != glm::dvec3(0.0))
        note(fmt::format("positions: without the scene's origin ({}, {}, {})", o.x, o.y, o.z));
}

std::vector<std::string> ExportOutput::approximated() const {
    std::vector<std::string> sentences;
    for (const auto& [sentence, count] : notes_)
        sentences.push_back(count == 1 ? sentence : fmt::format("{} ({} times)", sentence, count));
    return sentences;
}

UsedParts used_parts(const Scene& scene) {
    UsedParts used{std::vector<bool>(scene.meshes.size()), std::vector<bool>(scene.materials.size())};
    for (const Instance& instance : scene.instances) {
        used.meshes[std::size_t(instance.mesh)] = true;
        used.materials[std::size_t(scene.meshes[std::size_t(instance.mesh)].material)] = true;
    }
    return used;
}

} // namespace luxel
