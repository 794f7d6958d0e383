/// Decides what the exhibit shows, from what was pressed and from where the prop and the eye are.
///
///     commands, situation -> step -> Presentation
///
/// A Presentation is plain values: the code that draws, lights lamps or reports needs nothing else.
///
/// Staff    Command::StaffMode shows the alignment pattern for a minute, or until something is pressed; that
///          press does nothing else. Presses take effect at once, since a visitor's must. If they turn out to
///          be the beginning of the staff's chord they are undone, so the pattern leaves no trace.
/// Frames   table T, metres.
/// Time     `now` never goes back. Fades are closed forms of it; a caption appears from its first step on.
/// Threads  values; one caller. `step` allocates nothing.
/// Errors   none. A catalogue without artifacts shows nothing.
#pragma once

#include "app/exhibit/advice_sign.h"
#include "app/exhibit/artifact_state.h"
#include "app/exhibit/attract.h"
#include "app/exhibit/captions.h"
#include "app/exhibit/description_shape.h"
#include "app/exhibit/hotspot_labels.h"
#include "app/exhibit/presence.h"
#include "app/exhibit/selection.h"
#include "app/exhibit/stand_in.h"
#include "app/exhibit/table_browser.h"
#include "app/exhibit/teller.h"
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
    /// For each of `languages` what there is to tell, and how large it is; none: there is nothing.
    std::vector<Tellable> tellables{};
    std::vector<DescriptionShape> descriptions{};
    HotspotSet hotspots{};
};
using Catalogue = std::vector<CatalogueEntry>;

/// A sentence of the exhibit's own words.
struct AdviceText {
    std::string key;                 ///< as words_key gives it
    std::vector<glm::dvec2> sizes_m; ///< as CatalogueEntry::caption_sizes_m
};
struct AdviceLanguage {
    std::string language; ///< BCP 47
    std::vector<AdviceText> texts;
};

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
};

struct PresentedCaption {
    std::size_t language = 0; ///< index into CatalogueEntry::languages
    std::size_t shape = 0;    ///< index into its sizes
    TableRectangle rectangle;
    double brightness = 0.0; ///< above 0, up to 1; a factor on linear light
    /// Of the description, which is shown in place of the short text.
    std::optional<std::size_t> portion = std::nullopt;
};

/// One of ExhibitPlace::words.
struct WordIndex {
    std::size_t language = 0;
    std::size_t text = 0;
    [[nodiscard]] bool operator==(const WordIndex&) const = default;
};
struct PresentedAdvice {
    WordIndex word;
    std::size_t shape = 0; ///< index into its sizes
    TableRectangle rectangle;
    double brightness = 0.0; ///< above 0, up to 1; a factor on linear light
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
    std::size_t artifact = 0; ///< index into the catalogue
    double brightness = 0.0;  ///< of the artifact: 0..1, a factor on linear light; 0 while it is not ready
    WantedArtifacts wanted;   ///< to load ahead
    std::optional<PresentedStandIn> stand_in; ///< in the place of the chosen artifact, until that is ready
    std::string_view language;                ///< of the caption, shown or not; valid as long as the exhibit
    std::optional<PresentedCaption> caption;
    std::optional<PlacedSign> sign;           ///< what the visitor should do
    std::optional<PresentedAdvice> advice;    ///< the same in words
    std::optional<WordIndex> says;            ///< what begins to be spoken at this step
    bool falls_silent = false;                ///< no advice need be said any more
    std::optional<WordIndex> prepares_word;   ///< what may be spoken next
    std::optional<DescriptionIndex> tells;    ///< whose description is to be heard, from its beginning on
    bool leaves = false;                      ///< what it told before ends at its next pause, else at once
    std::optional<DescriptionIndex> prepares; ///< whose description may be heard next
    std::optional<std::size_t> tells_of;      ///< the hotspot that is pointed out, seen or not
    std::optional<PresentedHotspot> hotspot;  ///< its label
    const PresentedTable* table = nullptr;    ///< what lies there to choose from; valid until the next step
    std::string_view table_language;          ///< of its titles; valid as long as the exhibit
    double title_brightness = 1.0;            ///< of its titles: 0..1, a factor on linear light
    double zone_share = 0.0;        ///< of the frame around the prop's zone: 0..1, a factor on linear light
    RigidTransform table_from_prop; ///< the pose to draw for
    bool attracts = false;          ///< the prop's own pose is not what is drawn
    bool settled = true;            ///< nothing fades: a good moment for a picture
    bool staff = false;             ///< the alignment pattern is shown instead
    std::uint32_t lamps = 0;        ///< the buttons that do something, bit k = button k
};

