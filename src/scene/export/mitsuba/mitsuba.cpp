// SPDX-License-Identifier: MIT
#include "scene/export/mitsuba/mitsuba.h"

#include <algorithm>
#include <cmath>

#include "core/file.h"
#include "core/image_io.h"
#include "scene/export/geometry.h"
#include "scene/export/look.h"
#include "scene/export/sky.h"
#include "scene/printable.h"

namespace luxel {
namespace {

// For comments: two hyphens would end one.
std::string comment(const std::string& text) {
    std::string safe;
    for (char c : ascii(text)) safe += c == '-' ? '_' : c;
    return safe;
}
std::string numbers(glm::vec3 v) { return fmt::format("{}, {}, {}", v.x, v.y, v.z); }
float degrees_of(float versine) { return glm::degrees(shared::versine_angle(versine)); }
std::string look_at(glm::vec3 origin, glm::vec3 direction, glm::vec3 up) {
    return fmt::format("<lookat origin=\"{}\" target=\"{}\" up=\"{}\"/>", numbers(origin),
                       numbers(origin + direction), numbers(up));
}

// Rays begin and end at its clipping planes. Without a far one: behind all that there is.
void add_view(ExportOutput& out, const ExportedView& view) {
    const Camera& c = view.camera;
    const Bounds bounds = out.scene.bounds();
    const float behind = glm::length(c.position - bounds.center()) + 2.0f * bounds.radius() + 1.0f;
    const bool parallel = c.half_height > 0.0f;
    out.add("<sensor type=\"{}\"> <!-- {} -->\n", parallel ? "orthographic" : "perspective", comment(c.name));
    if (!parallel)
        out.add("  <string name=\"fov_axis\" value=\"y\"/>\n  <float name=\"fov\" value=\"{}\"/>\n",
                glm::degrees(c.yfov));
    out.add("  <float name=\"near_clip\" value=\"{}\"/>\n  <float name=\"far_clip\" value=\"{}\"/>\n", c.near,
            std::isfinite(c.far) ? std::min(c.far, std::max(behind, 2.0f * c.near)) : behind);
    out.add("  <transform name=\"to_world\">\n");
    // A parallel picture is two units wide.
    if (parallel) {
        const float half_width = c.half_height * float(view.width) / float(view.height);
        out.add("    <scale x=\"{}\" y=\"{}\"/>\n", half_width, half_width);
    }
    out.add("    {}\n  </transform>\n", look_at(c.position, c.forward, c.up));
    out.add("  <sampler type=\"independent\"><integer name=\"sample_count\" value=\"256\"/></sampler>\n"
            "  <film type=\"hdrfilm\">\n    <integer name=\"width\" value=\"{}\"/>\n"
            "    <integer name=\"height\" value=\"{}\"/>\n    <string name=\"pixel_format\" value=\"rgb\"/>\n"
            "    <string name=\"component_format\" value=\"float32\"/>\n    <rfilter type=\"box\"/>\n"
            "  </film>\n</sensor>\n",
            view.width, view.height);
}

void add_light(ExportOutput& out, const shared::Light& light) {
    if (light.range > 0.0f) out.note("the range of point and spot lights: their light goes on");
    const std::string rgb = numbers(light.intensity);
    // Any direction that is not the light's own.
    const glm::vec3 up = std::abs(light.direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    switch (light.type) {
    case shared::LIGHT_POINT:
        return out.add(
            "<emitter type=\"point\"><point name=\"position\" value=\"{}\"/><rgb name=\"intensity\" "
            "value=\"{}\"/></emitter>\n",
            numbers(light.position), rgb);
    case shared::LIGHT_SPOT:
        out.note("the soft rim of spot lights: linear in the angle instead of a square of the cosine");
        return out.add("<emitter type=\"spot\"><rgb name=\"intensity\" value=\"{}\"/><float "
                       "name=\"cutoff_angle\" value=\"{}\"/><float name=\"beam_width\" "
                       "value=\"{}\"/><transform name=\"to_world\">{}</transform></emitter>\n",
                       rgb, degrees_of(light.outer), degrees_of(light.inner),
                       look_at(light.position, light.direction, up));
    case shared::LIGHT_DIRECTIONAL:
        return out.add("<emitter type=\"directional\"><vector name=\"direction\" value=\"{}\"/><rgb "
                       "name=\"irradiance\" value=\"{}\"/></emitter>\n",
                       numbers(light.direction), rgb);
    default:
        return out.note("lights of a kind of their own: left out");
    }
}

void add_lights(ExportOutput& out) {
    for (const shared::Light& light : out.scene.lights) add_light(out, light);
    const Environment& environment = out.scene.environment;
    if (environment.empty()) return;
    const std::string name = out.stem + "-sky.exr";
    write_exr(out.folder / name, {{"", environment.radiance}});
    out.add("<emitter type=\"envmap\"><string name=\"filename\" value=\"{}\"/><float name=\"scale\" "
            "value=\"{}\"/><transform name=\"to_world\"><rotate y=\"1\" "
            "angle=\"{}\"/></transform></emitter>\n",
            name, environment.scale, mitsuba_sky_angle(environment));
}

const char* wrap_name(Wrap wrap) {
    return wrap == Wrap::clamp ? "clamp" : wrap == Wrap::mirror ? "mirror" : "repeat";
}

std::string picture(const char* name, const Channel& channel, bool raw) {
    return fmt::format("<texture type=\"bitmap\" name=\"{}\"><string name=\"filename\" value=\"{}\"/>"
                       "<boolean name=\"raw\" value=\"{}\"/><string name=\"wrap_mode\" value=\"{}\"/><string "
                       "name=\"filter_type\" value=\"{}\"/></texture>",
                       name, channel.file, raw, wrap_name(channel.wrap_u),
                       channel.nearest ? "nearest" : "bilinear");
}
std::string color(const char* name, const Channel& channel) {
    return channel.file.empty() ? fmt::format("<rgb name=\"{}\" value=\"{}\"/>", name, numbers(channel.value))
                                : picture(name, channel, false);
}
std::string number(const char* name, const Channel& channel) {
    return channel.file.empty() ? fmt::format("<float name=\"{}\" value=\"{}\"/>", name, channel.number())
                                : picture(name, channel, true);
}

std::string glass(ExportOutput& out, const Material& m, const Look& look) {
    if (m.thin && m.roughness > 0.0f) out.note("rough thin glass: smooth");
    const std::string ior = fmt::format("<float name=\"int_ior\" value=\"{}\"/>", look.ior);
    if (m.thin)
        return "<bsdf type=\"thindielectric\">" + ior + color("specular_transmittance", look.color) +
               "</bsdf>";
    const bool smooth = look.alpha.file.empty() && look.alpha.number() <= 1e-6f;
    return fmt::format("<bsdf type=\"{}\">", smooth ? "dielectric" : "roughdielectric") + ior +
           (smooth ? "" : "<string name=\"distribution\" value=\"ggx\"/>" + number("alpha", look.alpha)) +
           color("specular_transmittance", look.color) + "</bsdf>";
}

// Its roughness is the perceptual one, as glTF's; Disney's diffuse lobe is not Lambertian, so that what does
// not reflect is `diffuse`.
std::string opaque(ExportOutput& out, const Look& look) {
    const bool plain = look.metallic.file.empty() && look.metallic.number() <= 0.0f;
    if (plain && !look.reflects)
        return "<bsdf type=\"diffuse\">" + color("reflectance", look.color) + "</bsdf>";
    const bool metal = look.metallic.file.empty() && look.metallic.number() >= 1.0f;
    if (metal) {
        const bool smooth = look.alpha.file.empty() && look.alpha.number() <= 1e-6f;
        out.note("the tint of metals: Fresnel's rise to white at grazing angles is not in it");
        return fmt::format("<bsdf type=\"{}\"><string name=\"material\" value=\"none\"/>",
                           smooth ? "conductor" : "roughconductor") +
               (smooth ? "" : "<string name=\"distribution\" value=\"ggx\"/>" + number("alpha", look.alpha)) +
               color("specular_reflectance", look.color) + "</bsdf>";
    }
    if (plain && look.alpha.file.empty()) {
        const bool smooth = look.alpha.number() <= 1e-6f;
        return fmt::format("<bsdf type=\"{}\">", smooth ? "plastic" : "roughplastic") +
               (smooth ? ""
                       : fmt::format("<string name=\"distribution\" value=\"ggx\"/><float name=\"alpha\" "
                                     "value=\"{}\"/>",
                                     look.alpha.number())) +
               fmt::format("<float name=\"int_ior\" value=\"{}\"/>", look.ior) +
               color("diffuse_reflectance", look.color) + "</bsdf>";
    }
    out.note("the diffuse lobe of half metals and textured roughness: Disney's instead of Lambert's");
    return "<bsdf type=\"principled\">" + color("base_color", look.color) +
           number("roughness", look.roughness) + number("metallic", look.metallic) +
           fmt::format("<float name=\"eta\" value=\"{}\"/></bsdf>", std::max(look.ior, 1.001f));
}

void declare_material(ExportOutput& out, const Material& m, const Look& look, const std::string& name) {
    std::string bsdf = look.glass ? glass(out, m, look) : opaque(out, look);
    if (!look.normal_map.file.empty())
        bsdf = "<bsdf type=\"normalmap\">" + picture("normalmap", look.normal_map, true) + bsdf + "</bsdf>";
    if (!look.glass) bsdf = "<bsdf type=\"twosided\">" + bsdf + "</bsdf>";
    if (!look.coverage.file.empty() || look.coverage.number() < 1.0f)
        bsdf = "<bsdf type=\"mask\">" + number("opacity", look.coverage) + bsdf + "</bsdf>";
    // The outermost has the name that shapes refer to.
    bsdf.insert(bsdf.find('>'), " id=\"" + name + "\"");
    out.add("<!-- {} -->\n{}\n", comment(m.name), bsdf);
}

void add_shape(ExportOutput& out, const ExportedShape& shape, const Look& look, const std::string& material) {
    const glm::mat4& m = shape.transform;
    out.add("<shape type=\"ply\"> <!-- {} -->\n  <string name=\"filename\" value=\"{}\"/>\n",
            comment(shape.instance->name), shape.file);
    out.add("  <transform name=\"to_world\"><matrix value=\"");
    for (int row = 0; row < 4; ++row)
        out.add("{}{} {} {} {}", row ? " " : "", m[0][row], m[1][row], m[2][row], m[3][row]);
    out.add("\"/></transform>\n  <ref id=\"{}\"/>\n", material);
    if (emits(*shape.material)) {
        if (shape.material->double_sided) out.note("emitters of both sides: light from their front alone");
        out.add("  <boolean name=\"face_normals\" value=\"true\"/>\n  <emitter type=\"area\">{}</emitter>\n",
                color("radiance", look.emission));
    }
    if (look.absorption != glm::vec3(0.0f))
        out.add(
            "  <medium name=\"interior\" type=\"homogeneous\"><rgb name=\"albedo\" value=\"0, 0, 0\"/><rgb "
            "name=\"sigma_t\" value=\"{}\"/></medium>\n",
            numbers(look.absorption));
    out.add("</shape>\n");
}

} // namespace

std::vector<std::string> write_mitsuba(const std::filesystem::path& file, const Scene& scene,
                                       const ExportedView& view) {
    ExportOutput out(scene, file);
    out.note_origin();
    add_view(out, view);
    add_lights(out);
    const UsedParts used = used_parts(scene);
    std::vector<Look> looks(scene.materials.size());
    const auto name_of = [](std::size_t index) { return fmt::format("M{}", index); };
    bool absorbs = false;
    for (std::size_t i = 0; i < looks.size(); ++i) {
        if (!used.materials[i]) continue;
        looks[i] = make_look(out, i, true);
        absorbs = absorbs || looks[i].absorption != glm::vec3(0.0f);
        declare_material(out, scene.materials[i], looks[i], name_of(i));
    }
    for (const ExportedShape& shape : write_shapes(out, false))
        add_shape(out, shape, looks[shape.material_index], name_of(shape.material_index));

    std::string head = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!-- " + comment(scene.name) +
                       ", exported by luxel for Mitsuba 3; render with: mitsuba " + comment(out.stem) +
                       ".xml -->\n";
    std::vector<std::string> approximated = out.approximated();
    for (const std::string& sentence : approximated)
        head += "<!-- approximated: " + comment(sentence) + " -->\n";
    head += fmt::format("<scene version=\"3.0.0\">\n<integrator type=\"{}\"><integer name=\"max_depth\" "
                        "value=\"32\"/></integrator>\n",
                        absorbs ? "volpath" : "path");
    write_file(file, std::string_view(head + out.text + "</scene>\n"));
    return approximated;
}

} // namespace luxel
