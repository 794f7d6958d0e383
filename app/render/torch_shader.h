/// GLSL of a torch's light on a surface: the beam, its attenuation and shadow, and the stages of its content.
///
/// Exact for each fragment. A fragment that the torch does not light is discarded, so that blending leaves it as it is.
///
/// Shadow   a place is lit if it is not behind the farthest of the three nearest depths around it in the torch's own picture, which
///          the shadow map has found once for all of its pixels (torch::ShadowMap::Farthest); of what the GPU has drawn, of the four.
///          On a plane the nearness is linear between texels and the place lies between them, so it is never behind all; a shadow's
///          edge is right within one pixel of that picture.
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
uniform vec4 fall;               // of the intensity: this over the squared distance at most; factors of t, t^2, t^3, which it falls by
uniform vec4 falloff_range;      // distance up to which it is full; 1 / (dark - full); brightness; the ruler's mm a metre
uniform highp vec3 inverse_z;    // of a texel of `shadow`: factor, offset; share of z by which nothing shades itself
uniform int content_kind;        // number of stages
uniform ivec2 stage_kind[MAX_STAGES];  // source, mix
uniform vec4 stage_colour[MAX_STAGES]; // opacity in a
uniform vec3 stage_size[MAX_STAGES];   // size, width, magnification
uniform mat3x2 stage_from_content[MAX_STAGES];
uniform float height_per_width;
uniform vec4 ray_from_fragment; // scale, offset; z = 1
uniform vec3 inverse_depth;     // of the face's plane, along a ray
uniform vec4 face_gain;         // times d^3, most
uniform vec3 brightness;        // of the surface's own colours
uniform highp sampler2D shadow;
uniform sampler2D content;
uniform sampler2D seen_by_torch;
out vec4 result;

vec3 decoded(vec3 code) {
    return mix(code / 12.92, pow((code + 0.055) / 1.055, vec3(2.4)), step(0.04045, code));
}

float intensity_at(float squared_distance) {
    float t = clamp((sqrt(squared_distance) - falloff_range.x) * falloff_range.y, 0.0, 1.0);
    return min(1.0, fall.x / squared_distance) * (1.0 - t * (fall.y + t * (fall.z + t * fall.w)));
}

#if CONTENT_PARTS & 64
bool is_shaded(vec2 at, float z) { return false; }
#else
bool is_shaded(vec2 at, float z) {
    vec2 place = at * (0.5 * SHADOW_PX) + (0.5 * SHADOW_PX - 0.5);
    ivec2 low = clamp(ivec2(place), ivec2(0), ivec2(int(SHADOW_PX) - 2));
    vec2 farthest = texelFetch(shadow, low, 0).rg; // of four; without one of them, in the two lowest bits, or 0
    ivec2 away = ivec2(lessThan(place - vec2(low), vec2(0.5)));
    bool is_away = farthest.g > 0.0 && (floatBitsToInt(farthest.g) & 3) == away.x + 2 * away.y;
    return z * ((is_away ? farthest.g : farthest.r) * inverse_z.x + inverse_z.y) * (1.0 - inverse_z.z) > 1.0;
}
#endif

// By which a place that was found by its depth may lie too far away: two steps of 24 bits.
float place_error = 0.0;
float error_of(float distance_from_eye, float depth_left) { return 2.4e-7 * distance_from_eye / (depth_left * depth_left); }

bool is_lit(vec3 p) {
    vec2 at = p.xy / p.z * beam.xy;
    float out_of_shape = beam.w > 0.5 ? dot(at, at) : max(abs(at.x), abs(at.y));
    return p.z > 0.0 && dot(p, p) <= beam.z * beam.z && out_of_shape <= 1.0 && !is_shaded(at, p.z - place_error);
}

#if CONTENT_PARTS & 4
// The share of a pixel that a line covers, which is at least as wide as the pixel: `away` from its middle.
float covered(float away, float across, float pixel) {
    return clamp((0.5 * max(across, pixel) - away) / pixel + 0.5, 0.0, 1.0);
}
float from_line(float at, float every) { return abs(fract(at / every + 0.5) - 0.5) * every; }

