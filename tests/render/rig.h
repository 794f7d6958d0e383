/// A display, an uploaded synthetic pack and the two renderers.
#pragma once

#include "app/render/hit_points.h"
#include "app/render/read_back.h"
#include "app/render/renderer.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/render/synthetic_pack.h"

#include <gtest/gtest.h>

namespace frustumscreen::synthetic {

/// Shaders for opaque artifacts, in plain and in even light, their edges and captions.
[[nodiscard]] inline scene::RenderNeeds needs(int samples, bool fades = false) {
    scene::RenderNeeds needs{samples,
                             {{scene::ShaderKey::Pass::TablePicture}, {scene::ShaderKey::Pass::EdgeFeather}}};
    for (const bool even_light : {false, true}) {
        for (const bool dithered : {false, fades}) {
            scene::ShaderKey key;
            key.even_light = even_light;
            key.dithered = dithered;
            needs.draws.insert(key);
        }
    }
    return needs;
}

struct Rig {
    pack::Pack pack;
    geometry::PropShape prop = geometry::make_frustum({});
    std::unique_ptr<display::SurfacelessDisplay> display;
    std::optional<render::Renderer> renderer;
    std::optional<render::HitPointRenderer> hit_points;
    scene::PlacedLevel level;
    scene::FramePlan plan;

    /// `bent_by`: the table's projector, if its lens has distortion.
    Rig(int width, int height, int samples = 1, pack::Pack shown = rings(),
        const std::optional<geometry::Pinhole>& bent_by = std::nullopt)
        : pack(std::move(shown)) {
        display = display::SurfacelessDisplay::create(width, height).value();
        scene::RenderNeeds all = needs(samples);
        all.bent_by = bent_by;
        renderer = render::Renderer::create(width, height, all).value();
        hit_points = render::HitPointRenderer::create(*renderer).value();
        level = scene::placed(pack, 0, metres_per_box(pack, prop), renderer->store().upload(pack, 0).value());
        plan = scene::make_plan(prop, level);
    }
    render::DrawResult draw(render::Redraw redraw = render::Redraw::Changes) {
        const render::DrawResult result =
            renderer->draw(plan, {display->framebuffer(), display->buffer_age()}, redraw);
        if (result.drawn) {
            EXPECT_TRUE(display->present(MonotonicTime{}));
        }
        return result;
    }
    /// Call it after a change of `pack`.
    void upload_again() {
        renderer->store().release(level.drawable);
        level.drawable = renderer->store().upload(pack, 0).value();
    }
    [[nodiscard]] image::ImageFloat places() { return hit_points->draw(plan, renderer->store()); }
    [[nodiscard]] image::Image8 picture() const {
        return render::read_colour(display->framebuffer(), display->width(), display->height());
    }
};

[[nodiscard]] inline std::size_t lit_pixels(const image::Image8& image) {
    std::size_t lit = 0;
    for (const glm::u8vec4& texel : image.texels) {
        lit += texel.r + texel.g + texel.b > 0 ? 1U : 0U;
    }
    return lit;
}

} // namespace frustumscreen::synthetic
