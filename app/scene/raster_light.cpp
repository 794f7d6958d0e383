#include "app/scene/raster_light.h"

#include "app/relief/lens_lanes.h"
#include "app/scene/face_view.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace frustumscreen::scene {

namespace {

/// A factor of light to this power is the factor of codes: sRGB's own power, away from black.
constexpr float code_power = 1.0F / 2.4F;
constexpr float code_offset = 0.055F * 255.0F;

FRUSTUMSCREEN_INLINE relief::Floats root_of(relief::Floats values) {
    relief::Floats roots;
    for (int lane = 0; lane < relief::lanes; ++lane) {
        roots[lane] = std::sqrt(values[lane]);
    }
    return roots;
}

/// Factors for the lens: it packs pixels more densely by its area factor, which divides each pixel's light.
struct Share {
    float linear = 1.0F, code = 1.0F;
};

/// One value for eight pixels: it changes by at most a tenth of a code across them.
FRUSTUMSCREEN_INLINE Share share_of(const relief::PixelLens& lens, const relief::PixelLanes& ideal) {
    const float r2 = relief::squared_radius(lens, ideal)[relief::lanes / 2];
    const float area =
        (1.0F + r2 * (lens.k1 + lens.k2 * r2)) * (1.0F + r2 * (3.0F * lens.k1 + 5.0F * lens.k2 * r2));
    return {1.0F / area, std::pow(area, -code_power)};
}

/// Eight ideal pixels, one texel each, red in the lowest byte.
FRUSTUMSCREEN_INLINE relief::Ints lit(const RasterLight::Gain& gain, const relief::PixelLanes& at,
                                      const Share& share, relief::Ints texels) {
    const relief::Floats ray_x = at.x * gain.ray_per_pixel.x + gain.first_ray.x;
    const relief::Floats ray_y = at.y * gain.ray_per_pixel.y + gain.first_ray.y;
    const relief::Floats distance =
        root_of(ray_x * ray_x + (ray_y * ray_y + 1.0F)) /
        (ray_x * gain.inverse_depth.x + (ray_y * gain.inverse_depth.y + gain.inverse_depth.z));
    // 3 / 2.4 is 1 + 1 / 4.
    const relief::Floats linear =
        gain.brightness * relief::least(relief::all(gain.most),
                                        share.linear * gain.per_cubic_metre * distance * distance * distance);
    const relief::Floats power =
        gain.brightness_code *
        relief::least(relief::all(gain.max_code),
                      share.code * gain.per_cubic_metre_code * distance * root_of(root_of(distance)));
    const auto channel_in = [&](int shift, const relief::Floats& linear_in,
                                const relief::Floats& power_in) FRUSTUMSCREEN_INLINED {
        const relief::Floats code = __builtin_convertvector(texels >> shift & 255, relief::Floats);
        const relief::Floats straight = linear_in * code;
        const relief::Floats by_power = (code + code_offset) * power_in - code_offset;
        const relief::Floats shown =
            linear_in > 1.0F ? relief::least(straight, by_power) : relief::most(straight, by_power);
        return __builtin_convertvector(relief::least(shown, relief::all(255.0F)) + 0.5F, relief::Ints)
               << shift;
    };
    const auto channel = [&](int shift) FRUSTUMSCREEN_INLINED {
        return gain.coloured
                   ? channel_in(shift, linear * gain.light[shift / 8], power * gain.light_code[shift / 8])
                   : channel_in(shift, linear, power);
    };
    constexpr auto alpha = static_cast<std::int32_t>(0xFF000000U);
    const relief::Ints seen = texels & alpha;
    return seen != 0 ? channel(0) | channel(8) | channel(16) | seen : relief::Ints{};
}

FRUSTUMSCREEN_INLINE relief::Floats at_pixels(const glm::vec3& linear, const relief::PixelLanes& at) {
    return linear.x * at.x + linear.y * at.y + linear.z;
}

/// The pixels within the face, including those on an edge, which go to the first of two faces.
FRUSTUMSCREEN_INLINE relief::Ints inside(const RasterLight::Face& face, const relief::PixelLanes& at) {
    relief::Ints in = relief::Ints{} - 1;
    for (const glm::vec3& edge : face.edges) {
        in &= at_pixels(edge, at) >= 0.0F;
    }
    for (const glm::vec3& edge : face.more_edges) {
        in &= at_pixels(edge, at) >= 0.0F;
    }
    return in;
}

FRUSTUMSCREEN_INLINE relief::Ints softened(const RasterLight::Feather& feather, const relief::PixelLanes& at,
                                           relief::Ints own, relief::Ints texels) {
    const relief::Floats along = at_pixels(feather.along, at);
    const relief::Floats inward = at_pixels(feather.inward, at);
    own &= (along >= 0.0F) & (along <= 1.0F) & (inward >= 0.0F) & (inward <= 1.0F);
    for (unsigned lanes_left = relief::bits_of(own); lanes_left != 0; lanes_left &= lanes_left - 1) {
        const int lane = std::countr_zero(lanes_left);
        const float share =
            glm::mix(glm::mix(feather.share.x, feather.share.y, along[lane]), 1.0F, inward[lane]);
        const float factor = std::pow(std::max(share, 0.0F), code_power);
        const auto code = std::bit_cast<glm::u8vec4>(texels[lane]);
        texels[lane] =
            std::bit_cast<std::int32_t>(glm::u8vec4(glm::u8vec3(factor * glm::vec3(code) + 0.5F), code.a));
    }
    return texels;
}

/// True if a part may contain some of the eight pixels from `x` on.
FRUSTUMSCREEN_INLINE bool may_have(const PixelRectangle& part, int x, int y) {
    return y >= part.y && y < part.y + part.height && x + relief::lanes > part.x && x < part.x + part.width;
}

/// Eight pixels of row `y`, from `x` on.
FRUSTUMSCREEN_INLINE relief::Ints shown(const RasterLight::Parts& parts, int x, int y, relief::Ints texels) {
    constexpr relief::Floats middles = {0.5F, 1.5F, 2.5F, 3.5F, 4.5F, 5.5F, 6.5F, 7.5F};
    relief::PixelLanes at{static_cast<float>(x) + middles, relief::all(static_cast<float>(y) + 0.5F)};
    Share share;
    if (parts.lens.bends) {
        at = relief::unbent(parts.lens, at);
        share = share_of(parts.lens, at);
    }
    relief::Ints left = relief::Ints{} - 1; // pixels that no face has taken yet
    relief::Ints result{};
    for (const RasterLight::Face& face : parts.faces) {
        const relief::Ints own = may_have(face.lit, x, y) ? left & inside(face, at) : relief::Ints{};
        if (!relief::any(own)) {
            continue;
        }
        left &= ~own;
        relief::Ints codes = parts.changes_codes ? lit(face.gain, at, share, texels) : texels;
        for (const RasterLight::Feather& feather : parts.feathers) {
            if (feather.face == face.face && may_have(feather.lit, x, y)) {
                codes = softened(feather, at, own, codes);
            }
        }
        result = own != 0 ? codes : result;
    }
    return result;
}

FRUSTUMSCREEN_INLINE void light_row(const RasterLight::Parts& parts, int y, int first,
                                    std::span<glm::u8vec4> codes) {
    for (std::size_t k = 0; k < codes.size(); k += relief::lanes) {
        const std::size_t bytes =
            sizeof(glm::u8vec4) * std::min<std::size_t>(relief::lanes, codes.size() - k);
        relief::Ints texels{};
        std::memcpy(&texels, &codes[k], bytes);
        texels = shown(parts, first + static_cast<int>(k), y, texels);
        std::memcpy(static_cast<void*>(&codes[k]), &texels, bytes);
    }
}

RasterLight::Gain gain_of(const FacePlan& face, const geometry::Pinhole& pinhole, bool even_light,
                          float brightness, const glm::vec3& light) {
    RasterLight::Gain gain;
    const glm::dvec2 per_pixel = 1.0 / glm::dvec2(pinhole.fx, pinhole.fy);
    gain.ray_per_pixel = glm::vec2(per_pixel);
    gain.first_ray = glm::vec2(-glm::dvec2(pinhole.cx, pinhole.cy) * per_pixel);
    gain.brightness = brightness;
    gain.brightness_code = std::pow(brightness, code_power);
    gain.coloured = light != glm::vec3(1.0F);
    gain.light = light;
    gain.light_code = glm::pow(light, glm::vec3(code_power));
    gain.per_cubic_metre = gain.per_cubic_metre_code = std::numeric_limits<float>::infinity();
    if (even_light) {
        gain.inverse_depth = face.light.inverse_depth;
        gain.per_cubic_metre = face.light.per_cubic_metre;
        gain.per_cubic_metre_code = std::pow(face.light.per_cubic_metre, code_power);
        gain.most = face.light.most;
        gain.max_code = std::pow(face.light.most, code_power);
    }
    return gain;
}

/// The linear function that is 0 at the first point and 1 at the second.
glm::dvec3 linear_between(const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dvec2 slope = (to - from) / glm::dot(to - from, to - from);
    return {slope, -glm::dot(slope, from)};
}

} // namespace

