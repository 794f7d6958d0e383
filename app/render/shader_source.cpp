#include "app/render/shader_source.h"

#include "app/render/block_shader.h"
#include "app/render/torch_shader.h"
#include "app/scene/frame_plan.h"
#include "app/scene/lit_tiles.h"

#include <fmt/format.h>

namespace frustumscreen::render {

namespace {

// The projector's lens; for both stages of shaders that bend.
constexpr std::string_view lens = R"(
#define BENT
uniform vec4 lens_from_clip; // scale, offset: clip coordinates to a direction's (x / z, y / z)
uniform vec3 distortion;     // k1, k2, the r^2 up to which they hold
)";

/// Bending keeps depth and w.
constexpr std::string_view bent_vertex = R"(
invariant gl_Position; // a torch draws the same surface again
#ifdef BENT
vec4 bent(vec4 clip) {
    if (clip.w <= 0.0) {
        return clip;
    }
    vec2 x = clip.xy / clip.w * lens_from_clip.xy + lens_from_clip.zw;
    float r2 = min(dot(x, x), distortion.z);
    clip.xy += clip.w * r2 * (distortion.x + distortion.y * r2) * x / lens_from_clip.xy;
    return clip;
}
#else
vec4 bent(vec4 clip) { return clip; }
#endif
)";

/// A quadrilateral: a fan of four corners; or, if bent, strips of cells, one strip per instance.
constexpr std::string_view quad_vertex = R"(
uniform vec4 corners[4]; // top left, top right, bottom right, bottom left
#ifdef BENT
vec2 place_in_quad() { return vec2(gl_VertexID >> 1, gl_InstanceID + (gl_VertexID & 1)) / float(QUAD_CELLS); }
vec4 corner(vec2 at) {
    return bent(mix(mix(corners[0], corners[1], at.x), mix(corners[3], corners[2], at.x), at.y));
}
#else
vec2 place_in_quad() {
    return vec2(gl_VertexID == 1 || gl_VertexID == 2 ? 1.0 : 0.0, gl_VertexID >= 2 ? 1.0 : 0.0);
}
vec4 corner(vec2 at) { return corners[gl_VertexID]; }
#endif
)";

constexpr std::string_view outline_vertex = R"(
void main() { gl_Position = corner(place_in_quad()); }
)";
constexpr std::string_view outline_fragment = R"(
void main() {}
)";

constexpr std::string_view surface_vertex = R"(
layout(location = 0) in vec3 position; // 0..1 over the artifact's box
uniform mat4 clip_from_unit;
#if defined(PLACES) || defined(TORCH)
uniform mat4 prop_from_unit; // of a torch: into its frame
out vec3 point;
#endif
#if !defined(PLACES) || defined(CUT_OUT)
layout(location = 1) in vec2 uv;
out vec2 texel;
#endif
void main() {
    gl_Position = bent(clip_from_unit * vec4(position, 1.0));
#if defined(PLACES) || defined(TORCH)
    point = vec3(prop_from_unit * vec4(position, 1.0));
#endif
#if !defined(PLACES) || defined(CUT_OUT)
    texel = uv;
#endif
}
)";

// For surfaces that fade.
constexpr std::string_view dither = R"(
#ifdef DITHERED
uniform vec4 pixel_from_fragment; // scale, offset
uniform vec2 dither; // share of the pixels; 1 = those of the share are drawn, 0 = the others
// Bayer's matrix of 8 x 8: 64 thresholds, each once in every 8 x 8 pixels.
bool is_other_draws() {
    ivec2 p = ivec2(gl_FragCoord.xy * pixel_from_fragment.xy + pixel_from_fragment.zw);
    int q = p.x ^ p.y;
    int rank = (q & 1) << 5 | (p.y & 1) << 4 | (q & 2) << 2 | (p.y & 2) << 1 | (q & 4) >> 1 | (p.y & 4) >> 2;
    return ((float(rank) + 0.5) / 64.0 < dither.x) != (dither.y > 0.5);
}
#else
bool is_other_draws() { return false; }
#endif
)";

