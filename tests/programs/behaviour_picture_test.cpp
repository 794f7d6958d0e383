// `render --behaviour`, made by the program, against rays through the prop file's own corners and triangles that the test
// itself moves: a chest, its lid that turns on a hinge, and the lid's knob that is pulled.

#include "app/pack/pack_file.h"
#include "app/pack/pack_world.h"
#include "assets_baked/bake/bake.h"
#include "tests/base/text_of.h"
#include "tests/folders.h"
#include "tests/programs/program_folder.h"
#include "tests/programs/solid_rays.h"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace frustumscreen::programs {
namespace {

// config/cube.toml: a projector that looks straight down.
constexpr int width = 640;
constexpr int height = 400;
constexpr double focal_px = 1000.0;
constexpr glm::dvec3 lens_m(0.0, 0.0, 0.9);
/// Of the largest size inside the prop, so that the open lid stays inside too.
constexpr double scale = 0.5;

/// A box in its own frame, and where that stands at rest in its parent's: T * R * S, as a glTF file has it.
struct BoxNode {
    glm::dvec3 low{0.0}, high{0.0};
    int parent = -1;
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scaling{1.0};
};
std::array<BoxNode, 3> nodes_at_rest() {
    return {{{.low = {-1.0, -0.6, 0.0}, .high = {1.0, 0.6, 0.8}},
             {.low = {-1.0, -1.2, 0.0}, .high = {1.0, 0.0, 0.2}, .parent = 0, .translation = {0.0, 0.6, 0.8}},
             {.low = {-1.0, -1.0, 0.0},
              .high = {1.0, 1.0, 1.0},
              .parent = 1,
              .translation = {0.3, -0.9, 0.2},
              .rotation = glm::dquat(std::cos(0.3), 0.0, 0.0, std::sin(0.3)),
              .scaling = glm::dvec3(0.2)}}};
}

constexpr double opened_rad = -1.1;
constexpr double seconds = 2.0;
constexpr double pulled = 0.15;

/// The nodes `t` seconds after the behaviour began: the lid turns evenly about its hinge for two seconds; after one
/// second, the knob is out at once.
std::array<BoxNode, 3> nodes_at(double t) {
    std::array<BoxNode, 3> nodes = nodes_at_rest();
    const double angle = opened_rad * std::clamp(t / seconds, 0.0, 1.0);
    nodes[1].rotation = glm::dquat(std::cos(0.5 * angle), std::sin(0.5 * angle), 0.0, 0.0);
    nodes[2].translation.z += t >= 1.0 ? pulled : 0.0;
    return nodes;
}

std::array<glm::dvec3, 8> corners_of(const BoxNode& node) {
    std::array<glm::dvec3, 8> corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        corners.at(k) = {(k & 1U) != 0 ? node.high.x : node.low.x, (k & 2U) != 0 ? node.high.y : node.low.y,
                         (k & 4U) != 0 ? node.high.z : node.low.z};
    }
    return corners;
}
constexpr std::array<std::array<std::uint32_t, 3>, 12> box_triangles{{{0, 2, 1},
                                                                      {1, 2, 3},
                                                                      {4, 5, 6},
                                                                      {5, 7, 6},
                                                                      {0, 1, 4},
                                                                      {1, 5, 4},
                                                                      {2, 6, 3},
                                                                      {3, 6, 7},
                                                                      {0, 4, 2},
                                                                      {2, 4, 6},
                                                                      {1, 3, 5},
                                                                      {3, 7, 5}}};

