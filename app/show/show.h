/// Something that the run loop can put on the display: the exhibit, or the alignment pattern.
///
/// Threads  the render thread.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/render/renderer.h"
#include "app/show/run_levels.h"
#include "app/show/run_report.h"
#include "app/tracking/situation.h"
#include "firmware_host/base/time.h"

#include <optional>
#include <span>
#include <string_view>

namespace frustumscreen {

/// What a frame shows, for the status and the report. The texts live as long as the show.
struct ShowState {
    std::string_view artifact; ///< title; empty for the pattern
    std::string_view language;
    LevelState levels;
    bool settled = true; ///< no artifact or caption fades: a good moment for a picture
    /// The prop's pose that was drawn for, where it is not the one that is known.
    std::optional<RigidTransform> stands = {};
    std::span<const PackLeftOut> left_out = {};
};

class Show {
public:
    virtual ~Show() = default;
    virtual void wish(Wish wish, MonotonicTime now) = 0;
    /// As if the latest such wish had not been.
    virtual void take_back(Wish /*wish*/, MonotonicTime /*now*/) {}
    /// The staff's chord was held; `wish` heard the presses that it began with.
    virtual void chord(MonotonicTime /*now*/, const RunStatus& /*status*/) {}
    /// Once a second, how the run is.
    virtual void tell(const RunStatus& /*status*/) {}
    /// Such a wish changes something.
    [[nodiscard]] virtual bool heeds(Wish /*wish*/) const { return false; }
    /// Draws the picture for `now` where it differs from the one on show; allocates nothing after the start.
    [[nodiscard]] virtual DrawResult draw(MonotonicTime now, const Situation& situation,
                                          const RenderTarget& target, Redraw redraw) = 0;
    /// What the latest picture drawn took, from the poll until it was done; no wait for a refresh in it.
    virtual void took(MonotonicTime /*now*/, double /*ms*/) {}
    [[nodiscard]] virtual ShowState state(MonotonicTime now) const = 0;
};

} // namespace frustumscreen
