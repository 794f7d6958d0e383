/// Windows on the table that show a world pinned from the prop, and the rays that tell what each pixel shows: from the
/// eye through the place on the table that the pixel lights, to the first of the moved triangles.
///
/// Frames   as named; table T.
/// Threads  values; any.
#pragma once

#include "app/scene/pinned_view.h"
#include "app/scene/window_plan.h"
#include "tests/render/torch_world.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <vector>

namespace frustumscreen::synthetic {

struct Pinned {
    scene::PinnedView view;
    std::vector<scene::Part> parts;

    /// `share`: of the world's ball that lies behind the window; below 1 the rest reaches out of it.
    Pinned(const TestTable& table, std::span<const scene::Part> world, const scene::WindowPlace& place,
           double share = 1.0)
        : view(scene::pin_view({.table_from_prop = table.table_from_prop,
                                .prop_middle = table.prop.middle,
                                .eye_m = table.eye_m,
                                .world = share_of(scene::ball_around(world).value(), share),
                                .place = place})
                   .value()) {
        scene::move_behind(view.window_from_prop, world, parts);
    }
    [[nodiscard]] scene::PlacedWindow placed() const {
        return {.surface = &view.surface, .table_from_window = view.table_from_window, .parts = parts};
    }
    /// The window's plane in the frame of the prop whose world it shows.
    [[nodiscard]] geometry::Plane plane() const {
        const glm::dmat3 turn(view.window_from_prop / view.scale);
        return {.normal = glm::transpose(turn) * glm::dvec3(0.0, 0.0, 1.0),
                .offset = -view.window_from_prop[3].z / view.scale};
    }

private:
    static scene::WorldBall share_of(scene::WorldBall ball, double share) {
        ball.radius *= share;
        return ball;
    }
};
[[nodiscard]] inline std::vector<scene::PlacedWindow> placed(std::span<const Pinned> pinned) {
    std::vector<scene::PlacedWindow> windows;
    for (const Pinned& each : pinned) {
        windows.push_back(each.placed());
    }
    return windows;
}

/// The place that a pixel of the projector lights.
struct LitPlace {
    bool prop = false;
    int window = -1;       ///< -1: none
    glm::dvec3 point{0.0}; ///< on the table, table frame, unless it is the prop
};

/// A ray of a window's eye, in the frame of the prop whose world it shows.
struct PropRay {
    glm::dvec3 from{0.0}, direction{0.0};
};

class WindowTruth {
public:
    WindowTruth(const TestTable& table, std::span<const Pinned> pinned) : table_(table), pinned_(pinned) {}

    [[nodiscard]] LitPlace at(const glm::dvec2& pixel) const {
        const glm::dvec3 from = table_.table_from_projector.translation;
        const glm::dvec3 ray = table_.table_from_projector.direction(table_.projector.ray(pixel));
        const geometry::RigidTransform prop_from_table = table_.table_from_prop.inverse();
        geometry::PropHit hit;
        if (geometry::enter(table_.prop, prop_from_table.point(from), prop_from_table.direction(ray), hit)) {
            return {.prop = true};
        }
        LitPlace lit{.point = from - from.z / ray.z * ray};
        for (std::size_t k = 0; k < pinned_.size(); ++k) {
            if (inside(pinned_[k], lit.point) > 0.0) {
                lit.window = static_cast<int>(k);
            }
        }
        return lit;
    }
    /// The eye's ray through a place in a window.
    [[nodiscard]] PropRay ray(int window, const glm::dvec3& point) const {
        const scene::PinnedView& view = pinned_[static_cast<std::size_t>(window)].view;
        const glm::dmat4 prop_from_table =
            glm::inverse(view.window_from_prop) * view.table_from_window.inverse().matrix();
        const glm::dvec3 from(prop_from_table * glm::dvec4(table_.eye_m, 1.0));
        return {from, glm::dvec3(prop_from_table * glm::dvec4(point, 1.0)) - from};
    }
    /// Whether all places within `radius` pixels are alike.
    template <typename Alike>
    [[nodiscard]] bool all_around(const glm::dvec2& pixel, double radius, const Alike& alike) const {
        for (int k = 0; k < 32; ++k) {
            const double angle = k * std::numbers::pi / 8.0;
            const double r = radius * (k < 16 ? 0.5 : 1.0);
            if (!alike(pixel + r * glm::dvec2(std::cos(angle), std::sin(angle)))) {
                return false;
            }
        }
        return true;
    }

private:
    /// Distance to the nearest edge, metres; negative outside.
    [[nodiscard]] static double inside(const Pinned& pinned, const glm::dvec3& point) {
        const glm::dvec3 at = pinned.view.table_from_window.inverse().point(point);
        const glm::dvec3& corner = pinned.view.surface.faces[0].corners[2];
        return std::fmin(corner.x - std::fabs(at.x), corner.y - std::fabs(at.y));
    }

