// SPDX-License-Identifier: MIT
// JSON as text, whatever bytes the names in it have.
#pragma once
#include <string>

#include <nlohmann/json.hpp>

namespace luxel {

// Bytes that are no UTF-8 (names come from scene files) are replaced.
inline std::string dump(const nlohmann::ordered_json& json, int indent = 2) {
    return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

} // namespace luxel
