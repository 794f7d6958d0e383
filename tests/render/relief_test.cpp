// A relief in the picture, rasterized or drawn by the GPU: at the positions of the ray cast, in the colours
// of its mesh, together with meshes in a fade.

#include "tests/render/counted_new.h"
#include "tests/render/mass.h"
#include "tests/render/reference_cast.h"
#include "tests/render/relief_rig.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::synthetic {
namespace {

/// Hits through each pixel's centre, row by row.
std::vector<ReferenceCast::Hit> hits_of(const ReferenceCast& truth, const TestTable& table) {
    std::vector<ReferenceCast::Hit> hits;
    for (int y = 0; y < table.projector.height; ++y) {
        for (int x = 0; x < table.projector.width; ++x) {
            hits.push_back(truth.through_pixel(table, {x + 0.5, y + 0.5}));
        }
    }
    return hits;
}

TEST(Relief, PlacesMatchTheRayCast) {
    std::mt19937 random(3);
    for (const geometry::Lens& lens : lenses) {
        ReliefRig rig(1, 256, rings(), lens);
        const ReferenceCast truth(rig.pack, rig.level.metres_per_box);
        TestTable table = table_of(lens);
        for (int pose = 0; pose < 3; ++pose) {
            table.shuffle(random);
            const std::vector<ReferenceCast::Hit> hits = hits_of(truth, table);
            for (const scene::PlacedLevel& which : {rig.raster, rig.drawn}) {
                const image::Image8 picture = rig.one(table, which);
                const image::ImageFloat places = rig.places();
                std::size_t both = 0;
                std::size_t one = 0;
                double mm = 0.0;
                for (std::size_t k = 0; k < hits.size(); ++k) {
                    const bool met = !std::isnan(places.texels[k].x);
                    const glm::u8vec4 shown = picture.texels[k];
                    one += met != hits[k].found ? 1U : 0U;
                    EXPECT_TRUE(met || shown.r + shown.g + shown.b == 0) << k;
                    if (met && hits[k].found) {
                        both += 1;
                        mm += 1e3 * glm::distance(glm::dvec3(places.texels[k]), hits[k].point);
                    }
                }
                std::printf("%zu pixels, %zu in one alone, %.4f mm\n", both, one,
                            mm / static_cast<double>(both));
                ASSERT_GT(both, 400U);
                EXPECT_LT(one, both / 50) << which.on_gpu;
                EXPECT_LT(mm / static_cast<double>(both), 0.1)
                    << which.on_gpu; // one pixel of 750 that sees past an edge contributes 0.06
            }
        }
    }
}

/// Light that a place needs for uniform reflected light: incident light falls with the square of the distance
/// and with the angle of incidence.
double evened(const TestTable& table, const glm::dvec2& pixel) {
    const geometry::RigidTransform prop_from_projector =
        table.table_from_prop.inverse() * table.table_from_projector;
    const glm::dvec3 ray = prop_from_projector.direction(table.projector.ray(pixel));
    geometry::PropHit lit;
    if (!geometry::intersect(table.prop, prop_from_projector.translation, ray, lit)) {
        return 0.0;
    }
    const double d = lit.t * glm::length(ray);
    const glm::dvec3& normal = table.prop.faces[static_cast<std::size_t>(lit.face)].plane.normal;
    return d * d / glm::dot(normal, -glm::normalize(ray));
}

TEST(Relief, LiesWithinATwentiethOfAPixelWithAndWithoutEvenLight) {
    ReliefRig rig(16, 256, white(rings(16, 8)));
    const ReferenceCast cast(rig.pack, metres_per_box(rig.pack, rig.prop));
    TestTable table(320, 200);
    const Mass plain = cast_mass(cast, table);
    ASSERT_GT(plain.light, 400.0);
    for (const scene::PlacedLevel& which : {rig.raster, rig.drawn}) {
        const Mass shown = shown_mass(rig.one(table, which));
        EXPECT_NEAR(shown.light, plain.light, 0.01 * plain.light) << which.on_gpu;
        EXPECT_LT(glm::distance(shown.centre(), plain.centre()), 0.05) << which.on_gpu;
    }
    rig.prop = table.prop = geometry::make_frustum({0.2, 0.06, 0.08}); // no grazing light on any face
    const Mass even = cast_mass(cast, table, [&](const glm::dvec2& at) { return evened(table, at); });
    for (const scene::PlacedLevel& which : {rig.raster, rig.drawn, rig.level}) {
        const Mass lit = shown_mass(rig.one(table, which, scene::LightCompensation{}));
        EXPECT_LT(glm::distance(lit.centre(), even.centre()), 0.05)
            << (which.relief ? "relief" : "mesh") << which.on_gpu;
    }
}

TEST(Relief, HasTheColoursOfItsMesh) {
    ReliefRig rig(1);
    TestTable table(320, 200);
    std::mt19937 random(4);
    for (const std::optional<scene::LightCompensation>& light :
         {std::optional<scene::LightCompensation>(), std::optional(scene::LightCompensation{})}) {
        table.shuffle(random);
        const image::Image8 mesh = rig.one(table, rig.level, light);
        for (const scene::PlacedLevel& which : {rig.raster, rig.drawn}) {
            const image::Image8 relief = rig.one(table, which, light);
            std::size_t lit = 0;
            std::size_t off = 0;
            glm::dvec3 sum(0.0);
            for (std::size_t k = 0; k < mesh.texels.size(); ++k) {
                const glm::u8vec4& a = mesh.texels[k];
                if (a.r + a.g + a.b > 0) {
                    lit += 1;
                    sum += glm::dvec3(relief.texels[k]) - glm::dvec3(a);
                    off += farthest_channel(a, relief.texels[k]) > 24 ? 1U : 0U;
                }
            }
            const glm::dvec3 brighter = sum / static_cast<double>(lit);
            std::printf("%zu pixels, %zu off by more than 24 codes, %.2f %.2f %.2f brighter\n", lit, off,
                        brighter.r, brighter.g, brighter.b);
            ASSERT_GT(lit, 800U);
            EXPECT_LT(off, lit / 4); // the texture's squares have edges, and few pixels each
            EXPECT_LT(glm::length(brighter), 6.0);
        }
    }
}

/// White, so a pixel's code is its gain: for a mesh from the shader, for a rasterized relief from the
/// processor. Where the prop's faces meet, a rasterizer's grid of 1/256 pixel may assign a pixel to the other
/// face.
TEST(Relief, HasTheLightAndSoftEdgesOfItsMesh) {
    for (const geometry::Lens& lens : lenses) {
        ReliefRig rig(1, 128, white(rings()), lens);
        TestTable table = table_of(lens);
        std::mt19937 random(9);
        for (const scene::PlacedLevel& which : {rig.raster, rig.drawn}) {
            std::size_t both = 0;
            std::size_t soft = 0;
            std::size_t off = 0;
            for (int pose = 0; pose < 10; ++pose) {
                table.shuffle(random);
                const scene::LightCompensation light{pose % 2 == 0 ? 0.25 : 1.5};
                const image::Image8 mesh = rig.one(table, rig.level, light);
                const image::Image8 relief = rig.one(table, which, light);
                scene::plan_frame(rig.prop, which, table.view(light), rig.plan);
                rig.plan.feathers.clear();
                rig.draw(render::Redraw::Everything);
                const image::Image8 sharp = rig.picture();
                for (std::size_t k = 0; k < mesh.texels.size(); ++k) {
                    if (mesh.texels[k].g > 0 && relief.texels[k].g > 0) {
                        both += 1;
                        soft += relief.texels[k].g < sharp.texels[k].g ? 1U : 0U;
                        off += farthest_channel(mesh.texels[k], relief.texels[k]) > 1 ? 1U : 0U;
                    }
                }
            }
            std::printf("%zu pixels, %zu of soft edges, %zu off\n", both, soft, off);
            EXPECT_GT(both, 5'000U);
            EXPECT_GT(soft, 100U);
            EXPECT_LE(off, both / 2000);
        }
    }
}

/// Arbitrary codes, on and off the faces, in compensated light and with soft edges.
TEST(Relief, LightIsEqualForPlainAndBestInstructions) {
    for (const geometry::Lens& lens : lenses) {
        ReliefRig rig(1, 256, rings(), lens);
        const TestTable table = table_of(lens);
        scene::plan_frame(rig.prop, rig.raster, table.view(scene::LightCompensation{1.5}), rig.plan);
        std::mt19937 random(11);
        std::vector<glm::u8vec4> codes(static_cast<std::size_t>(table.projector.width));
        for (glm::u8vec4& each : codes) {
            each = glm::u8vec4(random() % 256, random() % 256, random() % 256, 255);
        }
        scene::RasterLight best;
        scene::RasterLight plain(relief::Instructions::Plain);
        best.begin(rig.plan);
        plain.begin(rig.plan);
        std::size_t shown = 0;
        for (int y = 0; y < table.projector.height; ++y) {
            std::vector<glm::u8vec4> a = codes;
            std::vector<glm::u8vec4> b = codes;
            best.light(y, 0, a);
            plain.light(y, 0, b);
            ASSERT_EQ(a, b) << y;
            shown += static_cast<std::size_t>(
                std::count_if(a.begin(), a.end(), [](const glm::u8vec4& each) { return each.g > 0; }));
        }
        EXPECT_GT(shown, 1000U);
    }
}

TEST(Relief, CoversPicturesOnThePropOnlyAtItsPixels) {
    ReliefRig rig(1);
    const TestTable table(320, 200);
    const image::Image8 alone = rig.one(table, rig.raster, scene::LightCompensation{});
    scene::TablePicture everywhere;
    everywhere.corners_m = {glm::dvec3(-0.4, 0.4, 0.0), {0.4, 0.4, 0.0}, {0.4, -0.4, 0.0}, {-0.4, -0.4, 0.0}};
    everywhere.texture = rig.renderer->store().upload(image::Image<std::uint8_t>(16, 16, 255)).value();
    everywhere.on_prop = true;
    scene::PlanView view = table.view(scene::LightCompensation{});
    view.on_table = {&everywhere, 1};
    scene::plan_frame(rig.prop, rig.raster, view, rig.plan);
    rig.draw(render::Redraw::Everything);
    const image::Image8 both = rig.picture();
    std::size_t shown = 0;
    for (std::size_t k = 0; k < alone.texels.size(); ++k) {
        const bool dark = alone.texels[k].r + alone.texels[k].g + alone.texels[k].b == 0;
        shown += dark ? 0U : 1U;
        ASSERT_EQ(both.texels[k], dark ? glm::u8vec4(255) : alone.texels[k]) << k;
    }
    EXPECT_GT(shown, 1000U);
}

/// Without anything else in the picture the relief is copied, which is no draw call, otherwise drawn: both
/// give equal pixels, and the table's picture next to the prop stays unchanged whichever way a strip takes.
TEST(Relief, LeavesPicturesOnTheTableUnchanged) {
    ReliefRig rig(2);
    TestTable table(320, 200);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place_m(-0.12, 0.12);
    const scene::TextureId texture =
        rig.renderer->store().upload(image::Image<std::uint8_t>(16, 16, 255)).value();
    std::size_t drawn = 0;
    std::size_t copied = 0;
    std::size_t beside = 0;
    for (int pose = 0; pose < 30; ++pose) {
        table.shuffle(random);
        scene::PlanView view = table.view(scene::LightCompensation{});
        scene::plan_frame(rig.prop, rig.raster, view, rig.plan);
        EXPECT_EQ(rig.draw(render::Redraw::Everything).draw_calls, 0);
        const image::Image8 alone = rig.picture();
        const double half_m = pose == 0 ? 0.4 : 0.03;
        const glm::dvec2 middle_m =
            pose == 0 ? glm::dvec2(0.0) : glm::dvec2(place_m(random), place_m(random));
        scene::TablePicture lying;
        lying.texture = texture;
        for (std::size_t k = 0; k < 4; ++k) {
            lying.corners_m[k] = {middle_m.x + (k == 1 || k == 2 ? half_m : -half_m),
                                  middle_m.y + (k < 2 ? half_m : -half_m), 0.0};
        }
        view.on_table = {&lying, 1};
        scene::plan_frame(rig.prop, scene::PlacedLevel{}, view, rig.plan);
        const int without = rig.draw(render::Redraw::Everything).draw_calls;
        const image::Image8 below = rig.picture();
        scene::plan_frame(rig.prop, rig.raster, view, rig.plan);
        const int with = rig.draw(render::Redraw::Everything).draw_calls;
        const image::Image8 both = rig.picture();
        (with > without ? drawn : copied) += 1;
        for (std::size_t k = 0; k < both.texels.size(); ++k) {
            const bool lit = alone.texels[k].r + alone.texels[k].g + alone.texels[k].b > 0;
            beside += below.texels[k].r > 0 ? 1U : 0U;
            ASSERT_EQ(both.texels[k], lit ? alone.texels[k] : below.texels[k]) << pose << " " << k;
        }
    }
    std::printf("%zu drawn, %zu copied, %zu pixels on the table\n", drawn, copied, beside);
    EXPECT_GT(drawn, 5U);
    EXPECT_GT(copied, 5U);
    EXPECT_GT(beside, 10'000U);
}

TEST(Relief, PartialRedrawEqualsFullRedraw) {
    ReliefRig rig(2);
    TestTable table(320, 200);
    std::mt19937 random(12);
    for (int pose = 0; pose < 8; ++pose) {
        table.shuffle(random);
        scene::plan_frame(rig.prop, rig.raster, table.view(scene::LightCompensation{}), rig.plan);
        ASSERT_TRUE(rig.draw(render::Redraw::Changes).drawn);
        const image::Image8 moved = rig.picture();
        rig.draw(render::Redraw::Everything);
        ASSERT_EQ(moved.texels, rig.picture().texels) << pose;
        EXPECT_GT(lit_pixels(moved), 500U);
    }
}

TEST(Relief, FadesPixelByPixelBetweenMeshAndRelief) {
    for (const auto& [samples, on_gpu] : {std::pair(1, false), {4, false}, {1, true}, {4, true}}) {
        ReliefRig rig(samples);
        const scene::PlacedLevel& which = on_gpu ? rig.drawn : rig.raster;
        TestTable table(320, 200);
        std::mt19937 random(7);
        table.shuffle(random);
        const image::Image8 mesh = rig.one(table, rig.level, scene::LightCompensation{});
        const image::Image8 relief = rig.one(table, which, scene::LightCompensation{});
        for (const bool comes : {true, false}) {
            const image::Image8& from = comes ? mesh : relief;
            const image::Image8& to = comes ? relief : mesh;
            std::size_t last = 0;
            for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
                const image::Image8 middle = comes ? rig.fading(table, rig.level, which, share)
                                                   : rig.fading(table, which, rig.level, share);
                std::size_t arrived = 0;
                std::size_t neither = 0;
                for (std::size_t k = 0; k < middle.texels.size(); ++k) {
                    const bool is_from = farthest_channel(middle.texels[k], from.texels[k]) <= 1;
                    const bool is_to = farthest_channel(middle.texels[k], to.texels[k]) <= 1;
                    neither += is_from || is_to ? 0U : 1U;
                    arrived += is_to && !is_from ? 1U : 0U;
                }
                EXPECT_EQ(neither, 0U) << samples << " " << comes << " " << share;
                std::printf("%d samples, %g: %zu neither, %zu arrived\n", samples, share, neither, arrived);
                EXPECT_TRUE(share == 0.0 ? arrived == 0 : arrived > last) << share;
                last = arrived;
            }
        }
    }
}

TEST(Relief, FadesPixelByPixelBetweenTwoReliefs) {
    ReliefRig rig(1);
    const std::shared_ptr<const relief::BlockRelief> coarse = relief_of(rig.pack, 64);
    scene::PlacedLevel other =
        scene::placed(rig.pack, coarse, rig.level.metres_per_box, rig.renderer->store().keep(coarse));
    other.samples = 1;
    TestTable table(320, 200);
    std::mt19937 random(8);
    table.shuffle(random);
    const image::Image8 from = rig.one(table, rig.raster, scene::LightCompensation{});
    const image::Image8 to = rig.one(table, other, scene::LightCompensation{});
    for (const double share : {0.25, 0.5, 0.75}) {
        const image::Image8 middle = rig.fading(table, rig.raster, other, share);
        std::size_t differing = 0;
        std::size_t arrived = 0;
        for (std::size_t k = 0; k < middle.texels.size(); ++k) {
            ASSERT_TRUE(middle.texels[k] == from.texels[k] || middle.texels[k] == to.texels[k]) << k;
            const bool differs = from.texels[k] != to.texels[k];
            differing += differs ? 1U : 0U;
            arrived += differs && middle.texels[k] == to.texels[k] ? 1U : 0U;
        }
        ASSERT_GT(differing, 500U);
        EXPECT_NEAR(static_cast<double>(arrived) / static_cast<double>(differing), share, 0.06);
    }
}

TEST(Relief, DisappearsAfterRelease) {
    ReliefRig rig(1);
    const TestTable table(320, 200);
    for (const scene::PlacedLevel& which : {rig.raster, rig.drawn}) {
        ASSERT_GT(lit_pixels(rig.one(table, which)), 1000U);
        rig.renderer->store().release(which.drawable);
        EXPECT_EQ(lit_pixels(rig.one(table, which)), 0U);
    }
}

TEST(Relief, AFrameAllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    ReliefRig rig(4, 96);
    TestTable table(320, 200);
    std::mt19937 random(5);
    std::vector<TestTable> tables;
    for (int k = 0; k < 20; ++k) {
        table.shuffle(random);
        tables.push_back(table);
    }
    for (const scene::PlacedLevel& which : {rig.raster, rig.drawn}) {
        long counted = 0;
        for (int k = 0; k < 60; ++k) { // the first rounds reserve memory for the fullest view
            const TestTable& from = tables[static_cast<std::size_t>(k) % tables.size()];
            const long before = allocations_so_far();
            scene::plan_frame(from.prop, which, from.view(scene::LightCompensation{}), rig.plan);
            rig.draw();
            counted += k < 40 ? 0 : allocations_so_far() - before;
        }
        EXPECT_EQ(counted, 0) << which.on_gpu;
    }
}

} // namespace
} // namespace frustumscreen::synthetic
