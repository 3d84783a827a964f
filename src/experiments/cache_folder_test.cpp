// SPDX-License-Identifier: MIT
// The cache of truths within its limit, unfinished truths that go on, and sizes as they are typed.
#include "experiments/cache_folder.h"

#include <chrono>

#include <gtest/gtest.h>

#include "core/error.h"
#include "experiments/reference_cache.h"
#include "scene/load.h"
#include "support/temporary_folder.h"

namespace luxel {
namespace {

ReferenceRequest small_request(const Scene& scene, int spp) {
    ReferenceRequest request{.components = {"direct", "diffuse1"}, .width = 24, .height = 18};
    request.camera = scene.cameras[0];
    request.settings.spp = spp, request.settings.pixel_center = true;
    return request;
}

TEST(CacheFolder, TheLeastRecentlyUsedGoFirst) {
    const testing::TemporaryFolder folder;
    const Scene scene = load_scene("builtin:cornell");
    const RayCaster rays(scene);
    std::vector<std::string> warnings;
    for (int spp : {4, 5, 6}) find_truth(rays, small_request(scene, spp), folder.path(), warnings);
    std::vector<CachedFile> files = cached_files(folder.path());
    ASSERT_EQ(files.size(), 3u);
    EXPECT_EQ(files[0].components, (std::vector<std::string>{"diffuse1", "direct"}));
    EXPECT_EQ(files[0].width, 24);

    // As if they had been used hours ago, the oldest first; then the oldest is used again.
    for (const CachedFile& file : files)
        std::filesystem::last_write_time(file.file, std::filesystem::file_time_type::clock::now() -
                                                        std::chrono::hours(10 - file.spp));
    EXPECT_TRUE(find_truth(rays, small_request(scene, 4), folder.path(), warnings).cached);
    const Pruned pruned = prune_cache(folder.path(), files[0].bytes + files[1].bytes);
    EXPECT_EQ(pruned.files, 1);
    files = cached_files(folder.path());
    ASSERT_EQ(files.size(), 2u);
    EXPECT_EQ(files[0].spp, 6);
    EXPECT_EQ(files[1].spp, 4);
    EXPECT_EQ(prune_cache(folder.path(), 0, files[0].file).files, 1);
    EXPECT_TRUE(warnings.empty());
}

TEST(CacheFolder, AStoppedTruthGoesOnAndEndsWithTheSameImage) {
    const testing::TemporaryFolder folder;
    const Scene scene = load_scene("builtin:cornell");
    const RayCaster rays(scene);
    std::vector<std::string> warnings;
    const ReferenceRequest request = small_request(scene, 40);
    const Truth whole = find_truth(rays, request, {}, warnings);

    const auto stop_at = [&](int samples) {
        return find_truth(rays, request, folder.path(), warnings, [=](int spp) { return spp < samples; });
    };
    const Truth first = stop_at(3);
    EXPECT_FALSE(first.complete);
    EXPECT_GE(first.spp, 3);
    EXPECT_LT(first.spp, 40);
    ASSERT_EQ(cached_files(folder.path()).size(), 1u);
    EXPECT_TRUE(cached_files(folder.path())[0].checkpoint);

    int least = 1000;
    const Truth rest = find_truth(rays, request, folder.path(), warnings, [&](int spp) {
        least = std::min(least, spp);
        return true;
    });
    EXPECT_GT(least, first.spp);
    EXPECT_TRUE(rest.complete);
    EXPECT_EQ(rest.mean.at("diffuse1").data, whole.mean.at("diffuse1").data);
    EXPECT_EQ(rest.group[1].at("direct").data, whole.group[1].at("direct").data);
    ASSERT_EQ(cached_files(folder.path()).size(), 1u);
    EXPECT_FALSE(cached_files(folder.path())[0].checkpoint);
    EXPECT_TRUE(warnings.empty());
}

TEST(CacheFolder, SizesAreTypedWithUnits) {
    EXPECT_EQ(parse_size_limit("--limit", "0"), 0u);
    EXPECT_EQ(parse_size_limit("--limit", "500M"), 500u << 20);
    EXPECT_EQ(parse_size_limit("--limit", "2.5GiB"), std::uint64_t(5) << 29);
    for (const char* wrong : {"", "M", "1X", "-1M", "1e30", "12 M", "nan"})
        EXPECT_THROW(parse_size_limit("--limit", wrong), Error) << wrong;
}

} // namespace
} // namespace luxel
