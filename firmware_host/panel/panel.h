/// The button panel: which button a visitor pressed, and when.
///
/// Threads  one caller; `poll` never blocks.
#pragma once

#include "firmware_host/base/device_state.h"
#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::panel {

enum class PressKind : std::uint8_t {
    Press,
    LongPress, ///< follows the press while the button is still down
    Chord,     ///< first and last button held by the staff, after their presses; `button` is the first
    Stuck,     ///< down implausibly long: it counts as broken and is ignored
    Chatters,  ///< implausibly many edges: it counts as broken and is ignored
    Freed,     ///< a stuck button came up, or a chattering one is quiet: it counts again
};

struct PanelEvent {
    MonotonicTime time;
    int button = 0; ///< from 0; its meaning is the client's
    PressKind kind = PressKind::Press;
};

class Panel {
public:
    virtual ~Panel() = default;
    /// Appends the events with time <= now that were not returned yet.
    [[nodiscard]] virtual Result<void> poll(MonotonicTime now, std::vector<PanelEvent>& events) = 0;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Whether the first and the last button are down now, as the staff hold them for the chord; their
    /// presses were reported. False if unknown.
    [[nodiscard]] virtual bool chord_held(MonotonicTime /*now*/) const { return false; }
    /// The state of the device, or of its replacement, in one plain sentence, valid until the next `poll`;
    /// empty if there is nothing to report.
    [[nodiscard]] virtual std::string_view state() const { return {}; }
    /// Whether the device that the settings ask for can be used; its id is that of the sentence that `state` says.
    [[nodiscard]] virtual DeviceCondition condition() const { return {}; }
    /// Lights the lamps of the buttons that do something, bit k = button k; it does not wait for them.
    virtual void light(std::uint32_t /*buttons*/) {}
    /// Time until which the device's thread has promised a sign of life; nullopt: there is no such thread.
    [[nodiscard]] virtual std::optional<MonotonicTime> alive_until() const { return {}; }
};

} // namespace frustumscreen::panel
