#include "assets_baked/artifacts/amphora_ornaments.h"
#include "assets_baked/artifacts/hall/turned.h"
#include "assets_baked/artifacts/hall/vessels.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::artifacts {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int texture_size = 1024;
constexpr AtlasStrip whole{0, 1024};

// ---- the plum vase

Profile vase_profile() {
    return Profile({{0, 6},          {40, 5},     {46, 0, true},   {54, 0, true}, {56, 3},   {55, 12},
                    {56, 34},        {63, 90},    {77, 150},       {92, 205},     {97, 240}, {91, 272},
                    {70, 298},       {44, 312},   {30, 318, true}, {26, 322},     {25, 330}, {29, 337},
                    {33, 341, true}, {32.5, 344}, {29, 345, true}, {21, 337},     {19, 326}, {24, 314},
                    {60, 290},       {80, 268},   {86, 240},       {60, 110},     {44, 40},  {0, 22}});
}

/// Distance from a petal's outline, in petals' widths: petals stand side by side, pointed upward.
float petal(float x, float y) {
    const float across = std::abs(x - std::floor(x) - 0.5F); // 0 in its middle
    const float half = 0.47F * std::sqrt(std::max(0.0F, 1.0F - std::pow(std::max(0.0F, y), 2.4F)));
    return across - half;
}

/// The carving: `depth` is 0 on the ground and 1 on a petal's ridge, `groove` is 1 along its outline.
struct Carving {
    float depth = 0.0F;
    float groove = 0.0F;
};

Carving carved(const TurnedPlace& place) {
    const auto height = static_cast<float>(place.along.position.y);
    Carving carving;
    if (place.along.normal.x < 0.0 && height < 330.0F && place.along.length_mm > 400.0) {
        return carving; // inside
    }
    const auto u = static_cast<float>(place.u);
    const auto row = [&](float from, float to, float count, float shift) {
        const float y = (height - from) / (to - from);
        if (y < 0.0F || y > 1.1F) {
            return;
        }
        const float begins = glm::smoothstep(0.0F, 0.14F, y);
        const float distance = petal(u * count + shift, y);
        const float across = std::abs(u * count + shift - std::floor(u * count + shift) - 0.5F);
        const float line = std::exp(-distance * distance / (0.030F * 0.030F));
        const float rib = std::exp(-across * across / (0.022F * 0.022F)) * glm::smoothstep(0.95F, 0.75F, y);
        if (distance < 0.0F) {
            carving = {begins * glm::smoothstep(0.0F, -0.16F, distance) * (1.0F - 0.30F * y),
                       0.55F * rib * begins};
        }
        carving.groove = std::max(carving.groove, line * begins);
    };
    row(14.0F, 116.0F, 12.0F, 0.5F);
    row(14.0F, 92.0F, 12.0F, 0.0F);
    row(308.0F, 240.0F, 12.0F, 0.5F);
    row(308.0F, 258.0F, 12.0F, 0.0F);
    return carving;
}

vec3 vase_colour(const TurnedPlace& place) {
    const auto u = static_cast<float>(place.u);
    const auto length = static_cast<float>(place.along.length_mm);
    const Carving carving = carved(place);
    const float drift = noise({u * 8.0F, length * 0.012F}, 8, 4, 301);
    const float crack_at = cell_border({u * 34.0F + 0.6F * drift, length * 0.060F}, 34, 302);
    const float crack = glm::smoothstep(0.045F, 0.0F, crack_at) * (0.35F + 0.3F * drift);
    const vec3 thin(0.66F, 0.76F, 0.66F);
    const vec3 thick(0.40F, 0.58F, 0.50F);
    // Glaze gathers in the carving and is thin on ridges and at the rim.
    const float gathered = std::clamp(0.55F - 0.5F * carving.depth + 0.25F * drift, 0.0F, 1.0F);
    vec3 colour = glm::mix(thin, thick, gathered) * (1.0F - 0.34F * carving.groove);
    colour = glm::mix(colour, vec3(0.36F, 0.36F, 0.27F), std::clamp(crack, 0.0F, 0.5F));
    const auto height = static_cast<float>(place.along.position.y);
    const float rim = glm::smoothstep(5.0F, 0.0F, std::abs(height - 343.0F));
    const float foot = glm::smoothstep(7.0F, 3.0F, height);
    return glm::mix(colour, vec3(0.55F, 0.37F, 0.25F), std::clamp(0.7F * rim + 0.9F * foot, 0.0F, 1.0F));
}

// ---- the bowl

Profile bowl_profile() {
    return Profile({{0, 9},
                    {44, 8},
                    {48, 0, true},
                    {54, 0, true},
                    {55, 6},
                    {56, 12, true},
                    {80, 24},
                    {104, 50},
                    {120, 82},
                    {133, 106, true},
                    {134.5, 108},
                    {133, 109.5, true},
                    {129, 107},
                    {116, 84},
                    {100, 54},
                    {76, 29},
                    {50, 19},
                    {0, 17}});
}

