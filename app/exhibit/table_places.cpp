#include "app/exhibit/table_places.h"

#include <utility>

namespace frustumscreen::exhibit {

namespace {

constexpr double widest_gap_m = 0.050; ///< a wider row falls apart
constexpr double size_step_m = 0.0025;
constexpr double home_margin_m = 0.015; ///< beyond dimming: with the prop at home, pictures are bright
constexpr double rounding_m = 1e-9;

/// Costs in metres of distance from the reader, or of picture size.
constexpr double cost_behind_prop = 1.0;
constexpr double cost_of_unused_place = 0.2;
constexpr double size_for_even_rows = 0.015;

/// An interval along one axis.
struct Span {
    double low = 0.0;
    double high = 0.0;
};

/// Middles of rows or of columns.
struct Lines {
    std::vector<double> middles;
    bool split = false; ///< half of the lines are at each end
};

/// All ways to arrange lines of one size: spread evenly about a middle, or packed against both ends.
std::vector<Lines> ways_to_line_up(const Span& span, double wanted_middle, double size) {
    std::vector<Lines> ways;
    const double length = span.high - span.low;
    for (std::size_t count = 1;; ++count) {
        const double spaces = static_cast<double>(count - 1);
        if (static_cast<double>(count) * size + spaces * table_gap_m > length + rounding_m) {
            break;
        }
        const double pitch = count > 1 ? std::min((length - size) / spaces, size + widest_gap_m) : 0.0;
        const double half = 0.5 * (spaces * pitch + size);
        const double middle = std::max(span.low + half, std::min(span.high - half, wanted_middle));
        std::vector<double>& spread = ways.emplace_back().middles;
        for (std::size_t k = 0; k < count; ++k) {
            spread.push_back(middle + (static_cast<double>(k) - 0.5 * spaces) * pitch);
        }
        if (count % 2 == 0) {
            Lines& packed = ways.emplace_back();
            packed.split = true;
            for (std::size_t k = 0; k < count / 2; ++k) {
                packed.middles.push_back(span.low + 0.5 * size +
                                         static_cast<double>(k) * (size + table_gap_m));
            }
            for (std::size_t k = count / 2; k-- > 0;) {
                packed.middles.push_back(span.low + span.high - packed.middles[k]);
            }
        }
    }
    return ways;
}

/// Sorts left to right, row by row, from the row farthest from the reader.
void put_in_reading_order(std::vector<glm::dvec2>& middles) {
    std::sort(middles.begin(), middles.end(),
              [](const glm::dvec2& a, const glm::dvec2& b) { return a.y != b.y ? a.y > b.y : a.x < b.x; });
}

/// True if all rows have the same columns.
bool has_equal_rows(const std::vector<glm::dvec2>& middles) {
    const auto length = static_cast<std::size_t>(std::count_if(
        middles.begin(), middles.end(), [&](const glm::dvec2& at) { return at.y == middles.front().y; }));
    for (std::size_t k = length; k < middles.size(); ++k) {
        if (middles[k].x != middles[k - length].x) {
            return false;
        }
    }
    return middles.size() % length == 0;
}

struct Place {
    glm::dvec2 middle{0.0};
    double cost = 0.0;
};

/// The usable places of a lattice, nearest first.
struct Lattice {
    double size = 0.0;        ///< of the pictures
    double line = 0.0;        ///< x of the mirror line of the pairs
    bool split = false;       ///< its rows are split
    std::vector<Place> pairs; ///< the left one of each pair
    std::vector<Place> singles;
    [[nodiscard]] std::size_t places() const { return 2 * pairs.size() + singles.size(); }
};

/// Uses `pairs` pairs and some singles for n pictures, if that is better than `best`. If a pair is only half needed,
/// its last place in reading order is dropped.
void keep_if_better(FoundPlaces& best, const Lattice& lattice, std::size_t n, std::size_t pairs) {
    const std::size_t singles = n - std::min(n, 2 * pairs);
    double sum = 0.0;
    for (std::size_t k = 0; k < pairs; ++k) {
        sum += 2.0 * lattice.pairs[k].cost;
    }
    for (std::size_t k = 0; k < singles; ++k) {
        sum += lattice.singles[k].cost;
    }
    const double cost = sum / static_cast<double>(2 * pairs + singles) +
                        cost_of_unused_place * static_cast<double>(std::max(lattice.places(), n) - n);
    const auto is_better = [&](double value) {
        return best.size <= 0.0 || value > best.value ||
               (value == best.value && cost < best.cost - rounding_m);
    };
    const double uneven = lattice.size - size_for_even_rows;
    if (!is_better(lattice.split ? uneven : lattice.size)) {
        return;
    }
    std::vector<glm::dvec2> middles;
    for (std::size_t k = 0; k < pairs; ++k) {
        const glm::dvec2& left = lattice.pairs[k].middle;
        middles.insert(middles.end(), {left, {2.0 * lattice.line - left.x, left.y}});
    }
    for (std::size_t k = 0; k < singles; ++k) {
        middles.push_back(lattice.singles[k].middle);
    }
    put_in_reading_order(middles);
    const double value = !lattice.split && has_equal_rows(middles) ? lattice.size : uneven;
    if (!is_better(value)) {
        return;
    }
    middles.resize(n);
    best = {.size = lattice.size, .value = value, .cost = cost, .middles = std::move(middles)};
}

/// For every n, keeps the best of the lattice if it beats `found`: pairs and, for the rest, singles.
void keep_better(FoundByCount& found, const Lattice& lattice) {
    for (std::size_t n = 1; n <= std::min(lattice.places(), max_table_places); ++n) {
        for (std::size_t pairs = 0; pairs <= std::min(lattice.pairs.size(), (n + 1) / 2); ++pairs) {
            if (2 * pairs + lattice.singles.size() >= n && lattice.size > found[n].value - rounding_m) {
                keep_if_better(found[n], lattice, n, pairs);
            }
        }
    }
}

/// The spans for rows: between the table's edges, or between the caption and an edge.
std::vector<Span> row_spans(const PictureArea& area) {
    const ReadersTable& table = area.table;
    const std::optional<TableArea>& caption = area.caption;
    const Span whole{table.inner.centre.y - table.inner.half.y, table.inner.centre.y + table.inner.half.y};
    std::vector<Span> spans{whole};
    if (caption) {
        spans.push_back({caption->centre.y + caption->half.y + table_gap_m, whole.high});
        spans.push_back({whole.low, caption->centre.y - caption->half.y - table_gap_m});
    }
    return spans;
}

Span column_span(const PictureArea& area) {
    const ReadersTable& table = area.table;
    const double half_on_both_sides = table.inner.half.x - std::abs(table.home.x - table.inner.centre.x);
    return area.symmetric
               ? Span{table.home.x - half_on_both_sides, table.home.x + half_on_both_sides}
               : Span{table.inner.centre.x - table.inner.half.x, table.inner.centre.x + table.inner.half.x};
}

/// Fills a lattice with its usable places; of a symmetric one, those whose mirror image is usable too.
void fill(Lattice& lattice, const PictureArea& area, const Lines& rows, const Lines& columns,
          const glm::dvec2& whole) {
    const ReadersTable& table = area.table;
    const glm::dvec2 reader(table.home.x, table.inner.centre.y - table.inner.half.y);
    lattice.split = rows.split;
    lattice.pairs.clear();
    lattice.singles.clear();
    for (const double y : rows.middles) {
        for (const double x : columns.middles) {
            const glm::dvec2 at(x, y);
            const bool is_pair = area.symmetric && std::abs(x - lattice.line) > rounding_m;
            if ((is_pair && x > lattice.line) || !area.holds({at, 0.5 * whole}) ||
                (is_pair && !area.holds({{2.0 * lattice.line - x, y}, 0.5 * whole}))) {
                continue;
            }
            const double behind = table.is_behind_prop(at) ? cost_behind_prop : 0.0;
            (is_pair ? lattice.pairs : lattice.singles).push_back({at, glm::distance(at, reader) + behind});
        }
    }
    for (std::vector<Place>* places : {&lattice.pairs, &lattice.singles}) {
        std::stable_sort(places->begin(), places->end(),
                         [](const Place& a, const Place& b) { return a.cost < b.cost - rounding_m; });
    }
}

} // namespace

bool PictureArea::holds(const TableArea& area) const {
    return !(caption && area.overlaps(*caption, table_gap_m - rounding_m)) &&
           table.is_clear_of_home(area, home_margin_m);
}

glm::dvec2 size_of_place(double picture, const glm::dvec2& title) {
    return {std::max(picture, title.x), picture + table_title_gap_m + title.y};
}

FoundByCount find_places(const PictureArea& area, const TableSetUp& set_up, double min_size_m) {
    FoundByCount found;
    const int steps =
        static_cast<int>(std::lround((max_table_picture_m - min_table_picture_m) / size_step_m));
    const Span across = column_span(area);
    const std::size_t wanted = std::min(set_up.artifacts, max_table_places);
    Lattice lattice;
    lattice.line = area.table.home.x;
    for (int step = steps; step >= 0; --step) {
        lattice.size = min_table_picture_m + step * size_step_m;
        if (lattice.size < std::max(found[wanted].value + rounding_m, min_size_m)) {
            break;
        }
        const glm::dvec2 whole = size_of_place(lattice.size, set_up.title_m);
        const std::vector<Lines> columns = ways_to_line_up(across, 0.5 * (across.low + across.high), whole.x);
        for (const Span& span : row_spans(area)) {
            for (const Lines& rows : ways_to_line_up(span, area.table.home.y, whole.y)) {
                for (const Lines& each : columns) {
                    fill(lattice, area, rows, each, whole);
                    keep_better(found, lattice);
                }
            }
        }
    }
    return found;
}

void come_nearer_to_prop(const PictureArea& area, const glm::dvec2& whole, std::vector<glm::dvec2>& middles) {
    const double line = area.table.home.x;
    const auto nearer = [&](const glm::dvec2& at, double by) {
        return glm::dvec2(at.x + (at.x < line ? by : -by), at.y);
    };
    const auto holds = [&](double by) {
        return std::all_of(middles.begin(), middles.end(), [&](const glm::dvec2& at) {
            const bool beside = std::abs(at.x - line) - by - 0.5 * whole.x > 0.5 * area.table.home_radius;
            return beside && area.holds({nearer(at, by), 0.5 * whole});
        });
    };
    constexpr double step_m = 0.001;
    double way = 0.0;
    while (holds(way + step_m)) {
        way += step_m;
    }
    for (glm::dvec2& at : middles) {
        at = nearer(at, 0.5 * way);
    }
}

} // namespace frustumscreen::exhibit
