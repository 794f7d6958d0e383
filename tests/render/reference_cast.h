/// Plain ray casting of a level in 64-bit: the reference for the renderer. Every ray meets all triangles but those in a ball that it
/// misses: a ball for every 16.
#pragma once

#include "tests/render/synthetic_pack.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

namespace frustumscreen::synthetic {

class ReferenceCast {
public:
    ReferenceCast(const pack::Pack& pack, double metres) : level_(pack.levels[0]) {
        for (const pack::PackVertex& v : level_.vertices) {
            const glm::dvec3 box =
                glm::dvec3(v.position[0], v.position[1], v.position[2]) / 65535.0 * pack.box_size -
                glm::dvec3(0.5 * pack.box_size.x, 0.5 * pack.box_size.y, 0.0);
            points_.push_back(box * metres);
        }
        for (std::size_t k = 0; k < level_.indices.size(); k += in_ball) {
            balls_.push_back(ball_around(k, std::min(k + in_ball, level_.indices.size())));
        }
    }

    struct Hit {
        bool found = false;
        glm::dvec3 point{0.0};
        double edge = 1.0;      ///< smallest barycentric coordinate of the hit
        glm::dvec3 normal{0.0}; ///< of the triangle, its length is twice its area
    };

    /// Method: Möller and Trumbore 1997.
    [[nodiscard]] Hit first_hit(const glm::dvec3& origin, const glm::dvec3& direction) const {
        Hit hit;
        double nearest = std::numeric_limits<double>::infinity();
        const double square = glm::dot(direction, direction);
        for (std::size_t ball = 0; ball < balls_.size(); ++ball) {
            const glm::dvec3 aside = glm::cross(balls_[ball].centre - origin, direction);
            if (glm::dot(aside, aside) > balls_[ball].radius2 * square) {
                continue;
            }
            const std::size_t end = std::min((ball + 1) * in_ball, level_.indices.size());
            for (std::size_t k = ball * in_ball; k < end; k += 3) {
                meet(k, origin, direction, nearest, hit);
            }
        }
        return hit;
    }

    /// The eye's ray that `pixel` serves: from the eye to the place on the prop that it lights, prop frame; nullopt if the
    /// eye does not see that face.
    struct Ray {
        glm::dvec3 eye{0.0}, lit{0.0};
    };
    [[nodiscard]] static std::optional<Ray> ray_of(const TestTable& table, const glm::dvec2& pixel) {
        const geometry::RigidTransform prop_from_projector =
            table.table_from_prop.inverse() * table.table_from_projector;
        const glm::dvec3 ray = prop_from_projector.direction(table.projector.ray(pixel));
        geometry::PropHit lit;
        if (!geometry::intersect(table.prop, prop_from_projector.translation, ray, lit)) {
            return std::nullopt;
        }
        const glm::dvec3 eye = table.table_from_prop.inverse().point(table.eye_m);
        if (!(table.prop.faces[static_cast<std::size_t>(lit.face)].plane.distance(eye) > 0.0)) {
            return std::nullopt;
        }
        return Ray{eye, prop_from_projector.translation + lit.t * ray};
    }

    /// The hit shown by `pixel`, in the prop frame.
    [[nodiscard]] Hit through_pixel(const TestTable& table, const glm::dvec2& pixel) const {
        const std::optional<Ray> ray = ray_of(table, pixel);
        return ray ? first_hit(ray->eye, ray->lit - ray->eye) : Hit{};
    }

private:
    static constexpr std::size_t in_ball = 3 * 16; ///< indices
    struct Ball {
        glm::dvec3 centre{0.0};
        double radius2 = 0.0;
    };

    [[nodiscard]] Ball ball_around(std::size_t begin, std::size_t end) const {
        Ball ball;
        for (std::size_t k = begin; k < end; ++k) {
            ball.centre += points_[level_.indices[k]] / static_cast<double>(end - begin);
        }
        for (std::size_t k = begin; k < end; ++k) {
            const glm::dvec3 from_centre = points_[level_.indices[k]] - ball.centre;
            ball.radius2 =
                std::max(ball.radius2, 1.001 * glm::dot(from_centre, from_centre)); // more than rounding
        }
        return ball;
    }

    /// The triangle that begins at index `k`.
    void meet(std::size_t k, const glm::dvec3& origin, const glm::dvec3& direction, double& nearest,
              Hit& hit) const {
        const glm::dvec3& a = points_[level_.indices[k]];
        const glm::dvec3 ab = points_[level_.indices[k + 1]] - a;
        const glm::dvec3 ac = points_[level_.indices[k + 2]] - a;
        const glm::dvec3 p = glm::cross(direction, ac);
        const double determinant = glm::dot(ab, p);
        if (determinant == 0.0) {
            return;
        }
        const glm::dvec3 s = origin - a;
        const double u = glm::dot(s, p) / determinant;
        const glm::dvec3 q = glm::cross(s, ab);
        const double v = glm::dot(direction, q) / determinant;
        const double t = glm::dot(ac, q) / determinant;
        if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < nearest) {
            nearest = t;
            hit = {true, origin + t * direction, std::min(u, std::min(v, 1.0 - u - v)), glm::cross(ab, ac)};
        }
    }

    const pack::PackLevel& level_;
    std::vector<glm::dvec3> points_;
    std::vector<Ball> balls_;
};

} // namespace frustumscreen::synthetic
