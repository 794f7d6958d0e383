#include "assets_baked/artifacts/hall/sculptures.h"
#include "assets_baked/artifacts/hall/turned.h"
#include "assets_baked/artifacts/ink.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::artifacts {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int texture_size = 1024;
constexpr AtlasStrip outside{0, 600};
constexpr AtlasStrip inside{608, 200};
constexpr AtlasStrip crest_strip{816, 200};
constexpr double wall_mm = 2.4;
constexpr double equator_mm = 150.0; ///< height of the dome's foot
constexpr double dome_mm = 112.0;

double within(double x, double from, double to, double soft) {
    return glm::smoothstep(from, from + soft, x) * glm::smoothstep(to, to - soft, x);
}

/// Height of the lower edge at an angle from the front: nose guard, eye, cheek piece, ear, neck guard.
double edge_mm(double angle) {
    const double a = std::abs(angle);
    double edge = 148.0;                                         // above the eyes
    edge = glm::mix(edge, 88.0, glm::smoothstep(0.16, 0.05, a)); // the nose guard
    const double cheek = 20.0 + 34.0 * std::pow(std::abs(a - 0.82) / 0.40, 3.0);
    edge = glm::mix(edge, std::min(cheek, 150.0), within(a, 0.37, 1.40, 0.20));
    edge = glm::mix(edge, 104.0, within(a, 1.20, 1.80, 0.22)); // above the ear
    edge = glm::mix(edge, 40.0, glm::smoothstep(1.55, 2.05, a));
    return edge;
}

/// The outer wall: `along` 0 at the crown, 1 at the edge.
glm::dvec3 wall(double angle, double along, double inward_mm) {
    constexpr double dome_share = 0.52;
    const double edge = edge_mm(angle);
    double radius = 0.0;
    double height = 0.0;
    const double t = std::min(1.0, along / dome_share);
    radius = std::sin(0.25 * full_turn * t);
    height = equator_mm + dome_mm * std::cos(0.25 * full_turn * t);
    if (along > dome_share) {
        const double down = (along - dome_share) / (1.0 - dome_share);
        height = glm::mix(equator_mm, edge, down);
        const double below = equator_mm - height;
        const double neck = glm::smoothstep(1.5, 2.3, std::abs(angle));
        radius = 1.0 - 0.0011 * below + neck * (0.30 * std::pow(below / 110.0, 2.6) - 0.0012 * below);
        radius +=
            (1.0 - neck) * 0.03 * std::sin(std::min(1.0, std::max(0.0, below) / 120.0) * 0.5 * full_turn);
    }
    const double front = std::cos(angle);
    const double deep = 112.0 + 4.0 * front; // to front and back
    const glm::dvec2 half(92.0 - inward_mm, deep - inward_mm);
    glm::dvec3 at(half.x * radius * std::sin(angle), height, half.y * radius * front);
    if (along < dome_share) {
        at.y -= inward_mm * std::cos(0.25 * full_turn * t);
    }
    return at;
}

/// Brows, and a rim along the edge.
double raised_mm(double angle, double along, double height) {
    const double a = std::abs(angle);
    const double brow = 176.0 - 26.0 * std::pow(std::abs(a - 0.42) / 0.5, 2.0);
    double up = 3.4 * std::exp(-std::pow((height - brow) / 4.5, 2.0)) * glm::smoothstep(1.0, 0.7, a) *
                glm::smoothstep(0.0, 0.10, a);
    up +=
        2.4 * std::exp(-std::pow(angle / 0.05, 2.0)) * glm::smoothstep(0.42, 0.60, along); // the nose's ridge
    up += 1.3 * glm::smoothstep(0.965, 0.985, along);
    return up;
}

vec3 bronze(vec2 p, int period, float recess) {
    const float drift = noise(p, period, 5, 801);
    const float fine = noise(p * 8.0F, 8 * period, 3, 802);
    const vec3 metal = vec3(0.66F, 0.46F, 0.22F) * (1.0F + 0.12F * drift + 0.10F * fine);
    const vec3 dark(0.25F, 0.17F, 0.09F);
    const vec3 patina(0.33F, 0.52F, 0.43F);
    const float green = glm::smoothstep(0.08F, 0.46F, drift + 0.45F * fine + 0.40F * recess);
    return glm::mix(glm::mix(metal, dark, std::clamp(recess, 0.0F, 1.0F)), patina, 0.62F * green);
}

