/// A person with a sensor on the head at a kiosk of the shipped size, simulated report by report: the true
/// eye is put where the true corner covers the true cross.
///
/// The geometry is independent: only the crosses and corners come from the procedure.
/// Frames   table T as it really is; the kept calibration is off by half a millimetre.
#pragma once

#include "app/calibration/procedure/eye_procedure.h"
#include "tests/calibration/simulated_sights.h"

#include <gtest/gtest.h>

namespace frustumscreen::calibration {

inline constexpr Nanoseconds tick = std::chrono::milliseconds(20);     // 50 reports a second
inline constexpr double base_m = 0.30, top_m = 0.08, height_m = 0.155; ///< the prop
inline constexpr double deep_m = 0.5 * base_m;

inline glm::dquat about(double angle, const glm::dvec3& axis) {
    return glm::angleAxis(angle, axis);
}

/// A kiosk of the shipped size with its truth and a good calibration of it.
struct World {
    /// `turned`: error of the kept rotation of the prop in its sensor.
    explicit World(std::uint64_t seed, double turned = 0.0)
        : numbers(seed), person(some_person(seed)), kept_turn_rad(turned) {
        truth.pinhole = {1920, 1200, 3600.0, 3605.0, 962.0, 640.0};
        truth.pinhole.lens.k1 = 0.03;
        truth.table_from_projector = {about(0.02, {1, 0.3, 0}) * glm::dquat(0.0, 1.0, 0.0, 0.0),
                                      {0.01, 0.02, 1.5}};
        truth.table_from_tracker = {numbers.rotation(), 0.4 * numbers.normals()};
        sensor_from_prop = {numbers.rotation(), 0.04 * numbers.normals()};
        table_from_prop = {about(numbers.between(-0.4, 0.4), {0, 0, 1}), {0.11, -0.04, 0.0}};
    }
    /// The scene as kept: off by half a millimetre, with a slightly wrong lens.
    [[nodiscard]] SightScene scene() {
        SightScene scene{truth.pinhole,
                         truth.table_from_projector,
                         geometry::make_frustum({base_m, top_m, height_m}),
                         {0.0, -0.55, 0.5}};
        scene.pinhole.lens.k1 += 0.004;
        scene.table_from_projector.translation += 3e-4 * numbers.normals();
        return scene;
    }
    [[nodiscard]] geometry::Registration registration() {
        const geometry::RigidTransform turned{about(kept_turn_rad, {0, 0, 1}), {}};
        geometry::Registration kept{.table_from_tracker = truth.table_from_tracker,
                                    .sensor_from_prop = sensor_from_prop * turned};
        kept.table_from_tracker.translation += 3e-4 * numbers.normals();
        return kept;
    }
    [[nodiscard]] geometry::RigidTransform prop_report() {
        geometry::RigidTransform report =
            truth.table_from_tracker.inverse() * table_from_prop * sensor_from_prop.inverse();
        report.translation += 2e-4 * numbers.normals();
        return report;
    }
    /// The true corner of the prop that is nearest to the procedure's.
    [[nodiscard]] glm::dvec3 corner_near(const glm::dvec3& place) const {
        glm::dvec3 nearest(1e9);
        for (const glm::dvec2 side :
             {glm::dvec2(1, 1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(-1, -1)}) {
            const glm::dvec3 corner = table_from_prop.point({0.5 * top_m * side, height_m});
            nearest = glm::distance(corner, place) < glm::distance(nearest, place) ? corner : nearest;
        }
        return nearest;
    }
    /// True if a point in the table's frame lies in the prop, by the prop's width at that height.
    [[nodiscard]] bool is_in_prop(const glm::dvec3& point) const {
        const glm::dvec3 p = table_from_prop.inverse().point(point);
        const double half = 0.5 * (base_m + (top_m - base_m) * p.z / height_m);
        return p.z > 0.0 && p.z < height_m && std::fmax(std::abs(p.x), std::abs(p.y)) < half;
    }

    simulators::SeededNumbers numbers;
    SimulatedPerson person;
    double kept_turn_rad;
    CalibratedTable truth;
    geometry::RigidTransform sensor_from_prop, table_from_prop;
};

/// How well the person follows the instructions.
struct Manner {
    double turn = 0.4, nod = 0.3; ///< turn of the head, and nod of the chin
    SightNoise noise;
    double spread = 0.08;       ///< random part of each angle
    double kept_turn_rad = 0.0; ///< error of the prop's kept rotation
};

class Live {
public:
    explicit Live(std::uint64_t seed, const Manner& manner = {})
        : world(seed, manner.kept_turn_rad), manner(manner), procedure(world.scene(), world.registration()) {}

