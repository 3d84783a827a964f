// SPDX-License-Identifier: MIT
// EXR files of other programs: windows, names, parts.
#include <array>
#include <cstdio>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"
#include "core/image_io.h"

using namespace luxel;

namespace {

std::filesystem::path temporary(const char* name) {
    return std::filesystem::path(::testing::TempDir()) / name;
}

// Channel c of pixel (x, y) holds 1 + c + 10 x + 100 y, with x and y counted in the display window.
float value_at(int c, int x, int y) { return 1.0f + float(c) + 10.0f * float(x) + 100.0f * float(y); }

struct Written {
    Imath::Box2i data, shown;
    std::vector<std::string> channels;

    Imf::Header header() const {
        Imf::Header h(shown, data, 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y, Imf::PIZ_COMPRESSION);
        for (const std::string& name : channels) h.channels().insert(name, Imf::Channel(Imf::FLOAT));
        return h;
    }
    std::vector<std::vector<float>> values() const {
        std::vector<std::vector<float>> all;
        for (std::size_t c = 0; c < channels.size(); ++c) {
            all.emplace_back();
            for (int y = data.min.y; y <= data.max.y; ++y)
                for (int x = data.min.x; x <= data.max.x; ++x)
                    all.back().push_back(value_at(int(c), x - shown.min.x, y - shown.min.y));
        }
        return all;
    }
    template <class File> void write(File& file) const {
        std::vector<std::vector<float>> all = values();
        Imf::FrameBuffer frame;
        for (std::size_t c = 0; c < channels.size(); ++c)
            frame.insert(channels[c], Imf::Slice::Make(Imf::FLOAT, all[c].data(), data));
        file.setFrameBuffer(frame);
        file.writePixels(data.max.y - data.min.y + 1);
    }
    ExrFile read() const {
        const auto path = temporary("luxel_codec_exr.exr");
        {
            Imf::OutputFile file(path.c_str(), header());
            write(file);
        }
        ExrFile read = read_exr(path);
        std::filesystem::remove(path);
        return read;
    }
};

Imath::Box2i box(int x0, int y0, int x1, int y1) { return {{x0, y0}, {x1, y1}}; }

} // namespace

TEST(CodecExr, DataWindowsStandInTheirDisplayWindow) {
    // Within it, across its corner, and beside it; the display window begins anywhere.
    for (const Imath::Box2i& data : {box(5, -2, 8, 0), box(1, -6, 4, 4), box(100, 100, 103, 101)}) {
        const Written file{data, box(3, -4, 12, 1), {"B", "G", "R"}};
        const ExrFile read = file.read();
        const Image& image = read.layers.at("");
        ASSERT_EQ(image.width, 10);
        ASSERT_EQ(image.height, 6);
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 10; ++x) {
                const bool inside =
                    x + 3 >= data.min.x && x + 3 <= data.max.x && y - 4 >= data.min.y && y - 4 <= data.max.y;
                for (int c = 0; c < 3; ++c)
                    EXPECT_EQ(image.at(x, y)[c], inside ? value_at(2 - c, x, y) : 0.0f) << x << " " << y;
            }
        EXPECT_EQ(read.remark.empty(), data == box(5, -2, 8, 0)) << read.remark;
    }
}

TEST(CodecExr, ChannelsByManyNames) {
    const std::vector<std::vector<std::string>> unnamed = {{"R", "G", "B"},
                                                           {".R", ".G", ".B"},
                                                           {"r", "g", "b"},
                                                           {"red", "green", "blue"},
                                                           {"R", "G", "B", "Z", "id"}};
    for (const auto& names : unnamed) {
        const ExrFile file = Written{box(0, 0, 2, 1), box(0, 0, 2, 1), names}.read();
        ASSERT_TRUE(file.layers.contains("")) << names[0];
        EXPECT_EQ(file.layers.at("").channels, 3) << names[0];
        EXPECT_EQ(file.layers.at("").rgb(2, 1),
                  glm::vec3(value_at(0, 2, 1), value_at(1, 2, 1), value_at(2, 2, 1)))
            << names[0];
    }
    for (const char* name : {"Y", "R", ".R"})
        EXPECT_EQ(Written({box(0, 0, 1, 1), box(0, 0, 1, 1), {name}}).read().layers.at("").channels, 1)
            << name;
    const ExrFile layers =
        Written{box(0, 0, 1, 1), box(0, 0, 1, 1), {"a.b.R", "a.b.G", "a.b.B", "a.Z"}}.read();
    EXPECT_EQ(layers.layers.at("a.b").channels, 3);
    EXPECT_EQ(layers.layers.at("a.Z").channels, 1);
}

TEST(CodecExr, XyzIsAColor) {
    const ExrFile file = Written{box(0, 0, 0, 0), box(0, 0, 0, 0), {"X", "Y", "Z"}}.read();
    EXPECT_NE(file.remark.find("XYZ"), std::string::npos);
    const glm::vec3 rgb = file.layers.at("").rgb(0, 0); // of XYZ (1, 2, 3)
    EXPECT_NEAR(rgb.r, 3.2406f - 2 * 1.5372f - 3 * 0.4986f, 1e-5f);
    EXPECT_NEAR(rgb.b, 0.0557f - 2 * 0.2040f + 3 * 1.0570f, 1e-5f);
}

TEST(CodecExr, TheFirstOfSeveralPartsIsRead) {
    const auto path = temporary("luxel_codec_parts.exr");
    const Written first{box(0, 0, 3, 2), box(0, 0, 3, 2), {"R", "G", "B"}},
        second{box(1, 1, 2, 2), box(0, 0, 3, 2), {"Z"}};
    std::array<Imf::Header, 2> headers = {first.header(), second.header()};
    for (std::size_t i = 0; i < 2; ++i)
        headers[i].setName(i ? "depth" : "beauty"), headers[i].setType(Imf::SCANLINEIMAGE);
    {
        Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 2);
        Imf::OutputPart a(file, 0), b(file, 1);
        first.write(a), second.write(b);
    }
    Remarks remarks;
    const Image image = read_image(path, &remarks);
    EXPECT_EQ(image.width, 4);
    EXPECT_EQ(image.rgb(3, 2), glm::vec3(value_at(0, 3, 2), value_at(1, 3, 2), value_at(2, 3, 2)));
    ASSERT_EQ(remarks.size(), 1u);
    EXPECT_NE(remarks[0].find("2 parts"), std::string::npos) << remarks[0];
    std::filesystem::remove(path);
}

TEST(CodecExr, TheOnlyLayerOfColorsIsThePicture) {
    const auto path = temporary("luxel_codec_layers.exr");
    const Written layered{box(0, 0, 3, 2), box(0, 0, 3, 2), {"a.R", "a.G", "a.B", "b.Z"}};
    {
        Imf::OutputFile file(path.c_str(), layered.header());
        layered.write(file);
    }
    Remarks remarks;
    EXPECT_EQ(read_image(path, &remarks).rgb(3, 2).r, value_at(0, 3, 2));
    ASSERT_EQ(remarks.size(), 1u);
    EXPECT_NE(remarks[0].find("layer \"a\" is read"), std::string::npos) << remarks[0];
    std::filesystem::remove(path);
}
