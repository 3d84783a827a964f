// SPDX-License-Identifier: MIT
#include "scene/export/pbrt/pbrt.h"

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

std::string numbers(glm::vec3 v) { return fmt::format("[{} {} {}]", v.x, v.y, v.z); }
float degrees_of(float versine) { return glm::degrees(shared::versine_angle(versine)); }

// pbrt's camera space is left-handed: without the mirroring, right would be left. Its angle is that of the
// shorter side.
void add_view(ExportOutput& out, const ExportedView& view) {
    const Camera& c = view.camera;
    const glm::vec3 target = c.position + c.forward;
    out.add("# {}\nScale -1 1 1\nLookAt {} {} {}  {} {} {}  {} {} {}\n", ascii(c.name), c.position.x,
            c.position.y, c.position.z, target.x, target.y, target.z, c.up.x, c.up.y, c.up.z);
    const float aspect = float(view.width) / float(view.height);
    if (c.half_height > 0.0f) {
        const float half_width = c.half_height * aspect;
        out.add("Camera \"orthographic\" \"float screenwindow\" [{} {} {} {}]\n", -half_width, half_width,
                -c.half_height, c.half_height);
    } else {
        const float half = std::tan(0.5f * c.yfov) * std::min(aspect, 1.0f);
        out.add("Camera \"perspective\" \"float fov\" [{}]\n", glm::degrees(2.0f * std::atan(half)));
    }
    out.add("Film \"rgb\" \"integer xresolution\" [{}] \"integer yresolution\" [{}] \"string filename\" "
            "\"{}.exr\"\nPixelFilter \"box\" \"float xradius\" [0.5] \"float yradius\" [0.5]\nSampler "
            "\"zsobol\" \"integer pixelsamples\" [256]\nIntegrator \"volpath\" \"integer maxdepth\" "
            "[32]\n\nWorldBegin\n",
            view.width, view.height, out.stem);
}

void add_light(ExportOutput& out, const shared::Light& light) {
    const glm::vec3 to = light.position + light.direction;
    if (light.range > 0.0f) out.note("the range of point and spot lights: their light goes on");
    switch (light.type) {
    case shared::LIGHT_POINT:
        return out.add("LightSource \"point\" \"rgb I\" {} \"point3 from\" {}\n", numbers(light.intensity),
                       numbers(light.position));
    case shared::LIGHT_SPOT:
        out.note("the soft rim of spot lights: a cubic of the cosine instead of a square");
        return out.add("LightSource \"spot\" \"rgb I\" {} \"point3 from\" {} \"point3 to\" {} \"float "
                       "coneangle\" [{}] \"float conedeltaangle\" [{}]\n",
                       numbers(light.intensity), numbers(light.position), numbers(to),
                       degrees_of(light.outer), degrees_of(light.outer) - degrees_of(light.inner));
    case shared::LIGHT_DIRECTIONAL:
        return out.add("LightSource \"distant\" \"rgb L\" {} \"point3 from\" {} \"point3 to\" [0 0 0]\n",
                       numbers(light.intensity), numbers(-light.direction));
    default:
        return out.note("lights of a kind of their own: left out");
    }
}

void add_lights(ExportOutput& out) {
    for (const shared::Light& light : out.scene.lights) add_light(out, light);
    if (out.scene.environment.empty()) return;
    const std::string name = out.stem + "-sky.exr";
    write_exr(out.folder / name, {{"", equal_area_sky(out.scene.environment)}});
    out.add("LightSource \"infinite\" \"string filename\" \"{}\"\n", name);
}

// Declares a texture for a picture; returns the parameter, "rgb NAME [...]" or "texture NAME" "...".
std::string parameter(ExportOutput& out, const char* name, const Channel& channel, bool color,
                      const std::string& prefix) {
    if (channel.file.empty())
        return color ? fmt::format("\"rgb {}\" {}", name,
                                   numbers(glm::clamp(channel.value, glm::vec3(0.0f), glm::vec3(1.0f))))
                     : fmt::format("\"float {}\" [{}]", name, channel.number());
    if (channel.wrap_u != channel.wrap_v || channel.wrap_u == Wrap::mirror)
        out.note("textures that are mirrored, or clamped in one direction: as in the first, or repeated");
    out.add(
        "Texture \"{}-{}\" \"{}\" \"imagemap\" \"string filename\" \"{}\" \"string wrap\" \"{}\" \"string "
        "filter\" \"{}\" \"string encoding\" \"{}\"\n",
        prefix, name, color ? "spectrum" : "float", channel.file,
        channel.wrap_u == Wrap::clamp ? "clamp" : "repeat", channel.nearest ? "point" : "bilinear",
        color ? "sRGB" : "linear");
    return fmt::format("\"texture {}\" \"{}-{}\"", name, prefix, name);
}

