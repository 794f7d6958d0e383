/// A pack with its relief, rasterized and drawn by the GPU, under projectors with and without lens
/// distortion.
#pragma once

#include "tests/render/rig.h"
#include "tests/render/ring_relief.h"

#include <algorithm>
#include <array>
#include <memory>

namespace frustumscreen::synthetic {

inline constexpr std::array<geometry::Lens, 4> lenses{geometry::Lens{}, geometry::Lens{0.1, 0.0},
                                                      geometry::Lens{-0.12, 0.04}, geometry::Lens{0.3, -0.2}};

/// A lens with distortion is a wide one: 0.3 and -0.2 move the picture's corner by 3 pixels.
inline TestTable table_of(const geometry::Lens& lens) {
    TestTable table(320, 200);
    if (!lens.is_plain()) {
        table.projector.fx = table.projector.fy = 450.0;
        table.projector.lens = lens;
    }
    return table;
}

inline scene::RenderNeeds needs_with_reliefs(int samples, const geometry::Pinhole& projector) {
    scene::RenderNeeds all = needs(samples, true);
    all.bent_by = scene::if_it_bends(projector);
    all.draws.insert(scene::raster_shader());
    all.rasterizes = true;
    for (scene::ShaderKey key : needs(samples, true).draws) {
        key.blocks = key.pass == scene::ShaderKey::Pass::Surface;
        all.draws.insert(key);
    }
    return all;
}

struct ReliefRig : Rig {
    std::shared_ptr<const relief::BlockRelief> relief;
    scene::PlacedLevel raster, drawn; ///< one relief: rasterized on the processor, and drawn by the GPU

    explicit ReliefRig(int samples, int texels = 256, const pack::Pack& shown = rings(),
                       const geometry::Lens& lens = {})
        : Rig(320, 200, samples, shown, scene::if_it_bends(table_of(lens).projector)) {
        EXPECT_TRUE(renderer->prepare(needs_with_reliefs(samples, table_of(lens).projector)));
        hit_points = render::HitPointRenderer::create(*renderer).value();
        relief = relief_of(pack, texels);
        raster = scene::placed(pack, relief, level.metres_per_box, renderer->store().keep(relief));
        drawn = scene::placed(pack, relief, level.metres_per_box, renderer->store().upload(relief).value());
        drawn.on_gpu = true;
        level.samples = raster.samples = drawn.samples = samples;
        plan = scene::make_plan(prop, 2 * level.triangles->indices.size(), 2);
    }
    image::Image8 one(const TestTable& table, const scene::PlacedLevel& which,
                      std::optional<scene::LightCompensation> light = {}) {
        scene::plan_frame(prop, which, table.view(light), plan);
        draw(render::Redraw::Everything);
        return picture();
    }
    image::Image8 fading(const TestTable& table, const scene::PlacedLevel& from, const scene::PlacedLevel& to,
                         double share) {
        scene::plan_frame(prop, scene::fade(from, to, share), table.view(scene::LightCompensation{}), plan);
        EXPECT_TRUE(draw(render::Redraw::Everything).drawn);
        return picture();
    }
};

inline pack::Pack white(pack::Pack pack) {
    std::fill(pack.textures[0].texels.begin(), pack.textures[0].texels.end(), glm::u8vec4(255));
    return pack;
}

inline int farthest_channel(const glm::u8vec4& a, const glm::u8vec4& b) {
    const glm::ivec3 difference = glm::abs(glm::ivec3(a) - glm::ivec3(b));
    return std::max({difference.r, difference.g, difference.b});
}

} // namespace frustumscreen::synthetic
