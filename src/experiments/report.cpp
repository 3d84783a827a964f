// SPDX-License-Identifier: MIT
#include "experiments/report.h"

#include <algorithm>
#include <array>
#include <map>

#include "core/error.h"
#include "experiments/json_text.h"
#include "experiments/pictures.h"

namespace luxel {

namespace {

// JSON inside a <script>: no "<" may reach the HTML parser, whatever a scene file calls its cameras.
std::string script_safe(const nlohmann::ordered_json& json) {
    const std::string text = dump(json, -1);
    std::string safe;
    safe.reserve(text.size());
    for (char c : text)
        if (c == '<')
            safe += "\\u003c";
        else
            safe += c;
    return safe;
}

std::string html_safe(const std::string& text) {
    std::string safe;
    for (char c : text)
        if (c == '<')
            safe += "&lt;";
        else if (c == '&')
            safe += "&amp;";
        else
            safe += c;
    return safe;
}

std::string_view part(std::string_view name) {
    const auto files = text_files();
    const auto found =
        std::find_if(files.begin(), files.end(), [&](const TextFile& f) { return f.name == name; });
    LUXEL_ASSERT(found != files.end(), "{} is not embedded", name);
    return found->text;
}

// What depends on what comes first.
constexpr std::array scripts = {"base.js",   "tables.js", "charts.js", "stage.js",
                                "viewer.js", "link.js",   "page.js"};

} // namespace

std::string report_page(const nlohmann::ordered_json& results, const nlohmann::ordered_json& pictures) {
    const nlohmann::ordered_json scales = {{"error", error_scale},
                                           {"signed", signed_scale},
                                           {"flip", flip_scale},
                                           {"change", change_scale},
                                           {"bright", bright_scale}};
    std::string script;
    for (const char* name : scripts) script += part(name);
    const std::map<std::string_view, std::string> fields = {
        {"title", html_safe(results.at("name").get<std::string>())},
        {"style", std::string(part("style.css"))},
        {"results", script_safe(results)},
        {"pictures", script_safe(pictures)},
        {"scales", script_safe(scales)},
        {"script", std::move(script)}};

    // {{name}} in the page is a field; what a field holds is not searched for further ones.
    std::string page;
    std::string_view rest = part("page.html");
    for (std::size_t begin; (begin = rest.find("{{")) != rest.npos;) {
        const std::size_t end = rest.find("}}", begin);
        LUXEL_ASSERT(end != rest.npos, "page.html: {}", rest.substr(begin, 20));
        page += rest.substr(0, begin);
        page += fields.at(rest.substr(begin + 2, end - begin - 2));
        rest.remove_prefix(end + 2);
    }
    return page += rest;
}

} // namespace luxel
