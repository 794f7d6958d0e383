/// Decides what the exhibit shows, from the pressed buttons and the poses of prop and eye.
///
///     commands, situation -> step -> events -> state -> Presentation
///
/// Each part decides one thing; the exhibit keeps the state and the order of a step. It takes the values of catalogue.h
/// and returns those of presentation.h, which are all that the code that draws, lights lamps or reports needs.
///
/// States   all are in app/exhibit/states.h; the state determines what is said and where.
/// Rest     after `ExhibitPlace::rest` without a visitor, the artifacts are shown in turn, in the house's language.
///          The first touch ends this, and the artifact on show stays.
/// Staff    Command::StaffMode shows and ends the staff picture; its buttons and its time limit are in staff_tool.h.
///          Presses take effect at once, as a visitor's must. Presses that turn out to begin the staff's chord are
///          undone, so the staff picture leaves no trace. The staff may ask there for the table's calibration; the
///          program that runs the exhibit starts it, or does not.
/// Room     with a screen behind the table, an object that the prop rests before is chosen as a picture on the table is
///          (object_dwell.h). The caller says which object that is (note_object).
/// Torch    while one is held, two buttons control it: "choose" changes its content, and "behaviour" leaves its light on the
///          object. While the prop rests on a picture or before an object, both buttons keep their usual meaning.
/// Sites    if the artifact is a site, the button "behaviour" brings a region into the prop, then the whole back (site_travel.h).
/// Windows  a button pins what is seen through the prop onto the table (window_desk.h).
/// Frames   table T, metres.
/// Time     `now` never goes back. Fades are closed forms of it; a caption appears from its first step on.
/// Threads  values; one caller. `step` allocates nothing.
/// Errors   none. A catalogue without artifacts shows nothing.
#pragma once

#include "app/exhibit/advice_presenter.h"
#include "app/exhibit/artifact_caption.h"
#include "app/exhibit/artifact_state.h"
#include "app/exhibit/behaviour_title.h"
#include "app/exhibit/behaviour_triggers.h"
#include "app/exhibit/catalogue.h"
#include "app/exhibit/hotspot_labels.h"
#include "app/exhibit/idle_pose.h"
#include "app/exhibit/narrator.h"
#include "app/exhibit/object_dwell.h"
#include "app/exhibit/placeholder.h"
#include "app/exhibit/presence.h"
#include "app/exhibit/presentation.h"
#include "app/exhibit/presses.h"
#include "app/exhibit/selection.h"
#include "app/exhibit/set_change.h"
#include "app/exhibit/shown_catalogue.h"
#include "app/exhibit/site_travel.h"
#include "app/exhibit/staff_tool.h"
#include "app/exhibit/states.h"
#include "app/exhibit/stillness.h"
#include "app/exhibit/table_browser.h"
#include "app/exhibit/torch_lights.h"
#include "app/exhibit/visitor_guide.h"
#include "app/exhibit/window_desk.h"
#include "app/settings/command.h"
#include "app/tracking/tracked_state.h"
#include "app/typography/visitor_side.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::exhibit {

class Exhibit {
public:
    /// Begins in State::Attract with the first artifact, and with the caption that `caption_for` chooses for `language`.
    Exhibit(Catalogue catalogue, const ExhibitPlace& place, const std::string& language, MonotonicTime now);

