/// The button panel: which button a visitor pressed, and when. Threads: one caller; `poll` never blocks.
#pragma once

#include "firmware_host/base/device_state.h"
#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

enum class PressKind : std::uint8_t {
    Press,
    LongPress, ///< follows the press while the button is still down
    Chord,     ///< first and last button held together by staff, as their presses were; `button` is the first
    Stuck,     ///< down longer than anyone presses: it counts as broken and is ignored
    Chatters,  ///< up and down more often than anyone needs: it counts as broken and is ignored
    Freed,     ///< a stuck button came up, or one that chattered was quiet: it counts again
};

struct PanelEvent {
    MonotonicTime time;
    int button = 0; ///< from 0; the panel does not know what it means
    PressKind kind = PressKind::Press;
};

class Panel {
public:
    virtual ~Panel() = default;
    /// Appends the events with time <= now that were not handed out before.
    [[nodiscard]] virtual Result<void> poll(MonotonicTime now, std::vector<PanelEvent>& events) = 0;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Whether the first and the last button are down now, as staff hold them for the chord: their presses were reported, and neither
    /// is let go. False where nobody knows.
    [[nodiscard]] virtual bool chord_held(MonotonicTime /*now*/) const { return false; }
    /// The state of the device, or of what replaces it, in one plain sentence that is valid until the next
    /// `poll`; empty: there is nothing to say.
    [[nodiscard]] virtual std::string_view state() const { return {}; }
    /// Whether the device that the settings ask for can be used; its id is that of the sentence that `state` says.
    [[nodiscard]] virtual DeviceCondition condition() const { return {}; }
    /// Lights the lamps of the buttons that do something, bit k = button k; it does not wait for them.
    virtual void light(std::uint32_t /*buttons*/) {}
    /// Until when its thread has promised to be heard from again; nothing: it has none.
    [[nodiscard]] virtual std::optional<MonotonicTime> alive_until() const { return {}; }
};

} // namespace frustumscreen
