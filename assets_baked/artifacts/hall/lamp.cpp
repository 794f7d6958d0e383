#include "assets_baked/artifacts/hall/turned.h"
#include "assets_baked/artifacts/hall/vessels.h"
#include "assets_baked/artifacts/ink.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::artifacts {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int texture_size = 1024;
constexpr AtlasStrip body_strip{0, 640};
constexpr AtlasStrip nozzle_strip{648, 248};
constexpr AtlasStrip ring_strip{904, 112};

Profile body_profile() {
    return Profile({{0, 3},
                    {22, 2.4},
                    {25, 0, true},
                    {29, 0, true},
                    {34, 4},
                    {43, 12},
                    {46, 20},
                    {44, 27},
                    {38, 32},
                    {34, 33.4, true},
                    {32.5, 32.2},
                    {31, 33.2, true},
                    {29.4, 31, true},
                    {24, 28.4},
                    {12, 27},
                    {6, 27, true},
                    {5, 25},
                    {4, 20, true},
                    {0, 19}});
}

/// The rosette of the disc and the row of beads on the shoulder.
double body_relief(const TurnedPlace& place) {
    const double r = place.along.position.x;
    if (place.along.normal.y < 0.2 || place.along.position.y < 24.0) {
        return 0.0;
    }
    double height = 0.0;
    if (r > 7.0 && r < 28.0) {
        const double lobe = std::abs(std::cos(5.0 * place.angle));
        const double across = std::min(1.0, std::min(r - 7.0, 28.0 - r) / 4.0);
        height += 1.7 * across * (std::pow(lobe, 0.55) - 0.35) * (0.6 + 0.4 * r / 28.0);
    }
    if (r > 36.0 && r < 43.0) {
        const double bead = std::abs(std::cos(18.0 * place.angle));
        height += 0.9 * std::sqrt(std::max(0.0, 1.0 - (r - 39.5) * (r - 39.5) / 10.0)) * bead;
    }
    return height;
}

vec3 clay(vec2 p, int period, float recess) {
    const float drift = noise(p, period, 5, 501);
    const float fine = noise(p * 9.0F, period * 9, 2, 502);
    const vec3 slip = vec3(0.74F, 0.36F, 0.18F) * (1.0F + 0.16F * drift + 0.05F * fine);
    const vec3 bare(0.80F, 0.57F, 0.39F);
    const vec3 worn = glm::mix(slip, bare, 0.6F * glm::smoothstep(0.16F, 0.50F, drift + 0.30F * fine));
    return worn * (1.0F - 0.45F * recess);
}

/// Spreads out of the shoulder towards +Z and ends around the hole for the wick; soot blackens its end.
Patch nozzle() {
    // Closed by its two poles: underside and top meet at the sides.
    const auto outline = [](double t) { // half width at a distance from the lamp's middle, 0..1
        return 13.5 - 4.5 * std::sin(0.5 * full_turn * std::min(1.0, 1.3 * t)) * (1.0 - t) + 5.5 * t * t;
    };
    Patch patch;
    patch.at = [outline](double u, double v) {
        const double phi = u < 1.0 ? u * full_turn : 0.0;
        const double round = std::sqrt(std::max(0.0, 1.0 - std::pow(std::abs(2.0 * v - 1.0), 5.0)));
        const double half = outline(v) * round;
        const double up = std::sin(phi);
        const double z = 26.0 + 52.0 * v;
        const double middle = 19.0 + 1.5 * v;
        const double hole = std::hypot(half * std::cos(phi), z - 67.0);
        const double dip = up > 0.0 ? 9.0 * glm::smoothstep(6.4, 4.6, hole) : 0.0;
        const double thick = (up > 0.0 ? 8.5 : 15.0 - 5.0 * v) * round;
        const double flat = up > 0.0 ? std::pow(up, 0.55) : -std::pow(-up, 0.9);
        return SurfacePoint{{half * std::cos(phi), middle + thick * flat - dip, z},
                            {static_cast<float>(u), nozzle_strip.v(v, texture_size)}};
    };
    patch.length_u_mm = 190.0; // more than its size: the hole is small
    patch.length_v_mm = 150.0;
    patch.min_u = 16;
    patch.min_v = 14;
    patch.pole_at_start = true;
    patch.pole_at_end = true;
    return patch;
}

Patch ring() {
    return bar({.path =
                    [](double t) {
                        const double a = (t - 0.5) * 0.74 * full_turn;
                        return glm::dvec3(0.0, 27.0 - 13.5 * std::sin(a), -49.0 - 12.0 * std::cos(a));
                    },
                .half_mm = [](double) { return glm::dvec2(6.0, 3.4); },
                .side = {1.0, 0.0, 0.0},
                .length_mm = 70.0,
                .strip = ring_strip,
                .atlas_rows = texture_size});
}

} // namespace

bake::SourceMesh make_lamp(std::int64_t triangles) {
    const Turned body{
        .profile = body_profile(), .strip = body_strip, .atlas_rows = texture_size, .raised_mm = body_relief};
    image::Image8 texture(texture_size, texture_size, texel_of({0.7F, 0.36F, 0.2F}));
    paint_turned(body, texture, [](const TurnedPlace& place) {
        const bool top =
            place.along.normal.y > 0.2 && place.along.position.y > 24.0 && place.along.position.x > 7.0;
        const auto recess = top ? static_cast<float>(glm::smoothstep(0.4, -0.6, body_relief(place))) : 0.0F;
        const float hole = place.along.position.x < 6.0 && place.along.position.y > 15.0 ? 0.8F : 0.0F;
        return clay({static_cast<float>(place.u) * 12.0F, static_cast<float>(place.along.length_mm) * 0.05F},
                    12, std::max(0.8F * recess, 1.6F * hole));
    });
    paint_strip(nozzle_strip, texture, [](float u, float v) {
        const float soot = glm::smoothstep(0.50F, 0.95F, v + 0.10F * noise({u * 8.0F, v * 5.0F}, 8, 4, 503)) *
                           (u < 0.5F ? 1.0F : 0.4F);
        return clay({u * 8.0F, v * 5.0F}, 8, 1.7F * soot);
    });
    paint_strip(ring_strip, texture, [](float u, float v) { return clay({u * 4.0F, v * 6.0F}, 4, 0.0F); });
    return make_mesh({turned(body), nozzle(), ring()}, triangles, std::move(texture));
}

} // namespace frustumscreen::artifacts
