// SPDX-License-Identifier: MIT
#include "help.h"

#include <algorithm>
#include <vector>

#include "core/closest.h"
#include "core/error.h"

namespace luxel::app {

namespace {

constexpr const char* shared_options = "Options of every subcommand";

class Formatter : public CLI::Formatter {
public:
    // What comes after an app's own options: subcommands, or, where there are none, the parent's options.
    std::string make_subcommands(const CLI::App* app, CLI::AppFormatMode mode) const override {
        const std::string text = CLI::Formatter::make_subcommands(app, mode);
        const CLI::App* parent = app->get_parent();
        if (!parent || mode == CLI::AppFormatMode::Sub) return text;
        const auto shared = [&](const CLI::Option* option) {
            return option->nonpositional() && option != parent->get_help_ptr() &&
                   option->get_name() != "--version";
        };
        return text + make_group(shared_options, false, parent->get_options(shared));
    }
};

// CLI11's messages end in a hint of their own and may span lines.
std::string one_line(std::string text) {
    for (char& c : text)
        if (c == '\n') c = ' ';
    return text.substr(0, text.find_last_not_of(' ') + 1);
}

void add_long_names(const CLI::App& app, std::vector<std::string>& names) {
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
}

// Values of an unknown option are left over as well: the option comes first.
std::string unknown_option(const CLI::App& app) {
    for (const std::string& argument : app.remaining(true)) {
        if (argument.size() < 2 || argument[0] != '-') continue;
        std::vector<std::string> names;
        for (const CLI::App* command : app.get_subcommands()) add_long_names(*command, names);
        add_long_names(app, names);
        const std::string option = argument.substr(0, argument.find('='));
        return "no option " + option + did_you_mean(option, names);
    }
    return {};
}

} // namespace

std::shared_ptr<CLI::FormatterBase> make_formatter() {
    auto formatter = std::make_shared<Formatter>();
    formatter->column_width(34);
    return formatter;
}

void require_known_subcommand(const CLI::App& app, int argc, char** argv) {
    // Options of every subcommand may stand before it, some with a value: the first word that is neither.
    int first = 1;
    while (first < argc && argv[first][0] == '-') {
        const std::string word = argv[first++];
        const CLI::Option* option = app.get_option_no_throw(word.substr(0, word.find('=')));
        if (option && option->get_items_expected_max() > 0 && word.find('=') == word.npos) ++first;
    }
    if (first >= argc) return;
    std::vector<std::string> known;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        known.push_back(command->get_name());
    if (std::find(known.begin(), known.end(), argv[first]) != known.end()) return;
    fail(Fault::usage, "command line: no subcommand '{}'; {}", argv[first], known_are(argv[first], known));
}

std::string sentence_of(const CLI::App& app, const CLI::ParseError& error) {
    const std::string unknown = unknown_option(app);
    return "command line: " + (unknown.empty() ? one_line(error.what()) : unknown) +
           (unknown.ends_with("?") ? "" : " (--help lists what there is)");
}

} // namespace luxel::app
