#include "app/exhibit/description_shape.h"

#include "app/typography/visitor_side.h"

#include <algorithm>

namespace frustumscreen::exhibit {

std::vector<glm::dvec2> largest_sizes(const std::vector<std::vector<glm::dvec2>>& sizes_m) {
    std::vector<glm::dvec2> largest;
    for (const std::vector<glm::dvec2>& sizes : sizes_m) {
        largest.resize(std::max(largest.size(), sizes.size()), glm::dvec2(0.0));
        for (std::size_t shape = 0; shape < sizes.size(); ++shape) {
            largest[shape] = glm::max(largest[shape], sizes[shape]);
        }
    }
    return largest;
}

typography::TableRectangle portion_place(const typography::TableRectangle& whole, const glm::dvec2& size_m,
                                         bool flush_right) {
    const glm::dvec2 slack = 0.5 * (whole.size_m - size_m);
    const glm::dvec2 off(flush_right ? slack.x : -slack.x, slack.y);
    return {whole.centre_m + typography::turned(off, whole.quarter_turns), size_m, whole.quarter_turns};
}

} // namespace frustumscreen::exhibit
