/// The button panel: which button a visitor pressed, and when. Threads: one caller; `poll` never blocks.
#pragma once

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
    Chord,     ///< first and last button held together: staff, as were their presses; `button` is the first
    Stuck,     ///< down longer than anyone presses: it counts as broken and is ignored
    Chatters,  ///< up and down more often than anyone has a use for: it counts as broken and is ignored
    Freed,     ///< a stuck button came up, or one that chattered was quiet: it counts again
};

struct PanelEvent {
    MonotonicTime time;
    int button = 0; ///< from 0; what it means is none of the panel's business
    PressKind kind = PressKind::Press;
};

class Panel {
public:
    virtual ~Panel() = default;
    /// Appends the events with time <= now that were not handed out before.
    [[nodiscard]] virtual Result<void> poll(MonotonicTime now, std::vector<PanelEvent>& events) = 0;
    [[nodiscard]] virtual std::string name() const = 0;
    /// How the device is, or what stands in its place, in one plain sentence that stands until the next
    /// `poll`; empty: there is nothing to say.
    [[nodiscard]] virtual std::string_view state() const { return {}; }
    /// The buttons that do something, bit k = button k: their lamps are lit. Handed over, not waited for.
    virtual void light(std::uint32_t /*buttons*/) {}
    /// Until when its thread has promised to be heard of again; nothing: it has none.
    [[nodiscard]] virtual std::optional<MonotonicTime> alive_until() const { return {}; }
};

} // namespace frustumscreen
