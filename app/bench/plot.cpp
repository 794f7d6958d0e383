#include "app/bench/plot.h"

#include "app/bench/plot_axis.h"
#include "app/bench/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace frustumscreen {

namespace {

constexpr double letter = 12.0;                ///< size of text
constexpr double letter_width = 0.58 * letter; ///< mean advance of a sans-serif face, on the wide side

/// Size and margins of one plot.
struct Frame {
    double width, height;
    double left, right, above, below;
    bool legend; ///< on the right
};
constexpr Frame alone{860.0, 460.0, 76.0, 190.0, 44.0, 58.0, true};
constexpr Frame on_sheet{520.0, 430.0, 72.0, 18.0, 44.0, 58.0, false};

/// Dark enough on white, and told apart with any colour vision (Okabe & Ito 2008, darkened).
constexpr std::array<std::string_view, 8> colours = {"#00507f", "#b34700", "#00694d", "#8a3d6d",
                                                     "#1f1f1f", "#7a6200", "#2f7fb0", "#d0308f"};

struct Rect {
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
    [[nodiscard]] bool meets(const Rect& other) const {
        return x < other.x + other.width && other.x < x + width && y < other.y + other.height &&
               other.y < y + height;
    }
    [[nodiscard]] bool inside(const Rect& other) const {
        return x >= other.x && y >= other.y && x + width <= other.x + other.width &&
               y + height <= other.y + other.height;
    }
};

std::string_view colour_of(const std::vector<PlotSeries>& series, std::size_t k) {
    const int own = series[k].look.colour;
    return colours[(own >= 0 ? static_cast<std::size_t>(own) : k) % colours.size()];
}

/// Mark, a piece of line and the name, from (x, y) to the right.
std::string legend_entry(const std::vector<PlotSeries>& series, std::size_t k, double x, double y) {
    const PlotSeries& one = series[k];
    std::string entry;
    if (one.joined && one.points.size() > 1) {
        entry += fmt::format("<path d=\"M{:.1f} {:.1f}h20\" fill=\"none\" {}/>\n", x - 6.0, y,
                             line_style(one.look, colour_of(series, k)));
    }
    entry += mark_at({x + 4.0, y}, one.look.mark, colour_of(series, k), 1.0);
    return entry + text_at(x + 20.0, y + 4.0, "start", one.name);
}

/// Draws one plot into a group of its own; keeps the boxes of what is written, so that nothing is written
/// over.
class Drawing {
public:
    Drawing(const Plot& plot, const Frame& frame)
        : plot_(plot), frame_(frame), area_{frame.left, frame.above, frame.width - frame.left - frame.right,
                                            frame.height - frame.above - frame.below},
          x_(plot.log_x), y_(plot.log_y) {
        if (plot.y_least > 0.0) {
            y_.no_lower_than(plot.y_least);
        }
        for (const PlotSeries& series : plot.series) {
            for (const PlotPoint& point : series.points) {
                if (x_.shows(point.at.x) && y_.shows(point.at.y)) {
                    x_.include(point.at.x);
                    y_.include(point.at.y);
                }
            }
        }
        for (const PlotLimit& limit : plot.limits) {
            y_.include(limit.y);
        }
        x_.settle();
        y_.settle();
    }

    std::string svg() {
        frame();
        limits();
        if (!plot_.corner.empty()) {
            out_ += text_at(area_.x + 8.0, area_.y + area_.height - 9.0, "start", plot_.corner,
                            " fill=\"#808080\" font-style=\"italic\"");
        }
        if (frame_.legend) {
            legend();
        }
        for (std::size_t k = plot_.series.size(); k-- > 0;) { // the first on top
            line_through(plot_.series[k], colour_of(plot_.series, k));
        }
        for (std::size_t k = plot_.series.size(); k-- > 0;) {
            marks(plot_.series[k], colour_of(plot_.series, k));
        }
        for (std::size_t k = 0; k < plot_.series.size(); ++k) {
            labels(plot_.series[k], colour_of(plot_.series, k));
        }
        return std::move(out_);
    }

private:
    [[nodiscard]] std::optional<glm::dvec2> place(const glm::dvec2& value) const {
        if (!x_.shows(value.x) || !y_.shows(value.y)) {
            return std::nullopt;
        }
        return glm::dvec2(area_.x + x_.place(value.x) * area_.width,
                          area_.y + (1.0 - y_.place(value.y)) * area_.height);
    }
    void line(glm::dvec2 from, glm::dvec2 to, std::string_view style) {
        out_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", from.x,
                            from.y, to.x, to.y, style);
    }