/// Triangles of all boxes in the scene's frame, without any code of the project.
struct Triangles {
    explicit Triangles(const std::array<BoxNode, 3>& nodes) {
        for (const BoxNode& node : nodes) {
            for (const std::array<std::uint32_t, 3>& triangle : box_triangles) {
                std::array<glm::dvec3, 3>& placed = all.emplace_back();
                for (std::size_t k = 0; k < 3; ++k) {
                    glm::dvec3 point = corners_of(node).at(triangle.at(k));
                    for (const BoxNode* at = &node; at != nullptr;
                         at = at->parent < 0 ? nullptr : &nodes.at(static_cast<std::size_t>(at->parent))) {
                        point = at->translation + at->rotation * (at->scaling * point);
                    }
                    placed.at(k) = point;
                }
            }
        }
    }
    /// As Star::hit.
    [[nodiscard]] std::optional<glm::dvec3> hit(const glm::dvec3& from, const glm::dvec3& along) const {
        double first = std::numeric_limits<double>::infinity();
        for (const auto& [a, b, c] : all) {
            const glm::dvec3 ab = b - a;
            const glm::dvec3 ac = c - a;
            const glm::dvec3 p = glm::cross(along, ac);
            const double area = glm::dot(ab, p);
            const glm::dvec3 s = from - a;
            const double u = glm::dot(s, p) / area;
            const glm::dvec3 q = glm::cross(s, ab);
            const double v = glm::dot(along, q) / area;
            const double t = glm::dot(ac, q) / area;
            first = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 ? std::fmin(first, t) : first;
        }
        return std::isfinite(first) ? std::optional(from + first * along) : std::nullopt;
    }
    std::vector<std::array<glm::dvec3, 3>> all;
};

/// Where the artifact's rest stands in the prop, as Star.
struct PlacedInProp {
    explicit PlacedInProp(const std::vector<HalfSpace>& prop) {
        const Triangles rest(nodes_at_rest());
        glm::dvec3 low(std::numeric_limits<double>::infinity());
        glm::dvec3 high = -low;
        for (const auto& triangle : rest.all) {
            for (const glm::dvec3& corner : triangle) {
                low = glm::min(low, corner);
                high = glm::max(high, corner);
            }
        }
        base = {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), low.z};
        metres = std::numeric_limits<double>::infinity();
        for (const auto& triangle : rest.all) {
            for (const glm::dvec3& corner : triangle) {
                for (const HalfSpace& plane : prop) {
                    const double reach = glm::dot(plane.normal, corner - base);
                    metres = reach > 1e-12 ? std::fmin(metres, plane.offset / reach) : metres;
                }
            }
        }
        metres *= scale;
    }
    [[nodiscard]] Triangles at(double t) const {
        Triangles placed(nodes_at(t));
        for (auto& triangle : placed.all) {
            for (glm::dvec3& corner : triangle) {
                corner = metres * (corner - base);
            }
        }
        return placed;
    }
    glm::dvec3 base{0.0};
    double metres = 0.0;
};

bake::SourceMesh mesh_of(const std::vector<std::array<glm::dvec3, 3>>& triangles) {
    bake::SourceMesh mesh;
    mesh.materials.emplace_back();
    for (const auto& triangle : triangles) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), triangle.begin(), triangle.end());
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangle_materials.push_back(0);
    }
    return mesh;
}

pack::Pack baked(const std::vector<std::array<glm::dvec3, 3>>& triangles, double of_largest) {
    bake::BakeOptions options;
    options.size = 64;
    options.unlit = true;
    options.prop = bake::baked_cube();
    options.up = "z";
    options.scale = of_largest;
    pack::Pack pack = bake::bake(mesh_of(triangles), options).value();
    pack.title = "Chest";
    pack.provenance.source_name = "chest.gltf";
    pack.provenance.source_sha256 = std::string(64, '0');
    pack.provenance.source_triangles = triangles.size();
    return pack;
}

world::Behaviour opening() {
    world::Behaviour behaviour;
    behaviour.name = "open";
    behaviour.seconds = seconds;
    behaviour.stays = true;
    behaviour.trigger = world::Trigger::Arrival;
    world::Channel lid{.cell = 1, .path = world::Path::Rotation, .curve = {}};
    // Short arcs, so that the turn from key to key is even.
    for (const double t : {0.0, 0.5 * seconds, seconds}) {
        const glm::dquat q = nodes_at(t)[1].rotation;
        lid.curve.times_s.push_back(static_cast<float>(t));
        lid.curve.values.emplace_back(glm::dvec4(q.x, q.y, q.z, q.w));
    }
    world::Channel knob{.cell = 2, .path = world::Path::Translation, .curve = {}};
    knob.curve.interpolation = world::Interpolation::Step;
    for (const double t : {0.0, 1.0}) {
        knob.curve.times_s.push_back(static_cast<float>(t));
        knob.curve.values.emplace_back(glm::dvec4(nodes_at(t)[2].translation, 0.0));
    }
    behaviour.channels = {lid, knob};
    return behaviour;
}

