/// Decides what the exhibit shows, from what was pressed and from where the prop and the eye are.
///
///     commands, situation -> step -> events -> state -> Presentation
///
/// A Presentation is plain values: the code that draws, lights lamps or reports needs nothing else.
///
/// States   app/exhibit/states.h has them all; what is said, and where, follows from the state.
/// Rest     after `ExhibitPlace::rest` without anybody the artifacts come in turn, in the house's language. The first touch ends
///          it, and the artifact on show stays.
/// Staff    Command::StaffMode shows the staff's picture, and ends it; what buttons do there, and when it goes by itself, is
///          staff_tool.h's. Presses take effect at once, since a visitor's must. If they turn out to be the beginning of the
///          staff's chord they are undone, so the picture leaves no trace. The staff may ask there for the table's calibration;
///          whoever runs the exhibit sees to it, or not.
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
    std::vector<std::string> languages; ///< of its captions, BCP 47
    /// For each of `languages` the caption's sizes, one for each width that it was wrapped to, and again without its attribution
    /// where it has one; in falling preference.
    std::vector<std::vector<glm::dvec2>> caption_sizes_m;
    /// For each of `languages` what there is to tell, and how large it is; none: there is nothing.
    std::vector<Tellable> tellables{};
    std::vector<DescriptionShape> descriptions{};
    HotspotSet hotspots{};
    /// The artifact in the prop, by the corners of its hull (pack/pack_hull.h), prop frame; none: it is not known, and every seen
    /// face counts.
    std::vector<glm::dvec3> hull{};
    std::optional<ZoneFrame> zone{}; ///< where it is seen whole; none: the place's
};
using Catalogue = std::vector<CatalogueEntry>;

/// The exhibit's place: prop, projector and table.
struct ExhibitPlace {
    PropShape prop;
    glm::dvec3 lens_m{0.0};            ///< the projector's
    std::vector<glm::dvec2> picture_m; ///< what the projector's picture covers of the table, convex
    ZoneFrame zone;                    ///< by default there is none
    glm::dvec2 attract_place_m{0.0};   ///< where the artifact stands while nobody knows where the prop is
    std::size_t buttons = button_commands.size(); ///< of the panel; the chord is the first and the last
    std::optional<GuidanceSetup> guidance;        ///< none: nobody is told what to do
    std::vector<AdviceLanguage> words;            ///< none: guidance has no words
    bool staff_stays = false;                     ///< there is no calibration: as StaffTool
    bool table_pictures = false;                  ///< the set's artifacts lie on the table, to choose from
    Nanoseconds rest = std::chrono::seconds(60);  ///< nobody has been there for so long: attract
};

/// What lies on the table to choose from; nothing where the place has no such pictures. Takes some tens of milliseconds.
[[nodiscard]] std::optional<TableBrowser> lay_out_catalogue(const Catalogue& catalogue,
                                                            const ExhibitPlace& place);

struct PresentedCaption {
    std::size_t language = 0; ///< index into CatalogueEntry::languages
    std::size_t shape = 0;    ///< index into its sizes
    TableRectangle rectangle;
    double brightness = 0.0; ///< above 0, up to 1; a factor on linear light
    /// Of the description, which is shown in place of the short text.
    std::optional<std::size_t> portion = std::nullopt;
};

