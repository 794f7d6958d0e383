#include "app/typography/canvas.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::typography {

namespace {

struct PixelBox {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0; ///< x1, y1 excluded
};

PixelBox around(const glm::dvec2& low, const glm::dvec2& high, const image::Image8& image) {
    const auto clamp = [](double v, int most) {
        return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(most)));
    };
    return {.x0 = clamp(std::floor(low.x), image.width),
            .y0 = clamp(std::floor(low.y), image.height),
            .x1 = clamp(std::ceil(high.x), image.width),
            .y1 = clamp(std::ceil(high.y), image.height)};
}

glm::dvec3 linear_texel(const image::Image8& image, int x, int y) {
    if (x < 0 || y < 0 || x >= image.width || y >= image.height) {
        return glm::dvec3(0.0);
    }
    const glm::u8vec4& code = image.at(x, y);
    const std::array<float, 256>& linear = image::linear_from_srgb8();
    return {linear[code.r], linear[code.g], linear[code.b]};
}

glm::dvec3 bilinear(const image::Image8& image, const glm::dvec2& at) {
    const glm::dvec2 corner = glm::floor(at - 0.5);
    const glm::dvec2 f = at - 0.5 - corner;
    const int x = static_cast<int>(corner.x);
    const int y = static_cast<int>(corner.y);
    return glm::mix(glm::mix(linear_texel(image, x, y), linear_texel(image, x + 1, y), f.x),
                    glm::mix(linear_texel(image, x, y + 1), linear_texel(image, x + 1, y + 1), f.x), f.y);
}

} // namespace

Canvas::Canvas(int width, int height, Colour background)
    : image_(width, height, glm::u8vec4(background, 255)) {}

void Canvas::blend(int x, int y, Colour colour, double opacity) {
    if (opacity <= 0.0) {
        return;
    }
    glm::u8vec4& texel = image_.at(x, y);
    if (opacity >= 1.0) {
        texel = glm::u8vec4(colour, 255);
        return;
    }
    const std::array<float, 256>& linear = image::linear_from_srgb8();
    for (int k = 0; k < 3; ++k) {
        const double below = linear[texel[k]];
        texel[k] =
            image::srgb8_from_linear(below + opacity * (static_cast<double>(linear[colour[k]]) - below));
    }
}

void Canvas::fill(const glm::dvec2& low, const glm::dvec2& high, Colour colour, double opacity) {
    const PixelBox box = around(low, high, image_);
    const auto covered = [](double from, double to, int at) {
        return std::min(to, at + 1.0) - std::max(from, double(at));
    };
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            blend(x, y, colour, opacity * covered(low.x, high.x, x) * covered(low.y, high.y, y));
        }
    }
}

void Canvas::line(const glm::dvec2& a, const glm::dvec2& b, double width_px, Colour colour, double opacity) {
    const glm::dvec2 along = b - a;
    const double length2 = std::max(glm::dot(along, along), 1e-12);
    const PixelBox box = around(glm::min(a, b) - width_px - 1.0, glm::max(a, b) + width_px + 1.0, image_);
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            const glm::dvec2 p(x + 0.5, y + 0.5);
            const double t = std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0);
            const double distance = glm::distance(p, a + t * along);
            blend(x, y, colour,
                  opacity * std::clamp(width_px / 2.0 + 0.5 - distance, 0.0, std::min(1.0, width_px)));
        }
    }
}

void Canvas::outline(std::span<const glm::dvec2> points, double width_px, Colour colour, double opacity) {
    for (std::size_t k = 0; k < points.size(); ++k) {
        line(points[k], points[(k + 1) % points.size()], width_px, colour, opacity);
    }
}

void Canvas::circle(const glm::dvec2& centre, double radius_px, double width_px, Colour colour,
                    double opacity) {
    const PixelBox box =
        around(centre - radius_px - width_px - 1.0, centre + radius_px + width_px + 1.0, image_);
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            const double distance = std::abs(glm::distance(glm::dvec2(x + 0.5, y + 0.5), centre) - radius_px);
            blend(x, y, colour,
                  opacity * std::clamp(width_px / 2.0 + 0.5 - distance, 0.0, std::min(1.0, width_px)));
        }
    }
}

void Canvas::coverage(const image::Image<std::uint8_t>& coverage, const glm::ivec2& corner, Colour colour) {
    for (int y = std::max(0, -corner.y); y < std::min(coverage.height, image_.height - corner.y); ++y) {
        for (int x = std::max(0, -corner.x); x < std::min(coverage.width, image_.width - corner.x); ++x) {
            blend(x + corner.x, y + corner.y, colour, coverage.at(x, y) / 255.0);
        }
    }
}

void Canvas::text(const Typesetter& typesetter, std::string_view text, const glm::dvec2& position,
                  double em_px, Colour colour, Anchor anchor, bool bold) {
    const image::Image<std::uint8_t> letters = typesetter.line(text, em_px, bold);
    const glm::dvec2 size(letters.width, letters.height);
    coverage(letters, glm::ivec2(glm::round(position - glm::dvec2(anchor.x, anchor.y) * size)), colour);
}

void Canvas::picture(const image::Image8& picture, const glm::dvec2& from, const glm::dvec2& size,
                     const glm::ivec2& corner, const glm::ivec2& target) {
    const glm::dvec2 step = size / glm::dvec2(target);
    const glm::ivec2 taps = glm::max(glm::ivec2(glm::ceil(step)), glm::ivec2(1));
    for (int y = 0; y < target.y; ++y) {
        for (int x = 0; x < target.x; ++x) {
            glm::dvec3 sum(0.0);
            for (int k = 0; k < taps.x * taps.y; ++k) {
                const int column = k % taps.x;
                const int row = k / taps.x;
                const glm::dvec2 part((column + 0.5) / taps.x, (row + 0.5) / taps.y);
                sum += bilinear(picture, from + (glm::dvec2(x, y) + part) * step);
            }
            const glm::ivec2 at = corner + glm::ivec2(x, y);
            if (at.x >= 0 && at.y >= 0 && at.x < image_.width && at.y < image_.height) {
                sum /= static_cast<double>(taps.x * taps.y);
                image_.at(at.x, at.y) =
                    glm::u8vec4(image::srgb8_from_linear(sum.r), image::srgb8_from_linear(sum.g),
                                image::srgb8_from_linear(sum.b), 255);
            }
        }
    }
}

} // namespace frustumscreen::typography
