// SPDX-License-Identifier: MIT
// Names from files in sentences and on terminals.
#pragma once
#include <string>
#include <string_view>

namespace luxel {

// Control characters replaced (a terminal would obey them), long texts cut.
inline constexpr std::size_t longest_path = 4096;
inline std::string printable(std::string_view text, std::size_t longest = 120) {
    std::string shown(text.substr(0, longest));
    for (char& c : shown)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    if (text.size() > longest) shown += "...";
    return shown;
}

// For comments in files that other programs parse: whatever is no plain ASCII is replaced as well.
inline std::string ascii(std::string_view text, std::size_t longest = 120) {
    std::string shown = printable(text, longest);
    for (char& c : shown)
        if (static_cast<unsigned char>(c) >= 0x80) c = '?';
    return shown;
}

} // namespace luxel
