// SPDX-License-Identifier: MIT
#include "scene/environment_layout.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "shared/sampling.h"

namespace luxel {
namespace {

using shared::PI;

enum Face { right, left, top, bottom, front, back };

struct Cell {
    int column, row;
    bool turned = false; // by 180 degrees
};
struct Unfolding {
    int columns, rows;
    Cell faces[6];
};

Unfolding unfolding(MapLayout layout) {
    switch (layout) {
    case MapLayout::cross_4x3:
        return {4, 3, {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}};
    case MapLayout::cross_3x4:
        return {3, 4, {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3, true}}};
    case MapLayout::strip_6x1:
        return {6, 1, {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}};
    case MapLayout::strip_1x6:
        return {1, 6, {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}};
    default:
        LUXEL_ASSERT(false, "layout {} is no cube", int(layout));
    }
    return {};
}

float largest(glm::vec3 v) { return std::max({v.r, v.g, v.b}); }

// All of a cell's pixels are alike, up to what lossy compression adds.
bool is_blank(const Image& picture, int column, int row, int side) {
    const glm::vec3 first = picture.rgb(column * side, row * side);
    const float tolerance = 0.02f * (1.0f + largest(first));
    for (int y = row * side; y < (row + 1) * side; ++y)
        for (int x = column * side; x < (column + 1) * side; ++x) {
            const glm::vec3 difference = glm::abs(picture.rgb(x, y) - first);
            if (!(largest(difference) <= tolerance)) return false;
        }
    return true;
}

bool is_cross(const Image& picture, MapLayout layout) {
    const Unfolding u = unfolding(layout);
    const int side = picture.width / u.columns;
    for (int row = 0; row < u.rows; ++row)
        for (int column = 0; column < u.columns; ++column) {
            const bool used = std::any_of(std::begin(u.faces), std::end(u.faces),
                                          [&](const Cell& c) { return c.column == column && c.row == row; });
            if (!used && !is_blank(picture, column, row, side)) return false;
        }
    return true;
}

class Cube {
public:
    Cube(const Image& picture, MapLayout layout)
        : picture_(picture), unfolding_(unfolding(layout)), side_(picture.width / unfolding_.columns),
          uneven_(picture.pixels()) {
        for (const Cell& cell : unfolding_.faces) mark_uneven(cell);
    }

    int side() const { return side_; }

    struct Texel {
        glm::vec3 color;
        bool uneven; // a neighbor is brighter or darker by more than a tenth, or may be, on another face
    };
    // x to the right, y up, z backward.
    Texel at(glm::vec3 d) const {
        const glm::vec3 size = glm::abs(d);
        Face face;
        glm::vec2 st; // right and down on the face, in [-1, 1]
        if (size.x >= size.y && size.x >= size.z) {
            face = d.x > 0.0f ? right : left;
            st = glm::vec2(d.x > 0.0f ? d.z : -d.z, -d.y) / size.x;
        } else if (size.y >= size.z) {
            face = d.y > 0.0f ? top : bottom;
            st = glm::vec2(d.x, d.y > 0.0f ? -d.z : d.z) / size.y;
        } else {
            face = d.z < 0.0f ? front : back;
            st = glm::vec2(d.z < 0.0f ? d.x : -d.x, -d.y) / size.z;
        }
        const Cell& cell = unfolding_.faces[face];
        if (cell.turned) st = -st;
        const auto texel = [&](float s) {
            return std::clamp(int((s * 0.5f + 0.5f) * float(side_)), 0, side_ - 1);
        };
        const int x = cell.column * side_ + texel(st.x), y = cell.row * side_ + texel(st.y);
        return {picture_.rgb(x, y), uneven_[pixel(x, y)] != 0};
    }

private:
    std::size_t pixel(int x, int y) const {
        return std::size_t(y) * std::size_t(picture_.width) + std::size_t(x);
    }

    void mark_uneven(const Cell& cell) {
        const int left_end = cell.column * side_, upper_end = cell.row * side_;
        for (int y = 0; y < side_; ++y)
            for (int x = 0; x < side_; ++x) {
                bool uneven = x == 0 || y == 0 || x == side_ - 1 || y == side_ - 1;
                const glm::vec3 here = picture_.rgb(left_end + x, upper_end + y);
                for (int i = 0; i < 9 && !uneven; ++i) {
                    const glm::vec3 there = picture_.rgb(left_end + x + i % 3 - 1, upper_end + y + i / 3 - 1);
                    uneven = largest(glm::abs(there - here)) > 0.1f * std::max(largest(here), largest(there));
                }
                uneven_[pixel(left_end + x, upper_end + y)] = uneven;
            }
    }

    const Image& picture_;
    Unfolding unfolding_;
    int side_;
    std::vector<std::uint8_t> uneven_;
};

} // namespace

MapLayout layout_of(const Image& picture) {
    const auto is = [&](int across, int down) {
        return picture.width % across == 0 && picture.width / across * down == picture.height;
    };
    if (is(2, 1)) return MapLayout::equirectangular;
    if (is(4, 3) && is_cross(picture, MapLayout::cross_4x3)) return MapLayout::cross_4x3;
    if (is(3, 4) && is_cross(picture, MapLayout::cross_3x4)) return MapLayout::cross_3x4;
    if (is(6, 1)) return MapLayout::strip_6x1;
    if (is(1, 6)) return MapLayout::strip_1x6;
    return is(1, 1) ? MapLayout::square : MapLayout::other;
}

std::string describe(MapLayout layout) {
    switch (layout) {
    case MapLayout::equirectangular:
        return "an equirectangular map";
    case MapLayout::cross_4x3:
    case MapLayout::cross_3x4:
        return "a cube unfolded to a cross";
    case MapLayout::strip_6x1:
    case MapLayout::strip_1x6:
        return "a strip of the six faces of a cube";
    case MapLayout::square:
        return "square, as mirror balls and angular maps are";
    case MapLayout::other:
        break;
    }
    return "not twice as wide as high";
}

// Means over each texel by points that are even in solid angle, many where the cube is uneven.
Image equirectangular(const Image& picture, MapLayout layout) {
    const Cube cube(picture, layout);
    Image map(4 * cube.side(), 2 * cube.side(), 3);
    parallel_for(std::size_t(map.height), 4, [&](std::size_t row) {
        const float upper = std::cos(PI * float(row) / float(map.height)),
                    lower = std::cos(PI * float(row + 1) / float(map.height));
        for (int x = 0; x < map.width; ++x) {
            glm::vec3 mean(0.0f);
            bool uneven = false;
            const auto look = [&](std::uint32_t points) {
                glm::vec3 sum(0.0f);
                for (std::uint32_t i = 0; i < points; ++i) {
                    const glm::vec2 p = shared::hammersley(i, points);
                    const float cosine = glm::mix(upper, lower, p.y);
                    const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
                    const float phi = 2.0f * PI * ((float(x) + p.x) / float(map.width) - 0.5f);
                    const Cube::Texel texel = cube.at({sine * std::sin(phi), cosine, -sine * std::cos(phi)});
                    sum += texel.color, uneven |= texel.uneven;
                }
                mean = sum / float(points);
            };
            look(8);
            if (uneven) look(1024);
            map.set_rgb(x, int(row), mean);
        }
    });
    return map;
}

} // namespace luxel
