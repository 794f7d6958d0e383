/// Something that the run loop can put on the display: the exhibit, or the alignment pattern alone.
///
/// Threads  the render thread.
#pragma once

#include "app/drift/drift_watch.h"
#include "app/exhibit/exhibit.h"
#include "app/render/renderer.h"
#include "app/residency/prompt_reader.h"
#include "app/residency/run_levels.h"
#include "app/settings/command.h"
#include "app/show/run_report.h"
#include "app/show/viewfinder.h"
#include "app/tracking/signal_meter.h"
#include "app/tracking/tracked_state.h"
#include "firmware_host/base/time.h"
#include "firmware_host/sound/sound.h"

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
    /// The prop's pose that was drawn for, if it is not the known one.
    std::optional<RigidTransform> stands = {};
    PacksLeftOut left_out = {};
    SharedSetStatus set = {};
    bool library_hangs = false;     ///< as RunStatus
    std::uint32_t lamps = 0;        ///< the buttons that do something, bit k = button k
    std::size_t loaded = 0;         ///< artifacts that can be shown at once
    std::uint64_t loaded_bytes = 0; ///< that they take, and what is on its way
    State state = State::Staff;
    ToldText told = {};
    SharedImport import = {};               ///< what the importer says; none: nothing
    std::optional<MonotonicTime> used = {}; ///< when somebody used it last; nothing: never
    bool calibrate = false;                 ///< in this step the staff asked for the table's calibration
    int louder_db = 0;                      ///< than the settings say, by the staff's buttons
};

class Show {
public:
    virtual ~Show() = default;
    /// Decides what `draw` draws next. `commands`: those since the step before, in their order.
    virtual void step(MonotonicTime /*now*/, std::span<const Command> /*commands*/,
                      const TrackedState& /*on_table*/) {}
    /// Whether it may be dark by the timetable; an alignment pattern may not.
    [[nodiscard]] virtual bool sleeps() const { return false; }
    /// How much light all that is drawn has, 0..1, from the next step on. 0: it is asleep, silent and not drawn.
    virtual void set_light(double /*light*/) {}
    /// A mark of light that a camera looks for, from the next `step` on; nothing: none.
    virtual void set_mark(const std::optional<ShownMark>& /*mark*/) {}
    /// What the camera sees, from the next `draw` on, where the alignment pattern is shown to the staff; none: they do not hold their
    /// buttons, or no camera is used.
    virtual void set_viewfinder(Viewfinder* /*viewfinder*/) {}
    /// How the tracker sees the prop's and the head's sensor; while the staff's picture is shown, before each `step`.
    virtual void set_signal(const TrackerSignal& /*prop*/, const TrackerSignal& /*head*/) {}
    /// What is to be heard.
    [[nodiscard]] virtual const SoundRequest& wish() const {
        static const SoundRequest silence;
        return silence;
    }
    /// Whether it ever has something to say.
    [[nodiscard]] virtual bool speaks() const { return false; }
    /// What is heard.
    virtual void hear(const SoundReport& /*report*/) {}
    /// Tells how the run is: once a second, and when the staff ask.
    virtual void tell(const RunStatus& /*status*/) {}
    /// Draws the picture for `now` where it differs from the one on the display; allocates nothing after the
    /// start.
    [[nodiscard]] virtual DrawResult draw(MonotonicTime now, const TrackedState& on_table,
                                          const RenderTarget& target, Redraw redraw) = 0;
    /// Takes the time of the latest picture drawn, from the poll until it was done, without the wait for a
    /// refresh.
    virtual void record_time(MonotonicTime /*now*/, double /*ms*/) {}
    [[nodiscard]] virtual ShowState state() const = 0;
};

/// Draws what a Presentation says.
class ExhibitStage {
public:
    virtual ~ExhibitStage() = default;
    /// `eye_m`: in table coordinates. Allocates nothing after the start.
    [[nodiscard]] virtual DrawResult draw(MonotonicTime now, const Presentation& presentation,
                                          const glm::dvec3& eye_m, const RenderTarget& target,
                                          Redraw redraw) = 0;
    /// As in Show; it has room.
    virtual void set_mark(const std::optional<ShownMark>& /*mark*/) {}
    /// As in Show.
    virtual void record_time(MonotonicTime /*now*/, double /*ms*/) {}
    [[nodiscard]] virtual ShowState state(const Presentation& presentation) const = 0;
    /// Whether any word can be heard.
    [[nodiscard]] virtual bool speaks() const { return false; }
    /// Of each artifact, whether it can be shown; none: all can.
    [[nodiscard]] virtual std::span<const ArtifactState> artifacts() const { return {}; }
    /// What hides its hotspots; none while it is not there.
    [[nodiscard]] virtual ArtifactTriangles triangles(std::size_t /*artifact*/) const { return {}; }
    /// None: it is silent.
    [[nodiscard]] virtual SharedRecording recording(const WordIndex& /*word*/) const { return nullptr; }
    [[nodiscard]] virtual SharedRecording recording(const DescriptionIndex& /*description*/) const {
        return nullptr;
    }
};

} // namespace frustumscreen