class Exhibit {
public:
    static constexpr Nanoseconds staff_time = std::chrono::seconds(60);

    /// Begins with the first artifact, and with the caption that `caption_for` chooses for `language`.
    Exhibit(Catalogue catalogue, const ExhibitPlace& place, const std::string& language, MonotonicTime now);

    /// `commands`: those since the step before, in their order.
    [[nodiscard]] Presentation step(MonotonicTime now, std::span<const Command> commands,
                                    const Situation& situation);
    /// Of each artifact, whether it is ready; before anything is noted, all are. Of no artifact: nothing changes.
    void note(std::span<const ArtifactState> states);
    /// What hides the hotspots of the artifact on show, which need not be there; of the others nothing is kept.
    void note_triangles(std::size_t artifact, ArtifactTriangles triangles);
    /// Whether something is being said: then no advice begins to be. `narration`: of the description told.
    void hear(bool speaking, const Narration& narration = {}) {
        speaking_ = speaking;
        narration_ = narration;
    }
    /// Ends the staff's mode early: there is no pattern to show.
    void end_staff_mode() { staff_until_.reset(); }

private:
    void take(Command command, MonotonicTime now);
    void take_chord(MonotonicTime now);
    void leave_out_the_bad(MonotonicTime now);
    [[nodiscard]] bool ready(std::size_t artifact) const;
    [[nodiscard]] WantedArtifacts wanted() const;
    [[nodiscard]] StandIn::Output stand_in(MonotonicTime now, const Shown& shown, const Stand& stand);
    void step_table(MonotonicTime now, const Situation& situation, const Stand& stand);
    [[nodiscard]] std::optional<PresentedCaption> caption(MonotonicTime now, const Shown& shown,
                                                          const Situation& situation, const Stand& stand);
    [[nodiscard]] std::optional<PresentedHotspot> label(MonotonicTime now, const Shown& shown,
                                                        const Situation& situation, const Stand& stand,
                                                        const Presentation& presentation);
    [[nodiscard]] std::string_view language_of(std::size_t artifact) const;
    [[nodiscard]] std::optional<WordIndex> word_of(const Guidance& guidance) const;
    /// `around`: the shadow, and the sign beside it.
    void place_advice(MonotonicTime now, const std::optional<WordIndex>& word, const TablePolygon& around,
                      const Situation& situation, Presentation& presentation);
    void guide(MonotonicTime now, const Situation& situation, const Stand& stand, bool pressed,
               Presentation& presentation);
    void tell(MonotonicTime now, const Situation& situation, const Shown& shown, const Stand& stand,
              bool pressed, Presentation& presentation);
    [[nodiscard]] DescriptionIndex description_of(std::size_t artifact, std::string_view language) const;
    /// None: there is nothing to tell.
    [[nodiscard]] const Tellable* tellable(const DescriptionIndex& description) const;
    [[nodiscard]] std::uint32_t lamps() const;

    Catalogue catalogue_;
    ExhibitPlace place_;
    Selection selection_;
    std::vector<ArtifactState> states_;
    std::size_t left_out_ = 0;     ///< how many of them the selection knows to be left out
    std::size_t triangles_of_ = 0; ///< the artifact whose triangles are noted
    StandIn stand_in_;
    std::optional<Attract> attract_; ///< from the first step on
    std::optional<Guide> guide_;
    std::vector<std::string> word_languages_;
    CaptionPlacer advice_placer_;
    std::optional<WordIndex> advice_; ///< that the placer has
    bool speaking_ = false;
    Narration narration_;
    Teller teller_;
    bool choose_ = false;                        ///< pressed, and not taken yet
    bool help_ = false;                          ///< the same
    bool there_ = false;                         ///< somebody is
    GuidanceStage stage_ = GuidanceStage::Quiet; ///< of the latest step
    bool advised_ = false;                       ///< at the step before
    Presence presence_;                          ///< guidance is for somebody who is there
    VisitorSide side_;                           ///< what lies on the table is turned to it
    std::optional<TableBrowser> table_;
    CaptionPlacer placer_;
    HotspotLabels labels_;
    std::optional<std::size_t> hotspot_;
    const std::vector<glm::dvec2>* placed_ = nullptr; ///< the sizes that `placer_` has
    /// By button: its latest press reached the selection.
    std::array<bool, button_commands.size()> selected_{};
    std::optional<MonotonicTime> staff_until_;
};

} // namespace frustumscreen
