// SPDX-License-Identifier: MIT
#include "experiments/components.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/closest.h"
#include "core/error.h"
#include "reference/reference.h"

namespace luxel {

namespace {

// The families of light paths inside a component, as far as components overlap.
std::set<std::string> parts_of(const std::string& component) {
    if (component == "full")
        return {"direct", "first bounce", "later bounces", "reflections", "caustics", "other specular"};
    if (component == "specular") return {"reflections", "caustics", "other specular"};
    if (component == "diffuse") return {"first bounce", "later bounces"};
    if (component == "diffuse1" || component == "diffuse1_unoccluded") return {"first bounce"};
    return {component};
}

} // namespace

std::vector<std::string> parse_components(std::string_view text) {
    std::vector<std::string> components;
    std::set<std::string> seen;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('+', begin), text.size());
        const std::string name(text.substr(begin, end - begin));
        begin = end + 1;

        if (std::find(component_names.begin(), component_names.end(), name) == component_names.end())
            fail(Fault::usage, "component: '{}' is unknown; {}", name, known_are(name, component_names));
        for (const std::string& part : parts_of(name))
            if (!seen.insert(part).second)
                fail(Fault::usage, "component: '{}' counts the same light twice ({})", text, part);
        components.push_back(name);
    }
    for (const char* no_light : {"ao", "caustics_bias", "photon_bias"})
        if (components.size() > 1 && seen.count(no_light))
            fail(Fault::usage, "component: '{}' adds {}, which is no radiance, to light", text, no_light);
    return components;
}

std::vector<std::string> without_parts(const std::set<std::string>& components) {
    std::vector<std::string> kept;
    for (const std::string& name : components) {
        const std::set<std::string> parts = parts_of(name);
        const bool contained =
            std::any_of(components.begin(), components.end(), [&](const std::string& other) {
                const std::set<std::string> whole = parts_of(other);
                return whole.size() > parts.size() &&
                       std::includes(whole.begin(), whole.end(), parts.begin(), parts.end());
            });
        if (!contained) kept.push_back(name);
    }
    return kept;
}

bool is_accessibility(const std::vector<std::string>& components) {
    return components == std::vector<std::string>{"ao"};
}

Image sum_of(const Layers& layers, const std::vector<std::string>& components) {
    Image sum;
    for (const std::string& name : components) {
        const auto layer = layers.find(name);
        LUXEL_ASSERT(layer != layers.end(), "component={}", name);
        if (sum.empty()) {
            sum = layer->second;
            continue;
        }
        LUXEL_ASSERT(sum.data.size() == layer->second.data.size(), "component={}", name);
        for (std::size_t i = 0; i < sum.data.size(); ++i) sum.data[i] += layer->second.data[i];
    }
    return sum;
}

} // namespace luxel
