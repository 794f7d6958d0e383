#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"
#include "firmware_host/base/file.h"
#include "tests/simulators/visitor/visitor_figures.h"

#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    std::filesystem::path out;
    std::size_t visits = 24;
    double minutes = 10.0;
    std::uint64_t seed = 1;
};

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    const std::vector<simulators::VisitorCase> cases = simulators::visitor_cases();
    const std::vector<simulators::VisitorCase> empty = simulators::empty_cases();
    const auto all = static_cast<double>(cases.size() + empty.size());
    std::vector<simulators::VisitorFigures> figures;
    for (const simulators::VisitorCase& one : cases) {
        progress.show(one.name, static_cast<double>(figures.size()) / all);
        figures.push_back(simulators::measure(one, arguments.visits, arguments.seed));
    }
    std::vector<simulators::WrongPresence> wrong;
    for (const simulators::VisitorCase& one : empty) {
        progress.show("no visitor: " + one.name, static_cast<double>(cases.size() + wrong.size()) / all);
        wrong.push_back(simulators::measure_empty(one, arguments.minutes, arguments.seed));
    }
    progress.clear();
    fmt::print("{}\n{}", simulators::table_of(figures), simulators::table_of(wrong));
    return write_all(arguments.out, {{"visitor.csv", simulators::csv_of(figures)},
                                     {"nobody.csv", simulators::csv_of(wrong)}});
}

} // namespace

BenchCommand visitor_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "visitor",
        "measures the visitor's eye from a camera, in rendered scenes: presence, error, jitter and time");
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

} // namespace frustumscreen::programs
