/// GLSL of a torch's light on a surface: the beam, its attenuation and shadow, and the stages of its content.
///
/// Exact for each fragment. A fragment that the torch does not light is discarded, so that blending leaves it as it is.
///
/// Shadow   a place is lit if it is not behind the farthest of the four depths around it in the torch's own picture. On a
///          plane the nearness is linear between texels, so the place itself is never behind all four; a shadow's edge is
///          right within one pixel of that picture.
/// Colour   linear light, for a framebuffer that encodes. Light: added to the surface times its own colour; over: mixed by
///          alpha.
/// Threads  values; any.
/// Source   Francken 2007, 2; percentage-closer filtering's footprint (Reeves 1987), with a maximum in place of a mean.
#pragma once

#include <string_view>

namespace frustumscreen::render {

/// Follows `unbent` of shader_source.cpp. `p`: the place in the torch's frame, metres.
inline constexpr std::string_view torch_light = R"(
#define MAX_STAGES 3
uniform vec4 beam;               // x / z and y / z times xy: -1..1; reach; 1: round
uniform vec4 fall;               // kind of attenuation; way up to which it is full; 1 / (dark - full); brightness
uniform highp vec3 depth_of_inverse_z; // factor, offset; nearer by this share of z: does not shade itself. 0: no shadows
uniform ivec2 content_kind;      // number of stages; 1: over
uniform ivec2 stage_kind[MAX_STAGES];  // source, mix
uniform vec4 stage_colour[MAX_STAGES]; // opacity in a
uniform vec3 stage_size[MAX_STAGES];   // size, width, magnification
uniform mat3x2 stage_from_content[MAX_STAGES];
uniform float height_per_width;
uniform vec4 ray_from_fragment; // scale, offset; z = 1
uniform vec3 inverse_depth;     // of the face's plane, along a ray
uniform vec2 face_gain;         // times d^3, most
uniform vec3 brightness;        // of the surface's own colours
uniform highp sampler2D shadow;
uniform sampler2D content;
uniform sampler2D seen_by_torch;
out vec4 result;

vec3 decoded(vec3 code) {
    return mix(code / 12.92, pow((code + 0.055) / 1.055, vec3(2.4)), step(0.04045, code));
}

float intensity_at(float way) {
    int kind = int(fall.x);
    if (kind == 3 || way <= fall.y) {
        return 1.0;
    }
    float share = clamp((way - fall.y) * fall.z, 0.0, 1.0);
    return kind == 0 ? fall.y * fall.y / (way * way) : kind == 1 ? 1.0 - share : 1.0 - share * share * (3.0 - 2.0 * share);
}

bool is_shaded(vec2 place, float z) {
    if (depth_of_inverse_z.z <= 0.0) {
        return false;
    }
    ivec2 size = textureSize(shadow, 0);
    ivec2 low = clamp(ivec2(floor(place * vec2(size) - 0.5)), ivec2(0), size - 2);
    float farthest = max(max(texelFetch(shadow, low, 0).r, texelFetch(shadow, low + ivec2(1, 0), 0).r),
                         max(texelFetch(shadow, low + ivec2(0, 1), 0).r, texelFetch(shadow, low + ivec2(1, 1), 0).r));
    return depth_of_inverse_z.x / (z * (1.0 - depth_of_inverse_z.z)) + depth_of_inverse_z.y > farthest;
}

// The share of a pixel that a line covers: `away` from its middle, `across` its width, `pixel` the pixel's.
float covered(float away, float across, float pixel) {
    return clamp((0.5 * across - away) / pixel + 0.5, 0.0, 1.0) * min(1.0, max(across / pixel, 0.25));
}
float from_line(float at, float every) { return abs(fract(at / every + 0.5) - 0.5) * every; }

vec4 ruler(vec2 at_mm, float pixel_mm) {
    float mark = abs(at_mm.x) + 0.5;
    float count = floor(mark);
    float half_mm = mod(count, 10.0) < 0.5 ? 5.0 : mod(count, 5.0) < 0.5 ? 3.5 : 2.0;
    float across = max(0.2, pixel_mm);
    float marks = at_mm.y <= 0.0 && at_mm.y >= -2.0 * half_mm ? covered(abs(fract(mark) - 0.5), 0.2, pixel_mm) : 0.0;
    return vec4(1.0, 1.0, 1.0, max(marks, covered(abs(at_mm.y), across, pixel_mm)));
}

// `dx`, `dy`: of `place`.
vec4 stage(int k, vec2 place, vec2 dx, vec2 dy, vec3 p, vec3 layer) {
    vec2 at = stage_from_content[k] * vec3(place, 1.0);
    vec2 from_middle = (at - 0.5) * vec2(1.0, height_per_width);
    vec3 size = stage_size[k];
    float pixel = max(length(dx), length(dy));
    vec4 colour = vec4(1.0);
    int source = stage_kind[k].x;
    if (source == 1 || source == 2) {
        colour = textureGrad(content, at - floor(at), dx, dy);
        colour.rgb /= max(colour.a, 1e-3); // stored over black
    } else if (source == 3) {
        colour.rgb = layer;
    } else if (source == 4) {
        colour.a = covered(abs(length(from_middle) - 0.5 * size.x), size.y, pixel);
    } else if (source == 5) {
        vec2 away = vec2(from_line(from_middle.x, size.x), from_line(from_middle.y, size.x));
        colour.a = max(covered(away.x, size.y, pixel), covered(away.y, size.y, pixel));
    } else if (source == 6) {
        colour = ruler(1000.0 * p.xy, 1000.0 * p.z * 2.0 * pixel / beam.x);
    } else if (source == 7) {
        colour.a = clamp((0.5 * size.x - length(from_middle)) / pixel + 0.5, 0.0, 1.0);
        colour.rgb = decoded(textureLod(seen_by_torch, 0.5 + (place - 0.5) / size.z, 0.0).rgb);
    }
    return colour * stage_colour[k];
}

vec4 content_at(vec2 place, vec2 dx, vec2 dy, vec3 p, vec3 layer) {
    vec4 sum = stage(0, place, dx, dy, p, layer);
    for (int k = 1; k < content_kind.x; ++k) {
        vec4 next = stage(k, place, dx, dy, p, layer);
        int how = stage_kind[k].y;
        if (how == 0) {
            float a = next.a + sum.a * (1.0 - next.a);
            sum = vec4(mix(sum.rgb * sum.a, next.rgb, next.a) / max(a, 1e-4), a);
        } else if (how == 1) {
            sum.rgb *= mix(vec3(1.0), next.rgb, next.a);
        } else {
            float a = min(1.0, sum.a + next.a);
            sum = vec4((sum.rgb * sum.a + next.rgb * next.a) / max(a, 1e-4), a);
        }
    }
    return sum;
}

// The factor of the surface's own colours on this face.
vec3 surface_gain() {
    vec3 ray = vec3(unbent(gl_FragCoord.xy * ray_from_fragment.xy + ray_from_fragment.zw), 1.0);
    float d = length(ray) / dot(inverse_depth, ray);
    float gain = face_gain.x * d * d * d;
#ifdef BENT
    float r2 = min(dot(ray.xy, ray.xy), distortion.z);
    gain /= (1.0 + r2 * (distortion.x + distortion.y * r2)) * (1.0 + r2 * (3.0 * distortion.x + 5.0 * distortion.y * r2));
#endif
    return brightness * min(face_gain.y, gain);
}

void light(vec3 p, vec3 layer) {
    vec2 at = p.xy / p.z * beam.xy;
    vec2 place = 0.5 * at + 0.5;
    vec2 dx = dFdx(place);
    vec2 dy = dFdy(place);
    float way = length(p);
    bool in_shape = beam.w > 0.5 ? dot(at, at) <= 1.0 : max(abs(at.x), abs(at.y)) <= 1.0;
    if (p.z <= 0.0 || way > beam.z || !in_shape || is_shaded(place, p.z)) {
        discard;
    }
    vec4 colour = content_at(place, dx, dy, p, layer);
    float share = colour.a * fall.w * intensity_at(way);
    result = content_kind.y == 1 ? vec4(colour.rgb * surface_gain(), share) : vec4(colour.rgb * share, 1.0);
}
)";

