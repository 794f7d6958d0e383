/// The button panel: which button a visitor pressed, and when. Threads: one caller; `poll` never blocks.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"

#include <string>
#include <vector>

namespace frustumscreen {

struct PanelEvent {
    MonotonicTime time;
    int button = 0; ///< 0 = previous artifact, 1 = next artifact, 2 = language
};

class Panel {
public:
    virtual ~Panel() = default;
    /// Appends the events with time <= now that were not handed out before.
    [[nodiscard]] virtual Result<void> poll(MonotonicTime now, std::vector<PanelEvent>& events) = 0;
    [[nodiscard]] virtual std::string name() const = 0;
};

} // namespace frustumscreen
