#include "app/programs/frustumscreen/report/report_command.h"

#include "app/library/import_report_file.h"
#include "app/library/report_request.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/frustumscreen/report/copy_files.h"
#include "app/programs/frustumscreen/report/report_files.h"
#include "app/programs/frustumscreen/status/status_places.h"
#include "app/report/write_report.h"
#include "firmware_host/base/disk_tree.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/standard_error.h"
#include "firmware_host/base/tree_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::programs {

namespace {

struct Request {
    std::filesystem::path into;
    ReportPlaces places;
    CopyPlaces copy;
    std::string name; ///< of the folder as the staff see it on the stick; empty: that of `into`
    std::filesystem::path outcome;
    std::filesystem::path import_report;
    std::string id;
    double report_stands_s = 0.0;
};

std::optional<int> read_arguments(int argc, char** argv, Request& request) {
    CommandLine app("Collects a report on this machine's exhibit into a folder: status, journal, faults, "
                    "visits, settings. It contains no personal data.",
                    "frustumscreen report");
    ReportPlaces& places = request.places;
    app.add_option("--into", request.into, "folder to write to, empty or new").required();
    app.add_option("--config", places.config, "the kiosk's settings, TOML").capture_default_str();
    app.add_option("--counts", places.counts, "folder of the counts of visits").capture_default_str();
    app.add_option("--faults", places.faults, "folder of the watchdog's fault records").capture_default_str();
    app.add_option("--journal", places.journal, "folder of the journal (default: this machine's)");
    add_status_places(app, places.status);
    const CommandOption stick =
        app.add_option("--stick", request.copy.stick,
                       "folder of the stick: an empty frustumscreen-report.toml on it requests the report, a "
                       "signed frustumscreen-request.toml a kiosk copy");
    app.add_flag(
           "--confirmed", request.copy.confirmed,
           "the staff's buttons have confirmed an empty frustumscreen-request.toml, which then requests "
           "a kiosk copy without a signature")
        .needs(stick);
    app.add_option("--calibration", request.copy.calibration, "folder of the calibrations, for --stick")
        .capture_default_str();
    app.add_option("--library", request.copy.library, "folder of the installed set, for --stick")
        .capture_default_str();
    app.add_option("--name", request.name, "name of the folder on the stick, for --outcome");
    app.add_option("--outcome", request.outcome, "file to write the outcome to, for frustumscreen-import");
    const CommandOption id =
        app.add_option("--id", request.id, "name of the stick's import, for --import-report");
    app.add_option(
           "--import-report", request.import_report,
           "the importer's report; while this command works, it tells the staff to leave the stick in")
        .needs(id);
    app.add_option("--report-stands", request.report_stands_s,
                   "seconds to leave another stick's finished report before it is replaced")
        .within(0.0, 60.0);
    const std::optional<int> end = app.end_of_arguments(argc, argv);
    request.copy.config = places.config;
    request.copy.counts = places.counts;
    return end;
}

/// A file that cannot be written causes one message: the report itself counts.
void leave(const std::filesystem::path& file, const library::ImportReport& report) {
    if (file.empty()) {
        return;
    }
    if (const Result<void> written = write_file(file, as_bytes(library::write_import_report(report)));
        !written) {
        complain("frustumscreen", written.error());
    }
}

Result<std::unique_ptr<WritableTree>> open_or_make(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error && !std::filesystem::is_directory(folder)) {
        return bad_input("report.folder", "{}: cannot be made: {}", folder.string(), error.message());
    }
    return open_tree(folder);
}

/// The files to write, and those that are refused.
struct Contents {
    std::string asked_by; ///< name of the stick's file, for messages
    std::vector<report::ReportFile> texts;
    CopyFiles copy;
    std::optional<library::ImportFailure> refused; ///< the request for a copy
    bool asks_for_nothing = false;                 ///< to be written
};

bool asks_for_report(const Request& request) {
    if (request.copy.stick.empty()) {
        return true;
    }
    const Result<std::unique_ptr<WritableTree>> stick = open_tree(request.copy.stick);
    return stick && read_text(**stick, library::report_request_name, library::max_report_request_bytes);
}

/// nullopt: none was requested.
tl::expected<std::optional<CopyFiles>, library::ImportFailure> copy_for(const Request& request) {
    const auto clock = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
    TRY(const std::optional<kiosk_copy::CopyRequest> asked, copy_asked_for(request.copy, clock));
    if (!asked || !asked->asks_for_copy()) {
        return std::optional<CopyFiles>();
    }
    TRY(CopyFiles files, copy_files(*asked, request.copy).map_error([](const Error& error) {
        return library::ImportFailure{
            .refusal = library::ImportRefusal::Unwritable, .reason = error.message, .whole = false};
    }));
    return std::optional(std::move(files));
}

