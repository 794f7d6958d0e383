// Light by the file's own normals. On a convex body of flat walls nothing casts a shadow, so each wall with one normal
// has one value.
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/level.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen::bake {
namespace {

enum class Normals { None, Flat, Smooth };

double middle_of(int wall, int walls) {
    return 2.0 * std::numbers::pi * wall / walls;
}

/// A prism that stands on z = 0, as high as it is wide; its corners are at the middles between the walls' angles.
SourceMesh prism(int walls, Normals kind) {
    SourceMesh mesh = test::empty_mesh();
    const double half = std::numbers::pi / walls;
    const auto add = [&](const glm::dvec3& position, const glm::dvec3& normal) {
        mesh.positions.push_back(position);
        if (kind != Normals::None) {
            mesh.normals.emplace_back(glm::normalize(normal));
        }
        return static_cast<std::uint32_t>(mesh.positions.size() - 1);
    };
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        test::add_triangle(mesh, a, b, c);
        test::add_triangle(mesh, a, c, d);
    };
    for (int wall = 0; wall < walls; ++wall) {
        const double middle = middle_of(wall, walls);
        const glm::dvec3 out(std::cos(middle), std::sin(middle), 0.0);
        const glm::dvec3 left(std::cos(middle - half), std::sin(middle - half), 0.0);
        const glm::dvec3 right(std::cos(middle + half), std::sin(middle + half), 0.0);
        const glm::dvec3 up(0, 0, 1);
        const bool smooth = kind == Normals::Smooth;
        quad(add(0.5 * left, smooth ? left : out), add(0.5 * right, smooth ? right : out),
             add(0.5 * right + up, smooth ? right : out), add(0.5 * left + up, smooth ? left : out));
        const std::uint32_t centre = add(up, up);
        test::add_triangle(mesh, centre, add(0.5 * left + up, up), add(0.5 * right + up, up));
    }
    return mesh;
}

/// The baked pack, with a look at its picture.
class LitPrism {
public:
    LitPrism(int walls, Normals kind) : walls_(walls) {
        BakeOptions options;
        options.relief = false;
        options.size = 128;
        options.measuring = 0.1;
        options.up = "z";
        Result<pack::Pack> baked = bake(prism(walls, kind), options);
        EXPECT_TRUE(baked);
        pack_ = *std::move(baked);
        const pack::PackLevel& level = pack_.levels.back();
        surface_ = textured_source(level, pack_.textures[level.texture], pack_.box_size);
        scene_ = std::make_unique<SourceScene>(surface_, surface_.positions);
    }
    /// The code on a wall at half height; `across`: -0.5 to 0.5, from the wall's one edge to the other.
    [[nodiscard]] double code(int wall, double across) const {
        const double middle = middle_of(wall, walls_);
        const double half = std::numbers::pi / walls_;
        const glm::vec3 out(std::cos(middle), std::sin(middle), 0.0);
        const glm::vec3 along(-out.y, out.x, 0.0F);
        const auto aside = static_cast<float>(across * std::sin(half)); // the wall is sin(half) wide
        const SurfaceHit hit = scene_->trace(out + along * aside + glm::vec3(0, 0, 0.5F), -out);
        EXPECT_TRUE(hit.hit);
        return 255.0 * image::srgb_from_linear(static_cast<double>(scene_->colour(hit).x));
    }
    [[nodiscard]] const image::Image8& picture() const { return pack_.textures.front(); }

private:
    int walls_;
    pack::Pack pack_;
    SourceMesh surface_;
    std::unique_ptr<SourceScene> scene_;
};

/// The largest difference of codes inside one wall, away from its edges.
double spread_in_walls(const LitPrism& prism, int walls) {
    double largest = 0.0;
    for (int wall = 0; wall < walls; ++wall) {
        double low = 255.0;
        double high = 0.0;
        for (const double across : {-0.25, -0.1, 0.0, 0.1, 0.25}) {
            low = std::min(low, prism.code(wall, across));
            high = std::max(high, prism.code(wall, across));
        }
        largest = std::max(largest, high - low);
    }
    return largest;
}

/// The largest difference of codes close to both sides of an edge.
double jump_at_edges(const LitPrism& prism, int walls) {
    double largest = 0.0;
    for (int wall = 0; wall < walls; ++wall) {
        largest = std::max(largest, std::abs(prism.code(wall, 0.45) - prism.code((wall + 1) % walls, -0.45)));
    }
    return largest;
}

TEST(FileNormals, FlatNormalsGiveOneValuePerWall) {
    constexpr int walls = 8; // 45 degrees, which count as smooth without normals
    EXPECT_GT(spread_in_walls(LitPrism(walls, Normals::None), walls), 8.0);
    EXPECT_LE(spread_in_walls(LitPrism(walls, Normals::Flat), walls), 2.0);
}

TEST(FileNormals, SmoothNormalsSoftenAnEdge) {
    constexpr int walls = 6; // 60 degrees, which count as an edge without normals
    const double hard = jump_at_edges(LitPrism(walls, Normals::None), walls);
    EXPECT_GT(hard, 20.0);
    EXPECT_LT(jump_at_edges(LitPrism(walls, Normals::Smooth), walls), 0.4 * hard);
}

TEST(FileNormals, NormalsAveragedOverASharpEdgeAreIgnored) {
    constexpr int walls = 4; // smooth normals lean by 45 degrees
    EXPECT_EQ(LitPrism(walls, Normals::Smooth).picture().texels,
              LitPrism(walls, Normals::None).picture().texels);
}

TEST(FileNormals, InwardNormalsGiveTheSameLight) {
    SourceMesh mesh = prism(6, Normals::Smooth);
    SourceMesh inward = mesh;
    for (glm::vec3& normal : inward.normals) {
        normal = -normal;
    }
    BakeOptions options;
    options.relief = false;
    options.size = 64;
    options.measuring = 0.1;
    const Result<pack::Pack> one = bake(mesh, options);
    const Result<pack::Pack> other = bake(inward, options);
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->textures.front().texels, other->textures.front().texels);
}

} // namespace
} // namespace frustumscreen::bake
