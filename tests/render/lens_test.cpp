// The picture behind a projector lens with distortion, against rays through each pixel: the shaders bend what
// they draw, the rays are unbent by Newton's method in 64 bits.

#include "tests/render/comparison.h"
#include "tests/render/mass.h"
#include "tests/render/rig.h"

#include <algorithm>
#include <array>
#include <span>

namespace frustumscreen::synthetic {
namespace {

constexpr std::array<geometry::Lens, 4> lenses{geometry::Lens{0.1, 0.0}, geometry::Lens{-0.1, 0.0},
                                               geometry::Lens{-0.12, 0.04}, geometry::Lens{0.3, -0.2}};

/// A wide lens: the picture's corner is at 0.42 focal lengths, where k1 = 0.1 moves a pixel by 2.
TestTable wide(const geometry::Lens& lens) {
    TestTable table(256, 160);
    table.projector.fx = table.projector.fy = 360.0;
    table.projector.lens = lens;
    table.table_from_projector.translation.z = 0.5;
    return table;
}

/// A triangle's edge stays straight between its corners although the lens bends it: at 5 pixels length it is
/// off by k1 (5 / f)^2 f 6 r / 8, less than a hundredth of a pixel of 1.4 mm; a surface seen at a grazing
/// angle magnifies that ten times.
TEST(BentPicture, HitPointsMatchARayCastThroughTheLens) {
    std::mt19937 random(17);
    for (const geometry::Lens& lens : lenses) {
        Rig rig(256, 160, 1, rings(48, 24), wide(lens).projector);
        const ReferenceCast cast(rig.pack, rig.level.metres_per_box);
        for (int pose = 0; pose < 2; ++pose) {
            TestTable table = wide(lens);
            table.shuffle(random);
            table.table_from_projector.translation.z = 0.5;
            scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
            const Comparison c = compare(table, cast, rig.places());
            EXPECT_GT(c.both, 200U) << lens.k1 << ' ' << pose;
            EXPECT_LT(c.worst_mm, 0.1) << lens.k1 << ' ' << pose;
            EXPECT_EQ(c.unexcused, 0U) << lens.k1 << ' ' << pose << ": of " << c.mismatched << " mismatched";
        }
    }
}

/// Samples at outlines fall to either side, so one picture's centre of mass is known only to 0.05 pixel; the
/// mean of three would reveal a shift.
TEST(BentPicture, LiesWithinATwentiethOfAPixelOfARayCast) {
    constexpr std::array<glm::dvec2, 3> places{glm::dvec2(0.07, 0.03), {-0.07, -0.03}, {0.06, -0.04}};
    for (const geometry::Lens& lens : std::span(lenses).first(2)) {
        pack::Pack white = rings(16, 8);
        std::fill(white.textures[0].texels.begin(), white.textures[0].texels.end(), glm::u8vec4(255));
        Rig rig(256, 160, 16, white, wide(lens).projector);
        const ReferenceCast cast(rig.pack, metres_per_box(rig.pack, rig.prop));
        glm::dvec2 beside(0.0);
        for (const glm::dvec2& place : places) {
            TestTable table = wide(lens);
            table.table_from_prop.translation = glm::dvec3(place, 0.0);
            table.eye_m = {0.15, -0.3, 0.6};
            const Mass truth = cast_mass(cast, table);
            ASSERT_GT(truth.light, 1000.0);
            scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
            rig.draw(render::Redraw::Everything);
            const Mass shown = shown_mass(rig.picture());
            EXPECT_NEAR(shown.light, truth.light, 0.01 * truth.light) << lens.k1;
            EXPECT_LT(glm::distance(shown.centre(), truth.centre()), 0.1) << lens.k1;
            beside += (shown.centre() - truth.centre()) / 3.0;
            // Check of the test itself: without the lens the picture is displaced.
            table.projector.lens = {};
            EXPECT_GT(glm::distance(cast_mass(cast, table).centre(), truth.centre()), 0.2) << lens.k1;
        }
        EXPECT_LT(glm::length(beside), 0.05) << lens.k1;
    }
}

TEST(BentPicture, CullingChangesNoPixel) {
    std::mt19937 random(12);
    for (const geometry::Lens& lens : lenses) {
        Rig rig(256, 160, 1, rings(), wide(lens).projector);
        for (int pose = 0; pose < 12; ++pose) {
            TestTable table = wide(lens);
            table.shuffle(random);
            table.table_from_projector.translation.z = 0.5;
            if (pose % 4 == 3) { // at the picture's edge
                table.table_from_prop.translation += glm::dvec3(0.17, -0.08, 0.0);
            }
            scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
            rig.draw(render::Redraw::Everything);
            const image::Image8 culled_picture = rig.picture();
            draw_everything(rig.plan, rig.pack.levels[0].indices);
            rig.draw(render::Redraw::Everything);
            ASSERT_EQ(rig.picture().texels, culled_picture.texels) << lens.k1 << ' ' << pose;
        }
    }
}

/// Light of a pixel on a surface square to it at 1 m, relative to a pixel of the ideal lens: it fills the
/// solid angle between its corners' rays.
double light_of_pixel(const geometry::Pinhole& pinhole, int x, int y) {
    const auto ray = [&](double u, double v) { return glm::dvec2(pinhole.ray({u, v})); };
    const glm::dvec2 across = ray(x + 1.0, y + 0.5) - ray(x, y + 0.5);
    const glm::dvec2 down = ray(x + 0.5, y + 1.0) - ray(x + 0.5, y);
    return 1.0 / (pinhole.fx * pinhole.fy * (across.x * down.y - across.y * down.x));
}

TEST(BentPicture, WhiteArtifactReflectsEvenLightEverywhere) {
    for (const geometry::Lens& lens : lenses) {
        Rig rig(256, 160, 1, rings(), wide(lens).projector);
        rig.pack.textures[0] = image::Image8(8, 8, {255, 255, 255, 255});
        rig.upload_again();
        TestTable table = wide(lens);
        table.prop = geometry::make_frustum({0.2, 0.06, 0.08}); // no grazing light on any face
        table.eye_m = {0.0, -0.45, 0.5};
        constexpr double aim = 0.5; // relative to the light at 1 m; the lens is half a metre above the table
        scene::plan_frame(table.prop, rig.level, table.view(scene::LightCompensation{aim}), rig.plan);
        rig.plan.feathers.clear();
        rig.draw(render::Redraw::Everything);
        const image::Image8 picture = rig.picture();
        const geometry::RigidTransform prop_from_projector =
            table.table_from_prop.inverse() * table.table_from_projector;
        double least = 10.0;
        double most = 0.0;
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                geometry::PropHit lit;
                const glm::dvec3 ray = prop_from_projector.direction(table.projector.ray({x + 0.5, y + 0.5}));
                if (picture.at(x, y).g == 0 ||
                    !geometry::intersect(table.prop, prop_from_projector.translation, ray, lit)) {
                    continue;
                }
                const glm::dvec3 to_light = -lit.t * ray;
                const double d = glm::length(to_light);
                const double cosine =
                    glm::dot(table.prop.faces[static_cast<std::size_t>(lit.face)].plane.normal, to_light / d);
                const double light = image::linear_from_srgb(picture.at(x, y).g / 255.0) * cosine / (d * d) *
                                     light_of_pixel(table.projector, x, y);
                least = std::min(least, light);
                most = std::max(most, light);
            }
        }
        // A tolerance of one code at the darkest, about 80, is a factor of 1.03.
        EXPECT_LT(most, 1.04 * least) << lens.k1;
        EXPECT_NEAR(least, aim, 0.04 * aim) << lens.k1;
    }
}

} // namespace
} // namespace frustumscreen::synthetic
