// SPDX-License-Identifier: MIT
#include "experiments/report.h"

#include <fmt/format.h>

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

} // namespace

std::string report_page(const nlohmann::ordered_json& results, const nlohmann::ordered_json& pictures) {
    const nlohmann::ordered_json scales = {{"error", error_scale}, {"change", change_scale}};
    std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
    page += "<title>luxel: " + html_safe(results.at("name").get<std::string>()) + "</title>\n<style>\n";
    page += report_style();
    page += "</style>\n</head>\n<body>\n<main id=\"page\"><noscript>This report draws its tables and "
            "pictures with "
            "JavaScript; the same figures are in results.json beside it.</noscript></main>\n<script>\n";
    page += "\"use strict\";\nconst results = " + script_safe(results) + ";\n";
    page += "const pictures = " + script_safe(pictures) + ";\n";
    page += "const scales = " + script_safe(scales) + ";\n";
    page += report_script();
    page += report_charts();
    page += report_viewer();
    page += "</script>\n</body>\n</html>\n";
    return page;
}

} // namespace luxel
