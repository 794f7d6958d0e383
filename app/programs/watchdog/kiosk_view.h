/// Observes the kiosk from outside the exhibit: its status file, its control group, the kernel's own files.
///
/// Places   absolute paths, all under `root`, so a test can have its own kiosk.
/// Threads  one caller. Reads only small files of the kernel and in memory, and the free space of the data's
///          disk, which the kernel also keeps in memory.
/// Errors   none: an unreadable value counts as good, or as absent, as its field says (app/watch/outcome.h).
#pragma once

#include "app/watch/crash.h"
#include "app/watch/ladder.h"
#include "app/watch/outcome.h"
#include "app/watch/service_ends.h"
#include "firmware_host/base/time.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen::programs {

struct KioskPlaces {
    std::filesystem::path root = "/";
    std::filesystem::path status = "run/frustumscreen/status.json";
    std::filesystem::path ends = "run/frustumscreen/ends";
    std::filesystem::path safe_alive = "run/frustumscreen-safe/alive";
    std::filesystem::path group = "sys/fs/cgroup/system.slice/frustumscreen.service";
    std::filesystem::path device = "dev/frustumscreen/tracker"; ///< made by udev while one is plugged in
    std::filesystem::path crashes = "var/cache/frustumscreen/crashes";
    std::filesystem::path last_good = "var/lib/frustumscreen/library/set.txt";
    std::filesystem::path data =
        "var/lib/frustumscreen-watchdog"; ///< on the data disk; the only folder that the watchdog's sandbox
                                          ///< allows it to write
};

class KioskView {
public:
    KioskView(KioskPlaces places, std::string boot_id);

    [[nodiscard]] watch::Outcome look(MonotonicTime now, std::chrono::system_clock::time_point wall_clock);
    /// All capabilities, except whether a reboot can be recorded.
    [[nodiscard]] watch::Capabilities capabilities();
    /// The latest end of the exhibit's process: `watchdog killed KILL`; empty: there was none.
    [[nodiscard]] const std::string& last_end() const { return last_end_; }
    /// The latest end as a clause for the staff, with the place of a crash; empty: there was none.
    [[nodiscard]] std::string why_it_ended() const;

private:
    [[nodiscard]] std::optional<watch::ExhibitSays> exhibit(MonotonicTime now) const;
    void count_ends();

    KioskPlaces places_;
    std::string boot_id_;
    std::uint64_t ends_read_ = 0; ///< bytes read of the file of ends
    std::uint32_t failures_ = 0;
    std::string last_end_;
    std::optional<watch::ServiceEnd> last_failure_;
    std::filesystem::file_time_type set_changed_; ///< this and the next: the library's set at the last look
    std::uintmax_t set_bytes_ = 0;
    bool has_last_good_ = false;
};

/// Faults that no action remedies, each as a sentence for the staff.
[[nodiscard]] std::vector<std::string> notes_of(const watch::Outcome& outcome);

} // namespace frustumscreen::programs
