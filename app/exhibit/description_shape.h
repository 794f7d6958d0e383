/// Places of a description's portions: all lie where the largest does, so that the text does not move between
/// portions.
///
/// Frame    table T, metres.
/// Threads  pure; any. `portion_place` allocates nothing.
#pragma once

#include "app/typography/captions.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen::exhibit {

/// The sizes of a description's portions.
struct DescriptionShape {
    std::vector<std::vector<glm::dvec2>> sizes_m; ///< by portion and by width
    std::vector<glm::dvec2> largest_m;            ///< for each width, `largest_sizes` of them
    bool flush_right = false;                     ///< lines begin at the right
};

/// For each width, the size that holds all portions.
[[nodiscard]] std::vector<glm::dvec2> largest_sizes(const std::vector<std::vector<glm::dvec2>>& sizes_m);

/// The portion's place at the top of `whole`, where the reader begins.
[[nodiscard]] typography::TableRectangle portion_place(const typography::TableRectangle& whole,
                                                       const glm::dvec2& size_m, bool flush_right);

} // namespace frustumscreen::exhibit
