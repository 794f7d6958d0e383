// A site through the programs: baked from a file, and `render --site` against rays to the file's own triangles, which the test
// places by the similarity that docs/sites.md describes. Rays begin at the prop's face: what lies before it is cut off.
#include "tests/base/text_of.h"
#include "tests/folders.h"
#include "tests/programs/program_folder.h"
#include "tests/programs/solid_rays.h"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::programs {
namespace {

// As config/cube.toml: a projector that looks straight down.
constexpr int site_width = 320;
constexpr int site_height = 200;
constexpr double site_focal_px = 500.0;
constexpr glm::dvec3 site_lens_m(0.0, 0.0, 0.9);

/// Hills of 36 x 36 quads over 200 x 200 m whose lowest places are flat, so that each region begins at z = 0; towers on them. The
/// squares of 4 x 4 cut no quad's edge, those of 8 x 8 do.
std::vector<RayTriangle> town() {
    constexpr int n = 36;
    const auto at = [](int i, int j) {
        const double x = 200.0 * i / n;
        const double y = 200.0 * j / n;
        return glm::dvec3(x, y, std::fmax(0.0, 9.0 * std::sin(0.13 * x) * std::cos(0.11 * y)));
    };
    std::vector<RayTriangle> triangles;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    constexpr std::array<std::array<unsigned, 4>, 5> sides{
        {{0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}, {4, 5, 7, 6}}};
    for (int k = 0; k < 25; ++k) {
        const glm::dvec3 low(20.0 + 40.0 * (k % 5) - 4.0, 20.0 + 40.0 * (k / 5) - 4.0, 0.0);
        const glm::dvec3 size(8.0, 8.0, 18.0 + 2.0 * (k % 3));
        for (const auto& [a, b, c, d] : sides) {
            const auto corner = [&](unsigned v) {
                return low + size * glm::dvec3(v & 1U, v >> 1U & 1U, v >> 2U & 1U);
            };
            triangles.push_back({corner(a), corner(b), corner(c)});
            triangles.push_back({corner(a), corner(c), corner(d)});
        }
    }
    return triangles;
}

/// A ridge along y, of 36 x 36 quads over 200 x 200 m, that rises 3 m on each 2 m.
std::vector<RayTriangle> ridge() {
    constexpr int n = 36;
    const auto at = [](int i, int j) {
        const double x = 200.0 * i / n;
        return glm::dvec3(x, 200.0 * j / n, 150.0 - 1.5 * std::abs(x - 100.0));
    };
    std::vector<RayTriangle> triangles;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return triangles;
}

std::string obj_of(const std::vector<RayTriangle>& triangles) {
    std::string text;
    for (const RayTriangle& triangle : triangles) {
        for (const glm::dvec3& corner : triangle) {
            text += fmt::format("v {} {} {}\n", corner.x, corner.y, corner.z);
        }
        text += "f -3 -2 -1\n";
    }
    return text;
}

/// Triangles in the prop; a ray meets them at its own end or behind it, at t of 1 or more.
struct PlacedTown {
    [[nodiscard]] std::optional<glm::dvec3> hit(const glm::dvec3& from, const glm::dvec3& along) const {
        double first = std::numeric_limits<double>::infinity();
        for (const RayTriangle& triangle : all) {
            const double t = ray_meets(triangle, from, along);
            first = t >= 1.0 ? std::fmin(first, t) : first;
        }
        return std::isfinite(first) ? std::optional(from + first * along) : std::nullopt;
    }
    std::vector<RayTriangle> all;
};

/// Makes the site's longer side 1 in the box frame, whose z axis goes through its middle. Returns the miniature's metres per box.
double bring_into_box(const std::vector<HalfSpace>& prop, std::vector<RayTriangle>& site) {
    double metres = std::numeric_limits<double>::infinity();
    for (RayTriangle& triangle : site) {
        for (glm::dvec3& corner : triangle) {
            corner = (corner - glm::dvec3(100.0, 100.0, 0.0)) / 200.0;
            for (const HalfSpace& plane : prop) {
                const double reach = glm::dot(plane.normal, corner);
                metres = reach > 1e-12 ? std::fmin(metres, plane.offset / reach) : metres;
            }
        }
    }
    return metres;
}

/// `place`: of the site, box frame.
PlacedTown placed_in(const std::vector<HalfSpace>& prop, std::vector<RayTriangle> site,
                     const glm::dvec3& place, double zoom) {
    const double metres = bring_into_box(prop, site);
    PlacedTown placed{std::move(site)};
    for (RayTriangle& triangle : placed.all) {
        for (glm::dvec3& corner : triangle) {
            corner = metres * zoom * (corner - place);
        }
    }
    return placed;
}

struct SitePose {
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 place_m{0.0};
    glm::dvec3 eye_m{0.0};
};

std::vector<SitePose> site_poses() {
    std::mt19937 random(64);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    std::vector<SitePose> poses;
    for (int k = 0; k < 3; ++k) {
        poses.push_back(
            {.rotation = glm::normalize(glm::dquat(1.0, 0.2 * any(random), 0.2 * any(random), any(random))),
             .place_m = {0.03 * any(random), 0.03 * any(random), 0.1},
             .eye_m = {0.2 * any(random), -0.3 + 0.1 * any(random), 0.6}});
    }
    return poses;
}

class SitePicture : public ProgramFolder {
protected:
    void SetUp() override {
        put("town.obj", obj_of(town()));
        put("kiosk.toml", fmt::format("[projector]\nwidth = {}\nheight = {}\nrefresh_hz = 20.0\nfx = {}\n"
                                      "position_m = [0.0, 0.0, {}]\n"
                                      "aim_m = [0.0, 0.0, 0.0]\n[prop]\nkind = \"solid\"\nfile = \"{}\"\n"
                                      "[table]\nwidth_m = 0.576\ndepth_m = 0.36\n",
                                      site_width, site_height, site_focal_px, site_lens_m.z, prop_file()));
        std::string poses = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
        for (std::size_t k = 0; k < poses_.size(); ++k) {
            const SitePose& pose = poses_[k];
            const glm::dquat& q = pose.rotation;
            poses += fmt::format("{0},1,{1},{2},{3},{4},{5},{6},{7},1\n{0},2,{8},{9},{10},1,0,0,0,1\n",
                                 1000 * k, pose.place_m.x, pose.place_m.y, pose.place_m.z, q.w, q.x, q.y, q.z,
                                 pose.eye_m.x, pose.eye_m.y, pose.eye_m.z);
        }
        put("poses.csv", poses);
    }
    [[nodiscard]] static std::string prop_file() { return source_dir() + "/config/prop_cube.obj"; }
    [[nodiscard]] int bake(const std::string& more) const {
        return run("frustumscreen-bake town.obj -o town.fspack --prop cube --up z --turn 0 --unlit --size 32 "
                   "--no-relief --speech none " +
                   more);
    }
    [[nodiscard]] int render(const std::string& more) const {
        return run("frustumscreen render --config kiosk.toml --pack town.fspack --poses poses.csv --out out "
                   "--no-light --aov --technique finest " +
                   more);
    }
    void compare(const std::vector<RayTriangle>& site, const glm::dvec3& place, double zoom) const {
        const std::vector<HalfSpace> prop = planes_of(text_of(prop_file()));
        const PlacedTown truth = placed_in(prop, site, place, zoom);
        int hits = 0; // a corner of the site is not seen from every side
        for (std::size_t k = 0; k < poses_.size(); ++k) {
            const SitePose& pose = poses_[k];
            const std::vector<glm::vec3> points =
                read_points(text(fmt::format("out/frame_{:05}.pfm", k)), {site_width, site_height});
            const glm::dquat to_prop = glm::conjugate(pose.rotation);
            const auto ray = [&](double x, double y) {
                return to_prop * glm::dvec3((x + 0.5 - 0.5 * site_width) / site_focal_px,
                                            (0.5 * site_height - y - 0.5) / site_focal_px, -1.0);
            };
            Agreement seen =
                agreement(points, prop, truth, to_prop * (pose.eye_m - pose.place_m),
                          to_prop * (site_lens_m - pose.place_m), ray, {site_width, site_height});
            hits += seen.hits;
            EXPECT_LE(seen.other, 0.1 * 8.0 * std::sqrt(seen.hits)) << k << " of " << seen.hits;
            std::sort(seen.off_m.begin(), seen.off_m.end());
            // Positions are codes of 16 bits of a region's box; where a wall is seen edge-on, a pixel shows what is behind it.
            if (!seen.off_m.empty()) {
                const auto most =
                    static_cast<std::size_t>(0.995 * static_cast<double>(seen.off_m.size() - 1));
                EXPECT_LE(seen.off_m[most], 2e-4) << k;
            }
        }
        EXPECT_GT(hits, 1500);
    }