Patch shell_of(bool outer) {
    Patch patch;
    patch.at = [outer](double u, double v) {
        const double angle = ((u < 1.0 ? u : 0.0) - 0.5) * full_turn;
        // Outside from the edge up to the crown; inside from the crown down to the edge.
        const double along = outer ? 1.0 - v : v;
        glm::dvec3 at = wall(angle, along, outer ? 0.0 : wall_mm * std::min(1.0, (1.0 - along) * 40.0));
        if (outer) {
            const double fade = std::min(1.0, (1.0 - along) * 60.0) * glm::smoothstep(0.0, 0.08, along);
            at += glm::normalize(glm::dvec3(at.x, 0.0, at.z) + glm::dvec3(0, 1e-9, 0)) *
                  (fade * raised_mm(angle, along, at.y));
        }
        const AtlasStrip& strip = outer ? outside : inside;
        return SurfacePoint{at, {static_cast<float>(u), strip.v(along, texture_size)}};
    };
    patch.length_u_mm = 640.0;
    patch.length_v_mm = outer ? 300.0 : 150.0;
    patch.min_u = 48;
    patch.min_v = outer ? 16 : 6;
    patch.pole_at_end = outer;
    patch.pole_at_start = !outer;
    return patch;
}

/// Stands on the dome from above the brow to the nape.
Patch crest() {
    Patch patch;
    patch.at = [](double u, double v) {
        const double phi = u < 1.0 ? u * full_turn : 0.0;
        const double a =
            glm::mix(-0.66, 1.80, v); // along the dome's middle: 0 is the crown, negative in front
        const double out = std::cos(phi);
        const double end = v < 1.0 ? std::pow(std::max(0.0, std::sin(0.5 * full_turn * v)), 0.35) : 0.0;
        const double tail = glm::smoothstep(1.2, 1.8, a);
        const double high = (24.0 + 12.0 * std::sin(0.5 * full_turn * v) + 10.0 * tail) * end;
        const double wide = (7.5 + 1.2 * out) * end;
        const double radial = 2.0 + high + high * std::copysign(std::pow(std::abs(out), 0.8), out);
        const double deep = a > 0.0 ? 108.0 : 116.0;
        const glm::dvec2 base(-std::sin(a) * deep, std::cos(a) * dome_mm); // z, y
        const glm::dvec2 normal = glm::normalize(glm::dvec2(base.x * dome_mm, base.y * deep));
        const glm::dvec2 at = base + normal * radial;
        return SurfacePoint{{-wide * std::sin(phi), equator_mm + at.y, at.x},
                            {static_cast<float>(4.0 * v), crest_strip.v(0.5 + 0.5 * out, texture_size)}};
    };
    patch.length_u_mm = 130.0;
    patch.length_v_mm = 420.0;
    patch.min_u = 12;
    patch.min_v = 24;
    patch.pole_at_start = true;
    patch.pole_at_end = true;
    return patch;
}

} // namespace

bake::SourceMesh make_helmet(std::int64_t triangles) {
    image::Image8 texture(texture_size, texture_size);
    paint_strip(outside, texture, [](float u, float v) {
        const double angle = (static_cast<double>(u) - 0.5) * full_turn;
        const glm::dvec3 at = wall(angle, static_cast<double>(v), 0.0);
        const auto up = static_cast<float>(raised_mm(angle, static_cast<double>(v), at.y));
        const float beyond = static_cast<float>(raised_mm(angle, static_cast<double>(v), at.y - 7.0));
        float recess = std::clamp(0.35F * (beyond - up), 0.0F, 0.5F);
        // Two engraved lines and a row of dots follow the edge.
        const auto from_edge = static_cast<float>(1.0 - static_cast<double>(v)) * 230.0F;
        recess = std::max(recess, 0.8F * cover(std::abs(from_edge - 11.0F) - 0.5F, 1.0F));
        recess = std::max(recess, 0.8F * cover(std::abs(from_edge - 19.0F) - 0.5F, 1.0F));
        const float dots = u * 110.0F - std::floor(u * 110.0F) - 0.5F;
        recess =
            std::max(recess, 0.9F * cover(glm::length(vec2(dots * 5.8F, from_edge - 15.0F)) - 1.5F, 1.0F));
        return bronze({u * 14.0F, v * 7.0F}, 14, recess) * (1.0F + 0.09F * up);
    });
    paint_strip(inside, texture, [](float u, float v) {
        return 0.62F * bronze({u * 14.0F, v * 7.0F}, 14, 0.5F);
    });
    paint_strip(crest_strip, texture, [](float u, float v) {
        const float hair = noise({u * 256.0F, v * 2.2F}, 256, 3, 811);
        const float lock = noise({u * 40.0F, v * 1.5F}, 40, 2, 812);
        const vec3 red = vec3(0.60F, 0.10F, 0.08F) * (1.0F + 0.55F * hair + 0.35F * lock);
        const vec3 white = vec3(0.90F, 0.85F, 0.76F) * (1.0F + 0.25F * hair);
        const vec3 holder = bronze({u * 40.0F, v * 2.0F}, 40, 0.25F);
        const float band = cover(std::abs(v - 0.30F) - 0.045F, 0.02F);
        return glm::mix(glm::mix(red, white, band), holder, glm::smoothstep(0.22F, 0.19F, v));
    });
    std::vector<Patch> patches{shell_of(true), shell_of(false), crest()};
    patches[1].columns_of = 0;
    return make_mesh(patches, triangles, std::move(texture));
}

} // namespace frustumscreen::artifacts
