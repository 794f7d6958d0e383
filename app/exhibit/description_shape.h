/// Where the portions of a description lie: all in the place of the largest, so that the text stands still while it goes on.
///
/// Frame    table T, metres.
/// Threads  pure; any. `portion_place` allocates nothing.
#pragma once

#include "app/typography/captions.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen {

/// The sizes of a description's portions.
struct DescriptionShape {
    std::vector<std::vector<glm::dvec2>> sizes_m; ///< by portion and by width
    std::vector<glm::dvec2> largest_m;            ///< for each width; as `largest_sizes` of them
    bool flush_right = false;                     ///< its lines begin at the right
};

/// For each width the size that holds all of them.
[[nodiscard]] std::vector<glm::dvec2> largest_sizes(const std::vector<std::vector<glm::dvec2>>& sizes_m);

/// At the top of `whole`, where the reader begins.
[[nodiscard]] TableRectangle portion_place(const TableRectangle& whole, const glm::dvec2& size_m,
                                           bool flush_right);

} // namespace frustumscreen
