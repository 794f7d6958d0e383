/// A panel that a script operates.
///
/// Time     presses count from `start`. If `repeat` is above zero, the script begins again after that time,
///          which must be later than its last press.
/// Threads  one caller.
#pragma once

#include "firmware_host/panel/panel.h"

#include <vector>

namespace frustumscreen::panel {

struct PanelPress {
    Nanoseconds at{0};
    int button = 0;
};

class ScriptedPanel final : public Panel {
public:
    /// `script` in ascending time.
    ScriptedPanel(std::vector<PanelPress> script, Nanoseconds repeat, MonotonicTime start);

    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<PanelEvent>& events) override;
    [[nodiscard]] std::string name() const override { return "scripted"; }
    [[nodiscard]] std::string_view state() const override {
        return "presses come from a script; no buttons are used";
    }

private:
    std::vector<PanelPress> script_;
    Nanoseconds repeat_;
    MonotonicTime round_start_;
    std::size_t next_ = 0;
};

} // namespace frustumscreen::panel