    const TestTable& table_;
    std::span<const Pinned> pinned_;
};

/// The error of a drawing, pixels.
struct WindowTolerance {
    double outline_px = 1.0 / 32.0; ///< of what is seen
    double edge_px = 1.0 / 32.0;    ///< of the window
};
inline constexpr double cover_px =
    2.0; ///< a window may end so far from the prop: its margin, across a pixel's corners

struct WindowCounts {
    std::size_t shown = 0, empty = 0; ///< pixels of windows
    std::size_t prop = 0, table = 0;
    std::size_t outline = 0, edge = 0, cover = 0; ///< excused
    std::size_t wrong = 0;

    [[nodiscard]] std::size_t windows() const { return shown + empty; }
};

/// `part_of`: a code's part, -1 for black. `first`: the part that a ray meets first.
template <typename PartOf, typename First>
void count_pixels(const WindowTruth& truth, const WindowTolerance& tolerance, const image::Image8& without,
                  const image::Image8& with, const PartOf& part_of, const First& first,
                  WindowCounts& counts) {
    const auto shown_at = [&](const LitPlace& lit) {
        if (lit.prop || lit.window < 0) {
            return -1;
        }
        const PropRay ray = truth.ray(lit.window, lit.point);
        return first(ray.from, ray.direction);
    };
    for (int y = 0; y < with.height; ++y) {
        for (int x = 0; x < with.width; ++x) {
            const glm::dvec2 pixel(x + 0.5, y + 0.5);
            const LitPlace lit = truth.at(pixel);
            counts.prop += lit.prop ? 1U : 0U;
            counts.table += !lit.prop && lit.window < 0 ? 1U : 0U;
            if (lit.prop) {
                counts.wrong += with.at(x, y) == without.at(x, y) ? 0U : 1U;
                continue;
            }
            const int own = shown_at(lit);
            counts.shown += lit.window >= 0 && own >= 0 ? 1U : 0U;
            counts.empty += lit.window >= 0 && own < 0 ? 1U : 0U;
            const int drawn = part_of(with.at(x, y));
            const bool as_without = with.at(x, y) == without.at(x, y);
            if (lit.window < 0 ? as_without : drawn == own) {
                continue;
            }
            if (!truth.all_around(pixel, tolerance.edge_px,
                                  [&](const glm::dvec2& at) { return truth.at(at).window == lit.window; })) {
                ++counts.edge;
            } else if (as_without && !truth.all_around(pixel, cover_px, [&](const glm::dvec2& at) {
                           return !truth.at(at).prop;
                       })) {
                ++counts.cover;
            } else if (!truth.all_around(pixel, tolerance.outline_px, [&](const glm::dvec2& at) {
                           return shown_at(truth.at(at)) == own;
                       })) {
                ++counts.outline;
            } else {
                ++counts.wrong;
            }
        }
    }
}

/// A world drawn in the prop and in windows, by one renderer.
struct WindowRig {
    Interlocked world;
    TestTable table;
    std::vector<Pinned> pinned;

    WindowRig(const std::vector<WorldObject>& objects, std::span<const Way> chosen, int samples = 1,
              const geometry::Lens& lens = {}, std::size_t room = 6, bool torches = false)
        : world(geometry::make_frustum({}), objects, samples, lens, 256, torches), table(table_of(lens)) {
        world.choose(chosen);
        std::size_t indices = 0;
        for (const scene::Part& part : world.parts) {
            indices += part.level.triangles ? part.level.triangles->indices.size() : 0;
        }
        scene::make_window_space(world.plan, room, 2 * indices, 2 * world.parts.size(), torches);
    }
    void pin(const scene::WindowPlace& place, double share = 1.0) {
        pinned.emplace_back(table, world.parts, place, share);
    }
    /// As many as fit beside each other, some of them partly behind the prop or out of the picture.
    void pin_some(std::mt19937& random, std::size_t count) {
        std::uniform_real_distribution<double> u(-1.0, 1.0);
        pinned.clear();
        for (std::size_t k = 0; k < count; ++k) {
            const double side = k % 2 == 0 ? -1.0 : 1.0;
            const double row = count > 2 ? static_cast<double>(k / 2) - 0.5 : 0.0;
            pin({.middle_m = {0.14 * side + 0.02 * u(random), 0.12 * row + 0.03 * u(random)},
                 .yaw_rad = std::numbers::pi * u(random),
                 .width_m = 0.075,
                 .depth_m = 0.06});
        }
    }
    [[nodiscard]] scene::PlanView view(std::span<const scene::PlacedWindow> windows,
                                       std::optional<scene::LightCompensation> light = std::nullopt) const {
        scene::PlanView made = table.view(std::move(light));
        made.windows = windows;
        return made;
    }
    [[nodiscard]] image::Image8 picture(std::optional<scene::LightCompensation> light = std::nullopt) {
        const std::vector<scene::PlacedWindow> windows = placed(pinned);
        return world.picture(view(windows, std::move(light)));
    }
    [[nodiscard]] int first(const glm::dvec3& from, const glm::dvec3& direction) const {
        return world.first_on(from, direction).part;
    }
};

} // namespace frustumscreen::synthetic
