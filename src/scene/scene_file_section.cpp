// SPDX-License-Identifier: MIT
// Typed access to TOML values with a line number in every complaint.
#include "scene/scene_file_section.h"

#include <algorithm>
#include <cmath>

#include "core/closest.h"
#include "core/file.h"
#include "scene/printable.h"

namespace luxel {
namespace {

constexpr std::uint64_t max_file_bytes = 256 << 10;

// Each dot of a key nests a table, and the parser bounds only brackets: long chains would end on the stack.
constexpr int max_dots_per_line = 64;

// A number, a text or a flag as typed after "key=" on the command line.
std::optional<std::string> plain_text(const toml::node& node) {
    if (const auto* flag = node.as_boolean()) return flag->get() ? "on" : "off";
    if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
    if (const auto* real = node.as_floating_point()) return fmt::format("{}", real->get());
    if (const auto* text = node.as_string()) return text->get();
    return std::nullopt;
}

} // namespace

toml::table parse_toml(const std::filesystem::path& path) {
    const std::vector<std::uint8_t> bytes = read_file(path, max_file_bytes);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    int line = 1, dots = 0;
    for (const char c : text) {
        if (c == '\n') ++line, dots = 0;
        if (c == '.' && ++dots > max_dots_per_line)
            fail(Fault::bad_input, "{}: line {}: more than {} dots on one line", path.string(), line,
                 max_dots_per_line);
    }
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        fail(Fault::bad_input, "{}: line {}: {}", path.string(), error.source().begin.line,
             printable(error.description()));
    }
}

const toml::node* Section::find(std::string_view key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
    return table_->get(key);
}

void Section::reject(std::string_view key, const std::string& reason) const {
    const toml::node* node = table_->get(key);
    const auto line = node ? node->source().begin.line : table_->source().begin.line;
    const std::string place = title_.empty() ? "" : title_ + ": ";
    fail(Fault::bad_input, "{}: line {}: {}{}", file_, line, place, reason);
}

void Section::missing(std::string_view key) const { reject(key, fmt::format("\"{}\" is missing", key)); }

bool Section::has(std::string_view key) { return find(key) != nullptr; }

bool Section::is_text(std::string_view key) {
    const toml::node* node = find(key);
    return node && node->is_string();
}

std::optional<std::string> Section::text(std::string_view key) {
    const toml::node* node = find(key);
    if (!node) return std::nullopt;
    const auto value = node->value<std::string>();
    if (!value) reject(key, fmt::format("\"{}\" must be a text in quotes", key));
    return value;
}

std::optional<bool> Section::flag(std::string_view key) {
    const toml::node* node = find(key);
    if (!node) return std::nullopt;
    const auto* value = node->as_boolean();
    if (!value) reject(key, fmt::format("\"{}\" must be true or false", key));
    return value->get();
}

double Section::checked(std::string_view key, const toml::node& node, double least, double most) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value) reject(key, fmt::format("\"{}\" must be made of numbers", key));
    if (!(*value >= least && *value <= most))
        reject(key, fmt::format("\"{}\" is {}, not within [{}, {}]", key, *value, least, most));
    return *value;
}

std::optional<float> Section::number(std::string_view key, double least, double most) {
    const toml::node* node = find(key);
    if (!node) return std::nullopt;
    return float(checked(key, *node, least, most));
}

std::optional<int> Section::integer(std::string_view key, int least, int most) {
    const toml::node* node = find(key);
    if (!node) return std::nullopt;
    const auto value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
    if (!value) reject(key, fmt::format("\"{}\" must be a whole number", key));
    if (*value < least || *value > most)
        reject(key, fmt::format("\"{}\" is {}, not within [{}, {}]", key, *value, least, most));
    return int(*value);
}

std::vector<std::string> Section::texts(std::string_view key) {
    const toml::node* node = find(key);
    if (!node) return {};
    if (const auto one = node->value<std::string>()) return {*one};
    std::vector<std::string> texts;
    if (!node->is_array()) reject(key, fmt::format("\"{}\" must be a list of texts in quotes", key));
    for (const toml::node& element : *node->as_array()) {
        const auto text = element.value<std::string>();
        if (!text) reject(key, fmt::format("\"{}\" must be a list of texts in quotes", key));
        texts.push_back(*text);
    }
    return texts;
}

