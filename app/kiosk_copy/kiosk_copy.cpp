#include "app/kiosk_copy/kiosk_copy.h"

#include "app/counts/counts_folder.h"
#include "app/library/stick_settings.h"
#include "app/pack/container/zip_archive.h"
#include "app/settings/calibration.h"
#include "app/settings/settings.h"
#include "firmware_host/base/calendar_day.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace frustumscreen::kiosk_copy {

namespace {

using pack::Packing;
using pack::ZipEntry;
using pack::ZipReader;
using pack::ZipWriter;

constexpr std::string_view format_name = "format.txt";
constexpr std::string_view format_line = "FrustumScreen kiosk copy 1\n";
constexpr std::string_view calibration_name = "calibration.toml";
constexpr std::string_view counts_folder = "counts/";
constexpr std::string_view day_ending = ".json";
constexpr std::size_t max_day_bytes = 1U << 20U;

std::string name_of_day(std::chrono::sys_days day) {
    return fmt::format("{}{}{}", counts_folder, text_of_day(day), day_ending);
}

/// Nothing unless it is the name of a day's counts.
std::optional<std::chrono::sys_days> day_in(std::string_view name) {
    if (!name.starts_with(counts_folder) || !name.ends_with(day_ending)) {
        return std::nullopt;
    }
    name.remove_prefix(counts_folder.size());
    name.remove_suffix(std::min(name.size(), day_ending.size()));
    return parse_day(name);
}

/// 0: no file of a copy has this name.
std::size_t max_bytes_of(std::string_view name) {
    if (name == format_name) {
        return format_line.size();
    }
    if (name == library::settings_file_name) {
        return library::max_stick_settings_bytes;
    }
    if (name == calibration_name) {
        return settings::largest_calibration_bytes;
    }
    return day_in(name) ? max_day_bytes : 0;
}

Result<void> check_sizes(const std::vector<ZipEntry>& entries) {
    std::uint64_t together = 0;
    for (const ZipEntry& entry : entries) {
        const std::size_t most = max_bytes_of(entry.name);
        if (most == 0) {
            return bad_input("kiosk_copy.name", "it has a file {}, which no copy of a kiosk has",
                             printable(entry.name, 60));
        }
        together += entry.bytes;
        if (entry.bytes > most || together > max_unpacked_copy_bytes) {
            return bad_input("kiosk_copy.size",
                             "its file {} is too large; allowed are {} bytes, and {} for all",
                             printable(entry.name, 60), most, max_unpacked_copy_bytes);
        }
    }
    return {};
}

Result<void> check_format(ZipReader& zip) {
    const ZipEntry* const entry = zip.find(format_name);
    if (entry != nullptr) {
        TRY(const Bytes line, zip.read(*entry));
        if (as_text(line) == format_line) {
            return {};
        }
    }
    return bad_input("kiosk_copy.format", "it is not a copy of a kiosk, or a newer version wrote it");
}

Result<void> add_file(KioskCopy& copy, std::string_view name, std::string text) {
    if (name == library::settings_file_name) {
        TRY_VOID(without_value(settings::parse_settings(text, library::settings_file_name)));
        copy.settings = std::move(text);
    } else if (name == calibration_name) {
        TRY_VOID(without_value(settings::parse_calibration(text, calibration_name)));
        copy.calibration = std::move(text);
    } else if (const auto day = day_in(name)) {
        TRY(counts::DayCounts counts, at(std::string(name), counts::parse_day_counts(text)));
        if (counts.day != day) {
            return bad_input("kiosk_copy.day", "{}: it has the numbers of another day", name);
        }
        copy.days.push_back(std::move(counts));
    }
    return {};
}

/// A copy's files in their order, by name.
Result<void> check_limits(const KioskCopy& copy, std::size_t day_bytes, std::size_t packed_bytes) {
    const std::size_t settings = copy.settings ? copy.settings->size() : 0;
    const std::size_t calibration = copy.calibration ? copy.calibration->size() : 0;
    const bool fits = settings <= library::max_stick_settings_bytes &&
                      calibration <= settings::largest_calibration_bytes &&
                      settings + calibration + day_bytes + format_line.size() <= max_unpacked_copy_bytes &&
                      packed_bytes <= max_kiosk_copy_bytes;
    return fits ? Result<void>()
                : bad_input("kiosk_copy.too_large",
                            "the kiosk's settings, calibration and visits are more than a copy may have");
}

} // namespace

Result<Bytes> write_kiosk_copy(const KioskCopy& copy) {
    ZipWriter zip;
    zip.add(std::string(format_name), as_bytes(format_line), Packing::Stored);
    if (copy.settings) {
        zip.add(std::string(library::settings_file_name), as_bytes(*copy.settings), Packing::Deflated);
    }
    if (copy.calibration) {
        zip.add(std::string(calibration_name), as_bytes(*copy.calibration), Packing::Deflated);
    }
    std::size_t day_bytes = 0;
    for (const counts::DayCounts& counts : copy.days) {
        const std::string text = counts::write_day_counts(counts);
        day_bytes += text.size();
        zip.add(name_of_day(counts.day.value()), as_bytes(text), Packing::Deflated);
    }
    TRY(Bytes bytes, zip.finish());
    TRY_VOID(check_limits(copy, day_bytes, bytes.size()));
    return bytes;
}

Result<KioskCopy> parse_kiosk_copy(std::span<const std::byte> bytes) {
    TRY(ZipReader zip, ZipReader::open(bytes));
    TRY_VOID(check_sizes(zip.entries()));
    TRY_VOID(check_format(zip));
    KioskCopy copy;
    for (const ZipEntry& entry : zip.entries()) {
        TRY(const Bytes file, zip.read(entry));
        TRY_VOID(add_file(copy, entry.name, std::string(as_text(file))));
    }
    std::sort(copy.days.begin(), copy.days.end(),
              [](const counts::DayCounts& a, const counts::DayCounts& b) { return a.day < b.day; });
    return copy;
}

} // namespace frustumscreen::kiosk_copy
