#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"
#include "tests/simulators/museum/museum_report.h"

#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    std::filesystem::path out;
    int days = 1000;
    std::uint64_t seed = 1;
    double times = 1.0;
};

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    const std::vector<simulators::FaultEvent> fault_events =
        simulators::seeded_faults(arguments.seed, arguments.days, arguments.times);
    std::vector<simulators::MuseumRun> runs;
    for (const simulators::Policy policy : simulators::all_policies) {
        progress.show(std::string(simulators::name_of(policy)),
                      static_cast<double>(runs.size()) /
                          static_cast<double>(simulators::all_policies.size()));
        runs.push_back(simulators::simulate(policy, fault_events, arguments.days, arguments.seed));
    }
    progress.clear();
    fmt::print("{} faults in {} days\n\n{}", fault_events.size(), arguments.days,
               simulators::museum_table(runs, fault_events));
    const Result<void> written =
        write_all(arguments.out, {{"ladder.csv", simulators::dark_times_csv(runs, arguments.days)},
                                  {"ladder_policies.csv", simulators::museum_csv(runs, arguments.days)},
                                  {"ladder_faults.csv", simulators::faults_csv(runs, fault_events)}});
    return written ? draw_all(arguments.out, {"ladder.csv"}) : written;
}

} // namespace

BenchCommand ladder_command(CommandLine& app) {
    CommandLine command = app.add_subcommand("ladder", "measures dark time with the recovery ladder and with "
                                                       "other policies, over simulated days of a museum");
    const auto arguments = std::make_shared<Arguments>();
    command.add_option("--out", arguments->out, "folder for the tables and the plot").required();
    command.add_option("--days", arguments->days, "number of simulated days")
        .within(1, 10000)
        .capture_default_str();
    command.add_option("--seed", arguments->seed, "seed of the faults").capture_default_str();
    command.add_option("--times", arguments->times, "factor on the usual number of faults")
        .within(0.01, 1000.0)
        .capture_default_str();
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
