#include "app/exhibit/table_layout.h"

#include "app/exhibit/visitor_side.h"
#include "app/geometry/time_curves.h"
#include "app/settings/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace frustumscreen {

namespace {

constexpr double border_m = 0.008;     ///< to the picture's edge
constexpr double gap_m = 0.012;        ///< between neighbours
constexpr double widest_gap_m = 0.050; ///< a row that is spread does not fall apart
constexpr double title_gap_m = 0.004;  ///< between a picture and its title
constexpr double size_step_m = 0.0025;
constexpr double dimming_m = 0.012;        ///< as a caption's
constexpr double home_margin_m = 0.015;    ///< more than dimming_m: with the prop at home, all is bright
constexpr double caption_margin_m = 0.022; ///< a caption is never placed closer to the prop than 20 mm
constexpr double caption_slack_m = 0.012;  ///< captions are placed on a grid of 10 mm
constexpr double rounding_m = 1e-9;

/// Costs in metres away from the reader, or of picture size.
constexpr double cost_behind_prop = 1.0;
constexpr double cost_of_unused_place = 0.2;
constexpr double size_for_better_anchor = 0.003;
constexpr double size_for_better_shape = 0.005;

/// In the reader's frame, along its axes.
struct Box {
    glm::dvec2 centre{0.0};
    glm::dvec2 half{0.0};
    [[nodiscard]] bool overlaps(const Box& other, double margin) const {
        const glm::dvec2 apart = glm::abs(centre - other.centre) - half - other.half;
        return std::max(apart.x, apart.y) < margin;
    }
};

/// The table as the reader sees it: turned so that the reader stands at the front.
///
/// What the prop at home may hide, at any yaw, is the convex hull of circles: those on which its corners go round, as seen
/// from the lens. It is kept as how far it reaches in each of some directions.
struct ReadersTable {
    static constexpr std::size_t direction_count = 32;

    ReadersTable(const TableSetUp& set_up, int quarter_turns);
    [[nodiscard]] bool is_clear_of_home(const Box& box, double margin) const;
    [[nodiscard]] bool is_behind_prop(const glm::dvec2& at) const {
        return at.y > home.y && std::abs(at.x - home.x) < home_radius;
    }

    Box room; ///< the picture's edge is `border_m` away
    glm::dvec2 home{0.0};
    double home_radius = 0.0;
    bool usable = false; ///< there is room, and the lens is above the prop
    std::array<glm::dvec2, direction_count> directions{};
    std::array<double, direction_count> reach{};
};

ReadersTable::ReadersTable(const TableSetUp& set_up, int quarter_turns)
    : home(turned(set_up.home_m, -quarter_turns)) {
    Polygon picture;
    for (const glm::dvec2& corner : set_up.picture_m) {
        picture.push_back(turned(corner, -quarter_turns));
    }
    const Rectangle inside = picture.size() >= 3 ? rectangle_inside(picture) : Rectangle{};
    room = {inside.centre_m, inside.half_m - border_m};
    usable = room.half.x > 0.0 && room.half.y > 0.0 && !set_up.prop.corners.empty();
    const glm::dvec2 lens = turned(glm::dvec2(set_up.lens_m), -quarter_turns);
    reach.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < direction_count; ++k) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / direction_count;
        directions[k] = {std::cos(angle), std::sin(angle)};
    }
    for (const glm::dvec3& corner : set_up.prop.corners) {
        usable = usable && corner.z < 0.99 * set_up.lens_m.z;
        const double larger = set_up.lens_m.z / (set_up.lens_m.z - corner.z);
        const glm::dvec2 middle = lens + larger * (home - lens);
        const double radius = larger * glm::length(glm::dvec2(corner));
        for (std::size_t k = 0; k < direction_count; ++k) {
            reach[k] = std::max(reach[k], glm::dot(directions[k], middle) + radius);
        }
        home_radius = std::max(home_radius, radius);
    }
}

/// By a separating axis: the directions are the normals of all edges, the box's too.
bool ReadersTable::is_clear_of_home(const Box& box, double margin) const {
    for (std::size_t k = 0; k < direction_count; ++k) {
        const double nearest =
            glm::dot(directions[k], box.centre) - glm::dot(glm::abs(directions[k]), box.half);
        if (nearest >= reach[k] + margin) {
            return true;
        }
    }
    return false;
}

