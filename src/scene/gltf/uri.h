// SPDX-License-Identifier: MIT
// URIs of a glTF file: data: URIs and relative paths, nothing else.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "core/file.h"
#include "scene/gltf/json.h"

namespace luxel::gltf {

// The bytes a URI names, at most `limit`; nullopt when no such file exists beneath the folder.
// Error Fault::bad_input: another scheme, malformed base64, or a path that leaves the folder.
std::optional<std::vector<std::uint8_t>> read_uri(const Folder& folder, const Value& uri,
                                                  std::uint64_t limit);

// The path without "." and "..", which are resolved before anything is opened (RFC 3986, section 5.2.4): a
// folder that ".." leaves again need not exist. nullopt: it leads out of its folder.
std::optional<std::string> without_dots(std::string_view path);

// What to call it in a sentence.
std::string uri_name(const std::string& uri);

// nullopt: malformed.
std::optional<std::vector<std::uint8_t>> decode_base64(std::string_view text);
// Each %XX once; a "%" that two hexadecimal digits do not follow stands for itself.
std::string decode_percent(std::string_view text);

} // namespace luxel::gltf
