/// The exhibit's output of one step, as plain values: the code that draws, lights lamps or speaks needs nothing else.
///
/// Frames   table T, metres.
/// Threads  values; any.
#pragma once

#include "app/exhibit/advice_sign.h"
#include "app/exhibit/behaviour_title.h"
#include "app/exhibit/behaviour_triggers.h"
#include "app/exhibit/hotspot_labels.h"
#include "app/exhibit/narration_sequencer.h"
#include "app/exhibit/notice_place.h"
#include "app/exhibit/object_dwell.h"
#include "app/exhibit/placeholder.h"
#include "app/exhibit/presented_windows.h"
#include "app/exhibit/sentences.h"
#include "app/exhibit/site_travel.h"
#include "app/exhibit/staff_tool.h"
#include "app/exhibit/states.h"
#include "app/exhibit/table_browser.h"
#include "app/exhibit/torch_lights.h"
#include "app/geometry/transform.h"
#include "app/typography/captions.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace frustumscreen::exhibit {

struct PresentedCaption {
    std::size_t language = 0; ///< index into CatalogueEntry::languages
    std::size_t shape = 0;    ///< index into its sizes
    typography::TableRectangle rectangle;
    double brightness = 0.0; ///< above 0, up to 1; a factor on linear light
    /// The portion of the description that is shown in place of the short text.
    std::optional<std::size_t> portion = std::nullopt;
};

/// Artifacts that a visitor may see next, most urgent first: the chosen one, the one whose picture the prop rests on,
/// the next, the previous; and those that windows show. Some may be equal.
class WantedArtifacts {
public:
    void add(std::size_t artifact) { artifacts_.at(count_++) = artifact; }
    [[nodiscard]] std::span<const std::size_t> artifacts() const {
        return std::span(artifacts_).first(count_);
    }

private:
    std::array<std::size_t, 4 + settings::max_windows + 1> artifacts_{};
    std::size_t count_ = 0;
};

struct Presentation {
    State state = State::Attract;
    std::size_t artifact = 0;    ///< index into the catalogue
    double brightness = 0.0;     ///< of the artifact: 0..1, a factor on linear light; 0 until it is ready
    double artifact_light = 0.0; ///< as `brightness`, before it fades with an unknown pose
    WantedArtifacts wanted;      ///< to load ahead
    std::optional<PresentedPlaceholder> placeholder; ///< in place of the chosen artifact until that is ready
    std::string_view language;        ///< the caption's, shown or not; valid as long as the exhibit
    std::string_view wanted_language; ///< the chosen one, to load texts ahead; valid as long as the exhibit
    std::optional<PresentedCaption> caption;
    std::optional<PlacedSign> sign;         ///< advice as a picture
    std::optional<PresentedAdvice> advice;  ///< advice in words; an invitation; why nothing is shown
    std::optional<WordIndex> says;          ///< sentence whose speech begins in this step
    bool falls_silent = false;              ///< the sentence being spoken does not apply any more
    std::optional<WordIndex> prepares_word; ///< sentence that may be spoken next; none while the set leaves
    std::optional<DescriptionIndex> tells;  ///< description to be heard, from its beginning
    bool leaves = false; ///< true: the former description ends at its next pause; false: at once
    std::optional<DescriptionIndex> prepares; ///< description that may be heard next
    std::optional<std::size_t> tells_of;      ///< the hotspot pointed out, visible or not
    std::optional<PresentedHotspot> hotspot;  ///< the hotspot's label
    BehaviourEvents behaviours;               ///< that begin or end in this step
    std::optional<PresentedTitle> title;      ///< what the button for behaviours does now
    PresentedTorches torches;                 ///< what torches throw onto the artifact
    PresentedWindows windows;                 ///< that lie on the table
    PresentedSite site;                       ///< which part of a site the prop shows
    std::optional<PresentedTitle> site_map;   ///< the place of the site's map
    std::optional<RoomObject> before;         ///< the object of the room that the prop rests in front of
    const PresentedTable* table = nullptr;    ///< pictures to choose from; valid until the next step
    std::string_view table_language;          ///< of the table's titles; valid as long as the exhibit
    double set_share = 1.0;                   ///< of the table's pictures: 0..1, a factor on linear light
    double title_brightness = 1.0;            ///< of the table's titles: 0..1, a factor on linear light
    std::optional<PresentedNotice> notice;    ///< notice about a stick; not set by the exhibit
    std::array<typography::TableRectangle, 4> zone_sides{}; ///< of the frame around the zone
    double zone_share = 0.0; ///< of the frame around the zone: 0..1, a factor on linear light
    geometry::RigidTransform table_from_prop; ///< the pose to draw for
    bool attracts = false;                    ///< the pose drawn for is not the prop's own
    bool settled = true;                      ///< nothing fades: a good moment for a picture
    bool staff = false;                       ///< State::Staff: the staff picture is shown instead
    State before_staff = State::Attract;      ///< the state that led to it
    StaffView staff_view;                     ///< what the staff picture shows
    std::uint32_t staff_tones = 0;            ///< number of test tones asked for by the staff
    int louder_db = 0;                        ///< relative to the settings' volume
    bool calibrate = false;                   ///< the staff asked for calibration in this step
    bool reset = false;                       ///< the staff confirmed the state of delivery in this step
    bool copy = false;                        ///< the staff confirmed a copy onto a stick in this step
    std::uint32_t lamps = 0;                  ///< buttons that do something; bit k = button k
};

} // namespace frustumscreen::exhibit
