#include "app/typography/eye_letter.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace frustumscreen::typography {

namespace {

// Shares of the picture's width and height.
constexpr std::array<double, 2> columns{0.58, 0.77}; ///< where the letters' parts of the picture begin
constexpr double column_width = 0.19;
constexpr double first_row = 0.2, end_row = 0.4;
constexpr double max_side = 0.12, min_side = 0.05; ///< of a square, of the picture's height
constexpr double next_side = 0.9;                  ///< of the side before
constexpr int step_px = 2;                         ///< between two squares that are tried; even
constexpr int lit_code = 8;                        ///< codes above this are light
constexpr double em_of_side = 1.0 / 0.9; ///< a capital of the bold typeface is 0.73 em high, R 0.77 em wide

/// Down to an even number: a square of even numbers covers whole pixels of a picture that is shrunk to a half.
int even(double number) {
    return 2 * static_cast<int>(0.5 * number);
}

/// Counts lit pixels in squares of a part of the picture.
class LitPixels {
public:
    LitPixels(const image::Image8& picture, const PixelRectangle& part)
        : part_(part), sums_(part.width + 1, part.height + 1) {
        for (int y = 0; y < part.height; ++y) {
            for (int x = 0; x < part.width; ++x) {
                const glm::u8vec4& code = picture.at(part.x + x, part.y + y);
                const int lit = std::max({code.r, code.g, code.b}) > lit_code ? 1 : 0;
                sums_.at(x + 1, y + 1) = lit + sums_.at(x, y + 1) + sums_.at(x + 1, y) - sums_.at(x, y);
            }
        }
    }
    /// In the square at (x, y) of the part.
    [[nodiscard]] int in(int x, int y, int side) const {
        return sums_.at(x + side, y + side) - sums_.at(x, y + side) - sums_.at(x + side, y) + sums_.at(x, y);
    }
    [[nodiscard]] const PixelRectangle& part() const { return part_; }

private:
    PixelRectangle part_;
    image::Image<int> sums_; ///< of the lit pixels above and to the left
};

struct Place {
    PixelRectangle square; ///< of the picture
    int lit = 0;           ///< pixels
};

/// The square of this side with the fewest lit pixels, the first one from the upper left.
Place darkest(const LitPixels& pixels, int side) {
    Place best{.square = {}, .lit = side * side + 1};
    const PixelRectangle& part = pixels.part();
    for (int y = 0; y + side <= part.height; y += step_px) {
        for (int x = 0; x + side <= part.width; x += step_px) {
            if (const int lit = pixels.in(x, y, side); lit < best.lit) {
                best = {.square = {.x = part.x + x, .y = part.y + y, .width = side, .height = side},
                        .lit = lit};
            }
        }
    }
    return best;
}

/// The largest squares without light; if there are none, the largest ones with the least.
std::array<PixelRectangle, 2> squares_in(const image::Image8& pattern) {
    const auto pixels_in = [&pattern](double begin) {
        const double w = pattern.width, h = pattern.height;
        return LitPixels(pattern, {.x = even(begin * w),
                                   .y = even(first_row * h),
                                   .width = even(column_width * w),
                                   .height = even((end_row - first_row) * h)});
    };
    const std::array<LitPixels, 2> pixels{pixels_in(columns[0]), pixels_in(columns[1])};
    const auto places = [&pixels](double side) {
        return std::array{darkest(pixels[0], even(side)), darkest(pixels[1], even(side))};
    };
    const double largest = std::min(max_side * pattern.height, 0.95 * column_width * pattern.width);
    for (double side = largest; side >= min_side * pattern.height; side *= next_side) {
        if (const std::array<Place, 2> found = places(side); found[0].lit + found[1].lit == 0) {
            return {found[0].square, found[1].square};
        }
    }
    const std::array<Place, 2> found = places(largest);
    return {found[0].square, found[1].square};
}

/// The rectangle around the ink.
PixelRectangle ink_of(const image::Image<std::uint8_t>& coverage) {
    PixelRectangle ink;
    for (int y = 0; y < coverage.height; ++y) {
        for (int x = 0; x < coverage.width; ++x) {
            if (coverage.at(x, y) > 0) {
                ink = united(ink, {.x = x, .y = y, .width = 1, .height = 1});
            }
        }
    }
    return ink;
}

/// The letter in the middle of a square.
image::Image<std::uint8_t> set_in_square(std::string_view letter, int side, const Typesetter& typesetter) {
    const image::Image<std::uint8_t> line = typesetter.line(letter, em_of_side * side, true);
    const PixelRectangle ink = ink_of(line);
    const glm::ivec2 from(ink.x - (side - ink.width) / 2, ink.y - (side - ink.height) / 2);
    image::Image<std::uint8_t> square(side, side);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const glm::ivec2 at = from + glm::ivec2(x, y);
            if (at.x >= 0 && at.y >= 0 && at.x < line.width && at.y < line.height) {
                square.at(x, y) = line.at(at.x, at.y);
            }
        }
    }
    return square;
}

} // namespace

std::array<EyeLetter, 2> eye_letters(const image::Image8& pattern, const Typesetter& typesetter) {
    const std::array<PixelRectangle, 2> squares = squares_in(pattern);
    return {EyeLetter{squares[0], set_in_square("L", squares[0].width, typesetter)},
            EyeLetter{squares[1], set_in_square("R", squares[1].width, typesetter)}};
}

image::Image8 with_letter(const image::Image8& picture, const EyeLetter& letter, Colour colour) {
    const PixelRectangle& square = letter.square;
    image::Image8 shown(square.width, square.height);
    for (int y = 0; y < square.height; ++y) {
        for (int x = 0; x < square.width; ++x) {
            const glm::u8vec4& above = picture.at(square.x + x, square.y + y);
            const double below = (255.0 - std::max({above.r, above.g, above.b})) / 255.0;
            const double share = below * letter.coverage.at(x, y) / 255.0;
            glm::u8vec4& texel = shown.at(x, y);
            texel = {0, 0, 0, 255};
            for (int k = 0; k < 3; ++k) {
                const std::array<float, 256>& linear = image::linear_from_srgb8();
                texel[k] = image::srgb8_from_linear(linear[above[k]] +
                                                    share * static_cast<double>(linear[colour[k]]));
            }
        }
    }
    return shown;
}

} // namespace frustumscreen::typography
