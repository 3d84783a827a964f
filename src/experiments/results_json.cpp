// SPDX-License-Identifier: MIT
#include "experiments/results_json.h"

#include <fmt/ranges.h>

#include "experiments/components.h"

namespace luxel {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(glm::vec3 v) { return {v.x, v.y, v.z}; }

Json to_json(const Camera& camera) {
    return {{"position", to_json(camera.position)},
            {"forward", to_json(camera.forward)},
            {"up", to_json(camera.up)},
            {"yfov", camera.yfov},
            {"near", camera.near},
            {"far", camera.far}};
}

// An infinite PSNR becomes null: JSON has no infinity.
Json to_json(const RowName& name, const RowResult& row) {
    Json json = {{"name", name.name}, {"label", name.label}, {"parameters", luxel::to_json(name.parameters)}};

    const Figures& f = row.figures;
    json.update({{"delta", f.delta},
                 {"gain", f.gain},
                 {"gain_error", f.gain_error},
                 {"claimed", row.claimed},
                 {"rho", f.rho},
                 {"improved", f.improved},
                 {"tied", f.tied},
                 {"quality", f.quality},
                 {"rmse", f.rmse},
                 {"relmse", f.relmse},
                 {"psnr", f.psnr},
                 {"ssim", f.ssim},
                 {"flip", f.flip},
                 {"ms", row.ms},
                 {"passes", Json::array()},
                 {"memory_bytes", row.memory_bytes}});
    for (const gpu::PassTime& pass : row.passes)
        json["passes"].push_back({{"name", pass.name}, {"ms", pass.ms}});
    return json;
}

Json to_json(const std::vector<RowName>& names, const std::vector<RowResult>& rows) {
    Json json = Json::array();
    for (std::size_t i = 0; i < rows.size(); ++i) json.push_back(to_json(names[i], rows[i]));
    return json;
}

Json to_json(const std::vector<RowName>& names, const ViewResult& view) {
    return {{"name", view.camera.name},
            {"camera", to_json(view.camera)},
            {"exposure", view.exposure},
            {"reference",
             {{"spp", view.reference_spp},
              {"seconds", view.reference_seconds},
              {"noise", view.noise},
              {"cached", view.reference_cached}}},
            {"techniques", to_json(names, view.rows)}};
}

// What occlusion the truth is; null where it is light.
Json ao_of(const EvaluationSettings& settings) {
    if (!is_accessibility(settings.components)) return nullptr;
    ReferenceSettings reference;
    reference.ao_radius = settings.ao_radius, reference.ao_membership = settings.ao_membership;
    const Json all = luxel::to_json(parameters_of(reference));
    return {{"radius", all["ao_radius"]}, {"membership", all["ao_membership"]}};
}

} // namespace

Json typed_value(const ParameterInfo& parameter) {
    if (parameter.type == "flag") return parameter.value == "on";
    if (parameter.type == "real" || parameter.type == "integer") return Json::parse(parameter.value);
    return parameter.value;
}

Json to_json(const std::vector<ParameterInfo>& parameters) {
    Json json = Json::object();
    for (const ParameterInfo& p : parameters) json[p.name] = typed_value(p);
    return json;
}

Json to_json(const EvaluationResult& result) {
    const EvaluationSettings& s = result.settings;
    FrameOptions frame = s.frame;
    Json json = {{"schema", "luxel-results"},
                 {"schema_version", results_schema_version},
                 {"luxel_version", LUXEL_VERSION},
                 {"scene", s.scene},
                 {"size", {s.width, s.height}},
                 {"spp", s.spp},
                 {"seed", s.seed},
                 {"component", fmt::format("{}", fmt::join(s.components, "+"))},
                 {"ao", ao_of(s)},
                 {"device",
                  {{"name", result.device.name},
                   {"driver", result.device.driver},
                   {"type", result.device.type},
                   {"api_version", result.device.api_version}}},
                 {"frame", to_json(parameters_of(frame))},
                 {"reference_lights", s.true_environment ? "true" : "same"},
                 {"timed_frames", s.timed_frames},
                 {"views", Json::array()},
                 {"mean", to_json(result.rows, result.mean)},
                 {"mean_noise", result.mean_noise},
                 {"warnings", result.warnings}};
    for (const ViewResult& view : result.views) json["views"].push_back(to_json(result.rows, view));
    return json;
}

} // namespace luxel
