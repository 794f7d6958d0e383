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

namespace frustumscreen::kiosk_copy {

namespace {

template <typename T> using Outcome = tl::expected<T, library::ImportFailure>;
using Today = std::optional<std::chrono::sys_days>;

tl::unexpected<library::ImportFailure> failed(library::ImportRefusal refusal, std::string reason) {
    return tl::unexpected<library::ImportFailure>(
        library::ImportFailure{.refusal = refusal, .reason = std::move(reason), .whole = false});
}

/// The parts of a copy that were new to the kiosk, in words.
using News = std::vector<std::string>;

Outcome<void> take_days(const KioskCopy& copy, const KioskFolders& kiosk, Today today, News& news) {
    std::size_t taken = 0;
    for (const counts::DayCounts& counts : copy.days) {
        std::error_code unknown;
        const bool is_over = !today || *counts.day < *today;
        if (!is_over || std::filesystem::exists(counts::file_of_day(kiosk.counts, counts.day), unknown)) {
            continue;
        }
        if (const Result<void> kept = counts::keep_day(kiosk.counts, counts); !kept) {
            return failed(library::ImportRefusal::Unwritable, kept.error().message);
        }
        ++taken;
    }
    if (taken > 0) {
        news.push_back(fmt::format("visits of {} days", taken));
    }
    return {};
}

/// As the kiosk that was copied has it, or as this one has kept it: digits differ, as rotations are written as matrices.
bool is_newest(WritableTree& folder, const std::string& copied, const settings::Calibration& calibration) {
    const Result<std::vector<settings::KeptCalibration>> kept = settings::list_calibrations(folder);
    if (!kept || kept->empty()) {
        return false;
    }
    const FileResult<std::string> newest =
        read_text(folder, kept->front().name, settings::largest_calibration_bytes);
    return newest && (*newest == copied || *newest == settings::calibration_text(calibration));
}

Outcome<void> take_calibration(const KioskCopy& copy, WritableTree& folder, News& news) {
    if (!copy.calibration) {
        return {};
    }
    const Result<settings::Calibration> calibration =
        settings::parse_calibration(*copy.calibration, library::kiosk_copy_name);
    if (calibration && is_newest(folder, *copy.calibration, *calibration)) {
        return {};
    }
    const Result<void> kept = calibration.and_then([&](const settings::Calibration& checked) {
        return without_value(settings::keep_calibration(folder, checked));
    });
    if (!kept) {
        return failed(library::ImportRefusal::Unwritable, kept.error().message);
    }
    news.emplace_back("calibration");
    return {};
}

Outcome<void> take_settings_in(const KioskCopy& copy, WritableTree& folder, const library::OwnSettings& own,
                               News& news) {
    if (!copy.settings) {
        return {};
    }
    TRY(const library::ImportOutcome outcome, library::replace_settings(folder, own, *copy.settings));
    if (outcome == library::ImportOutcome::Taken) {
        news.emplace_back("settings");
    }
    return {};
}

/// The serial to keep, once the copy is known to be whole.
std::uint64_t serial_of(const library::SignedText& file, const KioskCopy& copy,
                        const library::OwnSettings& own, std::uint64_t trusted) {
    if (!own.keys.empty() || !copy.settings) {
        return trusted;
    }
    const Result<settings::CheckedSettings> settings =
        settings::parse_settings(*copy.settings, library::kiosk_copy_name);
    return settings ? library::serial_of_first(library::kiosk_copy_name, file, (*settings)->exhibit.keys) : 0;
}

Outcome<void> take(const library::SignedText& file, const KioskFolders& kiosk, Today today, News& news) {
    TRY(const library::OwnSettings own, library::read_own_settings(kiosk.settings));
    TRY(const std::uint64_t trusted, library::serial_of_trusted(library::kiosk_copy_name, file, own, today));
    const Result<KioskCopy> copy = parse_kiosk_copy(as_bytes(*file.text));
    if (!copy) {
        return failed(library::ImportRefusal::NotAPack,
                      fmt::format("{}: {}", library::kiosk_copy_name, copy.error().message));
    }
    TRY_VOID(library::keep_serial(kiosk.settings, own, serial_of(file, *copy, own, trusted)));
    TRY_VOID(take_days(*copy, kiosk, today, news));
    TRY_VOID(take_calibration(*copy, kiosk.calibration, news));
    return take_settings_in(*copy, kiosk.settings, own, news);
}

} // namespace

std::optional<library::ImportedPack> take_kiosk_copy(FileTree& stick, const KioskFolders& kiosk,
                                                     Today today) {
    const Outcome<library::SignedText> file =
        library::read_signed_text(stick, library::kiosk_copy_name, max_kiosk_copy_bytes);
    if (file && !file->text) {
        return std::nullopt;
    }
    News news;
    const Outcome<void> taken =
        file.and_then([&](const library::SignedText& found) { return take(found, kiosk, today, news); });
    library::ImportedPack line{.file = std::string(library::kiosk_copy_name),
                               .title = "",
                               .outcome = library::ImportOutcome::AlreadyThere,
                               .refusal = {},
                               .reason = ""};
    if (!taken) {
        library::refuse(line, taken.error());
        line.reason += news.empty() ? "" : fmt::format("; taken before that: {}", fmt::join(news, ", "));
    } else if (!news.empty()) {
        line.outcome = library::ImportOutcome::Taken;
        line.reason = fmt::format("{}", fmt::join(news, ", "));
    }
    return line;
}

} // namespace frustumscreen::kiosk_copy