/// Middles of rows, or of columns.
using Lines = std::vector<double>;

/// All ways to lay out lines of things of one size: spread evenly, or packed against both ends.
std::vector<Lines> ways_to_line_up(double middle, double half, double size) {
    std::vector<Lines> ways;
    const double length = 2.0 * half + rounding_m;
    for (std::size_t count = 1;; ++count) {
        const double spaces = static_cast<double>(count - 1);
        if (static_cast<double>(count) * size + spaces * gap_m > length) {
            break;
        }
        const double pitch = count > 1 ? std::min((2.0 * half - size) / spaces, size + widest_gap_m) : 0.0;
        Lines& spread = ways.emplace_back();
        for (std::size_t k = 0; k < count; ++k) {
            spread.push_back(middle + (static_cast<double>(k) - 0.5 * spaces) * pitch);
        }
        if (count % 2 == 0) {
            Lines& packed = ways.emplace_back();
            for (std::size_t k = 0; k < count / 2; ++k) {
                packed.push_back(middle - half + 0.5 * size + static_cast<double>(k) * (size + gap_m));
            }
            for (std::size_t k = count / 2; k-- > 0;) {
                packed.push_back(2.0 * middle - packed[k]);
            }
        }
    }
    return ways;
}

/// The places found for a number of pictures.
struct Found {
    double size = 0.0; ///< of the pictures; 0 = there is no room for so many
    double cost = 0.0;
    std::vector<glm::dvec2> middles; ///< of picture and title together; in reading order
};
/// [n]: for n pictures.
using FoundByCount = std::array<Found, most_table_places + 1>;

struct Place {
    glm::dvec2 middle{0.0};
    double cost = 0.0;
};

/// Left to right, row by row, from the one farthest from the reader.
void put_in_reading_order(std::vector<glm::dvec2>& middles) {
    std::sort(middles.begin(), middles.end(),
              [](const glm::dvec2& a, const glm::dvec2& b) { return a.y != b.y ? a.y > b.y : a.x < b.x; });
}

/// Takes the first n of `places`, nearest first, for every n for which nothing better was found yet.
void keep_better(FoundByCount& found, const std::vector<Place>& places, double size) {
    double sum = 0.0;
    for (std::size_t n = 1; n <= std::min(places.size(), most_table_places); ++n) {
        sum += places[n - 1].cost;
        const double cost =
            sum / static_cast<double>(n) + cost_of_unused_place * static_cast<double>(places.size() - n);
        Found& best = found[n];
        if (best.size > size || (best.size == size && best.cost <= cost + rounding_m)) {
            continue;
        }
        best = {size, cost, {}};
        for (std::size_t k = 0; k < n; ++k) {
            best.middles.push_back(places[k].middle);
        }
    }
}

glm::dvec2 size_of_place(double picture, const glm::dvec2& title) {
    return {std::max(picture, title.x), picture + title_gap_m + title.y};
}

FoundByCount find_places(const ReadersTable& table, const TableSetUp& set_up,
                         const std::optional<Box>& caption) {
    FoundByCount found;
    const glm::dvec2 reader(table.home.x, table.room.centre.y - table.room.half.y);
    const int steps =
        static_cast<int>(std::lround((most_table_picture_m - least_table_picture_m) / size_step_m));
    std::vector<Place> places;
    const std::size_t wanted = std::min(set_up.artifacts, most_table_places);
    for (int step = steps; step >= 0 && found[wanted].size <= 0.0; --step) {
        const double size = least_table_picture_m + step * size_step_m;
        const glm::dvec2 whole = size_of_place(size, set_up.title_m);
        for (const Lines& rows : ways_to_line_up(table.room.centre.y, table.room.half.y, whole.y)) {
            for (const Lines& columns : ways_to_line_up(table.room.centre.x, table.room.half.x, whole.x)) {
                places.clear();
                for (const double y : rows) {
                    for (const double x : columns) {
                        const Box box{{x, y}, 0.5 * whole};
                        if (table.is_clear_of_home(box, home_margin_m) &&
                            !(caption && box.overlaps(*caption, gap_m - rounding_m))) {
                            const double behind = table.is_behind_prop(box.centre) ? cost_behind_prop : 0.0;
                            places.push_back({box.centre, glm::distance(box.centre, reader) + behind});
                        }
                    }
                }
                std::stable_sort(places.begin(), places.end(),
                                 [](const Place& a, const Place& b) { return a.cost < b.cost - rounding_m; });
                keep_better(found, places, size);
            }
        }
    }
    return found;
}