/// Artifacts that a visitor may see next, the most urgent first: the chosen one, the one that is rested on, the next, the
/// previous. Some may be the same.
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
    State state_before = State::Attract; ///< the latest other one
    std::size_t artifact = 0;            ///< index into the catalogue
    double brightness = 0.0; ///< of the artifact: 0..1, a factor on linear light; 0 while it is not ready
    WantedArtifacts wanted;  ///< to load ahead
    std::optional<PresentedStandIn> placeholder; ///< in the place of the chosen artifact, until that is ready
    std::string_view language;        ///< of the caption, shown or not; valid as long as the exhibit
    std::string_view wanted_language; ///< the chosen one, to load texts ahead; valid as long as the exhibit
    std::optional<PresentedCaption> caption;
    std::optional<PlacedSign> sign;             ///< what the visitor should do
    std::optional<PresentedAdvice> advice;      ///< the same in words; an invitation; why nothing is shown
    std::optional<WordIndex> says;              ///< what begins to be spoken at this step
    bool falls_silent = false;                  ///< what was spoken of it holds no more
    std::optional<WordIndex> prepares_word;     ///< what may be spoken next; none while the set leaves
    std::optional<DescriptionIndex> tells;      ///< whose description is to be heard, from its beginning on
    bool leaves = false;                        ///< what it told before ends at its next pause, else at once
    std::optional<DescriptionIndex> prepares;   ///< whose description may be heard next
    std::optional<std::size_t> tells_of;        ///< the hotspot that is pointed out, seen or not
    std::optional<PresentedHotspot> hotspot;    ///< its label
    const PresentedTable* table = nullptr;      ///< what lies there to choose from; valid until the next step
    std::string_view table_language;            ///< of its titles; valid as long as the exhibit
    double set_share = 1.0;                     ///< of the table's pictures: 0..1, the same
    double title_brightness = 1.0;              ///< of its titles: 0..1, a factor on linear light
    std::optional<PresentedNotice> notice;      ///< what is told of a stick; the exhibit leaves it out
    std::array<TableRectangle, 4> zone_sides{}; ///< of the frame around the zone
    double zone_share = 0.0;        ///< of the frame around the prop's zone: 0..1, a factor on linear light
    RigidTransform table_from_prop; ///< the pose to draw for
    bool attracts = false;          ///< the prop's own pose is not what is drawn
    bool settled = true;            ///< nothing fades: a good moment for a picture
    bool staff = false;             ///< State::Staff: the staff's picture is shown instead
    StaffView staff_view;           ///< then, what it shows
    std::uint32_t staff_tones = 0;  ///< how often the staff have asked for the test tone
    int louder_db = 0;              ///< than the settings say
    bool calibrate = false;         ///< in this step the staff asked for it
    std::uint32_t lamps = 0;        ///< the buttons that do something, bit k = button k
};

class Exhibit {
public:
    /// Of an artifact, while they come in turn.
    static constexpr Nanoseconds turn_time = std::chrono::seconds(20);
    /// Of another set, for somebody who is being told something.
    static constexpr Nanoseconds longest_wait = std::chrono::seconds(20);

    /// Begins in State::Attract with the first artifact, and with the caption that `caption_for` chooses for `language`.
    Exhibit(Catalogue catalogue, const ExhibitPlace& place, const std::string& language, MonotonicTime now);

