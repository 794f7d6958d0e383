#include "assets_baked/artifacts/amphora_ornaments.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::artifacts {
namespace {

using glm::vec2;

constexpr float turn = 6.28318531F;
constexpr float ornament_raised_mm = 0.35F;

void stamp(Ink& ink, Pigment pigment, float distance, float edge) {
    ink.paint(pigment, cover(distance, edge));
    ink.raise(ornament_raised_mm, cover(distance + edge, 3.0F * edge));
}

/// x within its unit, -unit/2..unit/2, and the unit's number.
float within_unit(float x, float unit, int& number) {
    const float cell = std::floor(x / unit + 0.5F);
    number = static_cast<int>(cell);
    return x - cell * unit;
}

} // namespace

void paint_meander(Ink& ink, glm::vec2 p, float unit, float height, float edge) {
    // The key's strokes in a grid of 8 x 7 cells, each between two corners.
    struct Stroke {
        vec2 a, b;
    };
    constexpr std::array<Stroke, 7> strokes = {{{{-1, 0}, {0, 0}},
                                                {{0, 0}, {0, 6}},
                                                {{0, 6}, {5, 6}},
                                                {{5, 6}, {5, 2}},
                                                {{5, 2}, {2, 2}},
                                                {{2, 2}, {2, 4}},
                                                {{2, 4}, {3, 4}}}};
    const vec2 cell = {unit / 8.0F, height / 7.0F};
    float distance = 1e9F;
    const float x = p.x - unit * std::floor(p.x / unit);
    for (const float shift : {-unit, 0.0F, unit}) {
        for (const Stroke& stroke : strokes) {
            const vec2 low = glm::min(stroke.a, stroke.b) * cell;
            const vec2 high = (glm::max(stroke.a, stroke.b) + 1.0F) * cell;
            distance =
                std::min(distance, rectangle({x + shift, p.y}, 0.5F * (low + high), 0.5F * (high - low)));
        }
        const vec2 base_low = vec2(5.0F, 0.0F) * cell;
        const vec2 base_high = vec2(8.0F, 1.0F) * cell;
        distance = std::min(distance, rectangle({x + shift, p.y}, 0.5F * (base_low + base_high),
                                                0.5F * (base_high - base_low)));
    }
    // Strokes fill their cells. They are made slightly thinner, so that the gaps between them are as wide as
    // they are.
    stamp(ink, Pigment::Slip, distance + 0.04F * cell.y, edge);
}

void paint_rays(Ink& ink, glm::vec2 p, float unit, float height, float edge) {
    int number = 0;
    const float x = std::abs(within_unit(p.x, unit, number));
    const float slope = 0.5F * unit / height;
    stamp(ink, Pigment::Slip, std::max((x - slope * (height - p.y)) / std::sqrt(1.0F + slope * slope), -p.y),
          edge);
}

void paint_tongues(Ink& ink, glm::vec2 p, float unit, float height, float edge) {
    int number = 0;
    const float x = within_unit(p.x, unit, number);
    const float radius = 0.40F * unit;
    const float distance = limb({x, p.y}, {0.0F, radius + 0.3F}, {0.0F, height + radius}, radius, radius);
    stamp(ink, Pigment::Slip, std::max(distance, p.y - height), edge);
    if (number % 2 != 0) {
        ink.paint(Pigment::Red, cover(std::max(distance + 0.12F * unit, p.y - height), edge));
    }
}

void paint_palmette(Ink& ink, glm::vec2 p, float height, float edge) {
    const vec2 q = p / height;
    const float e = edge / height;
    for (int i = -4; i <= 4; ++i) {
        const float a = 0.25F * turn - 0.40F * static_cast<float>(i);
        const float length = 1.0F - 0.016F * static_cast<float>(i * i);
        const vec2 along = {std::cos(a), std::sin(a)};
        stamp(ink, Pigment::Slip,
              limb(q, vec2(0, 0.10F) + 0.16F * along, vec2(0, 0.10F) + (0.84F * length) * along, 0.030F,
                   0.088F),
              e);
        if (i % 2 != 0) {
            ink.paint(Pigment::Red, cover(limb(q, vec2(0, 0.10F) + 0.40F * along,
                                               vec2(0, 0.10F) + (0.83F * length) * along, 0.012F, 0.056F),
                                          e));
        }
    }
    stamp(ink, Pigment::Slip, disc(q, {0, 0.08F}, 0.17F), e);
    ink.paint(Pigment::Red, cover(disc(q, {0, 0.08F}, 0.115F), e));
    ink.paint(Pigment::Ground, 0.9F * cover(std::abs(disc(q, {0, 0.08F}, 0.135F)) - 0.008F, e));
}

