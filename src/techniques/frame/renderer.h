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

// What a camera sees before any technique: several renders of the same camera can share it.
struct BaseFrame {
    Frame frame;
    std::vector<Capture> layers; // what covers a part of its pixels
    std::vector<gpu::PassTime> passes;
    std::uint64_t memory_bytes = 0; // peak of its images and buffers, scene included
};

struct RenderRequest {
    Camera camera;
    int width = 0, height = 0;
    // Prepared by the renderer; sorted by slot; Error Fault::usage on two in one slot with the same
    // receivers.
    std::vector<Technique*> techniques;
    std::vector<std::string> images; // names of intermediate images to read back ("depth", "isr irradiance",
                                     // ...), as large as they are, supersampled ones with all their samples
    bool accessibility = false;      // read back what composition multiplies the ambient term by
    bool read = true;                // false: only times and memory are of interest, no image is read back
    const BaseFrame* base = nullptr; // of the same camera and size, instead of drawing it: then the passes
                                     // are the techniques' and composition's alone, and `images` is of those
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
    // The first part of it, for RenderRequest::base: how height maps are searched is the techniques' of this
    // request. It is of use while nothing moves and the renderer lives.
    BaseFrame base(const RenderRequest& request);
    // To be called when instances' transforms or lights of the scene have changed. Techniques are not
    // prepared again.
    void update_motion();

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace luxel