std::vector<std::pair<std::string, std::vector<std::string>>> Section::values(std::string_view key) {
    const toml::node* node = find(key);
    if (!node) return {};
    const toml::table* table = node->as_table();
    if (!table) reject(key, fmt::format("\"{}\" must be a table of values", key));

    // The parser sorts keys by name; their places bring the file's order back.
    std::vector<std::pair<toml::source_position, std::string>> keys;
    for (const auto& [name, value] : *table) keys.emplace_back(name.source().begin, std::string(name.str()));
    std::sort(keys.begin(), keys.end(), [](const auto& a, const auto& b) { return a.first < b.first; });

    std::vector<std::pair<std::string, std::vector<std::string>>> values;
    for (const auto& [place, name] : keys) {
        std::vector<std::string> texts;
        const auto add = [&](const toml::node& value) {
            const auto text = plain_text(value);
            if (!text)
                reject(key, fmt::format("\"{}\" must be plain values or lists of them", printable(name)));
            texts.push_back(*text);
        };
        const toml::node& value = *table->get(name);
        if (const toml::array* list = value.as_array())
            for (const toml::node& element : *list) add(element);
        else
            add(value);
        if (texts.empty()) reject(key, fmt::format("\"{}\" is an empty list", printable(name)));
        values.emplace_back(name, std::move(texts));
    }
    return values;
}

std::optional<glm::vec3> Section::triple(std::string_view key, double least, double most, bool allow_one) {
    const toml::node* node = find(key);
    if (!node) return std::nullopt;
    if (allow_one && node->is_number()) return glm::vec3(float(checked(key, *node, least, most)));
    const toml::array* array = node->as_array();
    if (!array || array->size() != 3)
        reject(key, fmt::format("\"{}\" must be {}[x, y, z]", key, allow_one ? "a number or " : ""));
    glm::vec3 value;
    for (int i = 0; i < 3; ++i) value[i] = float(checked(key, (*array)[std::size_t(i)], least, most));
    return value;
}

std::optional<glm::dvec3> Section::place(std::string_view key) {
    const auto rounded = triple(key, -far_away, far_away);
    if (!rounded) return std::nullopt;
    glm::dvec3 value;
    const toml::array& array = *find(key)->as_array();
    for (int i = 0; i < 3; ++i) value[i] = checked(key, array[std::size_t(i)], -far_away, far_away);
    return value;
}

std::optional<glm::vec3> Section::direction(std::string_view key) {
    const auto value = triple(key, -1e6, 1e6);
    if (!value) return std::nullopt;
    if (glm::length(*value) < 1e-6f) reject(key, fmt::format("\"{}\" has no length", key));
    return glm::normalize(*value);
}

std::optional<glm::vec3> Section::aim(std::string_view direction_key,
                                      const std::optional<glm::dvec3>& position) {
    const auto given = direction(direction_key);
    const auto target = place("target");
    if (!target) return given;
    if (given) reject("target", fmt::format("give \"{}\" or \"target\", not both", direction_key));
    if (!position) reject("target", "\"target\" needs \"position\"");
    const glm::dvec3 way = *target - *position;
    if (glm::length(way) < 1e-9) reject("target", "\"target\" is where \"position\" is");
    return glm::vec3(glm::normalize(way));
}

std::optional<Section> Section::section(std::string_view key) {
    const toml::node* node = find(key);
    if (!node) return std::nullopt;
    if (!node->is_table()) reject(key, fmt::format("\"{}\" must be a table", key));
    return Section(*node->as_table(), file_, std::string(key));
}

std::vector<Section> Section::sections(std::string_view key) {
    const toml::node* node = find(key);
    if (!node) return {};
    const toml::array* array = node->as_array();
    const auto is_table = [](const toml::node& element) { return element.is_table(); };
    if (!array || !std::all_of(array->begin(), array->end(), is_table))
        reject(key, fmt::format("\"{}\" must be written as [[{}]]", key, key));
    std::vector<Section> sections;
    for (const toml::node& element : *array)
        sections.emplace_back(*element.as_table(), file_, std::string(key));
    return sections;
}

glm::vec3 Section::required_triple(std::string_view key, double least, double most, bool allow_one) {
    const auto value = triple(key, least, most, allow_one);
    if (!value) missing(key);
    return *value;
}

std::string Section::required_text(std::string_view key) {
    const auto value = text(key);
    if (!value) missing(key);
    return *value;
}

void Section::finish() const {
    for (const auto& [key, node] : *table_) {
        if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
        reject(key.str(),
               fmt::format("unknown key \"{}\"; {}", printable(key.str()), known_are(key.str(), known_)));
    }
}

} // namespace luxel