    void frame() {
        const double bottom = area_.y + area_.height;
        for (const double tick : x_.ticks()) {
            const double x = area_.x + x_.place(tick) * area_.width;
            line({x, area_.y}, {x, bottom}, "stroke=\"#e3e3e3\"");
            out_ += text_at(x, bottom + 18.0, "middle", x_.number(tick));
        }
        for (const double tick : y_.ticks()) {
            const double y = area_.y + (1.0 - y_.place(tick)) * area_.height;
            line({area_.x, y}, {area_.x + area_.width, y}, "stroke=\"#e3e3e3\"");
            out_ += text_at(area_.x - 8.0, y + 4.0, "end", y_.number(tick));
        }
        out_ +=
            fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
                        "stroke=\"#404040\"/>\n",
                        area_.x, area_.y, area_.width, area_.height);
        out_ += text_at(area_.x, 26.0, "start", plot_.title, " font-size=\"15\" font-weight=\"bold\"");
        out_ += text_at(area_.x + area_.width / 2.0, frame_.height - 16.0, "middle", plot_.x_label);
        const double middle = area_.y + area_.height / 2.0;
        out_ += text_at(18.0, middle, "middle", plot_.y_label,
                        fmt::format(" transform=\"rotate(-90 18 {:.1f})\"", middle));
    }

    void limits() {
        for (const PlotLimit& limit : plot_.limits) {
            if (!y_.shows(limit.y)) {
                continue;
            }
            const double y = area_.y + (1.0 - y_.place(limit.y)) * area_.height;
            line({area_.x, y}, {area_.x + area_.width, y}, "stroke=\"#a00000\" stroke-dasharray=\"6 4\"");
            out_ += text_at(area_.x + area_.width + 8.0, y + 4.0, "start", limit.label, " fill=\"#a00000\"");
            taken_.push_back({area_.x + area_.width, y - letter, frame_.right, 1.5 * letter});
            keep_clear({area_.x, y}, {area_.x + area_.width, y});
        }
    }

    /// Where the limits' labels leave room for all of it, else around them.
    void legend() {
        const double x = area_.x + area_.width + 14.0;
        const auto free_from = [&](double top, double height) {
            const Rect box{x, top, frame_.right, height};
            return std::none_of(taken_.begin(), taken_.end(), [&box](const Rect& r) { return r.meets(box); });
        };
        const double row = 1.6 * letter;
        const double all = row * static_cast<double>(std::count_if(
                                     plot_.series.begin(), plot_.series.end(),
                                     [](const PlotSeries& series) { return series.look.in_legend; }));
        double y = area_.y;
        while (y + all < area_.y + area_.height && !free_from(y, all)) {
            y += letter / 2.0;
        }
        y = free_from(y, all) ? y : area_.y;
        for (std::size_t k = 0; k < plot_.series.size(); ++k) {
            if (plot_.series[k].look.in_legend) {
                while (!free_from(y, row)) {
                    y += letter / 2.0;
                }
                out_ += legend_entry(plot_.series, k, x, y + row / 2.0);
                y += row;
            }
        }
    }

    void line_through(const PlotSeries& series, std::string_view colour) {
        std::string path;
        std::optional<glm::dvec2> before;
        for (const PlotPoint& point : series.points) {
            const std::optional<glm::dvec2> at = place(point.at);
            if (at && series.joined) {
                const glm::dvec2 corner(at->x, before && series.look.stepped ? before->y : at->y);
                if (before && series.look.stepped) {
                    path += fmt::format("L{:.1f} {:.1f}", corner.x, corner.y);
                    keep_clear(*before, corner);
                }
                path += fmt::format("{}{:.1f} {:.1f}", before ? "L" : "M", at->x, at->y);
                keep_clear(before ? (series.look.stepped ? corner : *before) : *at, *at);
            }
            before = at;
        }
        if (path.find('L') != std::string::npos) {
            out_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke-linejoin=\"round\" {}/>\n", path,
                                line_style(series.look, colour));
        }
    }

    void marks(const PlotSeries& series, std::string_view colour) {
        for (const PlotPoint& point : series.points) {
            const std::optional<glm::dvec2> at = place(point.at);
            if (at && series.look.mark != PlotMark::None) {
                out_ += mark_at(*at, series.look.mark, colour, series.look.opacity);
                taken_.push_back({at->x - 5.0, at->y - 5.0, 10.0, 10.0});
            }
        }
    }

    /// No label is written over this line.
    void keep_clear(const glm::dvec2& from, const glm::dvec2& to) {
        const int steps = static_cast<int>(glm::distance(from, to) / 5.0) + 1;
        for (int k = 0; k <= steps; ++k) {
            const glm::dvec2 at = glm::mix(from, to, static_cast<double>(k) / steps);
            taken_.push_back({at.x - 1.0, at.y - 1.0, 2.0, 2.0});
        }
    }

    /// Beside each point, at the nearest place where nothing stands yet; left out if there is none.
    void labels(const PlotSeries& series, std::string_view colour) {
        for (const PlotPoint& point : series.points) {
            const std::optional<glm::dvec2> at = place(point.at);
            if (!at || point.label.empty()) {
                continue;
            }
            const double width = static_cast<double>(point.label.size()) * letter_width + letter / 2.0;
            const std::optional<Rect> box = free_place(*at, width);
            if (!box) {
                continue;
            }
            taken_.push_back(*box);
            const glm::dvec2 nearest(std::clamp(at->x, box->x, box->x + box->width),
                                     std::clamp(at->y, box->y, box->y + box->height));
            if (glm::distance(nearest, *at) > 1.5 * letter) {
                line(*at, nearest, fmt::format("stroke=\"{}\" stroke-width=\"0.6\"", colour));
            }
            out_ +=
                text_at(box->x, box->y + letter, "start", point.label, fmt::format(" fill=\"{}\"", colour));
        }
    }

    [[nodiscard]] std::optional<Rect> free_place(const glm::dvec2& at, double width) const {
        const double height = 1.3 * letter;
        for (int ring = 0; ring < 30; ++ring) {
            const double away = 8.0 + ring * 7.0;
            const std::array<glm::dvec2, 6> corners = {glm::dvec2(at.x + 8.0, at.y - away - height / 2.0),
                                                       {at.x + 8.0, at.y + away - height / 2.0},
                                                       {at.x - width / 2.0, at.y - away - height},
                                                       {at.x - width / 2.0, at.y + away},
                                                       {at.x - width - 8.0, at.y - away - height / 2.0},
                                                       {at.x - width - 8.0, at.y + away - height / 2.0}};
            for (const glm::dvec2& corner : corners) {
                const Rect box{corner.x, corner.y, width, height};
                if (box.inside(area_) &&
                    std::none_of(taken_.begin(), taken_.end(),
                                 [&box](const Rect& other) { return other.meets(box); })) {
                    return box;
                }
            }
        }
        return std::nullopt;
    }

    const Plot& plot_;
    const Frame frame_;
    const Rect area_;
    Axis x_;
    Axis y_;
    std::string out_;
    std::vector<Rect> taken_;
};

