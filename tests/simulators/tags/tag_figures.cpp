#include "tests/simulators/tags/tag_figures.h"

#include "app/settings/looking_at.h"
#include "app/tags/tag_pose.h"
#include "app/tags/tag_reader.h"
#include "app/tracking/pose_math.h"
#include "firmware_host/base/quantile.h"
#include "firmware_host/tags/tag_detector.h"

#include <fmt/format.h>

#include <cmath>
#include <random>

namespace frustumscreen::simulators {

namespace {

struct Lists {
    std::vector<double> off_mm, off_deg, said_mm, find_ms, fit_ms;
};

/// A random place on the table, random orientation, moving in a random direction.
PropMotion any_motion(const TagCase& of, std::mt19937_64& random) {
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    const glm::dvec3 place(0.15 * share(random), 0.08 * share(random), 0.0);
    const double yaw = glm::radians(180.0 * share(random));
    const double heading = glm::radians(180.0 * share(random));
    const glm::dvec3 velocity = of.speed_m_s * glm::dvec3(std::cos(heading), std::sin(heading), 0.0);
    const double turning = glm::radians(of.turn_deg_s);
    if (of.motion) {
        return [begin = geometry::RigidTransform{tracking::rotation_of({0.0, 0.0, yaw}), place},
                motion = of.motion(random)](double t_s) {
            const geometry::RigidTransform moved = motion(t_s);
            return geometry::RigidTransform{moved.rotation * begin.rotation,
                                            begin.translation + moved.translation};
        };
    }
    return [=](double t_s) {
        return geometry::RigidTransform{tracking::rotation_of({0.0, 0.0, yaw + turning * t_s}),
                                        place + t_s * velocity};
    };
}

/// The exhibit's knowledge of a rolling shutter after three frames before the one at 0 s.
tags::RollingShutter known_shutter(const TagScene& scene, tags::TagDetector& detector,
                                   const PropMotion& motion, std::mt19937_64& random) {
    constexpr double frame_s = 1.0 / 30.0;
    const geometry::Pinhole& pinhole = scene.camera().pinhole;
    tags::RollingShutter shutter{1e-3 * scene.camera().rolling_ms, {}, 0.0};
    std::vector<tags::FoundTag> found;
    for (const int ago : {3, 2, 1}) {
        const std::vector<std::uint8_t> picture =
            scene.picture([&](double t_s) { return motion(t_s - ago * frame_s); }, random());
        detector.find(picture, pinhole.width, pinhole.height, found);
        const auto pose =
            tags::pose_from_tags(found, scene.tags(), pinhole, tags::usual_corner_sd_px, shutter);
        shutter.before.reset();
        if (pose && tags::is_sure(*pose)) {
            shutter.before = pose->camera_from_prop;
            shutter.before_s = pose->moment_s - frame_s;
        }
    }
    return shutter;
}

} // namespace

TagFigures measure(const TagCase& of, std::size_t pictures, std::uint64_t seed) {
    std::vector<tags::PropTag> tags = tags_of(of.skirt);
    tags.resize(of.tags > 0 ? of.tags : tags.size());
    SceneCamera camera = of.camera;
    const glm::dvec3 towards = glm::normalize(glm::dvec3(0.0, -0.3, 1.27));
    camera.table_from_camera = *settings::looking_at(of.distance_m * towards, {0.0, 0.0, 0.0}, 0.0);
    const TagScene scene(geometry::make_frustum(geometry::shipped_frustum), tags, camera, of.light);
    tags::TagDetectorOptions options;
    options.decimate = of.decimate;
    tags::TagDetector detector(options);
    std::mt19937_64 random(seed);
    std::vector<tags::FoundTag> found;
    Lists lists;
    TagFigures figures{.name = of.name, .pictures = pictures};
    double squares = 0.0;
    for (std::size_t k = 0; k < pictures; ++k) {
        const PropMotion motion = any_motion(of, random);
        const tags::RollingShutter shutter =
            of.is_shutter_known ? known_shutter(scene, detector, motion, random) : tags::RollingShutter{};
        const std::vector<std::uint8_t> picture = scene.picture(motion, random());
        const double begin = 1e3 * camera::thread_seconds();
        detector.find(picture, camera.pinhole.width, camera.pinhole.height, found);
        const double between = 1e3 * camera::thread_seconds();
        const auto pose =
            tags::pose_from_tags(found, tags, camera.pinhole, tags::usual_corner_sd_px, shutter);
        lists.find_ms.push_back(between - begin);
        lists.fit_ms.push_back(1e3 * camera::thread_seconds() - between);
        figures.tags += static_cast<double>(found.size()) / static_cast<double>(pictures);
        figures.posed += pose ? 1.0 / static_cast<double>(pictures) : 0.0;
        if (!pose || !tags::is_sure(*pose)) {
            continue;
        }
        const double moment_s =
            of.is_shutter_known ? pose->moment_s + 0.5e-3 * camera.exposure_ms : scene.moment_s(motion);
        const tracking::PoseStep off =
            tracking::step_between(motion(moment_s), camera.table_from_camera * pose->camera_from_prop);
        lists.off_mm.push_back(1e3 * glm::length(off.shift_m));
        lists.off_deg.push_back(glm::degrees(glm::length(off.turn_rad)));
        lists.said_mm.push_back(1e3 * pose->place_sd_m);
        figures.worst_mm = std::fmax(figures.worst_mm, lists.off_mm.back());
        squares += std::pow(lists.off_mm.back() / lists.said_mm.back(), 2.0);
    }
    const auto taken = static_cast<double>(lists.off_mm.size());
    figures.trusted = taken / static_cast<double>(pictures);
    figures.normalised = taken > 0.0 ? std::sqrt(squares / taken) : 0.0;
    figures.fit_ms = quantile(lists.fit_ms, 0.5);
    for (const auto& [list, pair] : {std::pair(&lists.off_mm, figures.off_mm),
                                     {&lists.off_deg, figures.off_deg},
                                     {&lists.find_ms, figures.find_ms}}) {
        pair[0] = quantile(*list, 0.5);
        pair[1] = quantile(*list, 0.95);
    }
    figures.said_mm = quantile(lists.said_mm, 0.5);
    return figures;
}

} // namespace frustumscreen::simulators
