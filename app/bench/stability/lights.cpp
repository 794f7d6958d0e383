// The light that the prop reflects while a visitor walks, and while the prop is slid and turned.

#include "app/bench/stability/themes.h"
#include "app/scene/light.h"
#include "app/settings/light_range.h"
#include "app/settings/whole_zone.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace frustumscreen::bench {

namespace {

constexpr int walks = 40;
constexpr int steps_a_walk = 500;
constexpr double step_m = 1e-4;
constexpr double step_deg = 0.05;

/// A visitor's head position and the prop's pose on the table.
struct Pose {
    glm::dvec3 eye_m{0.0};
    glm::dvec2 place_m{0.0};
    double yaw = 0.0;
};

class Table {
public:
    explicit Table(const settings::Settings& settings)
        : projector_(settings.projector), prop_(settings::make_prop(settings.prop)),
          compensation_(scene::light_compensation(settings)), eye_(settings.eye),
          reach_m_(settings::reach_on_table(settings.prop, settings.table)) {
        compensation_.hull = std::make_shared<const std::vector<glm::dvec3>>(settings::usual_artifact(prop_));
    }

    [[nodiscard]] Pose random_pose(std::mt19937& random) const {
        std::uniform_real_distribution<double> share(-1.0, 1.0);
        Pose pose;
        pose.place_m = reach_m_ * glm::dvec2(share(random), share(random));
        pose.yaw = std::numbers::pi * share(random);
        const double least = eye_.lowest_elevation_deg * std::numbers::pi / 180.0;
        const double elevation = std::lerp(least, 0.5 * std::numbers::pi, 0.5 + 0.5 * share(random));
        const double azimuth = std::numbers::pi * share(random);
        const double distance = std::lerp(eye_.nearest_m, 1.0, 0.5 + 0.5 * share(random));
        pose.eye_m = glm::dvec3(pose.place_m, prop_.middle.z) +
                     distance * glm::dvec3(std::cos(elevation) * std::cos(azimuth),
                                           std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        return pose;
    }

    /// The light that each corner and middle of each face reflects to the eye, relative to the exhibit's
    /// target; nullopt where it is not both seen and lit.
    [[nodiscard]] std::vector<std::optional<double>> sent_back(const Pose& pose) const {
        const geometry::RigidTransform table_from_prop{glm::angleAxis(pose.yaw, glm::dvec3(0, 0, 1)),
                                                       glm::dvec3(pose.place_m, 0.0)};
        const geometry::RigidTransform projector_from_prop =
            projector_.table_from_projector.inverse() * table_from_prop;
        const glm::dvec3 lens = projector_from_prop.inverse().translation;
        const glm::dvec3 eye = table_from_prop.inverse().point(pose.eye_m);
        std::vector<scene::SeenFace> faces;
        for (const geometry::PropFace& face : prop_.faces) {
            faces.push_back({&face, eye});
        }
        const double reference = scene::reference_light(faces, lens, compensation_);
        std::vector<std::optional<double>> sent;
        for (const geometry::PropFace& face : prop_.faces) {
            const scene::FaceLight light = scene::face_light(face, projector_from_prop.matrix(), reference);
            const glm::dvec3 middle = 0.5 * (face.corners[0] + face.corners[2]);
            for (const glm::dvec3& point :
                 {face.corners[0], face.corners[1], face.corners[2], face.corners[3], middle}) {
                const auto pixel = projector_.pinhole.pixel(projector_from_prop.point(point));
                const double received = settings::received_light(face.plane, point, lens);
                sent.push_back(pixel && received > 0.0 && face.plane.distance(eye) > 0.0
                                   ? std::optional(scene::gain(light, projector_.pinhole, *pixel) * received /
                                                   compensation_.reference)
                                   : std::nullopt);
            }
        }
        return sent;
    }

private:
    settings::ProjectorSettings projector_;
    geometry::PropShape prop_;
    scene::LightCompensation compensation_;
    settings::EyeSettings eye_;
    glm::dvec2 reach_m_;
};

/// The largest change of a point's light in one step, relative to the exhibit's target, over points that stay
/// seen and lit.
double max_change(const Table& table, unsigned seed, const auto& step) {
    std::mt19937 random(seed);
    double most = 0.0;
    for (int walk = 0; walk < walks; ++walk) {
        Pose pose = table.random_pose(random);
        const Pose goal = table.random_pose(random);
        std::vector<std::optional<double>> before = table.sent_back(pose);
        for (int k = 0; k < steps_a_walk; ++k) {
            step(pose, goal);
            std::vector<std::optional<double>> now = table.sent_back(pose);
            for (std::size_t point = 0; point < now.size(); ++point) {
                if (now[point] && before[point]) {
                    most = std::fmax(most, std::abs(*now[point] - *before[point]));
                }
            }
            before = std::move(now);
        }
    }
    return most;
}

StabilityResult walks_in(const std::string& name, const settings::Settings& settings, double bound_a_mm,
                         double bound_a_turn) {
    const Table table(settings);
    const auto towards = [](auto& from, const auto& to) { from += step_m * glm::normalize(to - from); };
    const double head =
        max_change(table, 1, [&](Pose& pose, const Pose& goal) { towards(pose.eye_m, goal.eye_m); });
    const double slide =
        max_change(table, 2, [&](Pose& pose, const Pose& goal) { towards(pose.place_m, goal.place_m); });
    const double turn = max_change(
        table, 3, [&](Pose& pose, const Pose&) { pose.yaw += step_deg * std::numbers::pi / 180.0; });
    return {{{name + ": light sent back, change a mm of the head", bound_a_mm, head * 1e-3 / step_m},
             {name + ": change a mm of the prop", bound_a_mm, slide * 1e-3 / step_m},
             {name + ": change a turn of 0.05 deg", bound_a_turn, turn}}};
}

/// The shipped table: the light is constant, up to the gains' 32 bits.
StabilityResult shipped(const StabilityOptions&) {
    constexpr double rounding = 5e-6;
    return walks_in("shipped", settings::Settings{}, 1e-3 / step_m * rounding, rounding);
}

/// A steep prop close to the projector: faces dim as they lose light, and the other faces dim with them.
StabilityResult steep(const StabilityOptions&) {
    settings::Settings settings;
    settings.projector.pinhole = {
        .width = 1280, .height = 800, .fx = 2850.0, .fy = 2850.0, .cx = 640.0, .cy = 400.0};
    settings.projector.table_from_projector.translation = {0.0, 0.0, 0.9};
    settings.prop = {.kind = settings::PropKind::Frustum,
                     .base_m = 0.16,
                     .top_m = 0.09,
                     .height_m = 0.12,
                     .zone = settings::PropZone::Table};
    settings.table = {0.404, 0.252};
    return walks_in("steep prop", settings, 0.01, 0.01);
}

} // namespace

std::vector<StabilityCase> light_cases() {
    const std::string theme = "light";
    return {{theme, "walks around the shipped table", FloatingPoint::Strict, shipped},
            {theme, "walks around a steep prop", FloatingPoint::Strict, steep}};
}

} // namespace frustumscreen::bench
