// Objects whose boxes interlock, each a mesh, a relief of the GPU or one of the processor: every pixel shows the object
// that its ray meets first, and its place. Kim 2008 merges objects whose boxes collide (Fig. 7); here none are merged.

#include "tests/render/counted_new.h"
#include "tests/render/interlocked.h"

#include <cstdlib>
#include <fstream>
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
    return {{ball(), at({-0.3, 0.0, 0.5}, scaled({0.5, 0.4, 0.5}) * turned(30.0, {1.0, 1.0, 0.0}))},
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
        for (const double r : {0.5 * radius, radius}) {
            const SeenPart beside = world.seen(table, pixel + r * glm::dvec2(std::cos(angle), std::sin(angle)));
            if (beside.part != own.part || glm::distance(beside.point, own.point) > jump_m) {
                return false;
            }
        }
    }
    return true;
}

struct Counts {
    std::size_t pixels = 0; ///< that a ray meets a part through
    std::size_t excused = 0, wrong = 0, wrong_places = 0;
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
                   const image::Image8& picture, const image::ImageFloat& places, double radius, Counts& counts) {
    for (std::size_t k = 0; k < truth.size(); ++k) {
        const auto width = static_cast<std::size_t>(picture.width);
        const glm::dvec2 centre(static_cast<double>(k % width) + 0.5, static_cast<double>(k / width) + 0.5);
        counts.pixels += truth[k].part >= 0 ? 1U : 0U;
        const bool right = part_of(picture.texels[k]) == truth[k].part;
        const bool met = !std::isnan(places.texels[k].x);
        const double mm =
            met && truth[k].part >= 0 ? 1e3 * glm::distance(glm::dvec3(places.texels[k]), truth[k].point) : 0.0;
        const bool near = met == (truth[k].part >= 0) && mm < 1.0;
        if (right && near) {
            counts.mm += mm;
        } else if (!is_inside(world, table, centre, truth[k], radius)) {
            ++counts.excused;
        } else {
            counts.wrong += right ? 0U : 1U;
            counts.wrong_places += near ? 0U : 1U;
            counts.worst_mm = std::max(counts.worst_mm, mm);
        }
    }
}

/// Writes a picture where DEPTH_PICTURES names a folder.
void keep(const image::Image8& picture, const std::string& name) {
    if (const char* const folder = std::getenv("DEPTH_PICTURES"); folder != nullptr) {
        const Bytes bytes = image::encode_png(picture);
        std::ofstream(std::string(folder) + "/" + name + ".png", std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
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
           const std::vector<std::vector<Way>>& combinations, int poses, int samples, const geometry::Lens& lens,
           Shuffle shuffle) {
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
                keep(picture, name + "_" + std::to_string(pose) + "_" + name_of(combinations[k]));
            }
        }
    }
    for (std::size_t k = 0; k < combinations.size(); ++k) {
        const Counts& c = counts[k];
        std::printf("%s, %s: %zu pixels, %zu near an edge, %zu of another part, %zu of another place (%.2f mm), "
                    "%.4f mm\n",
                    name.c_str(), name_of(combinations[k]).c_str(), c.pixels, c.excused, c.wrong, c.wrong_places,
                    c.worst_mm, c.mm / static_cast<double>(c.pixels));
        EXPECT_GT(c.pixels, static_cast<std::size_t>(poses) * 1000);
        EXPECT_EQ(c.wrong, 0U) << name << ' ' << name_of(combinations[k]);
        EXPECT_EQ(c.wrong_places, 0U) << name << ' ' << name_of(combinations[k]);
        EXPECT_LT(c.excused, c.pixels / 20);
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

TEST(CellsDepth, LinkedRingsAreRightToThePixelInEveryCombination) {
    check("tori", geometry::make_frustum({}), linked_tori(), all_combinations(2, ways), 40, 1, {},
          &TestTable::shuffle);
}

TEST(CellsDepth, ABoxThroughARingIsRightToThePixelInEveryCombination) {
    check("box", geometry::make_frustum({}), box_through_ring(), all_combinations(2, ways), 40, 1, {},
          &TestTable::shuffle);
}

TEST(CellsDepth, ThreePartsThatOverlapTurnedStretchedAndMirroredAreRightToThePixel) {
    check("balls", geometry::make_frustum({}), overlapping_balls(), all_combinations(3, mesh_or_raster), 40, 1, {},
          &TestTable::shuffle);
}

TEST(CellsDepth, TwoLWhoseBoxesCollideNeedNoMerging) {
    check("l", geometry::make_frustum({}), two_l(), all_combinations(2, ways), 40, 1, {}, &TestTable::shuffle);
}

TEST(CellsDepth, SeveralSamplesAPixelAreRightAwayFromEdges) {
    check("tori4", geometry::make_frustum({}), linked_tori(), all_combinations(2, mesh_or_raster), 8, 4, {},
          &TestTable::shuffle);
}

TEST(CellsDepth, ACubeInTheHandBehindALensThatDistorts) {
    check("cube", geometry::make_cube(0.16), overlapping_balls(), all_combinations(3, mesh_or_raster), 6, 1,
          lenses[2], &TestTable::hold);
}

} // namespace
} // namespace frustumscreen::synthetic
