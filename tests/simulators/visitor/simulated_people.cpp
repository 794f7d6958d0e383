#include "tests/simulators/visitor/simulated_people.h"

#include "app/geometry/transform.h"

#include <cmath>
#include <numbers>

namespace frustumscreen::simulators {

namespace {

double between(std::mt19937_64& random, double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
}

double about(std::mt19937_64& random, double mean, double sd) {
    return std::normal_distribution<double>(mean, sd)(random);
}

/// Right, forward and up axes of a head or a trunk.
glm::dmat3 facing(const glm::dvec2& towards, double pitch) {
    const glm::dvec2 across = glm::normalize(towards);
    const glm::dvec3 right(across.y, -across.x, 0.0);
    const glm::dvec3 ahead(std::cos(pitch) * across, -std::sin(pitch));
    return {right, ahead, glm::cross(right, ahead)};
}

void add_hair(std::vector<Ball>& body, const Person& person, const glm::dmat3& axes,
              const glm::dvec3& crown_middle, const glm::dvec3& skull_half) {
    if (person.hair == Hair::Bald) {
        return;
    }
    // Hair leaves the face free: its middle is behind and above the skull's.
    const glm::dvec3 behind = axes * glm::dvec3(0.0, -0.016, 0.012 + 0.5 * person.hair_top_m);
    body.push_back(ball(crown_middle + behind, axes,
                        skull_half + glm::dvec3(person.hair_side_m, 0.0, 0.5 * person.hair_top_m - 0.012),
                        person.hair_reflectance));
    if (person.hair == Hair::Long) {
        body.push_back(ball(crown_middle + axes * glm::dvec3(0.0, -0.03, -0.11), axes,
                            {skull_half.x + 1.3 * person.hair_side_m, 0.07, 0.16}, person.hair_reflectance));
    }
    if (person.hair == Hair::Hat) {
        body.push_back(ball(crown_middle + axes * glm::dvec3(0.0, 0.01, 0.06), axes,
                            {skull_half.x + 0.05, skull_half.y + 0.05, 0.02}, person.clothes));
        body.push_back(ball(crown_middle + axes * glm::dvec3(0.0, -0.005, 0.07), axes,
                            {skull_half.x + 0.008, skull_half.y + 0.008, 0.08}, person.clothes));
    }
}

} // namespace

Ball ball(const glm::dvec3& middle_m, const glm::dmat3& axes, const glm::dvec3& half_m, double reflectance) {
    glm::dmat3 scaled = glm::transpose(axes);
    for (int column = 0; column < 3; ++column) {
        scaled[column] /= half_m;
    }
    return {middle_m, scaled, std::fmax(half_m.x, std::fmax(half_m.y, half_m.z)), reflectance};
}

Ball limb(const glm::dvec3& from_m, const glm::dvec3& to_m, double thick_m, double reflectance) {
    const glm::dvec3 along = glm::normalize(to_m - from_m);
    const glm::dvec3 other = std::abs(along.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(along, other));
    return ball(0.5 * (from_m + to_m), {right, along, glm::cross(right, along)},
                {thick_m, 0.5 * glm::distance(from_m, to_m) + thick_m, thick_m}, reflectance);
}

std::optional<double> enter(const Ball& ball, const glm::dvec3& origin_m, const glm::dvec3& direction) {
    const glm::dvec3 from = ball.unit_from_table * (origin_m - ball.middle_m);
    const glm::dvec3 to = ball.unit_from_table * direction;
    const double a = glm::dot(to, to);
    const double half_b = glm::dot(from, to);
    const double under = half_b * half_b - a * (glm::dot(from, from) - 1.0);
    if (under < 0.0) {
        return std::nullopt;
    }
    const double t = (-half_b - std::sqrt(under)) / a;
    return t > 0.0 ? std::optional(t) : std::nullopt;
}

Person any_person(Build build, std::mt19937_64& random) {
    Person person;
    const bool child = build == Build::Child;
    person.head_m = {about(random, child ? 0.142 : 0.150, 0.006), about(random, child ? 0.182 : 0.193, 0.007),
                     about(random, child ? 0.108 : 0.115, 0.006)};
    const double kind = between(random, 0.0, 1.0);
    person.hair = kind < 0.55 ? Hair::Short : kind < 0.9 ? Hair::Long : kind < 0.95 ? Hair::Hat : Hair::Bald;
    person.hair_top_m = between(random, 0.005, 0.035);
    person.hair_side_m = between(random, 0.003, 0.025);
    person.skin = between(random, 0.12, 0.55);
    person.hair_reflectance =
        between(random, 0.0, 1.0) < 0.7 ? between(random, 0.03, 0.12) : between(random, 0.2, 0.5);
    person.clothes = between(random, 0.05, 0.7);
    person.nods = between(random, 0.45, 0.75);
    person.turned_rad = about(random, 0.0, glm::radians(6.0));
    person.phase = between(random, 0.0, 100.0);
    return person;
}

glm::dvec3 any_eye(Build build, double azimuth_rad, double outside_m, const glm::dvec2& table_size_m,
                   std::mt19937_64& random) {
    const glm::dvec2 towards(std::sin(azimuth_rad), -std::cos(azimuth_rad));
    const glm::dvec2 to_edge = 0.5 * table_size_m / glm::max(glm::abs(towards), glm::dvec2(1e-9));
    const double away = std::fmin(to_edge.x, to_edge.y) + outside_m;
    const double height = build == Build::Adult
                              ? about(random, 0.62, 0.08) // a table of 0.9 m, a slightly bent head
                          : build == Build::Child ? about(random, 0.28, 0.06)
                                                  : about(random, 0.30, 0.04);
    return {away * towards, height};
}

glm::dvec3 sway(const Person& person, double t_s) {
    const auto wave = [&](double hz, double shift) {
        return std::sin(2.0 * std::numbers::pi * hz * t_s + person.phase + shift);
    };
    const double size = person.sway_m * std::numbers::sqrt2 / std::sqrt(1.0 + 0.36 + 0.09);
    return size * glm::dvec3(wave(0.17, 0.0) + 0.6 * wave(0.41, 1.0) + 0.3 * wave(0.9, 2.0),
                             wave(0.21, 3.0) + 0.6 * wave(0.37, 4.0) + 0.3 * wave(1.1, 5.0),
                             0.2 * wave(0.29, 6.0));
}

std::vector<Ball> body_of(const Person& person, const glm::dvec3& eye_m, const glm::dvec3& prop_m) {
    const glm::dvec2 across(prop_m - eye_m);
    const double down = std::atan2(eye_m.z - prop_m.z, glm::length(across));
    const double c = std::cos(person.turned_rad);
    const double s = std::sin(person.turned_rad);
    const glm::dmat3 head =
        facing({c * across.x - s * across.y, s * across.x + c * across.y}, person.nods * down);
    const glm::dmat3 trunk = facing(across, 0.15);
    const glm::dvec3& size = person.head_m;
    const double crown = size.z; // from the top to the skull's middle, which lies 10 mm above the eyes
    const glm::dvec3 skull_half(0.5 * size.x, 0.5 * size.y, crown - 0.01);
    const glm::dvec3 skull = eye_m + head * glm::dvec3(0.0, 0.02 - 0.5 * size.y, 0.01);
    std::vector<Ball> body{
        ball(skull, head, skull_half, person.skin),
        ball(skull + head * glm::dvec3(0.0, 0.03, -0.075), head, {0.40 * size.x, 0.065, 0.065}, person.skin)};
    add_hair(body, person, head, skull, skull_half);
    const double body_scale = size.z < 0.111 ? 0.75 : 1.0;
    const glm::dvec3 neck = skull + glm::dvec3(0, 0, -0.2 * body_scale) - 0.03 * trunk[1];
    body.push_back(limb(skull + head * glm::dvec3(0.0, -0.02, -0.06), neck, 0.055 * body_scale, person.skin));
    const glm::dvec3 shoulders = neck - body_scale * glm::dvec3(0, 0, 0.05) - 0.02 * trunk[1];
    body.push_back(ball(shoulders, trunk, body_scale * glm::dvec3(0.21, 0.10, 0.07), person.clothes));
    body.push_back(ball(shoulders - body_scale * glm::dvec3(0, 0, 0.30), trunk,
                        body_scale * glm::dvec3(0.18, 0.12, 0.36), person.clothes));
    for (const double side : {-1.0, 1.0}) {
        const glm::dvec3 shoulder = shoulders + trunk * (body_scale * glm::dvec3(side * 0.19, 0.0, 0.0));
        const glm::dvec3 hand = person.holds ? prop_m + trunk * glm::dvec3(side * 0.12, -0.05, -0.02)
                                             : shoulder - body_scale * glm::dvec3(0, 0, 0.6);
        const glm::dvec3 elbow =
            0.5 * (shoulder + hand) + trunk * (body_scale * glm::dvec3(side * 0.08, 0.0, -0.12));
        body.push_back(limb(shoulder, elbow, 0.045 * body_scale, person.clothes));
        body.push_back(limb(elbow, hand, 0.035 * body_scale, person.clothes));
        body.push_back(ball(hand, trunk, body_scale * glm::dvec3(0.035, 0.05, 0.03), person.skin));
    }
    return body;
}

} // namespace frustumscreen::simulators
