// SPDX-License-Identifier: MIT
// One frame end to end: G-buffer, shadows, direct light, techniques by slot, composition.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/image.h"
#include "gpu/recorder.h"
#include "techniques/frame/frame.h"
#include "techniques/technique.h"

namespace luxel {

struct RenderRequest {
    Camera camera;
    int width = 0, height = 0;
    // Prepared by the renderer; sorted by slot; Error Fault::usage on two in one slot with the same
    // receivers.
    std::vector<Technique*> techniques;
    std::vector<std::string> images; // names of intermediate images to read back ("depth", "isr irradiance",
                                     // ...), as large as they are, supersampled ones with all their samples
    bool accessibility = false;      // read back what composition multiplies the ambient term by
};

struct RenderResult {
    Image radiance;      // 3 channels, linear, before tone mapping; background = environment radiance
    Image mask;          // 1 where a surface is seen
    Image accessibility; // 1 channel; empty unless asked for and delivered by a technique
    Layers images;       // the intermediate images asked for
    std::vector<gpu::PassTime> passes;
    std::vector<std::string> warnings; // of the techniques
    std::uint64_t memory_bytes = 0;    // peak of the frame's images and buffers, scene included
};

class Renderer {
public:
    // Uploads the scene. Keeps references to both.
    Renderer(gpu::Gpu& gpu, const Scene& scene, const FrameOptions& options);
    ~Renderer();
    RenderResult render(const RenderRequest& request);
    // To be called when instances' transforms or lights of the scene have changed. Techniques are not
    // prepared again.
    void update_motion();

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace luxel
