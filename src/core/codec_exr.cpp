// SPDX-License-Identifier: MIT
// OpenEXR images in memory to layers of floats, as large as their display windows.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <map>
#include <set>

#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
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

std::string lower(std::string text) {
    for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

// ".R" belongs to the unnamed layer, as "R" does.
std::pair<std::string, std::string> split(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    return dot == std::string::npos ? std::pair{std::string(), name}
                                    : std::pair{name.substr(0, dot), name.substr(dot + 1)};
}

// Which of R, G, B, A a channel's last name means; -1: none of them.
int component_of(const std::string& part) {
    static const std::map<std::string, int> components = {
        {"r", 0}, {"g", 1}, {"b", 2}, {"a", 3}, {"red", 0}, {"green", 1}, {"blue", 2}, {"alpha", 3}};
    const auto found = components.find(lower(part));
    return found == components.end() ? -1 : found->second;
}

// R, G, B (and A) of one layer belong together, in whatever case they are written; Y stands alone, and a
// lone R, too. X, Y and Z without a layer are a color. Everything else is a layer of its own.
struct Plan {
    std::vector<Target> targets;
    bool xyz = false; // the unnamed layer
};
Plan plan(const Imf::ChannelList& channels) {
    std::map<std::string, std::array<std::string, 4>> colors; // by layer: the channels of R, G, B, A
    std::set<std::string> names;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const std::string name = channel.name();
        names.insert(name);
        const auto [layer, part] = split(name);
        const int component = component_of(part);
        // Where a file has both "r" and "R", the capital comes first and is the color.
        if (component >= 0 && colors[layer][std::size_t(component)].empty())
            colors[layer][std::size_t(component)] = name;
    }
    Plan result;
    const auto unnamed = colors.find("");
    const bool no_color = unnamed == colors.end() || unnamed->second[0].empty();
    result.xyz = no_color && names.contains("X") && names.contains("Y") && names.contains("Z");

    for (const std::string& name : names) {
        const auto [layer, part] = split(name);
        const auto found = colors.find(layer);
        const std::array<std::string, 4>* rgba = found == colors.end() ? nullptr : &found->second;
        const bool color = rgba && !(*rgba)[0].empty() && !(*rgba)[1].empty() && !(*rgba)[2].empty();
        const bool lone_red =
            rgba && layer.empty() && !(*rgba)[0].empty() && (*rgba)[1].empty() && (*rgba)[2].empty();
        const bool lone_y = part == "Y" && !names.contains(name.substr(0, name.size() - 1) + "X");
        const int component = component_of(part);
        if (color && component >= 0 && (*rgba)[std::size_t(component)] == name)
            result.targets.push_back({name, layer, component, (*rgba)[3].empty() ? 3 : 4});
        else if (result.xyz && (name == "X" || name == "Y" || name == "Z"))
            result.targets.push_back({name, "", name[0] - 'X', 3});
        else if (!color && (lone_y || (lone_red && component == 0 && !names.contains("Y"))))
            result.targets.push_back({name, layer, 0, 1});
        else
            result.targets.push_back({name, name, 0, 1});
    }
    return result;
}

// CIE XYZ to linear sRGB, as IEC 61966-2-1 has it.
void to_srgb(Image& image) {
    const glm::mat3 rows(3.2406f, -1.5372f, -0.4986f, -0.9689f, 1.8758f, 0.0415f, 0.0557f, -0.2040f, 1.0570f);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) image.set_rgb(x, y, image.rgb(x, y) * rows);
}

void add_remark(ExrFile& file, const std::string& remark) {
    file.remark += (file.remark.empty() ? "" : "; ") + remark;
}

// What of the data window lies in the display window, at its place there; the rest is black.
Image placed(const Image& data, const Imath::Box2i& window, const Imath::Box2i& shown) {
    Image image(shown.max.x - shown.min.x + 1, shown.max.y - shown.min.y + 1, data.channels);
    const int left = std::max(window.min.x, shown.min.x), right = std::min(window.max.x, shown.max.x);
    const int top = std::max(window.min.y, shown.min.y), bottom = std::min(window.max.y, shown.max.y);
    for (int y = top; y <= bottom && left <= right; ++y)
        std::copy_n(data.at(left - window.min.x, y - window.min.y),
                    std::size_t(right - left + 1) * std::size_t(data.channels),
                    image.at(left - shown.min.x, y - shown.min.y));
    return image;
}

void place_all(ExrFile& file, const Imath::Box2i& window, const Imath::Box2i& shown) {
    if (window == shown) return;
    if (window.min.x < shown.min.x || window.min.y < shown.min.y || window.max.x > shown.max.x ||
        window.max.y > shown.max.y)
        add_remark(file, "what its data window holds outside of its display window is left out");
    for (auto& [name, image] : file.layers) image = placed(image, window, shown);
}

void read_metadata(ExrFile& file, const Imf::Header& header) {
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute()))
            file.metadata[attribute.name()] = text->value();
    if (Imf::hasChromaticities(header)) {
        const Imf::Chromaticities &a = Imf::chromaticities(header), b;
        const auto far = [](Imath::V2f p, Imath::V2f q) { return (p - q).length() > 0.002f; };
        if (far(a.red, b.red) || far(a.green, b.green) || far(a.blue, b.blue) || far(a.white, b.white))
            add_remark(file, "its color primaries are not those of sRGB but are read as if they were");
    }
}

ExrFile decode_checked(std::span<const std::uint8_t> bytes, const ExrHeader& checked) {
    MemoryStream stream(bytes);
    Imf::InputFile file(stream, 0);
    if (!file.isComplete()) fail(Fault::bad_input, "the EXR file is incomplete");
    const Imf::Header& header = file.header();
    const Imath::Box2i window = header.dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;

    // OpenEXR converts HALF and UINT to the FLOAT slices that it is given.
    ExrFile result;
    Imf::FrameBuffer frame;
    const Plan planned = plan(header.channels());
    for (const Target& target : planned.targets) {
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

    if (checked.parts > 1)
        add_remark(result, fmt::format("it has {} parts, of which the first is read", checked.parts));
    if (planned.xyz) {
        to_srgb(result.layers[""]);
        add_remark(result, "its CIE XYZ channels are converted to linear sRGB");
    }
    place_all(result, window, header.displayWindow());
    read_metadata(result, header);
    return result;
}

} // namespace

ExrFile decode_exr(std::span<const std::uint8_t> bytes) {
    const ExrHeader header = check_exr_header(bytes);
    try {
        return decode_checked(bytes, header);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        fail(Fault::bad_input, "{}", error.what());
    }
}

} // namespace luxel::codec
