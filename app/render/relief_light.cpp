#include "app/render/relief_light.h"

#include "app/image/image.h"
#include "app/render/place_map.h"
#include "app/render/torch_uniforms.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace frustumscreen::render {

namespace {

using relief::all;
using relief::Floats;
using relief::Ints;

constexpr int torch_px = scene::torch_picture_px;

FRUSTUMSCREEN_INLINE Floats root_of(Floats values) {
    Floats roots;
    for (int lane = 0; lane < relief::lanes; ++lane) {
        roots[lane] = std::sqrt(values[lane]);
    }
    return roots;
}

/// The uniforms of torch_shader.h.
struct Uniforms {
    PlaceMap map;
    std::array<Plane, geometry::max_face_corners> edges{}; ///< of the face; the first `edge_count`
    std::size_t edge_count = 0;
    bool round, over;
    float max_square; ///< of the distance from the torch
    glm::vec4 fall;
    glm::vec2 falloff_range; ///< distance up to which light is full; 1 / (dark - full)
    float opacity;
    glm::vec3 colour;
    float per_cubic_metre, most; ///< FaceLight
    float k1, k2, max_r2;        ///< the lens
    glm::vec2 ray_per_pixel, middle;
    glm::vec2 inverse_z;
    float nearer; ///< 1 - slack

    explicit Uniforms(const PlainLight& plain) : map(plain.plan, plain.face) {
        const scene::FramePlan& plan = plain.plan;
        const scene::TorchLight& light = plan.torches[plain.face.torch];
        const scene::Draw& draw = plan.draws[plain.face.draw];
        const torch::Beam& beam = light.torch.beam;
        const torch::Stage& stage = light.torch.stages.front();
        set_edges(plan, draw);
        round = beam.shape == torch::Shape::Round;
        over = light.torch.blend == torch::Blend::Over;
        max_square = light.reach_m * light.reach_m;
        fall = fall_of(beam);
        falloff_range = glm::vec2(beam.full_m, 1.0 / (beam.dark_m - beam.full_m));
        opacity = light.torch.stages_at.front().opacity * light.torch.brightness;
        colour = stage.colour;
        const scene::FaceLight& gain = plan.faces[static_cast<std::size_t>(draw.face)].light;
        const bool even = gain.per_cubic_metre > 0.0F;
        per_cubic_metre = even ? gain.per_cubic_metre : 1e30F;
        most = even ? gain.most : 1.0F;
        if (over) {
            colour *= draw.brightness * draw.light;
        }
        const geometry::Pinhole& pinhole = plan.projector;
        k1 = static_cast<float>(pinhole.lens.k1);
        k2 = static_cast<float>(pinhole.lens.k2);
        max_r2 = static_cast<float>(pinhole.bends_to_r2());
        ray_per_pixel = glm::vec2(1.0 / pinhole.fx, 1.0 / pinhole.fy);
        middle = glm::vec2(pinhole.cx, pinhole.cy);
        inverse_z = light.inverse_z_of_nearness;
        nearer = static_cast<float>(1.0 - slack_of(light));
    }

private:
    /// Each relief on the face has the same edges.
    void set_edges(const scene::FramePlan& plan, const scene::Draw& draw) {
        const int face = plan.faces[static_cast<std::size_t>(draw.face)].face;
        for (std::size_t relief = 0; relief < plan.relief_draw_count && edge_count == 0; ++relief) {
            for (const relief::RasterFace& seen : plan.relief_draws[relief].view.faces) {
                for (std::size_t k = 0; seen.face == face && k < seen.edges.size(); ++k) {
                    const glm::vec3 edge(seen.edges[k]);
                    edges.at(edge_count++) = {edge.x, edge.y, edge.z};
                }
            }
        }
    }
};

FRUSTUMSCREEN_INLINE Ints in_beam(const Uniforms& uniforms, const PlaceLanes& at, Floats square) {
    Ints in = (at.z > 0.0F) & (square <= uniforms.max_square);
    const Floats out = uniforms.round ? at.s * at.s + at.t * at.t : relief::most(at.s * at.s, at.t * at.t);
    in &= out <= 1.0F;
    for (std::size_t k = 0; k < uniforms.edge_count; ++k) {
        in &= uniforms.edges[k].at(at.ideal) >= 0.0F;
    }
    return in;
}

FRUSTUMSCREEN_INLINE Floats intensity_at(const Uniforms& uniforms, Floats squared_distance) {
    const Floats beyond = (root_of(squared_distance) - uniforms.falloff_range.x) * uniforms.falloff_range.y;
    const Floats t = relief::least(relief::most(beyond, Floats{}), all(1.0F));
    const glm::vec4& fall = uniforms.fall;
    return relief::least(all(1.0F), fall.x / squared_distance) *
           (1.0F - t * (fall.y + t * (fall.z + t * fall.w)));
}

/// The factor of the surface's own colours.
FRUSTUMSCREEN_INLINE Floats gain_at(const Uniforms& uniforms, const PlaceLanes& at) {
    const Floats x = (at.ideal.x - uniforms.middle.x) * uniforms.ray_per_pixel.x;
    const Floats y = (at.ideal.y - uniforms.middle.y) * uniforms.ray_per_pixel.y;
    const Floats square = x * x + y * y;
    const Floats d = root_of(square + 1.0F) / at.depth;
    Floats gain = uniforms.per_cubic_metre * d * d * d;
    if (uniforms.map.lens.bends) {
        const Floats r2 = relief::least(square, all(uniforms.max_r2));
        gain /= (1.0F + r2 * (uniforms.k1 + uniforms.k2 * r2)) *
                (1.0F + r2 * (3.0F * uniforms.k1 + 5.0F * uniforms.k2 * r2));
    }
    return relief::least(all(uniforms.most), gain);
}

struct Pictures {
    relief::PictureSpan<const float> nearness;
    relief::PictureSpan<glm::u8vec4> codes;
    const torch::ShadowMap* shadow;
};

/// The values of eight pixels of the map and of their neighbours to the right.
struct Pairs {
    Floats left, right;
    FRUSTUMSCREEN_INLINE Pairs(const float* map, Ints at) {
        using Words = std::uint64_t __attribute__((vector_size(4 * relief::lanes)));
        const auto pair = [&](int lane) FRUSTUMSCREEN_INLINED {
            std::uint64_t two;
            std::memcpy(&two, map + at[lane], sizeof two);
            return two;
        };
        const auto low = std::bit_cast<Floats>(Words{pair(0), pair(1), pair(2), pair(3)});
        const auto high = std::bit_cast<Floats>(Words{pair(4), pair(5), pair(6), pair(7)});
        left = __builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14);
        right = __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15);
    }
};

