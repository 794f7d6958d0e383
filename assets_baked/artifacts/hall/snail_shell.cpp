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
constexpr AtlasStrip outside{0, 760};
constexpr AtlasStrip inside{768, 248};

/// A tube on a spiral cone whose section grows by `growth` in each radian; 0 is the lip, negative angles lie within.
/// Source: the logarithmic spiral of molluscan shells (Moseley 1838).
constexpr double growth = 0.092;
constexpr double first_theta = -6.6 * full_turn;
constexpr double wall_mm = 2.6;
constexpr double apex_mm = 236.0; ///< height of the spiral's tip

/// phi goes around the section: 0 looks away from the axis, a quarter turn looks up.
glm::dvec3 bare(double theta, double phi) {
    const double scale = std::exp(growth * theta);
    const double out = std::cos(phi);
    const double up = std::sin(phi);
    // A shoulder above the middle, a canal drawn out below.
    const double canal = std::max(0.0, -up);
    const double radius =
        scale * (31.0 + 40.0 * out * (1.0 - 0.42 * canal * canal) + 5.0 * up * std::max(0.0, out));
    const double height = apex_mm - scale * (158.0 - 44.0 * up + 26.0 * canal * canal);
    const double a = theta + 0.62 * full_turn;
    return {radius * std::sin(a), height, radius * std::cos(a)};
}

glm::dvec3 normal(double theta, double phi) {
    constexpr double h = 1e-4;
    const glm::dvec3 along = bare(theta + h, phi) - bare(theta - h, phi);
    const glm::dvec3 around = bare(theta, phi + h) - bare(theta, phi - h);
    return glm::normalize(glm::cross(along, around));
}

double bump(double x, double width) {
    return std::exp(-x * x / (width * width));
}

/// Knobs on the shoulder, fine lines along the tube; at the lip it flares.
double relief(double theta, double phi) {
    const double knob = std::pow(0.5 + 0.5 * std::cos(9.0 * theta), 2.0);
    const double lines = 0.5 * std::sin(34.0 * phi) * bump(phi + 0.3, 1.6);
    return 8.0 * knob * bump(phi - 0.72, 0.34) + lines + 9.0 * std::exp(16.0 * theta) * bump(phi + 0.1, 1.5);
}

double phi_of(double u) {
    return ((u < 1.0 ? u : 0.0) - 0.5) * full_turn;
}

glm::dvec3 at(double theta, double phi, double height) {
    return bare(theta, phi) + normal(theta, phi) * (height * std::exp(growth * theta));
}

/// The middle of the section: where a patch ends in one point.
glm::dvec3 middle_at(double theta) {
    return 0.5 * (bare(theta, 0.0) + bare(theta, 0.5 * full_turn));
}

Patch outer() {
    Patch patch;
    patch.at = [](double u, double v) {
        const double phi = phi_of(u);
        const double theta = first_theta * (1.0 - std::pow(1.0 - v, 0.62));
        return SurfacePoint{v < 1.0 ? at(theta, phi, relief(theta, phi)) : middle_at(first_theta),
                            {static_cast<float>(u), outside.v(1.0 + theta / -first_theta, texture_size)}};
    };
    patch.length_u_mm = 230.0;
    patch.length_v_mm = 1100.0;
    patch.min_u = 10;
    patch.min_v = 40;
    patch.pole_at_end = true;
    return patch;
}

/// From a floor out of sight to the lip.
Patch inner() {
    Patch patch;
    patch.at = [](double u, double v) {
        constexpr double deepest = -0.30 * full_turn;
        const double phi = phi_of(u);
        const double within = 1.0 - v; // 0 at the lip
        const double theta = deepest * within;
        const double height = glm::mix(relief(theta, phi), -wall_mm, std::min(1.0, 14.0 * within));
        glm::dvec3 position = at(theta, phi, height);
        if (within > 0.86) {
            position =
                v > 0.0 ? glm::mix(position, middle_at(theta), (within - 0.86) / 0.14) : middle_at(theta);
        }
        return SurfacePoint{position, {static_cast<float>(u), inside.v(within, texture_size)}};
    };
    patch.length_u_mm = 230.0;
    patch.length_v_mm = 150.0;
    patch.min_u = 10;
    patch.min_v = 10;
    patch.pole_at_start = true;
    patch.columns_of = 0;
    return patch;
}

} // namespace

bake::SourceMesh make_shell(std::int64_t triangles) {
    image::Image8 texture(texture_size, texture_size);
    paint_strip(outside, texture, [](float u, float v) {
        const float theta = static_cast<float>(first_theta) * (1.0F - v);
        const float phi = (u - 0.5F) * 6.2831853F;
        const float drift = noise({u * 6.0F, theta * 1.2F}, 6, 4, 901);
        const float growth_lines = noise({u * 3.0F, theta * 14.0F}, 3, 3, 902);
        const vec3 cream = vec3(0.93F, 0.84F, 0.68F) * (1.0F + 0.06F * drift + 0.08F * growth_lines);
        const float flames = std::cos(9.0F * theta + 2.6F * phi + 3.5F * drift);
        const float brown = glm::smoothstep(0.15F, 0.65F, flames + 0.6F * growth_lines) *
                            (0.55F + 0.45F * std::cos(3.0F * phi));
        const vec3 rust = vec3(0.56F, 0.27F, 0.12F);
        const float tip = glm::smoothstep(0.40F, 0.0F, v);
        vec3 colour = glm::mix(cream, rust, std::clamp(brown, 0.0F, 0.85F));
        colour = glm::mix(colour, vec3(0.80F, 0.60F, 0.48F), 0.5F * tip);
        return glm::mix(colour, vec3(0.96F, 0.78F, 0.66F), glm::smoothstep(0.990F, 1.0F, v));
    });
    paint_strip(inside, texture, [](float u, float v) {
        const float drift = noise({u * 5.0F, v * 4.0F}, 5, 4, 911);
        const vec3 rose = vec3(0.95F, 0.70F, 0.60F) * (1.0F + 0.05F * drift);
        return glm::mix(rose, vec3(0.72F, 0.38F, 0.30F), glm::smoothstep(0.05F, 0.6F, v));
    });
    return make_mesh({outer(), inner()}, triangles, std::move(texture));
}

} // namespace frustumscreen::artifacts
