// The effect of the driver's own arithmetic on a picture, read back from it: the grid to which it snaps
// corners, surfaces of nearly equal depth, texture coordinates at the far end of the largest atlas.

#include "app/bench/stability/themes.h"
#include "firmware_host/display/surfaceless_display.h"
#include "firmware_host/gl/gl_program.h"

#include <fmt/format.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace frustumscreen::bench {

namespace {

struct Corner {
    glm::vec4 clip{0.0F, 0.0F, 0.0F, 1.0F};
    std::array<std::uint16_t, 2> uv{}; ///< as stored in a pack
};

constexpr std::string_view vertex = R"(
layout(location = 0) in vec4 place;
layout(location = 1) in vec2 uv;
out vec2 at;
void main() {
    gl_Position = place;
    at = uv;
}
)";
constexpr std::string_view fragment = R"(
in vec2 at;
uniform sampler2D picture;
out vec4 result;
void main() { result = texture(picture, at); }
)";

/// An 8-bit picture with the exhibit's depth format, and a program that draws triangles with one texture into
/// it.
class Canvas {
public:
    [[nodiscard]] static Result<std::unique_ptr<Canvas>> create(int width, int height) {
        TRY(auto display, display::SurfacelessDisplay::create(width, height));
        TRY(gl::GlProgram program, gl::make_program("", vertex, fragment));
        return std::unique_ptr<Canvas>(new Canvas(std::move(display), std::move(program), {width, height}));
    }

    /// Clears to black and far.
    void clear() const {
        constexpr std::array<float, 4> black{};
        glClearBufferfv(GL_COLOR, 0, black.data());
        glClearBufferfi(GL_DEPTH_STENCIL, 0, 1.0F, 0);
    }
    void draw(std::span<const Corner> corners, const gl::GlTexture& texture) const {
        glBindTexture(GL_TEXTURE_2D, texture.get());
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size_bytes()), corners.data(),
                     GL_STREAM_DRAW);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
    }
    /// The red channel of each pixel, row by row from the bottom.
    [[nodiscard]] std::vector<std::uint8_t> read() const {
        std::vector<glm::u8vec4> pixels(static_cast<std::size_t>(size_.x * size_.y));
        glReadPixels(0, 0, size_.x, size_.y, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
        std::vector<std::uint8_t> red(pixels.size());
        std::transform(pixels.begin(), pixels.end(), red.begin(), [](const glm::u8vec4& p) { return p.r; });
        return red;
    }
    /// A corner at a position in pixels, from the bottom left.
    [[nodiscard]] Corner at(double x, double y, double depth = 0.0) const {
        return {glm::vec4(2.0 * x / size_.x - 1.0, 2.0 * y / size_.y - 1.0, depth, 1.0), {}};
    }

private:
    Canvas(std::unique_ptr<display::SurfacelessDisplay> display, gl::GlProgram program, glm::ivec2 size)
        : display_(std::move(display)), program_(std::move(program)), size_(size) {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
        glBindRenderbuffer(GL_RENDERBUFFER, colour_.get());
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size.x, size.y);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.get());
        glBindRenderbuffer(GL_RENDERBUFFER, depth_.get());
        glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, size.x, size.y);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth_.get());
        glViewport(0, 0, size.x, size.y);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glUseProgram(program_.get());
        glBindVertexArray(vertices_.get());
        glBindBuffer(GL_ARRAY_BUFFER, buffer_.get());
        glEnableVertexAttribArray(0);
        glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(Corner), nullptr);
        glEnableVertexAttribArray(1);
        glVertexAttribPointer(1, 2, GL_UNSIGNED_SHORT, GL_TRUE, sizeof(Corner),
                              reinterpret_cast<const void*>(offsetof(Corner, uv)));
    }

    std::unique_ptr<display::SurfacelessDisplay> display_; ///< first: its context outlives everything below
    gl::GlProgram program_;
    glm::ivec2 size_;
    gl::GlFramebuffer framebuffer_ = gl::GlFramebuffer::generate();
    gl::GlRenderbuffer colour_ = gl::GlRenderbuffer::generate();
    gl::GlRenderbuffer depth_ = gl::GlRenderbuffer::generate();
    gl::GlVertexArray vertices_ = gl::GlVertexArray::generate();
    gl::GlBuffer buffer_ = gl::GlBuffer::generate();
};