    std::vector<SitePose> poses_ = site_poses();
};

TEST_F(SitePicture, ShowsAPartOfTheSiteWhereRaysBehindTheFacesSeeIt) {
    ASSERT_EQ(bake("--site"), 0) << text("err.txt");
    EXPECT_NE(text("out.txt").find("16 regions of "), std::string::npos) << text("out.txt");
    for (const auto& [place, zoom] : {std::pair(glm::dvec2(0.1, -0.15), 4.0),
                                      {glm::dvec2(-0.3, 0.35), 9.0},
                                      {glm::dvec2(0.5, -0.5), 3.0},
                                      {glm::dvec2(0.0, 0.0), 1.0}}) {
        ASSERT_EQ(render(fmt::format("--site {},{},{}", place.x, place.y, zoom)), 0) << text("err.txt");
        compare(town(), glm::dvec3(place, 0.0), zoom);
    }
}

/// The ground of the region is the foot of its slope, far below most of its places.
TEST_F(SitePicture, PlacesTheSurfaceAtHalfThePropsHeightOnASteepSlope) {
    put("town.obj", obj_of(ridge()));
    ASSERT_EQ(bake("--site"), 0) << text("err.txt");
    const std::vector<HalfSpace> prop = planes_of(text_of(prop_file()));
    double height_m = 0.0; // from the bottom, on z = 0
    for (const HalfSpace& plane : prop) {
        height_m = plane.normal.z > 0.5 ? plane.offset : height_m;
    }
    std::vector<RayTriangle> box = ridge();
    const double metres = bring_into_box(prop, box);
    for (const auto& [place, zoom] :
         {std::pair(glm::dvec2(0.3, 0.1), 20.0), {glm::dvec2(-0.1, -0.3), 60.0}}) {
        const double above = 0.75 - 1.5 * std::abs(place.x); // the surface there
        ASSERT_EQ(render(fmt::format("--site {},{},{}", place.x, place.y, zoom)), 0) << text("err.txt");
        compare(ridge(), glm::dvec3(place, above - 0.5 * height_m / (zoom * metres)), zoom);
    }
}

/// The visitor moves the prop all the time; button 5 goes into the site at 2 s and back at 7 s.
TEST_F(SitePicture, GoesIntoTheSiteAndBackInTheExhibit) {
    ASSERT_EQ(bake("--site"), 0) << text("err.txt");
    put("kiosk.toml", text("kiosk.toml") +
                          "[tracker]\nkind = \"replay\"\nposes = \"walk.csv\"\n"
                          "[panel]\nkind = \"scripted\"\n"
                          "script = [{ at_s = 2.0, button = 5 }, { at_s = 7.0, button = 5 }]\n"
                          "[exhibit]\npacks = [\"town.fspack\"]\n");
    std::string walk = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
    for (int k = 0; k < 130; ++k) {
        const double x_m = 0.03 * std::sin(0.2 * k);
        walk += fmt::format("{0},1,{1},0,0.05,1,0,0,0,1\n{0},2,0.1,-0.4,0.6,1,0,0,0,1\n", 100000 * k, x_m);
    }
    put("walk.csv", walk);
    ASSERT_EQ(run("frustumscreen run --config kiosk.toml --headless --fast --seconds 13 --out run"), 0)
        << text("err.txt");
    std::istringstream frames(text("run/frames.csv"));
    std::string order; // of whole and regions
    for (std::string line; std::getline(frames, line);) {
        const char shown = line.find(",cells,") != std::string::npos  ? 'r'
                           : line.find(",level") != std::string::npos ? 'w'
                                                                      : ' ';
        if (shown != ' ' && (order.empty() || order.back() != shown)) {
            order += shown;
        }
    }
    EXPECT_EQ(order, "wrw");
}

TEST_F(SitePicture, RefusesInvalidSitesInOneLine) {
    const auto told = [&](int status, const std::string& words) {
        EXPECT_NE(status, 0);
        const std::string line = text("err.txt");
        EXPECT_NE(line.find(words), std::string::npos) << line;
        EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
    };
    told(render("--site 0.6,0,4"), "'0.6,0,4' is not a part of a site");
    told(render("--site 0.1,0"), "is not a part of a site");
    told(render("--site 0.1,0,1001"), "1 to 1000");
    ASSERT_EQ(bake(""), 0) << text("err.txt");
    told(render("--site 0.1,0,4"), "--site: the pack is not a site");
}

} // namespace
} // namespace frustumscreen::programs
