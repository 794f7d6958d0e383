/// Anything that the run loop can put on the display: the exhibit, or the alignment pattern alone.
///
/// Threads  the render thread.
#pragma once

#include "app/drift/drift_watch.h"
#include "app/exhibit/exhibit.h"
#include "app/render/renderer.h"
#include "app/residency/prompt_reader.h"
#include "app/residency/run_levels.h"
#include "app/room/taking.h"
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

namespace frustumscreen::show {

/// The torch that was taken last, as it is shown.
struct ShownTorch {
    std::optional<std::size_t> held; ///< 0 the tracker's, 1 a camera's; none: none is in a hand
    std::optional<exhibit::TorchAim> aim;
    bool lit = false;         ///< it gives light to the artifact
    std::string_view content; ///< by its name; empty: none is held
};

/// The contents of a frame, for the status and the report. The texts live as long as the show.
struct ShowState {
    std::string_view artifact; ///< title; empty for the pattern
    std::string_view language;
    residency::LevelState levels;
    bool settled = true; ///< no artifact or caption fades: a good moment for a picture
    /// The prop's pose drawn for, if it is not the known one.
    std::optional<geometry::RigidTransform> stands = {};
    library::UnshownPacks left_out = {};
    status::SharedSetStatus set = {};
    bool library_hangs = false;     ///< as RunStatus
    std::uint32_t lamps = 0;        ///< buttons that do something; bit k = button k
    std::size_t loaded = 0;         ///< artifacts that can be shown at once
    std::uint64_t loaded_bytes = 0; ///< of the loaded artifacts and those being loaded
    exhibit::State state = exhibit::State::Staff;
    ToldText told = {};
    SharedImport import = {};               ///< the importer's report; null: none
    std::optional<ShownTorch> torch = {};   ///< none: there are no torches
    std::optional<MonotonicTime> used = {}; ///< when it was last used; nothing: never
    bool calibrate = false;                 ///< the staff asked for the table's calibration in this step
    bool reset = false;                     ///< the staff confirmed the state of delivery in this step
    bool copy = false;                      ///< the staff confirmed a copy onto a stick in this step
    int louder_db = 0;                      ///< relative to the settings, chosen with the staff's buttons
};

class Show {
public:
    virtual ~Show() = default;
    /// Decides what `draw` draws next. `commands`: those since the previous step, in order.
    virtual void step(MonotonicTime /*now*/, std::span<const settings::Command> /*commands*/,
                      const tracking::TrackedState& /*on_table*/) {}
    /// True if it may be dark by the timetable; an alignment pattern may not.
    [[nodiscard]] virtual bool sleeps() const { return false; }
    /// Sets the factor on all light, 0..1, from the next step on. 0: asleep, silent and not drawn.
    virtual void set_light(double /*light*/) {}
    /// Sets the drift mark that a camera looks for, from the next `step` on; nothing: none.
    virtual void set_mark(const std::optional<drift::ShownMark>& /*mark*/) {}
    /// Sets the camera's picture, from the next `draw` on, for the alignment pattern shown to the staff; null: the
    /// staff do not hold their buttons, or no camera is used.
    virtual void set_viewfinder(Viewfinder* /*viewfinder*/) {}
    /// Sets the tracker's signals of the prop's and the head's sensor; called before each `step` while the staff
    /// picture is shown.
    virtual void set_signal(const tracking::TrackerSignal& /*prop*/,
                            const tracking::TrackerSignal& /*head*/) {}
    /// The objects of the room behind the screen that are not in their places, as of the latest step (room/taking.h).
    [[nodiscard]] virtual std::span<const room::TakenPose> taken() const { return {}; }
    /// The sound to play.
    [[nodiscard]] virtual const sound::SoundRequest& sound_request() const {
        static const sound::SoundRequest silence;
        return silence;
    }
    /// True if it may ever play a sound.
    [[nodiscard]] virtual bool speaks() const { return false; }
    /// Takes the report of what is being played.
    virtual void hear(const sound::SoundReport& /*report*/) {}
    /// Takes the run's status: once a second, and when the staff ask.
    virtual void tell(const RunStatus& /*status*/) {}
    /// Draws the picture for `now` where it differs from the displayed one; allocates nothing after the start.
    [[nodiscard]] virtual render::DrawResult draw(MonotonicTime now, const tracking::TrackedState& on_table,
                                                  const render::RenderTarget& target,
                                                  render::Redraw redraw) = 0;
    /// Takes the time of the latest picture, from the poll until the drawing was done, without the wait for a
    /// refresh.
    virtual void record_time(MonotonicTime /*now*/, double /*ms*/) {}
    [[nodiscard]] virtual ShowState state() const = 0;
};

/// An artifact that the prop can show.
struct ArtifactInProp {
    std::string_view name;       ///< as ShownSet::names
    double metres_per_box = 0.0; ///< longest edge of its box in the prop
};

/// Draws a Presentation.
class PresentationShow {
public:
    virtual ~PresentationShow() = default;
    /// `eyes_m`: one for each eye of the layout (scene/stereo.h), table frame. Allocates nothing after the start.
    [[nodiscard]] virtual render::DrawResult
    draw(MonotonicTime now, const exhibit::Presentation& presentation, std::span<const glm::dvec3> eyes_m,
         const render::RenderTarget& target, render::Redraw redraw) = 0;
    /// As in Show; the caller has checked that the mark has space.
    virtual void set_mark(const std::optional<drift::ShownMark>& /*mark*/) {}
    /// As in Show.
    virtual void record_time(MonotonicTime /*now*/, double /*ms*/) {}
    [[nodiscard]] virtual ShowState state(const exhibit::Presentation& presentation) const = 0;
    /// True if any text can be heard.
    [[nodiscard]] virtual bool speaks() const { return false; }
    /// State of each artifact; empty: all are ready.
    [[nodiscard]] virtual std::span<const exhibit::ArtifactState> artifacts() const { return {}; }
    /// By index into the catalogue; valid until the set changes.
    [[nodiscard]] virtual std::span<const ArtifactInProp> in_prop() const { return {}; }
    /// The triangles that hide an artifact's hotspots; none while it is not loaded.
    [[nodiscard]] virtual exhibit::ArtifactTriangles triangles(std::size_t /*artifact*/) const { return {}; }
    /// The recording to play for a sentence or a description; null: silent.
    [[nodiscard]] virtual residency::SharedRecording recording(const exhibit::WordIndex& /*word*/) const {
        return nullptr;
    }
    [[nodiscard]] virtual residency::SharedRecording
    recording(const exhibit::DescriptionIndex& /*description*/) const {
        return nullptr;
    }
};

} // namespace frustumscreen::show
