// The preview's turning view against plain geometry: a box with one red side, whose middle is a hotspot. Where the
// hotspot is visible in the picture, the projector must have lit red there, seen through the prop; elsewhere not.
#include "app/programs/preview/turn_pictures.h"
#include "tests/programs/curator_folder.h"

namespace frustumscreen::programs {
namespace {

/// A box whose red side faces -Y, the visitor.
constexpr const char* box =
    "mtllib box.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv -1 -1 2\nv 1 -1 2\nv 1 1 2\nv -1 1 2\n"
    "usemtl red\nf 1 2 6 5\nusemtl blue\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 7 8\nf 1 4 3 2\n";

class Turn : public CuratorFolder {
protected:
    void SetUp() override {
        put("box/box.obj", box);
        put("box/box.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    }
    [[nodiscard]] int bake(const std::string& prop) const {
        put("box/artifact.toml", "scan = \"box.obj\"\nsize = 32\nunlit = true\nprop = \"" + prop +
                                     "\"\n[placement]\nup = \"z\"\nturn_deg = 0.0\n"
                                     "[[texts]]\nlanguage = \"en\"\n"
                                     "[[hotspots]]\npoint = [0.0, -1.0, 1.0]\nlabels = { en = \"Red\" }\n");
        return run("frustumscreen-bake box -o box.fspack");
    }
    /// Expects the red side's colour at its middle exactly in the pictures in which it is seen.
    void expect_red_where_seen() const {
        TurnOptions options;
        options.columns = 4;
        options.rows = 2;
        options.size = {200, 140};
        options.projected_width = 960;
        const Result<TurnPictures> turn = turn_pictures(folder / "box.fspack", options);
        ASSERT_TRUE(turn) << turn.error().message;
        ASSERT_EQ(turn->frames, 8);
        ASSERT_EQ(turn->marks.size(), 1U);
        EXPECT_EQ(turn->sheet.width, 800);
        EXPECT_EQ(turn->sheet.height, 280);
        for (int k = 0; k < turn->frames; ++k) {
            const MarkPlace& mark = turn->marks[0][static_cast<std::size_t>(k)];
            const int x = k % 4 * 200 + static_cast<int>(mark.x * 200);
            const int y = k / 4 * 140 + static_cast<int>(mark.y * 140);
            const glm::u8vec4 colour = turn->sheet.at(x, y);
            EXPECT_EQ(mark.seen, k <= 1 || k == 7)
                << "a side that is turned by 90 degrees or more is hidden: " << k;
            EXPECT_EQ(colour.r > 60 && colour.r > 2 * colour.b, mark.seen)
                << k << ": " << int{colour.r} << ' ' << int{colour.g} << ' ' << int{colour.b};
        }
        // With a counter-clockwise turn seen from above, the front moves to the visitor's right.
        EXPECT_NEAR(turn->marks[0][0].x, 0.5, 0.01);
        EXPECT_GT(turn->marks[0][1].x, 0.52);
        EXPECT_LT(turn->marks[0][7].x, 0.48);
    }
};

TEST_F(Turn, FrustumShowsTheSideFacingTheVisitor) {
    ASSERT_EQ(bake("frustum"), 0) << text("err.txt");
    expect_red_where_seen();
}

TEST_F(Turn, CubeShowsTheSideFacingTheVisitor) {
    ASSERT_EQ(bake("cube"), 0) << text("err.txt");
    expect_red_where_seen();
}

} // namespace
} // namespace frustumscreen::programs
