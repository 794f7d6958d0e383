#include "app/calibration/procedure/rest_request.h"

#include <algorithm>
#include <array>

namespace frustumscreen::calibration {

namespace {

/// Shares of the picture, ordered so that consecutive places are far apart.
constexpr std::array<glm::dvec2, 11> places{{{0.5, 0.5},
                                             {0.2, 0.25},
                                             {0.8, 0.75},
                                             {0.8, 0.25},
                                             {0.2, 0.75},
                                             {0.4, 0.25},
                                             {0.6, 0.75},
                                             {0.2, 0.5},
                                             {0.8, 0.5},
                                             {0.6, 0.25},
                                             {0.4, 0.75}}};
constexpr std::size_t leaning_every = 4;
constexpr std::size_t block_every = 3;

glm::dvec2 mean_pixel(const Rest& rest) {
    glm::dvec2 sum(0.0);
    for (const PropPoint& point : rest.points) {
        sum += point.pixel;
    }
    return sum / static_cast<double>(rest.points.size());
}

/// The place with the fewest rests; each rest counts at the nearest place.
glm::dvec2 emptiest(std::span<const TakenRest> taken, const glm::dvec2& size_px) {
    std::array<int, places.size()> been{};
    for (const TakenRest& each : taken) {
        const glm::dvec2 at = mean_pixel(each.rest) / size_px;
        const auto* const nearest =
            std::min_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
                return glm::distance(a, at) < glm::distance(b, at);
            });
        ++been.at(static_cast<std::size_t>(nearest - places.begin()));
    }
    const auto* const fewest = std::min_element(been.begin(), been.end());
    return size_px * places.at(static_cast<std::size_t>(fewest - been.begin()));
}

} // namespace

std::size_t count_of(std::span<const TakenRest> taken, Posture posture) {
    return static_cast<std::size_t>(std::count_if(
        taken.begin(), taken.end(), [&](const TakenRest& each) { return each.posture == posture; }));
}

RestRequest next_request(std::span<const TakenRest> taken, const glm::dvec2& size_px) {
    const std::size_t flat = count_of(taken, Posture::Flat);
    const auto with_top = static_cast<std::size_t>(
        std::count_if(taken.begin(), taken.end(), [](const TakenRest& each) { return each.has_top; }));
    RestRequest request{Posture::Flat, emptiest(taken, size_px)};
    if (flat >= first_flat && leaning_every * (count_of(taken, Posture::Leaning) + 1) <= taken.size() + 1) {
        request.posture = Posture::Leaning;
    } else if (flat > first_flat && 2 * with_top < taken.size() &&
               block_every * (count_of(taken, Posture::Block) + 1) <= taken.size()) {
        request.posture = Posture::Block; // all points lie in one plane; the block adds height
    }
    return request;
}

} // namespace frustumscreen::calibration
