// SPDX-License-Identifier: MIT
// A number that names inputs by what they contain: equal inputs, equal key. For caches and checkpoints; not
// proof against somebody who looks for collisions.
#pragma once
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <vector>

#include "reference/reference.h"

namespace luxel {

class ContentKey {
public:
    void add_bytes(const void* data, std::size_t size);
    void add(std::string_view text) { add(std::uint64_t(text.size())), add_bytes(text.data(), text.size()); }
    template <class T>
    requires std::is_arithmetic_v<T>
    void add(T value) { add_bytes(&value, sizeof value); }
    template <class T> void add(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(std::uint64_t(values.size()));
        add_bytes(values.data(), values.size() * sizeof(T));
    }
    std::uint64_t value() const { return state_; }

private:
    std::uint64_t state_ = 0x9e3779b97f4a7c15u;
};

// Everything of the scene that light depends on; not names, cameras, roles or warnings.
std::uint64_t content_key(const Scene& scene);

// What decides the value of each sample of a view. Not how many there are: spp, seconds and error are left
// out.
std::uint64_t content_key(const Scene& scene, const ReferenceRequest& request);

} // namespace luxel
