// `render --behaviour`, made by the program, against rays through the prop file's own corners and triangles that the test
// itself moves: a chest, its lid that turns on a hinge, and the lid's knob that is pulled. So is `render --state`.

#include "app/pack/pack_file.h"
#include "app/pack/pack_states.h"
#include "app/pack/pack_world.h"
#include "assets_baked/bake/bake.h"
#include "tests/base/text_of.h"
#include "tests/folders.h"
#include "tests/programs/opened_chest.h"
#include "tests/programs/program_folder.h"
#include "tests/programs/solid_rays.h"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace frustumscreen::programs {
namespace {

// config/cube.toml: a projector that looks straight down.
constexpr int width = 640;
constexpr int height = 400;
constexpr double focal_px = 1000.0;
constexpr glm::dvec3 lens_m(0.0, 0.0, 0.9);
/// A pose of the prop, the eye, and the time of the frame.
struct Pose {
    double t = 0.0;
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 place_m{0.0};
    glm::dvec3 eye_m{0.0};
};
constexpr int begin_us = 500000;

std::vector<Pose> seeded_poses() {
    std::mt19937 random(46);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    std::vector<Pose> poses;
    for (const double t : {0.0, 0.4, 0.999, 1.0, 1.7, 2.5}) {
        poses.push_back(
            {.t = t,
             .rotation = glm::normalize(glm::dquat(1.0, 0.3 * any(random), 0.3 * any(random), any(random))),
             .place_m = {0.03 * any(random), 0.03 * any(random), 0.12},
             .eye_m = {0.2 * any(random), -0.3 + 0.2 * any(random), 0.65}});
    }
    return poses;
}

std::string pose_file(const std::vector<Pose>& poses) {
    std::string text = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
    for (const Pose& pose : poses) {
        const glm::dquat& q = pose.rotation;
        const auto t_us = begin_us + std::lround(1e6 * pose.t);
        text += fmt::format("{},1,{},{},{},{},{},{},{},1\n{},2,{},{},{},1,0,0,0,1\n", t_us, pose.place_m.x,
                            pose.place_m.y, pose.place_m.z, q.w, q.x, q.y, q.z, t_us, pose.eye_m.x,
                            pose.eye_m.y, pose.eye_m.z);
    }
    return text;
}

class BehaviourPicture : public ProgramFolder {
protected:
    void SetUp() override {
        put("kiosk.toml", fmt::format("[projector]\nwidth = {}\nheight = {}\nrefresh_hz = 20.0\nfx = {}\n"
                                      "position_m = [0.0, 0.0, {}]\n"
                                      "aim_m = [0.0, 0.0, 0.0]\n[prop]\nkind = \"solid\"\nfile = \"{}\"\n"
                                      "[table]\nwidth_m = 0.576\ndepth_m = 0.36\n",
                                      width, height, focal_px, lens_m.z, prop_file()));
        put("poses.csv", pose_file(poses_));
        static const pack::Pack pack = chest(); // a bake takes seconds
        put_pack("chest.fspack", pack);
    }
    void put_pack(const std::string& name, const pack::Pack& pack) const {
        const Result<Bytes> bytes = pack::write_pack(pack);
        ASSERT_TRUE(bytes) << bytes.error().message;
        ASSERT_TRUE(write_file(folder / name, *bytes));
    }
    [[nodiscard]] static std::string prop_file() { return source_dir() + "/config/prop_cube.obj"; }
    [[nodiscard]] int render(const std::string& more, const std::string& pack = "chest.fspack") const {
        return run(
            fmt::format("frustumscreen render --config kiosk.toml --pack {} --poses poses.csv --out out "
                        "--no-light {}",
                        pack, more));
    }
    /// Compares the written hit points with rays: `share` of the pixels that both hit are within `close_m`; as many pixels
    /// differ as an outline of `outline_px` pixels has.
    void compare(double share, double close_m, double outline_px) const {
        compare(share, close_m, outline_px,
                [](const PlacedInProp& in_prop, const Pose& pose) { return in_prop.at(pose.t); });
    }
    /// `truth`: the triangles at a pose.
    void compare(double share, double close_m, double outline_px,
                 const std::function<Triangles(const PlacedInProp&, const Pose&)>& truth) const {
        const std::vector<HalfSpace> prop = planes_of(text_of(prop_file()));
        const PlacedInProp in_prop(prop);
        for (std::size_t k = 0; k < poses_.size(); ++k) {
            const Pose& pose = poses_[k];
            const std::vector<glm::vec3> points =
                read_points(text(fmt::format("out/frame_{:05}.pfm", k)), {width, height});
            const glm::dquat to_prop = glm::conjugate(pose.rotation);
            const auto ray = [&](double x, double y) {
                return to_prop * glm::dvec3((x + 0.5 - 0.5 * width) / focal_px,
                                            (0.5 * height - y - 0.5) / focal_px, -1.0);
            };
            Agreement seen =
                agreement(points, prop, truth(in_prop, pose), to_prop * (pose.eye_m - pose.place_m),
                          to_prop * (lens_m - pose.place_m), ray, {width, height});
            ASSERT_GT(seen.hits, 500) << k;
            EXPECT_LE(seen.other, outline_px * 8.0 * std::sqrt(seen.hits)) << k;
            std::sort(seen.off_m.begin(), seen.off_m.end());
            const auto last = static_cast<std::size_t>(share * static_cast<double>(seen.off_m.size() - 1));
            EXPECT_LE(seen.off_m[last], close_m) << k;
        }
    }