/// Where a caption may be while the prop is at home, the best first: at the reader's edge, then at the sides.
std::vector<Box> caption_areas(const ReadersTable& table, const glm::dvec2& caption) {
    std::vector<Box> areas;
    const glm::dvec2 half = 0.5 * (caption + caption_slack_m);
    const glm::dvec2 way = table.room.half - half;
    if (way.x < 0.0 || way.y < 0.0) {
        return areas;
    }
    for (const glm::dvec2& anchor :
         {glm::dvec2(0, -1), glm::dvec2(1, -1), glm::dvec2(-1, -1), glm::dvec2(1, 0), glm::dvec2(-1, 0),
          glm::dvec2(1, 1), glm::dvec2(-1, 1), glm::dvec2(0, 1)}) {
        const Box area{table.room.centre + anchor * way, half};
        if (table.is_clear_of_home(area, caption_margin_m)) {
            areas.push_back(area);
        }
    }
    return areas;
}

/// How many places a page has, for so many artifacts where at most `most` find room: the last one leads on where there are
/// several pages, and all pages but the last are full.
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
    Found found;
    std::optional<Box> caption;
};

Candidate candidate_for(const ReadersTable& table, const TableSetUp& set_up,
                        const std::optional<Box>& caption, double penalty) {
    FoundByCount found = find_places(table, set_up, caption);
    std::size_t most = most_table_places;
    while (most > 0 && found[most].size <= 0.0) {
        --most;
    }
    if (most < 2) {
        return {0, 0.0, {}, caption};
    }
    const std::size_t places = places_of_page(set_up.artifacts, most);
    const std::size_t shown = places - (places < set_up.artifacts ? 1 : 0);
    return {shown, found[places].size - penalty, std::move(found[places]), caption};
}

/// With an area for the caption if that leaves places; the most artifacts on a page first, then the larger pictures.
Candidate best_candidate(const ReadersTable& table, const TableSetUp& set_up) {
    Candidate best;
    for (std::size_t shape = 0; shape < set_up.captions_m.size(); ++shape) {
        const std::vector<Box> areas = caption_areas(table, set_up.captions_m[shape]);
        for (std::size_t anchor = 0; anchor < areas.size(); ++anchor) {
            const double penalty = size_for_better_shape * static_cast<double>(shape) +
                                   size_for_better_anchor * static_cast<double>(anchor);
            Candidate candidate = candidate_for(table, set_up, areas[anchor], penalty);
            if (std::pair(candidate.shown, candidate.score) > std::pair(best.shown, best.score)) {
                best = std::move(candidate);
            }
        }
    }
    return best.shown > 0 ? best : candidate_for(table, set_up, std::nullopt, 0.0);
}

} // namespace

TableRectangle TablePlace::whole() const {
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
    put_in_reading_order(best.found.middles);
    const double size = best.found.size;
    const double above_middle = 0.5 * size_of_place(size, set_up.title_m).y;
    for (const glm::dvec2& middle : best.found.middles) {
        const glm::dvec2 picture = middle + glm::dvec2(0.0, above_middle - 0.5 * size);
        const glm::dvec2 title = middle - glm::dvec2(0.0, above_middle - 0.5 * set_up.title_m.y);
        const glm::dvec2 title_size(size_of_place(size, set_up.title_m).x, set_up.title_m.y);
        layout.places.push_back({{turned(picture, quarter_turns), glm::dvec2(size), quarter_turns},
                                 {turned(title, quarter_turns), title_size, quarter_turns}});
    }
    layout.has_more = layout.places.size() > 0 && best.shown < set_up.artifacts;
    if (best.caption) {
        layout.caption = TableRectangle{turned(best.caption->centre, quarter_turns), 2.0 * best.caption->half,
                                        quarter_turns};
    }
    return layout;
}

double place_brightness(const TablePlace& place, const std::optional<TablePolygon>& shadow) {
    return shadow ? ease(clearance(place.whole().corners(), shadow->corners()) / dimming_m) : 0.0;
}

} // namespace frustumscreen
