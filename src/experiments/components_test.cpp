// SPDX-License-Identifier: MIT
// Sums of components: what may be added, and what would count light twice.
#include "experiments/components.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace luxel {
namespace {

std::string refusal(const std::string& text) {
    try {
        parse_components(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::usage) << text;
        return error.what();
    }
    return {};
}

TEST(ComponentSums, AddDisjointPaths) {
    for (const char* text : {"direct+diffuse1", "direct+caustics", "direct+reflections+caustics+diffuse",
                             "direct+diffuse+specular", "full", "ao", "caustics_bias", "photon_bias"})
        EXPECT_EQ(refusal(text), "") << text;
    EXPECT_EQ(parse_components("direct+caustics"), (std::vector<std::string>{"direct", "caustics"}));
}

TEST(ComponentSums, CountNoLightTwice) {
    for (const char* text : {"specular+caustics", "reflections+specular", "full+caustics",
                             "caustics+caustics", "diffuse+diffuse1"})
        EXPECT_NE(refusal(text).find("twice"), std::string::npos) << text;
    for (const char* text : {"direct+ao", "caustics+caustics_bias"})
        EXPECT_NE(refusal(text).find("no radiance"), std::string::npos) << text;
}

} // namespace
} // namespace luxel
