#include "app/typography/test_pictures.h"

#include "app/typography/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::typography {

namespace {

constexpr Colour white{255, 255, 255};

/// Alternating white and black sectors, averaged over each pixel in linear light.
image::Image8 star(int radius) {
    constexpr int spokes = 36, samples = 4;
    image::Image8 picture(2 * radius, 2 * radius);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            int lit = 0;
            for (int k = 0; k < samples * samples; ++k) {
                const glm::ivec2 cell(k % samples, k / samples);
                const glm::dvec2 at = glm::dvec2(x, y) + (glm::dvec2(cell) + 0.5) / double{samples} -
                                      static_cast<double>(radius);
                const double turns = std::atan2(at.y, at.x) / (2.0 * std::numbers::pi) + 0.5;
                lit += glm::length(at) < radius && static_cast<int>(turns * spokes) % 2 == 0 ? 1 : 0;
            }
            const std::uint8_t code =
                image::srgb8_from_linear(static_cast<double>(lit) / (samples * samples));
            picture.at(x, y) = {code, code, code, 255};
        }
    }
    return picture;
}

/// Vertical and horizontal lines of one, two and three pixels, with gaps as wide as the lines.
void draw_lines(Canvas& canvas, const glm::dvec2& corner, double size) {
    double along = 0.0;
    for (int width = 1; width <= 3; ++width) {
        for (int k = 0; k < 5; ++k, along += 2.0 * width) {
            const glm::dvec2 from = corner + glm::dvec2(along, 0.0);
            canvas.fill(from, from + glm::dvec2(width, size), white);
            const glm::dvec2 level = corner + glm::dvec2(0.0, size + 8.0 + along);
            canvas.fill(level, level + glm::dvec2(size, width), white);
        }
        along += 6.0;
    }
}

} // namespace

image::Image8 focus_picture(int width, int height) {
    Canvas canvas(width, height, Colour(0));
    canvas.fill({0, 0}, {width, 1}, white);
    canvas.fill({0, height - 1}, {width, height}, white);
    canvas.fill({0, 0}, {1, height}, white);
    canvas.fill({width - 1, 0}, {width, height}, white);
    const int radius = std::max(8, static_cast<int>(0.085 * std::min(width, height)));
    const image::Image8 one = star(radius);
    const int margin = radius + static_cast<int>(0.03 * std::min(width, height));
    const glm::ivec2 way = (glm::ivec2(width, height) - 2 * margin) / 2;
    const double size = std::floor(0.9 * radius);
    for (int k = 0; k < 9; ++k) {
        const glm::ivec2 centre = margin + way * glm::ivec2(k % 3, k / 3);
        const bool at_right = k % 3 == 2;
        const glm::dvec2 aside(at_right ? -radius - size - 20.0 : radius + 12.0, -size - 4.0);
        draw_lines(canvas, glm::round(glm::dvec2(centre) + aside), size);
        canvas.picture(one, {0.0, 0.0}, {one.width, one.height}, centre - radius, {one.width, one.height});
    }
    return canvas.take();
}

image::Image8 grey_picture(int width, int height, const Typesetter& typesetter) {
    Canvas canvas(width, height, Colour(0));
    const double em_px = std::max(10.0, height / 50.0);
    const auto columns = [&](std::span<const int> codes, double top, double bottom) {
        const double step = static_cast<double>(width) / static_cast<double>(codes.size());
        for (std::size_t k = 0; k < codes.size(); ++k) {
            const auto code = static_cast<std::uint8_t>(codes[k]);
            const double left = std::round(static_cast<double>(k) * step);
            canvas.fill({left, top}, {std::round(static_cast<double>(k + 1) * step), bottom}, Colour(code));
            canvas.text(typesetter, fmt::format("{}", codes[k]), {left + step / 2.0, bottom - 0.6 * em_px},
                        em_px, Colour(static_cast<std::uint8_t>(code < 128 ? code + 110 : code - 110)),
                        {0.5, 1.0});
        }
    };
    std::array<int, grey_steps> even{};
    for (int k = 0; k < grey_steps; ++k) {
        even[static_cast<std::size_t>(k)] = 255 * k / (grey_steps - 1);
    }
    constexpr std::array ends{0, 2, 4, 6, 8, 12, 16, 20, 235, 239, 243, 247, 249, 251, 253, 255};
    columns(even, 0.0, std::round(0.4 * height));
    columns(ends, std::round(0.4 * height), std::round(0.7 * height));
    return canvas.take();
}

} // namespace frustumscreen::typography
