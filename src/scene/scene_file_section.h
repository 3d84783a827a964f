// SPDX-License-Identifier: MIT
// One table of a TOML file, read key by key: whatever was not asked for in the end is an error.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/glm.hpp>
#include <toml++/toml.h>

#include "core/error.h"

namespace luxel {

inline constexpr double far_away = 1e9; // meters; no coordinate is larger

// A file of at most 256 KiB. Errors: Fault::bad_input (with the line), Fault::io.
toml::table parse_toml(const std::filesystem::path& path);

class Section {
public:
    // `file` and `title` ("light", "" for the top) are used in sentences; `table` must outlive the section.
    Section(const toml::table& table, std::string file, std::string title)
        : table_(&table), file_(std::move(file)), title_(std::move(title)) {}

    bool has(std::string_view key);
    bool is_text(std::string_view key);
    // Each reader returns nullopt where the key is absent, and fails where its value is of the wrong kind.
    std::optional<std::string> text(std::string_view key);
    std::optional<bool> flag(std::string_view key);
    std::optional<float> number(std::string_view key, double least, double most);
    std::optional<int> integer(std::string_view key, int least, int most);
    std::vector<std::string> texts(std::string_view key); // empty where absent; one text is a list of one
    // A table of numbers, texts and flags ("on", "off"), each alone or in a list, as texts in the file's
    // order.
    std::vector<std::pair<std::string, std::vector<std::string>>> values(std::string_view key);
    // Three numbers, or one that stands for all three where `allow_one`.
    std::optional<glm::vec3> triple(std::string_view key, double least, double most, bool allow_one = false);
    // A position: in double, as it may be far from the origin.
    std::optional<glm::dvec3> place(std::string_view key);
    std::optional<glm::vec3> direction(std::string_view key); // made unit
    // A direction under `direction_key`, or from `position` to a "target".
    std::optional<glm::vec3> aim(std::string_view direction_key, const std::optional<glm::dvec3>& position);
    std::optional<Section> section(std::string_view key);
    std::vector<Section> sections(std::string_view key); // [[key]]

    glm::vec3 required_triple(std::string_view key, double least, double most, bool allow_one = false);
    std::string required_text(std::string_view key);

    // Fails at the first key that no reader asked for.
    void finish() const;

    // Error Fault::bad_input at the line of `key`, or of the table where it has no such key.
    [[noreturn]] void reject(std::string_view key, const std::string& reason) const;

private:
    const toml::node* find(std::string_view key);
    double checked(std::string_view key, const toml::node& node, double least, double most) const;
    [[noreturn]] void missing(std::string_view key) const;

    const toml::table* table_;
    std::string file_, title_;
    std::vector<std::string> known_;
};

} // namespace luxel
