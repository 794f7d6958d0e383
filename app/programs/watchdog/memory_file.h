/// The ladder's memory on the disk (app/watch/ladder_memory.h).
///
/// Writes   at most one a minute, so that flash lasts for ten years: when something besides the time changed, else every ten
///          minutes.
/// Threads  one caller; a write waits for the disk.
/// Errors   none for the caller: where it cannot be written, no reboot may be taken (`can_write_now`).
#pragma once

#include "app/watch/ladder_memory.h"
#include "firmware_host/base/descriptor.h"
#include "firmware_host/base/time.h"

#include <filesystem>

namespace frustumscreen {

class MemoryFile {
public:
    static constexpr Nanoseconds between_writes = std::chrono::minutes(1);
    static constexpr Nanoseconds longest_between_writes = std::chrono::minutes(10);

    /// Makes the file in its full size where it is missing.
    MemoryFile(const std::filesystem::path& file, std::uint64_t boot);

    /// As it was left; a new one if there is none.
    [[nodiscard]] LadderMemory remembered(Awake since_boot) const;
    [[nodiscard]] bool is_of_this_boot() const { return kept_ && kept_->boot == boot_; }

    [[nodiscard]] bool can_write_now(MonotonicTime now) const;
    /// Writes if it is time. `at_once`: before a reboot; false: it is not on the disk.
    bool keep(MonotonicTime now, Awake since_boot, const LadderMemory& memory, bool at_once);

private:
    Descriptor descriptor_;
    std::uint64_t boot_;
    std::optional<KeptMemory> kept_;
    std::optional<MonotonicTime> tried_at_;
    bool has_failed_ = false;
};

} // namespace frustumscreen
