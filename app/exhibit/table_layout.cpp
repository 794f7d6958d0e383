#include "app/exhibit/table_layout.h"

#include "app/exhibit/table_places.h"
#include "app/geometry/time_curves.h"
#include "app/typography/visitor_side.h"

#include <utility>

namespace frustumscreen::exhibit {

namespace {

constexpr double dimming_m = 0.012;        ///< as a caption's
constexpr double caption_margin_m = 0.022; ///< a caption is never placed closer to the prop than 20 mm
constexpr double caption_slack_m = 0.012;  ///< captions are placed on a grid of 10 mm

/// Ratio of artifacts on a page that makes an asymmetric page worth it.
constexpr double worth_being_lopsided = 1.5;
/// The following are in metres of picture size.
constexpr double size_for_better_anchor = 0.003;
constexpr double size_for_better_shape = 0.015;

/// Areas for a caption while the prop is at home, best first: at the reader's edge, then at the sides.
std::vector<TableArea> caption_areas(const ReadersTable& table, const glm::dvec2& caption) {
    std::vector<TableArea> areas;
    const glm::dvec2 half = 0.5 * (caption + caption_slack_m);
    const glm::dvec2 way = table.inner.half - half;
    if (way.x < 0.0 || way.y < 0.0) {
        return areas;
    }
    for (const glm::dvec2& anchor :
         {glm::dvec2(0, -1), glm::dvec2(1, -1), glm::dvec2(-1, -1), glm::dvec2(1, 0), glm::dvec2(-1, 0),
          glm::dvec2(1, 1), glm::dvec2(-1, 1), glm::dvec2(0, 1)}) {
        const TableArea area{table.inner.centre + anchor * way, half};
        if (table.is_clear_of_home(area, caption_margin_m)) {
            areas.push_back(area);
        }
    }
    return areas;
}

/// The number of places of a page, for `artifacts` artifacts where at most `most` fit: with several pages the last
/// place leads on, and all pages but the last are full.
std::size_t places_of_page(std::size_t artifacts, std::size_t most) {
    if (artifacts <= most) {
        return artifacts;
    }
    const std::size_t pages = (artifacts + most - 2) / (most - 1);
    return (artifacts + pages - 1) / pages + 1;
}

struct Candidate {
    std::size_t shown = 0; ///< artifacts on a page
    double score = 0.0;
    FoundPlaces found;
    std::optional<TableArea> caption;
};

Candidate candidate_for(const PictureArea& area, const TableSetUp& set_up, double penalty, double min_score) {
    FoundByCount found = find_places(area, set_up, min_score + penalty);
    std::size_t most = max_table_places;
    while (most > 0 && found[most].size <= 0.0) {
        --most;
    }
    if (most < 2) {
        return {.shown = 0, .score = 0.0, .found = {}, .caption = area.caption};
    }
    const std::size_t places = places_of_page(set_up.artifacts, most);
    const std::size_t shown = places - (places < set_up.artifacts ? 1 : 0);
    Candidate candidate{.shown = shown,
                        .score = found[places].value - penalty,
                        .found = std::move(found[places]),
                        .caption = area.caption};
    if (area.symmetric) {
        come_nearer_to_prop(area, size_of_place(candidate.found.size, set_up.title_m),
                            candidate.found.middles);
    }
    return candidate;
}

/// The best layout: with an area for the caption if that leaves places; most artifacts on a page first, then larger
/// pictures.
Candidate best_candidate(const ReadersTable& table, const TableSetUp& set_up, bool symmetric) {
    const std::size_t wanted = std::min(set_up.artifacts, max_table_places);
    Candidate best;
    for (std::size_t shape = 0; shape < set_up.captions_m.size(); ++shape) {
        const std::vector<TableArea> areas = caption_areas(table, set_up.captions_m[shape]);
        for (std::size_t anchor = 0; anchor < areas.size(); ++anchor) {
            const double penalty = size_for_better_shape * static_cast<double>(shape) +
                                   size_for_better_anchor * static_cast<double>(anchor);
            const double min_score = best.shown == wanted ? best.score : 0.0;
            Candidate candidate =
                candidate_for({table, areas[anchor], symmetric}, set_up, penalty, min_score);
            if (std::pair(candidate.shown, candidate.score) > std::pair(best.shown, best.score)) {
                best = std::move(candidate);
            }
        }
    }
    return best.shown > 0 ? best : candidate_for({table, std::nullopt, symmetric}, set_up, 0.0, 0.0);
}

/// Symmetric, unless an asymmetric layout holds far more.
Candidate best_candidate(const ReadersTable& table, const TableSetUp& set_up) {
    Candidate symmetric = best_candidate(table, set_up, true);
    const double many = worth_being_lopsided * static_cast<double>(symmetric.shown);
    if (many > static_cast<double>(std::min(set_up.artifacts, max_table_places))) {
        return symmetric;
    }
    Candidate free = best_candidate(table, set_up, false);
    return static_cast<double>(free.shown) >= many ? free : symmetric;
}

} // namespace

typography::TableRectangle TablePlace::whole() const {
    const std::array<glm::dvec2, 4> below = title.corners();
    const std::array<glm::dvec2, 4> above = picture.corners();
    const double height = glm::distance(0.5 * (below[0] + below[1]), 0.5 * (above[2] + above[3]));
    return {0.25 * (below[0] + below[1] + above[2] + above[3]),
            {std::max(title.size_m.x, picture.size_m.x), height},
            picture.quarter_turns};
}

std::size_t TableLayout::pages() const {
    const std::size_t each = places.empty() ? 0 : artifacts_on_page();
    return each == 0 ? 0 : (artifacts + each - 1) / each;
}

std::size_t TableLayout::page_of(std::size_t artifact) const {
    return pages() == 0 ? 0 : artifact / artifacts_on_page();
}

std::optional<std::size_t> TableLayout::artifact_at(std::size_t page, std::size_t place) const {
    if (places.empty() || place >= artifacts_on_page()) {
        return std::nullopt;
    }
    const std::size_t artifact = page * artifacts_on_page() + place;
    return artifact < artifacts ? std::optional(artifact) : std::nullopt;
}

TableLayout lay_out_table(const TableSetUp& set_up, int quarter_turns) {
    TableLayout layout;
    layout.artifacts = set_up.artifacts;
    const ReadersTable table(set_up, quarter_turns);
    if (set_up.artifacts < 2 || !table.usable) {
        return layout;
    }
    Candidate best = best_candidate(table, set_up);
    const double size = best.found.size;
    const double above_middle = 0.5 * size_of_place(size, set_up.title_m).y;
    for (const glm::dvec2& middle : best.found.middles) {
        const glm::dvec2 picture = middle + glm::dvec2(0.0, above_middle - 0.5 * size);
        const glm::dvec2 title = middle - glm::dvec2(0.0, above_middle - 0.5 * set_up.title_m.y);
        const glm::dvec2 title_size(size_of_place(size, set_up.title_m).x, set_up.title_m.y);
        layout.places.push_back(
            {{typography::turned(picture, quarter_turns), glm::dvec2(size), quarter_turns},
             {typography::turned(title, quarter_turns), title_size, quarter_turns}});
    }
    layout.has_more = layout.places.size() > 0 && best.shown < set_up.artifacts;
    if (best.caption) {
        layout.caption = typography::TableRectangle{typography::turned(best.caption->centre, quarter_turns),
                                                    2.0 * best.caption->half, quarter_turns};
    }
    return layout;
}

double place_brightness(const TablePlace& place, const std::optional<typography::TablePolygon>& shadow) {
    return shadow
               ? geometry::ease(typography::clearance(place.whole().corners(), shadow->corners()) / dimming_m)
               : 0.0;
}

} // namespace frustumscreen::exhibit
