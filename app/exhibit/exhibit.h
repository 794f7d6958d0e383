/// Decides what the exhibit shows, from what was pressed and from where the prop and the eye are.
///
///     commands, situation -> step -> events -> state -> Presentation
///
/// A Presentation is plain values: the code that draws, lights lamps or reports needs nothing else.
///
/// States   app/exhibit/states.h has them all; what is said, and where, follows from the state.
/// Rest     after `ExhibitPlace::rest` without anybody the artifacts come in turn, in the house's language. The first touch ends
///          it, and the artifact on show stays.
/// Staff    Command::StaffMode shows the alignment pattern for a minute, or until something is pressed; that
///          press does nothing else. Presses take effect at once, since a visitor's must. If they turn out to
///          be the beginning of the staff's chord they are undone, so the pattern leaves no trace.
/// Frames   table T, metres.
/// Time     `now` never goes back. Fades are closed forms of it; a caption appears from its first step on.
/// Threads  values; one caller. `step` allocates nothing.
/// Errors   none. A catalogue without artifacts shows nothing.
#pragma once

#include "app/exhibit/advice_sign.h"
#include "app/exhibit/attract.h"
#include "app/exhibit/captions.h"
#include "app/exhibit/presence.h"
#include "app/exhibit/selection.h"
#include "app/exhibit/sensed.h"
#include "app/exhibit/sentences.h"
#include "app/exhibit/states.h"
#include "app/exhibit/table_browser.h"
#include "app/exhibit/visitor_side.h"
#include "app/exhibit/zone_frame.h"
#include "app/geometry/prop_shape.h"
#include "app/settings/command.h"
#include "app/tracking/situation.h"

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
    /// For each of `languages` the caption's sizes, one for each width that it was wrapped to, in falling
    /// preference; at most four.
    std::vector<std::vector<glm::dvec2>> caption_sizes_m;
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
    bool table_pictures = false;                  ///< the set's artifacts lie on the table, to choose from
    Nanoseconds rest = std::chrono::seconds(60);  ///< nobody has been there for so long: attract
};

struct PresentedCaption {
    std::size_t language = 0; ///< index into CatalogueEntry::languages
    std::size_t shape = 0;    ///< index into its sizes
    TableRectangle rectangle;
    double brightness = 0.0; ///< above 0, up to 1; a factor on linear light
};

struct Presentation {
    State state = State::Attract;
    State state_before = State::Attract; ///< the latest other one
    std::size_t artifact = 0;            ///< index into the catalogue
    double brightness = 0.0;             ///< of the artifact: 0..1, a factor on linear light
    std::string_view language;           ///< of the caption, shown or not; valid as long as the exhibit
    std::optional<PresentedCaption> caption;
    std::optional<PlacedSign> sign;        ///< what the visitor should do
    std::optional<PresentedAdvice> advice; ///< the same in words; an invitation; why nothing is shown
    std::optional<WordIndex> says;         ///< what begins to be spoken at this step
    bool falls_silent = false;             ///< what was spoken holds no more
    const PresentedTable* table = nullptr; ///< what lies there to choose from; valid until the next step
    double zone_share = 0.0;        ///< of the frame around the prop's zone: 0..1, a factor on linear light
    RigidTransform table_from_prop; ///< the pose to draw for
    bool attracts = false;          ///< the prop's own pose is not what is drawn
    bool settled = true;            ///< nothing fades: a good moment for a picture
    bool staff = false;             ///< State::Staff: the alignment pattern is shown instead
    std::uint32_t lamps = 0;        ///< the buttons that do something, bit k = button k
};

class Exhibit {
public:
    static constexpr Nanoseconds staff_time = std::chrono::seconds(60);
    /// Of an artifact, while they come in turn.
    static constexpr Nanoseconds turn_time = std::chrono::seconds(20);

    /// Begins in State::Attract with the first artifact, and with the caption that `caption_for` chooses for `language`.
    Exhibit(Catalogue catalogue, const ExhibitPlace& place, const std::string& language, MonotonicTime now);

    /// `commands`: those since the step before, in their order.
    [[nodiscard]] Presentation step(MonotonicTime now, std::span<const Command> commands,
                                    const Situation& situation);
    /// Whether something is being said: then nothing else begins to be.
    void hear(bool speaking);
    /// Ends the staff's mode early: there is no pattern to show.
    void end_staff_mode() { state_ = state_ == State::Staff ? next(state_, Event::Rest) : state_; }

private:
    void take(Command command, MonotonicTime now);
    void take_chord(MonotonicTime now);
    void go_to(State state, MonotonicTime now);
    /// What a state does as it begins, and as it goes on.
    void follow_state(State before, MonotonicTime now);
    [[nodiscard]] Observed observe(MonotonicTime now, const Situation& situation, const Stand& stand,
                                   bool there);
    void step_table(MonotonicTime now, const Situation& situation, const Stand& stand, Observed& seen);
    /// Nothing where nobody is there, or there is nothing to mend.
    [[nodiscard]] const Guidance* step_guide(MonotonicTime now, const Situation& situation,
                                             const Stand& stand, bool there);
    [[nodiscard]] std::optional<PresentedCaption> caption(MonotonicTime now, const Shown& shown,
                                                          const Situation& situation, const Stand& stand);
    [[nodiscard]] std::string_view language_of(std::size_t artifact) const;
    [[nodiscard]] std::optional<WordIndex> word() const;
    void present_words(MonotonicTime now, const Situation& situation, const Stand& stand,
                       Presentation& presentation);
    void speak(MonotonicTime now, const std::optional<WordIndex>& word, Presentation& presentation);
    [[nodiscard]] std::uint32_t lamps() const;

    Catalogue catalogue_;
    ExhibitPlace place_;
    Selection selection_;
    State state_ = State::Attract;
    State state_before_ = State::Attract;
    MonotonicTime state_since_;
    MonotonicTime next_turn_;        ///< when the next artifact comes, in State::Attract
    std::optional<Attract> attract_; ///< from the first step on
    Presence presence_;
    Sensed sensed_;
    std::optional<Guide> guide_;
    const Guidance* guidance_ = nullptr; ///< of this step
    Sentences sentences_;
    bool speaking_ = false;           ///< somebody hears something
    std::optional<WordIndex> spoken_; ///< what they may still hear
    VisitorSide side_;                ///< what lies on the table is turned to it
    std::optional<TableBrowser> table_;
    CaptionPlacer placer_;
    const std::vector<glm::dvec2>* placed_ = nullptr; ///< the sizes that `placer_` has
    /// By button: its latest press reached the selection.
    std::array<bool, button_commands.size()> selected_{};
};

} // namespace frustumscreen
