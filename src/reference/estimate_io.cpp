// SPDX-License-Identifier: MIT
#include "reference/estimate_io.h"

#include <charconv>

#include "core/error.h"

namespace luxel {
namespace {

constexpr const char* spp_attribute = "luxel.spp";

int parse_spp(const std::string& text) {
    int spp = 0;
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), spp);
    return error == std::errc() && end == text.data() + text.size() ? spp : 0;
}

} // namespace

std::string group_layer(const std::string& component, int group) {
    return fmt::format("{}{}group{}", component, component.empty() ? "" : ".", group);
}

Layers layers_of(const Estimate& estimate) {
    Layers layers;
    for (const auto& [name, mean] : estimate.mean) {
        layers[name] = mean;
        layers[name + ".variance"] = estimate.variance.at(name);
        for (int g = 0; g < sample_groups; ++g)
            layers[group_layer(name, g)] = estimate.group[std::size_t(g)].at(name);
    }
    layers["mask"] = estimate.mask;
    return layers;
}

void write_estimate(const std::filesystem::path& file, const Estimate& estimate,
                    const std::map<std::string, std::string>& metadata) {
    std::map<std::string, std::string> attributes = metadata;
    attributes[spp_attribute] = std::to_string(estimate.spp);
    write_exr(file, layers_of(estimate), attributes);
}

StoredEstimate read_estimate(const std::filesystem::path& file) {
    ExrFile exr = read_exr(file);
    StoredEstimate stored;
    stored.metadata = exr.metadata;
    Estimate& e = stored.estimate;
    e.spp = parse_spp(exr.metadata[spp_attribute]);
    if (e.spp < 1)
        fail(Fault::bad_input, "{}: no estimate: its attribute {} is missing", file.string(), spp_attribute);

    // Take each layer out of the file by its name; one that lacks makes the file useless.
    auto take = [&](const std::string& name) {
        auto found = exr.layers.find(name);
        if (found == exr.layers.end())
            fail(Fault::bad_input, "{}: no estimate: layer {} is missing", file.string(), name);
        return std::move(found->second);
    };
    e.mask = take("mask");
    e.width = e.mask.width, e.height = e.mask.height;
    for (const std::string& name : component_names) {
        if (!exr.layers.contains(name)) continue;
        e.mean[name] = take(name);
        e.variance[name] = take(name + ".variance");
        for (int g = 0; g < sample_groups; ++g) e.group[std::size_t(g)][name] = take(group_layer(name, g));
    }
    if (e.mean.empty()) fail(Fault::bad_input, "{}: no estimate: it has no component", file.string());
    return stored;
}

} // namespace luxel
