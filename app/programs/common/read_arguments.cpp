#include "app/programs/common/read_arguments.h"

#include "firmware_host/base/letters_apart.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

namespace {

/// The option whose name is nearest to a mistyped one; empty where none is near.
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

/// Where a command is missing; `word` may stand in its place.
std::string no_command(const CLI::App& app, const std::string& word) {
    std::string commands;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        commands += (commands.empty() ? "" : ", ") + command->get_name();
    }
    const bool is_option = word.empty() || word.starts_with('-');
    const std::string what =
        is_option ? "a command is missing" : fmt::format("'{}' is no command", printable(word, 100));
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

std::optional<int> end_of_arguments(CLI::App& app, int argc, const char* const* argv,
                                    const std::function<void()>& check) {
    app.failure_message(sentence);
    try {
        app.parse(argc, argv);
        check();
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    return std::nullopt;
}

bool names_option(int argc, const char* const* argv, std::string_view name) {
    return std::any_of(argv, argv + argc, [&](std::string_view argument) {
        return argument.substr(0, argument.find('=')) == name;
    });
}

} // namespace frustumscreen
