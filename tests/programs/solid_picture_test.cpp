// A prop of any shape from its file to the picture, made only by the programs, against rays through the prop file's own
// corners and the artifact's own triangles.

#include "tests/base/text_of.h"
#include "tests/folders.h"
#include "tests/programs/program_folder.h"
#include "tests/programs/solid_rays.h"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace frustumscreen::programs {
namespace {

// config/cube.toml: a projector that looks straight down.
constexpr int width = 1280;
constexpr int height = 800;
constexpr double focal_px = 2000.0;
constexpr glm::dvec3 lens_m(0.0, 0.0, 0.9);

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

class SolidPicture : public ProgramFolder, public testing::WithParamInterface<const char*> {};

TEST_P(SolidPicture, MatchesRays) {
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
        const std::vector<glm::vec3> points =
            read_points(text(fmt::format("out/frame_{:05}.pfm", k)), {width, height});
        const glm::dquat to_prop = glm::conjugate(poses[k].rotation);
        const glm::dvec3 eye = to_prop * (poses[k].eye_m - poses[k].place_m);
        const glm::dvec3 lens = to_prop * (lens_m - poses[k].place_m);
        const Agreement seen =
            agreement(points, prop, star, eye, lens,
                      [&](double x, double y) {
                          return to_prop * glm::dvec3((x + 0.5 - 0.5 * width) / focal_px,
                                                      (0.5 * height - y - 0.5) / focal_px, -1.0);
                      },
                      {width, height});
        EXPECT_GT(seen.hits, 1000) << k;
        // The outline alone may differ: a tenth of a pixel along an outline of a few times the root of the area.
        EXPECT_LE(seen.other, 0.1 * 8.0 * std::sqrt(seen.hits)) << k;
        EXPECT_LE(seen.worst_m, 1e-4) << k;
    }
}

class SolidProp : public ProgramFolder {};

TEST_F(SolidProp, RefusesInvalidPropFilesInOneLine) {
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

TEST_F(SolidProp, CalibrationRefusesAPropWithoutASquareFoot) {
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
