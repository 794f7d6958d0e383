// The picture of the screen with levels chosen by distance: as exact as frames.csv says; and both eyes' pictures in one.

#include "app/image/image.h"
#include "tests/programs/program_folder.h"
#include "tests/programs/room_rays.h"
#include "tests/programs/solid_rays.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace frustumscreen::programs {
namespace {

/// A ball with bumps, of some ten thousand triangles.
std::string bumpy_ball() {
    constexpr int around = 96;
    constexpr int up = 48;
    std::string text;
    for (int j = 0; j <= up; ++j) {
        for (int i = 0; i < around; ++i) {
            const double a = 2.0 * std::numbers::pi * i / around;
            const double b = std::numbers::pi * (static_cast<double>(j) / up - 0.5);
            const double r = 1.0 + 0.08 * std::cos(5.0 * a) * std::cos(b) * std::cos(6.0 * b);
            text += fmt::format("v {:.9f} {:.9f} {:.9f}\n", r * std::cos(a) * std::cos(b),
                                r * std::sin(a) * std::cos(b), r * std::sin(b));
        }
    }
    for (int j = 0; j < up; ++j) {
        for (int i = 0; i < around; ++i) {
            const int a = j * around + i + 1;
            const int b = j * around + (i + 1) % around + 1;
            text += j > 0 ? fmt::format("f {} {} {}\n", a, b, b + around) : "";
            text += j < up - 1 ? fmt::format("f {} {} {}\n", a, b + around, a + around) : "";
        }
    }
    return text;
}

class ScreenLevels : public ProgramFolder {
protected:
    void bake() {
        put("ball.obj", bumpy_ball());
        ASSERT_EQ(run("frustumscreen-bake ball.obj -o ball.fspack --prop cube --up z --turn 0 --unlit "
                      "--no-relief --size 64"),
                  0)
            << text("err.txt");
    }
    /// A ball at a depth, seen by a screen of 320 x 180.
    void put_room(double depth_m) const {
        put("room.toml",
            fmt::format("[[object]]\npack = \"ball.fspack\"\nplace_m = [0.1, {}, 0.35]\nsize_m = 0.3\n",
                        depth_m));
    }
    void put_settings(const std::string& stereo) const {
        put("kiosk.toml", fmt::format("[screen]\nroom = \"room.toml\"\nwidth = 320\nheight = "
                                      "180\n[render]\nerror_tolerance_px = 0.05\n[eye]\nstereo = \"{}\"\n",
                                      stereo));
        put("poses.csv",
            "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n0,1,0,0,0,1,0,0,0,1\n0,2,0,-0.3,0.6,1,0,0,0,1\n");
    }
    void render(const std::string& arguments) const {
        ASSERT_EQ(
            run("frustumscreen render --config kiosk.toml --poses poses.csv --output screen " + arguments), 0)
            << text("err.txt");
    }
    /// The value under error_mm of the first frame.
    [[nodiscard]] double told_mm() const {
        std::istringstream lines(text("out/frames.csv"));
        std::string head;
        std::string row;
        std::getline(lines, head);
        std::getline(lines, row);
        std::istringstream names(head);
        std::istringstream values(row);
        std::string name;
        std::string value;
        while (std::getline(names, name, ',') && std::getline(values, value, ',')) {
            if (name == "error_mm") {
                return std::stod(value);
            }
        }
        ADD_FAILURE() << "frames.csv has no column error_mm";
        return NAN;
    }
    [[nodiscard]] image::Image8 picture(const std::string& file) const {
        const std::string png = text(file);
        const Result<image::Image8> read = image::decode_png8(std::as_bytes(std::span(png)));
        EXPECT_TRUE(read);
        return read ? *read : image::Image8();
    }
};

TEST_F(ScreenLevels, ErrorStaysWithinTheReportedError) {
    ASSERT_NO_FATAL_FAILURE(bake());
    put_settings("off");
    const ObjMesh mesh(text("ball.obj"));
    const RayScreen screen{{{{-0.6, 0.7, 0.85}, {0.6, 0.7, 0.85}, {0.6, 0.7, 0.175}, {-0.6, 0.7, 0.175}}},
                           {320, 180}};
    const glm::dvec3 eye(0.0, -0.3, 0.6);
    double coarsest_mm = 0.0;
    for (const double depth_m : {0.4, 1.5, 6.0}) {
        put_room(depth_m);
        ASSERT_NO_FATAL_FAILURE(render("--out out --aov"));
        const RayRoom room({{.mesh = &mesh, .place_m = {0.1, depth_m, 0.35}, .size_m = 0.3}}, 0.0);
        const std::vector<glm::vec3> points = read_points(text("out/frame_00000.pfm"), screen.size);
        double sum_mm = 0.0;
        int hits = 0;
        for (int y = 0; y < screen.size.y; ++y) {
            for (int x = 0; x < screen.size.x; ++x) {
                const glm::vec3& drawn = points[static_cast<std::size_t>(y * screen.size.x + x)];
                const auto truth = room.hit(eye, screen.place(x + 0.5, y + 0.5));
                if (truth && !std::isnan(drawn.x)) {
                    sum_mm += 1e3 * glm::distance(truth->point, glm::dvec3(drawn));
                    ++hits;
                }
            }
        }
        ASSERT_GT(hits, 40);
        const double told = told_mm();
        std::printf("%g m deep: %d pixels, %.3f mm told, %.3f mm off along the rays\n", depth_m, hits, told,
                    sum_mm / hits);
        // Along a slanted ray a point moves farther than the surface is off, twice on a ball's mean.
        EXPECT_LE(sum_mm / hits, 2.0 * told + 0.01) << depth_m;
        EXPECT_GE(told, coarsest_mm) << depth_m; // the deeper, the coarser
        coarsest_mm = told;
    }
    EXPECT_GT(coarsest_mm, 0.05); // a level was saved
}

TEST_F(ScreenLevels, StereoPictureCombinesThePicturesOfEachEye) {
    ASSERT_NO_FATAL_FAILURE(bake());
    put_room(1.5);
    put_settings("anaglyph");
    for (const char* eye : {"left", "right"}) {
        ASSERT_NO_FATAL_FAILURE(render(fmt::format("--out {0} --eye {0}", eye)));
    }
    ASSERT_NO_FATAL_FAILURE(render("--out anaglyph"));
    put_settings("frame_sequential");
    ASSERT_NO_FATAL_FAILURE(render("--out sequential"));
    const image::Image8 left = picture("left/frame_00000.png");
    const image::Image8 right = picture("right/frame_00000.png");
    const image::Image8 both = picture("anaglyph/frame_00000.png");
    const image::Image8 above = picture("sequential/frame_00000.png"); // the left one above the right
    ASSERT_EQ(above.height, 360);
    EXPECT_NE(left.texels, right.texels);
    int other = 0;
    for (int y = 0; y < 180; ++y) {
        for (int x = 0; x < 320; ++x) {
            const glm::u8vec4& of_both = both.at(x, y);
            other +=
                of_both.r == left.at(x, y).r && of_both.g == right.at(x, y).g && of_both.b == right.at(x, y).b
                    ? 0
                    : 1;
            other += above.at(x, y) == left.at(x, y) && above.at(x, y + 180) == right.at(x, y) ? 0 : 1;
        }
    }
    EXPECT_EQ(other, 0);
}

} // namespace
} // namespace frustumscreen::programs
