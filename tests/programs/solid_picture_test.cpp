// A prop of any shape from its file to the picture, made only by the programs, against rays through the prop file's own
// corners and the artifact's own triangles.

#include "tests/base/text_of.h"
#include "tests/folders.h"
#include "tests/programs/program_folder.h"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

namespace frustumscreen::programs {
namespace {

// config/cube.toml: a projector that looks straight down.
constexpr int width = 1280;
constexpr int height = 800;
constexpr double focal_px = 2000.0;
constexpr glm::dvec3 lens_m(0.0, 0.0, 0.9);

struct HalfSpace {
    glm::dvec3 normal{0.0}; ///< outward
    double offset = 0.0;
};

/// The planes of a prop file's faces, in metres.
std::vector<HalfSpace> planes_of(const std::string& obj) {
    std::vector<glm::dvec3> corners;
    std::vector<HalfSpace> planes;
    std::istringstream lines(obj);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string keyword;
        words >> keyword;
        if (keyword == "v") {
            glm::dvec3 corner{0.0};
            words >> corner.x >> corner.y >> corner.z;
            corners.push_back(1e-3 * corner);
        } else if (keyword == "f") {
            std::array<std::size_t, 3> first{};
            words >> first[0] >> first[1] >> first[2];
            const glm::dvec3& a = corners[first[0] - 1];
            const glm::dvec3 normal =
                glm::normalize(glm::cross(corners[first[1] - 1] - a, corners[first[2] - 1] - a));
            planes.push_back({normal, glm::dot(normal, a)});
        }
    }
    return planes;
}

/// Where a ray from outside enters the half-spaces' common part, and through which.
struct Entry {
    double t = 0.0;
    std::size_t plane = 0;
};
std::optional<Entry> entry(const std::vector<HalfSpace>& planes, const glm::dvec3& from,
                           const glm::dvec3& along) {
    Entry in{.t = -std::numeric_limits<double>::infinity(), .plane = 0};
    double out = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < planes.size(); ++k) {
        const double speed = glm::dot(planes[k].normal, along);
        const double t = (planes[k].offset - glm::dot(planes[k].normal, from)) / speed;
        if (speed < 0.0 && t > in.t) {
            in = {t, k};
        } else if (speed > 0.0) {
            out = std::fmin(out, t);
        }
    }
    return in.t < out ? std::optional(in) : std::nullopt;
}

/// The star of `write_star` in a prop: z is up, the middle of its box on the axis, its lowest corner on z = 0, as large
/// as fits.
struct Star {
    explicit Star(const std::vector<HalfSpace>& prop) {
        double scale = std::numeric_limits<double>::infinity();
        for (glm::dvec3& corner : corners) {
            corner -= glm::dvec3(0.15, -0.05, -1.0);
            for (const HalfSpace& plane : prop) {
                const double reach = glm::dot(plane.normal, corner);
                scale = reach > 1e-12 ? std::fmin(scale, plane.offset / reach) : scale;
            }
        }
        for (glm::dvec3& corner : corners) {
            corner *= scale;
        }
    }
    /// The first point of the surface on a ray, if it meets it (Moeller, Trumbore 1997).
    [[nodiscard]] std::optional<glm::dvec3> hit(const glm::dvec3& from, const glm::dvec3& along) const {
        double first = std::numeric_limits<double>::infinity();
        for (const auto& [a, b, c] : triangles) {
            const glm::dvec3 ab = corners[b] - corners[a];
            const glm::dvec3 ac = corners[c] - corners[a];
            const glm::dvec3 p = glm::cross(along, ac);
            const double area = glm::dot(ab, p);
            const glm::dvec3 s = from - corners[a];
            const double u = glm::dot(s, p) / area;
            const glm::dvec3 q = glm::cross(s, ab);
            const double v = glm::dot(along, q) / area;
            const double t = glm::dot(ac, q) / area;
            first = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 ? std::fmin(first, t) : first;
        }
        return std::isfinite(first) ? std::optional(from + first * along) : std::nullopt;
    }

