// SPDX-License-Identifier: MIT
// Export, render, read back.
#include "experiments/povray_judge.h"

#include "core/error.h"
#include "core/image_io.h"
#include "core/process.h"
#include "core/temporary_folder.h"

namespace luxel {

bool povray_installed() { return is_installed("povray"); }

void require_povray() {
    if (!povray_installed())
        fail(Fault::unsupported, "povray: not installed; the judge needs POV-Ray 3.7 with OpenEXR");
}

Image povray_radiance(const Scene& scene, const Camera& camera, int width, int height,
                      const PovraySettings& settings, std::chrono::seconds limit) {
    require_povray();
    const TemporaryFolder folder;
    write_povray(folder.path() / "scene.pov", scene, camera, width, height, settings);

    // No anti-aliasing: a ray through each pixel's center, as the frame samples. FE: linear OpenEXR.
    run_process({"povray",
                 {"+Iscene.pov", "+Opicture.exr", "+FE", fmt::format("+W{}", width),
                  fmt::format("+H{}", height), "-A", "-D", "-P", "-V"},
                 folder.path(),
                 limit});
    Image picture = read_image(folder.path() / "picture.exr");
    if (picture.width != width || picture.height != height)
        fail(Fault::bad_input, "povray: {}x{} pixels instead of {}x{}", picture.width, picture.height, width,
             height);
    return picture;
}

} // namespace luxel
