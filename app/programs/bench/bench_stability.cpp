#include "app/bench/stability/report.h"
#include "app/bench/stability/stability.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    std::filesystem::path out;
    bench::StabilityOptions options{"../shared/data/tracker", 4'000'000};
};

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    const std::vector<bench::StabilityCase> cases = bench::stability_cases();
    std::vector<bench::MeasuredCase> measured;
    for (const bench::StabilityCase& one : cases) {
        progress.show(one.theme + ": " + one.name,
                      static_cast<double>(measured.size()) / static_cast<double>(cases.size()));
        measured.push_back({one.theme, one.name, bench::measure(one, arguments.options)});
    }
    progress.clear();
    fmt::print("{}", bench::stability_table(measured));
    std::fflush(stdout);
    const std::vector<bench::StepError> smoothers = bench::smoother_step_errors();
    const std::vector<bench::StepError> program = bench::program_step_errors();
    TRY_VOID(write_all(arguments.out, {{"stability.csv", bench::stability_csv(measured)},
                                       {"step_error.csv", bench::step_error_csv(smoothers, program)}}));
    Result<void> drawn = draw_all(arguments.out, {"step_error.csv"});
    if (!bench::all_held(measured)) {
        return fail(ErrorKind::Internal, "bench.bound_missed", "a bound was missed; {} says which",
                    (arguments.out / "stability.csv").string());
    }
    return drawn;
}

} // namespace

BenchCommand stability_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "stability",
        "measures numerical stability in stiff and extreme cases, each result against its bound");
    const auto arguments = std::make_shared<Arguments>();
    command.add_option("--out", arguments->out, "folder for the tables and the plot").required();
    command.add_option("--recordings", arguments->options.recordings, "folder of tracker recordings")
        .capture_default_str();
    command.add_option("--triangles", arguments->options.triangles, "triangles of the largest artifact")
        .within(10'000, 8'000'000)
        .capture_default_str();
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
