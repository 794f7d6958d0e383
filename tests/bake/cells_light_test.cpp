// The light on the cells of a world against that on the whole artifact at rest: rays from outside meet both, with their
// textures, and the colours that they find are compared.
#include "app/image/image.h"
#include "assets_baked/bake/level.h"
#include "assets_baked/bake/world_cells.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace frustumscreen::bake {

namespace {

void end_part(SourceMesh& mesh, const std::string& name) {
    mesh.triangle_nodes.resize(mesh.triangles.size(), static_cast<std::uint32_t>(mesh.nodes.size()));
    mesh.nodes.push_back({.name = name, .parent = {}, .parent_from_base = glm::dmat4(1.0), .rest = {}});
}

/// An open chest, a lid that closes it and hangs over its front, and a ball on the lid. The ball and the lid throw
/// shadows on the parts below.
SourceMesh closed_chest() {
    SourceMesh mesh = test::empty_mesh();
    test::add_box(mesh, {-1, -0.7, 0}, {1, 0.7, 0.1});
    test::add_box(mesh, {-1, -0.7, 0.1}, {1, -0.6, 0.8});
    test::add_box(mesh, {-1, 0.6, 0.1}, {1, 0.7, 0.8});
    test::add_box(mesh, {-1, -0.6, 0.1}, {-0.9, 0.6, 0.8});
    test::add_box(mesh, {0.9, -0.6, 0.1}, {1, 0.6, 0.8});
    end_part(mesh, "chest");
    test::add_box(mesh, {-1, -1.1, 0.8}, {1, 0.7, 0.9});
    end_part(mesh, "lid");
    test::add_sphere(mesh, {0.2, 0, 1.25}, 0.35, 24);
    end_part(mesh, "ball");
    return mesh;
}

BakeOptions lit() {
    BakeOptions options;
    options.relief = false;
    options.size = 128;
    options.measuring = 0.1;
    options.up = "z";
    options.table_picture = false;
    return options;
}

/// The finest level of a pack with its texture, placed in the whole's box.
class PlacedLevel {
public:
    PlacedLevel(const pack::Pack& pack, const glm::dmat4& box_from_pack)
        : level_(pack.levels.back()), texture_(pack.textures[level_.texture]),
          mesh_(textured_source(level_, texture_, pack.box_size)) {
        for (glm::dvec3& at : mesh_.positions) {
            at = glm::dvec3(box_from_pack * glm::dvec4(at, 1.0));
        }
        scene_ = std::make_unique<SourceScene>(mesh_, mesh_.positions, Sides::Front);
    }
    [[nodiscard]] const SourceScene& scene() const { return *scene_; }

private:
    const pack::PackLevel& level_;
    const image::Image8& texture_;
    SourceMesh mesh_;
    std::unique_ptr<SourceScene> scene_;
};

struct Seen {
    SurfaceHit hit;
    int code = 0;
};

Seen seen_by(const std::vector<std::unique_ptr<PlacedLevel>>& levels, const glm::vec3& from,
             const glm::vec3& direction) {
    Seen seen;
    for (const std::unique_ptr<PlacedLevel>& each : levels) {
        const SurfaceHit hit = each->scene().trace(from, direction);
        if (hit.hit && (!seen.hit.hit || hit.distance < seen.hit.distance)) {
            seen = {hit, image::srgb8_from_linear(each->scene().colour(hit).x)};
        }
    }
    return seen;
}

/// A whole and its cells at rest, baked alike.
struct Baked {
    pack::Pack pack;
    WorldCells cells;
    std::vector<std::unique_ptr<PlacedLevel>> whole, parts;

