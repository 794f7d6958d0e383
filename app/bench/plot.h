/// Small plots as SVG: points and lines over linear or logarithmic axes, dark on white, labels that do not
/// overlap.
///
/// Units    the data's own; the picture is in CSS pixels.
/// Errors   none: points that an axis cannot show (not finite, not positive on a logarithmic one) are left
///          out.
/// Threads  pure; any. The same plot gives the same bytes.
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

enum class PlotMark { Disc, Ring, Square, Diamond, Triangle, Cross, None };

struct PlotLook {
    int colour = -1; ///< of the palette; below 0: the series' place
    PlotMark mark = PlotMark::Disc;
    double line_px = 1.5;
    bool dashed = false;
    bool stepped = false;  ///< a line keeps its y until the next point's x
    double opacity = 1.0;  ///< of the marks
    bool in_legend = true; ///< no: it goes with another series
};

struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;
    bool joined = true; ///< by a line, in order
    PlotLook look{};
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
    std::string corner{}; ///< words in the lower left corner
    double y_least = 0.0; ///< above 0: the axis goes no lower; what lies below is drawn there
};

/// The plots one below the other as one SVG file, each with its legend.
[[nodiscard]] std::string svg_of(std::span<const Plot> plots);

/// The plots in rows of `columns` under one heading, with one legend (of the first plot) and notes below: the
/// format of a slide.
[[nodiscard]] std::string svg_sheet(const std::string& heading, std::span<const Plot> plots,
                                    std::size_t columns, std::span<const std::string> notes);

} // namespace frustumscreen
