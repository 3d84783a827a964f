// SPDX-License-Identifier: MIT
// Damaged and hostile glTF files: one sentence that names the place, the right fault, no memory taken on
// their word.
#include <fstream>
#include <limits>
#include <random>

#include "scene/gltf/json.h"
#include "scene/gltf/test_gltf.h"
#include "scene/gltf/uri.h"

namespace luxel {
namespace {

using testing::sentence;
using testing::TestGltf;

std::string error_of(TestGltf& file, Fault fault = Fault::bad_input) {
    return sentence(fault, [&] { file.load(); });
}

std::string error_of_bytes(std::string_view bytes, Fault fault = Fault::bad_input) {
    const testing::TemporaryFolder folder;
    const auto path = folder.add("scene.gltf", bytes);
    return sentence(fault, [&] { load_gltf(path); });
}

TEST(GltfMalformed, EmptyMissingOrNoJson) {
    EXPECT_CONTAINS(error_of_bytes(""), "scene.gltf: the file is empty");
    EXPECT_CONTAINS(error_of_bytes("v 0 0 0\n"), "JSON: not valid at byte 1");
    EXPECT_CONTAINS(error_of_bytes("[]"), "JSON: the root is not an object");
    EXPECT_CONTAINS(error_of_bytes("{\"asset\": {\"version\": \"2.0\"}} {}"), "JSON: not valid");
    const testing::TemporaryFolder folder;
    EXPECT_CONTAINS(sentence(Fault::io, [&] { load_gltf(folder.path() / "absent.gltf"); }), "absent.gltf");
    EXPECT_CONTAINS(sentence(Fault::bad_input, [&] { load_gltf(folder.path()); }), "not a regular file");
}

TEST(GltfMalformed, DeepNesting) {
    EXPECT_CONTAINS(error_of_bytes(std::string(1 << 20, '[')), "nested more than 64 levels deep");
    std::string objects;
    for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
    EXPECT_CONTAINS(error_of_bytes(objects), "nested more than 64 levels deep");
}

TEST(GltfMalformed, BinaryFileCutAnywhere) {
    TestGltf file;
    const auto whole = file.glb();
    const auto load = [&](std::vector<std::uint8_t> bytes) {
        const auto path = file.folder.add("scene.glb", std::span<const std::uint8_t>(bytes));
        return [path] { load_gltf(path); };
    };
    for (std::size_t length = 1; length < whole.size(); length += 7)
        sentence(Fault::bad_input, load({whole.begin(), whole.begin() + std::ptrdiff_t(length)}));

    // A chunk longer than the file, a whole longer than the file, version 1.
    auto changed = whole;
    changed[12 + 3] = 0x7f;
    EXPECT_CONTAINS(sentence(Fault::bad_input, load(changed)), "do not fit the file");
    changed = whole;
    changed[8 + 3] = 0x7f;
    EXPECT_CONTAINS(sentence(Fault::bad_input, load(changed)), "truncated");
    changed = whole;
    changed[4] = 1;
    EXPECT_CONTAINS(sentence(Fault::bad_input, load(changed)), "version 1 is not 2");
}

TEST(GltfMalformed, VersionAndRequiredExtensions) {
    TestGltf file;
    file.json["asset"]["version"] = "1.0";
    EXPECT_CONTAINS(error_of(file), "asset.version: glTF version 1.0 is not 2.0");
    file.json["asset"] = {{"version", "2.0"}, {"minVersion", "2.1"}};
    EXPECT_CONTAINS(error_of(file), "needs glTF version 2.1");
    file.json["asset"] = {{"version", "2.0"}};
    for (const char* name : {"KHR_draco_mesh_compression", "VENDOR_secret"}) {
        file.json["extensionsRequired"] = {name};
        EXPECT_CONTAINS(error_of(file, Fault::unsupported), std::string(name) + " is not supported");
    }
}

TEST(GltfMalformed, DracoWithoutFallback) {
    TestGltf file;
    file.accessor(0).erase("bufferView");
    file.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
    EXPECT_CONTAINS(error_of(file), "KHR_draco_mesh_compression");
}

TEST(GltfMalformed, UrisThatLeaveTheFolder) {
    for (const char* uri :
         {"../secret.bin", "%2e%2e/secret.bin", "%2e%2e%2fsecret.bin", "sub/../../secret.bin", "/etc/passwd",
          "%2fetc/passwd", "file:///etc/passwd", "http://localhost/a.bin", "C:/secret.bin", "a%00b", ""}) {
        TestGltf file;
        file.folder.add("sub/a.bin", std::string_view("a"));
        file.json["buffers"] = {{{"uri", uri}, {"byteLength", 36}}};
        error_of(file);

        TestGltf textured;
        textured.folder.add("sub/a.bin", std::string_view("a"));
        textured.json["images"] = {{{"uri", uri}}};
        textured.json["textures"] = {{{"source", 0}}};
        textured.material()["emissiveTexture"] = {{"index", 0}};
        const Scene scene = textured.load();
        ASSERT_EQ(scene.warnings.size(), 1u) << uri;
        EXPECT_CONTAINS(scene.warnings[0], "replaced by grey");
        EXPECT_EQ(scene.textures[0].pixels.width, 1);
        sentence(Fault::bad_input, [&] { textured.load({.strict = true}); });
    }
}

TEST(GltfMalformed, DotSegmentsAreResolvedBeforeTheyAreJudged) {
    for (const char* uri : {"a.bin", "./a.bin", "sub/../a.bin", "absent/../a.bin", "sub/%2e%2e/a.bin",
                            "sub/../sub/./../a.bin", "sub//b.bin", "sub\\b.bin", "absent\\..\\a.bin"}) {
        TestGltf file;
        file.folder.add("a.bin", std::span<const std::uint8_t>(file.bytes));
        file.folder.add("sub/b.bin", std::span<const std::uint8_t>(file.bytes));
        file.json["buffers"] = {{{"uri", uri}, {"byteLength", 36}}};
        EXPECT_EQ(file.load().triangles(), 1u) << uri;
    }
    for (const char* uri :
         {"sub/../../a.bin", "../a.bin", "..\\a.bin", "sub\\..\\..\\a.bin", "sub/..", "."}) {
        TestGltf file;
        file.folder.add("sub/b.bin", std::span<const std::uint8_t>(file.bytes));
        file.json["buffers"] = {{{"uri", uri}, {"byteLength", 36}}};
        error_of(file);
    }
}

TEST(GltfMalformed, LinksAndFoldersAreNotRead) {
    TestGltf file;
    std::filesystem::create_symlink("/etc/passwd", file.folder.path() / "link.bin");
    std::filesystem::create_directory(file.folder.path() / "folder.bin");
    for (const char* uri : {"link.bin", "folder.bin"}) {
        file.json["buffers"] = {{{"uri", uri}, {"byteLength", 36}}};
        EXPECT_CONTAINS(error_of(file), uri);
    }
    file.json["buffers"][0]["uri"] = "absent.bin";
    EXPECT_CONTAINS(error_of(file, Fault::io), "buffers[0].uri: cannot open \"absent.bin\"");
}

TEST(GltfMalformed, DataUris) {
    for (const char* uri : {"data:", "data:application/octet-stream,AAAA", "data:;base64,A",
                            "data:;base64,A$AA", "data:;base64,AAAA"}) {
        TestGltf file;
        file.json["buffers"] = {{{"uri", uri}, {"byteLength", 36}}};
        EXPECT_CONTAINS(error_of(file), "buffers[0]");
    }
}

TEST(GltfMalformed, NumbersBeyondAnyFile) {
    const std::uint64_t huge = std::uint64_t(1) << 62;
    const auto change = [](auto&& edit) {
        TestGltf file;
        edit(file);
        return error_of(file);
    };
    EXPECT_CONTAINS(change([&](TestGltf& f) { f.accessor(0)["count"] = huge; }), "accessors[0]");
    EXPECT_CONTAINS(change([&](TestGltf& f) { f.accessor(0)["count"] = 4; }), "do not fit the view");
    EXPECT_CONTAINS(change([&](TestGltf& f) { f.accessor(0)["count"] = 0; }), "no elements");
    EXPECT_CONTAINS(change([&](TestGltf& f) { f.accessor(0)["count"] = -3; }), "not a non-negative integer");
    EXPECT_CONTAINS(change([&](TestGltf& f) { f.accessor(0)["count"] = 1e300; }),
                    "not a non-negative integer");
    EXPECT_CONTAINS(change([&](TestGltf& f) { f.accessor(0)["byteOffset"] = huge; }), "do not fit the view");
    EXPECT_CONTAINS(change([&](TestGltf& f) { f.accessor(0)["byteOffset"] = ~std::uint64_t(0) - 3; }),
                    "do not fit");
    EXPECT_CONTAINS(change([&](TestGltf& f) { f.json["bufferViews"][0]["byteOffset"] = huge; }),
                    "lie outside");
    EXPECT_CONTAINS(change([&](TestGltf& f) { f.json["bufferViews"][0]["byteLength"] = huge; }),
                    "lie outside");
    EXPECT_CONTAINS(change([&](TestGltf& f) { f.json["bufferViews"][0]["byteStride"] = huge; }), "stride");
    EXPECT_CONTAINS(change([&](TestGltf& f) { f.json["bufferViews"][0]["byteStride"] = 4; }), "stride 4");
    EXPECT_CONTAINS(change([&](TestGltf& f) { f.json["buffers"] = {{{"byteLength", huge}}}; }), "buffers[0]");
    EXPECT_CONTAINS(change([&](TestGltf& f) {
                        f.json["buffers"] = {{{"byteLength", huge}, {"uri", "data:;base64,AAAA"}}};
                    }),
                    "holds 3 bytes");
}

TEST(GltfMalformed, AccessorsWithoutDataTakeNoMoreThanTheBudget) {
    TestGltf file;
    file.accessor(0).erase("bufferView");
    file.accessor(0)["count"] = 4000000000u;
    EXPECT_CONTAINS(error_of(file, Fault::resource), "needs more than 8 GiB");
}

TEST(GltfMalformed, TypesAndReferences) {
    const auto change = [](auto&& edit) {
        TestGltf file;
        edit(file);
        return error_of(file);
    };
    EXPECT_CONTAINS(change([](TestGltf& f) { f.accessor(0)["componentType"] = 5124; }), "componentType");
    EXPECT_CONTAINS(change([](TestGltf& f) { f.accessor(0)["componentType"] = 5125; }), "32-bit integers");
    EXPECT_CONTAINS(change([](TestGltf& f) { f.accessor(0)["type"] = "VEC2"; }),
                    "VEC2 instead of a vector of 3");
    EXPECT_CONTAINS(change([](TestGltf& f) { f.accessor(0)["type"] = "MAT4"; }), "MAT4");
    EXPECT_CONTAINS(change([](TestGltf& f) { f.attributes()["POSITION"] = 1; }),
                    "accessors 1 does not exist");
    EXPECT_CONTAINS(change([](TestGltf& f) { f.accessor(0)["bufferView"] = 7; }),
                    "bufferView 7 does not exist");
    EXPECT_CONTAINS(change([](TestGltf& f) { f.json["bufferViews"][0]["buffer"] = 7; }),
                    "buffer 7 does not exist");
    EXPECT_CONTAINS(change([](TestGltf& f) { f.json["nodes"][0]["mesh"] = 7; }), "mesh 7 does not exist");
    EXPECT_CONTAINS(change([](TestGltf& f) { f.primitive()["material"] = 0; }), "material 0 does not exist");
    EXPECT_CONTAINS(change([](TestGltf& f) { f.json["scene"] = 3; }), "scene 3 does not exist");
    EXPECT_CONTAINS(change([](TestGltf& f) { f.json["nodes"] = 3; }), "nodes: is not an array");
    EXPECT_CONTAINS(change([](TestGltf& f) { f.json["nodes"][0] = 3; }), "nodes[0]: is not an object");
    EXPECT_CONTAINS(change([](TestGltf& f) { f.primitive()["mode"] = 7; }), "not a primitive mode");
    EXPECT_CONTAINS(change([](TestGltf& f) {
                        f.attributes()["NORMAL"] = f.add_vectors<3>({{0, 0, 1}});
                    }),
                    "NORMAL: has 1 elements for 3 vertices");
    EXPECT_CONTAINS(change([](TestGltf& f) {
                        f.material()["emissiveTexture"] = {{"index", 0}};
                    }),
                    "texture 0");
    EXPECT_CONTAINS(change([](TestGltf& f) { f.material()["pbrMetallicRoughness"]["roughnessFactor"] = 2; }),
                    "roughnessFactor: 2 is not within 0 to 1");
}

TEST(GltfMalformed, Indices) {
    TestGltf file;
    file.primitive()["indices"] = file.add_accessor<std::uint16_t>({0, 1, 3}, 3, "SCALAR", 5123);
    EXPECT_CONTAINS(error_of(file), "indices: index 3 is out of range, there are 3 vertices");
    TestGltf floats;
    floats.primitive()["indices"] = floats.add_accessor<float>({0, 1, 2}, 3, "SCALAR", 5126);
    EXPECT_CONTAINS(error_of(floats), "unsigned integers");
}

TEST(GltfMalformed, SparseIndices) {
    const auto change = [](std::vector<std::uint16_t> targets, std::size_t count) {
        TestGltf file;
        const int values = file.add_view(std::vector<float>(9).data(), 36);
        const int indices = file.add_view(targets.data(), targets.size() * 2);
        file.accessor(0)["sparse"] = {{"count", count},
                                      {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                      {"values", {{"bufferView", values}}}};
        return error_of(file);
    };
    EXPECT_CONTAINS(change({3}, 1), "index 3 is out of range or order");
    EXPECT_CONTAINS(change({1, 1}, 2), "index 1 is out of range or order");
    EXPECT_CONTAINS(change({0, 1}, 3), "do not fit the view");
    EXPECT_CONTAINS(change({0, 1}, 4), "count 4 is not within 1 to 3");
}

TEST(GltfMalformed, CyclesAndSecondParents) {
    TestGltf cycle;
    cycle.json["nodes"] = {{{"children", {1}}}, {{"children", {0}}, {"mesh", 0}}};
    EXPECT_CONTAINS(error_of(cycle), "node 0 is reached twice");
    cycle.json["nodes"] = {{{"children", {0}}}};
    EXPECT_CONTAINS(error_of(cycle), "node 0 is reached twice");
    cycle.json["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}};
    cycle.json["scenes"][0]["nodes"] = {0, 1};
    EXPECT_CONTAINS(error_of(cycle), "node 2 is reached twice");

    // Without scenes a cycle has no root at all.
    cycle.json["nodes"] = {{{"children", {1}}}, {{"children", {0}}, {"mesh", 0}}};
    cycle.json.erase("scenes");
    cycle.json.erase("scene");
    EXPECT_CONTAINS(error_of(cycle), "no triangles");
}

TEST(GltfMalformed, LongChainsOfNodes) {
    TestGltf file;
    const int length = 100000;
    file.json["nodes"] = nlohmann::json::array();
    for (int i = 0; i + 1 < length; ++i) file.json["nodes"].push_back({{"children", {i + 1}}});
    file.json["nodes"].push_back({{"mesh", 0}});
    EXPECT_EQ(file.load().triangles(), 1u);
}

TEST(GltfMalformed, NumbersThatAreNotFinite) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        TestGltf file;
        file.attributes()["POSITION"] = file.add_vectors<3>({{0, 0, 0}, {1, bad, 0}, {0, 1, 0}});
        EXPECT_CONTAINS(error_of(file), "the scene has no triangles");
    }
    TestGltf overflow;
    overflow.json["nodes"] = {{{"scale", {1e30, 1e30, 1e30}}, {"children", {1}}},
                              {{"scale", {1e30, 1e30, 1e30}}, {"mesh", 0}}};
    EXPECT_CONTAINS(error_of(overflow), "not finite");
    TestGltf text;
    text.json["nodes"][0]["scale"] = {1, 1, 1e300};
    EXPECT_CONTAINS(error_of(text), "too large a number");
    EXPECT_CONTAINS(error_of_bytes("{\"asset\": {\"version\": 1e999}}"), "JSON");
}

TEST(GltfMalformed, NothingToShow) {
    TestGltf file;
    file.json["scenes"][0].erase("nodes");
    EXPECT_CONTAINS(error_of(file), "the scene has no triangles");
    TestGltf lines;
    lines.primitive()["mode"] = 1;
    EXPECT_CONTAINS(error_of(lines), "the scene has no triangles");
    TestGltf bare;
    bare.json = {{"asset", {{"version", "2.0"}}}};
    EXPECT_CONTAINS(error_of(bare), "the scene has no triangles");
}

// Random damage to a sound file, the same in every run: it loads or ends with a sentence.
TEST(GltfMalformed, RandomDamage) {
    TestGltf file;
    file.primitive()["indices"] = file.add_accessor<std::uint16_t>({0, 1, 2}, 3, "SCALAR", 5123);
    file.attributes()["TEXCOORD_0"] = file.add_vectors<2>({{0, 0}, {1, 0}, {0, 1}});
    file.material() = {{"emissiveFactor", {1, 1, 1}}, {"doubleSided", true}};
    const auto whole = file.glb();
    std::mt19937 random(1);
    int loaded = 0, refused = 0;
    for (int run = 0; run < 600; ++run) {
        auto bytes = whole;
        for (int change = 0; change <= run % 3; ++change)
            bytes[random() % bytes.size()] = std::uint8_t(random());
        const auto path = file.folder.path() / "damaged.glb";
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
        try {
            load_gltf(path);
            ++loaded;
        } catch (const Error& error) {
            ++refused;
            EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
        }
    }
    EXPECT_GT(loaded, 20);
    EXPECT_GT(refused, 200);
}

TEST(GltfMalformed, NamesDoNotReachTheTerminalRaw) {
    TestGltf file;
    file.json["nodes"][0]["name"] = "\x1b[2J\nname";
    EXPECT_EQ(file.load().instances[0].name, "?[2J?name");
    file.json["extensionsRequired"] = {"\x1b]0;evil\x07" + std::string(5000, 'x')};
    const std::string text = error_of(file, Fault::unsupported);
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
    EXPECT_LT(text.size(), 400u);
}

TEST(GltfUri, DecodesBase64) {
    const auto text = [](std::string_view encoded) {
        const auto bytes = gltf::decode_base64(encoded);
        return bytes ? std::string(bytes->begin(), bytes->end()) : std::string("(none)");
    };
    // RFC 4648, section 10.
    EXPECT_EQ(text(""), "");
    EXPECT_EQ(text("Zg=="), "f");
    EXPECT_EQ(text("Zm8="), "fo");
    EXPECT_EQ(text("Zm9v"), "foo");
    EXPECT_EQ(text("Zm9vYmFy"), "foobar");
    EXPECT_EQ(text("Zm9"), "fo");
    EXPECT_EQ(text("Zm9vY"), "(none)");
    EXPECT_EQ(text("Zm=v"), "(none)");
}

TEST(GltfUri, DecodesPercent) {
    EXPECT_EQ(gltf::decode_percent("a%20b"), "a b");
    EXPECT_EQ(gltf::decode_percent("%252e"), "%2e");
    EXPECT_EQ(gltf::decode_percent("100%"), "100%");
    EXPECT_EQ(gltf::decode_percent("%4"), "%4");
    EXPECT_EQ(gltf::decode_percent("%zz%2E"), "%zz.");
}

TEST(GltfUri, ResolvesDots) {
    EXPECT_EQ(gltf::without_dots("a/./b/../c"), "a/c");
    EXPECT_EQ(gltf::without_dots("a/.."), "");
    EXPECT_EQ(gltf::without_dots("a/b/../.."), "");
    EXPECT_EQ(gltf::without_dots("..a/b.."), "..a/b..");
    EXPECT_FALSE(gltf::without_dots(".."));
    EXPECT_FALSE(gltf::without_dots("a/../../a"));
}

} // namespace
} // namespace luxel
