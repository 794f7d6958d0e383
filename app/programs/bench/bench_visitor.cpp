#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"
#include "firmware_host/base/file.h"
#include "tests/simulators/visitor/visitor_figures.h"

#include <memory>

namespace frustumscreen {

namespace {

struct Arguments {
    std::filesystem::path out;
    std::size_t visits = 24;
    double minutes = 10.0;
    std::uint64_t seed = 1;
};

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    const std::vector<VisitorCase> cases = visitor_cases();
    const std::vector<VisitorCase> empty = empty_cases();
    const auto all = static_cast<double>(cases.size() + empty.size());
    std::vector<VisitorFigures> figures;
    for (const VisitorCase& one : cases) {
        progress.show(one.name, static_cast<double>(figures.size()) / all);
        figures.push_back(measure(one, arguments.visits, arguments.seed));
    }
    std::vector<WrongPresence> wrong;
    for (const VisitorCase& one : empty) {
        progress.show("nobody there: " + one.name, static_cast<double>(cases.size() + wrong.size()) / all);
        wrong.push_back(measure_empty(one, arguments.minutes, arguments.seed));
    }
    progress.clear();
    fmt::print("{}\n{}", table_of(figures), table_of(wrong));
    return write_all(arguments.out, {{"visitor.csv", csv_of(figures)}, {"nobody.csv", csv_of(wrong)}});
}

} // namespace

BenchCommand visitor_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "visitor",
        "position of the visitor's eye from a camera, in rendered scenes: presence, error, jitter and time");
    const auto arguments = std::make_shared<Arguments>();
    command.add_option("--out", arguments->out, "folder for the tables").required();
    command.add_option("--visits", arguments->visits, "visits of each scene, of seven seconds each")
        .within(1, 100000)
        .capture_default_str();
    command.add_option("--minutes", arguments->minutes, "length of each scene without anybody")
        .within(0.1, 10000.0)
        .capture_default_str();
    command.add_option("--seed", arguments->seed, "seed of people, light and noise").capture_default_str();
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen
