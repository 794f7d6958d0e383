/// Decides what the exhibit shows, from the pressed buttons and the poses of prop and eye.
///
///     commands, situation -> step -> events -> state -> Presentation
///
/// A Presentation is plain values: the code that draws, lights lamps or reports needs nothing else.
///
/// States   all are in app/exhibit/states.h; the state determines what is said and where.
/// Rest     after `ExhibitPlace::rest` without a visitor, the artifacts are shown in turn, in the house's language.
///          The first touch ends this, and the artifact on show stays.
/// Staff    Command::StaffMode shows and ends the staff picture; its buttons and its time limit are in staff_tool.h.
///          Presses take effect at once, as a visitor's must. Presses that turn out to begin the staff's chord are
///          undone, so the staff picture leaves no trace. The staff may ask there for the table's calibration; the
///          program that runs the exhibit starts it, or does not.
/// Frames   table T, metres.
/// Time     `now` never goes back. Fades are closed forms of it; a caption appears from its first step on.
/// Threads  values; one caller. `step` allocates nothing.
/// Errors   none. A catalogue without artifacts shows nothing.
#pragma once

#include "app/exhibit/advice_sign.h"
#include "app/exhibit/artifact_state.h"
#include "app/exhibit/attract.h"
#include "app/exhibit/description_shape.h"
#include "app/exhibit/hotspot_labels.h"
#include "app/exhibit/narrator.h"
#include "app/exhibit/notice_place.h"
#include "app/exhibit/placeholder.h"
#include "app/exhibit/presence.h"
#include "app/exhibit/selection.h"
#include "app/exhibit/sensed.h"
#include "app/exhibit/sentences.h"
#include "app/exhibit/staff_tool.h"
#include "app/exhibit/states.h"
#include "app/exhibit/table_browser.h"
#include "app/exhibit/zone_frame.h"
#include "app/geometry/prop_shape.h"
#include "app/settings/command.h"
#include "app/tracking/tracked_state.h"
#include "app/typography/captions.h"
#include "app/typography/visitor_side.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// An artifact that can be shown.
struct CatalogueEntry {
    std::vector<std::string> languages; ///< of the captions, BCP 47
    /// For each of `languages`, the caption's sizes: one for each width that it was wrapped to, and again without its
    /// attribution if it has one; in falling preference.
    std::vector<std::vector<glm::dvec2>> caption_sizes_m;
    /// For each of `languages`, what there is to tell, and its size; empty: nothing.
    std::vector<Tellable> tellables{};
    std::vector<DescriptionShape> descriptions{};
    HotspotSet hotspots{};
    /// The corners of the hull of the artifact in the prop (pack/pack_hull.h), prop frame; empty: unknown, and every
    /// face in view counts.
    std::vector<glm::dvec3> hull{};
    std::optional<ZoneFrame> zone{}; ///< where the artifact is seen whole; none: the place's zone
};
using Catalogue = std::vector<CatalogueEntry>;

/// The exhibit's place: prop, projector and table.
struct ExhibitPlace {
    PropShape prop;
    glm::dvec3 lens_m{0.0};            ///< the projector's
    std::vector<glm::dvec2> picture_m; ///< the part of the table that the projector's picture covers, convex
    ZoneFrame zone;                    ///< none by default
    glm::dvec2 attract_place_m{0.0};   ///< where the artifact stands while the prop's pose is unknown
    std::size_t buttons = button_commands.size(); ///< of the panel; the chord is the first and the last
    std::optional<GuidanceSetup> guidance;        ///< none: no guidance
    std::vector<AdviceLanguage> words;            ///< empty: guidance has no words
    bool staff_stays = false;                     ///< there is no calibration: as StaffTool
    bool table_pictures = false;                  ///< the set's artifacts lie on the table to choose from
    Nanoseconds rest = std::chrono::seconds(60);  ///< time without a visitor before State::Attract
};