/// Without cells.
pack::Pack whole_chest() {
    return baked(Triangles(nodes_at_rest()).all, scale);
}

pack::Pack chest() {
    const std::array<BoxNode, 3> rest = nodes_at_rest();
    const std::vector<std::array<glm::dvec3, 3>> all = Triangles(rest).all;
    pack::Pack whole = whole_chest();
    pack::PackWorld world;
    std::vector<pack::Pack> geometry;
    for (std::size_t k = 0; k < rest.size(); ++k) {
        std::vector<std::array<glm::dvec3, 3>> own;
        for (const std::array<std::uint32_t, 3>& triangle : box_triangles) {
            const std::array<glm::dvec3, 8> corners = corners_of(rest.at(k));
            own.push_back({corners.at(triangle[0]), corners.at(triangle[1]), corners.at(triangle[2])});
        }
        geometry.push_back(baked(own, 1.0));
        pack::PackCell& cell = world.cells.emplace_back();
        cell.triangles = own.size();
        cell.cell.name = std::array{"chest", "lid", "knob"}.at(k);
        cell.cell.rest = {rest.at(k).translation, rest.at(k).rotation, rest.at(k).scaling};
        cell.cell.has_geometry = true;
        cell.cell.cell_from_geometry = glm::inverse(geometry.back().box_from_file);
        if (rest.at(k).parent < 0) {
            cell.cell.parent_from_base = whole.box_from_file;
        } else {
            cell.cell.parent = static_cast<std::size_t>(rest.at(k).parent);
        }
        cell.low = glm::dvec3(std::numeric_limits<double>::infinity());
        cell.high = -cell.low;
        for (std::size_t t = 12 * k; t < 12 * (k + 1); ++t) {
            for (const glm::dvec3& corner : all[t]) {
                const glm::dvec3 in_box(whole.box_from_file * glm::dvec4(corner, 1.0));
                cell.low = glm::min(cell.low, in_box);
                cell.high = glm::max(cell.high, in_box);
            }
        }
    }
    world.behaviours.push_back({opening(), {{"en", "Open the lid"}}});
    EXPECT_TRUE(pack::put_world(whole, world, geometry));
    return whole;
}

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
        put("kiosk.toml",
            fmt::format("[projector]\nwidth = {}\nheight = {}\nfx = {}\nposition_m = [0.0, 0.0, {}]\n"
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
                agreement(points, prop, in_prop.at(pose.t), to_prop * (pose.eye_m - pose.place_m),
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

/// A relief's texel is about a pixel here, and where an edge hides another box, such a pixel shows what is behind it.
TEST_F(BehaviourPicture, ShowsReliefsAndPolygonsWhereRaysSeeThem) {
    for (const char* technique : {"relief", "relief-gpu"}) {
        ASSERT_EQ(render(fmt::format("--technique {} --aov --behaviour open", technique)), 0)
            << text("err.txt");
        compare(0.95, 1e-3, 1.0);
    }
}

TEST_F(BehaviourPicture, IsTheWholeArtifactsWithoutTheOption) {
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
    ASSERT_EQ(run("frustumscreen run --config kiosk.toml --headless --seconds 8 --out run"), 0)
        << text("err.txt");
    const std::string frames = text("run/frames.csv");
    EXPECT_NE(frames.find(",cells,"), std::string::npos) << frames.substr(frames.size() - 400);
}

TEST_F(BehaviourPicture, RefusesABehaviourThatThereIsNotInOneLine) {
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
