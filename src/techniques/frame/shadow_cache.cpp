// SPDX-License-Identifier: MIT
#include "techniques/frame/shadow_cache.h"

#include <algorithm>
#include <cstring>

namespace luxel {
namespace {

// Plain floats and integers without padding: equal bytes are equal values.
template <class T> bool same_bytes(const T& a, const T& b) { return std::memcmp(&a, &b, sizeof(T)) == 0; }
static_assert(sizeof(shared::ShadowView) == 25 * sizeof(float));
static_assert(sizeof(shared::HeightSearch) == 7 * sizeof(float));

bool same_views(const std::vector<shared::ShadowView>& a, const std::vector<shared::ShadowView>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_bytes<shared::ShadowView>);
}

bool same_search(const std::optional<shared::HeightSearch>& a, const std::optional<shared::HeightSearch>& b) {
    return a.has_value() == b.has_value() && (!a || same_bytes(*a, *b));
}

} // namespace

ShadowCache::ShadowCache(gpu::Gpu& gpu, ShadowMode mode, float esm_exponent, std::uint64_t budget)
    : gpu_(gpu), mode_(mode), esm_exponent_(esm_exponent), budget_(budget) {}

void ShadowCache::begin_frame() {
    if (frame_is_open_) entries_.clear();
    frame_is_open_ = true;
    ++frame_;
}

std::uint64_t ShadowCache::bytes() const {
    std::uint64_t sum = 0;
    for (const Entry& entry : entries_) sum += entry.maps.bytes();
    return sum;
}

// The place for new maps. Within the budget that is a new entry, after those that nobody uses any more are
// gone. Beyond it the entry that was used last is overwritten: frames ask for the same batches in the same
// order, and of such a cycle replacing the latest keeps the most, where replacing the oldest would keep
// nothing.
ShadowCache::Entry& ShadowCache::entry_for(int size, int layers, bool with_sheets) {
    const std::uint64_t needed = ShadowMaps::bytes_of(size, layers, mode_, with_sheets);
    const auto fits = [&](const Entry& e) {
        return e.maps.size() == size && e.maps.layers() >= layers && e.maps.with_sheets() == with_sheets;
    };
    const auto stale = [&](const Entry& e) { return e.last_frame + 1 < frame_; };
    const auto older = [](const Entry& a, const Entry& b) { return a.last_use < b.last_use; };

    if (bytes() + needed > budget_) {
        Entry* oldest = nullptr;
        for (Entry& e : entries_)
            if (fits(e) && stale(e) && (!oldest || older(e, *oldest))) oldest = &e;
        if (oldest) return *oldest;
        std::erase_if(entries_, stale);
    }
    if (bytes() + needed > budget_) {
        Entry* latest = nullptr;
        for (Entry& e : entries_)
            if (fits(e) && (!latest || older(*latest, e))) latest = &e;
        if (latest) return *latest;
    }
    return entries_.emplace_back(Entry{.maps = ShadowMaps(gpu_, size, layers, mode_, with_sheets)});
}

ShadowImages ShadowCache::maps(gpu::Recorder& recorder, const GpuScene& scene, int size,
                               const std::vector<shared::ShadowView>& views,
                               const std::optional<shared::HeightSearch>& search) {
    const auto kept = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
        return e.maps.size() == size && e.scene == &scene && e.scene_version == scene.version() &&
               same_search(e.search, search) && same_views(e.views, views);
    });
    const bool hit = kept != entries_.end();
    const bool sheets = !hit && std::any_of(views.begin(), views.end(), [&](const shared::ShadowView& v) {
        return sees_sheets(scene, v.world_to_map);
    });
    Entry& entry = hit ? *kept : entry_for(size, int(views.size()), sheets);
    if (!hit) {
        entry.images = entry.maps.draw(recorder, scene, views, esm_exponent_, search);
        entry.scene = &scene, entry.scene_version = scene.version();
        entry.views = views, entry.search = search;
    }
    entry.last_frame = frame_, entry.last_use = ++uses_;
    return entry.images;
}

} // namespace luxel
