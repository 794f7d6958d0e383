/// The polygons of a prop's surface as a file has them, not checked yet.
///
/// Units    metres.
/// Threads  values; any.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace frustumscreen::solid {

/// Limits of what is looked at; a prop of 16 faces needs about a hundredth of them.
inline constexpr std::size_t max_vertices = 10'000;
inline constexpr std::size_t max_polygons = 10'000;
inline constexpr std::size_t max_polygon_corners = 1'000;
inline constexpr std::size_t max_corners = 100'000; ///< of all polygons together

enum class LengthUnit : std::uint8_t { Millimetre, Metre };

struct Polygon {
    std::vector<std::uint32_t> corners; ///< numbers of vertices, counter-clockwise seen from outside
    std::string name;                   ///< of its group; empty: none
    std::size_t number = 0;             ///< its line, or its number in the file
};

struct PolygonMesh {
    enum class Numbers : std::uint8_t { Lines, Triangles };

    std::vector<glm::dvec3> vertices;
    std::vector<Polygon> polygons;
    Numbers numbers = Numbers::Lines;         ///< what Polygon::number counts
    LengthUnit unit = LengthUnit::Millimetre; ///< of the file's numbers, for messages
};

[[nodiscard]] std::vector<glm::dvec3> corners_of(const PolygonMesh& mesh, const Polygon& polygon);

// For messages.

/// "the face of line 12", "triangle 7".
[[nodiscard]] std::string place_of(const PolygonMesh& mesh, const Polygon& polygon);
/// "(0, 60, 12.5) mm".
[[nodiscard]] std::string in_mm(const glm::dvec3& point_m);
/// "12.5 mm": three digits, or as many as the whole millimetres have.
[[nodiscard]] std::string in_mm(double length_m);

} // namespace frustumscreen::solid
