// However a file describes a body, by triangles or polygons, in any order, with or without shared vertices: it
// is one solid.
#include "app/solid/make_solid.h"
#include "tests/solid/bodies.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace frustumscreen::solid {
namespace {

PropFile read_well(const std::string& text) {
    const Result<PropFile> file = parse_prop_file(text, LengthUnit::Millimetre);
    EXPECT_TRUE(file.has_value()) << (file ? "" : file.error().message) << "\n" << text;
    return file.value_or(PropFile{});
}

/// For each face its normal and its corners, in an order that does not depend on the file's.
using FaceKey = std::vector<std::array<long, 3>>;
FaceKey key_of(std::vector<glm::dvec3> corners_m) {
    FaceKey key;
    for (const glm::dvec3& corner : corners_m) {
        key.push_back(
            {std::lround(corner.x * 1e6), std::lround(corner.y * 1e6), std::lround(corner.z * 1e6)});
    }
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    return key;
}
std::set<FaceKey> faces_of(const Solid& solid) {
    std::set<FaceKey> faces;
    for (const SolidFace& face : solid.faces) {
        faces.insert(key_of(face.corners));
    }
    return faces;
}
std::set<FaceKey> faces_of(const Body& body) {
    std::set<FaceKey> faces;
    for (const std::vector<std::size_t>& face : body.faces) {
        std::vector<glm::dvec3> corners;
        for (const std::size_t corner : face) {
            corners.push_back(body.vertices[corner] / 1000.0);
        }
        faces.insert(key_of(corners));
    }
    return faces;
}

/// Each face as a fan of triangles about one of its corners.
Body in_triangles(const Body& body, std::mt19937& random) {
    Body result{body.vertices, {}};
    for (const std::vector<std::size_t>& face : body.faces) {
        const std::size_t n = face.size();
        const std::size_t first = random() % n;
        for (std::size_t k = 1; k + 1 < n; ++k) {
            result.faces.push_back({face[first], face[(first + k) % n], face[(first + k + 1) % n]});
        }
    }
    return result;
}

/// A vertex at a random place of each edge, in the faces on both sides, and each triangle about its middle.
Body with_more_vertices(const Body& body, std::mt19937& random) {
    std::uniform_real_distribution<double> share(0.2, 0.8);
    Body result{body.vertices, {}};
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> on_edge;
    for (const std::vector<std::size_t>& face : body.faces) {
        std::vector<std::size_t> outline;
        glm::dvec3 middle(0.0);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const std::size_t a = face[k];
            const std::size_t b = face[(k + 1) % face.size()];
            const auto [at, is_new] = on_edge.emplace(std::minmax(a, b), result.vertices.size());
            if (is_new) {
                result.vertices.push_back(glm::mix(body.vertices[a], body.vertices[b], share(random)));
            }
            outline.push_back(a);
            outline.push_back(at->second);
            middle += body.vertices[a] / static_cast<double>(face.size());
        }
        for (std::size_t k = 0; k < outline.size(); ++k) {
            result.faces.push_back({outline[k], outline[(k + 1) % outline.size()], result.vertices.size()});
        }
        result.vertices.push_back(middle);
    }
    return result;
}

/// As an STL file has them: each triangle with vertices of its own, in any order, rounded to 32 bits.
Body without_shared_vertices(const Body& body, std::mt19937& random) {
    Body result;
    for (const std::vector<std::size_t>& face : body.faces) {
        result.faces.emplace_back();
        for (const std::size_t corner : face) {
            result.faces.back().push_back(result.vertices.size());
            result.vertices.push_back(glm::dvec3(glm::vec3(body.vertices[corner])));
        }
    }
    std::shuffle(result.faces.begin(), result.faces.end(), random);
    return result;
}

void expect_solid(const Body& written, const std::set<FaceKey>& faces, double volume_mm3,
                  double digits = 1e-9) {
    const PropFile file = read_well(obj_of(written));
    EXPECT_EQ(faces_of(file.solid), faces);
    EXPECT_NEAR(volume_of(file.solid) * 1e9, volume_mm3, digits * volume_mm3);
    for (const SolidFace& face : file.solid.faces) {
        EXPECT_NEAR(glm::length(face.plane.normal), 1.0, 1e-12);
        for (const glm::dvec3& corner : file.solid.corners) {
            EXPECT_LE(face.plane.distance(corner), 1e-6) << "the normal looks outward";
        }
    }
}

TEST(MakeSolid, ResultDoesNotDependOnTheMesh) {
    std::mt19937 random(1);
    int compared = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const std::size_t planes = 4 + static_cast<std::size_t>(trial) % 13;
        const Body body = some_body(random, planes, 70.0);
        const std::set<FaceKey> faces = faces_of(body);
        ASSERT_EQ(faces.size(), planes);
        const double volume = volume_of_body(body);
        expect_solid(body, faces, volume);
        expect_solid(in_triangles(body, random), faces, volume);
        expect_solid(with_more_vertices(body, random), faces, volume);
        Body shuffled = in_triangles(body, random);
        std::shuffle(shuffled.faces.begin(), shuffled.faces.end(), random);
        expect_solid(shuffled, faces, volume);
        for (std::vector<std::size_t>& face : shuffled.faces) {
            std::reverse(face.begin(), face.end());
        }
        expect_solid(shuffled, faces, volume);
        const PropFile stl = read_well(obj_of(without_shared_vertices(in_triangles(body, random), random)));
        EXPECT_EQ(stl.solid.faces.size(), planes);
        EXPECT_EQ(stl.solid.corners.size(), 2 * planes - 4);
        EXPECT_NEAR(volume_of(stl.solid) * 1e9, volume, 1e-5 * volume);
        ++compared;
    }
    EXPECT_EQ(compared, 60);
}

