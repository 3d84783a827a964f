// SPDX-License-Identifier: MIT
#include "experiments/technique_rows.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "core/error.h"
#include "experiments/components.h"
#include "experiments/picture_row.h"

namespace luxel {

namespace {

// "+" joins only where a name begins: "a:x=1e+5" is one technique.
std::vector<std::string_view> split_techniques(std::string_view text) {
    std::vector<std::string_view> parts;
    std::size_t begin = 0;
    for (std::size_t i = 0; i + 1 < text.size(); ++i)
        if (text[i] == '+' && std::isalpha(static_cast<unsigned char>(text[i + 1]))) {
            parts.push_back(text.substr(begin, i - begin));
            begin = i + 1;
        }
    parts.push_back(text.substr(begin));
    return parts;
}

} // namespace

TechniqueRow baseline_row() {
    TechniqueRow row;
    row.label = row.name = baseline_name;
    return row;
}

TechniqueRow parse_use(std::string_view text) {
    TechniqueRow row;
    row.label = text;
    const std::vector<std::string_view> parts = split_techniques(text);
    for (std::string_view part : parts) {
        const Specification specification = parse_specification(part);
        std::unique_ptr<Technique> technique = make_technique(specification);

        for (const auto& other : row.techniques)
            if (other->slot() == technique->slot() && other->receivers() == technique->receivers())
                fail(Fault::usage, "--use {}: two techniques in the slot '{}' light the same surfaces", text,
                     slot_name(technique->slot()));
        const std::string prefix = parts.size() > 1 ? specification.name + "." : "";
        for (ParameterInfo& p : parameters_of(*technique)) {
            p.name.insert(0, prefix);
            row.parameters.push_back(std::move(p));
        }
        for (std::string& warning : idle_parameters(*technique, specification.name, specification.values))
            row.warnings.push_back(std::move(warning));
        row.name += (row.name.empty() ? "" : "+") + specification.name;
        row.techniques.push_back(std::move(technique));
    }
    return row;
}

std::string with_parameter(std::string_view use, std::string_view key, std::string_view value) {
    const std::vector<std::string_view> parts = split_techniques(use);
    const std::size_t dot = std::min(key.find('.'), key.size());
    const std::string_view technique = dot < key.size() ? key.substr(0, dot) : "";
    const std::string_view parameter = dot < key.size() ? key.substr(dot + 1) : key;
    if (technique.empty() && parts.size() > 1)
        fail(Fault::usage, "--use {}: it joins several; say technique.{}", use, key);

    std::string joined;
    bool found = false;
    for (std::string_view part : parts) {
        joined += joined.empty() ? "" : "+";
        joined += part;
        if (!technique.empty() && part.substr(0, part.find(':')) != technique) continue;
        found = true;
        joined += fmt::format("{}{}={}", part.find(':') == part.npos ? ":" : ",", parameter, value);
    }
    if (!found) fail(Fault::usage, "--use {}: there is no {} in it", use, technique);
    return joined;
}

std::vector<TechniqueRow> parse_uses(const std::vector<std::string>& texts) {
    std::vector<TechniqueRow> rows;
    rows.push_back(baseline_row());
    const auto known = [&](std::string_view text) {
        return std::any_of(rows.begin(), rows.end(),
                           [&](const TechniqueRow& row) { return row.label == text; });
    };
    for (const std::string& text : texts) {
        if (text == baseline_name) continue; // always there
        if (text == all_uses) {
            for (const TechniqueInfo& info : all_techniques()) {
                if (known(info.name)) continue;
                rows.push_back(parse_use(info.name));
                rows.back().of_all = true;
            }
            continue;
        }
        TechniqueRow next = is_picture_use(text) ? parse_picture_use(text) : parse_use(text);
        if (known(next.label)) fail(Fault::usage, "--use {}: this row is there already", next.label);
        rows.push_back(std::move(next));
    }
    return rows;
}

void mark_idle(std::vector<TechniqueRow>& rows, const Scene& scene, const FrameOptions& frame) {
    for (TechniqueRow& row : rows) {
        std::optional<std::string> why;
        for (const auto& technique : row.techniques) {
            const std::optional<std::string> one = why_idle(*technique, scene, frame);
            if (!one) why.reset();
            if (!one) break;
            if (!why) why = one;
        }
        row.idle = why.value_or("");
    }
}

std::vector<std::string> idle_parts(const TechniqueRow& row, const Scene& scene, const FrameOptions& frame) {
    std::vector<std::string> sentences;
    if (!row.idle.empty()) return sentences;
    for (const auto& technique : row.techniques)
        if (const auto why = why_idle(*technique, scene, frame))
            sentences.push_back(fmt::format("--use {}: the technique of the slot '{}' cannot act here: {}",
                                            row.label, slot_name(technique->slot()), *why));
    return sentences;
}

std::vector<std::string> own_components(const TechniqueRow& row) {
    std::set<std::string> components = {"direct"};
    for (const auto& technique : row.techniques)
        for (std::string& component : technique->components())
            if (component != "ao")
                components.insert(std::move(component)); // it weighs a part of direct light
    std::vector<std::string> own = without_parts(components);
    std::stable_partition(own.begin(), own.end(), [](const std::string& name) { return name == "direct"; });
    return own;
}

} // namespace luxel
