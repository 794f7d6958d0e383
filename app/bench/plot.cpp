#include "app/bench/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace frustumscreen {

namespace {

constexpr double plot_width = 860.0;
constexpr double plot_height = 460.0;
constexpr double left = 76.0, right = 190.0, above = 44.0,
                 below = 58.0;                 ///< margins; the legend is on the right
constexpr double letter = 12.0;                ///< size of text
constexpr double letter_width = 0.56 * letter; ///< mean advance of a sans-serif face, on the wide side

/// Dark enough on white, and told apart with any colour vision (Okabe & Ito 2008, darkened).
constexpr std::array<std::string_view, 7> colours = {"#00507f", "#b34700", "#00694d", "#8a3d6d",
                                                     "#1f1f1f", "#7a6200", "#2f7fb0"};

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
    }
    return result;
}

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

/// From values to the 0..1 of an axis, and the values that get a tick.
class Axis {
public:
    explicit Axis(bool logarithmic) : logarithmic_(logarithmic) {}

    [[nodiscard]] bool shows(double value) const {
        return std::isfinite(value) && (!logarithmic_ || value > 0.0);
    }
    void include(double value) {
        if (shows(value)) {
            low_ = std::min(low_, scaled(value));
            high_ = std::max(high_, scaled(value));
        }
    }
    /// After the last `include`: some room at both ends.
    void settle() {
        if (!(low_ <= high_)) {
            low_ = 0.0;
            high_ = 1.0;
        }
        if (!logarithmic_) {
            low_ = std::min(low_, 0.0);
        }
        const double room = std::max(0.06 * (high_ - low_), high_ == low_ ? 0.3 : 0.0);
        low_ -= logarithmic_ || low_ < 0.0 ? room : 0.0;
        high_ += room;
    }
    [[nodiscard]] double place(double value) const { return (scaled(value) - low_) / (high_ - low_); }
    [[nodiscard]] std::vector<double> ticks() const {
        std::vector<double> values;
        const double span = high_ - low_;
        if (logarithmic_) {
            const bool fine = span < 2.6;
            for (int decade = static_cast<int>(std::floor(low_));
                 decade <= static_cast<int>(std::ceil(high_)); ++decade) {
                for (const double digit : {1.0, 2.0, 5.0}) {
                    if (digit == 1.0 || fine) {
                        values.push_back(digit * std::pow(10.0, decade));
                    }
                }
            }
        } else {
            const double rough = span / 5.0;
            const double decade = std::pow(10.0, std::floor(std::log10(rough)));
            const double step = decade * (rough / decade > 5.0 ? 10.0 : rough / decade > 2.0 ? 5.0 : 2.0);
            for (double k = std::ceil(low_ / step); k * step <= high_; k += 1.0) {
                values.push_back(k * step);
            }
        }
        std::erase_if(values,
                      [this](double value) { return place(value) < -1e-9 || place(value) > 1.0 + 1e-9; });
        return values;
    }

private:
    [[nodiscard]] double scaled(double value) const { return logarithmic_ ? std::log10(value) : value; }
    bool logarithmic_;
    double low_ = std::numeric_limits<double>::infinity();
    double high_ = -std::numeric_limits<double>::infinity();
};

/// Of an axis: next to 0 counts as 0 where steps are added up, not where they are multiplied.
std::string number(double value, bool logarithmic) {
    const double size = std::abs(value);
    if (size >= 1e6) {
        return fmt::format("{:g}M", value / 1e6);
    }
    if (size >= 1e4) {
        return fmt::format("{:g}k", value / 1e3);
    }
    return fmt::format("{:g}", !logarithmic && size < 1e-12 ? 0.0 : value);
}

/// Draws one plot into a group of its own; keeps the boxes of what is written, so that nothing is written
/// over.
class Drawing {
public:
    explicit Drawing(const Plot& plot) : plot_(plot), x_(plot.log_x), y_(plot.log_y) {
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
        legend();
        for (std::size_t k = 0; k < plot_.series.size(); ++k) {
            line_and_points(plot_.series[k], colours[k % colours.size()]);
        }
        for (std::size_t k = 0; k < plot_.series.size(); ++k) {
            labels(plot_.series[k], colours[k % colours.size()]);
        }
        return std::move(out_);
    }

private:
    static constexpr Rect area_{left, above, plot_width - left - right, plot_height - above - below};