    void step(bool next = false, bool back = false) {
        now += tick;
        std::optional<geometry::RigidTransform> prop, head;
        if (sees_prop) {
            prop = world.prop_report();
        }
        if (sees_head) {
            head = trembling();
        }
        procedure.step({now, prop, next, back, head});
    }
    void wait(double seconds) {
        for (int k = 0; k < static_cast<int>(50.0 * seconds); ++k) {
            step();
        }
    }
    void next() { step(true, false); }
    void back() { step(false, true); }
    /// Goes on to the first eye to shut.
    void begin() {
        wait(0.2);
        next();
        wait(1.5);
    }
    /// Puts the true eye on the line from the true cross through the true corner, with the requested posture.
    void aim() {
        const AskedSight& asked = procedure.asked();
        const SightCross& shown = procedure.cross();
        const glm::dvec3 cross = simulators::true_light(world.truth, shown.pixel, 0.0) + cross_aside_m;
        const glm::dvec3 tip = world.corner_near(shown.tip_m);
        ASSERT_LT(glm::distance(tip, shown.tip_m), 3e-3 + 0.06 * std::abs(world.kept_turn_rad))
            << "what is lit is a corner";
        const glm::dvec3 way = tip - cross;
        const double times = world.numbers.between(0.4, 0.55) / std::hypot(way.x, way.y);
        eye_m = tip + times * way + (1.0 + times) * manner.noise.aim_m * world.numbers.normals();
        const double left = asked.posture == HeadPosture::TurnedLeft    ? 1.0
                            : asked.posture == HeadPosture::TurnedRight ? -1.0
                                                                        : 0.0;
        const double up = asked.posture == HeadPosture::ChinUp     ? 1.0
                          : asked.posture == HeadPosture::ChinDown ? -1.0
                                                                   : 0.0;
        const auto by_chance = [&] { return manner.spread * world.numbers.between(-1.0, 1.0); };
        const double ahead =
            std::atan2(way.x, -way.y); // direction from the cross to the eye, which looks back along it
        const glm::dquat table_from_head = about(ahead + left * manner.turn + by_chance(), {0, 0, 1}) *
                                           about(up * manner.nod - 0.45 + by_chance(), {1, 0, 0}) *
                                           about(by_chance(), {0, 1, 0});
        const glm::dquat rotation = table_from_head * world.person.head_from_sensor;
        const glm::dvec3 in_sensor = asked.eye == open ? eye_of(asked.eye) : eye_of(open);
        const glm::dvec3 turned = manner.noise.head_rad * world.numbers.normals();
        const glm::dquat off(1.0, 0.5 * turned.x, 0.5 * turned.y, 0.5 * turned.z);
        table_from_sensor = {glm::normalize(off) * rotation,
                             eye_m - rotation * in_sensor + manner.noise.head_m * world.numbers.normals()};
    }
    [[nodiscard]] glm::dvec3 eye_of(OpenEye eye) const {
        return eye == OpenEye::Left ? world.person.left_m : world.person.right_m;
    }
    /// Makes one sighting as requested.
    void sight() {
        if (procedure.stage() == CalibrationStage::Shut) {
            open = procedure.asked().eye;
            next();
        }
        ASSERT_EQ(procedure.stage(), CalibrationStage::Place) << static_cast<int>(procedure.word());
        aim();
        wait(0.3);
        next();
        wait(1.1);
    }
    void sight_all() {
        for (int k = 0; k < 60 && procedure.stage() != CalibrationStage::Solve; ++k) {
            sight();
        }
    }
    [[nodiscard]] EyeFit fit() {
        const auto placed = placed_sights(procedure.sights(), procedure.scene().pinhole,
                                          procedure.scene().table_from_projector, kept_table_from_tracker());
        return fit_eyes(*placed, deep_m);
    }
    void judge() {
        ASSERT_EQ(procedure.stage(), CalibrationStage::Solve);
        procedure.judge(fit());
    }
    [[nodiscard]] geometry::RigidTransform kept_table_from_tracker() const {
        return world.truth.table_from_tracker;
    }

    World world;
    Manner manner;
    EyeProcedure procedure;
    MonotonicTime now = from_microseconds(1'000'000);
    bool sees_prop = true, sees_head = true;
    OpenEye open = OpenEye::Left; ///< the eye that is really open
    glm::dvec3 cross_aside_m{0.0};
    glm::dvec3 eye_m{0.0};
    geometry::RigidTransform table_from_sensor{{1.0, 0.0, 0.0, 0.0}, {0.0, -0.6, 0.55}};

private:
    /// The head sways by 1 or 2 mm, and the tracker adds its noise.
    [[nodiscard]] geometry::RigidTransform trembling() {
        const double t = to_seconds(now.time_since_epoch());
        geometry::RigidTransform head = table_from_sensor;
        head.translation +=
            glm::dvec3(1.5e-3 * std::sin(5.0 * t), 1.5e-3 * std::cos(3.7 * t), 5e-4 * std::sin(11.0 * t));
        head.translation += 3e-4 * world.numbers.normals();
        head.rotation = about(5e-3 * std::sin(4.0 * t), {1, 0, 0}) * head.rotation;
        return world.truth.table_from_tracker.inverse() * head;
    }
};

} // namespace frustumscreen::calibration
