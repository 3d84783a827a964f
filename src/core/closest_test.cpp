// SPDX-License-Identifier: MIT
#include "core/closest.h"

#include <gtest/gtest.h>

namespace luxel {
namespace {

TEST(Closest, CountsEdits) {
    EXPECT_EQ(edit_distance("", "isr"), 3u);
    EXPECT_EQ(edit_distance("isr", "isr"), 0u);
    EXPECT_EQ(edit_distance("ISR", "isr"), 0u);
    EXPECT_EQ(edit_distance("irs", "isr"), 1u); // neighbors swapped
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
    EXPECT_EQ(edit_distance("sitting", "kitten"), 3u);
    EXPECT_EQ(edit_distance("ca", "abc"), 3u); // a swapped pair is not edited again
}

TEST(Closest, FindsWhatIsMeant) {
    const std::vector<std::string> known = {"evaluate", "experiment", "export", "render", "reference", "isr"};
    EXPECT_EQ(closest("evalaute", known), "evaluate");
    EXPECT_EQ(closest("expotr", known), "export");
    EXPECT_EQ(closest("Render", known), "render");
    EXPECT_EQ(closest("irs", known), "isr");
    EXPECT_EQ(closest("ref", known), "reference"); // begins only one
    EXPECT_EQ(closest("ex", known), "");           // begins two
    EXPECT_EQ(closest("xyz", known), "");
    EXPECT_EQ(closest("q", {"a"}), "");
    EXPECT_EQ(closest("", known), "");
}

TEST(Closest, EndsASentence) {
    EXPECT_EQ(known_are("samlpes", {"radius", "samples"}),
              "known are radius, samples; did you mean samples?");
    EXPECT_EQ(known_are("zzz", {"radius", "samples"}), "known are radius, samples");
    EXPECT_EQ(known_are("zzz", {}), "there is none");
}

} // namespace
} // namespace luxel
