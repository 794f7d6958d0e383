#include "app/programs/common/command_line.h"

#include "firmware_host/base/letters_apart.h"
#include "firmware_host/base/printable.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace frustumscreen::programs {

namespace {

/// The option whose name is nearest to a mistyped one; empty if none is near.
std::string nearest_option(const CLI::App& app, std::string_view mistyped) {
    std::vector<const CLI::App*> asked{&app};
    const std::vector<CLI::App*> parsed = app.get_subcommands();
    asked.insert(asked.end(), parsed.begin(), parsed.end());
    std::string nearest;
    std::size_t least = mistyped.size() / 3 + 1;
    for (const CLI::App* each : asked) {
        for (const CLI::Option* option : each->get_options()) {
            for (const std::string& name : option->get_lnames()) {
                const std::size_t apart = letters_apart(mistyped, "--" + name);
                if (apart < least) {
                    least = apart;
                    nearest = "--" + name;
                }
            }
        }
    }
    return nearest;
}

/// The error for a missing command; `word` was given in its place.
std::string no_command(const CLI::App& app, const std::string& word) {
    std::string commands;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        commands += (commands.empty() ? "" : ", ") + command->get_name();
    }
    const bool is_option = word.empty() || word.starts_with('-');
    const std::string what =
        is_option ? "a command is missing" : fmt::format("unknown command '{}'", printable(word, 100));
    return fmt::format("{}; the commands are {}", what, commands);
}

std::string sentence(const CLI::App* app, const CLI::Error& error) {
    std::string what = error.what();
    const std::vector<std::string> left = app->remaining(true);
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !left.empty()) {
        const std::string_view name = std::string_view(left.front()).substr(0, left.front().find('='));
        const std::string nearest = name.starts_with("--") ? nearest_option(*app, name) : "";
        what = fmt::format("'{}' is not expected here{}", printable(left.front(), 100),
                           nearest.empty() ? "" : "; the nearest option is " + nearest);
    } else if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr &&
               app->get_require_subcommand_min() > app->get_subcommands().size()) {
        what = no_command(*app, left.empty() ? "" : left.front());
    }
    return fmt::format("{0}: {1}; {0} --help says more\n", app->get_name(), what);
}

} // namespace

CommandOption CommandOption::required(bool is) const {
    option_->required(is);
    return *this;
}

CommandOption CommandOption::capture_default_str() const {
    option_->capture_default_str();
    return *this;
}

CommandOption CommandOption::check(const ArgumentCheck& check) const {
    option_->check(
        CLI::Validator([wrong = check.wrong](std::string& text) { return wrong(text); }, check.allowed));
    return *this;
}

template <typename Number> CommandOption CommandOption::within(Number least, Number most) const {
    option_->check(CLI::Range(least, most));
    return *this;
}

CommandOption CommandOption::one_of(std::vector<std::string> words) const {
    option_->check(CLI::IsMember(std::move(words)));
    return *this;
}

CommandOption CommandOption::one_of_numbers(std::vector<int> numbers) const {
    option_->check(CLI::IsMember(std::move(numbers)));
    return *this;
}

CommandOption CommandOption::needs(CommandOption other) const {
    option_->needs(other.option_);
    return *this;
}

CommandOption CommandOption::needs(const std::string& other) const {
    option_->needs(other);
    return *this;
}

CommandOption CommandOption::excludes(CommandOption other) const {
    option_->excludes(other.option_);
    return *this;
}

CommandOption CommandOption::excludes(const std::string& other) const {
    option_->excludes(other);
    return *this;
}

CommandOption CommandOption::expected(int count) const {
    option_->expected(count);
    return *this;
}

CommandOption CommandOption::expected(int least, int most) const {
    option_->expected(least, most);
    return *this;
}

CommandOption CommandOption::delimiter(char between) const {
    option_->delimiter(between);
    return *this;
}

CommandOption CommandOption::allow_extra_args(bool are) const {
    option_->allow_extra_args(are);
    return *this;
}

