// The contents of the desk's windows: the lens, and each window's place beside its title.
#include "app/exhibit/window_desk.h"
#include "app/geometry/time_curves.h"
#include "app/typography/visitor_side.h"

#include <algorithm>

namespace frustumscreen::exhibit {

void WindowDesk::look_through(MonotonicTime now, const Input& input) {
    if (input.ends_lens) {
        lens_.end();
    }
    const auto newest =
        std::find_if(all().rbegin(), all().rend(), [](const Window& one) { return !one.goes; });
    if (input.hold && !input.ends_lens && newest != all().rend()) {
        lens_window_ = newest->pinned.number;
        lens_.begin(now, {newest->pinned.turn_rad, newest->pinned.zoom}, input.table_from_prop);
    }
    lens_.step(now, input.table_from_prop, input.quarter_turns);
    for (Window& window : all()) {
        PresentedWindow& pinned = window.pinned;
        if (pinned.number != lens_window_ || window.goes) {
            continue;
        }
        if (lens_.on() || pinned.follows) {
            pinned.turn_rad = lens_.view().turn_rad;
            pinned.zoom = lens_.view().zoom;
        }
        if (pinned.follows && !lens_.on()) {
            pinned.comings += pinned.comings > 0 ? 1 : 0; // it is frozen so
        }
        pinned.follows = lens_.on();
    }
}

PresentedWindow WindowDesk::shown(const Window& window) const {
    PresentedWindow shown = window.pinned;
    if (window.title_m.y <= 0.0) {
        return shown;
    }
    const auto& [middle, size, turns] = window.pinned.rectangle;
    const double strip = title_gap_m + window.title_m.y;
    const double depth = size.y - strip;
    shown.rectangle = {middle + typography::turned(glm::dvec2(0.0, 0.5 * strip), turns),
                       place_.size_m * (depth / place_.size_m.y), turns};
    if (window.pinned.state) {
        shown.title = {middle + typography::turned(glm::dvec2(0.0, -0.5 * (depth + title_gap_m)), turns),
                       window.title_m, turns};
    }
    return shown;
}

void WindowDesk::present() {
    presented_ = {};
    obstacle_count_ = 0;
    changing_ = lens_.on();
    for (Window& window : all()) {
        const double light = 1.0 - (1.0 - under_sign) * geometry::ease(window.signed_share);
        window.pinned.brightness =
            window.lies ? light * std::min(geometry::ease(window.share), window.clear) : 0.0;
        presented_.add(shown(window));
        if (window.lies) {
            obstacles_.at(obstacle_count_++) = window.pinned.rectangle;
        }
        changing_ = changing_ || !window.lies || window.goes || window.moves || window.share < 1.0 ||
                    (window.signed_share > 0.0 && window.signed_share < 1.0);
    }
}

} // namespace frustumscreen::exhibit