glm::vec3 RasterLight::rest_of(const glm::vec3& light) const {
    glm::vec3 rest(1.0F);
    for (int channel = 0; channel < 3; ++channel) {
        if (common_light_[channel] > 0.0F) {
            rest[channel] = light[channel] / common_light_[channel];
        }
    }
    return rest;
}

void RasterLight::begin(const FramePlan& plan) {
    parts_.lens = relief::PixelLens(plan.projector);
    parts_.changes_codes = false;
    parts_.faces.clear();
    parts_.feathers.clear();
    parts_.faces.reserve(plan.faces.capacity());
    parts_.feathers.reserve(plan.feathers.capacity());
    bool any_relief = false;
    common_light_ = glm::vec3(1.0F);
    for (const Draw& draw : plan.draws) {
        if (draw.shader.pass == ShaderKey::Pass::Raster) {
            common_light_ = any_relief ? glm::max(common_light_, draw.light) : draw.light;
            any_relief = true;
        }
    }
    for (const Draw& draw : plan.draws) {
        if (draw.shader.pass != ShaderKey::Pass::Raster) {
            continue;
        }
        const ReliefDraw& planned = plan.relief_draws[draw.relief_draw];
        parts_.changes_codes = parts_.changes_codes || planned.even_light || draw.brightness != 1.0F ||
                               common_light_ != glm::vec3(1.0F);
        for (const relief::RasterFace& seen : planned.view.faces) {
            if (seen.face == plan.faces[static_cast<std::size_t>(draw.face)].face) {
                add_face(plan, draw, seen);
            }
        }
    }
    add_feathers(plan);
}

