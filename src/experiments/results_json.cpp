// SPDX-License-Identifier: MIT
#include "experiments/results_json.h"

#include <cmath>
#include <limits>

#include <fmt/ranges.h>

#include "experiments/components.h"

namespace luxel {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(glm::vec3 v) { return {v.x, v.y, v.z}; }

// JSON has no infinity (a PSNR of equal images) and no NaN: they become null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json to_json(const Camera& camera) {
    Json json = {{"position", to_json(camera.position)},
                 {"forward", to_json(camera.forward)},
                 {"up", to_json(camera.up)},
                 {"yfov", camera.yfov},
                 {"near", camera.near},
                 {"far", number(camera.far)}};
    if (camera.orthographic()) json["half_height"] = camera.half_height;
    return json;
}

Json figures_to_json(const Figures& figures) {
    Json json = Json::object();
    for (const FigureColumn& column : figure_columns) json[column.name] = number(figures.*column.member);
    return json;
}

Figures figures_from_json(const Json& json) {
    constexpr double infinity = std::numeric_limits<double>::infinity(),
                     none = std::numeric_limits<double>::quiet_NaN();
    Figures figures;
    for (const FigureColumn& column : figure_columns) {
        const Json& value = json.at(column.name);
        figures.*column.member = !value.is_null()                  ? value.get<double>()
                                 : column.member == &Figures::psnr ? infinity
                                                                   : none;
    }
    return figures;
}

Json to_json(const Spread& s) { return {{"ms", s.ms}, {"low", s.low}, {"high", s.high}}; }
Spread spread_from_json(const Json& json) { return {json.at("ms"), json.at("low"), json.at("high")}; }

Json to_json(const std::optional<OwnResult>& own) {
    if (!own) return nullptr;
    Json json = {{"component", own->component}, {"claimed", own->claimed}};
    json.update(figures_to_json(own->figures));
    return json;
}

std::optional<OwnResult> own_from_json(const Json& json) {
    if (json.is_null()) return std::nullopt;
    return OwnResult{json.at("component"), figures_from_json(json), json.at("claimed")};
}

Json to_json(const RowName& name, const RowResult& row) {
    Json json = {{"name", name.name}, {"label", name.label}, {"parameters", luxel::to_json(name.parameters)}};
    json.update(figures_to_json(row.figures));
    json.update({{"claimed", row.claimed},
                 {"unmeasured", row.unmeasured.empty() ? Json(nullptr) : Json(row.unmeasured)},
                 {"views", row.views},
                 {"own", to_json(row.own)},
                 {"ms", row.ms},
                 {"cost",
                  {{"base", to_json(row.cost.base)},
                   {"technique", to_json(row.cost.technique)},
                   {"preparation", row.cost.preparation}}},
                 {"passes", Json::array()},
                 {"memory_bytes", row.memory_bytes}});
    for (const gpu::PassTime& pass : row.passes)
        json["passes"].push_back({{"name", pass.name}, {"ms", pass.ms}});
    return json;
}

RowResult row_from_json(const Json& json) {
    RowResult row;
    row.figures = figures_from_json(json);
    row.claimed = json.at("claimed");
    if (!json.at("unmeasured").is_null()) row.unmeasured = json.at("unmeasured");
    row.views = json.at("views");
    row.own = own_from_json(json.at("own"));
    const Json& cost = json.at("cost");
    row.cost = {spread_from_json(cost.at("base")), spread_from_json(cost.at("technique")),
                cost.at("preparation")};
    row.ms = json.at("ms");
    row.memory_bytes = json.at("memory_bytes");
    for (const Json& pass : json.at("passes")) row.passes.push_back({pass.at("name"), pass.at("ms")});
    return row;
}

Json to_json(const std::vector<RowName>& names, const std::vector<RowResult>& rows) {
    Json json = Json::array();
    for (std::size_t i = 0; i < rows.size(); ++i) json.push_back(to_json(names[i], rows[i]));
    return json;
}