/// A texture with one row of grey values.
gl::GlTexture texture_of(std::span<const std::uint8_t> greys) {
    gl::GlTexture texture = gl::GlTexture::generate();
    glBindTexture(GL_TEXTURE_2D, texture.get());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_R8, static_cast<GLsizei>(greys.size()), 1);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, static_cast<GLsizei>(greys.size()), 1, GL_RED, GL_UNSIGNED_BYTE,
                    greys.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    return texture;
}

StabilityResult left_out(const Error& error) {
    return {{}, fmt::format("nothing is drawn: {}", error.message)};
}

/// An edge that leans by one pixel over 1024 rows: the row at which it leaves a pixel column tells its
/// position to 1/1024 pixel. It is moved in steps of 1/4096.
StabilityResult corners() {
    constexpr int rows = 1024;
    constexpr int column = 32;
    constexpr int width = 64;
    const auto canvas = Canvas::create(width, rows);
    if (!canvas) {
        return left_out(canvas.error());
    }
    const gl::GlTexture white = texture_of(std::array<std::uint8_t, 1>{255});
    double farthest = 0.0;
    std::vector<double> places;
    for (int step = 0; step < 512; ++step) {
        const double moved = step / 4096.0;
        (*canvas)->clear();
        (*canvas)->draw(std::array{(*canvas)->at(column + 1.0 + moved, 0.0),
                                   (*canvas)->at(column + moved, rows), (*canvas)->at(0.0, rows / 2.0)},
                        white);
        const std::vector<std::uint8_t> picture = (*canvas)->read();
        int last = 0;
        for (int row = 0; row < rows; ++row) {
            last = picture[static_cast<std::size_t>(row) * width + column] != 0 ? row : last;
        }
        places.push_back((last + 1.0) / rows - 0.5); // half a row to either side
        farthest = std::max(farthest, std::abs(places.back() - moved));
    }
    std::sort(places.begin(), places.end());
    double grid = 1.0;
    for (std::size_t k = 1; k < places.size(); ++k) {
        grid = places[k] > places[k - 1] ? std::min(grid, places[k] - places[k - 1]) : grid;
    }
    return {{{"grid of corners, px", 1.0 / 256.0, grid},
             {"edges off their place, px", 1.0 / 512.0 + 0.5 / rows, farthest}}};
}

/// A leaning plane, cut along one diagonal and then, drawn nearer or farther by `apart`, along the other: the
/// share of pixels that show the wrong one.
double wrongly_ordered(const Canvas& canvas, double side, double apart) {
    const gl::GlTexture grey = texture_of(std::array<std::uint8_t, 1>{100});
    const gl::GlTexture white = texture_of(std::array<std::uint8_t, 1>{255});
    const auto plane = [&](double x, double y, double moved) {
        return canvas.at(x * side, y * side, 1.2 * (x - 0.4) + 0.6 * (y - 0.3) - 0.2 + moved);
    };
    std::size_t wrong = 0;
    std::size_t pixels = 0;
    for (const bool nearer : {true, false}) {
        const double moved = nearer ? -2.0 * apart : 2.0 * apart; // clip depth ranges from -1 to 1
        canvas.clear();
        canvas.draw(std::array{plane(0, 0, 0), plane(1, 0, 0), plane(1, 1, 0), plane(0, 0, 0), plane(1, 1, 0),
                               plane(0, 1, 0)},
                    grey);
        canvas.draw(std::array{plane(0, 0, moved), plane(1, 0, moved), plane(0, 1, moved), plane(1, 0, moved),
                               plane(1, 1, moved), plane(0, 1, moved)},
                    white);
        for (const std::uint8_t red : canvas.read()) {
            wrong += red != 0 && (red == 255) != nearer ? 1 : 0;
            pixels += red != 0 ? 1 : 0;
        }
    }
    return static_cast<double>(wrong) / static_cast<double>(std::max<std::size_t>(pixels, 1));
}

