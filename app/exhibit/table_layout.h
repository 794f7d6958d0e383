/// Layout of the set's artifacts on the table: small pictures with titles, to choose from.
///
/// Every artifact has a place of its own. The place of the artifact in the prop stays empty, so nothing else
/// moves when another one is chosen. If not all fit there are several pages, and the last place leads to the next
/// page. Nothing lies at the prop's home, nor in the prop's shadow there at any yaw, and an area is left for the
/// caption. The layout depends only on the set-up, the number of artifacts and the reader's side: nothing that moves
/// on the table moves a place.
///
/// Method   all pictures have one size. They lie in even rows, symmetric about the line from the reader to the prop
///          (table_places.h), unless an asymmetric page has space for half as many again. The most artifacts on a page
///          take priority, then the larger pictures.
/// Frames   table T, metres.
/// Threads  pure; any. `lay_out_table` takes some milliseconds and allocates: before the first frame, for each side.
/// Errors   none: a table without space has no places.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/typography/captions.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace frustumscreen::exhibit {

inline constexpr double min_table_picture_m = 0.045; ///< smaller ones are hard to recognise
inline constexpr double max_table_picture_m = 0.10;
inline constexpr std::size_t max_table_places = 12; ///< a page

struct TablePlace {
    typography::TableRectangle picture; ///< square
    typography::TableRectangle title;   ///< below it, as the reader sees it
    /// The rectangle of picture, title and the gap between.
    [[nodiscard]] typography::TableRectangle whole() const;
};

struct TableSetUp {
    std::size_t artifacts = 0;         ///< of the whole set
    std::vector<glm::dvec2> picture_m; ///< the part of the table that the projector's picture covers, convex
    geometry::PropShape prop;
    glm::dvec3 lens_m{0.0};
    glm::dvec2 home_m{0.0};           ///< the prop's resting place, upright
    glm::dvec2 title_m{0.070, 0.022}; ///< two lines of the smallest type
    /// Sizes that hold every caption of the set, in falling preference; empty: no area is left for captions.
    std::vector<glm::dvec2> captions_m;
};

struct TableLayout {
    std::vector<TablePlace> places; ///< of a page; empty for a single artifact, or if no two fit
    bool has_more = false;          ///< the last place leads to the next page
    std::size_t artifacts = 0;
    std::optional<typography::TableRectangle> caption; ///< the area left for it

    [[nodiscard]] std::size_t artifacts_on_page() const { return places.size() - (has_more ? 1 : 0); }
    [[nodiscard]] std::size_t pages() const;
    [[nodiscard]] std::size_t page_of(std::size_t artifact) const;
    /// Nothing for a place that leads to the next page, and for one that the last page leaves empty.
    [[nodiscard]] std::optional<std::size_t> artifact_at(std::size_t page, std::size_t place) const;
    [[nodiscard]] bool leads_on(std::size_t place) const { return has_more && place + 1 == places.size(); }
};

/// `quarter_turns`: the reader's side (visitor_side.h).
[[nodiscard]] TableLayout lay_out_table(const TableSetUp& set_up, int quarter_turns);

/// Brightness of a place beside the prop's shadow, 0..1, a factor on linear light: 1 beyond 12 mm, 0 at contact, so
/// that no picture lies on the prop. Without a shadow the prop may be anywhere, and the place is dark.
[[nodiscard]] double place_brightness(const TablePlace& place,
                                      const std::optional<typography::TablePolygon>& shadow);

} // namespace frustumscreen::exhibit