/// The fragment stage of a mesh's surface; follows `torch_light`.
inline constexpr std::string_view torch_surface = R"(
in vec3 point; // torch's frame
in vec2 texel;
uniform sampler2D image;
uniform sampler2D layer;
void main() {
    if (is_other_draws() || is_beside_cover()) {
        discard;
    }
#ifdef CUT_OUT
    if (texture(image, texel).a < 0.5) {
        discard;
    }
#endif
    light(point, decoded(texture(layer, texel).rgb));
}
)";

/// That of a relief that was rasterized on the processor, by the nearness of each pixel (relief/nearness_row.h).
inline constexpr std::string_view torch_raster = R"(
uniform sampler2D image; // alpha: the share of the samples with a hit
uniform sampler2D layer; // other colours of the same hits
uniform highp sampler2D nearness;
uniform ivec4 raster;             // fragments along a pixel's sides, the texel of the framebuffer's corner
uniform mat4 torch_from_projector;
uniform vec3 eye;                 // torch's frame
uniform int edge_count;
uniform vec3 edges[15];           // of the face: a ray is inside
#ifdef IN_DEPTH
uniform vec4 depth_from_nearness; // of the face: times ray and nearness, and added
#endif
void main() {
    ivec2 fragment = ivec2(gl_FragCoord.xy);
    ivec2 at = fragment / raster.xy + raster.zw;
    float near = texelFetch(nearness, at, 0).r;
    vec3 ray = vec3(unbent(gl_FragCoord.xy * ray_from_fragment.xy + ray_from_fragment.zw), 1.0);
    bool inside = near > 0.0;
    for (int k = 0; k < edge_count; ++k) {
        inside = inside && dot(edges[k], ray) >= 0.0;
    }
    if (!inside) {
        discard;
    }
#ifdef IN_DEPTH
    ivec2 in_pixel = fragment % raster.xy;
    if (float(in_pixel.y * raster.x + in_pixel.x) + 0.5 > texelFetch(image, at, 0).a * float(raster.x * raster.y)) {
        discard;
    }
    gl_FragDepth = 0.5 * (dot(depth_from_nearness.xyz, ray) * near + depth_from_nearness.w) + 0.5 - 1e-6;
#endif
    vec3 on_face = (torch_from_projector * vec4(ray / dot(inverse_depth, ray), 1.0)).xyz;
    light(eye + (on_face - eye) / near, decoded(texelFetch(layer, at, 0).rgb));
}
)";

} // namespace frustumscreen::render
