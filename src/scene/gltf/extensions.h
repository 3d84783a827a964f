// SPDX-License-Identifier: MIT
// Which glTF versions and extensions are accepted.
#pragma once
#include "scene/gltf/document.h"

namespace luxel::gltf {

// Errors: Fault::bad_input (not glTF 2), Fault::unsupported (an extension that the file requires).
void check_version_and_extensions(Document& document);

// What may carry extensions that change what is drawn. Each that is not read is a warning, counted.
enum class Bearer { node, mesh, primitive };
void warn_of_extensions(Document& document, const Value& value, Bearer bearer);

} // namespace luxel::gltf
