/// The values that an exhibit is made of: the artifacts of a set, and the place where they are shown.
///
/// Frames   table T, metres.
/// Threads  values; any.
#pragma once

#include "app/exhibit/behaviour_triggers.h"
#include "app/exhibit/description_shape.h"
#include "app/exhibit/hotspot_labels.h"
#include "app/exhibit/narration_sequencer.h"
#include "app/exhibit/sentences.h"
#include "app/exhibit/site_travel.h"
#include "app/exhibit/table_browser.h"
#include "app/exhibit/torch_lights.h"
#include "app/exhibit/window_desk.h"
#include "app/exhibit/zone_frame.h"
#include "app/geometry/prop_shape.h"
#include "app/guidance/guide.h"
#include "app/settings/command.h"

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::exhibit {

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
    std::vector<TriggeredBehaviour> behaviours{}; ///< in the pack's order
    /// The contents of a torch on it, in the pack's order: the size of each title, by `languages`; the height is 0 if there
    /// is none.
    std::vector<std::vector<glm::dvec2>> content_title_sizes_m{};
    /// Its states, which windows show, in the pack's order: the size of each title, by `languages`; the height is 0 if there is
    /// none.
    std::vector<std::vector<glm::dvec2>> state_title_sizes_m{};
    /// The corners of the hull of the artifact in the prop (pack/pack_hull.h), prop frame; empty: unknown, and every
    /// face in view counts.
    std::vector<glm::dvec3> hull{};
    SiteGround site{};               ///< without regions: the artifact is no site
    std::optional<ZoneFrame> zone{}; ///< where the artifact is seen whole; none: the place's zone
};
using Catalogue = std::vector<CatalogueEntry>;

/// The exhibit's place: prop, projector and table.
struct ExhibitPlace {
    geometry::PropShape prop;
    glm::dvec3 lens_m{0.0};            ///< the projector's
    std::vector<glm::dvec2> picture_m; ///< the part of the table that the projector's picture covers, convex
    std::vector<geometry::Plane> picture_edges{}; ///< as LitPlaces
    ZoneFrame zone;                               ///< none by default
    glm::dvec2 attract_place_m{0.0}; ///< where the artifact stands while the prop's pose is unknown
    std::size_t buttons =
        settings::button_commands.size();            ///< of the panel; the chord is the first and the last
    std::optional<guidance::GuidanceSetup> guidance; ///< none: no guidance
    std::vector<AdviceLanguage> words;               ///< empty: guidance has no words
    bool in_hand = false;                            ///< the prop is lifted and turned in any way
    bool staff_stays = false;                        ///< there is no calibration: as StaffTool
    bool table_pictures = false;                     ///< the set's artifacts lie on the table to choose from
    std::optional<TorchPlace> torch;                 ///< none: there is no torch
    std::optional<WindowPlace> windows;              ///< none: none can be pinned
    Nanoseconds rest = std::chrono::seconds(60);     ///< time without a visitor before State::Attract
};

/// The pictures on the table to choose from; nothing if the place has none. Takes some tens of milliseconds.
[[nodiscard]] std::optional<TableBrowser> lay_out_catalogue(const Catalogue& catalogue,
                                                            const ExhibitPlace& place);

/// The languages in the order of their first appearance; the button goes through them in this order.
[[nodiscard]] std::vector<std::string> languages_of(const Catalogue& catalogue);

} // namespace frustumscreen::exhibit