// Marks of 1, 5 and 10 mm, of which those closer than four pixels are left out.
float ruler(vec2 at_mm, float pixel_mm) {
    float every = pixel_mm < 0.25 ? 1.0 : pixel_mm < 1.25 ? 5.0 : 10.0;
    float count = floor(abs(at_mm.x) / every + 0.5) * every;
    float length_mm = mod(count, 10.0) < 0.5 ? 10.0 : mod(count, 5.0) < 0.5 ? 7.0 : 4.0;
    float marks = at_mm.y <= 0.0 && at_mm.y >= -length_mm ? covered(from_line(at_mm.x, every), 0.3, pixel_mm) : 0.0;
    return max(marks, covered(abs(at_mm.y), 0.3, pixel_mm));
}

// `width_mm`: of the content at this depth.
float effect(int source, vec2 from_middle, vec3 size, float pixel, float width_mm) {
    if (source == 4) {
        return covered(abs(length(from_middle) - 0.5 * size.x), size.y, pixel);
    }
    if (source == 5) {
        return max(covered(from_line(from_middle.x, size.x), size.y, pixel),
                   covered(from_line(from_middle.y, size.x), size.y, pixel));
    }
    return source == 6 ? ruler(width_mm * from_middle, width_mm * pixel) : 1.0;
}
#endif

// `pixel`: its size in the content, shares of the width.
vec4 stage(int k, vec2 place, float pixel, vec3 p, vec4 layer) {
    vec4 colour = vec4(1.0);
#if CONTENT_PARTS & 15
    int source = stage_kind[k].x;
    vec2 at = stage_from_content[k] * vec3(place, 1.0);
    vec2 from_middle = (at - 0.5) * vec2(1.0, height_per_width);
#endif
#if CONTENT_PARTS & 1
    if (source == 1 || source == 2) {
        colour = textureGrad(content, at - floor(at), vec2(pixel, 0.0), vec2(0.0, pixel / height_per_width));
        colour.rgb /= max(colour.a, 1e-3); // stored over black
    }
#endif
#if CONTENT_PARTS & 2
    if (source == 3) {
        colour = layer;
    }
#endif
#if CONTENT_PARTS & 4
    if (source >= 4 && source <= 6) {
        colour.a = effect(source, from_middle, stage_size[k], pixel, 2.0 * falloff_range.w * p.z / beam.x);
    }
#endif
#if CONTENT_PARTS & 8
    if (source == 7) {
        colour.a = clamp((0.5 * stage_size[k].x - length(from_middle)) / pixel + 0.5, 0.0, 1.0);
        vec2 from_lens = inverse(mat2(stage_from_content[k])) * (at - 0.5); // of the lens's own middle
        colour.rgb = decoded(textureLod(seen_by_torch, place - from_lens * (1.0 - 1.0 / stage_size[k].z), 0.0).rgb);
    }
#endif
    return colour * stage_colour[k];
}

vec4 content_at(vec2 place, float pixel, vec3 p, vec4 layer) {
    vec4 sum = stage(0, place, pixel, p, layer);
#if CONTENT_PARTS & 16
    for (int k = 1; k < content_kind; ++k) {
        vec4 next = stage(k, place, pixel, p, layer);
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
#endif
    return sum;
}

#if CONTENT_PARTS & 32
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
#endif

// `share`: of the pixel that is lit. `pixel_m`: the pixel's size at the place.
void light(vec3 p, vec4 layer, float share, float pixel_m) {
    vec2 place = 0.5 * (p.xy / p.z * beam.xy) + 0.5;
    float pixel = 0.5 * pixel_m * beam.x / p.z;
    if (share <= 0.0) {
        discard;
    }
    vec4 colour = content_at(place, pixel, p, layer);
    share *= colour.a * falloff_range.z * intensity_at(dot(p, p));
#if CONTENT_PARTS & 32
    result = vec4(colour.rgb * surface_gain(), share);
#else
    result = vec4(colour.rgb * share, 1.0);
#endif
}
)";

