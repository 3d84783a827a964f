// SPDX-License-Identifier: MIT
// Silence proves nothing unless faults are heard. Here the recorder is told to leave its barriers out, and
// each fault has to be reported: by the Khronos layer what it can see, by the verifier everything.
#include <algorithm>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

#include "gpu/check.h"
#include "gpu/program.h"
#include "gpu/recorder.h"
#include "support/gpu.h"

namespace luxel::gpu {
namespace {

// A Gpu of its own for each test, since its log is meant to fill up. SetUp skips as in every validated test.
class Canary : public testing::GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        faulty_ = std::make_unique<Gpu>(GpuOptions{.validation = true});
        faulty_->data().faults.skip_barriers = true;
        faulty_->data().faults.keep_hazards = true;
    }
    Gpu& faulty() { return *faulty_; }

    bool layer_says(const std::string& text) { return contains(faulty().validation_messages(), text); }
    bool verifier_says(const std::string& text) { return contains(faulty().data().hazards, text); }
    static bool contains(const std::vector<std::string>& messages, const std::string& text) {
        return std::any_of(messages.begin(), messages.end(),
                           [&](const std::string& m) { return m.find(text) != std::string::npos; });
    }

    void fill(Recorder& r, const Buffer& b) {
        r.dispatch("gpu/test/overrun.comp", {1}, place_, {{"Values", b}});
    }
    void add(Recorder& r, const Buffer& from, const Buffer& to) {
        r.dispatch("gpu/test/add.comp", {64}, Recorder::NoParams{}, {{"Term", from}, {"Sum", to}});
    }
    Buffer filled(const char* name) { return faulty().upload<float>(std::vector<float>(64, 1.0f), name); }

    struct {
        std::uint32_t place = 0;
    } place_;
    std::unique_ptr<Gpu> faulty_;
};

TEST_F(Canary, ReadAfterWriteIsReportedByBoth) {
    const Buffer a = filled("a"), b = filled("b");
    Recorder recorder(faulty());
    fill(recorder, a);
    add(recorder, a, b);
    recorder.submit();
    EXPECT_TRUE(layer_says("SYNC-HAZARD-READ-AFTER-WRITE"));
    EXPECT_TRUE(verifier_says("gpu/test/add.comp: a (part 0): read after write"));
}

TEST_F(Canary, WriteAfterReadIsReportedByBoth) {
    const Buffer a = filled("a"), b = filled("b");
    Recorder recorder(faulty());
    add(recorder, a, b);
    fill(recorder, a);
    recorder.submit();
    EXPECT_TRUE(layer_says("SYNC-HAZARD-WRITE-AFTER-READ"));
    EXPECT_TRUE(verifier_says("write after read: does not wait for the read of gpu/test/add.comp"));
}

TEST_F(Canary, HazardsAcrossSubmitsAreReportedByBoth) {
    const Buffer a = filled("a"), b = filled("b");
    faulty().data().faults.skip_entry = faulty().data().faults.skip_wait = true;
    Recorder first(faulty()), second(faulty());
    fill(first, a);
    add(second, a, b);
    first.submit();
    EXPECT_FALSE(layer_says("SYNC-HAZARD-READ-AFTER-WRITE"));
    second.submit();
    EXPECT_TRUE(layer_says("SYNC-HAZARD-READ-AFTER-WRITE"));
    EXPECT_TRUE(verifier_says("gpu/test/add.comp: a (part 0): read after write"));
}

TEST_F(Canary, IndirectArgumentsAreReportedByBoth) {
    const Buffer arguments = filled("arguments"), count = filled("count");
    Recorder recorder(faulty());
    recorder.dispatch("gpu/test/arguments.comp", {1}, place_, {{"Arguments", arguments}});
    recorder.dispatch_indirect("gpu/test/count.comp", arguments, 4, Recorder::NoParams{}, {{"Count", count}});
    recorder.submit();
    EXPECT_TRUE(layer_says("SYNC-HAZARD-READ-AFTER-WRITE"));
    EXPECT_TRUE(verifier_says("gpu/test/count.comp: arguments (part 0): read after write"));
}

