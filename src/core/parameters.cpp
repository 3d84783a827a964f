// SPDX-License-Identifier: MIT
// Reading and setting declared parameters by name.
#include "core/parameters.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/closest.h"
#include "core/error.h"

namespace luxel {
namespace {

std::string limits(Range range) { return fmt::format("{} to {}", range.least, range.most); }

template <class Number> std::optional<Number> parse_number(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

class Lister : public Visitor {
public:
    std::vector<ParameterInfo> found;

    void real(std::string_view name, float& value, Range range, std::string_view meaning) override {
        add(name, "real", fmt::format("{}", value), limits(range), meaning);
    }
    void integer(std::string_view name, int& value, Range range, std::string_view meaning) override {
        add(name, "integer", fmt::format("{}", value), limits(range), meaning);
    }
    void flag(std::string_view name, bool& value, std::string_view meaning) override {
        add(name, "flag", value ? "on" : "off", "on, off", meaning);
    }
    void text(std::string_view name, std::string& value, std::string_view meaning) override {
        add(name, "text", value, "any text", meaning);
    }
    void choice_index(std::string_view name, int& value, const std::vector<std::string>& options,
                      std::string_view meaning) override {
        LUXEL_ASSERT(value >= 0 && std::size_t(value) < options.size(), "{}: option {} of {}", name, value,
                     options.size());
        add(name, "choice", options[std::size_t(value)], fmt::format("{}", fmt::join(options, ", ")),
            meaning);
    }

private:
    void add(std::string_view name, std::string type, std::string value, std::string allowed,
             std::string_view meaning) {
        found.push_back({std::string(name), std::move(type), std::move(value), std::move(allowed),
                         std::string(meaning), condition().when, condition().acts});
    }
};

class Setter : public Visitor {
public:
    Setter(std::string_view owner, const std::vector<std::pair<std::string, std::string>>& values)
        : owner_(owner), values_(values) {}

    void real(std::string_view name, float& value, Range range, std::string_view) override {
        if (const std::string* text = given(name)) value = number<float>(name, *text, range);
    }
    void integer(std::string_view name, int& value, Range range, std::string_view) override {
        if (const std::string* text = given(name)) value = number<int>(name, *text, range);
    }
    void flag(std::string_view name, bool& value, std::string_view) override {
        const std::string* text = given(name);
        if (!text) return;
        const bool on = *text == "on" || *text == "true" || *text == "yes" || *text == "1";
        const bool off = *text == "off" || *text == "false" || *text == "no" || *text == "0";
        if (!on && !off) refuse(name, *text, "on or off");
        value = on;
    }
    void text(std::string_view name, std::string& value, std::string_view) override {
        if (const std::string* text = given(name)) value = *text;
    }
    void choice_index(std::string_view name, int& value, const std::vector<std::string>& options,
                      std::string_view) override {
        const std::string* text = given(name);
        if (!text) return;
        const auto option = std::find(options.begin(), options.end(), *text);
        if (option == options.end())
            refuse(name, *text,
                   fmt::format("one of {}{}", fmt::join(options, ", "), did_you_mean(*text, options)));
        value = int(option - options.begin());
    }

private:
    const std::string* given(std::string_view name) const {
        const auto found = std::find_if(values_.begin(), values_.end(),
                                        [&](const auto& pair) { return pair.first == name; });
        return found == values_.end() ? nullptr : &found->second;
    }
    // Bounds are inclusive after rounding to the parameter's own type; NaN is outside every range.
    template <class Number> Number number(std::string_view name, const std::string& text, Range range) const {
        using Bound = std::conditional_t<std::is_integral_v<Number>, double, float>;
        const std::optional<Number> value = parse_number<Number>(text);
        const std::string_view kind = std::is_integral_v<Number> ? "an integer" : "a number";
        if (!value || !(Bound(*value) >= Bound(range.least) && Bound(*value) <= Bound(range.most)))
            refuse(name, text, fmt::format("{} from {}", kind, limits(range)));
        return *value;
    }
    [[noreturn]] void refuse(std::string_view name, const std::string& text,
                             const std::string& expected) const {
        fail(Fault::usage, "{}: parameter {} cannot be \"{}\"; it is {}", owner_, name, text, expected);
    }

    std::string_view owner_;
    const std::vector<std::pair<std::string, std::string>>& values_;
};

} // namespace

Specification parse_specification(std::string_view text) {
    const std::size_t colon = text.find(':');
    Specification specification{std::string(text.substr(0, colon)), {}};
    if (specification.name.empty()) fail(Fault::usage, "\"{}\": expected name:key=value,...", text);
    if (colon == std::string_view::npos) return specification;

    std::string_view rest = text.substr(colon + 1);
    for (bool more = true; more;) {
        const std::size_t comma = rest.find(',');
        const std::string_view item = rest.substr(0, comma);
        const std::size_t equals = item.find('=');
        if (equals == std::string_view::npos || equals == 0)
            fail(Fault::usage, "\"{}\": expected key=value, got \"{}\"", text, item);
        std::string key(item.substr(0, equals));
        for (const auto& [name, value] : specification.values)
            if (name == key) fail(Fault::usage, "\"{}\": {} is given twice", text, key);
        specification.values.emplace_back(std::move(key), std::string(item.substr(equals + 1)));
        more = comma != std::string_view::npos;
        if (more) rest.remove_prefix(comma + 1);
    }
    return specification;
}

namespace detail {

std::vector<ParameterInfo> list(void* object, Visit visit) {
    Lister lister;
    visit(object, lister);
    return std::move(lister.found);
}

void set(void* object, Visit visit, std::string_view owner,
         const std::vector<std::pair<std::string, std::string>>& values) {
    std::vector<std::string> known;
    for (ParameterInfo& info : list(object, visit)) known.push_back(std::move(info.name));
    for (const auto& [name, value] : values) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        if (known.empty()) fail(Fault::usage, "{}: no parameter {}; it has none", owner, name);
        fail(Fault::usage, "{}: no parameter {}; {}", owner, name, known_are(name, known));
    }
    Setter setter(owner, values);
    visit(object, setter);
}

std::vector<std::string> idle(void* object, Visit visit, std::string_view owner,
                              const std::vector<std::pair<std::string, std::string>>& values) {
    std::vector<std::string> sentences;
    for (const ParameterInfo& info : list(object, visit))
        for (const auto& [name, value] : values)
            if (name == info.name && !info.acts)
                sentences.push_back(fmt::format("{}: {}={} has no effect, as it is of {} alone", owner, name,
                                                value, info.when));
    return sentences;
}

} // namespace detail
} // namespace luxel