StabilityResult depths() {
    constexpr int side = 512;
    const auto canvas = Canvas::create(side, side);
    if (!canvas) {
        return left_out(canvas.error());
    }
    const double bit = std::ldexp(1.0, -24);
    double apart = 0.25 * bit; // smallest distance at which no pixel shows the wrong surface
    while (apart < 1.0 && wrongly_ordered(**canvas, side, apart) > 0.0) {
        apart *= 2.0;
    }
    // Per depth: half a step of the buffer, and three 24-bit products and sums of a number up to 1.
    return {{{"apart in depth, of 1, at which no pixel shows the wrong surface", 8.0 * bit, apart}}};
}

/// Texels alternate between black and white; between two of them the filter's result is the position itself.
StabilityResult atlases() {
    constexpr int texels = 16384;
    constexpr int width = 1000; // pixels; a texel spans 3.9, at a different phase each
    constexpr int first_code = 64512;
    const auto canvas = Canvas::create(width, 4);
    if (!canvas) {
        return left_out(canvas.error());
    }
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (largest < texels) {
        return {{}, fmt::format("the driver's largest texture has {} texels a side", largest)};
    }
    std::vector<std::uint8_t> greys(texels);
    for (std::size_t k = 0; k < greys.size(); ++k) {
        greys[k] = k % 2 == 0 ? 0 : 255;
    }
    const gl::GlTexture stripes = texture_of(greys);
    const auto corner = [&](double x, double y) {
        Corner made = (*canvas)->at(x * width, y * 4);
        made.uv = {static_cast<std::uint16_t>(x > 0.0 ? 65535 : first_code), 0};
        return made;
    };
    (*canvas)->clear();
    (*canvas)->draw(
        std::array{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 0), corner(1, 1), corner(0, 1)},
        stripes);
    const std::vector<std::uint8_t> picture = (*canvas)->read();
    double farthest = 0.0;
    for (int x = 0; x < width; ++x) {
        const long double code = first_code + (65535.0L - first_code) * (x + 0.5L) / width;
        const long double place = code / 65535.0L * texels - 0.5L;
        if (place >= texels - 1) {
            continue; // beyond the last texel's centre
        }
        const long double whole = std::floor(place);
        const long double share = place - whole;
        const bool rises = std::fmod(whole, 2.0L) == 0.0L;
        const long double seen = picture[width + static_cast<std::size_t>(x)] / 255.0L;
        farthest = std::max(farthest, static_cast<double>(std::abs(seen - (rises ? share : 1.0L - share))));
    }
    double stored = 0.0;
    for (int k = 0; k <= 100'000; ++k) {
        const double at = k / 100'000.0;
        stored = std::max(stored, texels * std::abs(std::round(65535.0 * at) / 65535.0 - at));
    }
    // Reading back adds half an 8-bit step; filter weights have eight bits; the coordinate itself has three
    // 24-bit roundings.
    const double bound = 0.5 / 255.0 + 1.0 / 256.0 + 3.0 * texels * std::ldexp(1.0, -24);
    return {{{"drawn: off its place, texels", bound, farthest},
             {"codes of 16 bits: off their place, texels", 0.5 * texels / 65535.0, stored}}};
}

} // namespace

std::vector<StabilityCase> driver_cases() {
    return {{"driver", "corners on its grid", FloatingPoint::Free,
             [](const StabilityOptions&) { return corners(); }},
            {"driver", "surfaces of about one depth", FloatingPoint::Free,
             [](const StabilityOptions&) { return depths(); }},
            {"driver", "the far end of an atlas of 16384 texels", FloatingPoint::Free,
             [](const StabilityOptions&) { return atlases(); }}};
}

} // namespace frustumscreen::bench
