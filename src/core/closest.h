// SPDX-License-Identifier: MIT
// What a mistyped name most likely means.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace luxel {

// Letters to insert, delete, replace or swap with their neighbor; upper and lower case are the same.
std::size_t edit_distance(std::string_view a, std::string_view b);

// The known name nearest to the typed one, or the one that alone begins with it; "" where none is near enough
// to be meant: at most a third of its letters differ, and at least one is right.
std::string closest(std::string_view typed, const std::vector<std::string>& known);

// "known are a, b, c; did you mean b?", for the end of a sentence on an unknown name.
std::string known_are(std::string_view typed, const std::vector<std::string>& known);
// The last part of it alone: "; did you mean b?", or "".
std::string did_you_mean(std::string_view typed, const std::vector<std::string>& known);

} // namespace luxel