    [[nodiscard]] std::optional<glm::dvec2> place(const glm::dvec2& value) const {
        if (!x_.shows(value.x) || !y_.shows(value.y)) {
            return std::nullopt;
        }
        return glm::dvec2(area_.x + x_.place(value.x) * area_.width,
                          area_.y + (1.0 - y_.place(value.y)) * area_.height);
    }
    void text(double x, double y, std::string_view anchor, std::string_view words,
              std::string_view more = "") {
        out_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor,
                            more, escaped(words));
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
            text(x, bottom + 18.0, "middle", number(tick, plot_.log_x));
        }
        for (const double tick : y_.ticks()) {
            const double y = area_.y + (1.0 - y_.place(tick)) * area_.height;
            line({area_.x, y}, {area_.x + area_.width, y}, "stroke=\"#e3e3e3\"");
            text(area_.x - 8.0, y + 4.0, "end", number(tick, plot_.log_y));
        }
        out_ +=
            fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
                        "stroke=\"#404040\"/>\n",
                        area_.x, area_.y, area_.width, area_.height);
        text(left, 26.0, "start", plot_.title, " font-size=\"15\" font-weight=\"bold\"");
        text(area_.x + area_.width / 2.0, plot_height - 16.0, "middle", plot_.x_label);
        const double middle = area_.y + area_.height / 2.0;
        text(18.0, middle, "middle", plot_.y_label,
             fmt::format(" transform=\"rotate(-90 18 {:.1f})\"", middle));
    }

    void limits() {
        for (const PlotLimit& limit : plot_.limits) {
            if (!y_.shows(limit.y)) {
                continue;
            }
            const double y = area_.y + (1.0 - y_.place(limit.y)) * area_.height;
            line({area_.x, y}, {area_.x + area_.width, y}, "stroke=\"#a00000\" stroke-dasharray=\"6 4\"");
            text(area_.x + area_.width + 8.0, y + 4.0, "start", limit.label, " fill=\"#a00000\"");
            taken_.push_back({area_.x + area_.width, y - letter, right, 1.5 * letter});
            keep_clear({area_.x, y}, {area_.x + area_.width, y});
        }
    }

    void legend() {
        const double x = area_.x + area_.width + 10.0;
        double y = area_.y + 8.0;
        for (std::size_t k = 0; k < plot_.series.size(); ++k) {
            const auto hidden = [this, x, &y] {
                const Rect box{x, y - letter / 2.0, right, letter};
                return std::any_of(taken_.begin(), taken_.end(),
                                   [&box](const Rect& r) { return r.meets(box); });
            };
            while (hidden()) {
                y += letter / 2.0;
            }
            out_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", x + 4.0, y,
                                colours[k % colours.size()]);
            text(x + 14.0, y + 4.0, "start", plot_.series[k].name);
            y += 1.6 * letter;
        }
    }

    void line_and_points(const PlotSeries& series, std::string_view colour) {
        std::optional<glm::dvec2> before;
        for (const PlotPoint& point : series.points) {
            const std::optional<glm::dvec2> at = place(point.at);
            if (at && before && series.joined) {
                line(*before, *at, fmt::format("stroke=\"{}\" stroke-width=\"1.5\"", colour));
                keep_clear(*before, *at);
            }
            if (at) {
                out_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", at->x,
                                    at->y, colour);
                taken_.push_back({at->x - 5.0, at->y - 5.0, 10.0, 10.0});
            }
            before = at;
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
            const double width = static_cast<double>(point.label.size()) * letter_width;
            const std::optional<Rect> box = free_place(*at, width);
            if (!box) {
                continue;
            }
            taken_.push_back(*box);
            const glm::dvec2 middle(box->x + box->width / 2.0, box->y + box->height / 2.0);
            if (std::abs(middle.y - at->y) > 2.0 * letter) {
                line(*at,
                     {std::clamp(at->x, box->x, box->x + box->width),
                      middle.y < at->y ? box->y + box->height : box->y},
                     fmt::format("stroke=\"{}\" stroke-width=\"0.6\"", colour));
            }
            text(box->x, box->y + letter, "start", point.label, fmt::format(" fill=\"{}\"", colour));
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
    Axis x_;
    Axis y_;
    std::string out_;
    std::vector<Rect> taken_;
};

} // namespace

std::string svg_of(std::span<const Plot> plots) {
    const double height = plot_height * static_cast<double>(std::max<std::size_t>(plots.size(), 1));
    std::string svg =
        fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                    "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
                    "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"{2:.0f}\" "
                    "fill=\"#1a1a1a\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
                    plot_width, height, letter);
    double y = 0.0;
    for (const Plot& plot : plots) {
        svg += fmt::format("<g transform=\"translate(0 {:.0f})\">\n", y) + Drawing(plot).svg() + "</g>\n";
        y += plot_height;
    }
    return svg + "</svg>\n";
}

} // namespace frustumscreen
