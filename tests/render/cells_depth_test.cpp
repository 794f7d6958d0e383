// Objects whose boxes interlock, each a mesh, a relief of the GPU or one of the processor: every pixel shows the object
// that its ray meets first, and its place. Kim 2008 merges objects whose boxes collide (Fig. 7); here none are merged.

#include "app/scene/error_estimate.h"
#include "tests/render/counted_new.h"
#include "tests/render/interlocked.h"
#include "tests/render/keep_picture.h"

#include <string>

namespace frustumscreen::synthetic {
namespace {

glm::dmat4 at(const glm::dvec3& place, const glm::dmat4& turn = glm::dmat4(1.0)) {
    return glm::translate(glm::dmat4(1.0), place) * turn;
}
glm::dmat4 turned(double degrees, const glm::dvec3& axis) {
    return glm::rotate(glm::dmat4(1.0), glm::radians(degrees), glm::normalize(axis));
}
glm::dmat4 scaled(const glm::dvec3& factors) {
    return glm::scale(glm::dmat4(1.0), factors);
}

std::vector<WorldObject> linked_tori() {
    return {{torus(0.5, 0.15), at({-0.25, 0.0, 0.3}, turned(20.0, {0.0, 1.0, 0.0}))},
            {torus(0.5, 0.15), at({0.25, 0.0, 0.7}, turned(90.0, {1.0, 0.2, 0.0}))}};
}
std::vector<WorldObject> box_through_ring() {
    return {{box({0.3, 1.6, 0.25}), at({0.0, 0.0, 0.5}, turned(25.0, {1.0, 0.0, 0.3}))},
            {torus(0.5, 0.14), at({0.0, 0.0, 0.65}, turned(80.0, {1.0, 0.1, 0.0}))}};
}
/// Turned, mirrored and stretched along the axes of the world after that, so that angles change too.
std::vector<WorldObject> overlapping_balls() {
    return {
        {ball(), at({-0.3, 0.0, 0.5}, scaled({0.5, 0.4, 0.5}) * turned(30.0, {1.0, 1.0, 0.0}))},
        {ball(), at({0.3, 0.1, 0.5}, scaled({0.35, 0.7, 0.45}) * turned(-50.0, {0.0, 1.0, 1.0}))},
        {torus(0.7, 0.12), at({0.0, 0.0, 0.5}, scaled({-1.0, 0.8, 0.9}) * turned(25.0, {1.0, 0.5, 0.0}))}};
}
/// As the paper's Fig. 7: each L reaches around the other, the one before the other in the middle.
std::vector<WorldObject> two_l() {
    return {{l_shape(), at({-0.5, -0.3, 0.0})},
            {l_shape(), at({0.5, 0.3, 1.1}, turned(180.0, {0.0, 1.0, 0.0}) * turned(12.0, {1.0, 0.0, 0.0}) *
                                                at({0.0, -0.45, 0.0}))}};
}

int part_of(const glm::u8vec4& code) {
    const int brightest = std::max({code.r, code.g, code.b});
    return brightest < 128 ? -1 : brightest == code.r ? 0 : brightest == code.g ? 1 : 2;
}

/// True if all rays within `radius` pixels meet the part that the pixel's own meets, and not far behind or before it.
bool is_inside(const Interlocked& world, const TestTable& table, const glm::dvec2& pixel, const SeenPart& own,
               double radius) {
    constexpr double jump_m = 5e-3;
    for (int k = 0; k < 16; ++k) {
        const double angle = k * std::numbers::pi / 8.0;
        for (const double r : {1.0 / 64.0, 0.25 * radius, 0.5 * radius, radius}) {
            const SeenPart beside =
                world.seen(table, pixel + r * glm::dvec2(std::cos(angle), std::sin(angle)));
            if (beside.part != own.part || glm::distance(beside.point, own.point) > jump_m) {
                return false;
            }
        }
    }
    return true;
}

/// True if the part that is shown lies so close behind the first one that the error of a relief decides.
bool is_tied(const Interlocked& world, const TestTable& table, const glm::dvec2& pixel, const SeenPart& own,
             int shown) {
    constexpr double relief_error_m = 0.15e-3;
    const SeenPart other = world.seen(table, pixel, shown);
    return own.part >= 0 && other.part == shown && glm::distance(other.point, own.point) < relief_error_m;
}

struct Counts {
    std::size_t pixels = 0; ///< that a ray meets a part through
    std::size_t excused = 0, tied = 0, wrong = 0, wrong_places = 0;
    double mm = 0.0, worst_mm = 0.0;
};

std::vector<SeenPart> truth_of(const Interlocked& world, const TestTable& table) {
    std::vector<SeenPart> truth;
    for (int y = 0; y < table.projector.height; ++y) {
        for (int x = 0; x < table.projector.width; ++x) {
            truth.push_back(world.seen(table, {x + 0.5, y + 0.5}));
        }
    }
    return truth;
}

void compare_parts(const Interlocked& world, const TestTable& table, const std::vector<SeenPart>& truth,
                   const image::Image8& picture, const image::ImageFloat& places, double radius,
                   Counts& counts) {
    for (std::size_t k = 0; k < truth.size(); ++k) {
        const auto width = static_cast<std::size_t>(picture.width);
        const glm::dvec2 centre(static_cast<double>(k % width) + 0.5, static_cast<double>(k / width) + 0.5);
        counts.pixels += truth[k].part >= 0 ? 1U : 0U;
        const bool right = part_of(picture.texels[k]) == truth[k].part;
        const bool met = !std::isnan(places.texels[k].x);
        const double mm = met && truth[k].part >= 0
                              ? 1e3 * glm::distance(glm::dvec3(places.texels[k]), truth[k].point)
                              : 0.0;
        const bool near = met == (truth[k].part >= 0) && mm < 1.0;
        const int shown = part_of(picture.texels[k]);
        if (right && near) {
            counts.mm += mm;
        } else if (near && shown >= 0 && is_tied(world, table, centre, truth[k], shown)) {
            ++counts.tied;
        } else if (!is_inside(world, table, centre, truth[k], radius)) {
            ++counts.excused;
        } else {
            counts.wrong += right ? 0U : 1U;
            counts.wrong_places += near ? 0U : 1U;
            counts.worst_mm = std::max(counts.worst_mm, mm);
        }
    }
}

std::string name_of(std::span<const Way> chosen) {
    std::string name;
    for (const Way way : chosen) {
        name += "mgp"[static_cast<std::size_t>(way)];
    }
    return name;
}

using Shuffle = void (TestTable::*)(std::mt19937&);

void check(const std::string& name, const geometry::PropShape& prop, const std::vector<WorldObject>& objects,
           const std::vector<std::vector<Way>>& combinations, int poses, int samples,
           const geometry::Lens& lens, Shuffle shuffle) {
    Interlocked world(prop, objects, samples, lens);
    TestTable table = table_of(lens);
    table.prop = prop;
    std::mt19937 random(46);
    std::vector<Counts> counts(combinations.size());
    for (int pose = 0; pose < poses; ++pose) {
        (table.*shuffle)(random);
        const std::vector<SeenPart> truth = truth_of(world, table);
        for (std::size_t k = 0; k < combinations.size(); ++k) {
            world.choose(combinations[k]);
            const image::Image8 picture = world.picture(table.view());
            compare_parts(world, table, truth, picture, world.places(), samples > 1 ? 1.5 : 1.0, counts[k]);
            if (pose < 3) {
                keep_picture(picture, "DEPTH_PICTURES",
                             name + "_" + std::to_string(pose) + "_" + name_of(combinations[k]));
            }
        }
    }
    for (std::size_t k = 0; k < combinations.size(); ++k) {
        const Counts& c = counts[k];
        std::printf("%s, %s: %zu pixels, %zu near an edge, %zu tied, %zu of another part, %zu of another "
                    "place (%.2f mm), "
                    "%.4f mm\n",
                    name.c_str(), name_of(combinations[k]).c_str(), c.pixels, c.excused, c.tied, c.wrong,
                    c.wrong_places, c.worst_mm, c.mm / static_cast<double>(c.pixels));
        EXPECT_GT(c.pixels, static_cast<std::size_t>(poses) * 1000);
        // A relief of these few texels lacks some ten places in 100,000 (tests/relief/raster_test.cpp).
        const bool all_meshes = std::ranges::count(combinations[k], Way::Mesh) == std::ssize(combinations[k]);
        const std::size_t lacking = all_meshes ? 0 : c.pixels / 5000;
        EXPECT_LE(c.wrong, lacking) << name << ' ' << name_of(combinations[k]);
        EXPECT_LE(c.wrong_places, lacking) << name << ' ' << name_of(combinations[k]);
        EXPECT_LT(c.excused, c.pixels / (samples > 1 ? 10 : 20));
        EXPECT_LT(c.tied, c.pixels / 200);
    }
}

/// Every way for each of `parts` parts.
std::vector<std::vector<Way>> all_combinations(std::size_t parts, std::span<const Way> of) {
    std::vector<std::vector<Way>> made{{}};
    for (std::size_t k = 0; k < parts; ++k) {
        std::vector<std::vector<Way>> longer;
        for (const std::vector<Way>& start : made) {
            for (const Way way : of) {
                longer.push_back(start);
                longer.back().push_back(way);
            }
        }
        made = longer;
    }
    return made;
}

constexpr std::array<Way, 2> mesh_or_raster{Way::Mesh, Way::RasterizedRelief};

constexpr int usual_poses = 8;
constexpr int long_poses = 40;

void check_linked_rings(int poses) {
    check("tori", geometry::make_frustum({}), linked_tori(), all_combinations(2, ways), poses, 1, {},
          &TestTable::shuffle);
}
void check_box_through_ring(int poses) {
    check("box", geometry::make_frustum({}), box_through_ring(), all_combinations(2, ways), poses, 1, {},
          &TestTable::shuffle);
}
void check_overlapping_balls(int poses) {
    check("balls", geometry::make_frustum({}), overlapping_balls(), all_combinations(3, mesh_or_raster),
          poses, 1, {}, &TestTable::shuffle);
}
void check_two_l(int poses) {
    check("l", geometry::make_frustum({}), two_l(), all_combinations(2, ways), poses, 1, {},
          &TestTable::shuffle);
}

TEST(CellsDepth, LinkedRingsMatchRaysInEveryCombination) {
    check_linked_rings(usual_poses);
}

TEST(CellsDepth, BoxThroughARingMatchesRaysInEveryCombination) {
    check_box_through_ring(usual_poses);
}

TEST(CellsDepth, ThreeOverlappingTransformedPartsMatchRays) {
    check_overlapping_balls(usual_poses);
}

TEST(CellsDepth, TwoLShapesWithCollidingBoxesMatchRays) {
    check_two_l(usual_poses);
}

TEST(CellsDepth, DISABLED_ObjectsMatchRaysAtManyPoses) {
    check_linked_rings(long_poses);
    check_box_through_ring(long_poses);
    check_overlapping_balls(long_poses);
    check_two_l(long_poses);
}

TEST(CellsDepth, SeveralSamplesAPixelAreRightAwayFromEdges) {
    check("tori4", geometry::make_frustum({}), linked_tori(), all_combinations(2, mesh_or_raster), 8, 4, {},
          &TestTable::shuffle);
}

TEST(CellsDepth, HeldCubeBehindADistortingLensMatchesRays) {
    check("cube", geometry::make_cube(0.16), overlapping_balls(), all_combinations(3, mesh_or_raster), 6, 1,
          lenses[2], &TestTable::hold);
}

/// Linked rings at one pose, each in a light of its own.
struct LitRings {
    Interlocked world{geometry::make_frustum({}), linked_tori(), 1};
    TestTable table = table_of({});

