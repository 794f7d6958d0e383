// A room behind a flat screen: the eye at a grazing angle, on the screen's plane and behind it, very near and very far; objects on
// the plane and around the eye; ten thousand objects; depths that differ a millionfold.

#include "app/bench/stability/picture.h"
#include "app/bench/stability/sweep.h"
#include "app/bench/stability/themes.h"
#include "app/scene/flat_screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

namespace frustumscreen::bench {

namespace {

/// The pinhole lies a hundredth of the panel's sides before it: 64-bit coordinates round that much more.
constexpr double screen_bound_px = 100.0 * bound_px;

/// A screen of 16:9 whose middle is at `middle_m`, upright or leaning, with its back to the artifact's box.
scene::FlatScreen screen_at(const glm::dvec3& middle_m, double width_m, double leans_rad = 0.0) {
    const glm::dvec3 right(0.5 * width_m, 0.0, 0.0);
    const glm::dvec3 up =
        9.0 / 16.0 * 0.5 * width_m * glm::dvec3(0.0, std::sin(leans_rad), std::cos(leans_rad));
    return scene::flat_screen(
        {middle_m - right + up, middle_m + right + up, middle_m + right - up, middle_m - right - up}, 1280,
        720);
}

exact::SetUp set_up_of(const scene::FlatScreen& screen, const glm::dvec3& eye_m) {
    return {.prop = screen.surface,
            .projector = screen.pinhole,
            .table_from_projector = screen.table_from_pinhole,
            .table_from_prop = {},
            .eye_m = eye_m};
}

PictureFigures figures(const exact::SetUp& set_up, double metres_per_box) {
    const SeenArtifact artifact = seen_artifact(set_up, 2000, metres_per_box);
    return figures_of(set_up, artifact, plan_of(set_up, artifact));
}

/// `degrees` off the screen's normal, to its right, `away_m` from its middle.
glm::dvec3 eye_at(const glm::dvec3& middle_m, double degrees, double away_m) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return middle_m + away_m * glm::dvec3(std::sin(angle), -std::cos(angle), 0.0);
}

StabilityResult slanting(const StabilityOptions&) {
    StabilityResult result;
    const glm::dvec3 middle(0.0, -0.49, 0.3); // at the front of the object's box
    for (const double degrees : {0.0, 60.0, 80.0, 89.0, 89.5, 89.8, 89.9}) {
        PictureFigures sum;
        for (const double away_m : {0.7, 2.0}) {
            sum.include(figures(set_up_of(screen_at(middle, 1.2), eye_at(middle, degrees, away_m)), 1.0));
        }
        const double per_sine = 1.0 / std::cos(degrees * std::numbers::pi / 180.0);
        append(result, rows_of(sum, fmt::format("{:g} deg: ", degrees), per_sine * screen_bound_px,
                               per_sine * gpu_bound_px));
    }
    return result;
}

StabilityResult on_the_plane_and_behind(const StabilityOptions&) {
    double lit = 0.0;
    double not_finite = 0.0;
    for (const double leans_rad : {0.0, 0.3, -0.7}) {
        const glm::dvec3 middle(0.0, -0.2, 0.3);
        const scene::FlatScreen screen = screen_at(middle, 1.2, leans_rad);
        const glm::dvec3& normal = screen.surface.faces.front().plane.normal;
        const glm::dvec3 beside = middle + glm::dvec3(0.9, 0.0, 0.0);
        for (const double height_m : {1e-300, 0.0, -1e-300, -1e-12, -1e-3, -0.1, -2.0, -1e6}) {
            for (const glm::dvec3& foot : {middle, beside, screen.surface.corners.front()}) {
                const exact::SetUp set_up = set_up_of(screen, foot + height_m * normal);
                const SeenArtifact artifact = seen_artifact(set_up, 200, 0.3);
                const scene::FramePlan plan = plan_of(set_up, artifact);
                lit += static_cast<double>(plan.draws.size() + plan.faces.size());
                not_finite += figures_of(set_up, artifact, plan).not_finite;
            }
        }
    }
    return {
        {{"draws on the screen", 0.0, lit}, {"numbers in its plan that are not finite", 0.0, not_finite}}};
}

/// The screen's plane runs through the object's middle: half of it is nearer than the screen.
StabilityResult on_the_plane(const StabilityOptions&) {
    StabilityResult result;
    for (const double leans_rad : {0.0, 0.3}) {
        const glm::dvec3 middle(0.0, 0.0, 0.15);
        const scene::FlatScreen screen = screen_at(middle, 1.2, leans_rad);
        append(result,
               rows_of(figures(set_up_of(screen, {0.2, -0.7, 0.4}), 0.5),
                       fmt::format("leaning by {:g}: ", leans_rad), screen_bound_px, 4.0 * gpu_bound_px));
    }
    return result;
}

/// An object of 6 m with the eye and the screen in it. The part behind the eye is not drawn.
StabilityResult around_the_eye(const StabilityOptions&) {
    StabilityResult result;
    const glm::dvec3 middle(0.0, 0.5, 2.0);
    constexpr double nearest_of_farthest = 1e-2;
    for (const glm::dvec3& eye : {glm::dvec3(0.0, -0.3, 2.0), glm::dvec3(0.5, -1.0, 1.5)}) {
        append(result, rows_of(figures(set_up_of(screen_at(middle, 1.2), eye), 6.0),
                               fmt::format("{:g} m before it: ", middle.y - eye.y),
                               screen_bound_px / nearest_of_farthest, gpu_bound_px / nearest_of_farthest));
    }
    return result;
}

StabilityResult sizes(const StabilityOptions&) {
    StabilityResult result;
    for (const double width_m : {0.05, 0.3, 1.2, 5.0, 20.0}) {
        const glm::dvec3 middle(0.0, -0.6 * width_m, 0.3 * width_m);
        append(result, rows_of(figures(set_up_of(screen_at(middle, width_m, 0.2),
                                                 middle + width_m * glm::dvec3(0.1, -0.8, 0.1)),
                                       width_m),
                               fmt::format("{:g} m wide: ", width_m), screen_bound_px, 4.0 * gpu_bound_px));
    }
    return result;
}

/// Nearer than a thousandth of the way to the objects' middle the screen stays dark, as a face does.
StabilityResult distances(const StabilityOptions&) {
    StabilityResult result;
    const glm::dvec3 middle(0.0, -0.06, 0.04);
    for (const double away_m : {1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0}) {
        const double sine = std::fmin(1.0, away_m / 0.1); // of the objects' middle
        append(result,
               rows_of(figures(set_up_of(screen_at(middle, 1.2), middle - glm::dvec3(0.0, away_m, 0.0)), 0.1),
                       fmt::format("{:g} m: ", away_m), screen_bound_px / sine, gpu_bound_px / sine));
    }
    double lit = 0.0;
    for (const double away_m : {1e-6, 1e-5, 5e-5}) {
        const exact::SetUp set_up = set_up_of(screen_at(middle, 1.2), middle - glm::dvec3(0.0, away_m, 0.0));
        const SeenArtifact artifact = seen_artifact(set_up, 200, 0.1);
        lit += static_cast<double>(plan_of(set_up, artifact).draws.size());
    }
    result.rows.push_back({"nearer than a thousandth: draws", 0.0, lit});
    return result;
}

/// An object of one triangle that faces the eye, as large as the eye's distance allows.
struct Small {
    scene::Part part;
    std::array<exact::Vector, 3> corners;
    exact::Real depth = 0; ///< below the eye, along the screen's normal
};

class SmallObjects {
public:
    SmallObjects() {
        pack::PackLevel level;
        for (const auto& [x, z] : {std::array{0, 0}, {65535, 0}, {0, 65535}}) {
            level.vertices.push_back(
                {{static_cast<std::uint16_t>(x), 32768, static_cast<std::uint16_t>(z)}, 0, {}});
        }
        level.indices = {0, 1, 2};
        pack::PackCluster all;
        all.index_count = 3;
        all.centre = {0.0F, 0.0F, 0.5F};
        all.radius = 1.0F;
        level.clusters = {all};
        triangles_ = std::make_shared<scene::LevelTriangles>(scene::triangles_of(level, glm::dvec3(1.0)));
    }
    [[nodiscard]] Small at(const glm::dvec3& place_m, double size_m, const exact::SetUp& set_up) const {
        Small small;
        small.part.level = {.triangles = triangles_,
                            .box_size = glm::dvec3(1.0),
                            .metres_per_box = size_m,
                            .drawable = {},
                            .samples = 2};
        small.part.level.prop_from_placed[3] = glm::dvec4(place_m, 1.0);
        const exact::Real y = static_cast<exact::Real>(size_m) * (32768.0L / 65535.0L - 0.5L);
        const exact::Real half = 0.5L * size_m;
        const exact::Vector place = exact::of(place_m);
        small.corners = {place + exact::Vector{-half, y, 0}, place + exact::Vector{half, y, 0},
                         place + exact::Vector{-half, y, 2 * half}};
        const geometry::PropFace& face = set_up.prop.faces.front();
        small.depth = set_up.height(face, exact::of(set_up.eye_m)) - set_up.height(face, small.corners[0]);
        return small;
    }

private:
    std::shared_ptr<const scene::LevelTriangles> triangles_;
};

/// The error of depth in 32 bits: the near plane lies at a thousandth of the far one, and z and w round once each.
constexpr double depth_share = 1e3 * 4.0 * 0x1p-24;

struct SmallFigures {
    double error_px = 0.0;
    double missing = 0.0; ///< seen by rays and not drawn
    double not_finite = 0.0;
    double cut = 0.0; ///< outside of the depth range, of those deeper than `cut_below`
    double swapped =
        0.0; ///< greatest difference of two depths that come out in the other order, of the depth
    double seen = 0.0;
};

/// The corners of each draw that is deeper than `cut_below` against rays; `objects` go from near to far.
SmallFigures check(const std::vector<Small>& objects, const exact::SetUp& set_up, exact::Real cut_below) {
    std::vector<scene::Part> parts;
    for (const Small& each : objects) {
        parts.push_back(each.part);
    }
    scene::FramePlan plan = scene::make_plan(set_up.prop, 3 * parts.size(), parts.size());
    scene::plan_frame(set_up.prop, parts,
                      {.projector = set_up.projector,
                       .table_from_projector = set_up.table_from_projector,
                       .table_from_prop = {},
                       .eyes_m = {&set_up.eye_m, 1}},
                      plan);
    SmallFigures figures;
    auto draw = plan.draws.begin();
    float deepest = -2.0F; // so far
    exact::Real deepest_is = 0;
    for (const Small& each : objects) {
        const geometry::PropFace& face = set_up.prop.faces.front();
        const auto seen = set_up.see(face, each.corners[0]);
        const bool shows = seen && seen->on_face;
        const bool planned =
            draw != plan.draws.end() &&
            draw->prop_from_unit[3] ==
                glm::vec4(glm::dvec4(
                    glm::dvec3(each.part.level.prop_from_placed[3]) + each.part.level.placed_box().low, 1.0));
        figures.missing += shows && !planned ? 1.0 : 0.0;
        if (!planned) {
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec4 unit(k == 1 ? 1.0F : 0.0F, 32768.0F / 65535.0F, k == 2 ? 1.0F : 0.0F, 1.0F);
            const glm::vec4 clip = draw->clip_from_unit * unit;
            const auto at = set_up.see(face, each.corners[k]);
            figures.not_finite += std::isfinite(clip.x + clip.y + clip.z + clip.w) ? 0.0 : 1.0;
            if (!at || !at->on_face || each.depth < cut_below) {
                continue;
            }
            figures.seen += 1.0;
            const double u = 0.5 * (double{clip.x} / double{clip.w} + 1.0) * set_up.projector.width;
            const double v = 0.5 * (double{clip.y} / double{clip.w} + 1.0) * set_up.projector.height;
            figures.error_px = std::fmax(
                figures.error_px, std::hypot(u - static_cast<double>(at->u), v - static_cast<double>(at->v)));
            const float depth = clip.z / clip.w;
            figures.cut += depth >= -1.0F && depth <= 1.0F ? 0.0 : 1.0;
            if (depth < deepest) {
                figures.swapped =
                    std::fmax(figures.swapped, static_cast<double>((each.depth - deepest_is) / each.depth));
            } else {
                deepest = depth;
                deepest_is = each.depth;
            }
        }
        ++draw;
    }
    return figures;
}

StabilityResult ten_thousand(const StabilityOptions&) {
    const glm::dvec3 middle(0.0, 0.7, 0.5);
    const exact::SetUp set_up = set_up_of(screen_at(middle, 1.2), {0.1, -0.4, 0.6});
    const SmallObjects kind;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> spread(0.0, 1.0);
    std::vector<Small> objects;
    for (int k = 0; k < 10'000; ++k) {
        const glm::dvec3 place(20.0 * spread(random) - 10.0, 30.0 * spread(random),
                               6.0 * spread(random) - 2.0);
        objects.push_back(kind.at(place, 0.01 + 0.3 * spread(random), set_up));
    }
    std::sort(objects.begin(), objects.end(),
              [](const Small& a, const Small& b) { return a.depth < b.depth; });
    const SmallFigures figures = check(objects, set_up, 0);
    return {{{"objects that rays see and the plan lacks", 0.0, figures.missing},
             {"32-bit, px", gpu_bound_px / 0.02, figures.error_px},
             {"numbers that are not finite", 0.0, figures.not_finite},
             {"corners outside of the depth range", 0.0, figures.cut},
             {"depths that are swapped, differing by a share of", depth_share, figures.swapped},
             {"corners compared, short of 1000", 0.0, std::fmax(0.0, 1000.0 - figures.seen)}}};
}

/// From 0.1 mm before the eye to 100 m. A part nearer than 1/500 of the farthest may be cut away.
StabilityResult depth_ratios(const StabilityOptions&) {
    const glm::dvec3 middle(0.0, 0.7, 0.5);
    const exact::SetUp set_up = set_up_of(screen_at(middle, 1.2), {0.0, 0.0, 0.5});
    const SmallObjects kind;
    std::vector<Small> objects;
    for (const double depth_m : sweep(1e-4, 100.0, 20)) {
        objects.push_back(kind.at({0.0, depth_m, 0.5}, 0.2 * depth_m, set_up));
    }
    const exact::Real farthest = objects.back().depth;
    const SmallFigures figures = check(objects, set_up, 2e-3L * farthest);
    return {{{"objects that rays see and the plan lacks", 0.0, figures.missing},
             {"numbers that are not finite", 0.0, figures.not_finite},
             {"32-bit, px", gpu_bound_px * 500.0, figures.error_px},
             {"corners outside of the depth range", 0.0, figures.cut},
             {"depths that are swapped, differing by a share of", depth_share, figures.swapped},
             {"corners compared, short of 100", 0.0, std::fmax(0.0, 100.0 - figures.seen)}}};
}

} // namespace

std::vector<StabilityCase> room_cases() {
    const std::string theme = "room";
    return {
        {theme, "a screen seen at 0 to 89.9 degrees", FloatingPoint::Strict, slanting},
        {theme, "an eye on the screen's plane and behind it", FloatingPoint::Strict, on_the_plane_and_behind},
        {theme, "an object on the screen's plane", FloatingPoint::Strict, on_the_plane},
        {theme, "an object around the eye", FloatingPoint::Strict, around_the_eye},
        {theme, "screens of 5 cm to 20 m", FloatingPoint::Strict, sizes},
        {theme, "eyes at 1 mm to 100 m", FloatingPoint::Strict, distances},
        {theme, "10000 objects", FloatingPoint::Strict, ten_thousand},
        {theme, "depths of 1e-4 to 100 m", FloatingPoint::Strict, depth_ratios}};
}

} // namespace frustumscreen::bench