/// From the direction of a fragment to that of the ideal lens.
constexpr std::string_view unbent_fragment = R"(
#ifdef BENT
// Each step comes some ten times nearer, and neither light nor depth of a place changes much over a pixel.
vec2 unbent(vec2 real) {
    vec2 x = real;
    for (int k = 0; k < 4; ++k) {
        float r2 = min(dot(x, x), distortion.z);
        x = real / (1.0 + r2 * (distortion.x + distortion.y * r2));
    }
    return x;
}
#else
vec2 unbent(vec2 real) { return real; }
#endif
)";

constexpr std::string_view surface_fragment = R"(
out vec4 result;
#if !defined(PLACES) || defined(CUT_OUT)
uniform sampler2D image;
in vec2 texel;
#endif
#ifdef PLACES
in vec3 point;
#else
uniform vec2 brightness; // the factor in linear light; to the power of 1 / 2.4
#ifdef COLOURED
uniform vec3 light[2];   // as brightness, for each channel
#endif
#ifdef EVEN_LIGHT
uniform vec4 ray_from_fragment; // scale, offset; z = 1
uniform vec3 inverse_depth;     // of the face's plane, along a ray
uniform vec4 face_gain;         // times d^3, most; both to the power of 1 / 2.4
#ifdef BENT
// The lens packs pixels more densely by its area factor.
vec2 share_of_pixel(vec2 x) {
    float r2 = min(dot(x, x), distortion.z);
    float area = (1.0 + r2 * (distortion.x + distortion.y * r2)) * (1.0 + r2 * (3.0 * distortion.x + 5.0 * distortion.y * r2));
    return vec2(1.0 / area, pow(area, -1.0 / 2.4));
}
#endif
// As `brightness`. 3 / 2.4 is 1 + 1 / 4: a power of the distance takes roots alone.
vec2 compensation() {
    vec3 ray = vec3(unbent(gl_FragCoord.xy * ray_from_fragment.xy + ray_from_fragment.zw), 1.0);
    float d = sqrt(dot(ray, ray)) / dot(inverse_depth, ray);
    vec2 gain = face_gain.xz * d * vec2(d * d, sqrt(sqrt(d)));
#ifdef BENT
    gain *= share_of_pixel(ray.xy);
#endif
    return min(face_gain.yw, gain);
}
#endif
#endif
void main() {
    if (is_other_draws() || is_beside_cover()) {
        discard;
    }
#if !defined(PLACES) || defined(CUT_OUT)
    vec4 seen = texture(image, texel);
#endif
#ifdef CUT_OUT
    if (seen.a < 0.5) {
        discard;
    }
#endif
#ifdef PLACES
    result = vec4(point, 1.0);
#else
    vec3 code = seen.rgb;
    vec2 gain = brightness;
#ifdef EVEN_LIGHT
    gain *= compensation();
#endif
    // The code of `gain` times the light of a code. sRGB is straight near black and a power law above: up to a gain of 1 the larger of both
    // is right, above 1 the smaller. Where one of the two codes lies on the straight piece and the other does not, the result is up to two
    // codes off; at a gain of 8, where codes lie 8 apart, up to four.
#ifdef COLOURED
    vec3 factor = gain.x * light[0];
    vec3 straight = factor * code;
    vec3 power = (code + 0.055) * (gain.y * light[1]) - 0.055;
    result = vec4(mix(max(straight, power), min(straight, power), greaterThan(factor, vec3(1.0))), 1.0);
#else
    vec3 straight = gain.x * code;
    vec3 power = (code + 0.055) * gain.y - 0.055;
    result = vec4(gain.x > 1.0 ? min(straight, power) : max(straight, power), 1.0);
#endif
#endif
}
)";

// The quadrilateral's corners: the edge's ends, then the inner corners.
constexpr std::string_view feather_vertex = R"(
out vec2 at;
void main() {
    at = place_in_quad();
    gl_Position = corner(at);
}
)";
// Codes are multiplied, so the factor is raised to sRGB's power. The share is no linear function of the place: between a
// triangle's corners it would be off where it differs from one end of the edge to the other.
constexpr std::string_view feather_fragment = R"(
in vec2 at;
uniform vec2 edge_share; // factor of linear light at the ends
out vec4 result;
void main() {
    float share = mix(mix(edge_share.x, edge_share.y, at.x), 1.0, at.y);
    result = vec4(vec3(pow(max(share, 0.0), 1.0 / 2.4)), 1.0);
}
)";

