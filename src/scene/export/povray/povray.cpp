// SPDX-License-Identifier: MIT
// The file as a whole: settings, camera, lights, sky, materials, meshes, objects.
#include "scene/export/povray/povray.h"

#include "core/file.h"
#include "scene/export/povray/text.h"
#include "scene/printable.h"

namespace luxel {
namespace povray {
namespace {

// The thesis's settings, but one bounce, which in 3.7 is recursion_limit 1, and brightness 1: its 2.4 made up
// for pictures that were not linear. gray_threshold 0 keeps the bounced color [Rohleder2010, ch. 5].
constexpr const char* radiosity = R"(  radiosity {
    pretrace_start 0.08
    pretrace_end 0.01
    count 250
    error_bound 0.25
    recursion_limit 1
    brightness 1
    gray_threshold 0
  }
)";

void add_settings(Export& out) {
    out.add("#version 3.7;\nglobal_settings {{\n  assumed_gamma 1.0\n  max_trace_level 20\n{}}}\n"
            "#default {{ finish {{ ambient 0 emission 0 diffuse 1 }} }}\n\n",
            out.settings.radiosity ? radiosity : "");
}

// Explicit vectors: POV-Ray's own up and right would mirror a right-handed scene.
void add_camera(Export& out, const Camera& camera, int width, int height) {
    const CameraBasis b = camera_basis(camera, width, height);
    out.add("// {}, {} x {} pixels\ncamera {{\n  {}\n  location {}\n  direction {}\n  right {}\n"
            "  up {}\n}}\n\n",
            ascii(camera.name), width, height, b.orthographic ? "orthographic" : "perspective",
            vector(b.position), vector(b.forward), vector(b.right * 2.0f), vector(b.up * 2.0f));
}

void add_objects(Export& out) {
    const Scene& scene = out.scene;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const Material& material = scene.materials[std::size_t(mesh.material)];
        const glm::mat4& m = instance.transform;
        out.add("// {}\nobject {{ M{}", ascii(instance.name), instance.mesh);
        if (mesh.colors.empty()) out.add(" texture {{ T{} }}", mesh.material);
        out.add("{} matrix <", interior_of(out, material));
        for (int column = 0; column < 4; ++column)
            out.add("{}{:.7g},{:.7g},{:.7g}", column ? "," : "", m[column].x, m[column].y, m[column].z);

        // The samples of an emitter light the scene already: bounce rays must not find it again.
        out.add(">{} }}\n", emits(material) ? " no_radiosity" : "");
    }
}

} // namespace

} // namespace povray

std::vector<std::string> write_povray(const std::filesystem::path& file, const Scene& scene,
                                      const Camera& camera, int width, int height,
                                      const PovraySettings& settings) {
    povray::Export out{{scene, file}, settings};
    povray::add_settings(out);
    povray::add_camera(out, camera, width, height);
    povray::add_lights(out);
    if (!scene.environment.empty()) povray::add_sky(out);

    const UsedParts used = used_parts(scene);
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (used.materials[i]) povray::declare_material(out, i);
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
        if (used.meshes[i]) povray::declare_mesh(out, i);
    povray::add_objects(out);

    std::string head = "// " + ascii(scene.name) + ", exported by luxel; render with: povray +I" + out.stem +
                       fmt::format(".pov +W{} +H{} -A +FE\n", width, height);
    const std::vector<std::string> approximated = out.approximated();
    for (const std::string& sentence : approximated) head += "// approximated: " + sentence + "\n";
    write_file(file, head + out.text);
    return approximated;
}

} // namespace luxel
