// The picture of the screen behind the table, made only by the programs, against rays through its pixels: objects before and
// behind its plane, boxes that interlock, one that moves, for any eye and for both.

#include "app/image/image.h"
#include "tests/programs/program_folder.h"
#include "tests/programs/room_rays.h"
#include "tests/programs/solid_rays.h"

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::programs {
namespace {

constexpr double interocular_m = 0.063;
constexpr int eyes_of_a_kind = 8;

/// A rectangle that leans and is rolled a little, as a screen on a wall's arm.
RayScreen leaning_screen() {
    const glm::dvec3 right = glm::normalize(glm::dvec3(1.0, 0.06, 0.03));
    const glm::dvec3 down = glm::normalize(glm::cross(glm::cross(right, glm::dvec3(0.0, 0.15, -1.0)), right));
    const glm::dvec3 middle(0.05, 0.7, 0.5);
    const glm::dvec3 across = 1.2 * right;
    const glm::dvec3 along = 0.675 * down;
    return {{middle - 0.5 * across - 0.5 * along, middle + 0.5 * across - 0.5 * along,
             middle + 0.5 * across + 0.5 * along, middle - 0.5 * across + 0.5 * along},
            {320, 180}};
}

/// A ball of 16 x 8 patches that are unequal, so that no symmetry hides a turn.
std::string ball() {
    std::string text;
    constexpr int around = 16;
    constexpr int up = 8;
    for (int j = 0; j <= up; ++j) {
        for (int i = 0; i < around; ++i) {
            const double a = 2.0 * std::numbers::pi * i / around;
            const double b = std::numbers::pi * (static_cast<double>(j) / up - 0.5);
            const double r = 1.0 + 0.2 * std::cos(3.0 * a) * std::cos(b);
            text += fmt::format("v {:.9f} {:.9f} {:.9f}\n", r * std::cos(a) * std::cos(b),
                                r * std::sin(a) * std::cos(b), 1.3 * std::sin(b));
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
constexpr const char* box =
    "v -1 -0.5 0\nv 1 -0.5 0\nv 1 0.5 0\nv -1 0.5 0\nv -1 -0.5 0.7\nv 1 -0.5 0.7\n"
    "v 1 0.5 0.7\nv -1 0.5 0.7\nf 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\n"
    "f 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\nf 4 1 5\nf 4 5 8\n";

struct Compared {
    long hits = 0;    ///< pixels at which rays meet an object
    long outline = 0; ///< pixels beside one of another object, or of none
    long edge = 0;    ///< pixels that differ, and agree with a ray at most a tenth of a pixel beside
    long wrong = 0;   ///< the others that differ
    double worst_m = 0.0;
    std::map<std::size_t, long> of_object{};
    long miscoloured = 0;   ///< pixels of the picture that are dark on an object, or lit beside all
    long before_screen = 0; ///< hits nearer to the eye than the screen
};

class ScreenPicture : public ProgramFolder {
protected:
    /// A head: between its eyes, and the axis from the left to the right one.
    struct Head {
        glm::dvec3 middle_m{0.0};
        double yaw = 0.0;
        [[nodiscard]] glm::dvec3 eye(double side) const {
            return middle_m + 0.5 * side * interocular_m * glm::dvec3(std::cos(yaw), std::sin(yaw), 0.0);
        }
    };

    /// Without reliefs: a picture is all relief or all polygons, whichever is quicker, and here the finest polygons count.
    void bake(const std::string& name, const std::string& obj) {
        put(name + ".obj", obj);
        ASSERT_EQ(run(fmt::format("frustumscreen-bake {0}.obj -o {0}.fspack --prop cube --up z --turn 0 "
                                  "--unlit --size 64 --no-relief",
                                  name)),
                  0)
            << text("err.txt");
    }
    void write_scene() {
        write_star();
        bake("star", text("star.obj"));
        bake("box", box);
        bake("ball", ball());
        meshes_.emplace_back(text("star.obj"));
        meshes_.emplace_back(box);
        meshes_.emplace_back(ball());
        objects_ = {{.mesh = &meshes_[0], .place_m = {-0.35, 1.3, 0.2}, .turn_deg = 33.0, .size_m = 0.5},
                    // Before the screen's plane.
                    {.mesh = &meshes_[2], .place_m = {0.15, 0.25, 0.45}, .turn_deg = -20.0, .size_m = 0.14},
                    {.mesh = &meshes_[1], .place_m = {0.35, 1.5, 0.3}, .turn_deg = 20.0, .size_m = 0.6},
                    {.mesh = &meshes_[1], .place_m = {0.3, 1.45, 0.35}, .turn_deg = 110.0, .size_m = 0.5},
                    // It moves, far behind.
                    {.mesh = &meshes_[2],
                     .place_m = {-0.2, 4.0, 0.1},
                     .turn_deg = 0.0,
                     .size_m = 1.2,
                     .turns_per_minute = 20.0,
                     .sway_m = {1.0, 0.3, 0.1},
                     .sway_s = 1.7}};
        const std::array<const char*, 5> packs{"star", "ball", "box", "box", "ball"};
        std::string room;
        for (std::size_t k = 0; k < objects_.size(); ++k) {
            const Placed& o = objects_[k];
            room += fmt::format(
                "[[object]]\npack = \"{}.fspack\"\nplace_m = [{}, {}, {}]\nturn_deg = {}\nsize_m = {}\n"
                "turns_per_minute = {}\nsway_m = [{}, {}, {}]\nsway_s = {}\n",
                packs[k], o.place_m.x, o.place_m.y, o.place_m.z, o.turn_deg, o.size_m, o.turns_per_minute,
                o.sway_m.x, o.sway_m.y, o.sway_m.z, o.sway_s);
        }
        put("room.toml", room);
        std::string corners;
        for (const glm::dvec3& c : screen_.corners_m) {
            corners += fmt::format("[{:.17g}, {:.17g}, {:.17g}], ", c.x, c.y, c.z);
        }
        for (const char* stereo : {"off", "anaglyph"}) {
            put(fmt::format("{}.toml", stereo),
                fmt::format("[screen]\nroom = \"room.toml\"\ncorners_m = [{}]\nwidth = {}\nheight = {}\n"
                            "[eye]\nstereo = \"{}\"\ninterocular_mm = {}\n"
                            "[render]\nerror_tolerance_px = 0.01\n",
                            corners, screen_.size.x, screen_.size.y, stereo, 1e3 * interocular_m));
        }
    }
    [[nodiscard]] std::vector<Head> put_heads(unsigned seed) const {
        std::mt19937 random(seed);
        const auto within = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        std::vector<Head> heads;
        std::string text = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
        for (int k = 0; k < eyes_of_a_kind; ++k) {
            const Head head{{within(-0.6, 0.6), within(-1.2, -0.1), within(0.25, 1.0)}, within(-0.6, 0.6)};
            text += fmt::format(
                "{0},1,0,0,0,1,0,0,0,1\n{0},2,{1:.17g},{2:.17g},{3:.17g},{4:.17g},0,0,{5:.17g},1\n",
                100'000 * k, head.middle_m.x, head.middle_m.y, head.middle_m.z, std::cos(0.5 * head.yaw),
                std::sin(0.5 * head.yaw));
            heads.push_back(head);
        }
        put("poses.csv", text);
        return heads;
    }

    void compare(const std::vector<glm::vec3>& drawn, const glm::dvec3& eye, double seconds,
                 Compared& sum) const {
        const RayRoom room(objects_, seconds);
        const glm::ivec2 size = screen_.size;
        const auto truth = [&](double x, double y) { return room.hit(eye, screen_.place(x, y)); };
        std::vector<std::size_t> ids(drawn.size(), objects_.size());
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const std::size_t at = static_cast<std::size_t>(y * size.x + x);
                const std::optional<RoomHit> hit = truth(x + 0.5, y + 0.5);
                ids[at] = hit ? hit->object : objects_.size();
                if (hit) {
                    ++sum.hits;
                    ++sum.of_object[hit->object];
                    const bool before =
                        glm::distance(hit->point, eye) < glm::distance(screen_.place(x + 0.5, y + 0.5), eye);
                    sum.before_screen += before ? 1 : 0;
                }
                count(
                    drawn[at], hit, [&](double dx, double dy) { return truth(x + 0.5 + dx, y + 0.5 + dy); },
                    sum);
                const bool beside = (x > 0 && ids[at - 1] != ids[at]) ||
                                    (y > 0 && ids[at - static_cast<std::size_t>(size.x)] != ids[at]);
                sum.outline += beside ? 1 : 0;
            }
        }
    }
    /// The picture lights the pixels that show an object, and no other; those beside an outline may be mixed.
    void compare_colours(const std::string& stem, Compared& sum) const {
        const std::string png = text(stem + ".png");
        const Result<image::Image8> picture = image::decode_png8(std::as_bytes(std::span(png)));
        ASSERT_TRUE(picture) << picture.error().message;
        const std::vector<glm::vec3> points = read_points(text(stem + ".pfm"), screen_.size);
        const auto shows = [&](int x, int y) {
            return !std::isnan(points[static_cast<std::size_t>(y * screen_.size.x + x)].x);
        };
        for (int y = 1; y + 1 < screen_.size.y; ++y) {
            for (int x = 1; x + 1 < screen_.size.x; ++x) {
                int hits = 0;
                for (int k = 0; k < 9; ++k) {
                    hits += shows(x + k % 3 - 1, y + k / 3 - 1) ? 1 : 0;
                }
                const auto& texel = picture->texels[static_cast<std::size_t>(y * screen_.size.x + x)];
                const bool lit = texel[0] > 40 && texel[1] > 40 && texel[2] > 40;
                const bool dark = texel[0] == 0 && texel[1] == 0 && texel[2] == 0;
                sum.miscoloured += (hits == 9 && !lit) || (hits == 0 && !dark) ? 1 : 0;
            }
        }
    }
    template <typename Truth>
    static void count(const glm::vec3& drawn, const std::optional<RoomHit>& hit, const Truth& beside,
                      Compared& sum) {
        constexpr double close_m = 1e-4;
        const auto off_m = [&](const std::optional<RoomHit>& truth) {
            if (std::isnan(drawn.x) || !truth) {
                return std::isnan(drawn.x) && !truth ? 0.0 : 1e9;
            }
            return glm::distance(truth->point, glm::dvec3(drawn));
        };
        const double off = off_m(hit);
        if (off <= close_m) {
            sum.worst_m = std::fmax(sum.worst_m, off);
            return;
        }
        const auto ring = [&](double step_px, const auto& accept) {
            constexpr int ways = 24;
            for (int k = 0; k < ways; ++k) {
                const double angle = 2.0 * std::numbers::pi * k / ways;
                if (accept(beside(step_px * std::cos(angle), step_px * std::sin(angle)))) {
                    return true;
                }
            }
            return false;
        };
        // A rasterizer places corners in steps of 1/256 of a pixel, and goes on in a triangle's plane up to there: by as much as
        // the rays around it differ.
        std::map<std::size_t, std::vector<glm::dvec3>> around;
        ring(raster_step_px, [&](const std::optional<RoomHit>& truth) {
            if (truth) {
                around[truth->object].push_back(truth->point);
            }
            return false;
        });
        for (const auto& [object, points] : around) {
            double span_m = 0.0;
            double nearest_m = off_m(std::optional(RoomHit{object, points.front()}));
            for (const glm::dvec3& point : points) {
                span_m = std::fmax(span_m, glm::distance(points.front(), point));
                nearest_m = std::fmin(nearest_m, off_m(std::optional(RoomHit{object, point})));
            }
            if (nearest_m <= span_m + close_m) {
                sum.edge += hit && hit->object == object ? 0 : 1;
                return;
            }
        }
        for (const double step_px : {0.02, 0.05, 0.1}) {
            if (ring(step_px, [&](const std::optional<RoomHit>& truth) { return off_m(truth) <= close_m; })) {
                ++sum.edge;
                return;
            }
        }
        ++sum.wrong;
    }

    std::vector<ObjMesh> meshes_;
    std::vector<Placed> objects_;
    RayScreen screen_ = leaning_screen();
};

TEST_F(ScreenPicture, MatchesRaysForEachEye) {
    meshes_.reserve(3);
    ASSERT_NO_FATAL_FAILURE(write_scene());
    Compared sum;
    unsigned seed = 47;
    for (const auto& [eye, side] :
         {std::pair("off", 0.0), std::pair("left", -1.0), std::pair("right", 1.0)}) {
        const std::vector<Head> heads = put_heads(seed++);
        ASSERT_EQ(run(fmt::format(
                      "frustumscreen render --config {} --poses poses.csv --output screen --out out --aov",
                      side == 0.0 ? "off.toml" : fmt::format("anaglyph.toml --eye {}", eye))),
                  0)
            << text("err.txt");
        EXPECT_EQ(text("err.txt"), "");
        for (std::size_t k = 0; k < heads.size(); ++k) {
            compare(read_points(text(fmt::format("out/frame_{:05}.pfm", k)), screen_.size),
                    heads[k].eye(side), 0.1 * static_cast<double>(k), sum);
            compare_colours(fmt::format("out/frame_{:05}", k), sum);
        }
    }
    std::printf("%ld pixels of %zu objects, %ld of them before the screen; outline %ld px: %ld differ there, "
                "%ld elsewhere; "
                "%.4f mm at most\n",
                sum.hits, sum.of_object.size(), sum.before_screen, sum.outline, sum.edge, sum.wrong,
                1e3 * sum.worst_m);
    EXPECT_EQ(sum.of_object.size(), objects_.size());
    for (const auto& [object, pixels] : sum.of_object) {
        EXPECT_GT(pixels, 2000) << object;
    }
    EXPECT_GT(sum.before_screen, 5000);
    EXPECT_EQ(sum.wrong, 0);
    EXPECT_EQ(sum.miscoloured, 0);
    EXPECT_LE(sum.edge, sum.outline / 10);
    EXPECT_LE(sum.worst_m, 1e-4);
}

} // namespace
} // namespace frustumscreen::programs
