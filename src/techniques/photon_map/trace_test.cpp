// SPDX-License-Identifier: MIT
// Rays through lists of fragments against rays through the scene itself.
#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "support/gpu.h"
#include "techniques/photon_map/test_rays.h"

namespace luxel {
namespace {

class PhotonTraceTest : public testing::GpuTest {
protected:
    TraceResult trace(const Scene& scene, const ListProjection& projection, const std::vector<TestRay>& rays,
                      PhotonOptions options = {}) {
        GpuScene on_gpu(gpu(), scene, false);
        FragmentLists lists(gpu(), scene);
        gpu::Recorder recorder(gpu());
        capture_lists(recorder, lists, on_gpu, projection, options);
        const PhotonBuffers photons = upload_rays(gpu(), rays, lists.view().center);
        trace_photons(recorder, lists, photons, options);
        recorder.submit();
        return compare_hits(gpu(), lists, photons, rays);
    }
    static ListProjection camera_lists(const Scene& scene, int side) {
        return list_view_of_camera(view_params(scene.cameras.front(), 256, 256), scene.bounds(), side, 0.25f);
    }
    // The tracers' bound: 98 % within two pixels.
    void expect_right(const Scene& scene, const ListProjection& projection, int rays,
                      const PhotonOptions& options = {}) {
        const TraceResult r = trace(scene, projection, specular_rays(scene, rays), options);
        RecordProperty("found", describe(r));
        EXPECT_GT(r.counted, rays / 4);
        EXPECT_GE(double(r.right), 0.98 * r.counted) << scene.name << ": " << describe(r);
    }
};

TEST_F(PhotonTraceTest, RaysFromTheRingEndWhereTheyDo) {
    const Scene scene = metal_ring();
    expect_right(scene, camera_lists(scene, 256), 20000);
    expect_right(scene, list_view_of_box(scene.bounds(), 256), 20000);
}

TEST_F(PhotonTraceTest, RaysThroughWaterEndWhereTheyDo) {
    const Scene scene = water(0.0f);
    expect_right(scene, camera_lists(scene, 256), 20000);
    expect_right(scene, list_view_of_box(scene.bounds(), 256), 20000);
}

// Lines miss some of the pixels that they pass, but not many that matter here; layers see what is in front.
TEST_F(PhotonTraceTest, TheOtherTracersFindMostEnds) {
    const Scene scene = metal_ring();
    const std::vector<TestRay> rays = specular_rays(scene, 5000);
    PhotonOptions options;
    options.tracer = PhotonTracer::lines;
    const TraceResult lines = trace(scene, camera_lists(scene, 256), rays, options);
    EXPECT_GE(double(lines.right), 0.95 * lines.counted) << describe(lines);
    options.tracer = PhotonTracer::layers;
    const TraceResult four = trace(scene, camera_lists(scene, 256), rays, options);
    options.layers = 16;
    const TraceResult all = trace(scene, camera_lists(scene, 256), rays, options);
    EXPECT_GE(double(all.right), 0.98 * all.counted) << describe(all);
    EXPECT_LE(four.right, all.right);
}

// Without the pyramid each pixel is looked at.
TEST_F(PhotonTraceTest, SkippingChangesNothing) {
    const Scene scene = water(0.0f);
    const std::vector<TestRay> rays = specular_rays(scene, 5000);
    PhotonOptions plain;
    plain.skip = false;
    const TraceResult skipping = trace(scene, camera_lists(scene, 128), rays),
                      all = trace(scene, camera_lists(scene, 128), rays, plain);
    EXPECT_EQ(skipping.t, all.t);
    EXPECT_LT(skipping.cells, all.cells);

    // A side that halves to an odd one has fewer levels.
    const TraceResult odd = trace(scene, camera_lists(scene, 200), rays);
    EXPECT_GE(double(odd.right), 0.98 * odd.counted) << describe(odd);
}

// A pool that is too small grows, and nothing is missing afterwards.
TEST_F(PhotonTraceTest, ThePoolGrowsInTheSameFrame) {
    const Scene scene = metal_ring();
    GpuScene on_gpu(gpu(), scene, false);
    FragmentLists small(gpu(), scene), large(gpu(), scene);
    small.capacity = 256;
    gpu::Recorder recorder(gpu());
    small.capture(recorder, on_gpu, camera_lists(scene, 128));
    large.capture(recorder, on_gpu, camera_lists(scene, 128));
    EXPECT_GT(recorder.submit().size(), 2u); // times of what has been run before stay
    EXPECT_EQ(small.node_count(), large.node_count());
    EXPECT_GE(small.capacity, small.node_count());
    EXPECT_GT(small.node_count(), 10000u);

    // Every node is in one list.
    const auto heads = gpu().read_all<std::uint32_t>(std::get<gpu::Buffer>(small.bindings()[0].resource));
    const auto nodes = gpu().read_all<glm::uvec4>(std::get<gpu::Buffer>(small.bindings()[1].resource));
    std::uint32_t linked = 0;
    for (std::uint32_t head : heads)
        for (std::uint32_t i = head; i != shared::LIST_END; i = nodes[i][shared::LIST_NEXT]) ++linked;
    EXPECT_EQ(linked, small.node_count());
}

} // namespace
} // namespace luxel
