/// Small plots as SVG: points and lines over linear or logarithmic axes, dark on white, labels that do not
/// overlap.
///
/// Units    the data's own; the picture is in CSS pixels.
/// Errors   none: points that an axis cannot show (not finite, not positive on a logarithmic one) are left
/// out. Threads  pure; any. The same plot gives the same bytes.
#pragma once

#include <glm/glm.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

struct PlotPoint {
    glm::dvec2 at{0.0};
    std::string label{}; ///< beside the point; may be empty
};

struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;
    bool joined = true; ///< by a line, in order
};

/// A horizontal line: a limit to hold.
struct PlotLimit {
    double y = 0.0;
    std::string label;
};

struct Plot {
    std::string title;
    std::string x_label;
    std::string y_label;
    bool log_x = true;
    bool log_y = true;
    std::vector<PlotSeries> series;
    std::vector<PlotLimit> limits;
};

/// The plots one below the other as one SVG file.
[[nodiscard]] std::string svg_of(std::span<const Plot> plots);

} // namespace frustumscreen
