#include "app/programs/frustumscreen/report/report_command.h"

#include "app/library/import_report_file.h"
#include "app/library/report_request.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/frustumscreen/report/report_files.h"
#include "app/programs/frustumscreen/status/status_places.h"
#include "app/report/write_report.h"
#include "firmware_host/base/disk_tree.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace frustumscreen::programs {

namespace {

struct Request {
    std::filesystem::path into;
    ReportPlaces places;
    std::string name; ///< of the folder as the staff see it on the stick; empty: that of `into`
    std::filesystem::path outcome;
    std::filesystem::path import_report;
    std::string id;
    double report_stands_s = 0.0;
};

std::optional<int> read_arguments(int argc, char** argv, Request& request) {
    CommandLine app(
        "Writes all that the makers want to know of this machine's exhibit into a folder: status, "
        "journal, faults, visits, settings. Nothing in it names a person.",
        "frustumscreen report");
    ReportPlaces& places = request.places;
    app.add_option("--into", request.into, "an empty folder, or a new one").required();
    app.add_option("--config", places.config, "the kiosk's settings, TOML").capture_default_str();
    app.add_option("--counts", places.counts, "folder of the visits' numbers").capture_default_str();
    app.add_option("--faults", places.faults, "the watchdog's ring of faults").capture_default_str();
    app.add_option("--journal", places.journal, "folder of the journal; else this machine's own");
    add_status_places(app, places.status);
    app.add_option("--name", request.name, "the folder's name on the stick, for --outcome");
    app.add_option("--outcome", request.outcome, "file that says what came of it, for frustumscreen-import");
    const CommandOption id = app.add_option("--id", request.id, "name of the stick's import");
    app.add_option("--import-report", request.import_report,
                   "the importer's report: says meanwhile that the stick is to stay in")
        .needs(id);
    app.add_option("--report-stands", request.report_stands_s,
                   "s that another stick's report stands once it is over")
        .within(0.0, 60.0);
    return app.end_of_arguments(argc, argv);
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

tl::expected<void, library::ImportFailure> write(const Request& request) {
    const std::vector<report::ReportFile> files = report_files(request.places);
    const Result<std::unique_ptr<WritableTree>> folder = open_or_make(request.into);
    if (!folder) {
        return tl::unexpected<library::ImportFailure>(library::ImportFailure{
            .refusal = library::ImportRefusal::Unwritable, .reason = folder.error().message, .whole = false});
    }
    return report::write_report(**folder, files);
}

} // namespace

int report_command(int argc, char** argv) {
    Request request;
    if (const std::optional<int> status = read_arguments(argc, argv, request)) {
        return *status;
    }
    library::ImportReport told;
    told.import_id = printable(request.id);
    if (!request.import_report.empty()) {
        library::wait_for_readers(request.import_report, told.import_id, request.report_stands_s);
        leave(request.import_report, told);
    }
    const tl::expected<void, library::ImportFailure> written = write(request);
    const std::string name = request.name.empty() ? request.into.filename().string() : request.name;
    library::ImportedPack& line = told.packs.emplace_back();
    line.file = written ? printable(name) : std::string(library::report_request_name);
    line.outcome = written ? library::ImportOutcome::Written : library::ImportOutcome::NotWritten;
    line.refusal = written ? library::ImportRefusal::None : written.error().refusal;
    line.reason = written ? std::string() : written.error().reason;
    told.stage = library::ImportStage::Done;
    leave(request.outcome, told);
    if (written) {
        fmt::print("{}: the report is written\n", line.file);
        return 0;
    }
    if (line.refusal == library::ImportRefusal::Unreadable) { // the importer may find no stick to tell of
        told.import_id += ".report";
        told.stage = library::ImportStage::Failed;
        told.refusal = line.refusal;
        told.reason = line.reason;
        leave(request.import_report, told);
    }
    say_line("frustumscreen", "no report is written: " + line.reason);
    return 1;
}

} // namespace frustumscreen::programs
