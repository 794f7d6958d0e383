/// Keys of a keyboard as levels, from the bytes of the kernel's event device.
///
/// Bytes    struct input_event of linux/input.h, one after the other; a read may cut one anywhere.
/// Threads  values; one caller.
/// Errors   none: keys that nobody asked for and events of other kinds change nothing.
/// Source   Documentation/input/event-codes.rst of Linux (SYN_DROPPED: events up to the next SYN_REPORT are
///          not to be used, and the state is to be asked for anew).
#pragma once

#include <linux/input.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen {

class KeyLevels {
public:
    /// `codes`: KEY_... of the keys that count, one each level.
    explicit KeyLevels(std::vector<std::uint16_t> codes) : codes_(std::move(codes)), down_(codes_.size()) {}

    /// True: the kernel dropped events; `set` must be called with the levels that it reports now.
    bool take(std::span<const std::byte> bytes);
    /// As EVIOCGKEY answers: bit k of byte k / 8, from the lowest, is set where key k is down.
    void set(std::span<const std::byte> keys);
    [[nodiscard]] bool down(std::size_t which) const { return down_[which] != 0; }

private:
    bool take(const input_event& event);

    std::vector<std::uint16_t> codes_;
    std::vector<std::uint8_t> down_;
    std::array<std::byte, sizeof(input_event)> part_{}; ///< an event whose end is still to come
    std::size_t part_bytes_ = 0;
    bool dropped_ = false; ///< until the next report
};

} // namespace frustumscreen
