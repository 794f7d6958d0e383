// Rays through a prop's planes to the star of ProgramFolder::write_star, and a picture's hit points held against them. It
// shares nothing with the programs.
#pragma once

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace frustumscreen::programs {

struct HalfSpace {
    glm::dvec3 normal{0.0}; ///< outward
    double offset = 0.0;
    bool lit = true; ///< false: it gets no picture
};

/// The planes of a prop file's faces, in metres.
inline std::vector<HalfSpace> planes_of(const std::string& obj) {
    std::vector<glm::dvec3> corners;
    std::vector<HalfSpace> planes;
    std::istringstream lines(obj);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string keyword;
        words >> keyword;
        if (keyword == "v") {
            glm::dvec3 corner{0.0};
            words >> corner.x >> corner.y >> corner.z;
            corners.push_back(1e-3 * corner);
        } else if (keyword == "f") {
            std::array<std::size_t, 3> first{};
            words >> first[0] >> first[1] >> first[2];
            const glm::dvec3& a = corners[first[0] - 1];
            const glm::dvec3 normal =
                glm::normalize(glm::cross(corners[first[1] - 1] - a, corners[first[2] - 1] - a));
            planes.push_back({.normal = normal, .offset = glm::dot(normal, a)});
        }
    }
    return planes;
}

/// Where a ray from outside enters the half-spaces' common part, and through which.
struct Entry {
    double t = 0.0;
    std::size_t plane = 0;
};
inline std::optional<Entry> entry(const std::vector<HalfSpace>& planes, const glm::dvec3& from,
                                  const glm::dvec3& along) {
    Entry in{.t = -std::numeric_limits<double>::infinity(), .plane = 0};
    double out = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < planes.size(); ++k) {
        const double speed = glm::dot(planes[k].normal, along);
        const double t = (planes[k].offset - glm::dot(planes[k].normal, from)) / speed;
        if (speed < 0.0 && t > in.t) {
            in = {t, k};
        } else if (speed > 0.0) {
            out = std::fmin(out, t);
        }
    }
    return in.t < out ? std::optional(in) : std::nullopt;
}

using RayTriangle = std::array<glm::dvec3, 3>;

/// Where the line from + t * along meets the triangle: t, also before the line's beginning; not a number: it passes (Moeller,
/// Trumbore 1997).
inline double ray_meets(const RayTriangle& triangle, const glm::dvec3& from, const glm::dvec3& along) {
    const auto& [a, b, c] = triangle;
    const glm::dvec3 p = glm::cross(along, c - a);
    const double area = glm::dot(b - a, p);
    const glm::dvec3 s = from - a;
    const double u = glm::dot(s, p) / area;
    const glm::dvec3 q = glm::cross(s, b - a);
    const double v = glm::dot(along, q) / area;
    const bool meets = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
    return meets ? glm::dot(c - a, q) / area : std::numeric_limits<double>::quiet_NaN();
}

/// The star of `write_star` in a prop: z is up, the middle of its box on the axis, its lowest corner on z = 0, as large
/// as fits.
struct Star {
    explicit Star(const std::vector<HalfSpace>& prop) {
        double scale = std::numeric_limits<double>::infinity();
        for (glm::dvec3& corner : corners) {
            corner -= glm::dvec3(0.15, -0.05, -1.0);
            for (const HalfSpace& plane : prop) {
                const double reach = glm::dot(plane.normal, corner);
                scale = reach > 1e-12 ? std::fmin(scale, plane.offset / reach) : scale;
            }
        }
        for (glm::dvec3& corner : corners) {
            corner *= scale;
        }
    }
    /// The first point of the surface on a ray, if it meets it.
    [[nodiscard]] std::optional<glm::dvec3> hit(const glm::dvec3& from, const glm::dvec3& along) const {
        double first = std::numeric_limits<double>::infinity();
        for (const auto& [a, b, c] : triangles) {
            const double t = ray_meets({corners[a], corners[b], corners[c]}, from, along);
            first = t > 0.0 ? std::fmin(first, t) : first;
        }
        return std::isfinite(first) ? std::optional(from + first * along) : std::nullopt;
    }