/// The pictures on the table to choose from; nothing if the place has none. Takes some tens of milliseconds.
[[nodiscard]] std::optional<TableBrowser> lay_out_catalogue(const Catalogue& catalogue,
                                                            const ExhibitPlace& place);

struct PresentedCaption {
    std::size_t language = 0; ///< index into CatalogueEntry::languages
    std::size_t shape = 0;    ///< index into its sizes
    TableRectangle rectangle;
    double brightness = 0.0; ///< above 0, up to 1; a factor on linear light
    /// The portion of the description that is shown in place of the short text.
    std::optional<std::size_t> portion = std::nullopt;
};

/// Artifacts that a visitor may see next, most urgent first: the chosen one, the one whose picture the prop rests on,
/// the next, the previous. Some may be equal.
class WantedArtifacts {
public:
    void add(std::size_t artifact) { artifacts_.at(count_++) = artifact; }
    [[nodiscard]] std::span<const std::size_t> artifacts() const {
        return std::span(artifacts_).first(count_);
    }

private:
    std::array<std::size_t, 4> artifacts_{};
    std::size_t count_ = 0;
};

struct Presentation {
    State state = State::Attract;
    State state_before = State::Attract; ///< the latest state other than `state`
    std::size_t artifact = 0;            ///< index into the catalogue
    double brightness = 0.0; ///< of the artifact: 0..1, a factor on linear light; 0 until it is ready
    WantedArtifacts wanted;  ///< to load ahead
    std::optional<PresentedPlaceholder> placeholder; ///< in place of the chosen artifact until that is ready
    std::string_view language;        ///< the caption's, shown or not; valid as long as the exhibit
    std::string_view wanted_language; ///< the chosen one, to load texts ahead; valid as long as the exhibit
    std::optional<PresentedCaption> caption;
    std::optional<PlacedSign> sign;           ///< advice as a picture
    std::optional<PresentedAdvice> advice;    ///< advice in words; an invitation; why nothing is shown
    std::optional<WordIndex> says;            ///< sentence whose speech begins in this step
    bool falls_silent = false;                ///< the sentence being spoken does not apply any more
    std::optional<WordIndex> prepares_word;   ///< sentence that may be spoken next; none while the set leaves
    std::optional<DescriptionIndex> tells;    ///< description to be heard, from its beginning
    bool leaves = false;                      ///< the description before ends at its next pause, else at once
    std::optional<DescriptionIndex> prepares; ///< description that may be heard next
    std::optional<std::size_t> tells_of;      ///< the hotspot pointed out, visible or not
    std::optional<PresentedHotspot> hotspot;  ///< the hotspot's label
    const PresentedTable* table = nullptr;    ///< pictures to choose from; valid until the next step
    std::string_view table_language;          ///< of the table's titles; valid as long as the exhibit
    double set_share = 1.0;                   ///< of the table's pictures: 0..1, a factor on linear light
    double title_brightness = 1.0;            ///< of the table's titles: 0..1, a factor on linear light
    std::optional<PresentedNotice> notice;    ///< notice about a stick; not set by the exhibit
    std::array<TableRectangle, 4> zone_sides{}; ///< of the frame around the zone
    double zone_share = 0.0;        ///< of the frame around the zone: 0..1, a factor on linear light
    RigidTransform table_from_prop; ///< the pose to draw for
    bool attracts = false;          ///< the pose drawn for is not the prop's own
    bool settled = true;            ///< nothing fades: a good moment for a picture
    bool staff = false;             ///< State::Staff: the staff picture is shown instead
    StaffView staff_view;           ///< what the staff picture shows
    std::uint32_t staff_tones = 0;  ///< number of test tones asked for by the staff
    int louder_db = 0;              ///< relative to the settings' volume
    bool calibrate = false;         ///< the staff asked for calibration in this step
    bool reset = false;             ///< the staff confirmed the state of delivery in this step
    std::uint32_t lamps = 0;        ///< buttons that do something; bit k = button k
};

