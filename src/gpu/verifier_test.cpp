// SPDX-License-Identifier: MIT
// The verifier against sequences whose verdict is known from the Vulkan memory model, and the tracker against
// the verifier over all pairs and triples of uses.
#include "gpu/verifier.h"

#include <gtest/gtest.h>

#include "gpu/access.h"

namespace luxel::gpu {
namespace {

constexpr VkImageLayout none = VK_IMAGE_LAYOUT_UNDEFINED, general = VK_IMAGE_LAYOUT_GENERAL,
                        read_only = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;

VerifierAccess access_of(Uses uses, VkImageLayout layout) {
    VerifierAccess access{.layout = layout, .reads_contents = (uses & use::writing) == 0};
    for (int i = 0; i < use::count; ++i) {
        if ((uses >> i & 1u) == 0) continue;
        const StageAccess s = stage_access(Uses(1) << i);
        access.scopes.push_back({s.stages, s.access});
    }
    return access;
}

VerifierBarrier barrier_of(Uses from, Uses to, VkImageLayout before, VkImageLayout after) {
    const StageAccess a = stage_access(from), b = stage_access(to);
    return {{a.stages, write_access(from)}, {b.stages, b.access}, before, after};
}

constexpr Uses compute_write = use::in(use::compute, use::storage_write),
               compute_read = use::in(use::compute, use::storage_read),
               fragment_sampled = use::in(use::fragment, use::sampled),
               compute_sampled = use::in(use::compute, use::sampled);

class Sequence {
public:
    std::string access(Uses uses, VkImageLayout layout = none) {
        return verify_access(state_, access_of(uses, layout), "command");
    }
    std::string barrier(Uses from, Uses to, VkImageLayout before = none, VkImageLayout after = none) {
        return verify_barrier(state_, barrier_of(from, to, before, after));
    }

private:
    VerifierState state_;
};

TEST(Verifier, KnowsReadAfterWrite) {
    Sequence s;
    EXPECT_EQ(s.access(compute_write), "");
    EXPECT_EQ(s.access(compute_read), "read after write: the write of command is not visible");
    EXPECT_EQ(s.barrier(compute_write, compute_read), "");
    EXPECT_EQ(s.access(compute_read), "");
    EXPECT_NE(s.access(fragment_sampled), "") << "visible to another stage only";
}

TEST(Verifier, KnowsThatExecutionAloneIsNotVisibility) {
    Sequence s;
    EXPECT_EQ(s.access(compute_write), "");
    // Source stages without source access: the data stays in the writer's cache.
    EXPECT_EQ(s.barrier(compute_read, compute_read), "");
    EXPECT_NE(s.access(compute_read), "");
}

TEST(Verifier, FollowsChains) {
    Sequence s;
    EXPECT_EQ(s.access(compute_write), "");
    EXPECT_EQ(s.barrier(compute_write, fragment_sampled), "");
    EXPECT_EQ(s.barrier(fragment_sampled, use::transfer_read), "");
    EXPECT_EQ(s.access(use::transfer_read), "");
    Sequence broken;
    EXPECT_EQ(broken.access(compute_write), "");
    EXPECT_EQ(broken.barrier(fragment_sampled, use::transfer_read), "");
    EXPECT_NE(broken.access(use::transfer_read), "");
}

TEST(Verifier, KnowsWriteAfterReadAndWriteAfterWrite) {
    Sequence s;
    EXPECT_EQ(s.access(use::transfer_write), "");
    EXPECT_EQ(s.barrier(use::transfer_write, compute_read | compute_write), "");
    EXPECT_EQ(s.access(compute_read), "");
    EXPECT_EQ(s.access(compute_write), "write after read: does not wait for the read of command");
    EXPECT_EQ(s.access(compute_write), "write after write: the write of command is not visible");
    EXPECT_EQ(s.barrier(compute_write, compute_write), "");
    EXPECT_EQ(s.access(compute_write), "");
}

TEST(Verifier, KnowsLayouts) {
    Sequence s;
    EXPECT_NE(s.access(compute_write, general), "") << "still undefined";
    Sequence t;
    EXPECT_EQ(t.barrier(0, compute_write, none, general), "");
    EXPECT_EQ(t.access(compute_write, general), "");
    EXPECT_EQ(t.barrier(compute_write, fragment_sampled, general, read_only), "");
    EXPECT_EQ(t.access(fragment_sampled, read_only), "");
    EXPECT_NE(t.access(fragment_sampled, general), "") << "no longer";
    EXPECT_NE(t.barrier(fragment_sampled, compute_write, general, read_only), "") << "it is not in GENERAL";
}

TEST(Verifier, KnowsTransitionsThatRace) {
    Sequence s;
    EXPECT_EQ(s.barrier(0, compute_write, none, general), "");
    EXPECT_EQ(s.access(compute_write, general), "");
    EXPECT_EQ(s.barrier(fragment_sampled, fragment_sampled, general, read_only),
              "layout transition races with the write of command");
    Sequence t;
    EXPECT_EQ(t.barrier(0, compute_sampled | fragment_sampled, none, read_only), "");
    EXPECT_NE(t.access(fragment_sampled, read_only), "") << "never written";
    EXPECT_EQ(t.barrier(compute_sampled, compute_write, read_only, general),
              "layout transition races with the read of command");
}

TEST(Verifier, KnowsWhatWasNeverWritten) {
    Sequence s;
    EXPECT_EQ(s.access(compute_read), "read before anything was written to it");
}

// Every triple of uses, with layouts as images have them and without: what the tracker emits satisfies the
// verifier, and is not more than needed: reads that follow reads need nothing the second time.
TEST(Tracker, SatisfiesTheVerifier) {
    std::vector<Uses> all;
    for (int i = 0; i < use::count; ++i) all.push_back(Uses(1) << i);
    all.push_back(compute_read | compute_write);
    all.push_back(compute_sampled | fragment_sampled);
    int barriers = 0;
    for (const bool image : {false, true}) {
        const auto layout_of = [&](Uses uses) {
            if (!image) return none;
            return (uses & use::writing) || (uses & compute_read) ? general : read_only;
        };
        for (const Uses a : all) {
            for (const Uses b : all) {
                for (const Uses c : all) {
                    TrackState track;
                    VerifierState state;
                    state.written = true;
                    for (const Uses uses : {a, b, c, c}) {
                        if (const auto t = advance(track, uses, layout_of(uses))) {
                            ++barriers;
                            ASSERT_EQ(verify_barrier(
                                          state, barrier_of(t->from, t->to, t->old_layout, t->new_layout)),
                                      "");
                        }
                        ASSERT_EQ(verify_access(state, access_of(uses, layout_of(uses)), "command"), "")
                            << a << " " << b << " " << c << " at " << uses << (image ? " of an image" : "");
                    }
                    if ((c & use::writing) == 0) {
                        ASSERT_FALSE(advance(track, c, layout_of(c)).has_value());
                    }
                }
            }
        }
    }
    EXPECT_GT(barriers, 0);
}

} // namespace
} // namespace luxel::gpu
