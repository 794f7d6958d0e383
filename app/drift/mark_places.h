/// Places of the drift marks on the table: near the picture's corners and edges, where a movement shows most
/// and disturbs least.
///
/// Frames   table T, metres.
/// Threads  pure; any.
#pragma once

#include "app/settings/settings.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen::drift {

/// At most max_marks; places outside the table are skipped.
[[nodiscard]] std::vector<glm::dvec2> mark_places(const settings::Settings& settings);

} // namespace frustumscreen::drift