// A picture of light: colours, or coverage as white.
constexpr std::string_view picture_vertex = R"(
out vec2 at;
void main() {
    at = place_in_quad();
    gl_Position = corner(at);
}
)";
constexpr std::string_view picture_fragment = R"(
in vec2 at;
uniform sampler2D image;
uniform float brightness;
out vec4 result;
void main() { result = vec4(brightness * texture(image, at).rgb, 1.0); }
)";

/// Rectangles of the picture's pixels, six corners each, at the far plane.
constexpr std::string_view tiles_vertex = R"(
uniform vec4 rectangles[MAX_RECTANGLES]; // x, y, width, height
uniform vec2 picture;                    // size in pixels
void main() {
    int corner = gl_VertexID % 6;
    vec4 r = rectangles[gl_VertexID / 6];
    vec2 pixel = r.xy + r.zw * vec2(corner == 1 || corner == 2 || corner == 4, corner == 2 || corner == 4 || corner == 5);
    gl_Position = vec4(2.0 * pixel / picture - 1.0, 1.0, 1.0);
}
)";
// Pixels of a rasterized relief, at their positions.
constexpr std::string_view rasterize_fragment = R"(
uniform sampler2D image;
out vec4 result;
void main() {
    result = texelFetch(image, ivec2(gl_FragCoord.xy), 0);
    if (result.a < 0.5) {
        discard;
    }
}
)";
// The same pixels among polygons. A pixel draws as many fragments as it has samples with a hit.
constexpr std::string_view rasterize_in_depth_fragment = R"(
uniform sampler2D image;          // mean of the hits; alpha is their share of the samples
uniform highp sampler2D nearness;
uniform ivec4 raster;             // fragments along a pixel's sides, the texel of the framebuffer's corner
uniform vec4 ray_from_fragment;   // scale, offset; z = 1
uniform vec4 depth_from_nearness; // of the face: times ray and nearness, and added
out vec4 result;
void main() {
    ivec2 fragment = ivec2(gl_FragCoord.xy);
    ivec2 texel = fragment / raster.xy + raster.zw;
    ivec2 in_pixel = fragment % raster.xy;
    vec4 seen = texelFetch(image, texel, 0);
    if (float(in_pixel.y * raster.x + in_pixel.x) + 0.5 > seen.a * float(raster.x * raster.y)) {
        discard;
    }
    vec3 ray = vec3(unbent(gl_FragCoord.xy * ray_from_fragment.xy + ray_from_fragment.zw), 1.0);
    float depth = dot(depth_from_nearness.xyz, ray) * texelFetch(nearness, texel, 0).r + depth_from_nearness.w;
    gl_FragDepth = 0.5 * depth + 0.5;
    result = vec4(seen.rgb, 1.0);
}
)";
constexpr std::string_view black_fragment = R"(
out vec4 result;
void main() { result = vec4(0.0, 0.0, 0.0, 1.0); }
)";
// A bilinear fetch where texels meet is their average; the sampler decodes sRGB before it. A pixel of more
// than 2 x 2 samples takes one fetch for each 2 x 2, in a separate program: a software GPU spends more on a
// loop of one iteration than on the fetch in it.
constexpr std::string_view average_fragment = R"(
uniform sampler2D image;
uniform ivec4 raster; // samples along a pixel's sides, the pixel at the larger picture's corner
out vec4 result;
void main() {
    vec2 texel = 1.0 / vec2(textureSize(image, 0));
    vec2 middle = (gl_FragCoord.xy - vec2(raster.zw)) * vec2(raster.xy) * texel;
#ifdef MANY
    ivec2 fetches = raster.xy / 2;
    vec2 first = middle - vec2(fetches - 1) * texel;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < fetches.y; ++y) {
        for (int x = 0; x < fetches.x; ++x) {
            sum += texture(image, first + 2.0 * vec2(x, y) * texel);
        }
    }
    result = sum / float(fetches.x * fetches.y);