class Exhibit {
public:
    /// How long each artifact is shown while they come in turn.
    static constexpr Nanoseconds turn_time = std::chrono::seconds(20);
    /// How long another set waits for a visitor who is being told something.
    static constexpr Nanoseconds longest_wait = std::chrono::seconds(20);

    /// Begins in State::Attract with the first artifact, and with the caption that `caption_for` chooses for `language`.
    Exhibit(Catalogue catalogue, const ExhibitPlace& place, const std::string& language, MonotonicTime now);

    /// `commands`: those since the previous step, in order.
    [[nodiscard]] Presentation step(MonotonicTime now, std::span<const Command> commands,
                                    const TrackedState& tracked_state);
    /// Sets the state of each artifact; before the first call all are ready. An empty list changes nothing.
    void note(std::span<const ArtifactState> states);
    /// The press did something else that the exhibit does not know of: no chord undoes it.
    void forget_press(Command command) { selected_.at(static_cast<std::size_t>(button_of(command))) = false; }
    /// Sets the triangles that hide the hotspots of the artifact on show, which need not be loaded; those of other
    /// artifacts are dropped.
    void note_triangles(std::size_t artifact, ArtifactTriangles triangles);
    /// `speaking`: something is being spoken, so no spoken advice begins. `narration`: of the description being told.
    void hear(bool speaking, const SpeechProgress& narration = {});
    /// Announces another set of artifacts; `ready`: it can be shown. When it does not disturb the visitor, everything
    /// of this set fades out: in State::Attract with the next turn; while something is told, spoken or chosen,
    /// afterwards, or after `longest_wait`, which begins when the other set is first ready.
    void await_set(bool ready) { set_is_ready_ = ready; }
    /// Withdraws the announced set.
    void await_no_set() {
        set_is_ready_ = false;
        set_waits_since_.reset();
    }
    /// True if everything of this set fades out or is dark.
    [[nodiscard]] bool leaves_set() const { return set_leaves_since_.has_value(); }
    /// True if everything of this set is dark; it stays dark.
    [[nodiscard]] bool set_has_left() const { return set_left_; }
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
    /// Offers the staff the state of delivery, for which a stick has asked, or not any more.
    void offer_reset(bool offered) { staff_.offer_reset(offered); }
    /// Ends the staff mode early, when there is no picture to show.
    void end_staff_mode() { state_ = state_ == State::Staff ? next(state_, Event::Rest) : state_; }

private:
    void take(Command command, MonotonicTime now);
    void take_chord(MonotonicTime now);
    void take_hold(bool first, MonotonicTime now);
    void offer_what_can_be_shown(MonotonicTime now);
    [[nodiscard]] bool ready(std::size_t artifact) const;
    void go_to(State state, MonotonicTime now);
    /// Resets everything that belongs to the visitor, who has gone.
    void rest(MonotonicTime now);
    [[nodiscard]] Observed observe(MonotonicTime now, const TrackedState& tracked_state, const Stand& stand);
    void step_table(MonotonicTime now, const TrackedState& tracked_state, const Stand& stand, Observed& seen);
    /// Nothing if no visitor is present or there is nothing to correct.
    [[nodiscard]] const Guidance* step_guide(MonotonicTime now, const TrackedState& tracked_state,
                                             const Stand& stand);
    [[nodiscard]] bool is_on_way_to_picture(MonotonicTime now);
    [[nodiscard]] const ZoneFrame& zone_of(std::size_t artifact) const;
    /// True while something of the artifact is being told.
    [[nodiscard]] bool tells() const;

    // Change of the set: exhibit_set.cpp.
    [[nodiscard]] static Selection make_selection(const Catalogue& catalogue, const std::string& language,
                                                  MonotonicTime now);
    void follow_set(MonotonicTime now);
    [[nodiscard]] bool may_leave_set(MonotonicTime now) const;
    void dim_what_leaves(MonotonicTime now, Presentation& presentation) const;