/// As torch_shader.h's, by ShadowMap::Farthest of eight places at once.
FRUSTUMSCREEN_INLINE Ints shaded(const Uniforms& uniforms, const torch::ShadowMap& shadow,
                                 const PlaceLanes& at, Ints lit) {
    constexpr float half = 0.5F * torch_px;
    const auto in_map = [&](Floats along)
                            FRUSTUMSCREEN_INLINED { return lit ? along * half + (half - 0.5F) : Floats{}; };
    const auto whole = [](Floats along) FRUSTUMSCREEN_INLINED {
        return __builtin_convertvector(relief::least(relief::most(along, Floats{}), all(torch_px - 2)), Ints);
    };
    const Floats x = in_map(at.s), y = in_map(at.t);
    const Ints low_x = whole(x), low_y = whole(y);
    const Pairs above(shadow.nearness().data(), low_y * torch_px + low_x);
    const Pairs below(shadow.nearness().data() + torch_px, low_y * torch_px + low_x);
    const Floats above_far = relief::least(above.left, above.right);
    const Floats above_near = relief::most(above.left, above.right);
    const Floats below_far = relief::least(below.left, below.right);
    const Floats below_near = relief::most(below.left, below.right);
    const Floats nearest = relief::most(above_near, below_near);
    const Floats first = relief::least(above_far, below_far);
    const Floats second =
        relief::least(relief::most(above_far, below_far), relief::least(above_near, below_near));
    const Ints farthest = below_far < above_far ? (below.right < below.left ? Ints{} + 3 : Ints{} + 2)
                                                : (above.right < above.left ? Ints{} + 1 : Ints{});
    const Ints away = ((x - __builtin_convertvector(low_x, Floats) < 0.5F) & 1) +
                      ((y - __builtin_convertvector(low_y, Floats) < 0.5F) & 2);
    const Floats compared = (farthest == away) & (second > 0.0F) ? second : first;
    const Floats seen = compared - relief::least(0.5F * (nearest - compared), shadow.max_share() * compared);
    return at.z * (seen * uniforms.inverse_z.x + uniforms.inverse_z.y) * uniforms.nearer > 1.0F;
}

