// The props of config/prop_*.obj in the hand, with faces of three, four and six corners: mesh and relief, with
// and without a lens, against a ray cast that meets the prop's planes and knows no corners.

#include "tests/render/comparison.h"
#include "tests/render/counted_new.h"
#include "tests/render/relief_rig.h"
#include "tests/solid/example_props.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

namespace frustumscreen::synthetic {
namespace {

constexpr std::array<const char*, 3> solids{"hexagon", "tetrahedron", "gem"};
/// A place in the picture may be this far off.
constexpr double outline_px = 0.1;

/// The table of the lens, as near to the table as the prop fits into the picture.
TestTable table_with(const geometry::PropShape& prop, const geometry::Lens& lens) {
    TestTable table = table_of(lens);
    table.prop = prop;
    return table;
}

struct SolidRig : Rig {
    SolidRig(const geometry::PropShape& shape, const geometry::Lens& lens, const pack::Pack& shown)
        : Rig(320, 200, 1, shown, scene::if_it_bends(table_of(lens).projector)) {
        prop = shape;
        level.metres_per_box = synthetic::metres_per_box(pack, prop);
        level.samples = 1;
        plan = scene::make_plan(prop, level);
    }
};

/// A relief takes seconds to bake.
struct SolidReliefRig : SolidRig {
    scene::PlacedLevel raster, drawn; ///< one relief: rasterized on the processor, and drawn by the GPU

