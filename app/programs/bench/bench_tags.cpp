#include "app/bench/tags/tag_figures.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"
#include "firmware_host/base/file.h"

#include <memory>

namespace frustumscreen {

namespace {

struct Arguments {
    std::filesystem::path out;
    std::size_t pictures = 40;
    std::uint64_t seed = 1;
    bool half = false;
};

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    std::vector<TagCase> cases = tag_cases();
    for (TagCase& one : cases) {
        one.decimate = arguments.half ? 2.0 : 1.0;
    }
    std::vector<TagFigures> figures;
    for (const TagCase& one : cases) {
        progress.show(one.name, static_cast<double>(figures.size()) / static_cast<double>(cases.size()));
        figures.push_back(measure(one, arguments.pictures, arguments.seed));
    }
    progress.clear();
    fmt::print("{}", table_of(figures));
    return write_all(arguments.out, {{"tags.csv", csv_of(figures)}});
}

} // namespace

BenchCommand tags_command(CommandLine& app) {
    CommandLine command =
        app.add_subcommand("tags", "the prop's pose by its tags, in rendered scenes: error, spread and time");
    const auto arguments = std::make_shared<Arguments>();
    command.add_option("--out", arguments->out, "folder for the table").required();
    command.add_option("--pictures", arguments->pictures, "of each scene")
        .within(1, 100000)
        .capture_default_str();
    command.add_flag("--half", arguments->half,
                     "search at half size, as the exhibit does where a frame costs much");
    command.add_option("--seed", arguments->seed, "of poses and noise").capture_default_str();
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen
