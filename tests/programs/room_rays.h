// Rays from an eye through the pixels of a flat screen into a room, from OBJ texts, the numbers of a room file and the corners
// of the screen alone. It shares nothing with the programs.
#pragma once

#include "tests/programs/solid_rays.h"

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace frustumscreen::programs {

/// An OBJ's triangles in the frame of an object: its box's middle on the Z axis, its foot at z = 0, its longest edge 1.
struct ObjMesh {
    explicit ObjMesh(const std::string& obj) {
        glm::dvec3 low(std::numeric_limits<double>::infinity());
        glm::dvec3 high = -low;
        std::istringstream lines(obj);
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            std::string keyword;
            words >> keyword;
            if (keyword == "v") {
                glm::dvec3& at = corners.emplace_back();
                words >> at.x >> at.y >> at.z;
                low = glm::min(low, at);
                high = glm::max(high, at);
            } else if (keyword == "f") {
                std::array<std::size_t, 3>& triangle = triangles.emplace_back();
                for (std::size_t& corner : triangle) {
                    words >> corner;
                    --corner;
                }
            }
        }
        const glm::dvec3 size = high - low;
        for (glm::dvec3& at : corners) {
            at = (at - glm::dvec3(0.5 * (low.x + high.x), 0.5 * (low.y + high.y), low.z)) /
                 std::fmax(size.x, std::fmax(size.y, size.z));
        }
    }
    std::vector<glm::dvec3> corners;
    std::vector<std::array<std::size_t, 3>> triangles;
};

/// An object of the room file.
struct Placed {
    const ObjMesh* mesh = nullptr;
    glm::dvec3 place_m{0.0};
    double turn_deg = 0.0;
    double size_m = 1.0;
    double turns_per_minute = 0.0;
    glm::dvec3 sway_m{0.0};
    double sway_s = 10.0;

    [[nodiscard]] std::vector<std::array<glm::dvec3, 3>> triangles_at(double seconds) const {
        const double angle =
            turn_deg * std::numbers::pi / 180.0 + 2.0 * std::numbers::pi * turns_per_minute * seconds / 60.0;
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        const glm::dvec3 at = place_m + std::sin(2.0 * std::numbers::pi * seconds / sway_s) * sway_m;
        std::vector<std::array<glm::dvec3, 3>> all;
        for (const auto& triangle : mesh->triangles) {
            std::array<glm::dvec3, 3>& moved = all.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec3 p = size_m * mesh->corners[triangle[k]];
                moved[k] = at + glm::dvec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
            }
        }
        return all;
    }
};

struct RoomHit {
    std::size_t object = 0;
    glm::dvec3 point{0.0};
};

/// The room at one time.
class RayRoom {
public:
    RayRoom(const std::vector<Placed>& objects, double seconds) {
        for (std::size_t which = 0; which < objects.size(); ++which) {
            Sphere& around = spheres_.emplace_back();
            around.triangles = objects[which].triangles_at(seconds);
            for (const auto& triangle : around.triangles) {
                for (const glm::dvec3& corner : triangle) {
                    around.middle += corner / (3.0 * static_cast<double>(around.triangles.size()));
                }
            }
            for (const auto& triangle : around.triangles) {
                for (const glm::dvec3& corner : triangle) {
                    around.radius = std::fmax(around.radius, glm::distance(corner, around.middle));
                }
            }
        }
    }
    /// The surface that the eye sees first in this direction, before and behind the screen.
    [[nodiscard]] std::optional<RoomHit> hit(const glm::dvec3& eye, const glm::dvec3& towards) const {
        const glm::dvec3 along = glm::normalize(towards - eye);
        double first = std::numeric_limits<double>::infinity();
        std::size_t object = 0;
        for (std::size_t which = 0; which < spheres_.size(); ++which) {
            const glm::dvec3 off = spheres_[which].middle - eye;
            const double ahead = glm::dot(off, along);
            if (glm::dot(off, off) - ahead * ahead > spheres_[which].radius * spheres_[which].radius) {
                continue;
            }
            for (const RayTriangle& triangle : spheres_[which].triangles) {
                const double t = ray_meets(triangle, eye, along);
                if (t > 0.0 && t < first) {
                    first = t;
                    object = which;
                }
            }
        }
        return std::isfinite(first) ? std::optional(RoomHit{object, eye + first * along}) : std::nullopt;
    }

private:
    struct Sphere {
        std::vector<std::array<glm::dvec3, 3>> triangles;
        glm::dvec3 middle{0.0};
        double radius = 0.0;
    };
    std::vector<Sphere> spheres_;
};

/// Top left, top right, bottom right, bottom left; and pixels.
struct RayScreen {
    std::array<glm::dvec3, 4> corners_m{};
    glm::ivec2 size{0};

    [[nodiscard]] glm::dvec3 place(double x, double y) const {
        return corners_m[0] + x / size.x * (corners_m[1] - corners_m[0]) +
               y / size.y * (corners_m[3] - corners_m[0]);
    }
};

} // namespace frustumscreen::programs
