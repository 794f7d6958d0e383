#include "app/kiosk_copy/take_kiosk_copy.h"

#include "app/counts/counts_folder.h"
#include "app/kiosk_copy/kiosk_copy.h"
#include "app/library/own_settings.h"
#include "app/library/report_request.h"
#include "app/library/stick_pack.h"
#include "app/settings/kept_calibrations.h"
#include "app/settings/settings.h"
#include "firmware_host/base/tree_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

namespace frustumscreen {

namespace {

template <typename T> using Outcome = tl::expected<T, ImportFailure>;
using Today = std::optional<std::chrono::sys_days>;

tl::unexpected<ImportFailure> failed(ImportRefusal refusal, std::string reason) {
    return tl::unexpected<ImportFailure>(ImportFailure{refusal, std::move(reason), false});
}

/// What of a copy was new to the kiosk, in words.
using News = std::vector<std::string>;

Outcome<void> take_days(const KioskCopy& copy, const KioskFolders& kiosk, Today today, News& news) {
    std::size_t taken = 0;
    for (const DayCounts& counts : copy.days) {
        std::error_code unknown;
        const bool is_over = !today || *counts.day < *today;
        if (!is_over || std::filesystem::exists(file_of_day(kiosk.counts, counts.day), unknown)) {
            continue;
        }
        if (const Result<void> kept = keep_day(kiosk.counts, counts); !kept) {
            return failed(ImportRefusal::Unwritable, kept.error().message);
        }
        ++taken;
    }
    if (taken > 0) {
        news.push_back(fmt::format("visits of {} days", taken));
    }
    return {};
}

/// As the kiosk that was copied has it, or as this one has kept it: digits differ, as rotations are written as matrices.
bool is_newest(WritableTree& folder, const std::string& copied, const Calibration& calibration) {
    const Result<std::vector<KeptCalibration>> kept = list_calibrations(folder);
    if (!kept || kept->empty()) {
        return false;
    }
    const FileResult<std::string> newest = read_text(folder, kept->front().name, largest_calibration_bytes);
    return newest && (*newest == copied || *newest == calibration_text(calibration));
}

Outcome<void> take_calibration(const KioskCopy& copy, WritableTree& folder, News& news) {
    if (!copy.calibration) {
        return {};
    }
    const Result<Calibration> calibration = parse_calibration(*copy.calibration, kiosk_copy_name);
    if (calibration && is_newest(folder, *copy.calibration, *calibration)) {
        return {};
    }
    const Result<void> kept = calibration.and_then(
        [&](const Calibration& checked) { return without_value(keep_calibration(folder, checked)); });
    if (!kept) {
        return failed(ImportRefusal::Unwritable, kept.error().message);
    }
    news.emplace_back("calibration");
    return {};
}

Outcome<void> take_settings_in(const KioskCopy& copy, WritableTree& folder, const OwnSettings& own,
                               News& news) {
    if (!copy.settings) {
        return {};
    }
    TRY(const ImportOutcome outcome, replace_settings(folder, own, *copy.settings));
    if (outcome == ImportOutcome::Taken) {
        news.emplace_back("settings");
    }
    return {};
}

/// The serial to keep, once the copy is known to be whole.
std::uint64_t serial_of(const SignedText& file, const KioskCopy& copy, const OwnSettings& own,
                        std::uint64_t trusted) {
    if (!own.keys.empty() || !copy.settings) {
        return trusted;
    }
    const Result<CheckedSettings> settings = parse_settings(*copy.settings, kiosk_copy_name);
    return settings ? serial_of_first(kiosk_copy_name, file, (*settings)->exhibit.keys) : 0;
}

Outcome<void> take(const SignedText& file, const KioskFolders& kiosk, Today today, News& news) {
    TRY(const OwnSettings own, read_own_settings(kiosk.settings));
    TRY(const std::uint64_t trusted, serial_of_trusted(kiosk_copy_name, file, own, today));
    const Result<KioskCopy> copy = parse_kiosk_copy(as_bytes(*file.text));
    if (!copy) {
        return failed(ImportRefusal::NotAPack, fmt::format("{}: {}", kiosk_copy_name, copy.error().message));
    }
    TRY_VOID(keep_serial(kiosk.settings, own, serial_of(file, *copy, own, trusted)));
    TRY_VOID(take_days(*copy, kiosk, today, news));
    TRY_VOID(take_calibration(*copy, kiosk.calibration, news));
    return take_settings_in(*copy, kiosk.settings, own, news);
}

} // namespace

std::optional<ImportedPack> take_kiosk_copy(FileTree& stick, const KioskFolders& kiosk, Today today) {
    const Outcome<SignedText> file = read_signed_text(stick, kiosk_copy_name, max_kiosk_copy_bytes);
    if (file && !file->text) {
        return std::nullopt;
    }
    News news;
    const Outcome<void> taken =
        file.and_then([&](const SignedText& found) { return take(found, kiosk, today, news); });
    ImportedPack line{std::string(kiosk_copy_name), "", ImportOutcome::AlreadyThere, {}, ""};
    if (!taken) {
        refuse(line, taken.error());
        line.reason += news.empty() ? "" : fmt::format("; taken before that: {}", fmt::join(news, ", "));
    } else if (!news.empty()) {
        line.outcome = ImportOutcome::Taken;
        line.reason = fmt::format("{}", fmt::join(news, ", "));
    }
    return line;
}

} // namespace frustumscreen
