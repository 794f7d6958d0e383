// The renderer's meshes, textures and shaders, and their lifetimes.

#include "tests/render/rig.h"

namespace frustumscreen::synthetic {
namespace {

std::size_t programs_that_exist() {
    std::size_t count = 0;
    for (GLuint name = 1; name < 1000; ++name) {
        count += glIsProgram(name) == GL_TRUE ? 1U : 0U;
    }
    return count;
}

TEST(Store, NeverReusesANumberAndFreesReleasedData) {
    Rig rig(64, 40);
    render::GpuStore& store = rig.renderer->store();
    const std::uint64_t bytes = store.bytes();
    const scene::Drawable first = store.upload(rig.pack, 0).value();
    const render::GpuStore::Mesh* const mesh = store.find(first.mesh);
    ASSERT_NE(mesh, nullptr);
    const GLuint buffer = mesh->vertices.get();
    const GLuint texture = store.find(first.material.texture)->texels.get();
    EXPECT_EQ(store.bytes(), bytes + store.bytes(first));
    EXPECT_EQ(store.bytes(first), scene::gpu_bytes(scene::whole_level(rig.pack, 0), rig.pack.textures[0]));
    store.release(first);
    EXPECT_EQ(store.bytes(), bytes);
    EXPECT_EQ(store.find(first.mesh), nullptr);
    EXPECT_EQ(store.find(first.material.texture), nullptr);
    EXPECT_FALSE(glIsBuffer(buffer) == GL_TRUE || glIsTexture(texture) == GL_TRUE);
    const scene::Drawable second = store.upload(rig.pack, 0).value();
    EXPECT_NE(second.mesh, first.mesh);
    EXPECT_NE(second.material.texture, first.material.texture);
    store.release(first); // released again: unknown
    EXPECT_NE(store.find(second.mesh), nullptr);
}

TEST(Store, ReleasedMeshIsNotDrawn) {
    Rig rig(320, 200);
    const TestTable table(320, 200);
    scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
    rig.draw();
    EXPECT_GT(lit_pixels(rig.picture()), 1000U);
    rig.renderer->store().release(rig.level.drawable);
    const render::DrawResult drawn = rig.draw(render::Redraw::Everything);
    EXPECT_EQ(lit_pixels(rig.picture()), 0U);
    EXPECT_EQ(drawn.draw_calls, static_cast<int>(rig.plan.faces.size())); // the faces' outlines
}

TEST(Shaders, MatchTheNeedsAndNoFrameCompilesOne) {
    Rig rig(320, 200);
    EXPECT_EQ(rig.renderer->shaders(), scene::shaders_of(needs(1)));
    ASSERT_TRUE(rig.renderer->prepare(needs(4, true)));
    EXPECT_EQ(rig.renderer->shaders(), scene::shaders_of(needs(4, true)));
    rig.hit_points = render::HitPointRenderer::create(*rig.renderer).value();
    const std::size_t programs = programs_that_exist();
    EXPECT_GE(programs, scene::shaders_of(needs(4, true)).size());
    const scene::TextureId caption =
        rig.renderer->store().upload(image::Image<std::uint8_t>(16, 16, 255)).value();
    TestTable table(320, 200);
    std::mt19937 random(3);
    for (int k = 0; k < 24; ++k) {
        table.shuffle(random);
        scene::PlanView view =
            table.view(k % 2 == 0 ? std::optional(scene::LightCompensation{}) : std::nullopt);
        if (k % 3 == 0) {
            view.caption = scene::TablePicture{{glm::dvec3(-0.2, 0.1, 0.0), glm::dvec3(-0.1, 0.1, 0.0),
                                                glm::dvec3(-0.1, 0.0, 0.0), glm::dvec3(-0.2, 0.0, 0.0)},
                                               1.0,
                                               caption};
        }
        rig.level.samples = k % 4 == 0 ? 1 : 4;
        const std::array<scene::Part, 2> fading = scene::fade(rig.level, rig.level, 0.5);
        scene::plan_frame(table.prop, std::span(fading).first(k % 5 == 0 ? 1 : 2), view, rig.plan);
        for (const scene::Draw& draw : rig.plan.draws) {
            EXPECT_EQ(rig.renderer->shaders().count(draw.shader), 1U) << scene::name_of(draw.shader);
        }
        rig.draw(render::Redraw::Everything);
        EXPECT_GT(lit_pixels(rig.picture()), 500U);
        static_cast<void>(rig.places());
    }
    EXPECT_EQ(programs_that_exist(), programs);
    ASSERT_TRUE(rig.renderer->prepare(needs(2)));
    EXPECT_EQ(programs_that_exist(), programs); // all exist already
}

} // namespace
} // namespace frustumscreen::synthetic
