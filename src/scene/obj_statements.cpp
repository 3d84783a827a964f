// SPDX-License-Identifier: MIT
#include "scene/obj_statements.h"

#include <algorithm>

#include "core/error.h"
#include "scene/printable.h"

namespace luxel {
namespace {

constexpr std::string_view blanks = " \t\r";
constexpr std::size_t most_kinds = 20; // of statements that one sentence names

// What obj_material.cpp reads.
const std::set<std::string, std::less<>> understood = {
    "newmtl", "Kd",    "Ks",   "Ns",   "Ke",     "d",      "Tr",       "illum",
    "Ni",     "Tf",    "Pr",   "Pm",   "Pc",     "Pcr",    "map_Kd",   "map_Ke",
    "map_Ks", "map_d", "norm", "bump", "map_Pr", "map_Pm", "map_Bump", "map_bump"};

std::string_view trimmed(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    const std::size_t last = text.find_last_not_of(blanks);
    return text.substr(0, last == text.npos ? 0 : last + 1);
}

} // namespace

std::string_view next_word(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(blanks));
    line.remove_prefix(word.size());
    return word;
}

std::string_view next_line(std::string_view& text) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, length);
    text.remove_prefix(std::min(length + 1, text.size()));
    return line;
}

void LeftOut::add(std::string_view keyword, int count) {
    std::string name = printable(std::string(keyword));
    if (counts_.size() >= most_kinds && !counts_.contains(name)) name = "others";
    counts_[name] += count;
}

std::string LeftOut::sentence() const {
    std::string list;
    for (const auto& [keyword, count] : counts_)
        list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", keyword, count);
    return list.empty() ? list : "statements that are left out: " + list;
}

void MtlStatements::read(std::string_view text, LeftOut& left_out) {
    std::set<std::string, std::less<>>* material = nullptr;
    while (!text.empty()) {
        std::string_view line = next_line(text);
        const std::string_view keyword = next_word(line);
        if (keyword.empty() || keyword[0] == '#') continue;
        if (keyword == "newmtl") material = &given_[std::string(trimmed(line))];
        if (!understood.contains(keyword))
            left_out.add(keyword);
        else if (material)
            material->emplace(keyword);
    }
}

bool MtlStatements::has(const std::string& material, std::string_view keyword) const {
    const auto found = given_.find(trimmed(material));
    return found != given_.end() && found->second.contains(keyword);
}

} // namespace luxel
