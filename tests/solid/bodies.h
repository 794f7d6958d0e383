/// Bodies for the tests: polygons from exact formulas and from random planes, by code that shares nothing with
/// app/solid.
///
/// Units    millimetres.
#pragma once

#include "app/solid/prop_file.h"

#include <fmt/format.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace frustumscreen::solid {

struct Body {
    std::vector<glm::dvec3> vertices;
    std::vector<std::vector<std::size_t>> faces; ///< numbers of vertices, counter-clockwise seen from outside
};

inline std::string obj_of(const Body& body) {
    std::string text;
    for (const glm::dvec3& v : body.vertices) {
        text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
    }
    for (const std::vector<std::size_t>& face : body.faces) {
        text += "f";
        for (const std::size_t corner : face) {
            text += fmt::format(" {}", corner + 1);
        }
        text += "\n";
    }
    return text;
}

inline Result<PropFile> read(const Body& body) {
    return parse_prop_file(obj_of(body), LengthUnit::Millimetre);
}

/// Faces in the order -Z +Z -Y +X +Y -X.
inline Body box(const glm::dvec3& low, const glm::dvec3& high) {
    Body body;
    for (const double z : {low.z, high.z}) {
        body.vertices.emplace_back(low.x, low.y, z);
        body.vertices.emplace_back(high.x, low.y, z);
        body.vertices.emplace_back(high.x, high.y, z);
        body.vertices.emplace_back(low.x, high.y, z);
    }
    body.faces = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    return body;
}
inline Body cube(double edge) {
    return box(glm::dvec3(-edge / 2, -edge / 2, 0), glm::dvec3(edge / 2, edge / 2, edge));
}

/// A regular prism of `n` sides with corners at `radius`; the sides first, then the top and the bottom.
inline Body prism(std::size_t n, double radius, double height) {
    Body body;
    for (const double z : {0.0, height}) {
        for (std::size_t k = 0; k < n; ++k) {
            const double turn = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
            body.vertices.emplace_back(radius * std::cos(turn), radius * std::sin(turn), z);
        }
    }
    std::vector<std::size_t> top;
    std::vector<std::size_t> bottom;
    for (std::size_t k = 0; k < n; ++k) {
        body.faces.push_back({k, (k + 1) % n, n + (k + 1) % n, n + k});
        top.push_back(n + k);
        bottom.push_back(n - 1 - k);
    }
    body.faces.push_back(top);
    body.faces.push_back(bottom);
    return body;
}

/// The volume from each face's plane, by the divergence theorem about the origin, mm3.
inline double volume_of_body(const Body& body) {
    double volume = 0.0;
    for (const std::vector<std::size_t>& face : body.faces) {
        for (std::size_t k = 1; k + 1 < face.size(); ++k) {
            volume += glm::determinant(glm::dmat3(body.vertices[face[0]], body.vertices[face[k]],
                                                  body.vertices[face[k + 1]])) /
                      6.0;
        }
    }
    return volume;
}

/// The body that `count` random planes bound, each at about `radius` from the origin; nullopt if it is not
/// bounded by all of them, or if an edge is shorter than 3 mm or an angle between faces is flatter than 8
/// degrees: at such places a prop file may be read as another body, which is meant so.
inline std::optional<Body> random_body(std::mt19937& random, std::size_t count, double radius) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> share(0.8, 1.2);
    std::vector<glm::dvec3> normals;
    std::vector<double> offsets;
    for (std::size_t k = 0; k < count; ++k) {
        normals.push_back(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
        offsets.push_back(radius * share(random));
    }
    Body body;
    std::vector<std::vector<std::size_t>> on_plane(count);
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            for (std::size_t c = 0; c < b; ++c) {
                const glm::dmat3 rows = glm::transpose(glm::dmat3(normals[a], normals[b], normals[c]));
                if (std::abs(glm::determinant(rows)) < 1e-6) {
                    continue;
                }
                const glm::dvec3 point = glm::inverse(rows) * glm::dvec3(offsets[a], offsets[b], offsets[c]);
                bool is_inside = glm::length(point) < 10.0 * radius;
                for (std::size_t k = 0; k < count; ++k) {
                    is_inside =
                        is_inside && (k == a || k == b || k == c || glm::dot(normals[k], point) < offsets[k]);
                }
                if (is_inside) {
                    for (const std::size_t k : {a, b, c}) {
                        on_plane[k].push_back(body.vertices.size());
                    }
                    body.vertices.push_back(point);
                }
            }
        }
    }
    if (body.vertices.size() != 2 * count - 4) { // Euler, three planes at each corner: bounded by all
        return std::nullopt;
    }
    for (std::size_t k = 0; k < count; ++k) {
        std::vector<std::size_t>& face = on_plane[k];
        if (face.size() < 3) {
            return std::nullopt;
        }
        glm::dvec3 middle(0.0);
        for (const std::size_t v : face) {
            middle += body.vertices[v] / static_cast<double>(face.size());
        }
        const glm::dvec3 x = glm::normalize(body.vertices[face[0]] - middle);
        const glm::dvec3 y = glm::cross(normals[k], x);
        std::sort(face.begin(), face.end(), [&](std::size_t p, std::size_t q) {
            const glm::dvec3 to_p = body.vertices[p] - middle;
            const glm::dvec3 to_q = body.vertices[q] - middle;
            return std::atan2(glm::dot(to_p, y), glm::dot(to_p, x)) <
                   std::atan2(glm::dot(to_q, y), glm::dot(to_q, x));
        });
        for (std::size_t j = 0; j < face.size(); ++j) {
            if (glm::distance(body.vertices[face[j]], body.vertices[face[(j + 1) % face.size()]]) < 3.0) {
                return std::nullopt;
            }
        }
        for (std::size_t j = 0; j < k; ++j) {
            if (glm::dot(normals[k], normals[j]) > std::cos(0.14)) {
                return std::nullopt;
            }
        }
        body.faces.push_back(face);
    }
    return body;
}

/// The next body that `random_body` finds.
inline Body some_body(std::mt19937& random, std::size_t count, double radius) {
    while (true) {
        if (std::optional<Body> body = random_body(random, count, radius)) {
            return *std::move(body);
        }
    }
}

} // namespace frustumscreen::solid
