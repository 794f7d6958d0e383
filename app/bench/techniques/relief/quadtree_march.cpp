#include "app/bench/techniques/relief/max_mipmap.h"
#include "app/bench/techniques/relief/relief_march.h"
#include "app/bench/techniques/relief/relief_technique.h"

#include <fmt/format.h>

#include <bit>

namespace frustumscreen::bench {

namespace {

/// At (t, level) each axis has one cell: its texel's square, which the ray leaves at `exit`, and the bounds
/// of its material, inside which the ray is from `enter` to `over`. Material must lie within all three.
constexpr std::string_view quadtree_source = R"(
bool search(vec3 start, vec3 along, float leave, out float at) {
    vec3 per_along = 1.0 / along;
    vec3 forward = vec3(greaterThan(along, vec3(0.0)));
    bvec3 is_forward = greaterThan(along, vec3(0.0));
    vec3 per_code = per_along / box_codes;
    vec3 to_start = start * per_along;
    float nudge = 1e-5 / max(max(abs(along.x), abs(along.y)), abs(along.z));
    float t = 0.0;
    int level = COARSEST;
    for (int k = 0; k < 512 && t < leave; ++k) {
        float cells = float(texels >> level);
        vec3 cell = clamp(floor((start + (t + nudge) * along) * cells), 0.0, cells - 1.0);
        vec3 border = (cell + forward) / cells * per_along - to_start;
        vec3 exit = vec3(min(border.y, border.z), min(border.x, border.z), min(border.x, border.y));
        ivec3 c = ivec3(cell);
        vec2 x = vec2(texelFetch(relief, ivec3(c.yz, 0), level).xy);
        vec2 y = vec2(texelFetch(relief, ivec3(c.xz, 1), level).xy);
        vec2 z = vec2(texelFetch(relief, ivec3(c.xy, 2), level).xy);
        vec3 to_low = vec3(x.x, y.x, z.x) * per_code - to_start;
        vec3 to_high = vec3(x.y, y.y, z.y) * per_code - to_start;
        vec3 enter = max(mix(to_high, to_low, is_forward), t);
        vec3 over = min(mix(to_low, to_high, is_forward), exit);
        vec3 none = vec3(greaterThan(enter, over));
        vec3 next = mix(enter, exit, none);
        t = max(max(next.x, next.y), max(next.z, t));
        if (none.x + none.y + none.z > 0.0) {
            t += nudge;
            level = min(level + 1, COARSEST);
        } else if (t <= min(min(over.x, over.y), over.z)) {
            if (level == 0) {
                at = t;
                return t < leave;
            }
            --level;
        }
    }
    return false;
}
)";

/// Cells per side of the level at which rays start; coarser levels have hardly any empty cell.
constexpr int coarsest_cells = 16;

} // namespace

Result<std::unique_ptr<Technique>> make_quadtree_march(const Kiosk& kiosk, const ReliefImages& images) {
    const auto texels = static_cast<unsigned>(images.texels);
    if (!std::has_single_bit(texels) || images.texels < coarsest_cells) {
        return bad_input("bench.mipmap_texels",
                         "maximum mipmaps need a power of two of texels, at least {}, not {}", coarsest_cells,
                         images.texels);
    }
    const int coarsest = static_cast<int>(std::bit_width(texels / coarsest_cells)) - 1;
    gl::GlTexture relief = make_relief_array(GL_RG16UI, images.texels, coarsest + 1, 3);
    for (int axis = 0; axis < 3; ++axis) {
        const MaxMipmap levels = max_mipmap(material_along(images, axis));
        for (int level = 0; level <= coarsest; ++level) {
            set_layer(level, axis, levels[static_cast<std::size_t>(level)]);
        }
    }
    return make_relief_technique(kiosk, images,
                                 {.name = fmt::format("quadtree {}", images.texels),
                                  .defines = fmt::format("#define COARSEST {}\n", coarsest),
                                  .source = quadtree_source,
                                  .relief = std::move(relief)});
}

} // namespace frustumscreen::bench
