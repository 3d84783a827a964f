// SPDX-License-Identifier: MIT
// OpenEXR images in memory to layers of floats.
#include <array>
#include <cstring>
#include <string_view>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

#include "core/codec.h"
#include "core/error.h"

namespace luxel::codec {
namespace {

class MemoryStream : public Imf::IStream {
public:
    explicit MemoryStream(std::span<const std::uint8_t> bytes) : IStream("image"), bytes_(bytes) {}

    bool read(char target[], int count) override {
        if (count < 0 || std::uint64_t(count) > bytes_.size() - position_)
            fail(Fault::bad_input, "the file ends early");
        std::memcpy(target, bytes_.data() + position_, std::size_t(count));
        position_ += std::uint64_t(count);
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override {
        if (position > bytes_.size()) fail(Fault::bad_input, "the file ends early");
        position_ = position;
    }

private:
    std::span<const std::uint8_t> bytes_;
    std::uint64_t position_ = 0;
};

// Which layer and which of its channels each EXR channel fills.
struct Target {
    std::string channel, layer;
    int index, count; // channel index of so many
};

std::pair<std::string, std::string> split(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    return dot == std::string::npos ? std::pair{std::string(), name}
                                    : std::pair{name.substr(0, dot), name.substr(dot + 1)};
}

// R, G, B (and A) of one layer belong together, Y stands alone; everything else is a layer of its own.
std::vector<Target> plan(const Imf::ChannelList& channels) {
    std::vector<Target> targets;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const std::string name = channel.name();
        const auto [layer, part] = split(name);
        const auto has = [&, prefix = layer.empty() ? "" : layer + "."](const char* other) {
            return channels.findChannel(prefix + other) != nullptr;
        };
        const bool color = has("R") && has("G") && has("B");
        const std::size_t index = std::string_view("RGBA").find(part);
        if (color && part.size() == 1 && index != std::string_view::npos)
            targets.push_back({name, layer, int(index), has("A") ? 4 : 3});
        else if (!color && part == "Y")
            targets.push_back({name, layer, 0, 1});
        else
            targets.push_back({name, name, 0, 1});
    }
    return targets;
}

ExrFile decode_checked(std::span<const std::uint8_t> bytes) {
    MemoryStream stream(bytes);
    Imf::InputFile file(stream, 0);
    const Imath::Box2i window = file.header().dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;

    // OpenEXR converts HALF and UINT to the FLOAT slices that it is given.
    ExrFile result;
    Imf::FrameBuffer frame;
    for (const Target& target : plan(file.header().channels())) {
        Image& image = result.layers[target.layer];
        if (image.empty()) image = Image(width, height, target.count);
        if (image.channels != target.count)
            fail(Fault::bad_input, "the EXR channels of layer \"{}\" clash", target.layer);
        const std::size_t step = sizeof(float) * std::size_t(target.count);
        frame.insert(target.channel, Imf::Slice::Make(Imf::FLOAT, image.data.data() + target.index, window,
                                                      step, step * std::size_t(width)));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);

    for (auto attribute = file.header().begin(); attribute != file.header().end(); ++attribute)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute()))
            result.metadata[attribute.name()] = text->value();
    return result;
}

} // namespace

ExrFile decode_exr(std::span<const std::uint8_t> bytes) {
    check_exr_header(bytes);
    try {
        return decode_checked(bytes);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        fail(Fault::bad_input, "{}", error.what());
    }
}

} // namespace luxel::codec
