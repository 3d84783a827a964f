// SPDX-License-Identifier: MIT
#include "techniques/frame/named_image.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/closest.h"
#include "core/error.h"
#include "core/image_io.h"
#include "core/parameters.h"

namespace luxel {
namespace {

struct Part {
    int mip = 0;
    int layer = -1; // -1: all
    void visit(Visitor& v) {
        v.integer("mip", mip, {0, 31}, "level of detail; each halves the sides");
        v.integer("layer", layer, {-1, 65535}, "one layer or face of a cube; -1 = all, unrolled");
    }
};

gpu::Image find_image(const std::vector<gpu::Image>& made, const std::string& name) {
    const auto found =
        std::find_if(made.rbegin(), made.rend(), [&](const gpu::Image& i) { return i.name() == name; });
    if (found != made.rend()) return *found;
    std::vector<std::string> known;
    for (const gpu::Image& image : made) known.push_back(image.name());
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    fail(Fault::usage, "{}: the frame has no such image; {}", name, known_are(name, known));
}

void paste(const Image& from, Image& to, int left, int top) {
    for (int y = 0; y < from.height; ++y)
        std::copy_n(from.at(0, y), std::size_t(from.width * from.channels), to.at(left, top + y));
}

Image cross_of(const Image* faces) {
    constexpr std::array<std::array<int, 2>, 6> places = {
        {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}}; // of +x, -x, +y, -y, +z, -z
    const int side = faces[0].width;
    Image cross(4 * side, 3 * side, faces[0].channels);
    for (std::size_t f = 0; f < 6; ++f) paste(faces[f], cross, places[f][0] * side, places[f][1] * side);
    return cross;
}

int columns_of(std::size_t tiles) { return int(std::ceil(std::sqrt(double(tiles)))); }

} // namespace

Image unrolled(const std::vector<Image>& layers, bool cubes) {
    LUXEL_ASSERT(!layers.empty() && (!cubes || layers.size() % 6 == 0), "{} layers", layers.size());
    std::vector<Image> crosses;
    for (std::size_t i = 0; cubes && i < layers.size(); i += 6) crosses.push_back(cross_of(&layers[i]));
    const std::vector<Image>& tiles = cubes ? crosses : layers;
    if (tiles.size() == 1) return tiles[0];

    const int columns = columns_of(tiles.size()), rows = (int(tiles.size()) + columns - 1) / columns;
    const int width = tiles[0].width, height = tiles[0].height;
    Image all(columns * width, rows * height, tiles[0].channels);
    for (int i = 0; i < int(tiles.size()); ++i)
        paste(tiles[std::size_t(i)], all, i % columns * width, i / columns * height);
    return all;
}

Image read_named_image(gpu::Gpu& gpu, const std::vector<gpu::Image>& made, std::string_view text) {
    const Specification specification = parse_specification(text);
    const gpu::Image image = find_image(made, specification.name);
    Part part;
    set_parameters(part, specification.name, specification.values);
    const gpu::ImageInfo& info = image.info();
    if (part.mip >= int(info.mips))
        fail(Fault::usage, "{}: there is no mip {}; it has {}", specification.name, part.mip, info.mips);
    if (part.layer >= int(info.layers))
        fail(Fault::usage, "{}: there is no layer {}; it has {}", specification.name, part.layer,
             info.layers);
    const gpu::Image level = image.mip(std::uint32_t(part.mip));
    if (part.layer >= 0) return gpu.read(level.layer(std::uint32_t(part.layer)));

    const std::size_t tiles = info.cube ? info.layers / 6 : info.layers;
    const std::uint64_t columns = std::uint64_t(columns_of(tiles)) * (info.cube ? 4 : 1);
    if (columns * std::max(level.width(), level.height()) > std::uint64_t(max_image_side))
        fail(Fault::usage, "{}: {} layers of {}x{} are too large for one picture; name one as {}:layer=0",
             specification.name, info.layers, level.width(), level.height(), specification.name);
    std::vector<Image> layers;
    for (std::uint32_t i = 0; i < info.layers; ++i) layers.push_back(gpu.read(level.layer(i)));
    return unrolled(layers, info.cube);
}

} // namespace luxel
