#include "app/bench/plots/draw_tables.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"

#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    std::vector<std::filesystem::path> from;
    std::filesystem::path out;
};

Result<void> run(const Arguments& arguments) {
    TRY_VOID(write_all(arguments.out, {}));
    std::vector<std::string> words = {"--overall", (arguments.out / "error_time_overall.svg").string()};
    for (const std::filesystem::path& folder : arguments.from) {
        words.push_back(folder.string());
    }
    return bench::draw_tables(bench::plot_script(), words);
}

} // namespace

BenchCommand plot_command(CommandLine& app) {
    CommandLine command =
        app.add_subcommand("plot", "draws the results of error-time for several artifacts on one sheet");
    const auto arguments = std::make_shared<Arguments>();
    command.add_option("--from", arguments->from, "folders that error-time wrote").required();
    command.add_option("--out", arguments->out, "folder for the plot").required();
    return {command, [arguments](BenchProgress&) { return run(*arguments); }};
}

} // namespace frustumscreen::programs