/// Eight codes, of which those in `lit` change.
FRUSTUMSCREEN_INLINE void light_codes(const Uniforms& uniforms, const ReliefLight::Codes& table, Floats gain,
                                      Floats share, Ints lit, glm::u8vec4* codes) {
    std::array<glm::u8vec4, relief::lanes> shown;
    std::memcpy(shown.data(), codes, sizeof shown);
    for (int channel = 0; channel < 3; ++channel) {
        Floats light;
        for (int lane = 0; lane < relief::lanes; ++lane) {
            light[lane] = table.linear[shown[static_cast<std::size_t>(lane)][channel]];
        }
        const Floats colour = gain * uniforms.colour[channel];
        const Floats sum = uniforms.over ? light + (relief::least(colour, all(1.0F)) - light) * share
                                         : light + light * relief::least(colour * share, all(1.0F));
        const Floats root = root_of(relief::least(lit ? sum : Floats{}, all(1.0F)));
        const Ints place = __builtin_convertvector(root * float{ReliefLight::roots - 1} + 0.5F, Ints);
        for (int lane = 0; lane < relief::lanes; ++lane) {
            std::uint8_t& code = shown[static_cast<std::size_t>(lane)][channel];
            code = lit[lane] != 0 ? table.of[static_cast<std::size_t>(place[lane])] : code;
        }
    }
    std::memcpy(codes, shown.data(), sizeof shown);
}

/// Eight pixels from `x` on, of which `inside` are lit.
FRUSTUMSCREEN_INLINE void light_eight(const Uniforms& uniforms, const ReliefLight::Codes& table,
                                      const Pictures& pictures, int x, int y, Ints inside) {
    const Floats met = inside ? relief::load(&pictures.nearness.at(x, y)) : Floats{};
    const Ints hit = met > 0.0F;
    if (!relief::any(hit)) {
        return;
    }
    const Floats column = __builtin_convertvector(relief::lane_numbers + x, Floats) + 0.5F;
    const PlaceLanes at = uniforms.map.at({column, all(static_cast<float>(y) + 0.5F)}, hit ? met : all(1.0F));
    const Floats square = at.x * at.x + at.y * at.y + at.z * at.z;
    Ints lit = hit & in_beam(uniforms, at, square);
    if (!relief::any(lit)) {
        return;
    }
    if (pictures.shadow != nullptr) {
        lit &= ~shaded(uniforms, *pictures.shadow, at, lit);
        if (!relief::any(lit)) {
            return;
        }
    }
    const Floats share = relief::least(uniforms.opacity * intensity_at(uniforms, square), all(1.0F));
    const Floats gain = uniforms.over ? gain_at(uniforms, at) : all(1.0F);
    light_codes(uniforms, table, gain, share, lit, &pictures.codes.at(x, y));
}

FRUSTUMSCREEN_INLINE void light_rectangle(const Uniforms& uniforms, const ReliefLight::Codes& table,
                                          const Pictures& pictures, const PixelRectangle& part) {
    const int right = part.x + part.width;
    for (int y = part.y; y < part.y + part.height; ++y) {
        for (int left = part.x; left < right; left += relief::lanes) {
            const int first = std::min(left, pictures.nearness.width - relief::lanes);
            light_eight(uniforms, table, pictures, first, y,
                        (relief::lane_numbers >= left - first) & (relief::lane_numbers < right - first));
        }
    }
}

} // namespace

bool is_plain(const scene::PlacedTorch& torch) {
    constexpr unsigned other = torch::all_parts;
    return torch.stage_count == 1 && (scene::parts_of(torch) & other) == 0;
}

ReliefLight::ReliefLight() {
    std::copy_n(image::linear_from_srgb8().begin(), codes_.linear.size(), codes_.linear.begin());
    for (std::size_t k = 0; k < codes_.of.size(); ++k) {
        const double root = static_cast<double>(k) / (roots - 1);
        codes_.of[k] = image::srgb8_from_linear(root * root);
    }
}

void ReliefLight::light(const PlainLight& plain, std::span<const PixelRectangle> rectangles,
                        const relief::PictureSpan<const float>& nearness,
                        const relief::PictureSpan<glm::u8vec4>& codes,
                        relief::Instructions instructions) const {
    const Uniforms uniforms(plain);
    const Pictures pictures{nearness, codes, plain.shadow};
    for (const PixelRectangle& rectangle : rectangles) {
        relief::run_with<light_rectangle>(instructions, uniforms, codes_, pictures, rectangle);
    }
}

} // namespace frustumscreen::render
