// SPDX-License-Identifier: MIT
// A scene on the GPU: vertex and index buffers, instances, materials, textures; and what of it to draw.
#pragma once
#include <vector>

#include "gpu/recorder.h"
#include "scene/scene.h"
#include "techniques/frame/frustum.h"

namespace luxel {

// Opaque or masked; or by what their materials need of a shader: no textures, those of core glTF filtered by
// the sampler, or all that there may be. Displaced: with a height map, whatever else they are.
enum class Surfaces { opaque, masked, plain, textured, full, displaced };
// What a batch binds in descriptor set 1: nothing, what the alpha test reads, or the whole material (for one
// of plain, textured, full, displaced); of displaced surfaces the height map, too.
enum class MaterialUse { none, alpha, all };
// By what a camera sees of an instance: whatever it is; with both sides; with its front alone, the transform
// mirroring or not. See Material::looks_through_back.
enum class Facing { any, both, front, mirrored_front };

class GpuScene {
public:
    // mipmaps = false: textures have one level. Error Fault::resource: more vertices than one buffer can
    // hold.
    GpuScene(gpu::Gpu& gpu, const Scene& scene, bool mipmaps);

    const Scene& scene() const { return *scene_; }
    const Bounds& bounds() const { return bounds_; } // world

    // Of the scene's instances, as they stand now.
    Bounds bounds_of(const std::vector<int>& instances) const;

    // Takes over the transforms that the scene's instances have now; all else must be as it was.
    void move_instances(gpu::Gpu& gpu);
    std::uint64_t version() const { return version_; } // changes with the transforms

    // Instances whose bounds touch the clip volume, one batch for each material (a single one for
    // MaterialUse::none). drawn: one entry for each of the scene's instances; empty = all. apart: those with
    // a height map are Surfaces::displaced and nothing else.
    std::vector<gpu::Batch> batches(const Frustum& frustum, Surfaces surfaces, MaterialUse use,
                                    const std::vector<bool>& drawn = {}, bool apart = false,
                                    Facing facing = Facing::any) const;

    // By instance, for batches(): thin sheets that light passes straight through, and all others. Both empty
    // where the scene has no sheets.
    const std::vector<bool>& sheets() const { return sheets_; }
    const std::vector<bool>& solids() const { return solids_; }

    // Set 0 of the vertex shaders: "positions" and "instances" alone; with what the alpha test needs; all
    // attributes.
    gpu::Bindings vertex_bindings(MaterialUse use) const;
    const gpu::Buffer& indices() const { return indices_; }

private:
    struct MaterialOnGpu {
        gpu::Bindings alpha, all, displaced_alpha, displaced_all; // the latter two empty without a height map
        bool masked;
        Surfaces kind; // plain, textured or full
        bool is(Surfaces s, bool apart) const {
            if (s == Surfaces::displaced) return !displaced_all.empty();
            if (apart && !displaced_all.empty()) return false;
            return s == kind || s == (masked ? Surfaces::masked : Surfaces::opaque);
        }
        const gpu::Bindings& bindings(Surfaces s, MaterialUse use) const {
            if (s == Surfaces::displaced) return use == MaterialUse::all ? displaced_all : displaced_alpha;
            return use == MaterialUse::all ? all : alpha;
        }
    };
    struct Object { // an instance as it is drawn
        Bounds bounds;
        gpu::Draw draw;
        int material;
        Facing facing; // not any
    };
    struct Place { // where a mesh's elements begin in the arrays of all meshes
        std::uint32_t first_index;
        int base_vertex;
        int uv0, uv1, tangent, color; // relative to the base vertex, or ABSENT
        Bounds bounds;                // object space
    };
    void upload_geometry(gpu::Gpu& gpu);
    void upload_materials(gpu::Gpu& gpu, bool mipmaps);

    const Scene* scene_;
    Bounds bounds_;
    gpu::Buffer indices_, positions_, normals_, tangents_, texcoords_, colors_, instances_;
    std::vector<Place> places_; // of the scene's meshes
    std::vector<MaterialOnGpu> materials_;
    std::vector<Object> objects_;       // sorted by material
    std::vector<glm::mat4> transforms_; // of the scene's instances
    std::vector<bool> sheets_, solids_;
    std::uint64_t version_ = 0;
};

} // namespace luxel