Contents contents_of(const Request& request) {
    Contents contents;
    contents.asked_by = library::copy_request_name;
    if (asks_for_report(request)) {
        contents.asked_by = library::report_request_name;
        contents.texts = report_files(request.places);
    }
    tl::expected<std::optional<CopyFiles>, library::ImportFailure> copy = copy_for(request);
    if (!copy) {
        contents.refused = std::move(copy.error());
        return contents;
    }
    if (!*copy) {
        contents.asks_for_nothing = contents.texts.empty();
        return contents;
    }
    contents.copy = **std::move(copy);
    for (report::ReportFile& file : contents.copy.texts) {
        const bool is_there =
            std::any_of(contents.texts.begin(), contents.texts.end(),
                        [&](const report::ReportFile& other) { return other.name == file.name; });
        if (!is_there) { // a report has the counts too
            contents.texts.push_back(std::move(file));
        }
    }
    return contents;
}

/// Tells the table how much of the packs is copied, a hundred times in all and each 4 MB.
class CopyProgress {
public:
    CopyProgress(const std::filesystem::path& file, library::ImportReport told,
                 std::span<const report::CopiedFile> packs)
        : file_(file), told_(std::move(told)) {
        told_.stage = library::ImportStage::Copying;
        for (const report::CopiedFile& pack : packs) {
            told_.total_bytes += pack.bytes;
        }
    }
    void add(std::uint64_t bytes) {
        constexpr std::uint64_t step = 4U << 20U;
        const std::uint64_t before = told_.done_bytes / step;
        told_.done_bytes += bytes;
        if (told_.done_bytes / step != before) {
            leave(file_, told_);
        }
    }

private:
    const std::filesystem::path& file_;
    library::ImportReport told_;
};

tl::expected<void, library::ImportFailure> write(const Request& request, const Contents& contents,
                                                 const library::ImportReport& told) {
    const Result<std::unique_ptr<WritableTree>> folder = open_or_make(request.into);
    if (!folder) {
        return tl::unexpected<library::ImportFailure>(library::ImportFailure{
            .refusal = library::ImportRefusal::Unwritable, .reason = folder.error().message, .whole = false});
    }
    CopyProgress progress(request.import_report, told, contents.copy.packs);
    return report::write_report(**folder, contents.texts,
                                {contents.copy.library.get(), contents.copy.packs,
                                 [&](std::uint64_t bytes) { progress.add(bytes); }});
}

library::ImportedPack not_written(std::string_view file, const library::ImportFailure& failure) {
    const std::string name = std::string(file) + ": ";
    const bool is_named = failure.reason.starts_with(name);
    return {.file = std::string(file),
            .title = "",
            .outcome = library::ImportOutcome::NotWritten,
            .refusal = failure.refusal,
            .reason = is_named ? failure.reason.substr(name.size()) : failure.reason};
}

/// Writes the files, and adds a line for each success and failure.
void write_and_tell(const Request& request, const Contents& contents, library::ImportReport& told) {
    if (contents.refused) {
        told.packs.push_back(not_written(library::copy_request_name, *contents.refused));
    }
    if (contents.texts.empty() && contents.copy.packs.empty()) {
        if (!contents.refused && !contents.asks_for_nothing) {
            told.packs.push_back(
                not_written(contents.asked_by,
                            {.refusal = library::ImportRefusal::Unwritable,
                             .reason = "the kiosk has nothing of what was asked for; nothing is written",
                             .whole = false}));
        }
        return;
    }
    const tl::expected<void, library::ImportFailure> written = write(request, contents, told);
    const std::string name = request.name.empty() ? request.into.filename().string() : request.name;
    told.packs.push_back(written ? library::ImportedPack{.file = printable(name),
                                                         .title = "",
                                                         .outcome = library::ImportOutcome::Written,
                                                         .refusal = {},
                                                         .reason = ""}
                                 : not_written(contents.asked_by, written.error()));
}

/// Returns the exit status. Reports a stick that was pulled out to the table at once, since the importer may no longer
/// find it.
int say(const Request& request, const library::ImportReport& told) {
    int status = 0;
    for (const library::ImportedPack& line : told.packs) {
        if (line.outcome == library::ImportOutcome::Written) {
            fmt::print("{}: it is written\n", line.file);
            continue;
        }
        status = 1;
        say_line("frustumscreen", fmt::format("not written, as {} asks: {}", line.file, line.reason));
        if (line.refusal == library::ImportRefusal::Unreadable) {
            library::ImportReport failed = told;
            failed.import_id += ".report";
            failed.stage = library::ImportStage::Failed;
            failed.refusal = line.refusal;
            failed.reason = line.reason;
            leave(request.import_report, failed);
        }
    }
    return status;
}

} // namespace

int report_command(int argc, char** argv) {
    Request request;
    if (const std::optional<int> status = read_arguments(argc, argv, request)) {
        return *status;
    }
    library::ImportReport told;
    told.import_id = printable(request.id) +
                     std::string(request.copy.confirmed ? library::staff_import_ending : std::string_view());
    if (!request.import_report.empty()) {
        library::wait_for_readers(request.import_report, told.import_id, request.report_stands_s);
        leave(request.import_report, told);
    }
    write_and_tell(request, contents_of(request), told);
    told.stage = library::ImportStage::Done;
    leave(request.outcome, told);
    return say(request, told);
}

} // namespace frustumscreen::programs
