#include "app/programs/watchdog/kiosk_view.h"

#include "app/programs/watchdog/exhibit_status.h"
#include "app/watch/machine.h"
#include "app/watch/service_ends.h"
#include "firmware_host/base/calendar_day.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/folder_entries.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace frustumscreen::programs {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_status_bytes = 1 << 20;
constexpr std::streamsize max_ends_bytes = 1 << 16; ///< per look; the rest follows at the next look
constexpr double longest_end_s = 10.0; ///< from a crash until systemd has recorded the end of the process
constexpr double full_disk = 0.03;
constexpr double worn_disk = 0.8;
constexpr double hot_c = 90.0;

std::string first_line(const fs::path& file) {
    std::string line;
    std::getline(std::ifstream(file), line);
    return line;
}

/// The number at the beginning of a file; `otherwise` if there is none.
double number_in(const fs::path& file, double otherwise) {
    double value = 0.0;
    std::ifstream stream(file);
    return stream >> value ? value : otherwise;
}

/// The number after a key at the beginning of a line: `MemTotal: 123 kB`, `anon 123`.
double value_of(const fs::path& file, std::string_view key, double otherwise) {
    std::ifstream stream(file);
    for (std::string word; stream >> word;) {
        double value = 0.0;
        if (word == key && stream >> value) {
            return value;
        }
        stream.clear();
        std::getline(stream, word);
    }
    return otherwise;
}

/// Calls `visit` for each entry of a folder whose name begins with `begin`.
template <typename Visit>
void for_each_in(const fs::path& folder, std::string_view begin, const Visit& visit) {
    for (const fs::directory_entry& entry : entries_of(folder)) {
        if (entry.path().filename().string().starts_with(begin)) {
            visit(entry.path());
        }
    }
}

std::int32_t first_process(const fs::path& group) {
    std::ifstream stream(group / "cgroup.procs");
    std::int32_t first = 0;
    for (std::int32_t process = 0; stream >> process;) {
        first = first == 0 ? process : std::min(first, process);
    }
    return first;
}

/// Share of the group's memory limit that its processes hold. Does not count the file cache, which can be
/// released.
double memory_of(const fs::path& group) {
    const double most = number_in(group / "memory.max", 0.0);
    return most > 0.0 ? value_of(group / "memory.stat", "anon", 0.0) / most : 0.0;
}

/// eMMC reports the used part of its lifetime in tenths, for two kinds of cells: `0x01 0x02`.
double worn(const fs::path& root) {
    double worst = 0.0;
    for_each_in(root / "sys/block", "mmcblk", [&](const fs::path& disk) {
        std::ifstream stream(disk / "device/life_time");
        for (std::string tenths; stream >> tenths;) {
            worst = std::max(worst, 0.1 * std::strtod(tenths.c_str(), nullptr));
        }
    });
    return worst;
}

std::optional<bool> projector(const fs::path& root) {
    std::optional<bool> connected;
    for_each_in(root / "sys/class/drm", "card", [&](const fs::path& connector) {
        const std::string status = first_line(connector / "status");
        connected = status.empty() ? connected : connected.value_or(false) || status != "disconnected";
    });
    return connected;
}

/// True if a JSON file has an object under this key, at any depth. Reads from one quotation mark to the next,
/// because the file may be larger than this program's memory limit.
bool has_object(const fs::path& file, std::string_view key) {
    std::ifstream stream(file, std::ios::binary);
    for (std::string piece; std::getline(stream, piece, '"');) {
        if (piece == key && std::getline(stream, piece, '"') && piece.find(':') != std::string::npos) {
            return piece.find('{') != std::string::npos;
        }
    }
    return false;
}

void look_at_disk(const fs::path& folder, watch::Outcome& outcome) {
    if (const std::optional<watch::DiskSpace> disk = watch::disk_space(folder)) {
        outcome.disk_free = disk->free_share();
        outcome.disk_writable = disk->writable;
    }
}

} // namespace

KioskView::KioskView(KioskPlaces places, std::string boot_id)
    : places_(std::move(places)), boot_id_(std::move(boot_id)) {}

std::optional<watch::ExhibitSays> KioskView::exhibit(MonotonicTime now) const {
    const Result<Bytes> text = read_file(places_.root / places_.status, max_status_bytes);
    const std::optional<ExhibitStatus> status =
        text ? read_exhibit_status(as_text(*text)) : std::optional<ExhibitStatus>{};
    if (!status || status->boot_id != boot_id_) {
        return std::nullopt;
    }
    watch::ExhibitSays says = status->says;
    says.age = std::max(now - status->written_at, Nanoseconds(0));
    return says;
}

