#include "app/scene/plan_hash.h"

#include "app/ldi/point_patch.h"

#include <bit>

namespace frustumscreen::scene {

namespace {

/// FNV-1a over 64-bit words.
class Hash {
public:
    void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3ULL; }
    void add_float(float number) { add(std::uint64_t{std::bit_cast<std::uint32_t>(number)}); }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

void hash_corner(const glm::vec4& corner, Hash& hash) {
    for (int k = 0; k < 4; ++k) {
        hash.add_float(corner[k]);
    }
}

void hash_corners(const geometry::PerCorner<glm::vec4>& corners, Hash& hash) {
    hash.add(corners.size());
    for (const glm::vec4& corner : corners) {
        hash_corner(corner, hash);
    }
}

void hash_colour(const glm::vec3& colour, Hash& hash) {
    for (int k = 0; k < 3; ++k) {
        hash.add_float(colour[k]);
    }
}

void hash_draw(const Draw& draw, Hash& hash) {
    hash.add(bits_of(draw.shader));
    hash.add(static_cast<std::uint64_t>(draw.drawable.mesh));
    hash.add(static_cast<std::uint64_t>(draw.drawable.material.texture));
    hash.add(static_cast<std::uint64_t>(draw.face));
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            hash.add_float(draw.clip_from_unit[column][row]);
        }
    }
    hash.add(draw.range.count);
    hash.add_float(draw.brightness);
    hash_colour(draw.light, hash);
    hash.add_float(draw.dither.share);
    hash.add(static_cast<std::uint64_t>(draw.dither.complement));
}

void hash_torch(const TorchLight& light, Hash& hash) {
    const torch::Beam& beam = light.torch.beam;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row) {
            hash.add_float(static_cast<float>(light.torch_from_prop[column][row]));
        }
    }
    hash.add(static_cast<std::uint64_t>(beam.shape) << 8U | static_cast<std::uint64_t>(beam.attenuation));
    for (const double number : {beam.opening_rad, beam.height_per_width, beam.full_m, beam.dark_m}) {
        hash.add(std::bit_cast<std::uint64_t>(number));
    }
    hash.add(static_cast<std::uint64_t>(light.torch.picture));
    hash.add(light.torch.picture_version);
    hash.add_float(light.torch.brightness);
    for (std::size_t k = 0; k < light.torch.stage_count; ++k) {
        const torch::Stage& stage = light.torch.stages[k];
        const torch::StageAt& at = light.torch.stages_at[k];
        hash.add(static_cast<std::uint64_t>(stage.source) << 8U | static_cast<std::uint64_t>(stage.item));
        hash_colour(stage.colour, hash);
        hash.add_float(at.opacity);
        for (int column = 0; column < 3; ++column) {
            hash.add_float(at.stage_from_content[column].x);
            hash.add_float(at.stage_from_content[column].y);
        }
    }
}

} // namespace

std::uint64_t hash_of(const Draw& draw) {
    Hash hash;
    hash_draw(draw, hash);
    return hash.value();
}

std::uint64_t hash_of(const FramePlan& plan) {
    Hash hash;
    hash.add(hash_of_prop(plan));
    for (const Draw& draw : plan.draws) {
        if (draw.face == Draw::on_table) {
            hash_draw(draw, hash);
        }
    }
    for (std::size_t k = 0; k < plan.window_count; ++k) {
        hash.add(plan.windows[k].hash);
    }
    for (const glm::vec4& corner : plan.cover_clip) {
        hash_corner(corner, hash);
    }
    return hash.value();
}

std::uint64_t hash_of_prop(const FramePlan& plan) {
    Hash hash;
    hash.add(static_cast<std::uint64_t>(plan.projector.width));
    hash.add(static_cast<std::uint64_t>(plan.projector.height));
    hash.add(static_cast<std::uint64_t>(plan.samples));
    for (const Draw& draw : plan.draws) {
        if (draw.face != Draw::on_table) {
            hash_draw(draw, hash);
        }
    }
    for (std::size_t k = 0; k < plan.relief_draw_count; ++k) {
        const ReliefDraw& drawn = plan.relief_draws[k];
        hash.add(static_cast<std::uint64_t>(drawn.samples));
        hash.add(drawn.points != nullptr ? drawn.points->number : 0);
    }
    for (const TorchLight& light : plan.torches) {
        hash_torch(light, hash);
    }
    for (const FacePlan& face : plan.faces) {
        hash.add(static_cast<std::uint64_t>(face.face));
        hash_corners(face.corners_clip, hash);
        hash.add_float(face.light.per_cubic_metre);
        hash.add_float(face.light.most);
    }
    return hash.value();
}

} // namespace frustumscreen::scene
