/// Which artifacts, and which of their texts, are in memory: a pure decision, one step at a time.
///
/// What is needed and what is wanted, in order of urgency, is gone through once: each item that fits into what the budget
/// has left is to be there. What is needed always is, as it is shown or somebody waits for it: it alone may exceed the
/// budget. Whatever else is loaded stays as long as there is room, and what was shown least recently goes first.
///
/// Units    bytes.
/// Threads  pure; allocates nothing.
/// Errors   none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace frustumscreen {

struct ResidentItem {
    std::uint64_t bytes = 0;      ///< that it takes, or would take
    bool loaded = false;          ///< takes them, or part of them
    bool left_out = false;        ///< cannot be loaded
    std::uint64_t last_shown = 0; ///< larger = later; 0 = never
};

/// At most one of the two. Ask again when it has been done; neither: all is as it should be.
struct ResidencyStep {
    std::optional<std::size_t> release; ///< first: room is needed
    std::optional<std::size_t> load;    ///< there is room
    [[nodiscard]] bool operator==(const ResidencyStep&) const = default;
};

/// Both: the most urgent first; they may name an item twice.
[[nodiscard]] ResidencyStep next_step(std::span<const ResidentItem> items,
                                      std::span<const std::size_t> needed,
                                      std::span<const std::size_t> wanted, std::uint64_t budget);

} // namespace frustumscreen
