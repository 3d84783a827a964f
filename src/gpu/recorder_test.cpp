// SPDX-License-Identifier: MIT
// Compute: bindings, params, tracking within and across recorders, times.
#include "gpu/recorder.h"

#include "support/gpu.h"

namespace luxel::gpu {
namespace {

class RecorderTest : public testing::GpuTest {};

struct FillParams {
    std::uint32_t count;
    float unused[3];
    float a;
    float rotation[9];
    float b;
};
FillParams line(std::uint32_t count, float a, float b) {
    return {count, {}, a, {0, 0, 0, 0, 0, 0, 0, 0, 100}, b};
}

struct PaintParams {
    float scale;
};

TEST_F(RecorderTest, ParamsHaveScalarLayout) {
    const Buffer out = gpu().buffer(1000 * 4, "out");
    Recorder recorder(gpu());
    recorder.dispatch("gpu/test/fill.comp", {1000}, line(1000, 2, 1), {{"Values", out}});
    recorder.submit();
    const std::vector<float> values = gpu().read_all<float>(out);
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], 2.0f * float(i) + 101.0f);
}

// Thousands of parameter blocks: the ring and the descriptor pools have to go on.
TEST_F(RecorderTest, EveryDispatchHasItsOwnParams) {
    const Buffer term = gpu().buffer(64 * 4, "term"), sum = gpu().buffer(64 * 4, "sum");
    constexpr int rounds = 3000;
    Recorder recorder(gpu());
    recorder.fill(sum, 0);
    for (int i = 0; i < rounds; ++i) {
        recorder.dispatch("gpu/test/fill.comp", {64}, line(64, 0, float(i) - 100.0f), {{"Values", term}});
        recorder.dispatch("gpu/test/add.comp", {64}, Recorder::NoParams{}, {{"Term", term}, {"Sum", sum}});
    }
    EXPECT_EQ(recorder.submit().size(), 2u * rounds + 1u);
    for (const float s : gpu().read_all<float>(sum)) ASSERT_EQ(s, float(rounds) * (rounds - 1) / 2);
}

TEST_F(RecorderTest, TablesCanBeTexelBuffersAndBlocks) {
    const Buffer colors = gpu().upload<float>(std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}, "colors");
    const Buffer counts = gpu().upload<std::uint32_t>(std::vector<std::uint32_t>{100, 200}, "counts");
    const Buffer offsets = gpu().upload<std::int32_t>(std::vector<std::int32_t>{-1, -2}, "offsets");
    const Buffer weights = gpu().upload<float>(std::vector<float>{1, 10, 0, 0}, "weights");
    const Buffer found = gpu().buffer(32, "found");
    Recorder recorder(gpu());
    recorder.dispatch("gpu/test/tables.comp", {2}, Recorder::NoParams{},
                      {{"colors", colors},
                       {"counts", counts},
                       {"offsets", offsets},
                       {"Weights", weights},
                       {"Found", found}});
    recorder.submit();
    EXPECT_EQ(gpu().read_all<float>(found), (std::vector<float>{100, 101, 102, 103, 248, 258, 268, 278}));
}

TEST_F(RecorderTest, GroupCountsCanComeFromABuffer) {
    const Buffer arguments = gpu().buffer(16, "arguments"), count = gpu().buffer(4, "count");
    Recorder recorder(gpu());
    recorder.fill(count, 0);
    struct {
        std::uint32_t groups = 5;
    } params;
    recorder.dispatch("gpu/test/arguments.comp", {1}, params, {{"Arguments", arguments}});
    recorder.dispatch_indirect("gpu/test/count.comp", arguments, 4, Recorder::NoParams{}, {{"Count", count}});
    recorder.submit();
    EXPECT_EQ(gpu().read_all<std::uint32_t>(count), std::vector<std::uint32_t>{5 * 64});
}

TEST_F(RecorderTest, ImagesAreStoredAndSampled) {
    const Image picture = gpu().image({.width = 16, .height = 16}, "picture");
    const std::vector<float> places = {0.25f, 0.5f, 0.5f, 0.53125f};
    const Buffer where = gpu().upload<float>(places, "where"), found = gpu().buffer(32, "found");
    Recorder recorder(gpu());
    recorder.dispatch("gpu/test/paint.comp", extent_of(picture), PaintParams{1}, {{"picture", picture}});
    struct {
        float lod = 0;
    } params;
    recorder.dispatch("gpu/test/sample.comp", {2}, params,
                      {{"picture", picture, Sampler::linear_clamp}, {"Places", where}, {"Found", found}});
    recorder.submit();

    // Texel centers are at 0.5: u = 0.25 is pixel coordinate 4, between texels 3 and 4.
    EXPECT_EQ(gpu().read_all<float>(found), (std::vector<float>{3.5f, 7.5f, 1, 1, 7.5f, 8, 1, 1}));
    EXPECT_EQ(gpu().read(picture).at(3, 5)[1], 5.0f);
}

TEST_F(RecorderTest, MipsCanBeWrittenOneByOneAndSampledTogether) {
    const Image picture = gpu().image({.width = 16, .height = 16, .mips = 3}, "picture");
    const std::vector<float> places = {0.5f, 0.5f};
    const Buffer where = gpu().upload<float>(places, "where"), found = gpu().buffer(16, "found");
    Recorder recorder(gpu());
    for (std::uint32_t m = 0; m < 3; ++m)
        recorder.dispatch("gpu/test/paint.comp", extent_of(picture.mip(m)), PaintParams{float(m)},
                          {{"picture", picture.mip(m)}});
    struct {
        float lod = 1.5f;
    } params;
    recorder.dispatch("gpu/test/sample.comp", {1}, params,
                      {{"picture", picture, Sampler::linear_clamp}, {"Places", where}, {"Found", found}});
    recorder.submit();
    EXPECT_FLOAT_EQ(gpu().read_all<float>(found)[2], 1.5f);
}

