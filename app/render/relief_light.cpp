#include "app/render/relief_light.h"

#include "app/image/image.h"
#include "app/render/place_map.h"
#include "app/render/torch_uniforms.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

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
    float max_square; ///< of the way
    glm::vec4 fall;
    glm::vec2 way; ///< up to which light is full; 1 / (dark - full)
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
        way = glm::vec2(beam.full_m, 1.0 / (beam.dark_m - beam.full_m));
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

FRUSTUMSCREEN_INLINE Floats intensity_at(const Uniforms& uniforms, Floats square) {
    const Floats beyond = (root_of(square) - uniforms.way.x) * uniforms.way.y;
    const Floats t = relief::least(relief::most(beyond, Floats{}), all(1.0F));
    const glm::vec4& fall = uniforms.fall;
    return relief::least(all(1.0F), fall.x / square) * (1.0F - t * (fall.y + t * (fall.z + t * fall.w)));
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

/// As torch_shader.h's, place by place.
FRUSTUMSCREEN_INLINE bool is_shaded(const Uniforms& uniforms, const torch::ShadowMap& shadow, float s,
                                    float t, float z) {
    constexpr float half = 0.5F * torch_px;
    const float x = s * half + (half - 0.5F);
    const float y = t * half + (half - 0.5F);
    const int low_x = std::clamp(static_cast<int>(x), 0, torch_px - 2);
    const int low_y = std::clamp(static_cast<int>(y), 0, torch_px - 2);
    const torch::ShadowMap::Farthest farthest = shadow.farthest_at(low_x, low_y);
    const std::uint32_t away =
        (x - static_cast<float>(low_x) < 0.5F ? 1U : 0U) + (y - static_cast<float>(low_y) < 0.5F ? 2U : 0U);
    const bool is_away =
        farthest.without_one > 0.0F && (std::bit_cast<std::uint32_t>(farthest.without_one) & 3U) == away;
    const float seen = is_away ? farthest.without_one : farthest.of_four;
    return z * (seen * uniforms.inverse_z.x + uniforms.inverse_z.y) * uniforms.nearer > 1.0F;
}

FRUSTUMSCREEN_INLINE void light_code(const ReliefLight::Codes& table, bool over, const glm::vec3& colour,
                                     float share, glm::u8vec4& code) {
    for (int channel = 0; channel < 3; ++channel) {
        const float light = table.linear[code[channel]];
        const float lit = over ? light + (std::min(colour[channel], 1.0F) - light) * share
                               : light + light * std::min(colour[channel] * share, 1.0F);
        const float root = std::sqrt(std::min(lit, 1.0F)) * (ReliefLight::roots - 1);
        code[channel] = table.of[static_cast<std::size_t>(root + 0.5F)];
    }
}

struct Pictures {
    relief::PictureSpan<const float> nearness;
    relief::PictureSpan<glm::u8vec4> codes;
    const torch::ShadowMap* shadow;
};

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
    unsigned lit = relief::bits_of(hit & in_beam(uniforms, at, square));
    if (lit == 0) {
        return;
    }
    const Floats share = relief::least(uniforms.opacity * intensity_at(uniforms, square), all(1.0F));
    const Floats gain = uniforms.over ? gain_at(uniforms, at) : all(1.0F);
    for (; lit != 0; lit &= lit - 1) {
        const int lane = std::countr_zero(lit);
        if (pictures.shadow == nullptr ||
            !is_shaded(uniforms, *pictures.shadow, at.s[lane], at.t[lane], at.z[lane])) {
            light_code(table, uniforms.over, gain[lane] * uniforms.colour, share[lane],
                       pictures.codes.at(x + lane, y));
        }
    }
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
