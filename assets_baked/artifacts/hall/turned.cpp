#include "assets_baked/artifacts/hall/turned.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::artifacts {
namespace {

TurnedPlace place_on(double u, const Profile::Point& along) {
    const double around = u < 1.0 ? u : 0.0; // the seam's two sides are equal points
    return {around, (around - 0.5) * full_turn, along};
}

glm::dvec2 raised(const Turned& body, const TurnedPlace& place) {
    const glm::dvec2 at =
        place.along.position + place.along.normal * (body.raised_mm ? body.raised_mm(place) : 0.0);
    return body.moved ? body.moved(place, at) : at;
}

glm::vec2 texel_at(const Turned& body, double u, const Profile::Point& along) {
    return {static_cast<float>(u), body.strip.v(along.length_mm / body.profile.length_mm(), body.atlas_rows)};
}

} // namespace

Patch turned(Turned body) {
    Patch patch;
    patch.length_v_mm = body.profile.length_mm();
    double widest = 0.0;
    for (int k = 0; k <= 64; ++k) {
        widest = std::max(widest, body.profile.at_row(k / 64.0).position.x);
    }
    patch.length_u_mm = 0.8 * full_turn * widest;
    patch.min_u = 12;
    patch.min_v = 12;
    patch.pole_at_start = true;
    patch.pole_at_end = true;
    patch.at = [body = std::move(body)](double u, double v) {
        const TurnedPlace place = place_on(u, body.profile.at_row(v));
        const glm::dvec2 at = raised(body, place);
        return SurfacePoint{{at.x * std::sin(place.angle), at.y, at.x * std::cos(place.angle)},
                            texel_at(body, u, place.along)};
    };
    return patch;
}

Patch squared(Turned body, int columns) {
    Patch patch;
    patch.length_u_mm = 1e-6; // the corners are columns: their number is fixed
    patch.length_v_mm = body.profile.length_mm();
    patch.min_u = 4 * columns;
    patch.min_v = 4;
    patch.pole_at_start = true;
    patch.pole_at_end = true;
    patch.at = [body = std::move(body)](double u, double v) {
        const TurnedPlace place = place_on(u, body.profile.at_row(v));
        const glm::dvec2 at = raised(body, place);
        // Sides at the back's left half, left, front, right, back; each runs counter-clockwise seen from above.
        const double quarter = 4.0 * place.u + 0.5;
        const auto side = static_cast<int>(quarter) % 4; // 0: back
        const double across = at.x * (2.0 * (quarter - std::floor(quarter)) - 1.0);
        const glm::dvec3 position = side == 0   ? glm::dvec3(-across, at.y, -at.x)
                                    : side == 1 ? glm::dvec3(-at.x, at.y, across)
                                    : side == 2 ? glm::dvec3(across, at.y, at.x)
                                                : glm::dvec3(at.x, at.y, -across);
        return SurfacePoint{position, texel_at(body, u, place.along)};
    };
    return patch;
}

void paint_turned(const Turned& body, image::Image8& texture,
                  const std::function<glm::vec3(const TurnedPlace&)>& colour) {
    paint_strip(body.strip, texture, [&](float u, float v) {
        const double length = static_cast<double>(v) * body.profile.length_mm();
        return colour(place_on(static_cast<double>(u), body.profile.at_length(length)));
    });
}

Patch bar(Bar bar) {
    Patch patch;
    patch.length_u_mm = full_turn * bar.half_mm(0.5).x;
    patch.length_v_mm = bar.length_mm;
    patch.min_u = 8;
    patch.min_v = 8;
    patch.at = [bar = std::move(bar)](double u, double v) {
        constexpr double h = 1e-4;
        const double phi = u < 1.0 ? u * full_turn : 0.0;
        const glm::dvec3 along = glm::normalize(bar.path(v + h) - bar.path(v - h));
        const glm::dvec3 up = glm::normalize(glm::cross(along, bar.side));
        const glm::dvec3 side = glm::cross(up, along);
        const glm::dvec2 half = bar.half_mm(v);
        return SurfacePoint{bar.path(v) + side * (half.x * std::cos(phi)) + up * (half.y * std::sin(phi)),
                            {static_cast<float>(u), bar.strip.v(v, bar.atlas_rows)}};
    };
    return patch;
}

} // namespace frustumscreen::artifacts
