/// The command line of a program: its commands and options, by CLI11.
///
/// That library costs every file that includes it seconds to compile, so command_line.cpp alone does; an option's value is one
/// of the types that stand at that file's end. The methods are named as the library's.
///
/// Errors   wrong use is one line on standard error: what is wrong, and what to do.
/// Threads  the main one.
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

namespace frustumscreen {

/// Looks at the text of an argument, and says what is wrong with it; nothing if it is well.
struct ArgumentCheck {
    std::function<std::string(const std::string&)> wrong;
    std::string allowed; ///< a few words for --help; may be empty
};

/// An option of a command line, which must live as long.
class CommandOption {
public:
    explicit CommandOption(CLI::Option* option) : option_(option) {}

    CommandOption required(bool is = true) const;
    CommandOption capture_default_str() const; ///< --help shows the value that is there
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
    CommandOption allow_extra_args(bool are) const; ///< several behind one name
    CommandOption type_name(const std::string& name) const;
    CommandOption hidden() const; ///< --help does not show it

    [[nodiscard]] std::size_t count() const; ///< how often it stands on the command line
    [[nodiscard]] std::string get_name() const;

private:
    CLI::Option* option_;
};

/// That of a program or of a command of it. A copy is the same command line.
class CommandLine {
public:
    CommandLine(const std::string& description, const std::string& name);

    /// `name` is "--long", "-s,--long", or a word for one that stands alone.
    template <typename Value>
    CommandOption add_option(const std::string& name, Value& value, const std::string& description);
    CommandOption add_flag(const std::string& name, bool& value, const std::string& description = {});
    [[nodiscard]] CommandOption get_option(const std::string& name) const;

    CommandLine add_subcommand(const std::string& name, const std::string& description);
    void require_subcommand();
    [[nodiscard]] bool got_subcommand(const std::string& name) const;
    [[nodiscard]] bool parsed() const; ///< this command was chosen
    /// Called where this command was chosen. It may throw a WrongUse.
    void callback(std::function<void()> chosen);

    void set_version_flag(const std::string& name, const std::string& version);
    void footer(const std::string& text); ///< of --help

    /// Reads the arguments. The exit status where the program ends there: 0 after --help and --version, 2 for wrong use.
    /// `check` looks at all options together, and throws a WrongUse at what does not go.
    [[nodiscard]] std::optional<int> end_of_arguments(
        int argc, const char* const* argv, const std::function<void()>& check = [] {});

private:
    explicit CommandLine(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {}

    std::shared_ptr<CLI::App> app_;
};

/// What does not go, in a sentence for the person who wrote it; `check` and `callback` may throw it.
struct WrongUse {
    std::string what;
};
/// That `what` is required.
[[nodiscard]] WrongUse missing(const std::string& what);

/// Whether `--name` or `--name=...` stands there: which command it is, where several have options of their own.
[[nodiscard]] bool names_option(int argc, const char* const* argv, std::string_view name);

} // namespace frustumscreen
