#include "app/bench/page/fill_page.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"
#include "firmware_host/base/file.h"

#include <algorithm>
#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    std::filesystem::path from;
    std::filesystem::path page = "docs/measurements.md";
    bool check = false;
};

Result<void> run(const Arguments& arguments) {
    TRY(const Bytes bytes, read_file(arguments.page));
    const std::string_view page = as_text(bytes);
    TRY(const bench::FilledPage filled, bench::fill_page(page, arguments.page.string(), arguments.from));
    for (const bench::FilledTable& table : filled.tables) {
        fmt::print("{}\n", bench::line_of(table, arguments.check));
    }
    const auto changed =
        std::count_if(filled.tables.begin(), filled.tables.end(), [](const bench::FilledTable& table) {
            return table.state == bench::TableState::Changed;
        });
    if (changed == 0) {
        return {};
    }
    if (arguments.check) {
        return fail(ErrorKind::Internal, "report.differs",
                    "{}: {} of {} tables differ from the CSV files in {}; without --check they are written",
                    arguments.page.string(), changed, filled.tables.size(), arguments.from.string());
    }
    return write_file(arguments.page, as_bytes(filled.text));
}

} // namespace

BenchCommand report_command(CommandLine& app) {
    CommandLine command =
        app.add_subcommand("report", "writes the tables of docs/measurements.md from measured CSV files");
    const auto arguments = std::make_shared<Arguments>();
    command
        .add_option("--from", arguments->from,
                    "folder that has a folder for each measurement (docs/bench.md lists them)")
        .required();
    command.add_option("--page", arguments->page, "the page whose marked tables are written")
        .capture_default_str();
    command.add_flag("--check", arguments->check,
                     "write nothing; exit status 1 if a table differs from its CSV files");
    return {command, [arguments](BenchProgress&) { return run(*arguments); }};
}

} // namespace frustumscreen::programs
