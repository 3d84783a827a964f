// SPDX-License-Identifier: MIT
// What the command line says of itself: help with the options of every subcommand, and what an unknown name
// means.
#pragma once
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

namespace luxel::app {

// Ends the help of a subcommand with the options that it shares with all others.
std::shared_ptr<CLI::FormatterBase> make_formatter();

// CLI11 itself would say that a subcommand is missing. Error Fault::usage.
void require_known_subcommand(const CLI::App& app, int argc, char** argv);

// One sentence for what CLI11 refused; an unknown option goes before whatever else is wrong.
std::string sentence_of(const CLI::App& app, const CLI::ParseError& error);

} // namespace luxel::app