void KioskView::count_ends() {
    std::ifstream stream(places_.root / places_.ends, std::ios::binary | std::ios::ate);
    const auto size = stream ? static_cast<std::uint64_t>(stream.tellg()) : 0;
    ends_read_ = size < ends_read_ ? 0 : ends_read_; // a new file
    stream.seekg(static_cast<std::streamoff>(ends_read_));
    std::string line;
    for (std::streamsize read = 0; read < max_ends_bytes && std::getline(stream, line) && !stream.eof();) {
        read += std::ssize(line) + 1;
        ends_read_ += line.size() + 1;
        if (const std::optional<watch::ServiceEnd> end = watch::parse_service_end(line);
            end && watch::is_failure(*end)) {
            ++failures_;
            last_end_ = fmt::format("{} {} {}", watch::service_results.at(end->result).word, end->code,
                                    end->exit_status);
            last_failure_ = end;
        }
    }
}

std::string KioskView::why_it_ended() const {
    if (!last_failure_) {
        return {};
    }
    for (const watch::Crash& crash : watch::read_crashes(places_.root / places_.crashes)) {
        const double before_s = last_failure_->monotonic_s - crash.monotonic_s;
        if (crash.boot == boot_id_ && before_s > -longest_end_s && before_s < longest_end_s) {
            return watch::sentence_of(crash);
        }
    }
    return fmt::format("{} ({} {})", watch::service_results.at(last_failure_->result).sentence,
                       last_failure_->code, last_failure_->exit_status);
}

watch::Outcome KioskView::look(MonotonicTime now, std::chrono::system_clock::time_point wall_clock) {
    const fs::path& root = places_.root;
    count_ends();
    watch::Outcome outcome;
    outcome.process = first_process(root / places_.group);
    outcome.failures = failures_;
    outcome.exhibit = exhibit(now);
    const double flips = number_in(root / places_.safe_alive, -1.0);
    outcome.safe_pictures = flips >= 0.0 ? std::optional(static_cast<std::uint64_t>(flips)) : std::nullopt;
    const fs::path memory = root / "proc/meminfo";
    outcome.memory_free =
        value_of(memory, "MemAvailable:", 1.0) / std::max(value_of(memory, "MemTotal:", 1.0), 1.0);
    outcome.exhibit_memory = memory_of(root / places_.group);
    look_at_disk(root / places_.data, outcome);
    outcome.disk_worn = worn(root);
    outcome.hottest_c = watch::hottest_c(root);
    outcome.projector = projector(root);
    outcome.clock_plausible = wall_clock >= earliest_plausible_day;
    return outcome;
}

watch::Capabilities KioskView::capabilities() {
    const fs::path set = places_.root / places_.last_good;
    std::error_code missing;
    const fs::file_time_type changed = fs::last_write_time(set, missing);
    const std::uintmax_t bytes = missing ? 0 : fs::file_size(set, missing);
    if (missing) {
        has_last_good_ = false;
    } else if (changed != set_changed_ || bytes != set_bytes_) {
        has_last_good_ = has_object(set, "last_good");
    }
    set_changed_ = changed;
    set_bytes_ = bytes;
    return {has_last_good_, fs::exists(places_.root / places_.device, missing), false};
}

std::vector<std::string> notes_of(const watch::Outcome& outcome) {
    std::vector<std::string> notes;
    if (outcome.projector == false) {
        notes.emplace_back("no projector is connected; check its cable, and switch it on");
    }
    if (!outcome.disk_writable) {
        notes.emplace_back("the disk can only be read; it may be worn out: have it looked at");
    } else if (outcome.disk_free < full_disk) {
        notes.push_back(fmt::format("the disk has {:.0f} % left; a stick with smaller packs makes room",
                                    100.0 * outcome.disk_free));
    }
    if (outcome.disk_worn > worn_disk) {
        notes.push_back(
            fmt::format("{:.0f} % of the disk's life is over; have it replaced", 100.0 * outcome.disk_worn));
    }
    if (outcome.hottest_c && *outcome.hottest_c > hot_c) {
        notes.push_back(
            fmt::format("the computer is at {:.0f} degrees Celsius, which is too hot; let air reach it",
                        *outcome.hottest_c));
    }
    if (!outcome.clock_plausible) {
        notes.emplace_back("the clock was never set; the timetable is not kept until it is");
    }
    return notes;
}

} // namespace frustumscreen::programs