    explicit Baked(const SourceMesh& mesh) {
        const BakeOptions options = lit();
        pack = bake(mesh, options).value();
        cells = bake_cells(mesh, make_box_frame(mesh, {"z", 0.0, 0.0}).value(), options);
        std::vector<world::Cell> tree;
        for (const pack::PackCell& each : cells.cells) {
            tree.push_back(each.cell);
        }
        const std::vector<world::CellPose> poses = world::poses_at_rest(tree);
        whole.push_back(std::make_unique<PlacedLevel>(pack, glm::dmat4(1.0)));
        for (std::size_t k = 0; k < cells.geometry.size(); ++k) {
            parts.push_back(std::make_unique<PlacedLevel>(cells.geometry[k], poses[k].box_from_geometry));
        }
    }
};

TEST(CellsLight, MatchesTheWholeAtRestOnVisibleSurfaces) {
    const Baked baked(closed_chest());
    ASSERT_EQ(baked.parts.size(), 3U);
    double squares = 0.0;
    int compared = 0, apart = 0, far_off = 0, darkest = 255;
    constexpr int across = 160;
    for (int side = 0; side < 6; ++side) {
        const double azimuth = side * std::numbers::pi / 3.0;
        const double elevation = side % 2 == 0 ? 0.3 : 0.9;
        const glm::dvec3 from(std::cos(azimuth) * std::cos(elevation),
                              std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
        const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), from));
        const glm::dvec3 up = glm::cross(from, right);
        for (int k = 0; k < across * across; ++k) {
            const double x = (k % across + 0.5) / across - 0.5;
            const double y = (k / across + 0.5) / across - 0.5;
            const glm::vec3 origin(glm::dvec3(0, 0, 0.35) + 2.0 * from + 1.3 * (x * right + y * up));
            const Seen whole = seen_by(baked.whole, origin, glm::vec3(-from));
            const Seen parts = seen_by(baked.parts, origin, glm::vec3(-from));
            if (!whole.hit.hit || !parts.hit.hit) {
                continue;
            }
            if (std::abs(whole.hit.distance - parts.hit.distance) > 1e-3F ||
                glm::dot(whole.hit.normal, parts.hit.normal) < 0.9F) {
                ++apart; // outlines
                continue;
            }
            const int off = std::abs(whole.code - parts.code);
            squares += off * off;
            far_off += off > 10 ? 1 : 0;
            darkest = std::min(darkest, whole.code);
            ++compared;
        }
    }
    ASSERT_GT(compared, 40'000);
    EXPECT_LT(apart, compared / 100);
    EXPECT_LT(std::sqrt(squares / compared), 2.0) << "codes";
    EXPECT_LT(far_off, compared / 200);
    EXPECT_LT(darkest, 120) << "the lid's shadow is looked at";
}

/// Colours along the chest's floor and on the rim, from above, in the pack of the chest alone.
TEST(CellsLight, HiddenSurfacesAreLitLikeThePartAlone) {
    const SourceMesh mesh = closed_chest();
    const Baked baked(mesh);
    SourceMesh open = mesh; // the chest without lid and ball, in a box of its own
    open.triangles.clear();
    open.triangle_materials.clear();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (mesh.triangle_nodes[t] == 0) {
            test::add_triangle(open, mesh.triangles[t][0], mesh.triangles[t][1], mesh.triangles[t][2]);
        }
    }
    open.nodes.clear();
    open.triangle_nodes.clear();
    BakeOptions options = lit();
    options.prop.zone = ViewingZone::all_around();
    const pack::Pack alone = bake(open, options).value();
    const glm::dmat4 box_from_chest = baked.pack.box_from_file * glm::inverse(alone.box_from_file);
    std::vector<std::unique_ptr<PlacedLevel>> expected, made;
    expected.push_back(std::make_unique<PlacedLevel>(alone, box_from_chest));
    std::vector<world::Cell> tree{baked.cells.cells[0].cell};
    made.push_back(std::make_unique<PlacedLevel>(baked.cells.geometry[0],
                                                 world::poses_at_rest(tree)[0].box_from_geometry));
    double squares = 0.0;
    int compared = 0;
    for (int k = 0; k < 80 * 80; ++k) {
        const glm::dvec3 file(-0.97 + 1.94 * (k % 80) / 79.0, -0.57 + 1.24 * (k / 80) / 79.0, 1.0);
        const glm::vec3 from(baked.pack.box_from_file * glm::dvec4(file, 1.0));
        const Seen here = seen_by(made, from, {0, 0, -1});
        const Seen there = seen_by(expected, from, {0, 0, -1});
        ASSERT_TRUE(here.hit.hit && there.hit.hit);
        if (std::abs(here.hit.distance - there.hit.distance) < 1e-3F) {
            squares += (here.code - there.code) * (here.code - there.code);
            ++compared;
        }
    }
    ASSERT_GT(compared, 6000);
    EXPECT_LT(std::sqrt(squares / compared), 2.0);
}

} // namespace

} // namespace frustumscreen::bake
