/// The command line of a program: its commands and options, by CLI11.
///
/// Compiling CLI11 takes seconds in every file that includes it, so only command_line.cpp does. An option's
/// value has one of the types at the end of that file. Methods are named as in CLI11.
///
/// Errors   wrong use is one line on standard error: what is wrong, and what to do.
/// Threads  the main thread.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace frustumscreen::programs {

/// Checks the text of an argument; returns a description of the error, empty if it is valid.
struct ArgumentCheck {
    std::function<std::string(const std::string&)> wrong;
    std::string allowed; ///< a few words for --help; may be empty
};

/// An option of a command line, which must outlive it.
class CommandOption {
public:
    explicit CommandOption(CLI::Option* option) : option_(option) {}

    CommandOption required(bool is = true) const;
    CommandOption capture_default_str() const; ///< --help shows the current value
    CommandOption check(const ArgumentCheck& check) const;
    /// `Number` is int, double or std::uint64_t.
    template <typename Number> CommandOption within(Number least, Number most) const;
    CommandOption one_of(std::vector<std::string> words) const;
    CommandOption one_of_numbers(std::vector<int> numbers) const;
    CommandOption needs(CommandOption other) const;
    CommandOption needs(const std::string& other) const;
    CommandOption excludes(CommandOption other) const;
    CommandOption excludes(const std::string& other) const;
    CommandOption expected(int count) const;
    CommandOption expected(int least, int most) const;
    CommandOption delimiter(char between) const;
    CommandOption allow_extra_args(bool are) const; ///< several values after one name
    CommandOption type_name(const std::string& name) const;
    CommandOption hidden() const; ///< not shown by --help

    [[nodiscard]] std::size_t count() const; ///< occurrences on the command line
    [[nodiscard]] std::string get_name() const;

private:
    CLI::Option* option_;
};

/// The command line of a program, or of one of its commands. Copies refer to the same command line.
class CommandLine {
public:
    CommandLine(const std::string& description, const std::string& name);

    /// `name` is "--long", "-s,--long", or a word for a positional argument.
    template <typename Value>
    CommandOption add_option(const std::string& name, Value& value, const std::string& description);
    CommandOption add_flag(const std::string& name, bool& value, const std::string& description = {});
    [[nodiscard]] CommandOption get_option(const std::string& name) const;

    CommandLine add_subcommand(const std::string& name, const std::string& description);
    void require_subcommand();
    [[nodiscard]] bool got_subcommand(const std::string& name) const;
    [[nodiscard]] bool parsed() const; ///< this command was chosen
    /// Called if this command was chosen. It may throw a WrongUse.
    void callback(std::function<void()> chosen);

    void set_version_flag(const std::string& name, const std::string& version);
    void footer(const std::string& text); ///< for --help

    /// Reads the arguments. Returns the exit status if the program must end: 0 after --help and --version, 2
    /// for wrong use. `check` checks all options together, and throws a WrongUse if they are invalid.
    [[nodiscard]] std::optional<int> end_of_arguments(
        int argc, const char* const* argv, const std::function<void()>& check = [] {});

private:
    explicit CommandLine(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {}

    std::shared_ptr<CLI::App> app_;
};

/// Wrong use, in a sentence for the user; `check` and `callback` may throw it.
struct WrongUse {
    std::string what;
};
/// The error for a missing argument or option; `what` names it.
[[nodiscard]] WrongUse missing(const std::string& what);

/// True if `--name` or `--name=...` is present; selects the command if several have options of their own.
[[nodiscard]] bool names_option(int argc, const char* const* argv, std::string_view name);

} // namespace frustumscreen::programs
