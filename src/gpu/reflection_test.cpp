// SPDX-License-Identifier: MIT
#include "gpu/reflection.h"

#include <gtest/gtest.h>

#include "gpu/shader_code.h"

namespace luxel::gpu {
namespace {

Reflection reflection_of(std::string_view name) {
    for (const EmbeddedShader& s : embedded_shaders()) {
        if (s.name == name) return reflect({s.words.begin, s.words.end}, std::string(name));
    }
    ADD_FAILURE() << "no shader " << name;
    return {};
}

TEST(Reflection, ReadsBlocks) {
    const Reflection r = reflection_of("gpu/test/fill.comp");
    EXPECT_EQ(r.stage, VK_SHADER_STAGE_COMPUTE_BIT);
    EXPECT_EQ(r.local_size, (std::array<std::uint32_t, 3>{64, 1, 1}));
    ASSERT_EQ(r.bindings.size(), 3u);

    // uint, a struct of vec3 and float, mat3, float: scalar layout has no holes.
    const ShaderBinding &params = r.bindings[0], &values = r.bindings[1], &unused = r.bindings[2];
    EXPECT_EQ(params.name, "params");
    EXPECT_EQ(params.type, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
    EXPECT_EQ(params.block_size, 4u + 16u + 36u + 4u);
    EXPECT_TRUE(params.used && params.reads && !params.writes);
    EXPECT_EQ(values.block, "Values");
    EXPECT_EQ(values.type, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    EXPECT_TRUE(values.used && !values.reads && values.writes);
    EXPECT_TRUE(!unused.used && unused.reads && !unused.writes);
}

TEST(Reflection, ReadsImages) {
    const Reflection paint = reflection_of("gpu/test/paint.comp");
    const ShaderBinding& target = paint.bindings.at(1);
    EXPECT_EQ(target.name, "picture");
    EXPECT_EQ(target.type, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    EXPECT_EQ(target.format, VK_FORMAT_R32G32B32A32_SFLOAT);
    EXPECT_EQ(target.view, VK_IMAGE_VIEW_TYPE_2D);
    EXPECT_TRUE(!target.reads && target.writes);
    EXPECT_EQ(paint.local_size, (std::array<std::uint32_t, 3>{8, 8, 1}));
    const ShaderBinding both = reflection_of("gpu/test/double.comp").bindings.at(0);
    EXPECT_TRUE(both.reads && both.writes);

    const ShaderBinding cube = reflection_of("gpu/test/cube.comp").bindings.at(0);
    EXPECT_EQ(cube.type, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    EXPECT_EQ(cube.view, VK_IMAGE_VIEW_TYPE_CUBE);
    EXPECT_TRUE(cube.reads && !cube.writes);
}

TEST(Reflection, ReadsTexelBuffersAndOutputs) {
    const Reflection tables = reflection_of("gpu/test/tables.comp");
    ASSERT_EQ(tables.bindings.size(), 5u);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(tables.bindings[i].type, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
    EXPECT_EQ(tables.bindings[0].numbers, Numbers::float_);
    EXPECT_EQ(tables.bindings[1].numbers, Numbers::uint_);
    EXPECT_EQ(tables.bindings[2].numbers, Numbers::int_);
    EXPECT_EQ(tables.bindings[3].block_size, 16u);

    const Reflection fragment = reflection_of("gpu/test/textured.frag");
    EXPECT_EQ(fragment.stage, VK_SHADER_STAGE_FRAGMENT_BIT);
    EXPECT_EQ(fragment.color_outputs, 1u);
    EXPECT_EQ(fragment.bindings.at(1).set, 1u);
}

TEST(ReflectionDeathTest, WhatIsNotSpirvIsABug) {
    const std::uint32_t words[] = {1, 2, 3, 4, 5, 6};
    EXPECT_DEATH(reflect(words, "noise"), "noise is not SPIR-V");
}

} // namespace
} // namespace luxel::gpu