/// The fragment stage of a mesh's surface; follows `torch_light`.
inline constexpr std::string_view torch_surface = R"(
in vec3 point; // torch's frame
in vec2 texel;
uniform sampler2D image;
#if CONTENT_PARTS & 2
uniform sampler2D layer;
vec4 layer_at_texel() {
    vec4 seen = texture(layer, texel);
    return vec4(decoded(seen.rgb), seen.a);
}
#else
vec4 layer_at_texel() { return vec4(0.0); }
#endif
void main() {
    if (is_other_draws() || is_beside_cover()) {
        discard;
    }
#ifdef CUT_OUT
    if (texture(image, texel).a < 0.5) {
        discard;
    }
#endif
    light(point, layer_at_texel(), is_lit(point) ? 1.0 : 0.0, 0.5 * (length(dFdx(point)) + length(dFdy(point))));
}
)";

/// The fragment stages that find a place by its nearness (relief/nearness_row.h).
inline constexpr std::string_view torch_nearness = R"(
uniform mat4 torch_from_projector;
uniform vec3 eye;                 // torch's frame
uniform vec4 depth_from_nearness; // of the face: times ray and nearness, and added
uniform ivec4 raster;             // fragments along a pixel's sides, the pixel at the corner
vec3 ray_at(vec2 fragment) { return vec3(unbent(fragment * ray_from_fragment.xy + ray_from_fragment.zw), 1.0); }
vec3 place_of(vec3 on_face, float near) { return eye + (on_face - eye) / near; }
vec3 on_face_at(vec3 ray) { return (torch_from_projector * vec4(ray / dot(inverse_depth, ray), 1.0)).xyz; }
// The pixel's size, without its neighbours, which may show another surface.
float pixel_m_at(vec3 on_face, vec3 p) {
    return distance(on_face, torch_from_projector[3].xyz) * ray_from_fragment.x * distance(p, eye) / distance(on_face, eye);
}
)";

/// Light on a relief that was rasterized on the processor.
inline constexpr std::string_view torch_raster = R"(
uniform sampler2D image; // alpha: the share of the samples with a hit
uniform highp sampler2D nearness;
#ifdef IN_DEPTH
uniform int edge_count;
uniform vec3 edges[15];  // of the face: a ray is inside
#endif
#if CONTENT_PARTS & 2
uniform sampler2D layer; // other colours of the same hits
vec4 layer_at(ivec2 at) { return vec4(decoded(texelFetch(layer, at, 0).rgb), 1.0); }
#else
vec4 layer_at(ivec2 at) { return vec4(0.0); }
#endif
void main() {
    ivec2 fragment = ivec2(gl_FragCoord.xy);
    ivec2 at = fragment / raster.xy + raster.zw;
    float near = texelFetch(nearness, at, 0).r;
    vec3 ray = ray_at(gl_FragCoord.xy);
    bool inside = near > 0.0;
#ifdef IN_DEPTH
    for (int k = 0; k < edge_count; ++k) {
        inside = inside && dot(edges[k], ray) >= 0.0;
    }
#endif
    vec3 on_face = on_face_at(ray);
    vec3 p = place_of(on_face, near > 0.0 ? near : 1.0);
#ifdef IN_DEPTH
    ivec2 in_pixel = fragment % raster.xy;
    inside = inside && float(in_pixel.y * raster.x + in_pixel.x) + 0.5 <=
                           texelFetch(image, at, 0).a * float(raster.x * raster.y);
    gl_FragDepth = 0.5 * (dot(depth_from_nearness.xyz, ray) * near + depth_from_nearness.w) + 0.5 - 1e-6;
#endif
    light(p, layer_at(at), inside && is_lit(p) ? 1.0 : 0.0, pixel_m_at(on_face, p));
}
)";

