// SPDX-License-Identifier: MIT
// Shadow maps that have been drawn, kept for the next capture that needs the same ones.
#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "gpu/recorder.h"
#include "techniques/frame/frame.h"
#include "techniques/frame/shadow_maps.h"

namespace luxel {

// A map depends on its view, on where the instances stand and on how height maps are searched. The camera
// only decides the box of a directional light, so everything else stays valid while the camera moves, and all
// of it while nothing moves. Cost: budget bytes of memory, and for each batch of lights one comparison of its
// views with those of the entries.
class ShadowCache {
public:
    // budget: bytes of maps to keep. Beyond it a batch overwrites maps of its own size, so that memory does
    // not grow with the number of lights.
    ShadowCache(gpu::Gpu& gpu, ShadowMode mode, float esm_exponent, std::uint64_t budget);

    // Around the recording and submission of a frame. Entries that neither this frame nor the one before has
    // used make room first; what a frame drew that was begun and never ended (an error came between) is
    // forgotten.
    void begin_frame();
    void end_frame() { frame_is_open_ = false; }

    // The maps of these views, `size` texels a side, one layer each, as frame/direct.glsl reads them. Passes
    // that read them are to be recorded before the next call.
    ShadowImages maps(gpu::Recorder& recorder, const GpuScene& scene, int size,
                      const std::vector<shared::ShadowView>& views,
                      const std::optional<shared::HeightSearch>& search);

private:
    struct Entry {
        ShadowMaps maps;
        const GpuScene* scene = nullptr;
        std::uint64_t scene_version = 0;
        std::vector<shared::ShadowView> views;
        std::optional<shared::HeightSearch> search;
        std::uint64_t last_frame = 0, last_use = 0;
        ShadowImages images; // what draw() returned
    };
    Entry& entry_for(int size, int layers, bool with_sheets);
    std::uint64_t bytes() const; // of all maps kept

    gpu::Gpu& gpu_;
    ShadowMode mode_;
    float esm_exponent_;
    std::uint64_t budget_, frame_ = 0, uses_ = 0;
    bool frame_is_open_ = false;
    std::deque<Entry> entries_;
};

} // namespace luxel
