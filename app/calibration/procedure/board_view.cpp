#include "app/calibration/procedure/board_view.h"

#include "app/calibration/quadrilateral.h"
#include "app/calibration/tag_pixels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::calibration {

namespace {

constexpr double still_px = 0.6;
/// Largest deviations, as shares of white less black: of a bit plus its inverse from white plus black, and of
/// a cosine's steps from their wave.
constexpr double max_of_pair = 0.35;
constexpr double max_of_wave = 0.08;
/// Largest shares of a tag's lit pixels.
constexpr double max_disturbed = 0.2;
constexpr double max_clipped = 0.2;
constexpr double min_contrast = 12.0;
constexpr int white_code = 254;

/// Checks single pixels of the captures: lit, clipped or disturbed.
class PixelChecks {
public:
    PixelChecks(const StripeSetup& setup, const Captures& captures)
        : captures_(captures), patterns_(patterns_of(setup)), steps_(setup.steps) {
        for (int harmonic = 1; harmonic <= 2; ++harmonic) {
            for (int step = 0; step < steps_; ++step) {
                const double angle = 2.0 * std::numbers::pi * harmonic * step / steps_;
                waves_.emplace_back(std::cos(angle), std::sin(angle));
            }
        }
    }
    [[nodiscard]] double contrast(std::size_t pixel) const {
        return grey(patterns_.size() - 2, pixel) - grey(patterns_.size() - 1, pixel);
    }
    [[nodiscard]] bool is_clipped(std::size_t pixel) const {
        return captures_.pictures[patterns_.size() - 2][pixel] >= white_code;
    }
    [[nodiscard]] bool is_disturbed(std::size_t pixel) const {
        const double contrast_here = contrast(pixel);
        const double both = grey(patterns_.size() - 2, pixel) + grey(patterns_.size() - 1, pixel);
        for (std::size_t k = 0; k < patterns_.size(); ++k) {
            if (patterns_[k].stripes == Stripes::Bit) {
                if (std::abs(grey(k, pixel) + grey(k + 1, pixel) - both) > max_of_pair * contrast_here) {
                    return true;
                }
            } else if (patterns_[k].stripes == Stripes::Cosine && patterns_[k].which == 0 &&
                       besides_wave(k, pixel) > max_of_wave * contrast_here) {
                return true;
            }
        }
        return false;
    }

private:
    [[nodiscard]] double grey(std::size_t picture, std::size_t pixel) const {
        return captures_.pictures[picture][pixel];
    }
    /// Root mean square of the steps less their mean and first two harmonics.
    [[nodiscard]] double besides_wave(std::size_t first, std::size_t pixel) const {
        double sum = 0.0;
        double squares = 0.0;
        for (int step = 0; step < steps_; ++step) {
            const double value = grey(first + static_cast<std::size_t>(step), pixel);
            sum += value;
            squares += value * value;
        }
        double rest = squares - sum * sum / steps_;
        for (std::size_t harmonic = 0; harmonic < 2; ++harmonic) {
            glm::dvec2 wave(0.0);
            for (std::size_t step = 0; step < static_cast<std::size_t>(steps_); ++step) {
                wave +=
                    grey(first + step, pixel) * waves_[harmonic * static_cast<std::size_t>(steps_) + step];
            }
            rest -= 2.0 * glm::dot(wave, wave) / steps_;
        }
        return std::sqrt(std::fmax(0.0, rest) / steps_);
    }

    const Captures& captures_;
    std::vector<Pattern> patterns_;
    int steps_;
    std::vector<glm::dvec2> waves_; ///< [harmonic][step]
};

/// Shares of a tag's lit pixels.
struct TagChecks {
    double clipped = 0.0;
    double disturbed = 0.0;
};

TagChecks checks_of(const PixelChecks& checks, const Captures& captures, const Quadrilateral& corners) {
    TagChecks found;
    double lit = 0.0;
    for_each_pixel(corners, captures.width, captures.height, [&](std::size_t pixel, const glm::dvec2&) {
        if (std::abs(checks.contrast(pixel)) >= min_contrast) {
            lit += 1.0;
            found.clipped += checks.is_clipped(pixel) ? 1.0 : 0.0;
            found.disturbed += checks.is_disturbed(pixel) ? 1.0 : 0.0;
        }
    });
    return {found.clipped / std::fmax(1.0, lit), found.disturbed / std::fmax(1.0, lit)};
}

Quadrilateral between(const tags::FoundTag& a, const tags::FoundTag& b) {
    Quadrilateral corners{};
    for (std::size_t k = 0; k < 4; ++k) {
        corners[k] = 0.5 * (a.corners_px[k] + b.corners_px[k]);
    }
    return corners;
}

bool is_in_picture(const Quadrilateral& pixels, const StripeSetup& setup) {
    return std::all_of(pixels.begin(), pixels.end(), [&](const glm::dvec2& pixel) {
        return pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x <= setup.width && pixel.y <= setup.height;
    });
}

} // namespace

std::vector<tags::FoundTag> tags_of(const Board& board, std::span<const tags::FoundTag> found) {
    std::vector<tags::FoundTag> known;
    for (const tags::FoundTag& tag : found) {
        const auto is_same = [&](const auto& other) { return other.id == tag.id; };
        if (std::any_of(board.tags.begin(), board.tags.end(), is_same) &&
            std::count_if(found.begin(), found.end(), is_same) == 1) {
            known.push_back(tag);
        }
    }
    return known;
}

bool has_moved(const tags::FoundTag& before, const tags::FoundTag& after, double farthest_px) {
    for (std::size_t k = 0; k < before.corners_px.size(); ++k) {
        if (glm::distance(before.corners_px[k], after.corners_px[k]) > farthest_px) {
            return true;
        }
    }
    return false;
}

BoardView view_of(const Board& board, const StripeSetup& setup, const Captures& captures,
                  std::span<const tags::FoundTag> before, std::span<const tags::FoundTag> after) {
    const PixelMap map = decode(setup, captures);
    const PixelChecks checks(setup, captures);
    BoardView view;
    for (const tags::PropTag& tag : board.tags) {
        const auto is_it = [&](const tags::FoundTag& found) { return found.id == tag.id; };
        const auto first = std::find_if(before.begin(), before.end(), is_it);
        const auto last = std::find_if(after.begin(), after.end(), is_it);
        if (first == before.end() || last == after.end()) {
            continue;
        }
        if (has_moved(*first, *last, still_px)) {
            ++view.moved;
            continue;
        }
        const Quadrilateral corners = between(*first, *last);
        const TagChecks tag_checks = checks_of(checks, captures, corners);
        if (tag_checks.clipped > max_clipped) {
            ++view.clipped;
            continue;
        }
        if (tag_checks.disturbed > max_disturbed) {
            ++view.disturbed;
            continue;
        }
        const auto pixels = tag_pixels(map, corners);
        if (!pixels || !is_in_picture(*pixels, setup)) {
            continue; // the edge of the light crosses it
        }
        const std::array<glm::dvec3, 4> places = tag.corners();
        for (std::size_t k = 0; k < places.size(); ++k) {
            view.points.push_back({places[k], (*pixels)[k]});
        }
        ++view.tags;
        view.has_top |= &tag == &board.top();
    }
    return view;
}

} // namespace frustumscreen::calibration
