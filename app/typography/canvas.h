/// Draws lines, text and pictures into a picture: alignment patterns and contact sheets.
///
/// Units    pixels; the top-left pixel covers (0, 0)-(1, 1), its centre is (0.5, 0.5).
/// Colour   sRGB codes in; edges are blended in linear light.
/// Threads  one; offline, or where a frame may take long.
#pragma once

#include "app/image/image.h"
#include "app/typography/text_image.h"

#include <glm/glm.hpp>

#include <span>
#include <string_view>

namespace frustumscreen::typography {

using Colour = glm::u8vec3;

/// The point of a text's box that is placed at the given position: 0 = left or top, 0.5 = middle, 1 = right
/// or bottom.
struct Anchor {
    double x = 0.0;
    double y = 0.0;
};

class Canvas {
public:
    Canvas(int width, int height, Colour background);
    explicit Canvas(image::Image8 image) : image_(std::move(image)) {}

    [[nodiscard]] const image::Image8& image() const { return image_; }
    [[nodiscard]] image::Image8 take() { return std::move(image_); }

    void fill(const glm::dvec2& low, const glm::dvec2& high, Colour colour, double opacity = 1.0);
    void line(const glm::dvec2& a, const glm::dvec2& b, double width_px, Colour colour, double opacity = 1.0);
    /// Closed polygon through the points.
    void outline(std::span<const glm::dvec2> points, double width_px, Colour colour, double opacity = 1.0);
    void circle(const glm::dvec2& centre, double radius_px, double width_px, Colour colour,
                double opacity = 1.0);
    /// One line of text.
    void text(const Typesetter& typesetter, std::string_view text, const glm::dvec2& position, double em_px,
              Colour colour, Anchor anchor = {}, bool bold = false);
    void coverage(const image::Image<std::uint8_t>& coverage, const glm::ivec2& corner, Colour colour);
    /// Scales `picture`'s rectangle [from, from + size) to the canvas rectangle at `corner`: averaged by area
    /// in linear light when it shrinks, bilinear when it grows. Outside the picture is black.
    void picture(const image::Image8& picture, const glm::dvec2& from, const glm::dvec2& size,
                 const glm::ivec2& corner, const glm::ivec2& target);

private:
    void blend(int x, int y, Colour colour, double opacity);

    image::Image8 image_;
};

} // namespace frustumscreen::typography
