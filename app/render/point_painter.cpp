#include "app/render/point_painter.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace frustumscreen::render {

namespace {

/// (x w, y w, w) of a sample, counted from the rectangle's corner, that lights a point of the window's frame.
glm::mat<4, 3, double> sample_from_window(const scene::ReliefDraw& drawn, const relief::RasterFace& face,
                                          int side) {
    glm::dmat3 sample_from_pixel(side);
    sample_from_pixel[2] = {-side * face.lit.x, -side * face.lit.y, 1.0};
    return sample_from_pixel * face.pixel_from_box * glm::inverse(drawn.prop_from_box);
}

/// `rows`: `side` rows of samples, `width` pixels each.
void average(std::span<const std::uint64_t> rows, int side, const relief::SampleLight& light,
             std::span<glm::u8vec4> codes) {
    const auto samples = static_cast<std::size_t>(side);
    const std::size_t stride = samples * codes.size();
    for (std::size_t x = 0; x < codes.size(); ++x) {
        glm::uvec3 sum(0U);
        bool any = false;
        for (std::size_t row = 0; row < samples; ++row) {
            for (std::size_t column = 0; column < samples; ++column) {
                const std::uint64_t word = rows[row * stride + x * samples + column];
                if (word != 0) {
                    any = true;
                    sum += light.light(std::bit_cast<glm::u8vec4>(static_cast<std::uint32_t>(word)));
                }
            }
        }
        codes[x] = any ? light.mean(sum, static_cast<unsigned>(side * side)) : glm::u8vec4(0);
    }
}

} // namespace

PixelRectangle PointPainter::paint(const scene::ReliefDraw& drawn,
                                   const relief::PictureSpan<glm::u8vec4>& picture,
                                   const relief::RowLight& light) {
    if (drawn.view.faces.empty()) {
        return {};
    }
    const relief::RasterFace& face = drawn.view.faces.front(); // a window has one
    const PixelRectangle& lit = face.lit;
    if (lit.empty()) {
        return {};
    }
    const int side = drawn.samples > 1 ? 2 : 1;
    const std::span<const std::uint64_t> samples = splatter_.draw(
        *drawn.points, sample_from_window(drawn, face, side), side * lit.width, side * lit.height);
    const auto width = static_cast<std::size_t>(lit.width);
    const std::size_t of_row = width * static_cast<std::size_t>(side * side);
    for (int y = 0; y < lit.height; ++y) {
        const std::span<glm::u8vec4> codes(&picture.at(lit.x, lit.y + y), width);
        average(samples.subspan(static_cast<std::size_t>(y) * of_row, of_row), side, light_, codes);
        light.light(lit.y + y, lit.x, codes);
    }
    return lit;
}

} // namespace frustumscreen::render
