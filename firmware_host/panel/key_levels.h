/// Levels of keyboard keys, from the bytes of the kernel's event device.
///
/// Bytes    struct input_event of linux/input.h, one after the other; a read may split one anywhere.
/// Threads  values; one caller.
/// Errors   none: other keys and other kinds of events have no effect.
/// Source   Documentation/input/event-codes.rst of Linux (SYN_DROPPED: discard events up to the next
///          SYN_REPORT, and query the state again).
#pragma once

#include <linux/input.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::panel {

class KeyLevels {
public:
    /// `codes`: KEY_... of the keys to follow, one for each level.
    explicit KeyLevels(std::vector<std::uint16_t> codes) : codes_(std::move(codes)), down_(codes_.size()) {}

    /// True: the kernel dropped events; call `set` with its current levels.
    bool take(std::span<const std::byte> bytes);
    /// `keys` as EVIOCGKEY returns them: bit k % 8 of byte k / 8 is set if key k is down.
    void set(std::span<const std::byte> keys);
    [[nodiscard]] bool down(std::size_t which) const { return down_[which] != 0; }

private:
    bool take(const input_event& event);

    std::vector<std::uint16_t> codes_;
    std::vector<std::uint8_t> down_;
    std::array<std::byte, sizeof(input_event)> part_{}; ///< an incomplete event
    std::size_t part_bytes_ = 0;
    bool dropped_ = false; ///< until the next report
};

} // namespace frustumscreen::panel