/// Light on samples that were averaged, or on pixels: each sample's place, by its depth, is lit or not.
inline constexpr std::string_view torch_on_samples = R"(
uniform highp sampler2D depths;
uniform mat4 torch_from_projector; // its 3 x 3: from a ray to the place less the eye, times the depth left (scene::TorchFace)
uniform vec3 eye;                  // torch's frame
uniform vec4 depth_from_nearness;  // times (ray.xy, 0, 1): the depth infinitely far away
uniform ivec4 raster;              // samples along a pixel's sides, the pixel at the corner
// In w the depth infinitely far away.
vec4 from_eye(vec2 fragment) {
    vec3 ray = vec3(unbent(fragment * ray_from_fragment.xy + ray_from_fragment.zw), 1.0);
    return vec4(mat3(torch_from_projector) * ray, dot(depth_from_nearness.xy, ray.xy) + depth_from_nearness.w);
}
void main() {
    vec4 middle = from_eye(gl_FragCoord.xy);
    // A sample's own ray: on a steep surface the pixel's would lie before the sample's place, in its shadow.
    vec4 right = (from_eye(gl_FragCoord.xy + vec2(0.5, 0.0)) - middle) * 2.0 / float(raster.x);
    vec4 down = (from_eye(gl_FragCoord.xy + vec2(0.0, 0.5)) - middle) * 2.0 / float(raster.y);
    ivec2 first = (ivec2(gl_FragCoord.xy) - raster.zw) * raster.xy;
    vec2 to_first = 0.5 - 0.5 * vec2(raster.xy);
    vec3 sum = vec3(0.0);
    float lit = 0.0;
    float depth_left = 1.0;
    for (int y = 0; y < raster.y; ++y) {
        for (int x = 0; x < raster.x; ++x) {
            float depth = texelFetch(depths, first + ivec2(x, y), 0).r;
            vec4 to_place = middle + right * (to_first.x + float(x)) + down * (to_first.y + float(y));
            depth_left = 2.0 * depth - 1.0 - to_place.w;
            vec3 p = eye + to_place.xyz / depth_left;
            place_error = error_of(length(middle.xyz), depth_left);
            if (depth < 1.0 && is_lit(p)) {
                sum += p;
                lit += 1.0;
            }
        }
    }
    vec3 p = lit > 0.0 ? sum / lit : vec3(0.0, 0.0, 1.0);
    light(p, vec4(0.0), lit / float(raster.x * raster.y), length(right.xyz) * float(raster.x) / abs(depth_left));
}
)";

/// The light on pixels of one sample each.
inline constexpr std::string_view torch_on_pixels = R"(
uniform highp sampler2D depths;
uniform mat4 torch_from_projector; // as above
uniform vec3 eye;
uniform vec4 depth_from_nearness;
uniform ivec4 raster;
vec4 from_eye(vec2 fragment) { // as above
    vec3 ray = vec3(unbent(fragment * ray_from_fragment.xy + ray_from_fragment.zw), 1.0);
    return vec4(mat3(torch_from_projector) * ray, dot(depth_from_nearness.xy, ray.xy) + depth_from_nearness.w);
}
void main() {
    float depth = texelFetch(depths, ivec2(gl_FragCoord.xy) - raster.zw, 0).r;
    vec4 to_place = from_eye(gl_FragCoord.xy);
    float depth_left = 2.0 * depth - 1.0 - to_place.w;
    vec3 p = eye + to_place.xyz / depth_left;
    place_error = error_of(length(to_place.xyz), depth_left);
    float pixel_m = distance(from_eye(gl_FragCoord.xy + vec2(1.0, 0.0)).xyz, to_place.xyz) / abs(depth_left);
    light(p, vec4(0.0), depth < 1.0 && is_lit(p) ? 1.0 : 0.0, pixel_m);
}
)";

/// The shadow map of depths that the GPU has drawn: of each texel and the next ones to the right and below, the farthest. A texel
/// whose first surface is turned away, by more than the slack before others, is dark from the torch on (torch::ShadowMap).
inline constexpr std::string_view farthest_depths = R"(
uniform highp sampler2D depths;
uniform highp sampler2D backs;
uniform highp vec3 inverse_z; // of a depth: factor, offset; slack
uniform ivec4 raster;         // x = 1: there are backs
float depth_at(ivec2 at) {
    float depth = texelFetch(depths, at, 0).r;
    float back = raster.x == 1 ? texelFetch(backs, at, 0).r : 1.0;
    bool is_back = back * inverse_z.x + inverse_z.y > (1.0 + inverse_z.z) * (depth * inverse_z.x + inverse_z.y);
    return back < 1.0 && is_back ? 0.0 : depth;
}
void main() {
    ivec2 low = clamp(ivec2(gl_FragCoord.xy), ivec2(0), textureSize(depths, 0) - 2);
    gl_FragDepth = max(max(depth_at(low), depth_at(low + ivec2(1, 0))),
                       max(depth_at(low + ivec2(0, 1)), depth_at(low + ivec2(1, 1))));
}
)";

} // namespace frustumscreen::render
