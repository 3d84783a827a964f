// SPDX-License-Identifier: MIT
#include "scene/export/gltf/buffer.h"

namespace luxel::gltf_export {

std::size_t Buffer::add_view(std::span<const std::byte> data, ViewOf what) {
    Json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", data.size()}};
    if (what != ViewOf::picture) view["target"] = int(what);
    bytes.append(reinterpret_cast<const char*>(data.data()), data.size());
    bytes.resize((bytes.size() + 3) / 4 * 4); // accessors begin at multiples of their components' size
    views.push_back(std::move(view));
    return views.size() - 1;
}

std::size_t Buffer::add(const std::vector<std::uint32_t>& indices) {
    accessors.push_back({{"bufferView", add_view(std::as_bytes(std::span(indices)), ViewOf::indices)},
                         {"componentType", 5125},
                         {"count", indices.size()},
                         {"type", "SCALAR"}});
    return accessors.size() - 1;
}

} // namespace luxel::gltf_export
