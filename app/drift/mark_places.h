/// Where on the table marks of light are shown: near the picture's corners and edges, where a move shows most and least lies.
///
/// Frames   table T, metres.
/// Threads  pure; any.
#pragma once

#include "app/settings/settings.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen {

/// At most most_marks. What would fall beside the table is left out.
[[nodiscard]] std::vector<glm::dvec2> mark_places(const Settings& settings);

} // namespace frustumscreen
