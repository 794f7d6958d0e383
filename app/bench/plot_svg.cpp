#include "app/bench/plot_svg.h"

#include "firmware_host/base/xml_text.h"

#include <fmt/format.h>

namespace frustumscreen {

namespace {

constexpr double mark_px = 4.0;

} // namespace

std::string text_at(double x, double y, std::string_view anchor, std::string_view words,
                    std::string_view more) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                       xml_text(words));
}

std::string mark_at(const glm::dvec2& at, PlotMark mark, std::string_view colour, double opacity) {
    const double r = mark_px;
    const std::string fill = opacity < 1.0 ? fmt::format("fill=\"{}\" fill-opacity=\"{:g}\"", colour, opacity)
                                           : fmt::format("fill=\"{}\"", colour);
    switch (mark) {
    case PlotMark::Disc:
        return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\" {}/>\n", at.x, at.y, r, fill);
    case PlotMark::Ring:
        return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\" fill=\"#ffffff\" stroke=\"{}\" "
                           "stroke-width=\"1.5\"/>\n",
                           at.x, at.y, r - 0.5, colour);
    case PlotMark::Square:
        return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:g}\" height=\"{:g}\" {}/>\n",
                           at.x - 0.9 * r, at.y - 0.9 * r, 1.8 * r, 1.8 * r, fill);
    case PlotMark::Diamond:
        return fmt::format("<path d=\"M{:.1f} {:.1f}l{:g} {:g}l-{:g} {:g}l-{:g} -{:g}z\" {}/>\n", at.x,
                           at.y - 1.4 * r, 1.4 * r, 1.4 * r, 1.4 * r, 1.4 * r, 1.4 * r, 1.4 * r, fill);
    case PlotMark::Triangle:
        return fmt::format("<path d=\"M{:.1f} {:.1f}l{:g} {:g}h-{:g}z\" {}/>\n", at.x, at.y - 1.2 * r,
                           1.2 * r, 2.1 * r, 2.4 * r, fill);
    case PlotMark::Cross:
        return fmt::format("<path d=\"M{:.1f} {:.1f}l{:g} {:g}m0 -{:g}l-{:g} {:g}\" fill=\"none\" "
                           "stroke=\"{}\" stroke-width=\"2.5\"/>\n",
                           at.x - r, at.y - r, 2.0 * r, 2.0 * r, 2.0 * r, 2.0 * r, 2.0 * r, colour);
    case PlotMark::None:
        break;
    }
    return {};
}

std::string line_style(const PlotLook& look, std::string_view colour) {
    return fmt::format("stroke=\"{}\" stroke-width=\"{:g}\"{}", colour, look.line_px,
                       look.dashed ? " stroke-dasharray=\"5 4\"" : "");
}

} // namespace frustumscreen