    std::array<glm::dvec3, 6> corners{
        {{1, 0, 0}, {-0.7, 0, 0}, {0, 0.8, 0}, {0, -0.9, 0}, {0, 0, 1.1}, {0, 0, -1}}};
    static constexpr std::array<std::array<std::size_t, 3>, 8> triangles{
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
};

/// A pose of the prop, and where the eye is; table coordinates.
struct Pose {
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 place_m{0.0};
    glm::dvec3 eye_m{0.0};
};
const std::vector<Pose> poses{
    {glm::dquat(1.0, 0.0, 0.0, 0.0), {0.02, -0.01, 0.10}, {0.1, -0.5, 0.6}},
    {glm::normalize(glm::dquat(0.8, 0.4, -0.3, 0.2)), {0.0, 0.0, 0.18}, {-0.2, -0.4, 0.55}},
    {glm::normalize(glm::dquat(0.1, 0.9, 0.2, -0.3)), {-0.03, 0.02, 0.25}, {0.0, -0.1, 0.85}},
};

std::string pose_file() {
    std::string text = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
    int time_us = 0;
    for (const Pose& pose : poses) {
        const glm::dquat& q = pose.rotation;
        text += fmt::format("{},1,{},{},{},{},{},{},{},1\n{},2,{},{},{},1,0,0,0,1\n", time_us, pose.place_m.x,
                            pose.place_m.y, pose.place_m.z, q.w, q.x, q.y, q.z, time_us, pose.eye_m.x,
                            pose.eye_m.y, pose.eye_m.z);
        time_us += 100000;
    }
    return text;
}

/// Points in the prop's frame, from the top row on; NaN where no surface was hit.
std::vector<glm::vec3> read_points(const std::string& pfm) {
    const std::size_t pixels = std::size_t{width} * height;
    std::vector<glm::vec3> points(pixels);
    EXPECT_TRUE(pfm.starts_with("PF"));
    const char* rows = pfm.data() + pfm.size() - sizeof(glm::vec3) * pixels;
    for (std::size_t y = 0; y < height; ++y) { // PFM begins with the bottom row
        std::memcpy(&points[(height - 1 - y) * width], rows + sizeof(glm::vec3) * width * y,
                    sizeof(glm::vec3) * width);
    }
    return points;
}

class SolidPicture : public ProgramFolder, public testing::WithParamInterface<const char*> {};

TEST_P(SolidPicture, ShowsWhatRaysSee) {
    const std::string file = source_dir() + "/config/" + GetParam();
    write_star();
    ASSERT_EQ(run(fmt::format(
                  "frustumscreen-bake star.obj -o star.fspack --prop '{}' --up z --turn 0 --unlit --size 64",
                  file)),
              0)
        << text("err.txt");
    put("kiosk.toml",
        fmt::format("[projector]\nwidth = {}\nheight = {}\nfx = {}\nposition_m = [0.0, 0.0, {}]\n"
                    "aim_m = [0.0, 0.0, 0.0]\n[prop]\nkind = \"solid\"\nfile = \"{}\"\n"
                    "[table]\nwidth_m = 0.576\ndepth_m = 0.36\n",
                    width, height, focal_px, lens_m.z, file));
    put("poses.csv", pose_file());
    ASSERT_EQ(run("frustumscreen render --config kiosk.toml --pack star.fspack --poses poses.csv --out out "
                  "--technique finest --no-light --aov"),
              0)
        << text("err.txt");
    EXPECT_EQ(text("err.txt"), "");
    const std::vector<HalfSpace> prop = planes_of(text_of(file));
    const Star star(prop);
    for (std::size_t k = 0; k < poses.size(); ++k) {
        const std::vector<glm::vec3> points = read_points(text(fmt::format("out/frame_{:05}.pfm", k)));
        const glm::dquat to_prop = glm::conjugate(poses[k].rotation);
        const glm::dvec3 eye = to_prop * (poses[k].eye_m - poses[k].place_m);
        const glm::dvec3 lens = to_prop * (lens_m - poses[k].place_m);
        int hits = 0;
        int other = 0; // pixels that are hit in one alone
        double worst_m = 0.0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const glm::dvec3 ray = to_prop * glm::dvec3((x + 0.5 - 0.5 * width) / focal_px,
                                                            (0.5 * height - y - 0.5) / focal_px, -1.0);
                const std::optional<Entry> face = entry(prop, lens, ray);
                std::optional<glm::dvec3> truth;
                if (face) {
                    const glm::dvec3 place = lens + face->t * ray;
                    const HalfSpace& plane = prop[face->plane];
                    if (glm::dot(plane.normal, eye) > plane.offset) {
                        truth = star.hit(eye, place - eye);
                    }
                }
                const glm::vec3& drawn = points[static_cast<std::size_t>(y * width + x)];
                hits += truth ? 1 : 0;
                if (truth.has_value() == std::isnan(drawn.x)) {
                    ++other;
                } else if (truth) {
                    worst_m = std::fmax(worst_m, glm::distance(*truth, glm::dvec3(drawn)));
                }
            }
        }
        EXPECT_GT(hits, 1000) << k;
        // The outline alone may differ: a tenth of a pixel along an outline of a few times the root of the area.
        EXPECT_LE(other, 0.1 * 8.0 * std::sqrt(hits)) << k;
        EXPECT_LE(worst_m, 1e-4) << k;
    }
}

class SolidProp : public ProgramFolder {};

TEST_F(SolidProp, ThatIsNoneIsRefusedInOneLine) {
    write_star();
    put("open.obj", "v 0 0 0\nv 90 0 0\nv 0 90 0\nv 0 0 90\nf 1 3 2\nf 1 2 4\nf 2 3 4\n");
    put("tip.obj", "v 0 0 0\nv 90 0 90\nv -45 80 90\nv -45 -80 90\nf 1 3 2\nf 1 4 3\nf 1 2 4\nf 2 3 4\n");
    const auto refused = [&](const std::string& prop, const std::string& words) {
        EXPECT_NE(run("frustumscreen-bake star.obj -o star.fspack --prop " + prop), 0) << prop;
        const std::string told = text("err.txt");
        EXPECT_NE(told.find(words), std::string::npos) << told;
        EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
        EXPECT_FALSE(std::filesystem::exists(folder / "star.fspack"));
    };
    refused("sphere", "--prop 'sphere': allowed are frustum, cube and the path of a prop file");
    refused("nowhere.obj", "nowhere.obj");
    refused("open.obj", "open.obj: ");
    refused("tip.obj", "none of its faces lies on z = 0");
}

TEST_F(SolidProp, HasNoSquareFootToMeasureATableWith) {
    put("kiosk.toml",
        fmt::format("[prop]\nkind = \"solid\"\nfile = \"{}/config/prop_gem.obj\"\n", source_dir()));
    for (const char* command :
         {"table --config kiosk.toml --json", "sheet --config kiosk.toml -o board.svg"}) {
        EXPECT_EQ(run(fmt::format("frustumscreen-calibrate {}", command)), 1) << command;
        EXPECT_NE(text("err.txt").find("measure it with a frustum or a cube"), std::string::npos)
            << text("err.txt");
    }
}

INSTANTIATE_TEST_SUITE_P(Examples, SolidPicture,
                         testing::Values("prop_cube.obj", "prop_hexagon.obj", "prop_tetrahedron.obj",
                                         "prop_gem.obj"));

} // namespace
} // namespace frustumscreen::programs
