#include "app/programs/import/import_command.h"

#include "app/kiosk_copy/copy_request.h"
#include "app/kiosk_copy/take_kiosk_copy.h"
#include "app/library/import_end.h"
#include "app/library/import_report_file.h"
#include "app/library/import_stick.h"
#include "app/library/library_folder.h"
#include "app/library/own_settings.h"
#include "app/library/report_request.h"
#include "app/library/stick_settings.h"
#include "app/library/trusted_keys.h"
#include "app/pack/signature/key_folder.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/import/import_watcher.h"
#include "app/programs/import/listed_keys.h"
#include "app/programs/import/listed_signers.h"
#include "app/settings/settings.h"
#include "firmware_host/base/disk_tree.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/host_name.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/printable.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

namespace frustumscreen::programs {

namespace {

/// Locks a folder, so that an import from a second stick waits for the first.
class FolderLock {
public:
    [[nodiscard]] static Result<FolderLock> wait_for(const std::filesystem::path& folder) {
        FolderLock lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
        if (lock.folder_ < 0) {
            return bad_input("import.library_unopened",
                             folder.string() + ": cannot be opened as a folder: " + std::strerror(errno));
        }
        while (::flock(lock.folder_, LOCK_EX) != 0) {
            if (errno != EINTR) {
                return bad_input("import.library_locked",
                                 folder.string() + ": cannot be locked: " + std::strerror(errno));
            }
        }
        return lock;
    }
    FolderLock(FolderLock&& other) noexcept : folder_(std::exchange(other.folder_, -1)) {}
    FolderLock& operator=(FolderLock&&) = delete;
    ~FolderLock() {
        if (folder_ >= 0) {
            ::close(folder_);
        }
    }

private:
    explicit FolderLock(int folder) : folder_(folder) {}
    int folder_;
};

Nanoseconds processor_time() {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// An id that differs for each stick, even after a restart with the clock set back: time and process id.
std::string import_id(const ImportArguments& arguments) {
    if (!arguments.id.empty()) {
        return printable(arguments.id) +
               std::string(arguments.confirmed ? library::staff_import_ending : std::string_view());
    }
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return fmt::format("{}-{}", std::chrono::duration_cast<std::chrono::milliseconds>(now).count(),
                       ::getpid());
}

Result<void> read_trust(const ImportArguments& arguments, library::ImportRequest& request) {
    if (!arguments.config.empty()) {
        TRY(const settings::CheckedSettings settings, settings::load_settings(arguments.config));
        request.keys = settings->exhibit.keys;
        request.unsigned_packs = settings->exhibit.unsigned_packs;
    }
    if (!arguments.keys.empty()) {
        TRY(request.keys, pack::read_key_folder(arguments.keys));
    }
    if (arguments.allow_unsigned) {
        request.unsigned_packs = pack::UnsignedPacks::Allow;
    }
    return {};
}

Result<void> make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    return error ? bad_input("import.library_not_made",
                             folder.string() + ": cannot be made: " + error.message())
                 : Result<void>();
}

/// The contents of set.txt, and the set that an exhibit started now would show.
struct Installed {
    library::SetFile file;
    library::InstalledSet set;
};

Result<Installed> installed(const std::filesystem::path& folder) {
    TRY(const std::unique_ptr<WritableTree> library, open_tree(folder));
    const tl::expected<library::SetFile, library::ImportFailure> file = library::read_set_file(*library);
    if (!file) {
        return bad_input("import.set_file", folder.string() + ": " + file.error().reason);
    }
    const tl::expected<std::optional<library::SetVerdict>, library::ImportFailure> verdict =
        library::read_verdict(*library);
    if (!verdict) {
        return bad_input("import.verdict_file", folder.string() + ": " + verdict.error().reason);
    }
    return Installed{*file, library::set_to_show(file->choice, *verdict)};
}

/// Number of the installed set; 0 if it is not known.
std::uint64_t set_number(const ImportArguments& arguments) {
    return installed(arguments.into).map([](const Installed& found) { return found.set.number; }).value_or(0);
}

std::optional<library::ImportedPack> take_copy_of(FileTree& stick, WritableTree& settings,
                                                  const ImportArguments& arguments,
                                                  std::optional<std::chrono::sys_days> today) {
    const Result<std::unique_ptr<WritableTree>> calibration = open_tree(arguments.calibration);
    if (arguments.counts.empty() || !calibration) {
        return std::nullopt; // this kiosk takes no copies
    }
    return kiosk_copy::take_kiosk_copy(stick, {settings, **calibration, arguments.counts}, today);
}

void leave_mark(const ImportArguments& arguments, std::string_view name, std::string_view text = "") {
    if (!arguments.report.empty()) {
        if (const Result<void> marked = write_file(arguments.report.parent_path() / name, as_bytes(text));
            !marked) {
            complain("frustumscreen-import", marked.error());
        }
    }
}

/// A valid request for the state of delivery, which the staff must confirm; none: there is none. The unit that writes to
/// the stick reports why a request is invalid.
std::optional<library::ImportedPack> reset_asked_for(FileTree& stick, WritableTree& settings,
                                                     std::optional<std::chrono::sys_days> today) {
    const tl::expected<library::OwnSettings, library::ImportFailure> own =
        library::read_own_settings(settings);
    if (!own) {
        return std::nullopt;
    }
    const auto asked = kiosk_copy::read_copy_request(stick, own->keys, host_name(), today);
    if (!asked || !*asked || !(*asked)->reset) {
        return std::nullopt;
    }
    return library::ImportedPack{
        .file = std::string(library::copy_request_name),
        .title = "",
        .outcome = library::ImportOutcome::Pending,
        .refusal = library::ImportRefusal::None,
        .reason =
            "it asks for the state of delivery; to confirm, show the staff's picture within ten minutes, "
            "and hold the first button for two seconds on its first page"};
}

/// Takes the stick's settings before the keys are read from them, because the stick may bring other keys. Those in a copy
/// come first: the stick's kiosk.toml is meant for this kiosk.
void take_settings_of(FileTree& stick, WritableTree& library, const ImportArguments& arguments,
                      library::ImportRequest& request) {
    const Result<std::unique_ptr<WritableTree>> folder = open_tree(arguments.settings);
    if (!folder) {
        return; // this kiosk has no settings to replace
    }
    const tl::expected<library::SetFile, library::ImportFailure> set = library::read_set_file(library);
    const std::optional<std::chrono::sys_days> today =
        library::day_here(request.today, set ? set->latest_day : "");
    const std::optional<library::ImportedPack> reset = reset_asked_for(stick, **folder, today);
    if (reset) {
        leave_mark(arguments, "reset-asked");
    }
    const std::optional<library::ImportedPack> copy = take_copy_of(stick, **folder, arguments, today);
    for (const std::optional<library::ImportedPack>& line : {copy, reset}) {
        if (line) {
            request.kiosk.push_back(*line);
        }
    }
    request.settings = library::take_settings(stick, **folder, today);
    const auto is_taken = [](const std::optional<library::ImportedPack>& line) {
        return line && line->outcome == library::ImportOutcome::Taken;
    };
    if (is_taken(copy) || is_taken(request.settings)) {
        leave_mark(arguments, "settings-taken");
    }
}

/// The lines on the report that was written to the stick. The file of its outcome is read once.
std::vector<library::ImportedPack> stick_report_of(FileTree& stick, const ImportArguments& arguments) {
    const std::optional<library::ImportReport> written = library::read_import_report(arguments.stick_report);
    std::error_code ignored;
    std::filesystem::remove(arguments.stick_report, ignored);
    return library::lines_of_stick_report(stick, written ? std::optional(written->packs) : std::nullopt,
                                          arguments.confirmed);
}

/// A copy that the staff may confirm, once for each time that a stick is put in. A copy that cannot be written is not offered.
void offer_copy(FileTree& stick, const ImportArguments& arguments, library::ImportRequest& request) {
    const bool fails =
        std::any_of(request.stick_report.begin(), request.stick_report.end(),
                    [](const auto& line) { return line.outcome == library::ImportOutcome::NotWritten; });
    if (!arguments.confirmed && !fails && library::waits_for_staff(stick)) {
        leave_mark(arguments, "copy-asked", request.import_id);
        request.kiosk.push_back(library::copy_offer());
    }
}

/// Reports that nothing of the stick was read except what `request` tells of.
library::ImportReport tell_failed(const ImportArguments& arguments, const std::string& id,
                                  library::ImportRefusal refusal, const std::string& reason,
                                  const library::ImportRequest& request = {}) {
    library::ImportReport report;
    report.import_id = id;
    report.stick = printable(arguments.label);
    report.stage = library::ImportStage::Failed;
    report.refusal = refusal;
    report.reason = reason;
    report.set_number = set_number(arguments);
    if (request.settings) {
        report.packs.push_back(*request.settings);
    }
    for (const auto* lines : {&request.kiosk, &request.stick_report}) {
        report.packs.insert(report.packs.end(), lines->begin(), lines->end());
    }
    ImportWatcher(arguments.report, !arguments.json).tell(report, monotonic_now());
    return report;
}

} // namespace

library::ImportReport import_from(const ImportArguments& arguments) {
    library::ImportRequest request;
    request.import_id = import_id(arguments);
    request.stick = arguments.label;
    request.today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
    const Result<std::unique_ptr<WritableTree>> stick = open_tree(arguments.from);
    const Result<FolderLock> lock =
        make_folder(arguments.into).and_then([&] { return FolderLock::wait_for(arguments.into); });
    const Result<std::unique_ptr<WritableTree>> library = open_tree(arguments.into);
    request.takes_settings = !arguments.settings.empty();
    if (stick && lock && library && request.takes_settings) {
        take_settings_of(**stick, **library, arguments, request);
    }
    request.writes_reports = !arguments.stick_report.empty();
    if (stick && request.writes_reports) {
        request.stick_report = stick_report_of(**stick, arguments);
        offer_copy(**stick, arguments, request);
    }
    const Result<void> trusted = read_trust(arguments, request);
    library::wait_for_readers(arguments.report, request.import_id, arguments.report_stands_s);
    if (!stick) {
        return tell_failed(arguments, request.import_id, library::ImportRefusal::Unreadable,
                           stick.error().message);
    }
    const Result<void> ready = lock.map([](const FolderLock&) {})
                                   .and_then([&] { return library.map([](const auto&) {}); })
                                   .and_then([&] { return trusted; });
    if (!ready) {
        return tell_failed(arguments, request.import_id, library::ImportRefusal::Unwritable,
                           ready.error().message, request);
    }
    ImportWatcher watcher(arguments.report, !arguments.json);
    const library::ImportEnvironment outside{
        monotonic_now, processor_time,
        [&](const library::ImportReport& report) { watcher.tell(report, monotonic_now()); }};
    return library::import_stick(**stick, **library, request, outside);
}

std::optional<library::ImportReport> tell_unmounted(const ImportArguments& arguments) {
    // If the folder cannot be locked, no import runs either.
    const Result<FolderLock> lock = FolderLock::wait_for(arguments.into);
    const std::string id = import_id(arguments);
    if (!library::must_report_unmounted(library::read_import_report(arguments.report), id)) {
        return std::nullopt;
    }
    library::wait_for_readers(arguments.report, id, arguments.report_stands_s);
    return tell_failed(arguments, id, library::ImportRefusal::Unreadable,
                       "the stick cannot be read or was pulled out; put it in again, and if this is said "
                       "again, format it as FAT32 or exFAT and copy the packs onto it");
}

Result<void> tell_ended(const ImportArguments& arguments, std::string_view service_result) {
    const std::optional<library::ImportReport> report =
        library::final_report_of(library::read_import_report(arguments.report), import_id(arguments),
                                 service_result, set_number(arguments));
    return report ? write_file(arguments.report, as_bytes(library::write_import_report(*report)))
                  : Result<void>();
}

Result<std::string> list_installed(const ImportArguments& arguments) {
    TRY(const Installed found, installed(arguments.into));
    library::ImportRequest request; // its keys are empty if no settings are named
    TRY_VOID(read_trust(arguments, request));
    const library::InstalledSet* set = &found.set;
    const bool knows_settings = !arguments.config.empty() || !arguments.keys.empty();
    const std::vector<ListedKey> listed = list_keys(request.keys, found.file.keys);
    const SignerList signers(
        arguments.into, listed, knows_settings, library::trusted_keys(request.keys, found.file.keys),
        library::day_here(std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()),
                          found.file.latest_day));
    auto packs = nlohmann::ordered_json::array();
    std::string text;
    for (const library::InstalledPack& pack : set->packs) {
        const ListedSigner signer = signers.of(pack);
        packs.push_back({{"file", pack.file},
                         {"title", pack.title},
                         {"serial", pack.serial},
                         {"sha256", pack.sha256},
                         {"id", pack.id},
                         {"bytes", pack.bytes},
                         {"signed_by", json_of(signer)}});
        text +=
            fmt::format("{}  {}  serial {}  {}  {}\n", pack.sha256.substr(0, 12),
                        pack.id.empty() ? "-" : pack.id, pack.serial, printable(pack.title), text_of(signer));
    }
    auto keys = nlohmann::ordered_json::array();
    for (const ListedKey& key : listed) {
        keys.push_back(json_of(key, knows_settings));
        text += text_of(key, knows_settings);
    }
    nlohmann::ordered_json json{
        {"number", set->number}, {"packs", std::move(packs)}, {"keys", std::move(keys)}};
    return arguments.json ? json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n" : text;
}

} // namespace frustumscreen::programs