    /// `commands`: those since the previous step, in order.
    [[nodiscard]] Presentation step(MonotonicTime now, std::span<const settings::Command> commands,
                                    const tracking::TrackedState& tracked_state);
    /// Sets the state of each artifact; before the first call all are ready. An empty list changes nothing.
    void note(std::span<const ArtifactState> states) { catalogue_.note(states); }
    /// The press had an effect outside the exhibit, so a chord must not undo it.
    void forget_press(settings::Command command) { presses_.forget(command); }
    /// Sets the triangles that hide the hotspots of the artifact on show, which need not be loaded; those of other
    /// artifacts are dropped.
    void note_triangles(std::size_t artifact, ArtifactTriangles triangles) {
        catalogue_.note_triangles(artifact, std::move(triangles));
    }
    /// For the next step: the object of the room that the prop is in front of, seen from the eye; none: there is none.
    void note_object(const std::optional<RoomObject>& object) { room_object_ = object; }
    /// `speaking`: something is being spoken, so no spoken advice begins. `narration`: of the description being told.
    void hear(bool speaking, const SpeechProgress& narration = {});
    /// Announces another set of artifacts; `ready`: it can be shown. When it does not disturb the visitor, everything
    /// of this set fades out: in State::Attract with the next turn; while something is told, spoken or chosen,
    /// afterwards, or after `SetChange::longest_wait`, which begins when the other set is first ready.
    void await_set(bool ready) { set_change_.await(ready); }
    /// Withdraws the announced set.
    void await_no_set() { set_change_.await_none(); }
    /// True if everything of this set fades out or is dark.
    [[nodiscard]] bool leaves_set() const { return set_change_.leaves(); }
    /// True if everything of this set is dark; it stays dark.
    [[nodiscard]] bool set_has_left() const { return set_change_.has_left(); }
    /// Replaces the set. `artifact` fades in, in the chosen language if the set has it, and the state is kept.
    /// `table`: lay_out_catalogue of the new catalogue. Returns the previous catalogue. Not for a frame that is being
    /// presented.
    [[nodiscard]] Catalogue show_set(Catalogue catalogue, std::optional<TableBrowser> table,
                                     std::vector<AdviceLanguage> words, std::size_t artifact,
                                     MonotonicTime now);
    /// The time when the prop last moved, or something was pressed or told; nothing: never.
    [[nodiscard]] const std::optional<MonotonicTime>& used() const { return presence_.touched(); }
    /// The chosen artifact; it may not be visible yet.
    [[nodiscard]] std::size_t chosen() const { return selection_.artifact(); }
    /// The chosen language.
    [[nodiscard]] const std::string& language() const { return selection_.language(); }
    /// Sets the volume that the staff chose earlier, in place of the settings'.
    void set_louder_db(int louder_db) { staff_.set_louder_db(louder_db); }
    /// Starts or withdraws the offer to restore the state of delivery, which a stick has requested.
    void offer_reset(bool offered) { staff_.offer_reset(offered); }
    /// Starts or withdraws the offer to copy the kiosk onto a stick that waits for it.
    void offer_copy(bool offered) { staff_.offer_copy(offered); }
    /// Ends the staff mode early, when there is no picture to show.
    void end_staff_mode() { state_ = state_ == State::Staff ? next(state_, Event::Rest) : state_; }

private:
    // From commands and situation to the state: exhibit.cpp.
    void take(settings::Command command, MonotonicTime now);
    void take_chord(MonotonicTime now);
    void offer_what_can_be_shown(MonotonicTime now);
    /// Resets everything that belongs to the visitor, who has gone.
    void rest(MonotonicTime now);
    [[nodiscard]] Observed observe(MonotonicTime now, const tracking::TrackedState& tracked_state,
                                   const DrawnPose& drawn, bool pressed);
    void step_objects(MonotonicTime now, const tracking::TrackedState& tracked_state, bool pressed,
                      Observed& seen);
    void step_table(MonotonicTime now, const tracking::TrackedState& tracked_state, const DrawnPose& drawn,
                    Observed& seen);
    void step_guide(MonotonicTime now, const tracking::TrackedState& tracked_state, const DrawnPose& drawn);
    /// True while something of the artifact is being told.
    [[nodiscard]] bool tells() const;

    // Change of the set: exhibit_set.cpp.
    [[nodiscard]] static Selection make_selection(const Catalogue& catalogue, const std::string& language,
                                                  MonotonicTime now);
    [[nodiscard]] SetChange::Moment moment_for_set(MonotonicTime now) const;
    void dim_what_leaves(MonotonicTime now, Presentation& presentation) const;

    // From the state to the presentation: exhibit_shows.cpp.
    /// True if an artifact is not ready, or fades.
    [[nodiscard]] bool waits() const { return has_artifact() && placeholder_.waits(); }
    /// Behind the staff picture everything goes on except narration.
    [[nodiscard]] bool has_artifact() const { return !catalogue_.all().empty() && state_ != State::Fault; }
    [[nodiscard]] Presentation present(MonotonicTime now, const tracking::TrackedState& tracked_state,
                                       const DrawnPose& drawn, bool pressed);
    [[nodiscard]] WantedArtifacts wanted() const;
    [[nodiscard]] Placeholder::Output placeholder(MonotonicTime now, const Shown& shown,
                                                  const DrawnPose& drawn);
    [[nodiscard]] std::optional<PresentedCaption> caption(MonotonicTime now, const Shown& shown,
                                                          const tracking::TrackedState& tracked_state,
                                                          const DrawnPose& drawn);
    /// Places that a text on the table must keep clear of: the artifacts' pictures, and the caption and label that are placed already.
    struct Obstacles {
        std::array<typography::TableRectangle, typography::CaptionPlacer::max_obstacles> places{};
        std::size_t count = 0;

        void add(const typography::TableRectangle& place) { places.at(count++) = place; }
        [[nodiscard]] std::span<const typography::TableRectangle> all() const {
            return std::span(places).first(count);
        }
    };
    [[nodiscard]] Obstacles obstacles_of(const Presentation& presentation) const;
    [[nodiscard]] std::optional<PresentedHotspot> label(MonotonicTime now, const Shown& shown,
                                                        const tracking::TrackedState& tracked_state,
                                                        const DrawnPose& drawn,
                                                        const Presentation& presentation);
    [[nodiscard]] std::optional<WordIndex> word() const;
    void advise(MonotonicTime now, const tracking::TrackedState& tracked_state, const DrawnPose& drawn,
                Presentation& presentation);
    void tell(MonotonicTime now, const tracking::TrackedState& tracked_state, const Shown& shown,
              const DrawnPose& drawn, bool pressed, Presentation& presentation);
    [[nodiscard]] std::uint32_t lamps() const;