CommandOption CommandOption::type_name(const std::string& name) const {
    option_->type_name(name);
    return *this;
}

CommandOption CommandOption::hidden() const {
    option_->group("");
    return *this;
}

std::size_t CommandOption::count() const {
    return option_->count();
}

std::string CommandOption::get_name() const {
    return option_->get_name();
}

CommandLine::CommandLine(const std::string& description, const std::string& name)
    : app_(std::make_shared<CLI::App>(description, name)) {}

template <typename Value>
CommandOption CommandLine::add_option(const std::string& name, Value& value, const std::string& description) {
    return CommandOption(app_->add_option(name, value, description));
}

CommandOption CommandLine::add_flag(const std::string& name, bool& value, const std::string& description) {
    return CommandOption(app_->add_flag(name, value, description));
}

CommandOption CommandLine::get_option(const std::string& name) const {
    return CommandOption(app_->get_option(name));
}

CommandLine CommandLine::add_subcommand(const std::string& name, const std::string& description) {
    return CommandLine({app_, app_->add_subcommand(name, description)});
}

void CommandLine::require_subcommand() {
    app_->require_subcommand(1);
}

bool CommandLine::got_subcommand(const std::string& name) const {
    return app_->got_subcommand(name);
}

bool CommandLine::parsed() const {
    return app_->parsed();
}

void CommandLine::callback(std::function<void()> chosen) {
    app_->callback(std::move(chosen));
}

void CommandLine::set_version_flag(const std::string& name, const std::string& version) {
    app_->set_version_flag(name, version);
}

void CommandLine::footer(const std::string& text) {
    app_->footer(text);
}

std::optional<int> CommandLine::end_of_arguments(int argc, const char* const* argv,
                                                 const std::function<void()>& check) {
    app_->failure_message(sentence);
    try {
        app_->parse(argc, argv);
        check();
    } catch (const CLI::ParseError& error) {
        return app_->exit(error) == 0 ? 0 : 2;
    } catch (const WrongUse& wrong) {
        fmt::print(stderr, "{0}: {1}; {0} --help says more\n", app_->get_name(), wrong.what);
        return 2;
    }
    return std::nullopt;
}

WrongUse missing(const std::string& what) {
    return {what + " is required"};
}

bool names_option(int argc, const char* const* argv, std::string_view name) {
    return std::any_of(argv, argv + argc, [&](std::string_view argument) {
        return argument.substr(0, argument.find('=')) == name;
    });
}

template CommandOption CommandOption::within(int, int) const;
template CommandOption CommandOption::within(double, double) const;
template CommandOption CommandOption::within(std::uint64_t, std::uint64_t) const;

#define FRUSTUMSCREEN_OPTION_VALUE(...)                                                                      \
    template CommandOption CommandLine::add_option(const std::string&, __VA_ARGS__&, const std::string&)
FRUSTUMSCREEN_OPTION_VALUE(int);
FRUSTUMSCREEN_OPTION_VALUE(double);
FRUSTUMSCREEN_OPTION_VALUE(std::int64_t);
FRUSTUMSCREEN_OPTION_VALUE(std::uint64_t);
FRUSTUMSCREEN_OPTION_VALUE(std::string);
FRUSTUMSCREEN_OPTION_VALUE(std::filesystem::path);
FRUSTUMSCREEN_OPTION_VALUE(std::optional<int>);
FRUSTUMSCREEN_OPTION_VALUE(std::optional<double>);
FRUSTUMSCREEN_OPTION_VALUE(std::optional<std::uint64_t>);
FRUSTUMSCREEN_OPTION_VALUE(std::optional<std::string>);
FRUSTUMSCREEN_OPTION_VALUE(std::vector<int>);
FRUSTUMSCREEN_OPTION_VALUE(std::vector<std::int64_t>);
FRUSTUMSCREEN_OPTION_VALUE(std::vector<double>);
FRUSTUMSCREEN_OPTION_VALUE(std::vector<std::string>);
FRUSTUMSCREEN_OPTION_VALUE(std::vector<std::filesystem::path>);

} // namespace frustumscreen::programs
