#include "app/programs/frustumscreen/report/copy_files.h"

#include "app/counts/counts_table.h"
#include "app/kiosk_copy/kiosk_copy.h"
#include "app/library/library_folder.h"
#include "app/library/report_request.h"
#include "app/library/stick_settings.h"
#include "app/library/trusted_keys.h"
#include "app/settings/kept_calibrations.h"
#include "app/settings/settings.h"
#include "app/settings/settings_to_share.h"
#include "firmware_host/base/disk_tree.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/host_name.h"
#include "firmware_host/base/tree_text.h"

#include <fmt/format.h>

#include <cerrno>
#include <string>
#include <utility>

namespace frustumscreen::programs {

namespace {

template <typename T> using Outcome = tl::expected<T, library::ImportFailure>;

tl::unexpected<library::ImportFailure> failed(const Error& error) {
    return tl::unexpected<library::ImportFailure>(library::ImportFailure{
        .refusal = library::ImportRefusal::Unwritable, .reason = error.message, .whole = false});
}

/// The day that counts on this machine, as for packs.
std::optional<std::chrono::sys_days> today_of(const CopyPlaces& places, std::chrono::sys_days clock) {
    const Result<std::unique_ptr<WritableTree>> library = open_tree(places.library);
    const Outcome<library::SetFile> set =
        library ? library::read_set_file(**library) : Outcome<library::SetFile>();
    return library::day_here(clock, set ? set->latest_day : "");
}

Result<void> add_settings(const kiosk_copy::CopyRequest& request, const CopyPlaces& places,
                          kiosk_copy::KioskCopy& copy, std::vector<report::ReportFile>& texts) {
    TRY(const Bytes bytes, read_file(places.config, library::max_stick_settings_bytes));
    copy.settings = std::string(as_text(bytes));
    if (request.by_staff) {
        TRY(copy.settings, settings::settings_without_comments(*copy.settings));
    }
    texts.push_back({"settings.toml", *copy.settings});
    return {};
}

/// The newest one that can be read; a kiosk that was never measured has none.
Result<void> add_calibration(const CopyPlaces& places, kiosk_copy::KioskCopy& copy,
                             std::vector<report::ReportFile>& texts) {
    TRY(const std::unique_ptr<WritableTree> folder, open_tree(places.calibration));
    TRY(const std::vector<settings::KeptCalibration> kept, settings::list_calibrations(*folder));
    for (const settings::KeptCalibration& each : kept) {
        FileResult<std::string> text = read_text(*folder, each.name, settings::largest_calibration_bytes);
        if (text && settings::read_calibration(*folder, each)) {
            copy.calibration = *std::move(text);
            texts.push_back({"calibration.toml", *copy.calibration});
            break;
        }
    }
    return {};
}

Result<void> add_counts(const CopyPlaces& places, kiosk_copy::KioskCopy& copy,
                        std::vector<report::ReportFile>& texts) {
    TRY(counts::ReadCounts counts, counts::read_counts(places.counts));
    texts.push_back({"counts.csv", counts::counts_csv(counts)});
    copy.days = std::move(counts.days);
    return {};
}

Result<void> add_packs(CopyFiles& files, const CopyPlaces& places) {
    TRY(files.library, open_tree(places.library));
    const Outcome<library::SetFile> set = library::read_set_file(*files.library);
    if (!set) {
        return bad_input("copy.set_file", "{}", set.error().reason);
    }
    const Outcome<std::optional<library::SetVerdict>> verdict = library::read_verdict(*files.library);
    const library::InstalledSet& shown =
        library::set_to_show(set->choice, verdict ? *verdict : std::optional<library::SetVerdict>());
    for (const library::InstalledPack& pack : shown.packs) {
        const std::string name = pack.id.empty() ? pack.sha256.substr(0, 12) : pack.id;
        files.packs.push_back(
            {fmt::format("{:03}-{}.fspack", files.packs.size() + 1, name), pack.file, pack.bytes});
    }
    return {};
}

} // namespace

Outcome<std::optional<kiosk_copy::CopyRequest>> copy_asked_for(const CopyPlaces& places,
                                                               std::chrono::sys_days clock) {
    if (places.stick.empty()) {
        return std::optional<kiosk_copy::CopyRequest>();
    }
    const Result<std::unique_ptr<WritableTree>> stick = open_tree(places.stick);
    if (!stick) {
        return tl::unexpected<library::ImportFailure>(library::ImportFailure{
            .refusal = library::ImportRefusal::Unreadable, .reason = stick.error().message, .whole = false});
    }
    const FileResult<std::string> request =
        read_text(**stick, library::copy_request_name, library::max_copy_request_bytes);
    if (!request && request.error().number == ENOENT) {
        return std::optional<kiosk_copy::CopyRequest>(); // so damaged settings are no obstacle to a report
    }
    if (library::waits_for_staff(**stick)) {
        return places.confirmed ? std::optional(kiosk_copy::whole_copy())
                                : std::optional<kiosk_copy::CopyRequest>();
    }
    const Result<settings::CheckedSettings> settings = settings::load_settings(places.config);
    if (!settings) {
        return failed(settings.error());
    }
    return kiosk_copy::read_copy_request(**stick, (*settings)->exhibit.keys, host_name(),
                                         today_of(places, clock));
}

Result<CopyFiles> copy_files(const kiosk_copy::CopyRequest& request, const CopyPlaces& places) {
    CopyFiles files;
    kiosk_copy::KioskCopy copy;
    if (request.settings) {
        TRY_VOID(add_settings(request, places, copy, files.texts));
    }
    if (request.calibration) {
        TRY_VOID(add_calibration(places, copy, files.texts));
    }
    if (request.counts) {
        TRY_VOID(add_counts(places, copy, files.texts));
    }
    if (!files.texts.empty()) {
        TRY(const Bytes bytes, kiosk_copy::write_kiosk_copy(copy));
        files.texts.push_back({std::string(library::kiosk_copy_name), std::string(as_text(bytes))});
    }
    if (request.packs) {
        TRY_VOID(add_packs(files, places));
    }
    return files;
}

} // namespace frustumscreen::programs