void RasterLight::add_face(const FramePlan& plan, const Draw& draw, const relief::RasterFace& seen) {
    const auto known = std::find_if(parts_.faces.begin(), parts_.faces.end(),
                                    [&](const Face& face) { return face.face == draw.face; });
    if (known != parts_.faces.end()) { // of another relief
        known->lit = united(known->lit, seen.lit);
        return;
    }
    Face& added = parts_.faces.emplace_back();
    added.face = draw.face;
    added.lit = seen.lit;
    added.edges = relief::first_edges(seen);
    for (const glm::dvec3& edge : relief::more_edges(seen)) {
        added.more_edges.push_back(glm::vec3(edge));
    }
    added.gain = gain_of(plan.faces[static_cast<std::size_t>(draw.face)], plan.projector,
                         plan.relief_draws[draw.relief_draw].even_light, draw.brightness, common_light_);
}

void RasterLight::add_feathers(const FramePlan& plan) {
    const auto pixel = [&](const glm::vec4& clip) {
        return (0.5 * glm::dvec2(clip) + 0.5) * glm::dvec2(plan.projector.width, plan.projector.height);
    };
    for (const EdgeFeather& feather : plan.feathers) {
        const auto& [a, b, c, d] = feather.corners_clip;
        const std::array<glm::dvec4, 4> corners{a, b, c, d};
        const glm::dvec2 start = pixel(a);
        parts_.feathers.push_back({.face = feather.face,
                                   .lit = pixels_around(corners, plan.projector),
                                   .along = linear_between(start, pixel(b)),
                                   .inward = linear_between(start, pixel(d)),
                                   .share = feather.share});
    }
}

void RasterLight::light(int y, int first, std::span<glm::u8vec4> codes) const {
    relief::run_with<light_row>(instructions_, parts_, y, first, codes);
}

} // namespace frustumscreen::scene
