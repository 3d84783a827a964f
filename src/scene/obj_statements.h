// SPDX-License-Identifier: MIT
// Which statements OBJ and MTL files make, as the parser gives only values; and
// what of them nobody reads.
#pragma once
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace luxel {

// Counts of keywords, for one sentence.
class LeftOut {
public:
    void add(std::string_view keyword, int count = 1);
    // "" when nothing was left out, else "statements that are left out: Ka (3),
    // map_Ns (1)".
    std::string sentence() const;

private:
    std::map<std::string, int> counts_;
};

// By material: the keywords of its statements.
class MtlStatements {
public:
    // Adds those of a library; unknown ones go to left_out.
    void read(std::string_view text, LeftOut& left_out);
    bool has(const std::string& material, std::string_view keyword) const;

private:
    std::map<std::string, std::set<std::string, std::less<>>, std::less<>> given_;
};

// The next word of a line, which it loses; "" at its end.
std::string_view next_word(std::string_view& line);
// The next line of a text, which it loses.
std::string_view next_line(std::string_view& text);

} // namespace luxel
