/// The table as the reader sees it: turned so that the reader stands at the front, with the prop at its home place.
///
/// Frames   the reader's: table T turned by quarter turns about its origin; metres.
/// Threads  pure; any.
/// Errors   none: a table without usable area is not `usable`.
#pragma once

#include "app/exhibit/table_layout.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace frustumscreen::exhibit {

/// A rectangle on the table, along its axes.
struct TableArea {
    glm::dvec2 centre{0.0};
    glm::dvec2 half{0.0};
    [[nodiscard]] bool overlaps(const TableArea& other, double margin) const {
        const glm::dvec2 apart = glm::abs(centre - other.centre) - half - other.half;
        return std::max(apart.x, apart.y) < margin;
    }
};

/// The area that the prop at home may hide at any yaw is the convex hull of the circles that its corners describe, as
/// seen from the lens. It is stored as its reach in each of several directions.
struct ReadersTable {
    static constexpr std::size_t direction_count = 32;

    ReadersTable(const TableSetUp& set_up, int quarter_turns);
    [[nodiscard]] bool is_clear_of_home(const TableArea& area, double margin) const;
    [[nodiscard]] bool is_behind_prop(const glm::dvec2& at) const {
        return at.y > home.y && std::abs(at.x - home.x) < home_radius;
    }

    TableArea inner; ///< `border_m` inside the picture's edge
    glm::dvec2 home{0.0};
    double home_radius = 0.0;
    double hidden_around_home = 0.0; ///< in every direction
    bool usable = false;             ///< the inner area is not empty, and the lens is above the prop
    std::array<glm::dvec2, direction_count> directions{};
    std::array<double, direction_count> reach{};
};

} // namespace frustumscreen::exhibit
