#include "app/bench/truth/poses.h"

#include "app/bench/truth/seeded_draw.h"
#include "app/settings/lit_zone.h"

#include <cmath>
#include <numbers>

namespace frustumscreen::bench {

namespace {

/// Upright on the table.
geometry::RigidTransform slid(SeededDraw& draw, const glm::dvec2& over_table) {
    const double yaw = draw.between(-std::numbers::pi, std::numbers::pi);
    return {glm::angleAxis(yaw, glm::dvec3(0.0, 0.0, 1.0)), glm::dvec3(over_table, 0.0)};
}

/// Any orientation (Shoemake 1992, uniform random rotations), from just above the table to a forearm higher.
geometry::RigidTransform held(const geometry::PropShape& prop, SeededDraw& draw,
                              const glm::dvec2& over_table) {
    constexpr double highest_above_table_m = 0.25;
    const double share = draw.between(0.0, 1.0);
    const double first = draw.between(-std::numbers::pi, std::numbers::pi);
    const double second = draw.between(-std::numbers::pi, std::numbers::pi);
    const glm::dquat rotation(std::sqrt(share) * std::cos(second), std::sqrt(1.0 - share) * std::sin(first),
                              std::sqrt(1.0 - share) * std::cos(first), std::sqrt(share) * std::sin(second));
    double lowest = 0.0;
    for (const glm::dvec3& corner : prop.corners) {
        lowest = std::fmin(lowest, (rotation * corner).z);
    }
    const glm::dvec3 middle = rotation * prop.middle;
    return {rotation,
            glm::dvec3(over_table - glm::dvec2(middle), draw.between(0.0, highest_above_table_m) - lowest)};
}

BenchPose draw_one(const settings::Settings& settings, const geometry::PropShape& prop, SeededDraw& draw) {
    const double x = draw.between(-settings.table.width_m / 2.0, settings.table.width_m / 2.0);
    const double y = draw.between(-settings.table.depth_m / 2.0, settings.table.depth_m / 2.0);
    const geometry::RigidTransform table_from_prop =
        settings.prop.zone == settings::PropZone::Hand ? held(prop, draw, {x, y}) : slid(draw, {x, y});
    const double lowest_sine = std::sin(settings.eye.lowest_elevation_deg * std::numbers::pi / 180.0);
    const double sine = draw.between(lowest_sine, 1.0);
    const double cosine = std::sqrt(1.0 - sine * sine);
    const double azimuth = draw.between(-std::numbers::pi, std::numbers::pi);
    const double distance = draw.between(settings.eye.nearest_m, settings.eye.farthest_m);
    const glm::dvec3 towards_eye(cosine * std::cos(azimuth), cosine * std::sin(azimuth), sine);
    return {table_from_prop, table_from_prop.translation + distance * towards_eye};
}

} // namespace

TruthView view_of(const settings::Settings& settings, const BenchPose& pose) {
    const geometry::RigidTransform prop_from_table = pose.table_from_prop.inverse();
    return {settings.projector.pinhole, prop_from_table * settings.projector.table_from_projector,
            prop_from_table.point(pose.eye_m)};
}

bool in_zone(const settings::Settings& settings, const geometry::PropShape& prop, const BenchPose& pose) {
    const geometry::RigidTransform projector_from_prop =
        settings.projector.table_from_projector.inverse() * pose.table_from_prop;
    const geometry::Pinhole& pinhole = settings.projector.pinhole;
    for (const geometry::PropFace& face : prop.faces) {
        for (const glm::dvec3& corner : face.corners) {
            const glm::dvec3 on_table = pose.table_from_prop.point(corner);
            const std::optional<glm::dvec2> pixel = pinhole.pixel(projector_from_prop.point(corner));
            if (std::abs(on_table.x) > settings.table.width_m / 2.0 ||
                std::abs(on_table.y) > settings.table.depth_m / 2.0 || !pixel || pixel->x < 0.0 ||
                pixel->y < 0.0 || pixel->x > pinhole.width || pixel->y > pinhole.height) {
                return false;
            }
        }
    }
    return settings::every_seen_face_is_lit(settings, pose.table_from_prop, pose.eye_m);
}

Result<std::vector<BenchPose>> draw_poses(const settings::Settings& settings, const geometry::PropShape& prop,
                                          int count, std::uint64_t seed) {
    constexpr int max_tries_each = 10000;
    SeededDraw draw(seed);
    std::vector<BenchPose> poses;
    for (std::int64_t tries = 0; static_cast<int>(poses.size()) < count; ++tries) {
        if (tries > static_cast<std::int64_t>(count) * max_tries_each) {
            return fail(
                ErrorKind::BadConfiguration, "bench.no_lit_place",
                "hardly any place on the table has the prop inside the picture and light on every face that "
                "is seen; move the projector higher or make the prop smaller");
        }
        const BenchPose pose = draw_one(settings, prop, draw);
        if (in_zone(settings, prop, pose)) {
            poses.push_back(pose);
        }
    }
    return poses;
}

} // namespace frustumscreen::bench