    std::vector<Pose> poses_ = seeded_poses();
};

TEST_F(BehaviourPicture, ShowsTheMovedCellsWhereRaysSeeThem) {
    ASSERT_EQ(render("--technique finest --aov --behaviour open"), 0) << text("err.txt");
    EXPECT_EQ(text("err.txt"), "");
    compare(1.0, 1e-4, 0.1);
}

TEST_F(BehaviourPicture, ShowsAStateAtEveryTimeWhereRaysSeeIt) {
    for (const char* technique : {"finest", "relief-gpu"}) {
        const bool exact = std::string_view(technique) == "finest";
        const double share = exact ? 1.0 : 0.95, close_m = exact ? 1e-4 : 1e-3,
                     outline_px = exact ? 0.1 : 1.0;
        ASSERT_EQ(render(fmt::format("--technique {} --aov --state opened", technique)), 0)
            << text("err.txt");
        EXPECT_EQ(text("err.txt"), "");
        compare(share, close_m, outline_px,
                [](const PlacedInProp& in_prop, const Pose&) { return in_prop.at(1e3); });
        ASSERT_EQ(render(fmt::format("--technique {} --aov --state 'without its lid'", technique)), 0)
            << text("err.txt");
        compare(share, close_m, outline_px,
                [](const PlacedInProp& in_prop, const Pose&) { return in_prop.of_first(1); });
    }
}

/// A window pins the state: its picture is that of a pack that is so from the beginning.
TEST_F(BehaviourPicture, PinsTheStateAtTheEndOfItsBehaviour) {
    ASSERT_EQ(render("--technique finest --state opened --pin 0.2,-0.1"), 0) << text("err.txt");
    const std::string pinned = text("out/frame_00005.png");
    ASSERT_EQ(render("--technique finest --state opened"), 0) << text("err.txt");
    const std::string plain = text("out/frame_00005.png");
    EXPECT_NE(pinned, plain);
    ASSERT_EQ(render("--technique finest --behaviour open"), 0) << text("err.txt");
    EXPECT_EQ(text("out/frame_00005.png"), plain) << "the last pose is after the behaviour's end";
    ASSERT_EQ(render("--technique finest --behaviour open --pin 0.2,-0.1"), 0) << text("err.txt");
    EXPECT_NE(text("out/frame_00005.png"), pinned) << "that window shows the beginning";
}

TEST_F(BehaviourPicture, RefusesAnUnknownOrEmptyStateInOneLine) {
    for (const auto& [state, words] :
         {std::pair("close", "--state close: the pack has no such state; it has opened, without its lid"),
          std::pair("nothing", "--state nothing: it hides every part")}) {
        EXPECT_EQ(render(fmt::format("--state {}", state)), 1);
        const std::string told = text("err.txt");
        EXPECT_NE(told.find(words), std::string::npos) << told;
        EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
    }
}

/// A relief's texel is about a pixel here, and where an edge hides another box, such a pixel shows what is behind it.
TEST_F(BehaviourPicture, ShowsReliefsAndPolygonsWhereRaysSeeThem) {
    for (const char* technique : {"relief", "relief-gpu"}) {
        ASSERT_EQ(render(fmt::format("--technique {} --aov --behaviour open", technique)), 0)
            << text("err.txt");
        compare(0.95, 1e-3, 1.0);
    }
}

TEST_F(BehaviourPicture, MatchesTheWholeArtifactWithoutTheOption) {
    put_pack("whole.fspack", whole_chest());
    ASSERT_EQ(render("--technique finest --aov", "whole.fspack"), 0) << text("err.txt");
    const std::string picture = text("out/frame_00003.png");
    const std::string points = text("out/frame_00003.pfm");
    ASSERT_EQ(render("--technique finest --aov"), 0) << text("err.txt");
    EXPECT_EQ(text("out/frame_00003.png"), picture);
    EXPECT_EQ(text("out/frame_00003.pfm"), points);
}

TEST_F(BehaviourPicture, RunsInTheExhibitWhenTheArtifactArrives) {
    put("kiosk.toml", text("kiosk.toml") + "[tracker]\nkind = \"replay\"\nposes = \"walk.csv\"\n"
                                           "[exhibit]\npacks = [\"chest.fspack\"]\n");
    std::string walk = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
    for (int k = 0; k < 80; ++k) { // a visitor slides the prop
        const double x_m = 0.03 * std::sin(0.2 * k);
        walk += fmt::format("{0},1,{1},0,0.05,1,0,0,0,1\n{0},2,0.1,-0.4,0.6,1,0,0,0,1\n", 100000 * k, x_m);
    }
    put("walk.csv", walk);
    ASSERT_EQ(run("frustumscreen run --config kiosk.toml --headless --fast --seconds 8 --out run"), 0)
        << text("err.txt");
    const std::string frames = text("run/frames.csv");
    EXPECT_NE(frames.find(",cells,"), std::string::npos) << frames.substr(frames.size() - 400);
}

TEST_F(BehaviourPicture, RefusesAnUnknownBehaviourInOneLine) {
    const auto refused = [&](const std::string& pack, const std::string& words) {
        EXPECT_EQ(render("--behaviour close", pack), 1);
        const std::string told = text("err.txt");
        EXPECT_NE(told.find(words), std::string::npos) << told;
        EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
    };
    refused("chest.fspack", "--behaviour close: the pack has no such behaviour; it has open");
    put_pack("whole.fspack", whole_chest());
    refused("whole.fspack", "--behaviour close: the pack has no behaviours");
}

} // namespace
} // namespace frustumscreen::programs