    // The contents of the presentation, by state: exhibit_shows.cpp.
    /// Behind the staff picture everything goes on except narration.
    [[nodiscard]] bool has_artifact() const { return !catalogue_.empty() && state_ != State::Fault; }
    [[nodiscard]] Presentation present(MonotonicTime now, const TrackedState& tracked_state,
                                       const Stand& stand, bool pressed);
    [[nodiscard]] WantedArtifacts wanted() const;
    [[nodiscard]] Placeholder::Output placeholder(MonotonicTime now, const Shown& shown, const Stand& stand);
    [[nodiscard]] std::optional<PresentedCaption>
    caption(MonotonicTime now, const Shown& shown, const TrackedState& tracked_state, const Stand& stand);
    [[nodiscard]] std::optional<PresentedHotspot> label(MonotonicTime now, const Shown& shown,
                                                        const TrackedState& tracked_state, const Stand& stand,
                                                        const Presentation& presentation);
    [[nodiscard]] std::string_view language_of(std::size_t artifact) const;
    [[nodiscard]] std::optional<WordIndex> word() const;
    void present_words(MonotonicTime now, const TrackedState& tracked_state, const Stand& stand,
                       Presentation& presentation);
    void speak(MonotonicTime now, const std::optional<WordIndex>& word, Presentation& presentation);
    void tell(MonotonicTime now, const TrackedState& tracked_state, const Shown& shown, const Stand& stand,
              bool pressed, Presentation& presentation);
    [[nodiscard]] DescriptionIndex description_of(std::size_t artifact, std::string_view language) const;
    /// Null: there is nothing to tell.
    [[nodiscard]] const Tellable* tellable(const DescriptionIndex& description) const;
    [[nodiscard]] std::uint32_t lamps() const;

    Catalogue catalogue_;
    ExhibitPlace place_;
    std::string house_language_;
    Selection selection_;
    std::vector<ArtifactState> ready_;
    std::vector<bool> offered_;    ///< by artifact: offered by selection and table
    std::size_t triangles_of_ = 0; ///< the artifact whose triangles are noted
    Placeholder placeholder_;
    State state_ = State::Attract;
    State state_before_ = State::Attract;
    StaffTool staff_;
    MonotonicTime state_since_;
    MonotonicTime next_turn_;        ///< when the next artifact comes, in State::Attract
    std::optional<Attract> attract_; ///< from the first step on
    Presence presence_;
    Sensed sensed_;
    std::optional<Guide> guide_;
    const Guidance* guidance_ = nullptr;     ///< of this step
    std::optional<MonotonicTime> way_since_; ///< since when the prop has been moving
    std::optional<PlacedSign> sign_;         ///< of the latest step
    Sentences sentences_;
    bool speaking_ = false;           ///< speech is heard
    bool speech_due_ = false;         ///< until the words are visible on the table
    std::optional<WordIndex> spoken_; ///< the sentence that may still be heard
    VisitorSide side_;                ///< the texts on the table are turned to this side
    SpeechProgress narration_;
    Narrator narrator_;
    bool choose_ = false;       ///< pressed, not handled yet
    bool help_ = false;         ///< as `choose_`
    bool answer_comes_ = false; ///< advice for the visitor who pressed it is being searched
    bool there_ = false;        ///< a visitor is present
    std::optional<TableBrowser> table_;
    CaptionPlacer placer_;
    HotspotLabels labels_;
    bool waits_ = false; ///< the artifact was not ready in the latest step
    bool set_is_ready_ = false;
    bool set_left_ = false;
    std::optional<MonotonicTime> set_waits_since_, set_leaves_since_;
    const std::vector<glm::dvec2>* placed_ = nullptr; ///< the sizes that `placer_` has been given
    /// By button: its latest press reached the selection.
    std::array<bool, button_commands.size()> selected_{};
};

} // namespace frustumscreen
