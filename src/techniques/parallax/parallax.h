// SPDX-License-Identifier: MIT
// Parallax mapping [Umenhoffer2009, section 2.1.1]: texture coordinates corrected by guesses, nothing
// searched.
#pragma once
#include "techniques/common/surface_technique.h"

namespace luxel {

enum class ParallaxMode { plain, offset_limit, slope, iterated };

class Parallax final : public SurfaceTechnique {
public:
    Parallax() : SurfaceTechnique(false) {} // guesses as positions would shadow themselves
    void visit(Visitor& v) override;
    std::optional<shared::HeightSearch> height_search() const override;

private:
    ParallaxMode mode_ = ParallaxMode::iterated;
    int iterations_ = 4;
};

} // namespace luxel