TEST(MakeSolid, RoundTrip) {
    std::mt19937 random(2);
    for (int trial = 0; trial < 30; ++trial) {
        const Body body = some_body(random, 4 + static_cast<std::size_t>(trial) % 13, 60.0);
        const PropFile file = read_well(obj_of(in_triangles(body, random)));
        const PropFile again = read_well(write_prop_file(file.solid));
        EXPECT_TRUE(again.notes.empty());
        ASSERT_EQ(again.solid.faces.size(), file.solid.faces.size());
        for (std::size_t k = 0; k < file.solid.faces.size(); ++k) {
            const SolidFace& was = file.solid.faces[k];
            const SolidFace& is = again.solid.faces[k];
            EXPECT_EQ(is.name, was.name);
            ASSERT_EQ(is.corners.size(), was.corners.size());
            for (std::size_t c = 0; c < was.corners.size(); ++c) {
                EXPECT_NEAR(glm::distance(is.corners[c], was.corners[c]), 0.0, 1e-9);
            }
        }
    }
}

TEST(MakeSolid, NotesJoinedPolygonsAndInvertedFaces) {
    EXPECT_TRUE(read_well(obj_of(cube(120))).notes.empty());
    std::mt19937 random(3);
    Body body = in_triangles(cube(120), random);
    EXPECT_EQ(read_well(obj_of(body)).notes,
              (std::vector<std::string>{"its 12 polygons are joined into 6 flat faces"}));
    for (std::vector<std::size_t>& face : body.faces) {
        std::reverse(face.begin(), face.end());
    }
    const std::vector<std::string> notes = read_well(obj_of(body)).notes;
    ASSERT_EQ(notes.size(), 2U);
    EXPECT_TRUE(notes[0].starts_with("its faces were inside out")) << notes[0];
}

std::vector<std::string> names_of(const std::string& text) {
    std::vector<std::string> names;
    for (const SolidFace& face : read_well(text).solid.faces) {
        names.push_back(face.name);
    }
    return names;
}

TEST(MakeSolid, NamesFacesAfterTheirGroups) {
    const std::string tetrahedron = "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\n";
    EXPECT_EQ(names_of(tetrahedron + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"),
              (std::vector<std::string>{"F1", "F2", "F3", "F4"}));
    EXPECT_EQ(names_of(tetrahedron + "f 1 3 2\ng front\nf 1 2 4\no left\nf 1 4 3\ng\nf 2 3 4\n"),
              (std::vector<std::string>{"F1", "front", "left", "F4"}));
    // A group of several faces names none of them, and no name is given twice.
    EXPECT_EQ(names_of(tetrahedron + "g body\nf 1 3 2\nf 1 2 4\ng F1\nf 1 4 3\ng F6\nf 2 3 4\n"),
              (std::vector<std::string>{"F5", "F2", "F1", "F6"}));
}

TEST(MakeSolid, IgnoresUnusedVertices) {
    Body body = cube(120);
    body.vertices.emplace_back(9e5, 0, 0);
    EXPECT_EQ(read_well(obj_of(body)).solid.corners.size(), 8U);
}

/// Hundreds of coplanar polygons with corners rounded to 0.01 mm, as some programs write them.
TEST(MakeSolid, JoinsARoundedGridIntoOneFace) {
    const glm::dmat3 turn(glm::mat3_cast(glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)))));
    Body body;
    constexpr std::size_t n = 12;
    const std::array<std::array<glm::dvec3, 3>, 6> sides{{{glm::dvec3(0, 0, 0), {0, 1, 0}, {1, 0, 0}},
                                                          {glm::dvec3(0, 0, 1), {1, 0, 0}, {0, 1, 0}},
                                                          {glm::dvec3(0, 0, 0), {1, 0, 0}, {0, 0, 1}},
                                                          {glm::dvec3(0, 1, 0), {0, 0, 1}, {1, 0, 0}},
                                                          {glm::dvec3(0, 0, 0), {0, 0, 1}, {0, 1, 0}},
                                                          {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}}}};
    for (const auto& [corner, across, up] : sides) {
        const std::size_t first = body.vertices.size();
        for (std::size_t row = 0; row <= n; ++row) {
            for (std::size_t column = 0; column <= n; ++column) {
                const double u = static_cast<double>(column) / n;
                const double v = static_cast<double>(row) / n;
                const glm::dvec3 p = turn * (corner + u * across + v * up) * 120.0;
                body.vertices.push_back(glm::round(p * 100.0) / 100.0);
            }
        }
        for (std::size_t row = 0; row < n; ++row) {
            for (std::size_t column = 0; column < n; ++column) {
                const std::size_t at = first + row * (n + 1) + column;
                body.faces.push_back({at, at + 1, at + n + 2});
                body.faces.push_back({at, at + n + 2, at + n + 1});
            }
        }
    }
    const PropFile file = read_well(obj_of(body));
    EXPECT_EQ(file.solid.faces.size(), 6U);
    EXPECT_EQ(file.solid.corners.size(), 8U);
    EXPECT_NEAR(volume_of(file.solid), 0.12 * 0.12 * 0.12, 1e-6);
}

} // namespace
} // namespace frustumscreen::solid
