// The offline renderer draws a pack's file without a screen, as the live exhibit does. Hit points are the
// places of the artifact that the pixels show.
#include "app/show/offline_renderer.h"
#include "assets_baked/bake/bake.h"
#include "tests/bake/shapes.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

pack::Pack baked_ball() {
    bake::SourceMesh ball = test::empty_mesh();
    test::add_sphere(ball, {0.0, 0.0, 0.0}, 1.0, 24);
    bake::BakeOptions options;
    options.relief = false;
    options.measuring = 0.05;
    return bake::bake(ball, options).value();
}

class RoomExampleOfFiles : public WithTemporaryFolder {};

TEST_F(RoomExampleOfFiles, Show) {
    const std::filesystem::path file = folder / "ball.fspack";
    ASSERT_TRUE(write_file(file, pack::write_pack(baked_ball()).value()));
    // example
    show::OfflineOptions options;
    options.technique = "finest";
    options.hit_points = true;
    const show::OfflineSetup setup{settings::parse_settings("", "kiosk.toml").value(), options}; // as shipped
    const show::OfflineScene scene = show::load_offline(file, [&](const pack::PackOutline&) {
                                         return Result<show::OfflineSetup>(setup);
                                     }).value();
    const auto renderer = show::OfflineRenderer::create(scene).value();
    const show::OfflinePicture picture = renderer->draw(geometry::RigidTransform{}, {0.0, -0.55, 0.50});
    const double radius_m =
        0.5 * pack::place(*scene.pack, renderer->prop()).metres_per_box; // the artifact is a ball
    const glm::dvec3 hit = picture.hit_points->at(960, 720);             // prop frame
    EXPECT_NEAR(glm::distance(hit, glm::dvec3(0.0, 0.0, radius_m)), radius_m, 0.02 * radius_m);
    // end
}

} // namespace
} // namespace frustumscreen::example
