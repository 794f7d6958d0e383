#include "app/programs/frustumscreen/report/report_files.h"

#include "app/counts/counts_table.h"
#include "app/report/shared_text.h"
#include "app/settings/settings_to_share.h"
#include "app/status/status_document.h"
#include "app/status/status_lines.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/run_program.h"
#include "firmware_host/base/version.h"

#include <fmt/format.h>

#include <ctime>
#include <string>

namespace frustumscreen::programs {

namespace {

constexpr std::size_t max_journal_bytes = 8U << 20U;
constexpr std::uintmax_t max_small_bytes = 4U << 20U; ///< of the settings, and of the ring of faults

std::string text_or_why(Result<std::string> text) {
    return text ? *std::move(text) : text.error().message + "\n";
}

Result<std::string> small_text(const std::filesystem::path& file) {
    TRY(const Bytes bytes, read_file(file, max_small_bytes));
    return std::string(as_text(bytes));
}

/// The disk with the packs may be read-only for this process alone; the watchdog's notes tell of the disk.
std::string document_to_share(const status::KnownExhibit& known) {
    auto document = nlohmann::ordered_json::parse(status::status_document(known));
    if (auto& machine = document["machine"]; machine.is_object() && machine["disk"].is_object()) {
        machine["disk"].erase("writable");
    }
    return document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string version_text(const status::Environment& environment) {
    const status::SystemImage& image = environment.image;
    std::string text = fmt::format("FrustumScreen {}\n{}\n", project_version(), environment.system);
    if (image.there()) {
        text += fmt::format("image {}, slot {}\n", image.version, image.slot);
    }
    return text;
}

Result<std::string> journal_text(const std::filesystem::path& folder) {
    std::vector<std::string> command{"journalctl",         "--quiet", "--no-pager",   "--no-hostname",
                                     "--output=short-iso", "--utc",   "--since=-24h", "--lines=60000"};
    if (!folder.empty()) {
        command.push_back("--directory=" + folder.string());
    }
    ProgramLimits limits;
    limits.time = std::chrono::minutes(4);
    limits.output_bytes = 4 * max_journal_bytes;
    TRY(const Bytes journal, run_program(command, "", limits));
    return report::shared_journal(as_text(journal), max_journal_bytes);
}

} // namespace

std::vector<report::ReportFile> report_files(const ReportPlaces& places) {
    status::KnownExhibit known = status::read_known_exhibit(places.status, status::status_clock());
    if (const auto import = known.status.fields.find("import");
        import != known.status.fields.end() && import->is_object()) {
        (*import)["stick"] = ""; // a label may be a person's name
    }
    std::vector<report::ReportFile> files;
    files.push_back({"version.txt", version_text(known.environment)});
    files.push_back({"status.txt", status::status_text(known, std::time(nullptr))});
    files.push_back({"status.json", document_to_share(known)});
    files.push_back(
        {"settings.txt", text_or_why(small_text(places.config).and_then([](const std::string& text) {
             return settings::settings_to_share(text);
         }))});
    if (const Result<counts::ReadCounts> counts = counts::read_counts(places.counts)) {
        files.push_back({"counts.csv", counts::counts_csv(*counts)});
    }
    files.push_back({"faults.txt", text_or_why(small_text(places.faults).map([](const std::string& ring) {
                         return report::faults_in_order(ring);
                     }))});
    files.push_back({"journal.txt", text_or_why(journal_text(places.journal))});
    return files;
}

} // namespace frustumscreen::programs
