#include "firmware_host/panel/scripted_panel.h"

#include <cassert>
#include <utility>

namespace frustumscreen::panel {

ScriptedPanel::ScriptedPanel(std::vector<PanelPress> script, Nanoseconds repeat, MonotonicTime start)
    : script_(std::move(script)), repeat_(repeat), round_start_(start) {
    assert(repeat == Nanoseconds::zero() || script_.empty() || script_.back().at < repeat);
}

Result<void> ScriptedPanel::poll(MonotonicTime now, std::vector<PanelEvent>& events) {
    while (next_ < script_.size() && round_start_ + script_[next_].at <= now) {
        events.push_back({round_start_ + script_[next_].at, script_[next_].button});
        if (++next_ == script_.size() && repeat_ > Nanoseconds::zero()) {
            next_ = 0;
            round_start_ += repeat_;
        }
    }
    return {};
}

} // namespace frustumscreen::panel
