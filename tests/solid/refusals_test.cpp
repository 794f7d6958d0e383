// A file that is no prop is refused in one sentence with the place and the amount.
#include "app/solid/make_solid.h"
#include "tests/solid/bodies.h"

#include <gtest/gtest.h>

namespace frustumscreen::solid {
namespace {

void expect_refused(const Body& body, std::string_view id, const std::vector<std::string>& words) {
    const Result<PropFile> file = read(body);
    ASSERT_FALSE(file.has_value());
    EXPECT_EQ(file.error().id, id) << file.error().message;
    for (const std::string& word : words) {
        EXPECT_NE(file.error().message.find(word), std::string::npos) << word << ": " << file.error().message;
    }
}

/// Both in one file.
Body both(Body a, const Body& b) {
    const std::size_t before = a.vertices.size();
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (std::vector<std::size_t> face : b.faces) {
        for (std::size_t& corner : face) {
            corner += before;
        }
        a.faces.push_back(face);
    }
    return a;
}

TEST(RefusedProp, OpenSurface) {
    Body body = cube(120);
    body.faces.erase(body.faces.begin() + 1);
    expect_refused(body, "prop_file.open", {"4 edges", "120 mm long", "face of line"});
    body = cube(120);
    body.vertices.emplace_back(60, 60, 119.9); // the corner that one face has elsewhere
    body.faces[3][2] = 8;
    expect_refused(body, "prop_file.open", {"4 edges", "120 mm long", "(60, 60, "});
}

TEST(RefusedProp, InconsistentlyOrientedFaces) {
    Body body = cube(120);
    std::reverse(body.faces[2].begin(), body.faces[2].end());
    expect_refused(body, "prop_file.turned",
                   {"line 9", "line 11", "counter-clockwise"}); // the first edge in order
}

TEST(RefusedProp, EdgeSharedByThreeFaces) {
    Body body = cube(120);
    body.faces.push_back(body.faces[0]);
    expect_refused(body, "prop_file.edge_of_many", {"3 faces", "line 9", "line 15"});
}

TEST(RefusedProp, SeveralBodies) {
    expect_refused(both(cube(120), box(glm::dvec3(100, 0, 0), glm::dvec3(130, 30, 30))), "prop_file.parts",
                   {"2 bodies"});
    Body inner = cube(60); // a hollow
    for (std::vector<std::size_t>& face : inner.faces) {
        std::reverse(face.begin(), face.end());
    }
    expect_refused(both(cube(120), inner), "prop_file.parts", {"2 bodies"});
    // Two cubes that share a corner share no edge.
    expect_refused(both(cube(120), box(glm::dvec3(60, 60, 120), glm::dvec3(100, 100, 160))),
                   "prop_file.parts", {"2 bodies"});
}

TEST(RefusedProp, ConcaveBody) {
    // An L: 100 x 100, of which a corner of 60 x 60 is cut off, 80 high.
    Body body;
    for (const double z : {0.0, 80.0}) {
        for (const auto& [x, y] : {std::pair(0, 0), {100, 0}, {100, 40}, {40, 40}, {40, 100}, {0, 100}}) {
            body.vertices.emplace_back(x, y, z);
        }
    }
    for (std::size_t k = 0; k < 6; ++k) {
        body.faces.push_back({k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k});
    }
    body.faces.push_back({6, 7, 8, 9, 10, 11});
    body.faces.push_back({5, 4, 3, 2, 1, 0});
    expect_refused(body, "prop_file.not_convex", {"60.0 mm outside", "0.20 mm"});
    // Edges pushed in by 0.15 mm are concave: the planes go on, to 0.3 mm at the top. 0.09 mm are flat enough.
    for (const auto& [depth, is_taken] : {std::pair(0.15, false), {0.09, true}}) {
        Body waisted = prism(4, 100, 60);
        const std::size_t n = waisted.vertices.size();
        for (std::size_t k = 0; k < 4; ++k) { // a ring of corners at half the height
            const glm::dvec3 middle = 0.5 * (waisted.vertices[k] + waisted.vertices[4 + k]);
            waisted.vertices.push_back(middle * glm::dvec3(1.0 - depth / 70.0, 1.0 - depth / 70.0, 1.0));
        }
        waisted.faces.resize(6);
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t next = (k + 1) % 4;
            waisted.faces[k] = {k, next, n + next, n + k};
            waisted.faces.push_back({n + k, n + next, 4 + next, 4 + k});
        }
        if (is_taken) {
            EXPECT_TRUE(read(waisted).has_value()) << read(waisted).error().message;
        } else {
            expect_refused(waisted, "prop_file.not_convex", {"0.30 mm outside the plane", "face F"});
        }
    }
}

TEST(RefusedProp, SelfIntersectingBody) {
    // A prism on a five-pointed star, whose outline goes round twice.
    Body star = prism(5, 100, 100);
    for (std::vector<std::size_t>& face : star.faces) {
        for (std::size_t& corner : face) {
            corner = corner < 5 ? corner * 2 % 5 : 5 + (corner - 5) * 2 % 5;
        }
    }
    expect_refused(star, "prop_file.not_convex", {"outside"});
    // A cube whose top is turned by half a turn: its sides cross themselves.
    Body twisted = cube(120);
    for (std::size_t k = 4; k < 8; ++k) {
        twisted.vertices[k] *= glm::dvec3(-1, -1, 1);
    }
    EXPECT_FALSE(read(twisted).has_value());
}

TEST(RefusedProp, FaceThatIsNotFlat) {
    Body body = cube(120);
    body.vertices[6].z += 1.0; // a corner of the top: the plane goes up by a quarter of it, on the whole
    expect_refused(body, "prop_file.not_flat", {"face F2 (line 10)", "0.25 mm", "0.20 mm"});
    body.vertices[6].z = 120.5;
    EXPECT_TRUE(read(body).has_value()) << "0.125 mm";
}

TEST(RefusedProp, TooManyFaces) {
    const Result<PropFile> sixteen = read(prism(14, 100, 100));
    ASSERT_TRUE(sixteen.has_value());
    EXPECT_EQ(sixteen->solid.faces.size(), 16U);
    expect_refused(prism(15, 100, 100), "prop_file.faces", {"17 flat faces", "4 to 16"});
    expect_refused(prism(48, 100, 100), "prop_file.faces", {"50 flat faces"});
}

TEST(RefusedProp, BodyWithoutVolume) {
    Body body;
    body.vertices = {{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}};
    body.faces = {{0, 1, 2, 3}, {3, 2, 1, 0}};
    expect_refused(body, "prop_file.no_volume", {"0 cm3"});
}

TEST(RefusedProp, TooSmallOrTooLargeBody) {
    expect_refused(cube(0.12), "prop_file.size", {"0.12 mm long", "10.0 mm to 2000 mm", "metres"});
    expect_refused(cube(9.9), "prop_file.size", {"9.90 mm long"});
    expect_refused(cube(1e6), "prop_file.size", {"1000000 mm long", "true size"}); // 1 km
    EXPECT_TRUE(read(cube(10)).has_value());
    EXPECT_TRUE(read(cube(2000)).has_value());
    const Result<PropFile> in_metres = parse_prop_file(obj_of(cube(120)), LengthUnit::Metre);
    ASSERT_FALSE(in_metres.has_value());
    EXPECT_NE(in_metres.error().message.find("millimetres"), std::string::npos) << in_metres.error().message;
    Body all_at_one_place = cube(0);
    EXPECT_FALSE(read(all_at_one_place).has_value());
}

TEST(RefusedProp, TooManyPolygons) {
    PolygonMesh mesh;
    mesh.vertices = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}};
    mesh.polygons.assign(1'000'000, Polygon{.corners = {0, 1, 2}, .name = {}, .number = 1});
    const Result<MadeSolid> made = make_solid(mesh);
    ASSERT_FALSE(made.has_value());
    EXPECT_EQ(made.error().id, "prop_file.too_many");
    EXPECT_NE(made.error().message.find("1000000"), std::string::npos);
}

/// A cube on one face of which a small one stands, as one surface with a hole in that face.
TEST(RefusedProp, FaceWithARaisedPart) {
    Body body = both(cube(120), box(glm::dvec3(-20, -20, 120), glm::dvec3(20, 20, 140)));
    std::erase(body.faces, std::vector<std::size_t>{4, 5, 6, 7});
    std::erase(body.faces, std::vector<std::size_t>{11, 10, 9, 8});
    for (std::size_t k = 0; k < 4; ++k) { // the top around it
        body.faces.push_back({4 + k, 4 + (k + 1) % 4, 8 + (k + 1) % 4, 8 + k});
    }
    expect_refused(body, "prop_file.not_convex", {"40.0 mm outside"}); // of the small one's sides
    for (std::size_t k = 12; k < 16; ++k) {
        body.vertices[k].z = 120.1; // so low that it is flat enough: then the face still is one
    }
    const Result<PropFile> file = read(body);
    ASSERT_TRUE(file.has_value()) << file.error().message;
    EXPECT_EQ(file->solid.faces.size(), 6U);
}

} // namespace
} // namespace frustumscreen::solid
