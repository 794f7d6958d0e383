/// The ladder's memory as a file. A power cut at any moment leaves the previous or the new state.
///
/// File     two slots of `slot_bytes`, written in turn. Each is a line of text, padded with blanks:
///          `frustumscreen-ladder-2`, a checksum (FNV-1a, 64 bits) of the rest, and whole numbers, -1 for
///          nullopt. A slot is written as a whole, over the older one, in a file of fixed size, so a full
///          disk is no obstacle.
/// Threads  pure; any.
/// Errors   an invalid slot is ignored; two invalid slots mean an empty memory.
/// Source   Fowler, Noll, Vo: the FNV non-cryptographic hash algorithm, draft-eastlake-fnv.
#pragma once

#include "app/watch/ladder.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen::watch {

inline constexpr std::size_t slot_bytes = 4096; ///< a block of the disk
inline constexpr std::size_t slot_count = 2;

struct KeptMemory {
    std::uint64_t writes = 0; ///< a counter; modulo `slot_count` it selects the slot
    std::uint64_t boot = 0;   ///< the boot that wrote it, see `number_of_boot`
    Awake since_boot{0};      ///< time of the write
    LadderMemory memory;
    [[nodiscard]] bool operator==(const KeptMemory&) const = default;
};

/// A slot of exactly `slot_bytes`.
[[nodiscard]] std::string slot_of(const KeptMemory& kept);
[[nodiscard]] std::optional<KeptMemory> read_slot(std::string_view slot);
/// The later one of a file's slots; nullopt: no slot is valid.
[[nodiscard]] std::optional<KeptMemory> read_slots(std::string_view file);
/// Advances `awake` to now: in the same boot by the time since the write, in another one by the time since
/// the boot. The time of operation after the last write is lost.
[[nodiscard]] LadderMemory remembered(const KeptMemory& kept, std::uint64_t boot, Awake since_boot);
/// A number for the kernel's id of a boot (random(4), boot_id).
[[nodiscard]] std::uint64_t number_of_boot(std::string_view boot_id);

} // namespace frustumscreen::watch