Json to_json(const Summary& s) {
    return {{"group", s.group},
            {"label", s.label},
            {"views", s.views},
            {"positive", s.positive},
            {"claimed", s.claimed},
            {"mean_gain", s.mean_gain},
            {"median_gain", s.median_gain},
            {"rho_before", s.rho_before},
            {"rho_after", s.rho_after},
            {"improved", s.improved},
            {"tied", s.tied}};
}

Json to_json(const std::vector<RowName>& names, const SceneEntry& entry, const SceneResult& scene) {
    FrameOptions frame = entry.frame;
    Json json = {{"name", entry.name},
                 {"source", entry.source},
                 {"group", entry.group},
                 {"environment", entry.load.environment},
                 {"environment_scale", entry.load.environment_scale},
                 {"frame", to_json(parameters_of(frame))},
                 {"views", Json::array()},
                 {"mean", to_json(names, scene.mean)},
                 {"mean_noise", scene.mean_noise},
                 {"warnings", scene.warnings}};
    for (const ViewResult& view : scene.views) json["views"].push_back(to_json(names, view));
    return json;
}

// What occlusion the truth is; null where it is light.
Json ao_of(const TruthSettings& truth) {
    if (!is_accessibility(truth.components)) return nullptr;
    ReferenceSettings reference;
    reference.ao_radius = truth.ao_radius, reference.ao_membership = truth.ao_membership;
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

Json to_json(const std::vector<RowName>& names, const ViewResult& view) {
    return {{"name", view.camera.name},
            {"size", {view.width, view.height}},
            {"camera", to_json(view.camera)},
            {"exposure", view.exposure},
            {"partial", view.partial},
            {"reference",
             {{"spp", view.reference_spp},
              {"seconds", view.reference_seconds},
              {"noise", view.noise},
              {"cached", view.reference_cached}}},
            {"techniques", to_json(names, view.rows)}};
}

ViewResult view_from_json(const Json& json, const ViewTask& task) {
    ViewResult view;
    view.camera = task.camera;
    view.width = task.width, view.height = task.height;
    view.exposure = json.at("exposure");
    const Json& reference = json.at("reference");
    view.reference_spp = reference.at("spp");
    view.reference_seconds = reference.at("seconds");
    view.noise = reference.at("noise");
    view.reference_cached = reference.at("cached");
    for (const Json& row : json.at("techniques")) view.rows.push_back(row_from_json(row));
    return view;
}

Json to_json(const ExperimentResult& result) {
    const Experiment& e = result.experiment;
    Json json = {{"schema", "luxel-results"},
                 {"schema_version", results_schema_version},
                 {"luxel_version", LUXEL_VERSION},
                 {"name", e.name},
                 {"spp", e.truth.spp},
                 {"seed", e.truth.seed},
                 {"component", fmt::format("{}", fmt::join(e.truth.components, "+"))},
                 {"ao", ao_of(e.truth)},
                 {"judge", e.truth.judge == Judge::povray ? "povray" : "reference"},
                 {"reference_lights", e.truth.true_environment ? "true" : "same"},
                 {"timed_frames", e.timed_frames},
                 {"device",
                  {{"name", result.device.name},
                   {"driver", result.device.driver},
                   {"type", result.device.type},
                   {"api_version", result.device.api_version}}},
                 {"missing", result.missing},
                 {"interrupted", result.interrupted},
                 {"scenes", Json::array()},
                 {"mean", to_json(result.rows, result.mean)},
                 {"mean_noise", result.mean_noise},
                 {"summary", Json::array()}};
    for (std::size_t i = 0; i < e.scenes.size(); ++i)
        json["scenes"].push_back(to_json(result.rows, e.scenes[i], result.scenes[i]));
    for (const Summary& s : result.summary) json["summary"].push_back(to_json(s));
    return json;
}

} // namespace luxel