    // Torches: exhibit_torches.cpp.
    /// Handles the presses that control a held torch.
    void take_torch_presses();
    /// Steps the torches' lights, and dims the artifact while a torch is held. Needs `presentation.brightness`.
    void throw_light(MonotonicTime now, const tracking::TrackedState& tracked_state, const Shown& shown,
                     const DrawnPose& drawn, Presentation& presentation);
    /// The advice to a visitor whose torch lights nothing; none: no advice.
    [[nodiscard]] std::optional<WordIndex> torch_word() const;
    [[nodiscard]] std::uint32_t torch_lamps() const;
    /// The title of the held torch's content, as an index among the titles of behaviours; none: it has no title.
    [[nodiscard]] std::optional<TitleIndex> content_title(const CatalogueEntry& entry, std::size_t artifact,
                                                          std::size_t language, glm::dvec2& size_m) const;

    // Sites: exhibit_sites.cpp.
    /// Handles the press of the button that controls the site.
    void travel(MonotonicTime now, const tracking::TrackedState& tracked_state, const Shown& shown,
                const DrawnPose& drawn, Presentation& presentation);
    /// Places the site's map beside everything else on the table, while the prop shows a part of the site.
    void place_map(MonotonicTime now, const tracking::TrackedState& tracked_state, const Shown& shown,
                   const DrawnPose& drawn, Presentation& presentation);
    [[nodiscard]] SiteTravel::Ray pointer(const tracking::TrackedState& tracked_state, const DrawnPose& drawn,
                                          const Presentation& presentation) const;

    // Windows: exhibit_windows.cpp.
    void step_windows(MonotonicTime now, const tracking::TrackedState& tracked_state, const Shown& shown,
                      const DrawnPose& drawn, Presentation& presentation);
    /// The places that captions and signs avoid: pictures to choose from, and windows.
    [[nodiscard]] Obstacles lying_on_table() const;
    /// Places the titles of states in the visitor's language.
    void place_titles(std::string_view language, PresentedWindows& windows) const;
    /// The hint about a press or a hold of the button for windows, each once per visit; none: no hint is due.
    [[nodiscard]] std::optional<WordIndex> window_word() const;

    // Behaviours: exhibit_behaves.cpp.
    void behave(MonotonicTime now, const tracking::TrackedState& tracked_state, const Shown& shown,
                const DrawnPose& drawn, bool pressed, Presentation& presentation);
    [[nodiscard]] std::optional<PresentedTitle> title(MonotonicTime now,
                                                      const tracking::TrackedState& tracked_state,
                                                      const Shown& shown, const DrawnPose& drawn,
                                                      const Presentation& presentation);

    // The sets and artifacts.
    ExhibitPlace place_;
    std::string first_language_;
    ShownCatalogue catalogue_;
    SetChange set_change_;

    // The visitor.
    Presses presses_;
    Selection selection_;
    Presence presence_;
    typography::VisitorSide side_;      ///< the texts on the table are turned to this side
    std::optional<IdlePose> idle_pose_; ///< from the first step on
    StaffTool staff_;

    State state_ = State::Attract;

    // The presentation.
    Placeholder placeholder_;
    std::optional<TableBrowser> table_;
    std::optional<RoomObject> room_object_; ///< that the prop is in front of, in the next step
    ObjectDwell object_dwell_;
    ArtifactCaption caption_;
    HotspotLabels labels_;
    Narrator narrator_;
    VisitorGuide guide_;
    AdvicePresenter advice_;
    Stillness stillness_; ///< of the visitor, for behaviours
    BehaviourTriggers triggers_;
    BehaviourTitle title_;

    std::optional<TorchLights> torches_; ///< none: there is no torch
    TorchAdvice torch_advice_;
    std::optional<TorchAim> torch_says_;               ///< what is wrong with the torch's aim
    bool next_content_ = false, leaves_light_ = false; ///< pressed in this step

    SiteTravel site_;
    BehaviourTitle map_;                ///< finds the map's place
    std::optional<WindowDesk> windows_; ///< none: none can be pinned
    WindowHistory history_;
    std::optional<MonotonicTime> visit_began_; ///< of the visitor who is there
    bool has_pinned_ = false;                  ///< in this visit
    std::optional<MonotonicTime> first_pin_;   ///< of the visit
    bool has_turned_ = false;                  ///< through the lens, in this visit
    bool invites_to_pin_ = false, invites_to_turn_ = false;
};

} // namespace frustumscreen::exhibit
