// Each eye's picture on every kind of prop, made only by the programs, against rays from that eye. The eyes are placed here by
// the turned head's own axis, from the sine and the cosine of its turn.

#include "tests/base/text_of.h"
#include "tests/folders.h"
#include "tests/programs/program_folder.h"
#include "tests/programs/solid_rays.h"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace frustumscreen::programs {
namespace {

// A projector that looks straight down; the picture covers 0.576 x 0.36 m of the table, as config/cube.toml's.
constexpr glm::ivec2 size_px(640, 400);
constexpr double focal_px = 1000.0;
constexpr glm::dvec3 above_m(0.0, 0.0, 0.9);
constexpr double interocular_mm = 63.0;

/// A turn by an angle around a unit axis.
struct Turn {
    glm::dvec3 axis{0.0, 0.0, 1.0};
    double angle = 0.0;

    /// Rodrigues' formula.
    [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& v) const {
        return std::cos(angle) * v + std::sin(angle) * glm::cross(axis, v) +
               (1.0 - std::cos(angle)) * glm::dot(axis, v) * axis;
    }
    [[nodiscard]] Turn back() const { return {axis, -angle}; }
    [[nodiscard]] std::string row() const {
        const glm::dvec3 v = std::sin(0.5 * angle) * axis;
        return fmt::format("{},{},{},{}", std::cos(0.5 * angle), v.x, v.y, v.z);
    }
};

struct Pose {
    Turn prop;
    glm::dvec3 place_m{0.0};
    Turn head;
    glm::dvec3 middle_m{0.0}; ///< between the eyes
};

struct PropCase {
    const char* name;     ///< of the bake's --prop; with .obj: of a file in config
    const char* settings; ///< of [prop]; of a file: added below
    double middle_m;      ///< height of its middle above its foot
    bool in_hand;         ///< turned in any way; otherwise about the upright, and tilted a little
};

/// As config/near.toml and config/cube.toml.
std::vector<HalfSpace> frustum_planes() {
    constexpr double base = 0.16;
    constexpr double top = 0.09;
    constexpr double height = 0.12;
    std::vector<HalfSpace> planes{{.normal = {0, 0, -1}, .offset = 0.0, .lit = false},
                                  {.normal = {0, 0, 1}, .offset = height}};
    for (const glm::dvec3& side :
         {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0)}) {
        const glm::dvec3 normal = glm::normalize(height * side + glm::dvec3(0, 0, 0.5 * (base - top)));
        planes.push_back({.normal = normal, .offset = glm::dot(normal, 0.5 * base * side)});
    }
    return planes;
}
std::vector<HalfSpace> cube_planes() {
    constexpr double edge = 0.10;
    std::vector<HalfSpace> planes{{.normal = {0, 0, -1}, .offset = 0.0},
                                  {.normal = {0, 0, 1}, .offset = edge}};
    for (const glm::dvec3& side :
         {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0)}) {
        planes.push_back({.normal = side, .offset = 0.5 * edge});
    }
    return planes;
}

