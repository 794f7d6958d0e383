/// The table as the reader sees it: turned so that the reader stands at the front, with the place of the prop at home.
///
/// Frames   the reader's: table T turned by quarter turns about its origin; metres.
/// Threads  pure; any.
/// Errors   none: a table that nothing can lie on is not `usable`.
#pragma once

#include "app/exhibit/table_layout.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace frustumscreen {

/// A rectangle on the table, along its axes.
struct TableArea {
    glm::dvec2 centre{0.0};
    glm::dvec2 half{0.0};
    [[nodiscard]] bool overlaps(const TableArea& other, double margin) const {
        const glm::dvec2 apart = glm::abs(centre - other.centre) - half - other.half;
        return std::max(apart.x, apart.y) < margin;
    }
};

/// What the prop at home may hide, at any yaw, is the convex hull of circles: those on which its corners go round, as seen
/// from the lens. It is kept as how far it reaches in each of some directions.
struct ReadersTable {
    static constexpr std::size_t direction_count = 32;

    ReadersTable(const TableSetUp& set_up, int quarter_turns);
    [[nodiscard]] bool is_clear_of_home(const TableArea& area, double margin) const;
    [[nodiscard]] bool is_behind_prop(const glm::dvec2& at) const {
        return at.y > home.y && std::abs(at.x - home.x) < home_radius;
    }

    TableArea room; ///< the picture's edge is `border_m` away
    glm::dvec2 home{0.0};
    double home_radius = 0.0;
    double hidden_around_home = 0.0; ///< in every direction
    bool usable = false;             ///< there is room, and the lens is above the prop
    std::array<glm::dvec2, direction_count> directions{};
    std::array<double, direction_count> reach{};
};

} // namespace frustumscreen