    SolidReliefRig(const geometry::PropShape& shape, const geometry::Lens& lens, const pack::Pack& shown)
        : SolidRig(shape, lens, shown) {
        EXPECT_TRUE(renderer->prepare(needs_with_reliefs(1, table_of(lens).projector)));
        hit_points = render::HitPointRenderer::create(*renderer).value();
        const std::shared_ptr<const relief::BlockRelief> relief = relief_of(pack, 256, true);
        raster = scene::placed(pack, relief, level.metres_per_box, renderer->store().keep(relief));
        drawn = scene::placed(pack, relief, level.metres_per_box, renderer->store().upload(relief).value());
        drawn.on_gpu = true;
        raster.samples = drawn.samples = 1;
    }
    /// A picture of one of the two alone.
    image::Image8 one(const TestTable& table, const scene::PlacedLevel& which) {
        scene::plan_frame(prop, which, table.view(), plan);
        draw(render::Redraw::Everything);
        return picture();
    }
};

/// True if `is` is the same all around the pixel's centre as in it.
template <typename Is> bool is_same_around(const glm::dvec2& centre, bool here, const Is& is) {
    for (int k = 0; k < 8; ++k) {
        const double angle = k * std::numbers::pi / 4.0;
        if (is(centre + outline_px * glm::dvec2(std::cos(angle), std::sin(angle))) != here) {
            return false;
        }
    }
    return true;
}

/// True if the light through a pixel meets a face that the eye sees.
bool lights_seen_face(const TestTable& table, const glm::dvec2& pixel) {
    const geometry::RigidTransform prop_from_projector =
        table.table_from_prop.inverse() * table.table_from_projector;
    geometry::PropHit lit;
    return geometry::intersect(table.prop, prop_from_projector.translation,
                               prop_from_projector.direction(table.projector.ray(pixel)), lit) &&
           table.prop.faces[static_cast<std::size_t>(lit.face)].plane.distance(
               table.table_from_prop.inverse().point(table.eye_m)) > 0.0;
}

TEST(Solids, EveryFaceShowsWhatARayCastShows) {
    for (const char* const name : solids) {
        const geometry::PropShape prop = solid::example_prop(name);
        std::set<std::string> shown;
        for (const geometry::Lens& lens : lenses) {
            // Small triangles: a triangle's edge stays straight where the lens bends it.
            SolidRig rig(prop, lens, lens.is_plain() ? rings() : rings(48, 24));
            TestTable table = table_with(prop, lens);
            const ReferenceCast cast(rig.pack, rig.level.metres_per_box);
            std::mt19937 random(31);
            std::size_t both = 0;
            for (int pose = 0; pose < (lens.is_plain() ? 24 : 4); ++pose) {
                table.hold(random);
                scene::plan_frame(prop, rig.level, table.view(), rig.plan);
                for (const scene::FacePlan& face : rig.plan.faces) {
                    shown.insert(prop.faces[static_cast<std::size_t>(face.face)].name);
                }
                const Comparison c = compare(table, cast, rig.places());
                both += c.both;
                EXPECT_LT(c.worst_mm, 0.1) << name << ' ' << lens.k1 << ' ' << pose;
                EXPECT_EQ(c.unexcused, 0U)
                    << name << ' ' << lens.k1 << ' ' << pose << ": of " << c.mismatched << " mismatched";
            }
            std::printf("%s, lens %g: %zu pixels\n", name, lens.k1, both);
            EXPECT_GT(both, 500U);
        }
        EXPECT_EQ(shown.size(), prop.faces.size()) << name;
    }
}

TEST(Solids, ReliefMatchesTheRayCastWithinItsFaces) {
    for (const char* const name : solids) {
        const geometry::PropShape prop = solid::example_prop(name);
        for (const geometry::Lens& lens : {lenses[0], lenses[2]}) {
            SolidReliefRig rig(prop, lens, rings());
            TestTable table = table_with(prop, lens);
            const ReferenceCast truth(rig.pack, rig.level.metres_per_box);
            std::mt19937 random(32);
            for (const bool on_gpu : {false, true}) {
                std::size_t both = 0;
                std::size_t one = 0;
                double mm = 0.0;
                for (int pose = 0; pose < 4; ++pose) {
                    table.hold(random);
                    const image::Image8 picture = rig.one(table, on_gpu ? rig.drawn : rig.raster);
                    const image::ImageFloat places = rig.places();
                    for (int y = 0; y < picture.height; ++y) {
                        for (int x = 0; x < picture.width; ++x) {
                            const ReferenceCast::Hit hit = truth.through_pixel(table, {x + 0.5, y + 0.5});
                            const glm::vec3& point = places.at(x, y);
                            const bool met = !std::isnan(point.x);
                            one += met != hit.found ? 1U : 0U;
                            if (met && hit.found) {
                                both += 1;
                                mm += 1e3 * glm::distance(glm::dvec3(point), hit.point);
                            }
                            const auto is_seen = [&](const glm::dvec2& at) {
                                return lights_seen_face(table, at);
                            };
                            const glm::dvec2 centre(x + 0.5, y + 0.5);
                            EXPECT_TRUE(!met || is_seen(centre) || !is_same_around(centre, false, is_seen))
                                << name << ' ' << pose << ": beside the face at " << x << ", " << y;
                            const glm::u8vec4& code = picture.at(x, y);
                            EXPECT_TRUE(met || code.r + code.g + code.b == 0) << x << ", " << y;
                        }
                    }
                }
                std::printf("%s, lens %g, %s: %zu pixels, %zu in one alone, %.4f mm\n", name, lens.k1,
                            on_gpu ? "GPU" : "processor", both, one, mm / static_cast<double>(both));
                EXPECT_GT(both, 500U);
                EXPECT_LT(one, both / 50);
                EXPECT_LT(mm / static_cast<double>(both), 0.1);
            }
        }
    }
}

/// White, so a pixel's code is its gain; see Relief.HasTheLightAndSoftEdgesOfItsMesh.
TEST(Solids, MeshAndReliefHaveTheSameLightAndSoftEdges) {
    for (const char* const name : solids) {
        const geometry::PropShape prop = solid::example_prop(name, solid::Underside::Dark);
        for (const geometry::Lens& lens : {lenses[0], lenses[2]}) {
            SolidReliefRig rig(prop, lens, white(rings()));
            TestTable table = table_with(prop, lens);
            std::mt19937 random(33);
            std::size_t both = 0;
            std::size_t soft = 0;
            std::size_t off = 0;
            for (int pose = 0; pose < 12; ++pose) {
                table.shuffle(random);
                const scene::LightCompensation light{pose % 2 == 0 ? 0.25 : 1.5};
                // One sample, also in slanting views: a mesh would need a grid for more, a relief does not.
                const auto drawn = [&](const scene::PlacedLevel& which, bool feathered) {
                    scene::plan_frame(prop, which, table.view(light), rig.plan);
                    for (scene::ReliefDraw& draw : rig.plan.relief_draws) {
                        draw.samples = 1;
                    }
                    if (!feathered) {
                        rig.plan.feathers.clear();
                    }
                    rig.draw(render::Redraw::Everything);
                    return rig.picture();
                };
                const image::Image8 mesh = drawn(rig.level, true);
                const image::Image8 relief = drawn(rig.raster, true);
                const image::Image8 sharp = drawn(rig.raster, false);
                for (std::size_t k = 0; k < mesh.texels.size(); ++k) {
                    if (mesh.texels[k].g > 0 && relief.texels[k].g > 0) {
                        both += 1;
                        soft += relief.texels[k].g < sharp.texels[k].g ? 1U : 0U;
                        off += farthest_channel(mesh.texels[k], relief.texels[k]) > 1 ? 1U : 0U;
                    }
                }
            }
            std::printf("%s, lens %g: %zu pixels, %zu of soft edges, %zu off\n", name, lens.k1, both, soft,
                        off);
            EXPECT_GT(both, 1'000U);
            EXPECT_GT(soft, 10U);
            EXPECT_LE(off, both / 1000);
        }
    }
}

/// A picture that covers the table does not shine on the prop.
TEST(Solids, CoverThePicturesOnTheTable) {
    for (const char* const name : solids) {
        const geometry::PropShape prop = solid::example_prop(name);
        for (const geometry::Lens& lens : lenses) {
            SolidRig rig(prop, lens, rings());
            TestTable table = table_with(prop, lens);
            scene::TablePicture everywhere;
            everywhere.corners_m = {
                glm::dvec3(-1.0, 1.0, 0.0), {1.0, 1.0, 0.0}, {1.0, -1.0, 0.0}, {-1.0, -1.0, 0.0}};
            everywhere.texture =
                rig.renderer->store().upload(image::Image<std::uint8_t>(16, 16, 255)).value();
            std::mt19937 random(34);
            for (int pose = 0; pose < 4; ++pose) {
                table.hold(random);
                scene::PlanView view = table.view();
                view.on_table = {&everywhere, 1};
                scene::plan_frame(prop, scene::PlacedLevel{}, view, rig.plan);
                rig.draw(render::Redraw::Everything);
                const image::Image8 picture = rig.picture();
                const geometry::RigidTransform prop_from_projector =
                    table.table_from_prop.inverse() * table.table_from_projector;
                std::size_t dark = 0;
                std::size_t wrong = 0;
                for (int y = 0; y < picture.height; ++y) {
                    for (int x = 0; x < picture.width; ++x) {
                        const auto is_covered = [&](const glm::dvec2& at) {
                            geometry::PropHit hit;
                            return geometry::enter(prop, prop_from_projector.translation,
                                                   prop_from_projector.direction(table.projector.ray(at)),
                                                   hit);
                        };
                        const glm::dvec2 centre(x + 0.5, y + 0.5);
                        const bool covered = is_covered(centre);
                        dark += covered ? 1U : 0U;
                        const bool differs = (picture.at(x, y).g == 0) != covered;
                        wrong += differs && is_same_around(centre, covered, is_covered) ? 1U : 0U;
                    }
                }
                EXPECT_GT(dark, 1'000U);
                EXPECT_EQ(wrong, 0U) << name << ' ' << lens.k1 << ' ' << pose << ": of " << dark << " dark";
            }
        }
    }
}

TEST(Solids, PlanningAFrameAllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    const geometry::PropShape prop = solid::example_prop("gem");
    SolidReliefRig rig(prop, {}, rings());
    TestTable table = table_with(prop, {});
    scene::TablePicture everywhere;
    everywhere.corners_m = {glm::dvec3(-1.0, 1.0, 0.0), {1.0, 1.0, 0.0}, {1.0, -1.0, 0.0}, {-1.0, -1.0, 0.0}};
    everywhere.texture = rig.renderer->store().upload(image::Image<std::uint8_t>(16, 16, 255)).value();
    for (const scene::PlacedLevel& which : {rig.level, rig.raster}) {
        rig.plan = scene::make_plan(prop, which);
        std::mt19937 random(35);
        long counted = 0;
        int shown = 0;
        for (int k = 0; k < 60; ++k) {
            table.hold(random);
            const long before = allocations_so_far();
            scene::PlanView view = table.view(scene::LightCompensation{});
            view.on_table = {&everywhere, 1};
            scene::plan_frame(prop, which, view, rig.plan);
            counted += allocations_so_far() - before;
            const auto on_prop = static_cast<std::size_t>(std::ranges::count_if(
                rig.plan.draws, [](const scene::Draw& draw) { return draw.face >= 0; }));
            shown += (which.relief ? rig.plan.relief_draw_count : on_prop) > 0 ? 1 : 0;
            EXPECT_GT(rig.plan.draws.size(), on_prop) << "the picture on the table " << k;
        }
        EXPECT_EQ(counted, 0) << (which.relief ? "relief" : "mesh");
        EXPECT_GT(shown, 50);
    }
}

} // namespace
} // namespace frustumscreen::synthetic