// Write after write, read after write, in place: the result counts the steps.
TEST_F(RecorderTest, StepsOnOneImageHappenInOrder) {
    const Image picture = gpu().image({.width = 200, .height = 100}, "picture");
    Recorder recorder(gpu());
    recorder.dispatch("gpu/test/paint.comp", extent_of(picture), PaintParams{5}, {{"picture", picture}});
    recorder.clear(picture, {1, 1, 1, 1});
    for (int i = 0; i < 10; ++i)
        recorder.dispatch("gpu/test/double.comp", extent_of(picture), Recorder::NoParams{},
                          {{"picture", picture}});
    recorder.submit();
    for (const float v : gpu().read(picture).data) ASSERT_EQ(v, 2047.0f);
}

// What one recorder recorded first may be submitted last.
TEST_F(RecorderTest, RecordersDoNotDependOnEachOther) {
    const Image picture = gpu().image({.width = 8, .height = 8}, "picture");
    const Image copy = gpu().image({.width = 8, .height = 8}, "copy");
    Recorder second(gpu()), first(gpu());
    second.dispatch("gpu/test/double.comp", extent_of(picture), Recorder::NoParams{}, {{"picture", picture}});
    second.copy(picture, copy);
    first.clear(picture, {3, 3, 3, 3});
    first.submit();
    second.submit();
    EXPECT_EQ(gpu().read(copy).at(7, 7)[0], 7.0f);
    {
        Recorder dropped(gpu());
        dropped.clear(copy, {9, 9, 9, 9});
    }
    EXPECT_EQ(gpu().read(copy).at(7, 7)[0], 7.0f);
    EXPECT_TRUE(Recorder(gpu()).submit().empty());
}

TEST_F(RecorderTest, FormatsAreConvertedByCopies) {
    const Image a = gpu().image({.width = 4, .height = 4}, "a");
    const Image b = gpu().image({.width = 4, .height = 4, .format = VK_FORMAT_R16G16B16A16_SFLOAT}, "b");
    Recorder recorder(gpu());
    recorder.clear(a, {0.5f, 1, 2, 4});
    recorder.copy(a, b);
    recorder.submit();
    EXPECT_EQ(gpu().read(b).at(3, 3)[3], 4.0f);
}

TEST_F(RecorderTest, PassesAreTimedByName) {
    const Buffer out = gpu().buffer(1 << 20, "out");
    Recorder recorder(gpu());
    {
        auto outer = recorder.scope("outer");
        recorder.dispatch("gpu/test/fill.comp", {1 << 18}, line(1 << 18, 1, 0), {{"Values", out}});
        auto inner = recorder.scope("inner");
        recorder.dispatch("gpu/test/fill.comp", {1 << 18}, line(1 << 18, 2, 0), {{"Values", out}});
    }
    recorder.fill(out, 0);
    const std::vector<PassTime> times = recorder.submit();
    ASSERT_EQ(times.size(), 3u);
    EXPECT_EQ(times[0].name, "outer: gpu/test/fill.comp");
    EXPECT_EQ(times[1].name, "outer: inner: gpu/test/fill.comp");
    EXPECT_EQ(times[2].name, "fill out");
    for (const PassTime& t : times) EXPECT_TRUE(t.ms > 0 && t.ms < 10000) << t.name << " " << t.ms;
}

using RecorderDeathTest = RecorderTest;
TEST_F(RecorderDeathTest, WrongBindingsAreBugsThatNameProgramAndBinding) {
    ::testing::FLAGS_gtest_death_test_style = "threadsafe";
    const Buffer buffer = gpu().buffer(256, "buffer");
    const Image image = gpu().image({.width = 4, .height = 4}, "image");
    const Image half = gpu().image({.format = VK_FORMAT_R16_SFLOAT}, "half");
    Recorder r(gpu());
    const auto fill = [&](const Bindings& b) { r.dispatch("gpu/test/fill.comp", {1}, line(1, 1, 1), b); };
    EXPECT_DEATH(fill({{"Values", buffer}, {"Valeus", buffer}}), "fill.comp has no binding \"Valeus\"");
    EXPECT_DEATH(fill({}), "fill.comp: nothing is bound to \"Values\"");
    EXPECT_DEATH(fill({{"Values", image}}), "fill.comp: \"Values\" is a buffer, not an image");
    EXPECT_DEATH(fill({{"Values", Buffer()}}), "fill.comp: the buffer for \"Values\" is empty");
    EXPECT_DEATH(r.dispatch("gpu/test/fill.comp", {1}, PaintParams{1}, {{"Values", buffer}}),
                 "fill.comp: params has 60 bytes in the shader, 4 in C\\+\\+");
    EXPECT_DEATH(r.dispatch("gpu/test/fill.comp", {1}, Recorder::NoParams{}, {{"Values", buffer}}),
                 "60 bytes");
    EXPECT_DEATH(r.dispatch("gpu/test/paint.comp", {1}, PaintParams{1}, {{"picture", buffer}}),
                 "paint.comp: \"picture\" is an image, not a buffer");
    EXPECT_DEATH(r.dispatch("gpu/test/paint.comp", {1}, PaintParams{1}, {{"picture", half}}),
                 "paint.comp: picture has format RGBA32F but image half has R16F");
    EXPECT_DEATH(r.dispatch("gpu/test/nothing.comp", {1}, Recorder::NoParams{}, {}),
                 "there is no shader gpu/test/nothing.comp");
}

} // namespace
} // namespace luxel::gpu