void declare_glass(ExportOutput& out, const Material& m, const Look& look, const std::string& name) {
    if (m.thin) {
        if (!look.color.file.empty() || look.color.value != glm::vec3(1.0f))
            out.note("colors of thin glass: clear");
        if (m.roughness > 0.0f) out.note("rough thin glass: smooth");
        return out.add("MakeNamedMaterial \"{}\" \"string type\" \"thindielectric\" \"float eta\" [{}]\n",
                       name, look.ior);
    }
    if (look.absorption != glm::vec3(0.0f))
        out.add("MakeNamedMedium \"{}-inside\" \"string type\" \"homogeneous\" \"rgb sigma_a\" {} \"rgb "
                "sigma_s\" [0 0 0]\n",
                name, numbers(look.absorption));
    if (!look.color.file.empty() || look.color.value != glm::vec3(1.0f))
        out.note("colors of solid glass at its surface: clear");
    const std::string rough = parameter(out, "roughness", look.alpha, false, name);
    out.add("MakeNamedMaterial \"{}\" \"string type\" \"dielectric\" \"float eta\" [{}] {} \"bool "
            "remaproughness\" false\n",
            name, look.ior, rough);
}

void declare_material(ExportOutput& out, const Material& m, const Look& look, const std::string& name) {
    out.add("\n# {}\n", ascii(m.name));
    if (look.glass) return declare_glass(out, m, look, name);
    const std::string normal =
        look.normal_map.file.empty() ? "" : fmt::format(" \"string normalmap\" \"{}\"", look.normal_map.file);
    const std::string color = parameter(out, "reflectance", look.color, true, name);
    const std::string rough =
        parameter(out, "roughness", look.alpha, false, name) + " \"bool remaproughness\" false";
    const auto dielectric = [&](const std::string& own) {
        if (!look.reflects)
            return out.add("MakeNamedMaterial \"{}\" \"string type\" \"diffuse\" {}{}\n", own, color, normal);
        out.note("the diffuse lobe under a dielectric one: with the light that goes between them");
        out.add("MakeNamedMaterial \"{}\" \"string type\" \"coateddiffuse\" {} {} \"float eta\" [{}]{}\n",
                own, color, rough, look.ior, normal);
    };
    const auto metal = [&](const std::string& own) {
        out.add("MakeNamedMaterial \"{}\" \"string type\" \"conductor\" {} {}{}\n", own, color, rough,
                normal);
    };
    if (look.metallic.file.empty() && look.metallic.number() <= 0.0f) return dielectric(name);
    if (look.metallic.file.empty() && look.metallic.number() >= 1.0f) return metal(name);
    dielectric(name + "-dielectric");
    metal(name + "-metal");
    const std::string amount = parameter(out, "amount", look.metallic, false, name);
    out.add("MakeNamedMaterial \"{}\" \"string type\" \"mix\" \"string materials\" [\"{}-dielectric\" "
            "\"{}-metal\"] {}\n",
            name, name, name, amount);
}

void add_shape(ExportOutput& out, const ExportedShape& shape, const Look& look, const std::string& material) {
    const glm::mat4& m = shape.transform;
    out.add("\n# {}\nAttributeBegin\n  Transform [", ascii(shape.instance->name));
    for (int column = 0; column < 4; ++column)
        out.add("{}{} {} {} {}", column ? " " : "", m[column].x, m[column].y, m[column].z, m[column].w);
    out.add("]\n  NamedMaterial \"{}\"\n", material);
    if (emits(*shape.material))
        out.add("  AreaLightSource \"diffuse\" {}{}\n",
                look.emission.file.empty() ? "\"rgb L\" " + numbers(look.emission.value)
                                           : fmt::format("\"string filename\" \"{}\"", look.emission.file),
                shape.material->double_sided ? " \"bool twosided\" true" : "");
    if (look.absorption != glm::vec3(0.0f)) out.add("  MediumInterface \"{}-inside\" \"\"\n", material);
    std::string alpha;
    if (!look.coverage.file.empty())
        alpha = fmt::format(" \"texture alpha\" \"{}-coverage\"", material);
    else if (look.coverage.number() < 1.0f)
        alpha = fmt::format(" \"float alpha\" [{}]", look.coverage.number());
    out.add("  Shape \"plymesh\" \"string filename\" \"{}\"{}\nAttributeEnd\n", shape.file, alpha);
}

} // namespace

std::vector<std::string> write_pbrt(const std::filesystem::path& file, const Scene& scene,
                                    const ExportedView& view) {
    ExportOutput out(scene, file);
    out.note_origin();
    add_view(out, view);
    add_lights(out);
    const UsedParts used = used_parts(scene);
    std::vector<Look> looks(scene.materials.size());
    const auto name_of = [](std::size_t index) { return fmt::format("M{}", index); };
    for (std::size_t i = 0; i < looks.size(); ++i) {
        if (!used.materials[i]) continue;
        looks[i] = make_look(out, i, false);
        declare_material(out, scene.materials[i], looks[i], name_of(i));
        if (!looks[i].coverage.file.empty()) parameter(out, "coverage", looks[i].coverage, false, name_of(i));
    }
    for (const ExportedShape& shape : write_shapes(out, true))
        add_shape(out, shape, looks[shape.material_index], name_of(shape.material_index));

    std::string head = "# " + ascii(scene.name) + ", exported by luxel for pbrt-v4; render with: pbrt " +
                       out.stem + ".pbrt\n";
    std::vector<std::string> approximated = out.approximated();
    for (const std::string& sentence : approximated) head += "# approximated: " + sentence + "\n";
    write_file(file, std::string_view(head + out.text));
    return approximated;
}

} // namespace luxel
