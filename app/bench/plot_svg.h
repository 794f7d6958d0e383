/// The SVG elements that plots are made of.
///
/// Units    CSS pixels, y down.
/// Threads  pure; any.
#pragma once

#include "app/bench/plot.h"

#include <string>
#include <string_view>

namespace frustumscreen {

/// `anchor`: start, middle or end. `more`: further attributes, each with a space before it.
[[nodiscard]] std::string text_at(double x, double y, std::string_view anchor, std::string_view words,
                                  std::string_view more = "");
[[nodiscard]] std::string mark_at(const glm::dvec2& at, PlotMark mark, std::string_view colour,
                                  double opacity);
/// The attributes of a line.
[[nodiscard]] std::string line_style(const PlotLook& look, std::string_view colour);

} // namespace frustumscreen
