/// The ladder's memory as a file keeps it, so that a power cut at any moment leaves the former one or the new one.
///
/// File     two slots of `slot_bytes` in turn, each a line of text that is filled up with blanks: `frustumscreen-ladder-2`, a
///          checksum (FNV-1a, 64 bits) of what follows, and whole numbers, -1 for nothing. A slot is written as a whole, over the
///          older one, into a file of fixed size: a full disk does not hinder it.
/// Threads  pure; any.
/// Errors   a slot that is not as above counts for nothing; two such are a kiosk without a past.
/// Source   Fowler, Noll, Vo: the FNV non-cryptographic hash algorithm, draft-eastlake-fnv.
#pragma once

#include "app/watch/ladder.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen {

inline constexpr std::size_t slot_bytes = 4096; ///< a block of the disk
inline constexpr std::size_t slot_count = 2;

struct KeptMemory {
    std::uint64_t writes = 0; ///< a counter; the slot is its remainder
    std::uint64_t boot = 0;   ///< in which it was written, see `number_of_boot`
    Awake since_boot{0};      ///< then
    LadderMemory memory;
    [[nodiscard]] bool operator==(const KeptMemory&) const = default;
};

/// Exactly `slot_bytes`.
[[nodiscard]] std::string slot_of(const KeptMemory& kept);
[[nodiscard]] std::optional<KeptMemory> read_slot(std::string_view slot);
/// The later one of a file's slots; nothing: there is none.
[[nodiscard]] std::optional<KeptMemory> read_slots(std::string_view file);
/// Brings it up to now: in the boot in which it was written the time since then was awake, in another one the time since the
/// boot. What was awake after the last write is lost.
[[nodiscard]] LadderMemory remembered(const KeptMemory& kept, std::uint64_t boot, Awake since_boot);
/// A number for the kernel's name of a boot (random(4), boot_id).
[[nodiscard]] std::uint64_t number_of_boot(std::string_view boot_id);

} // namespace frustumscreen
