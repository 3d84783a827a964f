// SPDX-License-Identifier: MIT
// Chooses the reader for a scene source and completes what the scene lacks.
#include "scene/load.h"

#include "core/error.h"
#include "scene/procedural_builtin.h"

namespace luxel {

Scene load_scene(const std::string& source, const LoadOptions&) {
    const std::string prefix = "builtin:";
    if (source.starts_with(prefix)) return builtin_scene(source.substr(prefix.size()));
    fail(Fault::bad_input, "{}: unknown kind of scene; supported is builtin:NAME", source);
}

} // namespace luxel
