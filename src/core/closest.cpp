// SPDX-License-Identifier: MIT
#include "core/closest.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace luxel {
namespace {

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = char(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

} // namespace

std::size_t edit_distance(std::string_view first, std::string_view second) {
    const std::string a = lower(first), b = lower(second);
    // Rows of the table of distances between beginnings of a and b: the one before last, the last, this one.
    std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before = std::exchange(last, row);
    }
    return last[b.size()];
}

std::string closest(std::string_view typed, const std::vector<std::string>& known) {
    std::string best;
    std::size_t least = 0;
    for (const std::string& name : known) {
        const std::size_t distance = edit_distance(typed, name);
        const std::size_t length = std::max(typed.size(), name.size());
        if (3 * distance > std::max<std::size_t>(length, 3) || distance >= length) continue;
        if (best.empty() || distance < least) best = name, least = distance;
    }
    if (!best.empty() || typed.size() < 2) return best;

    // A beginning that only one name has.
    std::size_t begun = 0;
    for (const std::string& name : known)
        if (lower(name).starts_with(lower(typed))) best = name, ++begun;
    return begun == 1 ? best : std::string();
}

std::string did_you_mean(std::string_view typed, const std::vector<std::string>& known) {
    const std::string meant = closest(typed, known);
    return meant.empty() ? "" : fmt::format("; did you mean {}?", meant);
}

std::string known_are(std::string_view typed, const std::vector<std::string>& known) {
    if (known.empty()) return "there is none";
    return fmt::format("known are {}{}", fmt::join(known, ", "), did_you_mean(typed, known));
}

} // namespace luxel
