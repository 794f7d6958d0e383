/// The command line of a program.
///
/// Errors   wrong use is one line on standard error: what is wrong, and what to do.
/// Threads  the main one.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <optional>
#include <string_view>

namespace frustumscreen {

/// Reads it into the options of `app`. The exit status where the program ends there: 0 after --help and --version, 2 for wrong use.
/// `check` looks at all options together, and throws a CLI::ParseError at what does not go.
[[nodiscard]] std::optional<int> end_of_arguments(
    CLI::App& app, int argc, const char* const* argv, const std::function<void()>& check = [] {});

/// Whether `--name` or `--name=...` stands there: which command it is, where several have options of their own.
[[nodiscard]] bool names_option(int argc, const char* const* argv, std::string_view name);

} // namespace frustumscreen
