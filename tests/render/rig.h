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
[[nodiscard]] inline RenderNeeds needs(int samples, bool fades = false) {
    RenderNeeds needs{samples, {{ShaderKey::Pass::TablePicture}, {ShaderKey::Pass::EdgeFeather}}};
    for (const bool even_light : {false, true}) {
        for (const bool dithered : {false, fades}) {
            ShaderKey key;
            key.even_light = even_light;
            key.dithered = dithered;
            needs.draws.insert(key);
        }
    }
    return needs;
}

struct Rig {
    Pack pack;
    PropShape prop = make_frustum({});
    std::unique_ptr<SurfacelessDisplay> display;
    std::optional<Renderer> renderer;
    std::optional<HitPointRenderer> hit_points;
    PlacedLevel level;
    FramePlan plan;

    /// `bent_by`: the stage's projector, if its lens has distortion.
    Rig(int width, int height, int samples = 1, Pack shown = rings(),
        const std::optional<Pinhole>& bent_by = std::nullopt)
        : pack(std::move(shown)) {
        display = SurfacelessDisplay::create(width, height).value();
        RenderNeeds all = needs(samples);
        all.bent_by = bent_by;
        renderer = Renderer::create(width, height, all).value();
        hit_points = HitPointRenderer::create(*renderer).value();
        level = placed(pack, 0, metres_per_box(pack, prop), renderer->store().upload(pack, 0).value());
        plan = make_plan(prop, level);
    }
    DrawResult draw(Redraw redraw = Redraw::Changes) {
        const DrawResult result =
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
    [[nodiscard]] ImageFloat places() { return hit_points->draw(plan, renderer->store()); }
    [[nodiscard]] Image8 picture() const {
        return read_colour(display->framebuffer(), display->width(), display->height());
    }
};

[[nodiscard]] inline std::size_t lit_pixels(const Image8& image) {
    std::size_t lit = 0;
    for (const glm::u8vec4& texel : image.texels) {
        lit += texel.r + texel.g + texel.b > 0 ? 1U : 0U;
    }
    return lit;
}

} // namespace frustumscreen::synthetic
