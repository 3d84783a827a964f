// SPDX-License-Identifier: MIT
// Which glTF versions and extensions are accepted.
#pragma once
#include "scene/gltf/document.h"

namespace luxel::gltf {

// Errors: Fault::bad_input (not glTF 2), Fault::unsupported (an extension that the file requires).
void check_version_and_extensions(Document& document);

} // namespace luxel::gltf
