/// The vertex stage of a relief that the GPU draws: its blocks' cells as micropolygons (Cook 1987), the same
/// triangles as on the processor.
///
/// An instance is a block, and four vertices are a cell's corners (block_instances.h); everything else is
/// fetched from the textures of block_upload.h. The fragment stage is that of a mesh: a colour is fetched by
/// `texel`, and a cut cell discards fragments outside its cover.
///
/// Threads  values; any.
#pragma once

#include <string_view>

namespace frustumscreen::render {

/// Tests a bit of an 8 x 8 mask; in both stages.
inline constexpr std::string_view block_bits = R"(
bool has(uvec2 bits, ivec2 at) {
    uint half_of_bits = at.y < 4 ? bits.x : bits.y;
    return (at & 7) == at && (half_of_bits >> (at.y % 4 * 8 + at.x) & 1u) != 0u;
}
)";

/// Follows `bent` of shader_source.cpp.
inline constexpr std::string_view block_vertex = R"(
layout(location = 0) in uvec2 block_and_direction; // of an instance
uniform highp usampler2D blocks; // three texels a block
uniform highp usampler2D covers;
uniform sampler2D image;         // 9 x 9 texels a block, of its corners: colour, and the residual's code
uniform mat4 clip_from_grid[6];
uniform uint mirrored;           // bits: directions whose grid is left-handed
#if defined(PLACES) || defined(TORCH)
uniform mat4 prop_from_grid[6];  // metres; of a torch: into its frame
out vec3 point;
#endif
#ifndef PLACES
out vec2 texel;
#endif
flat out uvec2 cover; // of the cell
out vec2 in_cell;     // 0..1 in it

// Where a cell has no neighbour in its block it is drawn wider by this, so that blocks whose residuals have other steps leave no gap.
const float seam = 0.04; // cells

int count(uvec2 bits) {
    bits -= bits >> 1 & 0x55555555u;
    bits = (bits & 0x33333333u) + (bits >> 2 & 0x33333333u);
    bits = (bits + (bits >> 4) & 0x0F0F0F0Fu) * 0x01010101u >> 24;
    return int(bits.x + bits.y);
}

float code(ivec2 corner) { return 255.0 * texelFetch(image, corner, 0).a; }

void main() {
    int columns = textureSize(blocks, 0).x / 3;
    int number = int(block_and_direction.x);
    ivec2 block = ivec2(number % columns, number / columns);
    uvec4 plane = texelFetch(blocks, ivec2(3 * block.x, block.y), 0);        // u0, v0, w0, w_u
    uvec4 residual = texelFetch(blocks, ivec2(3 * block.x + 1, block.y), 0); // w_v, low, step; the first cover's place
    uvec4 cells = texelFetch(blocks, ivec2(3 * block.x + 2, block.y), 0);    // those that are there, those that are cut
    uint cell = uint(gl_VertexID) >> 2;
    ivec2 first = ivec2(cell & 7u, cell >> 3);
    if (!has(cells.xy, first)) {
        gl_Position = vec4(0.0, 0.0, 2.0, 1.0); // all of the cell's corners: behind the far plane
        return;
    }
    cover = uvec2(~0u);
    if (has(cells.zw, first)) {
        uvec2 before = cell < 32u ? uvec2((1u << cell) - 1u, 0u) : uvec2(~0u, (1u << (cell - 32u)) - 1u);
        int place = int(residual.w) + count(cells.zw & before);
        int wide = textureSize(covers, 0).x;
        cover = texelFetch(covers, ivec2(place % wide, place / wide), 0).xy;
    }
    ivec2 corner = ivec2(gl_VertexID & 1, gl_VertexID >> 1 & 1);
    if ((mirrored >> block_and_direction.y & 1u) != 0u) {
        corner = corner.yx;
    }
    ivec2 side = 2 * corner - 1;
    bvec2 joined = bvec2(has(cells.xy, first + ivec2(side.x, 0)), has(cells.xy, first + ivec2(0, side.y)));
    in_cell = vec2(corner) + seam * vec2(side) * vec2(not(joined));
    ivec2 tile = 9 * block;
    ivec2 at = tile + first;
    float height = mix(mix(code(at), code(at + ivec2(1, 0)), in_cell.x),
                       mix(code(at + ivec2(0, 1)), code(at + 1), in_cell.x), in_cell.y);
    vec2 uv = vec2(first) + in_cell;
    vec2 slope = vec2(uintBitsToFloat(plane.w), uintBitsToFloat(residual.x));
    float w = uintBitsToFloat(plane.z) + dot(slope, uv) + uintBitsToFloat(residual.y) + uintBitsToFloat(residual.z) * height;
    vec4 place = vec4(uintBitsToFloat(plane.xy) + uv, w, 1.0);
    gl_Position = bent(clip_from_grid[block_and_direction.y] * place);
#if defined(PLACES) || defined(TORCH)
    point = (prop_from_grid[block_and_direction.y] * place).xyz;
#endif
#ifndef PLACES
    texel = (vec2(tile + first + corner) + 0.5) / vec2(textureSize(image, 0));
#endif
}
)";

/// For the fragment stage, before its `main`.
inline constexpr std::string_view block_cover = R"(
#ifdef BLOCKS
flat in uvec2 cover;
in vec2 in_cell;
bool is_beside_cover() { return !has(cover, clamp(ivec2(8.0 * in_cell), 0, 7)); }
#else
bool is_beside_cover() { return false; }
#endif
)";

} // namespace frustumscreen::render
