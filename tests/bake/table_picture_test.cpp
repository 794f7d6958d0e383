// The picture for the table: its frame, outline and colours, compared with shapes of known silhouette.
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/table_picture.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace frustumscreen::bake {
namespace {

pack::Pack baked(const SourceMesh& mesh) {
    BakeOptions options;
    options.relief = false;
    options.size = 32;
    options.up = "z";
    options.unlit = true;
    options.measuring = 0.05;
    Result<pack::Pack> pack = bake(mesh, options);
    EXPECT_TRUE(pack) << (pack ? "" : pack.error().message);
    return *std::move(pack);
}

const image::Image8& of_red_sphere() {
    static const image::Image8 picture = [] {
        SourceMesh mesh = test::empty_mesh();
        test::add_sphere(mesh, {0, 0, 0}, 1.0, 40);
        mesh.materials[0].base_colour = {0.4F, 0.1F, 0.02F, 1.0F}; // linear
        return baked(mesh).table_picture;
    }();
    return picture;
}

double covered(const image::Image8& picture) {
    double sum = 0.0;
    for (const glm::u8vec4& texel : picture.texels) {
        sum += texel.a / 255.0;
    }
    return sum;
}

TEST(TablePicture, sphere_is_a_disc_that_fills_the_frame) {
    const image::Image8& picture = of_red_sphere();
    EXPECT_EQ(std::max(picture.width, picture.height), table_picture_px);
    EXPECT_GE(std::min(picture.width, picture.height), table_picture_px - 3);
    const double disc = 0.25 * std::numbers::pi * (table_picture_px - 2) * (table_picture_px - 2);
    EXPECT_NEAR(covered(picture) / disc, 1.0, 0.01);
    for (int k = 0; k < picture.width; ++k) {
        EXPECT_EQ(picture.at(k, 0).a, 0) << "an empty row all around";
        EXPECT_EQ(picture.at(k, picture.height - 1).a, 0);
    }
}

TEST(TablePicture, has_no_dark_fringe) {
    const image::Image8& picture = of_red_sphere();
    const glm::u8vec4 middle = picture.at(picture.width / 2, picture.height / 2);
    int edge = 0;
    for (const glm::u8vec4& texel : picture.texels) { // also the empty ones, because filters mix them in
        edge += texel.a > 0 && texel.a < 255 ? 1 : 0;
        ASSERT_LE(std::abs(texel.r - middle.r), 2);
        ASSERT_LE(std::abs(texel.g - middle.g), 2);
    }
    EXPECT_GT(edge, 300) << "the outline is smooth";
    EXPECT_EQ(middle.r, 235) << "as bright as the exhibit shows it";
    // The exposure is one factor of linear light for all channels: 0.1 / 0.4 of the code 235.
    EXPECT_NEAR(middle.g, 255.0 * image::srgb_from_linear(0.25 * image::linear_from_srgb(235.0 / 255.0)),
                2.0);
}

TEST(TablePicture, is_seen_from_one_side_and_from_above) {
    SourceMesh mesh = test::empty_mesh();
    test::add_box(mesh, {-1, -1, 0}, {1, 1, 2});
    mesh.materials.resize(4);
    const std::array<glm::vec4, 4> colours{glm::vec4(1, 1, 1, 1), {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
    for (std::size_t k = 0; k < 4; ++k) {
        mesh.materials[k].base_colour = colours[k];
    }
    mesh.triangle_materials = {1, 1, 1, 1, 0, 0, 2, 2, 3, 3, 0, 0}; // +-x red, -y green, +z blue
    const image::Image8 picture = baked(mesh).table_picture;
    std::array<int, 4> seen{};
    for (const glm::u8vec4& texel : picture.texels) {
        if (texel.a > 250) {
            const bool red = texel.r > 150;
            const bool green = texel.g > 150;
            const bool blue = texel.b > 150;
            seen.at(red && green && blue ? 0 : red ? 1 : green ? 2 : 3) += 1;
        }
    }
    EXPECT_GT(seen[2], seen[1]) << "more of the front than of the side";
    EXPECT_GT(seen[1], 5000) << "a side";
    EXPECT_GT(seen[3], 5000) << "the top";
    EXPECT_LT(seen[0], 300) << "nothing of the back";
}

} // namespace
} // namespace frustumscreen::bake
