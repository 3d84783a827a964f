// SPDX-License-Identifier: MIT
// Records a frame: one statement per pass. Bindings go by the shader's own names; layouts, barriers, debug
// labels and timestamps follow from SPIR-V reflection and the recorder's own tracker.
#pragma once
#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "gpu/gpu.h"

namespace luxel::gpu {

enum class Sampler {
    nearest_clamp,
    linear_clamp,
    nearest_repeat,
    linear_repeat,
    linear_mirror,
    shadow_compare
};

// name = the GLSL variable (images, samplers) or block/instance name (buffers). The shader says how it is
// used.
struct Binding {
    std::string_view name;
    std::variant<Image, Buffer> resource;
    Sampler sampler = Sampler::nearest_clamp; // for combined image samplers
};
using Bindings = std::vector<Binding>;

struct Extent {
    std::uint32_t x = 1, y = 1, z = 1; // in threads (invocations)
};
inline Extent extent_of(const Image& image) { return {image.width(), image.height(), 1}; }

enum class Blend { none, add, min, max };
enum class Cull { none, back, front };

struct ColorTarget {
    Image image;                               // one mip; one layer, or all layers with RasterPass::layers
    std::optional<std::array<float, 4>> clear; // nullopt = load
    Blend blend = Blend::none;
};
struct DepthTarget {
    Image image;
    std::optional<float> clear;
    bool write = true;
    VkCompareOp compare = VK_COMPARE_OP_LESS_OR_EQUAL;
};
struct RasterPass {
    std::vector<ColorTarget> color;
    std::optional<DepthTarget> depth;
    Cull cull = Cull::none; // front faces are counter-clockwise as seen on screen with +y up
    float depth_bias = 0.0f, depth_bias_slope = 0.0f;
    bool depth_clamp = false;
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    std::uint32_t layers = 1; // > 1: gl_Layer selects
    // Viewport is the whole target, y flipped so that clip-space +y is up.
};

struct Draw {
    std::uint32_t count = 0; // indices, or vertices without an index buffer
    std::uint32_t first = 0;
    std::int32_t vertex_offset = 0;
    std::uint32_t instance = 0; // gl_InstanceIndex of the only (or first) instance
    std::uint32_t instances = 1;
};
// Draws that share the bindings of descriptor set 1 (set 0 holds the pass's own).
struct Batch {
    Bindings bindings;
    std::vector<Draw> draws;
};

struct PassTime {
    std::string name; // "isr/gather.comp", or "scope: program" inside scopes
    double ms;
};

class Recorder {
public:
    explicit Recorder(Gpu& gpu);
    ~Recorder(); // submits nothing: work that was not submitted is dropped
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    // `params` is the content of the shader's uniform block named `params` (scalar layout, at most 64 KiB). A
    // program without such a block takes NoParams. Errors are bugs (assertions) that name the program and the
    // binding: unknown name, missing name, wrong kind of resource, wrong size of params.
    struct NoParams {};
    template <class P>
    void dispatch(std::string_view program, Extent threads, const P& params, const Bindings& bindings) {
        dispatch_bytes(program, threads, bytes_of(params), bindings);
    }
    // Group counts (3 x uint32) read from `arguments` at `offset`.
    template <class P> void dispatch_indirect(std::string_view program, const Buffer& arguments,
                                              std::uint64_t offset, const P& params,
                                              const Bindings& bindings) {
        dispatch_indirect_bytes(program, arguments, offset, bytes_of(params), bindings);
    }
    // program "frame/gbuffer" = frame/gbuffer.vert + frame/gbuffer.frag (no .frag file: depth only).
    // indices: uint32 index buffer, or none. Vertex data is pulled from buffers by gl_VertexIndex.
    template <class P> void draw(std::string_view program, const RasterPass& pass, const P& params,
                                 const Bindings& bindings, const Buffer& indices,
                                 std::span<const Batch> batches) {
        draw_bytes(program, pass, bytes_of(params), bindings, indices, batches);
    }

    void clear(const Image& image,
               std::array<float, 4> value); // color images; integer formats take the rounded value
    void fill(const Buffer& buffer, std::uint32_t word);
    void copy(const Image& from, const Image& to);
    void generate_mips(const Image& image); // linear blits from mip 0

    Image image(const ImageInfo& info, std::string name) {
        return images_.emplace_back(gpu_.image(info, std::move(name)));
    }
    const std::vector<Image>& images() const { return images_; } // all that image() made, in order
    Gpu& gpu() { return gpu_; }

    // Debug label and time group: { auto scope = recorder.scope("shadow"); ... }
    class [[nodiscard]] Scope {
    public:
        explicit Scope(Recorder& r) : recorder_(r) {}
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        Recorder& recorder_;
    };
    Scope scope(std::string name);

    // Runs everything recorded, waits, returns GPU times per pass in order. The recorder can then be used
    // again. Errors: Fault::device_lost.
    std::vector<PassTime> submit();
    // The same in the middle of a frame, for what the CPU has to see: the times come first in what the next
    // submit() returns.
    void flush();

private:
    template <class P> static std::span<const std::byte> bytes_of(const P& p) {
        if constexpr (std::is_same_v<P, NoParams>)
            return {};
        else
            return std::as_bytes(std::span<const P, 1>(&p, 1));
    }
    void dispatch_bytes(std::string_view, Extent, std::span<const std::byte>, const Bindings&);
    void dispatch_indirect_bytes(std::string_view, const Buffer&, std::uint64_t, std::span<const std::byte>,
                                 const Bindings&);
    void draw_bytes(std::string_view, const RasterPass&, std::span<const std::byte>, const Bindings&,
                    const Buffer&, std::span<const Batch>);
    Gpu& gpu_;
    std::vector<Image> images_;
    std::vector<PassTime> flushed_;
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace luxel::gpu
