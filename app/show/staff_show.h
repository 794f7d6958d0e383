/// The staff picture on the display: its pages, with the current facts.
///
/// Memory   allocated only while the picture is shown.
/// Threads  the render thread, with the display's context current.
/// Errors   the typeface is missing.
#pragma once

#include "app/exhibit/states.h"
#include "app/settings/settings.h"
#include "app/show/pattern_show.h"
#include "app/show/staff_picture.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace frustumscreen::show {

class StaffShow {
public:
    /// Shortest time between changes of live numbers.
    static constexpr Nanoseconds between_signals = std::chrono::milliseconds(300);

    /// `speaks`: a sound device is used. `driver`: the display's name for itself. `before`: the state before the
    /// staff picture.
    [[nodiscard]] static Result<std::unique_ptr<StaffShow>>
    create(const settings::Settings& settings, bool speaks, std::string driver, exhibit::State before);

    /// `gain_db`: the settings' volume for this hour.
    void tell(const RunStatus& status, double gain_db);
    /// Sets how far a copy onto a stick is, from the next `show` on.
    void set_copy(const exhibit::CopyState& copy);
    void set_viewfinder(Viewfinder* viewfinder) { pattern_->set_viewfinder(viewfinder); }
    /// Draws the picture again if it has changed.
    void show(MonotonicTime now, const exhibit::StaffView& view, const tracking::TrackerSignal& prop,
              const tracking::TrackerSignal& head);
    [[nodiscard]] render::DrawResult draw(MonotonicTime now, const tracking::TrackedState& tracked_state,
                                          const render::RenderTarget& target, render::Redraw redraw) {
        return pattern_->draw(now, tracked_state, target, redraw);
    }

private:
    StaffShow(const settings::Settings& settings, typography::Typesetter typesetter,
              std::unique_ptr<PatternShow> pattern);

    const settings::Settings& settings_;
    typography::Typesetter typesetter_;
    std::unique_ptr<PatternShow> pattern_;
    std::string driver_;
    exhibit::State before_ = exhibit::State::View;
    StaffFacts facts_;
    image::Image8 background_; ///< of the page drawn last
    std::optional<std::pair<exhibit::StaffPage, exhibit::StaffLight>> background_of_;
    std::optional<exhibit::StaffView> drawn_; ///< nothing: the drawn picture is out of date
    MonotonicTime signals_at_;
};

} // namespace frustumscreen::show