// From here on the layer is silent, which the tests state so that a layer that learns to see them is noticed.
TEST_F(Canary, WriteAfterWriteOfTheSameKindIsReportedByTheVerifier) {
    const Buffer count = filled("count");
    const Image image = faulty().image({.width = 8, .height = 8}, "image");
    Recorder recorder(faulty());
    for (int i = 0; i < 2; ++i) {
        recorder.dispatch("gpu/test/count.comp", {64}, Recorder::NoParams{}, {{"Count", count}});
        recorder.dispatch("gpu/test/double.comp", {8, 8}, Recorder::NoParams{}, {{"picture", image}});
    }
    recorder.submit();
    EXPECT_TRUE(verifier_says("gpu/test/count.comp: count (part 0): read after write"));
    EXPECT_TRUE(verifier_says("gpu/test/double.comp: image (part 0): read after write"));
    EXPECT_TRUE(faulty().validation_messages().empty()) << faulty().validation_messages()[0];
}

TEST_F(Canary, TwoRenderingsToOneTargetAreReportedByTheVerifier) {
    const Image color = faulty().image({.width = 8, .height = 8}, "color");
    const Image depth = faulty().image({.width = 8, .height = 8, .format = VK_FORMAT_D32_SFLOAT}, "depth");
    const std::vector<Batch> triangle{{{}, {{.count = 3}}}};
    const std::array<float, 4> black{0, 0, 0, 0};
    RasterPass pass{.color = {{.image = color, .clear = black}},
                    .depth = DepthTarget{.image = depth, .clear = 1.0f}};
    Recorder recorder(faulty());
    for (int i = 0; i < 2; ++i)
        recorder.draw("gpu/test/layers", pass, Recorder::NoParams{}, {}, {}, triangle);
    recorder.submit();
    EXPECT_TRUE(verifier_says("gpu/test/layers: color (part 0): write after write"));
    EXPECT_TRUE(verifier_says("gpu/test/layers: depth (part 0): write after write"));
    EXPECT_TRUE(faulty().validation_messages().empty()) << faulty().validation_messages()[0];
}

TEST_F(Canary, AccessOutOfBoundsIsReportedByTheLayer) {
    Gpu checked({.validation = true, .check_shaders = true});
    const Buffer buffer = checked.buffer(256, "buffer");
    Recorder recorder(checked);
    fill(recorder, buffer);
    recorder.submit();
    EXPECT_TRUE(checked.validation_messages().empty());
    place_.place = 1000;
    fill(recorder, buffer);
    recorder.submit();
    EXPECT_TRUE(contains(checked.validation_messages(), "out of bounds"));
}

TEST_F(Canary, LeaksAreReportedByTheLayer) {
    const std::shared_ptr<MessageLog> log = faulty().data().context->log;
    const VkBufferCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = 16, .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    VkBuffer forgotten = VK_NULL_HANDLE;
#ifdef __SANITIZE_ADDRESS__
    const __lsan::ScopedDisabler meant; // the driver's side of it
#endif
    LUXEL_VK(vkCreateBuffer(faulty().data().context->device, &create, nullptr, &forgotten), "leak");
    faulty_.reset();
    EXPECT_TRUE(contains(log->messages, "has not been destroyed"));
}

using CanaryDeathTest = Canary;
TEST_F(CanaryDeathTest, OutsideOfTestsAHazardIsABug) {
    ::testing::FLAGS_gtest_death_test_style = "threadsafe";
    faulty().data().faults.keep_hazards = false;
    const Buffer a = filled("a"), b = filled("b");
    Recorder recorder(faulty());
    fill(recorder, a);
    add(recorder, a, b);
    EXPECT_DEATH(recorder.submit(),
                 "bug: .*gpu/test/add.comp: a .*read after write: the write of gpu/test/overrun.comp");
}

} // namespace
} // namespace luxel::gpu
