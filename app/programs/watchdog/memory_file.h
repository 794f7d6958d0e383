/// The ladder's memory on the disk (app/watch/ladder_memory.h).
///
/// Writes   at most one a minute if a value other than the time changed, otherwise every ten minutes, so
///          flash lasts for ten years.
/// Threads  one caller; a write waits for the disk.
/// Errors   none for the caller: while the file cannot be written, no reboot may be done (`can_write_now`).
#pragma once

#include "app/watch/ladder_memory.h"
#include "firmware_host/base/descriptor.h"
#include "firmware_host/base/time.h"

#include <filesystem>

namespace frustumscreen::programs {

class MemoryFile {
public:
    static constexpr Nanoseconds between_writes = std::chrono::minutes(1);
    static constexpr Nanoseconds longest_between_writes = std::chrono::minutes(10);

    /// Creates the file in its full size if it is missing.
    MemoryFile(const std::filesystem::path& file, std::uint64_t boot);

    /// The stored memory; a new one if there is none.
    [[nodiscard]] watch::LadderMemory remembered(watch::Awake since_boot) const;
    [[nodiscard]] bool is_of_this_boot() const { return kept_ && kept_->boot == boot_; }

    [[nodiscard]] bool can_write_now(MonotonicTime now) const;
    /// Writes if a write is due. `at_once`: before a reboot; returns false if it is not on the disk.
    bool keep(MonotonicTime now, watch::Awake since_boot, const watch::LadderMemory& memory, bool at_once);

private:
    Descriptor descriptor_;
    std::uint64_t boot_;
    std::optional<watch::KeptMemory> kept_;
    std::optional<MonotonicTime> tried_at_;
    bool has_failed_ = false;
};

} // namespace frustumscreen::programs