/// The share of cobalt at a place of the outside, x and y in mm: a scroll of peonies.
float scroll(vec2 p, float unit) {
    const float number = std::floor(p.x / unit);
    const bool up = (static_cast<int>(number) & 1) == 0;
    const vec2 q(p.x - (number + 0.5F) * unit, up ? p.y : -p.y);
    float distance = std::abs(q.y - 7.0F * std::cos(3.14159F * q.x / unit)) - 0.9F; // the stem
    for (int k = 0; k < 8; ++k) {
        const float a = 0.785398F * static_cast<float>(k);
        const vec2 along(std::cos(a), std::sin(a));
        distance = std::min(
            distance, leaf(q, vec2(0.0F, -6.0F) + 4.0F * along, vec2(0.0F, -6.0F) + 15.5F * along, 4.4F));
    }
    distance = std::min(distance, disc(q, {0.0F, -6.0F}, 3.2F));
    for (const float side : {-1.0F, 1.0F}) {
        distance =
            std::min(distance, leaf(q, {side * 0.30F * unit, 3.0F}, {side * 0.46F * unit, 17.0F}, 3.0F));
        distance =
            std::min(distance, leaf(q, {side * 0.34F * unit, 2.0F}, {side * 0.22F * unit, 17.0F}, 2.6F));
        distance =
            std::min(distance, leaf(q, {side * 0.36F * unit, 0.0F}, {side * 0.44F * unit, -15.0F}, 3.0F));
    }
    return cover(distance, 1.0F);
}

float bowl_cobalt(const TurnedPlace& place, double rim_mm) {
    const auto length = static_cast<float>(place.along.length_mm);
    const auto radius = static_cast<float>(place.along.position.x);
    const auto height = static_cast<float>(place.along.position.y);
    const auto u = static_cast<float>(place.u);
    Ink ink;
    constexpr float edge = 0.9F;
    if (place.along.length_mm < rim_mm) {
        if (height > 30.0F && height < 95.0F) {
            ink.paint(Pigment::Slip, scroll({u * 690.0F, length - 152.0F}, 690.0F / 12.0F));
        }
        if (height > 12.0F && height < 30.0F) {
            paint_tongues(ink, {u * 480.0F, height - 13.0F}, 480.0F / 32.0F, 13.0F, edge);
        }
        for (const float at : {28.0F, 30.5F, 97.0F, 102.0F}) {
            paint_line(ink, height, at, 1.0F, Pigment::Slip, 0.8F);
        }
        paint_line(ink, height, 5.0F, 2.5F, Pigment::Slip, edge);
    } else {
        const float a = (u - 0.5F) * 6.2831853F;
        const vec2 p = radius * vec2(std::sin(a), std::cos(a));
        if (radius < 46.0F) { // the medallion
            for (int k = 0; k < 6; ++k) {
                const float at = 1.0471976F * static_cast<float>(k);
                const vec2 along(std::cos(at), std::sin(at));
                ink.paint(Pigment::Slip, cover(leaf(p, 6.0F * along, 36.0F * along, 9.5F), 1.2F));
                ink.paint(Pigment::Ground, cover(leaf(p, 12.0F * along, 31.0F * along, 2.0F), 1.0F));
            }
            ink.paint(Pigment::Slip, cover(disc(p, {0.0F, 0.0F}, 5.0F), 1.2F));
        }
        for (const float at : {41.0F, 45.0F, 100.0F, 104.0F}) {
            ink.paint(Pigment::Slip, cover(std::abs(radius - at) - 0.6F, 0.9F));
        }
        if (radius > 105.0F) {
            paint_tongues(ink, {u * 760.0F, 128.5F - radius}, 760.0F / 48.0F, 20.0F, 1.4F);
        }
        if (radius > 50.0F && radius < 98.0F) {
            ink.paint(Pigment::Slip, scroll({u * 480.0F, radius - 74.0F}, 480.0F / 10.0F));
        }
    }
    return ink.share.y + ink.share.z;
}

vec3 bowl_colour(const TurnedPlace& place, double rim_mm) {
    const auto u = static_cast<float>(place.u);
    const auto length = static_cast<float>(place.along.length_mm);
    const float wash = noise({u * 60.0F, length * 0.11F}, 60, 4, 411);
    const float drift = noise({u * 6.0F, length * 0.02F}, 6, 3, 412);
    const vec3 white = vec3(0.93F, 0.94F, 0.93F) + 0.02F * drift;
    const vec3 cobalt = glm::mix(vec3(0.10F, 0.17F, 0.47F), vec3(0.26F, 0.38F, 0.68F),
                                 std::clamp(0.45F + 0.9F * wash, 0.0F, 1.0F));
    return glm::mix(white, cobalt, bowl_cobalt(place, rim_mm));
}

} // namespace

bake::SourceMesh make_celadon_vase(std::int64_t triangles) {
    const Turned body{.profile = vase_profile(),
                      .strip = whole,
                      .atlas_rows = texture_size,
                      .raised_mm = [](const TurnedPlace& place) {
                          return place.along.position.y < 8.0 || place.along.position.x < 40.0
                                     ? 0.0
                                     : 1.4 * static_cast<double>(carved(place).depth);
                      }};
    image::Image8 texture(texture_size, texture_size);
    paint_turned(body, texture, vase_colour);
    return make_mesh({turned(body)}, triangles, std::move(texture));
}

bake::SourceMesh make_bowl(std::int64_t triangles) {
    const Turned body{.profile = bowl_profile(), .strip = whole, .atlas_rows = texture_size};
    image::Image8 texture(texture_size, texture_size);
    const double rim_mm = body.profile.length_at_height(109.0);
    paint_turned(body, texture, [rim_mm](const TurnedPlace& place) { return bowl_colour(place, rim_mm); });
    return make_mesh({turned(body)}, triangles, std::move(texture));
}

} // namespace frustumscreen::artifacts
