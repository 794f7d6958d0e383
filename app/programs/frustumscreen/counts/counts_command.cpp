#include "app/programs/frustumscreen/counts/counts_command.h"

#include "app/counts/counts_plot.h"
#include "app/counts/counts_table.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "firmware_host/base/calendar_day.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

namespace frustumscreen::programs {

namespace {

struct Request {
    std::filesystem::path folder = "/var/lib/frustumscreen/counts";
    std::filesystem::path csv, plot;
    std::string from, to;
    bool json = false;
};

std::optional<int> read_arguments(int argc, char** argv, Request& request) {
    CommandLine app("Prints how often, when and for how long the exhibit was used, in numbers for each of at "
                    "most 400 days.",
                    "frustumscreen counts");
    app.add_option("--folder", request.folder, "folder of the counts: exhibit.counts in the settings")
        .capture_default_str();
    app.add_option("--csv", request.csv, "write all numbers to this CSV file: day,kind,name,visits,minutes");
    app.add_option("--plot", request.plot, "write a plot to this SVG file");
    app.add_option("--from", request.from, "first day, such as 2026-11-27 (default: the first recorded)");
    app.add_option("--to", request.to, "last day (default: the last recorded)");
    app.add_flag("--json", request.json, "print all numbers as JSON");
    return app.end_of_arguments(argc, argv);
}

Result<std::optional<std::chrono::sys_days>> day_in(const std::string& text, const char* option) {
    const std::optional<std::chrono::sys_days> day = parse_day(text);
    if (!text.empty() && !day) {
        return bad_input("counts.day", "{} {}: this is not a day; write it as 2026-11-27", option, text);
    }
    return day;
}

Result<counts::ReadCounts> wanted(const Request& request) {
    TRY(const auto from, day_in(request.from, "--from"));
    TRY(const auto to, day_in(request.to, "--to"));
    TRY(counts::ReadCounts counts, counts::read_counts(request.folder));
    std::erase_if(counts.days, [&](const counts::DayCounts& each) {
        return (from && *each.day < *from) || (to && *each.day > *to);
    });
    if (from || to) {
        counts.undated = {};
    }
    return counts;
}

Result<void> show_counts(const Request& request, const counts::ReadCounts& counts) {
    if (!request.csv.empty()) {
        TRY_VOID(write_file(request.csv, as_bytes(counts::counts_csv(counts))));
    }
    if (!request.plot.empty()) {
        TRY_VOID(write_file(request.plot, as_bytes(counts::counts_plot(counts.days))));
    }
    fmt::print("{}", request.json ? counts::counts_json(counts) : counts::counts_text(counts));
    std::fflush(stdout);
    return {};
}

} // namespace

int counts_command(int argc, char** argv) {
    Request request;
    if (const std::optional<int> status = read_arguments(argc, argv, request)) {
        return *status;
    }
    const Result<counts::ReadCounts> counts = wanted(request);
    if (!counts) {
        return exit_status("frustumscreen", tl::unexpected<Error>(counts.error()));
    }
    for (const std::string& trouble : counts->trouble) {
        say_line("frustumscreen", trouble);
    }
    const int status = exit_status("frustumscreen", show_counts(request, *counts));
    return counts->trouble.empty() ? status : 1;
}

} // namespace frustumscreen::programs
