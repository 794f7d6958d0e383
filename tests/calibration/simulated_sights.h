/// A person with a sensor on the head who sights over the prop, with noise. It shares only structs with the
/// fit; its arithmetic is independent.
#pragma once

#include "app/calibration/eye_fit.h"
#include "tests/simulators/table/simulated_table.h"

#include <cmath>

namespace frustumscreen::calibration {

struct SimulatedPerson {
    glm::dvec3 left_m{0.0}, right_m{0.0}; ///< the eyes, in the sensor
    glm::dquat head_from_sensor{1.0, 0.0, 0.0, 0.0};

    [[nodiscard]] glm::dvec3 middle_m() const { return 0.5 * (left_m + right_m); }
};

/// A person whose sensor is anywhere on the forehead, at any rotation.
inline SimulatedPerson some_person(std::uint64_t seed) {
    simulators::SeededNumbers numbers(seed);
    SimulatedPerson person;
    person.head_from_sensor = numbers.rotation();
    const glm::dquat back = glm::conjugate(person.head_from_sensor);
    const glm::dvec3 middle{numbers.between(-0.04, 0.04), numbers.between(-0.02, 0.06),
                            -numbers.between(0.04, 0.1)};
    const double half = 0.5 * numbers.between(0.056, 0.07);
    person.left_m = back * (middle + glm::dvec3(-half, 0.0, 0.0));
    person.right_m = back * (middle + glm::dvec3(half, 0.0, 0.0));
    return person;
}

/// Ranges of the head's rotation between sightings.
struct HeadTurns {
    double aside_rad = 0.5, nod_rad = 0.4, lean_rad = 0.2;
};

/// One sighting: a random pose of the head, over a prop's corner, to a cross behind it. `noise`: of the
/// sighting itself.
inline EyeSight some_sight(const SimulatedPerson& person, OpenEye open, const HeadTurns& turns,
                           const SightNoise& noise, simulators::SeededNumbers& numbers) {
    EyeSight sight;
    sight.eye = open;
    sight.tip_m = {0.045, 0.045, 0.12};
    sight.cross_m = {numbers.between(-0.12, 0.2), numbers.between(0.2, 0.28), 0.0};
    const double times = numbers.between(2.0, 3.5);
    const glm::dvec3 way = sight.tip_m - sight.cross_m;
    const glm::dvec3 eye = sight.tip_m + times * way + (1.0 + times) * noise.aim_m * numbers.normals();
    // The head: x to the right, y away, z up; then turned.
    const auto about = [](double angle, const glm::dvec3& axis) { return glm::angleAxis(angle, axis); };
    const glm::dquat table_from_head = about(turns.aside_rad * numbers.between(-1.0, 1.0), {0, 0, 1}) *
                                       about(turns.nod_rad * numbers.between(-1.0, 1.0) - 0.4, {1, 0, 0}) *
                                       about(turns.lean_rad * numbers.between(-1.0, 1.0), {0, 1, 0});
    const glm::dquat rotation = table_from_head * person.head_from_sensor;
    const glm::dvec3 at = eye - rotation * (open == OpenEye::Left ? person.left_m : person.right_m);
    const glm::dvec3 turn = noise.head_rad * numbers.normals();
    const double angle = glm::length(turn);
    const glm::dquat off = angle > 0.0 ? glm::angleAxis(angle, turn / angle) : glm::dquat(1.0, 0.0, 0.0, 0.0);
    sight.table_from_sensor = {off * rotation, at + noise.head_m * numbers.normals()};
    return sight;
}

/// `count` sightings with each eye, including the shared errors.
inline EyeSights some_sights(const SimulatedPerson& person, int count, const HeadTurns& turns,
                             const SightNoise& noise, simulators::SeededNumbers& numbers) {
    EyeSights sights;
    for (const OpenEye open : {OpenEye::Left, OpenEye::Right}) {
        for (int k = 0; k < count; ++k) {
            sights.push_back(some_sight(person, open, turns, noise, numbers));
        }
    }
    const glm::dvec3 tip = noise.tip_m * numbers.normals();
    const glm::dvec3 cross = noise.cross_m * glm::dvec3(numbers.normal(), numbers.normal(), 0.0);
    for (EyeSight& sight : sights) {
        sight.tip_m += tip;
        sight.cross_m += cross;
    }
    return sights;
}

} // namespace frustumscreen::calibration
