/// Decides which artifacts, and which of their texts, are in memory: a pure function, one step at a time.
///
/// Needed and then wanted items are visited once in order of urgency: each item that fits the rest of the
/// budget should be in memory. Needed items are always loaded, because they are shown or a visitor waits for
/// them; only they may exceed the budget. Other loaded items stay while the budget allows, and the least
/// recently shown is released first.
///
/// Units    bytes.
/// Threads  pure; allocates nothing.
/// Errors   none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace frustumscreen::residency {

struct ResidentItem {
    std::uint64_t bytes = 0;      ///< bytes that it takes, or would take
    bool loaded = false;          ///< takes its bytes, or part of them
    bool left_out = false;        ///< cannot be loaded
    std::uint64_t last_shown = 0; ///< larger = later; 0 = never
};

/// At most one field is set. Call again after the step; neither is set: nothing is left to do.
struct ResidencyStep {
    std::optional<std::size_t> release; ///< set first if bytes must be freed
    std::optional<std::size_t> load;    ///< it fits
    [[nodiscard]] bool operator==(const ResidencyStep&) const = default;
};

/// `needed`, `wanted`: the most urgent first; they may name an item twice.
[[nodiscard]] ResidencyStep next_step(std::span<const ResidentItem> items,
                                      std::span<const std::size_t> needed,
                                      std::span<const std::size_t> wanted, std::uint64_t budget);

} // namespace frustumscreen::residency
