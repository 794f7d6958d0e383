#include "app/programs/bench/bench_plot.h"

#include "app/bench/saved_results.h"
#include "firmware_host/base/file.h"

#include <memory>

namespace frustumscreen {

namespace {

struct Arguments {
    std::vector<std::filesystem::path> from;
    std::filesystem::path out;
};

Result<void> run(const Arguments& arguments) {
    std::vector<ArtifactResults> artifacts;
    for (const std::filesystem::path& folder : arguments.from) {
        const std::filesystem::path file = folder / "error_time.json";
        const Result<Bytes> bytes = read_file(file);
        if (!bytes) {
            return tl::unexpected<Error>(bytes.error());
        }
        Result<ArtifactResults> results = read_results(as_text(*bytes));
        if (!results) {
            return at(file.string(), results.error());
        }
        artifacts.push_back(std::move(*results));
    }
    return write_all(arguments.out, {{"error_time_overall.svg", overall_svg(artifacts)}});
}

} // namespace

BenchCommand plot_command(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("plot", "results of error-time on several artifacts, as fronts on one sheet");
    const auto arguments = std::make_shared<Arguments>();
    command->add_option("--from", arguments->from, "folders that error-time wrote")->required();
    command->add_option("--out", arguments->out, "folder for the plot")->required();
    return {command, [arguments](BenchProgress&) { return run(*arguments); }};
}

} // namespace frustumscreen
