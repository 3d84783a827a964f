// SPDX-License-Identifier: MIT
#include "experiments/page_view.h"

#include "core/flip.h"
#include "experiments/pictures.h"

namespace luxel {

namespace {

// Small copies bear less of a closer look.
constexpr int large_width = 640;
constexpr int photo_quality = 88, map_quality = 80, small_quality = 75;

} // namespace

nlohmann::ordered_json page_view(const ViewPictures& p, int width) {
    const bool small = width < large_width;
    const auto uri = [&](const Image& image, int quality) {
        return jpeg_uri(shrink(image, width), small ? small_quality : quality);
    };
    // Accessibility, of one channel, is never above white.
    const auto add_photo = [&](nlohmann::ordered_json& json, const std::string& name,
                               const std::string& bright, const Image& shown, const Image& radiance) {
        json[name] = uri(shown, photo_quality);
        if (radiance.channels != 3) return;
        const Image above = bright_picture(radiance, p.target.exposure);
        if (!above.empty()) json[bright] = uri(above, map_quality);
    };

    nlohmann::ordered_json page;
    add_photo(page, "reference", "reference_bright", p.target.shown, p.target.radiance);
    page["rows"] = nlohmann::ordered_json::array();
    const Image &truth = p.target.shown, &mask = p.target.mask;
    for (const Candidate& row : p.rows) {
        nlohmann::ordered_json json;
        add_photo(json, "image", "bright", row.shown, row.radiance);
        json["error"] = uri(error_map(truth, row.shown, mask), map_quality);
        json["signed"] = uri(signed_map(truth, row.shown, mask), map_quality);
        json["flip"] = uri(flip_picture(flip_ldr(truth, row.shown, mask).map, mask), map_quality);
        json["change"] = uri(change_map(truth, p.rows[0].shown, row.shown, mask), map_quality);
        page["rows"].push_back(std::move(json));
    }
    return page;
}

} // namespace luxel