void paint_lotus_chain(Ink& ink, glm::vec2 p, float unit, float height, float edge) {
    int number = 0;
    const float x = within_unit(p.x, unit, number);
    const bool lotus = number % 2 != 0;
    const float middle = 0.5F * height;
    const float up = p.y - middle;
    // Equal flowers above and below a chain of links.
    const vec2 q = {x, std::abs(up) - 0.13F * height};
    const float flower = 0.36F * height;
    if (lotus) {
        for (const float side : {-1.0F, 0.0F, 1.0F}) {
            const vec2 tip = {side * 0.42F * unit, flower * (side == 0.0F ? 0.95F : 1.0F)};
            stamp(ink, Pigment::Slip,
                  leaf(q, {0.0F, -0.02F * height}, tip, 0.085F * unit + (side == 0.0F ? 0.5F : 0.0F)), edge);
        }
        ink.paint(Pigment::Red,
                  cover(leaf(q, {0.0F, 0.06F * height}, {0.0F, 0.85F * flower}, 0.06F * unit), edge));
        for (const float side : {-1.0F, 1.0F}) {
            stamp(ink, Pigment::Slip, leaf(q, {0.0F, 0.0F}, {side * 0.21F * unit, flower}, 0.045F * unit),
                  edge);
        }
        stamp(ink, Pigment::Slip, disc(q, {0.0F, 0.02F * height}, 0.10F * unit), edge);
    } else {
        paint_palmette(ink, q, flower, edge);
    }
    const float link = std::abs(disc({std::abs(x) - 0.5F * unit, up}, {0.0F, 0.0F}, 0.11F * height)) - 0.6F;
    const float bar = std::abs(up) - 0.7F;
    stamp(ink, Pigment::Slip, std::min(link, std::max(bar, std::abs(x) - 0.5F * unit + 0.11F * height)),
          edge);
    ink.paint(Pigment::Red, cover(disc({std::abs(x) - 0.5F * unit, up}, {0.0F, 0.0F}, 0.05F * height), edge));
}

void paint_bud_chain(Ink& ink, glm::vec2 p, float unit, float height, float edge) {
    int number = 0;
    const float x = within_unit(p.x, unit, number);
    const float foot = 0.36F * height;
    stamp(ink, Pigment::Slip, leaf({x, p.y}, {0.0F, foot}, {0.0F, height}, 0.30F * unit), edge);
    ink.paint(Pigment::Ground, 0.9F * cover(std::abs(std::abs(x) - 0.05F * unit) - 0.10F, edge) *
                                   cover(foot + 1.5F - p.y, edge));
    const float stalk = limb({x, p.y}, {0.0F, foot * 0.6F}, {0.0F, foot + 1.0F}, 0.5F, 0.7F);
    float arcs = stalk;
    for (const float side : {-1.0F, 1.0F}) { // each bud is joined to the next but one
        arcs = std::min(arcs, std::abs(disc({x - side * unit, p.y}, {0.0F, foot + 0.2F * height},
                                            std::sqrt(unit * unit + 0.04F * height * height))) -
                                  0.35F);
    }
    stamp(ink, Pigment::Slip, std::max({arcs, -p.y, p.y - foot - 1.0F}), edge);
    stamp(ink, Pigment::Slip, disc({std::abs(x) - 0.5F * unit, p.y}, {0.0F, 0.72F * height}, 0.09F * unit),
          edge);
}

void paint_line(Ink& ink, float y, float at, float width, Pigment pigment, float edge) {
    const float distance = std::abs(y - at) - 0.5F * width;
    ink.paint(pigment, cover(distance, edge));
    ink.raise(0.25F, cover(distance + edge, 3.0F * edge));
}

float spiral(glm::vec2 p, float outer, float turns) {
    const float pitch = outer / turns; // radius gained in one turn
    const float angle = std::atan2(p.y, p.x) / turn + 0.25F;
    const float radius = glm::length(p);
    const float nearest_turn = std::round(radius / pitch - angle);
    float distance = 1e9F;
    for (float k = nearest_turn - 1.0F; k <= nearest_turn + 1.0F; k += 1.0F) {
        const float at = angle + k;
        if (at >= 0.35F && at <= turns) {
            distance = std::min(distance, std::abs(radius - pitch * at));
        }
    }
    return std::min(distance, std::abs(glm::length(p)) - 0.012F * outer);
}

} // namespace frustumscreen::artifacts