    std::array<glm::dvec3, 6> corners{
        {{1, 0, 0}, {-0.7, 0, 0}, {0, 0.8, 0}, {0, -0.9, 0}, {0, 0, 1.1}, {0, 0, -1}}};
    static constexpr std::array<std::array<std::size_t, 3>, 8> triangles{
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
};

/// Points in the prop's frame, from the top row on; NaN where no surface was hit.
inline std::vector<glm::vec3> read_points(const std::string& pfm, const glm::ivec2& size) {
    const std::size_t width = static_cast<std::size_t>(size.x);
    const std::size_t height = static_cast<std::size_t>(size.y);
    std::vector<glm::vec3> points(width * height);
    EXPECT_TRUE(pfm.starts_with("PF"));
    const char* rows = pfm.data() + pfm.size() - sizeof(glm::vec3) * points.size();
    for (std::size_t y = 0; y < height; ++y) { // PFM begins with the bottom row
        std::memcpy(&points[(height - 1 - y) * width], rows + sizeof(glm::vec3) * width * y,
                    sizeof(glm::vec3) * width);
    }
    return points;
}

struct Agreement {
    int hits = 0;  ///< of the rays
    int other = 0; ///< pixels that are hit in one alone
    /// Between two hits of a pixel; where a surface is grazed, at its best within a rasterizer's step.
    double worst_m = 0.0;
    std::vector<double> off_m{}; ///< of each pixel that both hit
};
/// llvmpipe places corners in steps of 1/256 of a pixel.
inline constexpr double raster_step_px = 1.0 / 256.0;

/// `surface` has the function `hit` of Star. Eye and lens are in the prop's frame, and so is `ray(x, y)`, the direction of a pixel's light.
template <typename Surface, typename Ray>
Agreement agreement(const std::vector<glm::vec3>& points, const std::vector<HalfSpace>& prop,
                    const Surface& surface, const glm::dvec3& eye, const glm::dvec3& lens, const Ray& ray,
                    const glm::ivec2& size) {
    const auto truth_at = [&](double x, double y) -> std::optional<glm::dvec3> {
        const glm::dvec3 along = ray(x, y);
        const std::optional<Entry> face = entry(prop, lens, along);
        const bool shows = face && prop[face->plane].lit &&
                           glm::dot(prop[face->plane].normal, eye) > prop[face->plane].offset;
        return shows ? surface.hit(eye, lens + face->t * along - eye) : std::nullopt;
    };
    const auto off_m = [&](int x, int y, const glm::dvec3& truth, const glm::dvec3& drawn) {
        constexpr double close_m = 1e-4;
        double min_off_m = glm::distance(truth, drawn);
        for (const glm::ivec2& way :
             {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
            const auto beside = min_off_m > close_m
                                    ? truth_at(x + raster_step_px * way.x, y + raster_step_px * way.y)
                                    : std::nullopt;
            min_off_m = beside ? std::fmin(min_off_m, glm::distance(*beside, drawn)) : min_off_m;
        }
        return min_off_m;
    };
    Agreement seen;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const std::optional<glm::dvec3> truth = truth_at(x, y);
            const glm::vec3& drawn = points[static_cast<std::size_t>(y * size.x + x)];
            seen.hits += truth ? 1 : 0;
            if (truth.has_value() == std::isnan(drawn.x)) {
                ++seen.other;
            } else if (truth) {
                seen.off_m.push_back(off_m(x, y, *truth, glm::dvec3(drawn)));
                seen.worst_m = std::fmax(seen.worst_m, seen.off_m.back());
            }
        }
    }
    return seen;
}

} // namespace frustumscreen::programs
