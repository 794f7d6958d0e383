/// A table and a renderer of a stereo layout, with the rings as a mesh, as a relief, and as a relief that the GPU draws.
#pragma once

#include "app/scene/stereo.h"
#include "tests/render/relief_rig.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <vector>

namespace frustumscreen::synthetic {

struct StereoRig : Rig {
    using Light = std::optional<scene::LightCompensation>;
    static constexpr std::size_t parts = 3;

    TestTable table;
    scene::StereoLayout layout;
    std::array<scene::PlacedLevel, parts> part{};
    std::vector<scene::FramePlan> plans; ///< one for each eye
    double interocular_m = 0.063;
    glm::dquat table_from_head{1.0, 0.0, 0.0, 0.0};

    explicit StereoRig(const scene::StereoLayout& made, int samples = 1)
        : Rig(made.display.width, made.display.height, samples, rings(), scene::if_it_bends(made.pinhole)),
          table(made.pinhole.width, made.pinhole.height), layout(made) {
        EXPECT_TRUE(renderer->prepare(needs_with_reliefs(samples, layout.pinhole)));
        const std::shared_ptr<const relief::BlockRelief> relief = relief_of(pack, 128);
        const auto placed = [&](scene::Drawable drawable) {
            return scene::placed(pack, relief, level.metres_per_box, drawable);
        };
        part = {level, placed(renderer->store().keep(relief)),
                placed(renderer->store().upload(relief).value())};
        part[2].on_gpu = true;
        for (scene::PlacedLevel& each : part) {
            each.samples = samples;
        }
        plans.reserve(layout.count); // a copy of a plan has no space
        for (std::size_t eye = 0; eye < layout.count; ++eye) {
            plans.push_back(scene::make_plan(prop, 2 * level.triangles->indices.size(), 2));
        }
    }

    /// The left and the right eye.
    [[nodiscard]] std::array<glm::dvec3, 2> eyes() const {
        const glm::dvec3 half = table_from_head * glm::dvec3(0.5 * interocular_m, 0.0, 0.0);
        return {table.eye_m - half, table.eye_m + half};
    }
    /// Another pose of the prop and of the head, which is turned in any way.
    void shuffle(std::mt19937& random) {
        std::normal_distribution<double> normal;
        table.shuffle(random);
        table_from_head =
            glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random)));
    }
    /// Plans the pictures of `eyes_m`, one for each of the layout; the `dimming` eyes decide how far they dim.
    void plan_for(const scene::PlacedLevel& which, const Light& light, std::span<const glm::dvec3> eyes_m,
                  std::span<const glm::dvec3> dimming) {
        std::array<scene::PlanView, 2> views = scene::views_of(layout, table.view(light), eyes_m);
        for (std::size_t eye = 0; eye < layout.count; ++eye) {
            views[eye].dimming_eyes_m = dimming;
            scene::plan_frame(prop, which, views[eye], plans[eye]);
            // A slanting view takes more samples where they fit, and a larger display's picture has space for more.
            plans[eye].samples = std::min(plans[eye].samples, which.samples);
        }
    }
    /// Plans both eyes' pictures.
    void plan_both(const scene::PlacedLevel& which, const Light& light = {}) {
        const std::array<glm::dvec3, 2> both = eyes();
        plan_for(which, light, both, both);
    }
    render::DrawResult draw_plans(render::Redraw redraw = render::Redraw::Changes) {
        const render::DrawResult result =
            renderer->draw(plans, {display->framebuffer(), display->buffer_age()}, redraw);
        if (result.drawn) {
            EXPECT_TRUE(display->present(MonotonicTime{}));
        }
        return result;
    }
    [[nodiscard]] image::Image8 drawn_plans() {
        draw_plans(render::Redraw::Everything);
        return picture();
    }
};

/// The eye's part of the display's picture, in the colours that the eye sees.
[[nodiscard]] inline image::Image8 seen_by(std::size_t eye, const scene::StereoLayout& layout,
                                           const image::Image8& picture) {
    const scene::EyePicture& part = layout.pictures[eye];
    image::Image8 seen(layout.pinhole.width, layout.pinhole.height);
    for (int y = 0; y < seen.height; ++y) {
        for (int x = 0; x < seen.width; ++x) {
            seen.at(x, y) = picture.at(part.viewport.x + x, part.viewport.y + y);
        }
    }
    return seen;
}

/// In the colours that the eye sees.
[[nodiscard]] inline image::Image8 coloured(image::Image8 picture, const glm::bvec3& channels) {
    for (glm::u8vec4& texel : picture.texels) {
        texel = {channels.r ? texel.r : 0, channels.g ? texel.g : 0, channels.b ? texel.b : 0, texel.a};
    }
    return picture;
}

struct Difference {
    std::size_t pixels = 0;
    std::size_t far = 0; ///< pixels that are more than one code off
    std::size_t lit = 0; ///< pixels of the first
    int worst = 0;       ///< codes
};
[[nodiscard]] inline Difference difference(const image::Image8& a, const image::Image8& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.texels.size(), b.texels.size());
    Difference found{.pixels = 0, .far = 0, .lit = lit_pixels(a), .worst = 0};
    for (std::size_t k = 0; k < a.texels.size(); ++k) {
        const int farthest = farthest_channel(a.texels[k], b.texels[k]);
        found.pixels += farthest > 0 ? 1U : 0U;
        found.far += farthest > 1 ? 1U : 0U;
        found.worst = std::max(found.worst, farthest);
    }
    return found;
}

} // namespace frustumscreen::synthetic