    /// `commands`: those since the step before, in their order.
    [[nodiscard]] Presentation step(MonotonicTime now, std::span<const Command> commands,
                                    const TrackedState& tracked_state);
    /// Of each artifact, whether it is ready; before anything is noted, all are. Of no artifact: nothing changes.
    void note(std::span<const ArtifactState> states);
    /// This press did something else, which the exhibit knows nothing of: no chord undoes it.
    void forget_press(Command command) { selected_.at(static_cast<std::size_t>(button_of(command))) = false; }
    /// What hides the hotspots of the artifact on show, which need not be there; of the others nothing is kept.
    void note_triangles(std::size_t artifact, ArtifactTriangles triangles);
    /// Whether something is being said: then no advice begins to be. `narration`: of the description told.
    void hear(bool speaking, const SpeechProgress& narration = {});
    /// Another set of artifacts comes, and can be shown now or not. When it suits who is there, all that belongs to this set fades
    /// out: in State::Attract with the next turn; while something is told, spoken or chosen, after that, or after `longest_wait`,
    /// which begins when the other set is ready for the first time.
    void await_set(bool ready) { set_is_ready_ = ready; }
    /// It does not come any more.
    void await_no_set() {
        set_is_ready_ = false;
        set_waits_since_.reset();
    }
    /// All of this set fades out, or is dark.
    [[nodiscard]] bool leaves_set() const { return set_leaves_since_.has_value(); }
    /// All of it is dark, and stays dark.
    [[nodiscard]] bool set_has_left() const { return set_left_; }
    /// The other set takes its place: `artifact` fades in, in the language that was chosen, if the set has it, and in the state in
    /// which everything was. `table`: lay_out_catalogue of it. Returns what was shown before. Not for a frame that is being
    /// presented.
    [[nodiscard]] Catalogue show_set(Catalogue catalogue, std::optional<TableBrowser> table,
                                     std::vector<AdviceLanguage> words, std::size_t artifact,
                                     MonotonicTime now);
    /// When the prop moved last, something was pressed or told; nothing: never.
    [[nodiscard]] const std::optional<MonotonicTime>& used() const { return presence_.touched(); }
    /// The chosen artifact; it may not be visible yet.
    [[nodiscard]] std::size_t chosen() const { return selection_.artifact(); }
    /// The chosen language.
    [[nodiscard]] const std::string& language() const { return selection_.language(); }
    /// The volume that the staff chose before, in place of the settings'.
    void set_louder_db(int louder_db) { staff_.set_louder_db(louder_db); }
    /// Ends the staff's mode early: there is no picture to show.
    void end_staff_mode() { state_ = state_ == State::Staff ? next(state_, Event::Rest) : state_; }

private:
    void take(Command command, MonotonicTime now);
    void take_chord(MonotonicTime now);
    void take_hold(bool first, MonotonicTime now);
    void offer_what_can_be_shown(MonotonicTime now);
    [[nodiscard]] bool ready(std::size_t artifact) const;
    void go_to(State state, MonotonicTime now);
    /// The visitor has gone.
    void rest(MonotonicTime now);
    [[nodiscard]] Observed observe(MonotonicTime now, const TrackedState& tracked_state, const Stand& stand);
    void step_table(MonotonicTime now, const TrackedState& tracked_state, const Stand& stand, Observed& seen);
    /// Nothing where nobody is there, or there is nothing to mend.
    [[nodiscard]] const Guidance* step_guide(MonotonicTime now, const TrackedState& tracked_state,
                                             const Stand& stand);
    [[nodiscard]] bool is_on_way_to_picture(MonotonicTime now);
    [[nodiscard]] const ZoneFrame& zone_of(std::size_t artifact) const;
    /// Something of the artifact is being told.
    [[nodiscard]] bool tells() const;

    // Of another set: exhibit_set.cpp.
    [[nodiscard]] static Selection make_selection(const Catalogue& catalogue, const std::string& language,
                                                  MonotonicTime now);
    void follow_set(MonotonicTime now);
    [[nodiscard]] bool may_leave_set(MonotonicTime now) const;
    void dim_what_leaves(MonotonicTime now, Presentation& presentation) const;

    // What is shown in the state that it is in: exhibit_shows.cpp.
    /// Behind the staff's picture all goes on but what is told.
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
    /// None: there is nothing to tell.
    [[nodiscard]] const Tellable* tellable(const DescriptionIndex& description) const;
    [[nodiscard]] std::uint32_t lamps() const;

    Catalogue catalogue_;
    ExhibitPlace place_;
    std::string house_language_;
    Selection selection_;
    std::vector<ArtifactState> ready_;
    std::vector<bool> offered_;    ///< by artifact: selection and table offer it
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
    std::optional<MonotonicTime> way_since_; ///< the prop moves
    std::optional<PlacedSign> sign_;         ///< of the latest step
    Sentences sentences_;
    bool speaking_ = false;           ///< somebody hears something
    bool speech_due_ = false;         ///< until the words lie on the table
    std::optional<WordIndex> spoken_; ///< what they may still hear
    VisitorSide side_;                ///< what lies on the table is turned to it
    SpeechProgress narration_;
    Narrator narrator_;
    bool choose_ = false;       ///< pressed, and not taken yet
    bool help_ = false;         ///< the same
    bool answer_comes_ = false; ///< advice for who pressed it is being looked for
    bool there_ = false;        ///< somebody is
    std::optional<TableBrowser> table_;
    CaptionPlacer placer_;
    HotspotLabels labels_;
    bool waits_ = false; ///< the artifact is still to come, as the latest step showed it
    bool set_is_ready_ = false;
    bool set_left_ = false;
    std::optional<MonotonicTime> set_waits_since_, set_leaves_since_;
    const std::vector<glm::dvec2>* placed_ = nullptr; ///< the sizes that `placer_` has
    /// By button: its latest press reached the selection.
    std::array<bool, button_commands.size()> selected_{};
};

} // namespace frustumscreen
