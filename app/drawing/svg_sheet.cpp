#include "app/drawing/svg_sheet.h"

#include "firmware_host/base/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace frustumscreen::drawing {

namespace {

/// No more digits than can be printed, and never -0.
std::string number(double value) {
    return fmt::format("{:.9g}", std::round(1e3 * value) / 1e3 + 0.0);
}

std::string style(const Pen& pen) {
    std::string text =
        fmt::format(R"(stroke="{}" stroke-width="{}" fill="{}")", pen.stroke, number(pen.width_mm), pen.fill);
    return pen.dashes.empty() ? text : text + fmt::format(R"( stroke-dasharray="{}")", pen.dashes);
}

std::size_t letters_of(std::string_view words) {
    return static_cast<std::size_t>(std::count_if(words.begin(), words.end(), [](char c) {
        // Counts the first byte of each UTF-8 character.
        return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U;
    }));
}

constexpr std::array anchors{"start", "middle", "end"};
/// Millimetres of paper per metre.
constexpr std::array usual_scales{5000.0, 2000.0, 1000.0, 500.0, 200.0, 100.0, 50.0, 20.0, 10.0, 5.0};

} // namespace

double length_mm(std::string_view words, double height_mm) {
    constexpr double mean_width = 0.6; // of DejaVu Sans, the widest requested typeface
    return mean_width * height_mm * static_cast<double>(letters_of(words));
}

SvgSheet::SvgSheet(const glm::dvec2& size_mm) : size_mm_(size_mm) {}

void SvgSheet::line(const glm::dvec2& from, const glm::dvec2& to, const Pen& pen) {
    fmt::format_to(std::back_inserter(body_), "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" {}/>\n",
                   number(from.x), number(from.y), number(to.x), number(to.y), style(pen));
}

void SvgSheet::polygon(std::span<const glm::dvec2> corners, const Pen& pen, std::string_view name) {
    std::string points;
    for (const glm::dvec2& corner : corners) {
        points += fmt::format("{}{},{}", points.empty() ? "" : " ", number(corner.x), number(corner.y));
    }
    fmt::format_to(std::back_inserter(body_), "<polygon{} points=\"{}\" {}/>\n",
                   name.empty() ? "" : fmt::format(R"( data-name="{}")", xml_text(name)), points, style(pen));
}

void SvgSheet::circle(const glm::dvec2& middle, double radius_mm, const Pen& pen) {
    fmt::format_to(std::back_inserter(body_), "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {}/>\n", number(middle.x),
                   number(middle.y), number(radius_mm), style(pen));
}

void SvgSheet::text(const glm::dvec2& at, std::string_view words, const Lettering& lettering) {
    const std::string turn = lettering.turned_deg == 0.0
                                 ? std::string()
                                 : fmt::format(" transform=\"rotate({} {} {})\"",
                                               number(lettering.turned_deg), number(at.x), number(at.y));
    fmt::format_to(std::back_inserter(body_),
                   "<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\"{}{}>{}</text>\n",
                   number(at.x), number(at.y), number(lettering.height_mm),
                   anchors.at(static_cast<std::size_t>(lettering.anchor)),
                   lettering.bold ? R"( font-weight="bold")" : "", turn, xml_text(words));
}

void SvgSheet::begin_view(std::string_view name, const glm::dvec2& origin_mm, double mm_per_m) {
    fmt::format_to(std::back_inserter(body_),
                   "<g data-view=\"{}\" data-origin-mm=\"{} {}\" data-mm-per-m=\"{}\">\n", xml_text(name),
                   number(origin_mm.x), number(origin_mm.y), number(mm_per_m));
}

void SvgSheet::end_view() {
    body_ += "</g>\n";
}

std::string SvgSheet::take() const {
    return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                       "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" "
                       "viewBox=\"0 0 {0} {1}\" font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\">\n"
                       "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n{2}</svg>\n",
                       number(size_mm_.x), number(size_mm_.y), body_);
}

std::vector<glm::dvec2> View::operator()(std::span<const glm::dvec2> places_m) const {
    std::vector<glm::dvec2> places;
    for (const glm::dvec2& place : places_m) {
        places.push_back((*this)(place));
    }
    return places;
}

void Extent::include(const glm::dvec2& at) {
    low = glm::min(low, at);
    high = glm::max(high, at);
}

View fitted_view(const Extent& extent, const glm::dvec2& field_low_mm, const glm::dvec2& field_high_mm) {
    const glm::dvec2 size_m = extent.high - extent.low;
    const glm::dvec2 field_mm = field_high_mm - field_low_mm;
    const auto fits = [&](double mm_per_m) {
        return mm_per_m * size_m.x <= field_mm.x && mm_per_m * size_m.y <= field_mm.y;
    };
    const auto* const largest = std::find_if(usual_scales.begin(), usual_scales.end(), fits);
    const double mm_per_m = largest != usual_scales.end() ? *largest : usual_scales.back();
    const glm::dvec2 middle_m = 0.5 * (extent.low + extent.high);
    const glm::dvec2 middle_mm = 0.5 * (field_low_mm + field_high_mm);
    return {middle_mm - mm_per_m * glm::dvec2(middle_m.x, -middle_m.y), mm_per_m};
}

std::string scale_words(const View& view) {
    constexpr double true_size = 1000.0;
    return view.mm_per_m > true_size ? fmt::format("{:g} : 1", view.mm_per_m / true_size)
                                     : fmt::format("1 : {:g}", true_size / view.mm_per_m);
}

std::string mm_words(double metres) {
    return fmt::format("{:g}", std::round(1e4 * metres) / 10.0 + 0.0);
}

} // namespace frustumscreen::drawing