#else
    result = texture(image, middle);
#endif
}
)";

std::string defines_of(const scene::ShaderKey& key) {
    std::string defines;
    const auto define = [&defines](bool wanted, std::string_view name) {
        defines += wanted ? fmt::format("#define {}\n", name) : "";
    };
    define(key.places, "PLACES");
    define(key.cut_out, "CUT_OUT");
    define(key.dithered, "DITHERED");
    define(key.even_light, "EVEN_LIGHT");
    define(key.blocks, "BLOCKS");
    define(key.coloured, "COLOURED");
    define(key.torch, "TORCH");
    defines += key.torch ? fmt::format("#define CONTENT_PARTS {}\n#define SHADOW_PX {}.0\n",
                                       static_cast<int>(key.content), scene::torch_picture_px)
                         : "";
    define(key.pass == scene::ShaderKey::Pass::RasterInDepth, "IN_DEPTH");
    return defines;
}

std::string by_nearness(std::string_view main) {
    return fmt::format("{}{}{}{}", unbent_fragment, torch_light, torch_nearness, main);
}

} // namespace

ShaderSource source_of(const scene::ShaderKey& key, bool bends) {
    const std::string defines =
        (bends ? fmt::format("#define QUAD_CELLS {}{}", quad_cells, lens) : std::string()) + defines_of(key);
    const std::string tiles_defines =
        fmt::format("#define MAX_RECTANGLES {}\n{}", scene::LitTiles::max_rectangles, defines_of(key));
    const auto quad = [](std::string_view vertex) {
        return fmt::format("{}{}{}", bent_vertex, quad_vertex, vertex);
    };
    const std::string tiles(tiles_vertex);
    switch (key.pass) {
    case scene::ShaderKey::Pass::Outline:
        return {defines, quad(outline_vertex), std::string(outline_fragment)};
    case scene::ShaderKey::Pass::Surface:
        return {defines,
                key.blocks ? fmt::format("{}{}{}", bent_vertex, block_bits, block_vertex)
                           : fmt::format("{}{}", bent_vertex, surface_vertex),
                key.torch ? fmt::format("{}{}{}{}{}{}", dither, block_bits, block_cover, unbent_fragment,
                                        torch_light, torch_surface)
                          : fmt::format("{}{}{}{}{}", dither, block_bits, block_cover, unbent_fragment,
                                        surface_fragment)};
    case scene::ShaderKey::Pass::Raster:
        if (key.torch) {
            return {defines, quad(outline_vertex), by_nearness(torch_raster)};
        }
        return {tiles_defines, tiles, std::string(rasterize_fragment)};
    case scene::ShaderKey::Pass::RasterInDepth:
        return {fmt::format("{}{}", bends ? lens : "", tiles_defines), tiles,
                key.torch ? by_nearness(torch_raster)
                          : fmt::format("{}{}", unbent_fragment, rasterize_in_depth_fragment)};
    case scene::ShaderKey::Pass::TorchOnSamples:
        return {defines, quad(outline_vertex),
                fmt::format("{}{}{}", unbent_fragment, torch_light, torch_on_samples)};
    case scene::ShaderKey::Pass::TorchOnPixels:
        return {defines, quad(outline_vertex),
                fmt::format("{}{}{}", unbent_fragment, torch_light, torch_on_pixels)};
    case scene::ShaderKey::Pass::FarthestDepths:
        return {tiles_defines, tiles, std::string(farthest_depths)};
    case scene::ShaderKey::Pass::EdgeFeather:
        return {defines, quad(feather_vertex), std::string(feather_fragment)};
    case scene::ShaderKey::Pass::TablePicture:
        return {defines, quad(picture_vertex), std::string(picture_fragment)};
    case scene::ShaderKey::Pass::TileClear:
        return {tiles_defines, tiles, std::string(black_fragment)};
    case scene::ShaderKey::Pass::TileAverage:
        return {tiles_defines, tiles, std::string(average_fragment)};
    case scene::ShaderKey::Pass::TileAverageMany:
        return {tiles_defines + "#define MANY\n", tiles, std::string(average_fragment)};
    }
    return {};
}

} // namespace frustumscreen::render
