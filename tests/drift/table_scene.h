// A camera's view of a table while a projector shows marks: wood, changing room light, a lens with
// distortion, noise, hands, tags. The arithmetic is independent of the code under test.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/transform.h"
#include "firmware_host/tags/tag_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace frustumscreen::drift {

struct SceneFaults {
    double room = 0.15;       ///< room light, relative to the projector's white
    double room_change = 0.0; ///< relative change per second: a cloud
    double gamma = 2.2;       ///< of the camera
    double exposure = 0.8;    ///< white paper in the projector's white, as a share of the camera's range
    double noise = 1.5;       ///< codes
    double blur_m = 0.002;    ///< blur of the mark by projector and camera: standard deviation
    double mark_light = 0.25; ///< at its middle, relative to the projector's white
};

/// An object that lies or moves above the table; it covers a mark and displaces its light.
struct SceneHand {
    glm::dvec2 at_m{0.0};
    glm::dvec2 per_s{0.0};
    double radius_m = 0.05;
    double albedo = 0.7;
    double height_m = 0.05;
};

struct SceneTag {
    int id = 0;
    glm::dvec2 middle_m{0.0};
    double size_m = 0.05; ///< side of its black square
};

class TableScene {
public:
    /// A camera next to the projector, 1.3 m above the table, that sees about 0.95 m of it along its rows.
    TableScene(int width, int height, const SceneFaults& faults, std::vector<SceneTag> tags = {})
        : width_(width), height_(height), faults_(faults), tags_(std::move(tags)) {
        prepare();
        look({0.1, -0.15, 1.3});
    }
    /// Moves the camera; it always aims near the table's middle.
    void look(const glm::dvec3& from, double roll = 0.02) {
        const glm::dvec3 forward = glm::normalize(glm::dvec3(0.01, 0.0, 0.0) - from);
        const glm::dvec3 right =
            glm::normalize(glm::cross(forward, glm::dvec3(std::sin(roll), std::cos(roll), 0.0)));
        const glm::dvec3 down = glm::cross(forward, right);
        const double focal = 1.3 * width_ / 0.95;
        places_.assign(static_cast<std::size_t>(width_ * height_), glm::dvec2(0.0));
        for (int v = 0; v < height_; ++v) {
            for (int u = 0; u < width_; ++u) {
                const glm::dvec2 real((u + 0.5 - 0.5 * width_) / focal, (v + 0.5 - 0.5 * height_) / focal);
                glm::dvec2 ideal = real;
                for (int k = 0; k < 8; ++k) {
                    ideal = real / (1.0 - 0.08 * glm::dot(ideal, ideal));
                }
                const glm::dvec3 ray = forward + ideal.x * right + ideal.y * down;
                places_[index(u, v)] = glm::dvec2(from - ray * (from.z / ray.z));
            }
        }
        albedo_.clear();
        for (const glm::dvec2& place : places_) {
            albedo_.push_back(static_cast<float>(albedo(place)));
        }
    }
    struct Light {
        glm::dvec2 at_m{0.0};
        double brightness = 1.0;
    };
    [[nodiscard]] const std::vector<std::uint8_t>& frame(double time_s, const std::optional<Light>& light,
                                                         const std::vector<SceneHand>& hands = {}) {
        picture_.resize(places_.size());
        const double room = faults_.room * (1.0 + faults_.room_change * time_s);
        for (std::size_t k = 0; k < places_.size(); ++k) {
            double reflected = albedo_[k];
            glm::dvec2 aside(0.0);
            for (const SceneHand& hand : hands) {
                const glm::dvec2 middle = hand.at_m + time_s * hand.per_s;
                if (glm::distance(places_[k], middle) < hand.radius_m) {
                    reflected = hand.albedo;
                    aside = hand.height_m * glm::dvec2(0.6, -0.4); // parallax of a surface above the table
                }
            }
            double lit = room;
            if (light) {
                const double far = glm::distance(places_[k] + aside, light->at_m);
                lit += far < 0.03 ? faults_.mark_light * light->brightness * profile(far) : 0.0;
            }
            picture_[k] = code(faults_.exposure * reflected * lit);
        }
        return picture_;
    }

private:
    [[nodiscard]] std::size_t index(int u, int v) const {
        return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
    }
    /// A raised cosine of 8 mm, blurred: approximately a Gaussian.
    [[nodiscard]] double profile(double far_m) const {
        const double own = 0.0034;
        const double spread = own * own + faults_.blur_m * faults_.blur_m;
        return own * own / spread * std::exp(-0.5 * far_m * far_m / spread);
    }
    [[nodiscard]] double albedo(const glm::dvec2& p) const {
        for (const SceneTag& tag : tags_) {
            const double module_m = tag.size_m / static_cast<double>(tags::black_modules);
            const glm::dvec2 cell = (glm::dvec2(p.x - tag.middle_m.x, tag.middle_m.y - p.y)) / module_m +
                                    0.5 * static_cast<double>(tags::tag_modules);
            if (cell.x >= 0.0 && cell.y >= 0.0 && cell.x < tags::tag_modules && cell.y < tags::tag_modules) {
                const tags::TagModules modules = tags::tag_modules_of(tag.id);
                return modules[static_cast<std::size_t>(cell.y)][static_cast<std::size_t>(cell.x)] ? 0.85
                                                                                                   : 0.05;
            }
        }
        const double grain = std::sin(160.0 * p.y + 3.0 * std::sin(11.0 * p.x));
        return 0.45 + 0.08 * grain + 0.04 * std::sin(900.0 * p.y + 40.0 * p.x);
    }
    /// Tables of the camera's response and of noise, because most of a test's time is spent there.
    void prepare() {
        for (std::size_t k = 0; k < response_.size(); ++k) {
            response_[k] = static_cast<float>(
                255.0 * std::pow(static_cast<double>(k) / static_cast<double>(response_.size()),
                                 1.0 / faults_.gamma));
        }
        for (float& noise : noise_) {
            double normal = -6.0;
            for (int k = 0; k < 12; ++k) { // the sum of twelve uniform numbers is nearly normal
                normal += static_cast<double>(next() >> 40U) / 16777216.0;
            }
            noise = static_cast<float>(faults_.noise * normal);
        }
    }
    std::uint64_t next() { return state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL; }
    [[nodiscard]] std::uint8_t code(double light) {
        const auto level =
            static_cast<std::size_t>(std::clamp(light, 0.0, 0.9999) * static_cast<double>(response_.size()));
        const float value = response_[level] + noise_[next() >> 52U];
        return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 255.0F)));
    }

    int width_, height_;
    SceneFaults faults_;
    std::vector<SceneTag> tags_;
    std::vector<glm::dvec2> places_; ///< on the table, by pixel
    std::vector<float> albedo_;
    std::vector<std::uint8_t> picture_;
    std::uint64_t state_ = 1;
    std::array<float, 16384> response_{};
    std::array<float, 4096> noise_{};
};

/// The shipped kiosk's projector.
struct SceneProjector {
    geometry::Pinhole pinhole{1280, 800, 2400.0, 2400.0, 640.0, 400.0};
    geometry::RigidTransform table_from_projector{{0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.5}};

    /// Where the light intended for a place falls if the projector's pose differs from the calibrated one.
    [[nodiscard]] glm::dvec2 light(const glm::dvec2& meant_m, const geometry::RigidTransform& real) const {
        const glm::dvec2 pixel = *pinhole.pixel(table_from_projector.inverse().point({meant_m, 0.0}));
        const glm::dvec3 ray = real.direction(pinhole.ray(pixel));
        return glm::dvec2(real.translation - ray * (real.translation.z / ray.z));
    }
    [[nodiscard]] geometry::RigidTransform moved(const glm::dvec3& shift_m,
                                                 const glm::dvec3& turn_rad = {}) const {
        const double angle = glm::length(turn_rad);
        const glm::dquat turn =
            angle > 0.0 ? glm::angleAxis(angle, turn_rad / angle) : glm::dquat(1.0, 0.0, 0.0, 0.0);
        return {turn * table_from_projector.rotation, table_from_projector.translation + shift_m};
    }
};

} // namespace frustumscreen::drift
