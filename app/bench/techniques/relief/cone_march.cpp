#include "app/bench/techniques/relief/cone_map.h"
#include "app/bench/techniques/relief/relief_march.h"
#include "app/bench/techniques/relief/relief_technique.h"

#include <fmt/format.h>

#include <bit>

namespace frustumscreen::bench {

namespace {

/// Layers axis + (0: the ray follows the axis, 3: opposes it) of (low, high, cone on low, cone on high); the
/// cone of the image that faces such a ray is relaxed, the other's empty.
constexpr std::string_view cone_source = R"(
vec4 cones_at(vec2 at, int layer) {
    return vec4(texelFetch(relief, ivec3(ivec2(at * float(texels)), layer), 0)) / box_codes;
}
/// Height above the surface of the image along `axis` that faces the ray.
float gap(vec3 p, int axis, int layer) {
    vec4 surface = cones_at(axis == 0 ? p.yz : axis == 1 ? p.xz : p.xy, layer);
    return layer < 3 ? surface.x - p[axis] : p[axis] - surface.y;
}
bool search(vec3 start, vec3 along, float leave, out float at) {
    bvec3 is_forward = greaterThan(along, vec3(0.0));
    vec3 forward = vec3(is_forward);
    ivec3 layer = ivec3(0, 1, 2) + 3 * ivec3(not(is_forward));
    vec3 per_along = 1.0 / along;
    vec3 speed = abs(along);
    vec3 across = vec3(length(along.yz), length(along.xz), length(along.xy));
    float fastest = max(max(speed.x, speed.y), speed.z);
    float nudge = 1e-5 / fastest;
    float half_texel = 0.5 / (fastest * float(texels));
    float t = 0.0;
    for (int k = 0; k < 256 && t < leave; ++k) {
        vec3 p = clamp(start + (t + nudge) * along, 0.0, 0.999999);
        vec4 x = cones_at(p.yz, layer.x);
        vec4 y = cones_at(p.xz, layer.y);
        vec4 z = cones_at(p.xy, layer.z);
        vec3 above_low = vec3(x.x, y.x, z.x) - p;
        vec3 above_high = p - vec3(x.y, y.y, z.y);
        vec3 facing = mix(above_high, above_low, is_forward);
        vec3 averted = mix(above_low, above_high, is_forward);
        if (max(max(max(facing.x, facing.y), facing.z), max(max(averted.x, averted.y), averted.z)) <= 0.0) {
            at = t;
            return true;
        }
        vec3 cone_low = vec3(x.z, y.z, z.z);
        vec3 cone_high = vec3(x.w, y.w, z.w);
        vec3 relaxed = mix(cone_high, cone_low, is_forward);
        vec3 empty = mix(cone_low, cone_high, is_forward);
        vec3 border = ((floor(p * float(texels)) + forward) / float(texels) - start) * per_along - t;
        vec3 texel = min(border.yxx, border.zzy);
        vec3 by_relaxed = max(facing, 0.0) * relaxed / (across + relaxed * speed);
        vec3 opening = across - empty * speed;
        vec3 by_empty = max(averted, 0.0) * empty / max(opening, 1e-6);
        vec3 by_texel = mix(vec3(0.0), min(texel, facing / speed), greaterThan(facing, vec3(0.0)));
        by_texel = mix(by_texel, texel, greaterThan(averted, vec3(0.0)));
        vec3 free = max(by_empty, by_texel);
        float surely = max(max(free.x, free.y), free.z);
        float stride = max(max(by_relaxed.x, by_relaxed.y), by_relaxed.z);
        float before = t;
        t += max(surely, stride) + nudge;
        if (stride > surely) {
            int axis = by_relaxed.x == stride ? 0 : by_relaxed.y == stride ? 1 : 2;
            int facing_layer = axis == 0 ? layer.x : axis == 1 ? layer.y : layer.z;
            if (gap(start + t * along, axis, facing_layer) < 0.0) {
                while (t - before > half_texel) {
                    float middle = 0.5 * (before + t);
                    if (gap(start + middle * along, axis, facing_layer) < 0.0) {
                        t = middle;
                    } else {
                        before = middle;
                    }
                }
            }
        }
    }
    return false;
}
)";

struct Cones { ///< on an axis's low and high surface
    image::Image16 low;
    image::Image16 high;
};

/// The cones of the images along `axis`; 0 on a side without an image.
Cones cones_of(const ReliefImages& images, int axis, image::Image16 (*make)(const image::Image16&)) {
    Cones cones{{images.texels, images.texels}, {images.texels, images.texels}};
    for (const ReliefImage& image : images.images) {
        if (image.axis == axis) {
            (image.high ? cones.high : cones.low) = make(image.depth);
        }
    }
    return cones;
}

} // namespace

Result<std::unique_ptr<Technique>> make_cone_march(const Kiosk& kiosk, const ReliefImages& images) {
    if (!std::has_single_bit(static_cast<unsigned>(images.texels))) {
        return bad_input("bench.cone_texels", "cone maps need a power of two of texels, not {}",
                         images.texels);
    }
    gl::GlTexture relief = make_relief_array(GL_RGBA16UI, images.texels, 1, 6);
    for (int axis = 0; axis < 3; ++axis) {
        const image::Image<glm::u16vec2> material = material_along(images, axis);
        const Cones relaxed = cones_of(images, axis, relaxed_cones);
        const Cones empty = cones_of(images, axis, empty_cones);
        image::Image<glm::u16vec4> forward(images.texels, images.texels);
        image::Image<glm::u16vec4> backward(images.texels, images.texels);
        for (std::size_t k = 0; k < material.texels.size(); ++k) {
            forward.texels[k] = {material.texels[k], relaxed.low.texels[k], empty.high.texels[k]};
            backward.texels[k] = {material.texels[k], empty.low.texels[k], relaxed.high.texels[k]};
        }
        glBindTexture(GL_TEXTURE_2D_ARRAY, relief.get());
        set_layer(0, axis, forward);
        set_layer(0, axis + 3, backward);
    }
    return make_relief_technique(kiosk, images,
                                 {.name = fmt::format("relaxed cone {}", images.texels),
                                  .defines = "",
                                  .source = cone_source,
                                  .relief = std::move(relief)});
}

} // namespace frustumscreen::bench