std::string svg_file(double width, double height, const std::string& content) {
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"{2:.0f}\" "
        "fill=\"#1a1a1a\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{3}</svg>\n",
        width, height, letter, content);
}

std::string group_at(double x, double y, const std::string& content) {
    return fmt::format("<g transform=\"translate({:.0f} {:.0f})\">\n{}</g>\n", x, y, content);
}

} // namespace

std::string svg_of(std::span<const Plot> plots) {
    std::string content;
    double y = 0.0;
    for (const Plot& plot : plots) {
        content += group_at(0.0, y, Drawing(plot, alone).svg());
        y += alone.height;
    }
    return svg_file(alone.width, std::max(y, alone.height), content);
}

std::string svg_sheet(const std::string& heading, std::span<const Plot> plots, std::size_t columns,
                      std::span<const std::string> notes) {
    const double width = on_sheet.width * static_cast<double>(columns);
    std::string content =
        text_at(on_sheet.left, 36.0, "start", heading, " font-size=\"21\" font-weight=\"bold\"");
    double y = 50.0;
    for (std::size_t k = 0; k < plots.size(); ++k) {
        content +=
            group_at(on_sheet.width * static_cast<double>(k % columns), y, Drawing(plots[k], on_sheet).svg());
        y += (k + 1) % columns == 0 || k + 1 == plots.size() ? on_sheet.height : 0.0;
    }
    double x = on_sheet.left + 6.0;
    y += 14.0;
    for (std::size_t k = 0; !plots.empty() && k < plots[0].series.size(); ++k) {
        if (!plots[0].series[k].look.in_legend) {
            continue;
        }
        const double entry = 44.0 + letter_width * static_cast<double>(plots[0].series[k].name.size());
        if (x + entry > width) {
            x = on_sheet.left + 6.0;
            y += 1.8 * letter;
        }
        content += legend_entry(plots[0].series, k, x, y);
        x += entry;
    }
    for (const std::string& note : notes) {
        y += 1.8 * letter;
        content += text_at(on_sheet.left, y + 4.0, "start", note, " fill=\"#505050\"");
    }
    return svg_file(width, y + 24.0, content);
}

} // namespace frustumscreen
