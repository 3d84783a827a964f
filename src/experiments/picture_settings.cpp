// SPDX-License-Identifier: MIT
#include "experiments/picture_settings.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "reference/content_key.h"

namespace luxel {

namespace {

using Json = nlohmann::json;

template <class T> std::string values_of(T object) {
    std::vector<std::string> values;
    for (const ParameterInfo& p : parameters_of(object)) values.push_back(p.name + "=" + p.value);
    return fmt::format("{}", fmt::join(values, ","));
}

// What lights the scene from afar; empty where nothing does.
std::string environment_text(const Scene& scene, const FrameOptions* frame) {
    if (scene.environment.empty()) return {};
    if (!frame || frame->environment == EnvironmentMode::ambient) return "the true environment";
    if (frame->environment == EnvironmentMode::none) return "no environment";
    return fmt::format("{} lights of seed {} for the environment", frame->environment_lights, frame->seed);
}

Json triple(glm::vec3 v) { return {v.x, v.y, v.z}; }
glm::vec3 triple(const Json& json) { return {json.at(0), json.at(1), json.at(2)}; }

std::string value_of(const Attributes& attributes, const char* name) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? std::string() : found->second;
}

// Within rounding of an angle or a decimal.
bool alike(float a, float b) { return a == b || std::abs(a - b) <= 1e-5f * std::max(std::abs(a), std::abs(b)); }
bool alike(glm::vec3 a, glm::vec3 b) {
    return glm::length(a - b) <= 1e-5f * std::max(glm::length(a), glm::length(b));
}

std::vector<std::string> camera_parts(const Camera& a, const Camera& b) {
    std::vector<std::string> parts;
    if (!alike(a.position, b.position)) parts.push_back("position");
    if (!alike(a.forward, b.forward)) parts.push_back("direction");
    if (!alike(a.up, b.up)) parts.push_back("up");
    if (!alike(a.yfov, b.yfov) || !alike(a.half_height, b.half_height)) parts.push_back("field of view");
    if (!alike(a.near, b.near)) parts.push_back("near plane");
    if (!alike(a.far, b.far)) parts.push_back("far plane");
    return parts;
}

std::string sampling_meaning(const std::string& sampling) {
    return sampling == "center" ? "pixel centers" : "pixel areas";
}

} // namespace

std::string camera_text(const Camera& c) {
    return Json{{"name", c.name},
                {"position", triple(c.position)},
                {"forward", triple(c.forward)},
                {"up", triple(c.up)},
                {"yfov", c.yfov},
                {"near", c.near},
                {"far", std::isfinite(c.far) ? Json(c.far) : Json(nullptr)},
                {"half_height", c.half_height}}
        .dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::optional<Camera> camera_of(const Attributes& attributes) {
    try {
        const Json json = Json::parse(value_of(attributes, attribute::camera));
        Camera c;
        c.name = json.at("name");
        c.position = triple(json.at("position")), c.forward = triple(json.at("forward")),
        c.up = triple(json.at("up"));
        c.yfov = json.at("yfov"), c.near = json.at("near");
        c.far = json.at("far").is_null() ? INFINITY : json.at("far").get<float>();
        c.half_height = json.at("half_height");
        return c;
    } catch (const Json::exception&) {
        return std::nullopt;
    }
}

std::string sampling_of(bool pixel_center) { return pixel_center ? "center" : "area"; }
std::string sampling_of(const FrameOptions& frame) { return sampling_of(frame.supersample == 1); }

Attributes attributes_of(const Scene& scene, const std::string& source, const Camera& camera,
                         const FrameOptions* frame) {
    Attributes attributes = {{attribute::version, LUXEL_VERSION},
                             {attribute::scene, source},
                             {attribute::scene_key, fmt::format("{:016x}", content_key(scene))},
                             {attribute::view, camera.name},
                             {attribute::camera, camera_text(camera)}};
    const std::string environment = environment_text(scene, frame);
    if (!environment.empty()) attributes[attribute::environment] = environment;
    return attributes;
}

void add_reference(Attributes& attributes, const std::string& component, const ReferenceSettings& settings,
                   int spp) {
    attributes[attribute::component] = component;
    attributes[attribute::spp] = fmt::format("{}", spp);
    attributes[attribute::seed] = fmt::format("{}", settings.seed);
    attributes[attribute::sampling] = sampling_of(settings.pixel_center);
    attributes[attribute::settings] = values_of(settings);
}

void add_frame(Attributes& attributes, const std::string& use, const FrameOptions& frame) {
    attributes[attribute::use] = use;
    attributes[attribute::sampling] = sampling_of(frame);
    attributes[attribute::frame] = values_of(frame);
}

std::vector<std::string> mismatches(const std::string& a_name, const Attributes& a, const std::string& b_name,
                                    const Attributes& b, bool named_layer) {
    std::vector<std::string> sentences;
    const auto differing = [&](const char* name) {
        const std::string of_a = value_of(a, name), of_b = value_of(b, name);
        return !of_a.empty() && !of_b.empty() && of_a != of_b;
    };
    if (differing(attribute::scene_key))
        sentences.push_back(fmt::format("{} and {} are of different scenes: {} and {}", a_name, b_name,
                                        value_of(a, attribute::scene), value_of(b, attribute::scene)));
    const std::optional<Camera> of_a = camera_of(a), of_b = camera_of(b);
    if (of_a && of_b)
        if (const auto parts = camera_parts(*of_a, *of_b); !parts.empty())
            sentences.push_back(
                fmt::format("{} and {} have different cameras: {}", a_name, b_name, fmt::join(parts, ", ")));
    if (differing(attribute::sampling))
        sentences.push_back(
            fmt::format("{} samples {}, {} {}: every edge counts as an error (luxel reference "
                        "--sampling center samples as frames do)",
                        a_name, sampling_meaning(value_of(a, attribute::sampling)), b_name,
                        sampling_meaning(value_of(b, attribute::sampling))));
    if (differing(attribute::environment))
        sentences.push_back(fmt::format(
            "{} is lit by {}, {} by {} (luxel reference --frame takes light as a frame does)", a_name,
            value_of(a, attribute::environment), b_name, value_of(b, attribute::environment)));
    if (!named_layer && differing(attribute::component))
        sentences.push_back(fmt::format("{} holds {}, {} {}: different light paths", a_name,
                                        value_of(a, attribute::component), b_name,
                                        value_of(b, attribute::component)));
    return sentences;
}

} // namespace luxel
