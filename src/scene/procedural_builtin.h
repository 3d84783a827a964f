// SPDX-License-Identifier: MIT
// Built-in scenes by name; builtin_scenes() of load.h lists them.
#pragma once
#include <string>

#include "scene/scene.h"

namespace luxel {

// "cornell", "furnace-0.8", "shapes-x16", ... Error Fault::bad_input lists the known names.
Scene builtin_scene(const std::string& name);

} // namespace luxel
