// SPDX-License-Identifier: MIT
#include "techniques/technique.h"

#include <algorithm>

#include "core/closest.h"
#include "core/error.h"

namespace luxel {

#define LUXEL_TECHNIQUE(name, summary) std::unique_ptr<Technique> make_##name();
#include "techniques/techniques.def"
#undef LUXEL_TECHNIQUE

std::string_view slot_name(Slot slot) {
    static constexpr std::string_view names[] = {"surface",  "shadow",   "occlusion", "diffuse",
                                                 "caustics", "specular", "media",     "post"};
    return names[std::size_t(slot)];
}

const std::vector<TechniqueInfo>& all_techniques() {
    static const std::vector<TechniqueInfo> table = {
#define LUXEL_TECHNIQUE(name, summary) TechniqueInfo{#name, summary, make_##name()->slot(), make_##name},
#include "techniques/techniques.def"
#undef LUXEL_TECHNIQUE
    };
    return table;
}

std::optional<std::string> why_idle(const Technique& technique, const Scene& scene,
                                    const FrameOptions& frame) {
    for (const Need& need : technique.needs(scene, frame))
        if (!need.met) return fmt::format("it needs {}", need.what);
    return std::nullopt;
}

std::unique_ptr<Technique> make_technique(const Specification& specification) {
    const std::vector<TechniqueInfo>& known = all_techniques();
    auto found =
        std::find_if(known.begin(), known.end(), [&](const auto& t) { return t.name == specification.name; });
    if (found == known.end()) {
        std::vector<std::string> names;
        for (const TechniqueInfo& t : known) names.push_back(t.name);
        fail(Fault::usage, "{}: no such technique; {}", specification.name,
             known_are(specification.name, names));
    }
    std::unique_ptr<Technique> technique = found->make();
    set_parameters(*technique, specification.name, specification.values);
    return technique;
}

} // namespace luxel