    LitRings() {
        std::mt19937 random(3);
        table.shuffle(random);
    }
    [[nodiscard]] image::Image8 picture(std::span<const Way> chosen, const std::array<glm::vec3, 2>& lights,
                                        double brightness) {
        world.choose(chosen);
        for (std::size_t k = 0; k < lights.size(); ++k) {
            world.parts[k].level.light = lights[k];
        }
        scene::PlanView view = table.view();
        view.brightness = brightness;
        return world.picture(view);
    }
};

/// IEC 61966-2-1.
double code_of(double linear) {
    return 255.0 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
}

TEST(CellsDepth, EachPartHasItsLight) {
    LitRings rings;
    const std::array<glm::vec3, 2> lights{glm::vec3(0.3F, 1.0F, 1.0F), glm::vec3(0.2F, 1.6F, 1.0F)};
    for (const double brightness : {1.0, 0.5}) {
        const std::array<double, 2> expected{code_of(0.3 * brightness),
                                             code_of(std::min(1.6 * brightness, 1.0))};
        for (const std::vector<Way>& chosen : all_combinations(2, ways)) {
            const image::Image8 picture = rings.picture(chosen, lights, brightness);
            std::array<int, 2> counted{};
            for (const glm::u8vec4& code : picture.texels) {
                for (int part = 0; part < 2; ++part) {
                    if (code[part] > 0) {
                        ++counted[static_cast<std::size_t>(part)];
                        EXPECT_NEAR(code[part], expected[static_cast<std::size_t>(part)], 2.0)
                            << name_of(chosen);
                    }
                }
            }
            EXPECT_GT(std::min(counted[0], counted[1]), 200) << name_of(chosen);
        }
    }
}

/// The first ring fades from a relief to its mesh, in red and in half of the light, so that the pixels differ.
TEST(CellsDepth, FadingCellTakesEachPixelFromOneOfItsLevels) {
    LitRings rings;
    const std::array<glm::vec3, 2> bright{glm::vec3(1.0F), glm::vec3(1.0F)};
    const std::array<glm::vec3, 2> dim{glm::vec3(0.5F), glm::vec3(1.0F)};
    for (const Way other : {Way::Mesh, Way::RasterizedRelief}) {
        for (const Way arriving : {Way::Mesh, Way::RasterizedRelief}) {
            const image::Image8 from = rings.picture(std::array{Way::RasterizedRelief, other}, bright, 1.0);
            const scene::PlacedLevel leaving = rings.world.parts[0].level;
            const image::Image8 to = rings.picture(std::array{arriving, other}, dim, 1.0);
            const std::array<scene::Part, 2> fading = scene::fade(leaving, rings.world.parts[0].level, 0.25);
            const scene::Part still = rings.world.parts[1];
            const std::array<scene::Part, 3> parts{fading[0], fading[1], still};
            rings.world.plan = scene::make_plan(rings.world.prop, 20'000, parts.size());
            const image::Image8 middle = rings.world.picture(rings.table.view(), parts);
            std::size_t differing = 0;
            std::size_t arrived = 0;
            std::size_t neither = 0;
            for (std::size_t k = 0; k < middle.texels.size(); ++k) {
                const bool is_from = farthest_channel(middle.texels[k], from.texels[k]) <= 1;
                const bool is_to = farthest_channel(middle.texels[k], to.texels[k]) <= 1;
                neither += is_from || is_to ? 0U : 1U;
                const bool differ = farthest_channel(from.texels[k], to.texels[k]) > 2;
                differing += differ ? 1U : 0U;
                arrived += differ && is_to ? 1U : 0U;
            }
            EXPECT_GT(differing, 300U);
            EXPECT_LE(neither, 2U) << static_cast<int>(other) << static_cast<int>(arriving);
            EXPECT_NEAR(static_cast<double>(arrived) / static_cast<double>(differing), 0.25, 0.05);
        }
    }
}

TEST(CellsDepth, AFrameAllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    Interlocked world(geometry::make_frustum({}), overlapping_balls(), 4);
    TestTable table = table_of({});
    std::mt19937 random(5);
    std::vector<TestTable> tables;
    for (int k = 0; k < 10; ++k) {
        table.shuffle(random);
        tables.push_back(table);
    }
    world.choose(std::array{Way::RasterizedRelief, Way::Mesh, Way::RasterizedRelief});
    world.parts[0].level.light = glm::vec3(0.5F);
    long counted = 0;
    for (int k = 0; k < 40; ++k) { // the first rounds reserve memory for the fullest view
        const TestTable& from = tables[static_cast<std::size_t>(k) % tables.size()];
        const long before = allocations_so_far();
        scene::plan_frame(world.prop, world.parts, from.view(scene::LightCompensation{}), world.plan);
        static_cast<void>(world.renderer->draw(world.plan,
                                               {world.display->framebuffer(), world.display->buffer_age()},
                                               render::Redraw::Everything));
        counted += k < 30 ? 0 : allocations_so_far() - before;
    }
    EXPECT_EQ(counted, 0);
}

/// A quarter turn of the part, and of the eye with the part still: the frustum is square.
TEST(CellsDepth, ErrorEstimateFollowsTheRotationOfThePart) {
    Interlocked world(geometry::make_frustum({}), linked_tori(), 1);
    world.choose(std::array{Way::Mesh, Way::Mesh});
    scene::PlacedLevel still = world.parts[0].level;
    still.prop_from_placed = glm::dmat4(1.0);
    scene::PlacedLevel moved = still;
    moved.prop_from_placed = turned(90.0, {0.0, 0.0, 1.0});
    scene::SeenLevel seen;
    for (const double side : {1.0, -1.0}) {
        pack::SeenEye eye;
        eye.towards = {side, 0.0, 0.0};
        eye.patches[0] = {{0.1 * side, 0.05, 0.2}, 1.0};
        seen.eyes.push_back(eye);
        pack::SeenError error{};
        error.mean_box = side > 0.0 ? 1e-3F : 2e-3F;
        error.p95_box = 2.0F * error.mean_box;
        error.patches_box.fill(error.mean_box);
        seen.errors.push_back(error);
    }
    const auto estimate = [&](const scene::PlacedLevel& level, const glm::dvec3& eye_m) {
        TestTable table = table_of({});
        table.eye_m = eye_m;
        const scene::Part part{level, std::nullopt};
        scene::plan_frame(world.prop, std::span(&part, 1), table.view(), world.plan);
        return scene::estimate_error(seen, world.prop, level, table.view(), world.plan).value();
    };
    const scene::ErrorEstimate before = estimate(still, {0.5, 0.1, 0.5});
    const scene::ErrorEstimate after = estimate(moved, {-0.1, 0.5, 0.5}); // turned with the part
    EXPECT_NEAR(after.mean_mm, before.mean_mm, 1e-6 * before.mean_mm);
    EXPECT_NEAR(after.p95_mm, before.p95_mm, 1e-6 * before.p95_mm);
    EXPECT_GT(estimate(moved, {0.1, -0.5, 0.5}).mean_mm, 1.5 * before.mean_mm);
}

} // namespace
} // namespace frustumscreen::synthetic
