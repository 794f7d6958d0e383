#include "app/programs/bake/batch_command.h"

#include "app/programs/bake/bake_options.h"
#include "app/programs/batch/batch_report.h"
#include "app/programs/batch/content_hash.h"
#include "app/programs/batch/run_batch.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/common/progress_line.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/output_file.h"
#include "firmware_host/base/standard_error.h"
#include "firmware_host/base/time.h"
#include "firmware_host/base/version.h"
#include "firmware_host/base/words_of_time.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen::programs {

namespace {

constexpr const char* program = "frustumscreen-bake";
constexpr double bytes_per_mb = 1e6;
/// With less memory, the libraries of a bake fail before they can report it.
constexpr double min_memory_mb = 500.0;
constexpr std::uintmax_t space_for_reports = 1'000'000;
constexpr std::size_t max_sentences = 20; ///< about failures on standard error; the report has all

struct Arguments {
    std::filesystem::path folder;
    std::filesystem::path output;
    std::size_t jobs = 1;
    std::string shard; ///< empty: all
    double time_limit_s = 3600.0;
    double memory_limit_mb = 0.0; ///< 0: none
    bool pages = false;
    bool report_only = false;
    bool json = false;
    BakeArguments bake;
};

/// Makes the folder for the packs and checks that it is writable.
Result<void> check_output_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        return bad_input("batch.no_output_folder",
                         "{}: cannot be made: {}; choose another folder for the packs", folder.string(),
                         error.message());
    }
    return check_output_place(folder / "report.csv", space_for_reports);
}

/// Identifies the build of the program, because another build may bake other packs.
Result<std::string> program_key() {
    Result<std::string> hash = hash_of_file("/proc/self/exe");
    return hash ? Result<std::string>(name_and_version("frustumscreen-bake") + " " + *hash) : hash;
}

Result<BatchPlan> plan_of(const Arguments& arguments, std::vector<BatchObject> objects) {
    TRY(std::string key, program_key());
    BatchPlan plan;
    plan.objects = std::move(objects);
    plan.output = arguments.output;
    plan.program = {"/proc/self/exe"};
    plan.program_key = std::move(key);
    plan.bake_options = bake_options_of(arguments.bake);
    plan.pages = arguments.pages;
    plan.bakes = !arguments.report_only;
    plan.jobs = arguments.jobs;
    plan.limits.time = std::chrono::milliseconds(static_cast<std::int64_t>(1000.0 * arguments.time_limit_s));
    plan.limits.memory_bytes = static_cast<std::uint64_t>(bytes_per_mb * arguments.memory_limit_mb);
    plan.limits.complaint_bytes = std::size_t{1} << 20U;
    return plan;
}

/// report.html and report.csv, or a shard's reports.
std::filesystem::path report_file(const Arguments& arguments, const std::optional<Shard>& shard,
                                  std::string_view ending) {
    return arguments.output / (shard ? fmt::format("report.{}-of-{}.{}", shard->number, shard->of, ending)
                                     : fmt::format("report.{}", ending));
}

Result<void> write_reports(const Arguments& arguments, const std::optional<Shard>& shard,
                           const std::vector<BatchRow>& rows, const Collection& collection, double seconds) {
    const std::string title =
        shard ? fmt::format("{}, share {} of {}", arguments.folder.string(), shard->number, shard->of)
              : arguments.folder.string();
    TRY_VOID(write_file(report_file(arguments, shard, "csv"), as_bytes(report_csv(rows))));
    return write_file(report_file(arguments, shard, "html"),
                      as_bytes(report_page(rows, title, seconds, collection.skipped)));
}

/// Prints failures as they occur; the report has the rest.
std::vector<BatchRow> run(const BatchPlan& plan) {
    ProgressLine progress("baking: ");
    std::size_t done = 0;
    std::size_t told = 0;
    return run_batch(plan, [&](const BatchRow& row) {
        progress.show(++done, plan.objects.size());
        if (!row.sentence.empty() && told < max_sentences) {
            progress.clear();
            ++told;
            say_line(program, fmt::format("{}: {}", row.object, row.sentence));
        }
    });
}