class StereoPicture : public ProgramFolder, public testing::WithParamInterface<PropCase> {
protected:
    [[nodiscard]] static bool is_file() { return std::string(GetParam().name).ends_with(".obj"); }
    [[nodiscard]] static std::string prop_argument() {
        return is_file() ? source_dir() + "/config/" + GetParam().name : GetParam().name;
    }
    [[nodiscard]] static std::vector<HalfSpace> planes() {
        return is_file()                                   ? planes_of(text_of(prop_argument()))
               : std::string(GetParam().name) == "frustum" ? frustum_planes()
                                                           : cube_planes();
    }
    [[nodiscard]] static Turn any_turn(std::mt19937& random) {
        std::normal_distribution<double> normal;
        std::uniform_real_distribution<double> u(-1.0, 1.0);
        return {glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))),
                std::numbers::pi * u(random)};
    }
    /// The prop in the light, and a head that looks at it from anywhere above, tilted to the side too.
    [[nodiscard]] static Pose any_pose(std::mt19937& random) {
        std::uniform_real_distribution<double> u(-1.0, 1.0);
        Pose pose;
        if (GetParam().in_hand) {
            pose.prop = any_turn(random);
            const glm::dvec3 middle(0.05 * u(random), 0.03 * u(random), 0.16 + 0.05 * u(random));
            pose.place_m = middle - pose.prop(glm::dvec3(0.0, 0.0, GetParam().middle_m));
        } else {
            pose.prop = {glm::normalize(glm::dvec3(0.1 * u(random), 0.1 * u(random), 1.0)),
                         std::numbers::pi * u(random)};
            pose.place_m = {0.05 * u(random), 0.03 * u(random), 0.02 + 0.02 * u(random)};
        }
        const double azimuth = std::numbers::pi * u(random);
        const double elevation = 0.9 + 0.4 * u(random);
        pose.middle_m =
            pose.place_m + (0.6 + 0.2 * u(random)) * glm::dvec3(std::cos(elevation) * std::cos(azimuth),
                                                                std::cos(elevation) * std::sin(azimuth),
                                                                std::sin(elevation));
        pose.head = any_turn(random);
        return pose;
    }
    void put_poses(const std::vector<Pose>& poses) const {
        std::string text = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
        int time_us = 0;
        for (const Pose& pose : poses) {
            const auto row = [&](int station, const glm::dvec3& at, const Turn& turn) {
                return fmt::format("{},{},{},{},{},{},1\n", time_us, station, at.x, at.y, at.z, turn.row());
            };
            text += row(1, pose.place_m, pose.prop) + row(2, pose.middle_m, pose.head);
            time_us += 100000;
        }
        put("poses.csv", text);
    }
    void put_settings() const {
        const std::string prop = is_file() ? fmt::format("kind = \"solid\"\nfile = \"{}\"\n", prop_argument())
                                           : GetParam().settings;
        put("kiosk.toml",
            fmt::format("[projector]\nwidth = {}\nheight = {}\nfx = {}\nposition_m = [0.0, 0.0, {}]\n"
                        "aim_m = [0.0, 0.0, 0.0]\n[prop]\n{}[eye]\nstereo = \"anaglyph\"\n"
                        "interocular_mm = {:.1f}\n[table]\nwidth_m = 0.576\ndepth_m = 0.36\n",
                        size_px.x, size_px.y, focal_px, above_m.z, prop, interocular_mm));
    }
    void expect_what_rays_see(int count) {
        write_star();
        ASSERT_EQ(
            run(fmt::format("frustumscreen-bake star.obj -o star.fspack --prop '{}' --up z --turn 0 --unlit "
                            "--size 64",
                            prop_argument())),
            0)
            << text("err.txt");
        std::mt19937 random(57);
        std::vector<Pose> poses;
        for (int k = 0; k < count; ++k) {
            poses.push_back(any_pose(random));
        }
        put_poses(poses);
        put_settings();
        for (const double side : {-1.0, 1.0}) {
            const std::string eye = side < 0.0 ? "left" : "right";
            ASSERT_EQ(run(fmt::format(
                          "frustumscreen render --config kiosk.toml --pack star.fspack --poses poses.csv "
                          "--out {0} --eye {0} --technique finest --no-light --aov",
                          eye)),
                      0)
                << text("err.txt");
            EXPECT_EQ(text("err.txt"), "");
            compare(poses, side, eye);
        }
    }
    void compare(const std::vector<Pose>& poses, double side, const std::string& eye) const {
        const std::vector<HalfSpace> prop = planes();
        const Star star(prop);
        int hits = 0;
        int other = 0;
        double worst_m = 0.0;
        for (std::size_t k = 0; k < poses.size(); ++k) {
            const Pose& pose = poses[k];
            const Turn to_prop = pose.prop.back();
            const glm::dvec3 eye_m =
                pose.middle_m + pose.head(glm::dvec3(side * 0.5e-3 * interocular_mm, 0.0, 0.0));
            const Agreement seen = agreement(
                read_points(text(fmt::format("{}/frame_{:05}.pfm", eye, k)), size_px), prop, star,
                to_prop(eye_m - pose.place_m), to_prop(above_m - pose.place_m),
                [&](double x, double y) {
                    return to_prop(glm::dvec3((x + 0.5 - 0.5 * size_px.x) / focal_px,
                                              (0.5 * size_px.y - y - 0.5) / focal_px, -1.0));
                },
                size_px);
            // The outline alone may differ: a tenth of a pixel along an outline of a few times the root of the area.
            EXPECT_LE(seen.other, 0.1 * 8.0 * std::sqrt(seen.hits))
                << GetParam().name << ' ' << eye << ' ' << k;
            EXPECT_LE(seen.worst_m, 1e-4) << GetParam().name << ' ' << eye << ' ' << k;
            hits += seen.hits;
            other += seen.other;
            worst_m = std::fmax(worst_m, seen.worst_m);
        }
        std::printf("%s, %s eye: %d pixels in %zu poses, %d in one alone, %.4f mm at most\n", GetParam().name,
                    eye.c_str(), hits, poses.size(), other, 1e3 * worst_m);
        EXPECT_GT(hits, 500 * static_cast<int>(poses.size()));
    }
};

TEST_P(StereoPicture, MatchesRaysForEachEye) {
    expect_what_rays_see(2);
}

/// By `ctest -C long -R stereo_picture`.
TEST_P(StereoPicture, DISABLED_MatchesRaysForEachEyeInFiftyPoses) {
    expect_what_rays_see(50);
}

INSTANTIATE_TEST_SUITE_P(
    Props, StereoPicture,
    testing::Values(PropCase{"frustum", "kind = \"frustum\"\nbase_m = 0.16\ntop_m = 0.09\nheight_m = 0.12\n",
                             0.06, false},
                    PropCase{"cube", "kind = \"cube\"\nbase_m = 0.10\n", 0.05, true},
                    PropCase{"prop_cube.obj", "", 0.06, true}, PropCase{"prop_hexagon.obj", "", 0.065, true},
                    PropCase{"prop_tetrahedron.obj", "", 0.04, true},
                    PropCase{"prop_gem.obj", "", 0.045, true}));

} // namespace
} // namespace frustumscreen::programs