void print_end(const Arguments& arguments, const std::vector<BatchRow>& rows,
               const std::filesystem::path& report, double seconds) {
    if (!arguments.json) {
        fmt::print("{}, in {}; {} says more\n", summary(rows), words_of_time(seconds), report.string());
        return;
    }
    nlohmann::ordered_json json = {
        {"objects", rows.size()}, {"seconds", seconds}, {"report", report.string()}};
    for (const BatchStatus status :
         {BatchStatus::Baked, BatchStatus::Unchanged, BatchStatus::Failed, BatchStatus::Missing}) {
        json[std::string(name_of(status))] = count_of(rows, status);
    }
    fmt::print("{}\n", json.dump(2));
}

/// True if every object has a pack.
Result<bool> work(const Arguments& arguments) {
    const MonotonicTime start = monotonic_now();
    std::optional<Shard> shard;
    if (!arguments.shard.empty()) {
        TRY(shard, parse_shard(arguments.shard));
    }
    TRY(const Collection collection, list_collection(arguments.folder, arguments.output));
    if (collection.objects.empty()) {
        return bad_input("batch.nothing_to_bake",
                         "{}: it contains no scan and no folder with an artifact.toml; frustumscreen-bake "
                         "--new FOLDER SCAN makes one",
                         arguments.folder.string());
    }
    TRY_VOID(check_output_folder(arguments.output));
    TRY(const BatchPlan plan, plan_of(arguments, share_of(collection.objects, shard.value_or(Shard()))));
    const std::vector<BatchRow> rows = run(plan);
    const double seconds = to_seconds(monotonic_now() - start);
    TRY_VOID(write_reports(arguments, shard, rows, collection, seconds));
    print_end(arguments, rows, report_file(arguments, shard, "html"), seconds);
    return count_of(rows, BatchStatus::Failed) + count_of(rows, BatchStatus::Missing) == 0;
}

ArgumentCheck is_memory_limit() {
    const auto check = [](const std::string& text) {
        double megabytes = -1.0;
        const char* const end = text.data() + text.size();
        const std::from_chars_result read = std::from_chars(text.data(), end, megabytes);
        const bool is_number = read.ec == std::errc{} && read.ptr == end;
        const bool well = is_number && (megabytes == 0.0 || (megabytes >= min_memory_mb && megabytes <= 1e8));
        return well ? std::string()
                    : fmt::format("'{}' is not allowed; allowed are {} megabytes and more, or 0 for no limit",
                                  text, min_memory_mb);
    };
    return {check, ""};
}

void add_options(CommandLine& app, Arguments& arguments) {
    app.add_option("--batch", arguments.folder, "DIR with scans, and subfolders with an artifact.toml each")
        .expected(0, 1);
    app.add_option("-o,--output", arguments.output, "folder to write packs, stamps and the report to");
    app.add_option("-j,--jobs", arguments.jobs, "number of bakes at a time; each uses all cores")
        .within(1, 256)
        .capture_default_str();
    app.add_option("--shard", arguments.shard,
                   "i/n: bake every n-th object from the i-th on, for one of n machines");
    app.add_option("--time-limit", arguments.time_limit_s, "longest time for one bake, seconds")
        .within(1.0, 1e6)
        .capture_default_str();
    app.add_option(
           "--memory-limit", arguments.memory_limit_mb,
           fmt::format("largest memory of one bake, megabytes, {} or more; 0: no limit", min_memory_mb))
        .check(is_memory_limit())
        .capture_default_str();
    app.add_flag("--previews", arguments.pages, "write a preview page beside each pack, as --preview does");
    app.add_flag("--report-only", arguments.report_only,
                 "bake nothing; report on the packs in the output folder, for example after all shards");
    app.add_flag("--json", arguments.json, "print the counts as JSON");
    add_bake_options(app, arguments.bake);
}

} // namespace

int batch_command(int argc, char** argv) {
    Arguments arguments;
    CommandLine app("Bakes every object of a folder into a pack. Unchanged objects are skipped, a failure "
                    "does not stop the others, and an interrupted run continues where it ended.",
                    program);
    app.set_version_flag("--version", name_and_version("frustumscreen-bake"));
    add_options(app, arguments);
    if (const auto end = app.end_of_arguments(argc, argv, [&] {
            if (arguments.folder.empty() || arguments.output.empty()) {
                throw WrongUse{"--batch needs DIR, the folder of the objects, after it; -o needs the folder "
                               "of the packs"};
            }
        })) {
        return *end;
    }
    const Result<bool> done = work(arguments);
    if (!done) {
        complain(program, done.error());
        return done.error().kind == ErrorKind::BadConfiguration ? 2 : 1;
    }
    return *done ? 0 : 1;
}

} // namespace frustumscreen::programs
