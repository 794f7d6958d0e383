#include "app/exhibit/leader_line.h"
#include "app/exhibit/table_layout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace frustumscreen::exhibit {
namespace {

using Random = std::mt19937_64;

double between(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

constexpr std::uint32_t all_faces = ~0U;

/// A cup without a handle: a surface of revolution about the z axis, with a foot, a belly and a lip, thick walls,
/// open above.
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::dvec3> normals;
    std::vector<std::uint32_t> indices;
};

Mesh cup(int rings, int spokes) {
    // The outline from the foot's middle, outside up to the lip and inside down again: radius and height; closed and
    // smooth.
    const auto outline = [](double s) {
        const double half = s < 0.5 ? 2.0 * s : 2.0 * (1.0 - s); // 0 at the middle, 1 at the lip
        const double wall = s < 0.5 ? 0.004 : -0.004;
        const double belly =
            0.03 * std::sin(std::numbers::pi * (0.15 + 0.75 * half)) + 0.008 * std::sin(9.0 * half);
        const double radius =
            std::max(0.0, belly * std::min(1.0, 6.0 * half) +
                              wall * std::min(1.0, 6.0 * half) * std::min(1.0, 8.0 * (1.0 - half)));
        return glm::dvec2(radius, 0.004 + 0.09 * half + (s < 0.5 ? -0.003 : 0.003) * (1.0 - half));
    };
    Mesh mesh;
    for (int ring = 0; ring <= rings; ++ring) {
        for (int spoke = 0; spoke < spokes; ++spoke) {
            const double s = static_cast<double>(ring) / rings;
            const double azimuth = 2.0 * std::numbers::pi * spoke / spokes;
            const glm::dvec2 at = outline(s);
            const glm::dvec2 along = outline(std::min(1.0, s + 1e-4)) - outline(std::max(0.0, s - 1e-4));
            const glm::dvec2 out = glm::normalize(glm::dvec2(along.y, -along.x));
            mesh.positions.emplace_back(at.x * std::cos(azimuth), at.x * std::sin(azimuth), at.y);
            mesh.normals.emplace_back(out.x * std::cos(azimuth), out.x * std::sin(azimuth), out.y);
        }
    }
    for (int ring = 0; ring < rings; ++ring) {
        for (int spoke = 0; spoke < spokes; ++spoke) {
            const auto index = [&](int r, int s) {
                return static_cast<std::uint32_t>(r * spokes + s % spokes);
            };
            const std::uint32_t a = index(ring, spoke);
            const std::uint32_t b = index(ring, spoke + 1);
            const std::uint32_t c = index(ring + 1, spoke);
            const std::uint32_t d = index(ring + 1, spoke + 1);
            mesh.indices.insert(mesh.indices.end(), {a, b, c, b, d, c});
        }
    }
    return mesh;
}

/// Brute-force ray cast: the distance to the first triangle, by signs of volumes, over all triangles.
double first_hit(const Mesh& mesh, const glm::dvec3& from, const glm::dvec3& direction) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
        const glm::dvec3 a = glm::dvec3(mesh.positions[mesh.indices[k]]) - from;
        const glm::dvec3 b = glm::dvec3(mesh.positions[mesh.indices[k + 1]]) - from;
        const glm::dvec3 c = glm::dvec3(mesh.positions[mesh.indices[k + 2]]) - from;
        const double u = glm::dot(direction, glm::cross(b, c));
        const double v = glm::dot(direction, glm::cross(c, a));
        const double w = glm::dot(direction, glm::cross(a, b));
        if ((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)) {
            const double sum = u + v + w;
            const double t = sum != 0.0 ? glm::dot(direction, (u * a + v * b + w * c) / sum) : -1.0;
            nearest = t > 0.0 ? std::min(nearest, t) : nearest;
        }
    }
    return nearest;
}

glm::dvec3 some_eye(Random& random) {
    const double azimuth = between(random, -std::numbers::pi, std::numbers::pi);
    const double elevation = between(random, 0.2, 1.3);
    return between(random, 0.35, 1.2) * glm::dvec3(std::cos(azimuth) * std::cos(elevation),
                                                   std::sin(azimuth) * std::cos(elevation),
                                                   std::sin(elevation));
}

/// `drawn`: the surface for ray casts; `truth`: the artifact itself.
struct Agreement {
    int seen = 0, unseen = 0, wrong = 0, wrong_beyond_tolerance = 0;
};

Agreement compare(const Mesh& truth, const Mesh& drawn, double tolerance_m, int count) {
    const geometry::PropShape prop = geometry::make_frustum(geometry::shipped_frustum);
    const geometry::TriangleTree tree(drawn.positions, drawn.indices);
    const Occluder artifact{&tree, glm::dmat4(1.0), tolerance_m};
    Random random(31);
    Agreement agreement;
    for (int k = 0; k < count; ++k) {
        const std::size_t vertex = random() % truth.positions.size();
        const Hotspot hotspot{glm::dvec3(truth.positions[vertex]), truth.normals[vertex]};
        const glm::dvec3 eye = some_eye(random);
        const glm::dvec3 way = hotspot.point_m - eye;
        const double distance = glm::length(way);
        const double cosine = -glm::dot(way, hotspot.normal) / distance;
        const auto truly_seen = [&](double tolerance) {
            return cosine > 0.0 && first_hit(truth, eye, way / distance) > distance - tolerance;
        };
        const bool seen = is_seen(hotspot, eye, prop, {all_faces}, artifact);
        const bool expected = truly_seen(1e-5);
        (expected ? agreement.seen : agreement.unseen) += 1;
        if (seen != expected) {
            ++agreement.wrong;
            // If another tolerance, or an offset by it, changes the truth, both answers are right.
            bool changes = cosine < 0.15;
            for (int step = 0; step < 8 && !changes; ++step) {
                const double turn = step * std::numbers::pi / 4.0;
                const glm::dvec3 aside = glm::normalize(glm::cross(way, glm::dvec3(0.3, 0.5, 0.8)));
                const glm::dvec3 other = glm::cross(way / distance, aside);
                const glm::dvec3 moved =
                    3.0 * tolerance_m * (std::cos(turn) * aside + std::sin(turn) * other);
                const glm::dvec3 goal = hotspot.point_m + moved + tolerance_m * hotspot.normal;
                const glm::dvec3 to = goal - eye;
                const double far = glm::length(to);
                changes = (first_hit(truth, eye, to / far) > far - 4.0 * tolerance_m) != expected;
            }
            agreement.wrong_beyond_tolerance += changes ? 0 : 1;
        }
    }
    return agreement;
}

TEST(Hotspots, VisibilityMatchesARayCast) {
    const Mesh mesh = cup(60, 72);
    const Agreement agreement = compare(mesh, mesh, 1e-5, 3000);
    EXPECT_GT(agreement.seen, 400);
    EXPECT_GT(agreement.unseen, 1000);
    RecordProperty("wrong", agreement.wrong);
    EXPECT_LE(agreement.wrong, 3);
    EXPECT_EQ(agreement.wrong_beyond_tolerance, 0);
}

TEST(Hotspots, CoarserMeshAgreesWithinItsError) {
    const Mesh fine = cup(80, 96);
    const Mesh coarse = cup(40, 32);
    // The coarser outline's spokes cut off up to r (1 - cos(pi / 32)) = 0.2 mm; its rings about as much.
    const Agreement agreement = compare(fine, coarse, 5e-4, 1500);
    EXPECT_GT(agreement.seen, 200);
    RecordProperty("wrong_coarse", agreement.wrong);
    RecordProperty("wrong_beyond_tolerance", agreement.wrong_beyond_tolerance);
    EXPECT_LE(agreement.wrong, 30);
    EXPECT_EQ(agreement.wrong_beyond_tolerance, 0);
}

TEST(Hotspots, HiddenBehindAnUnlitFace) {
    const geometry::PropShape prop = geometry::make_frustum(geometry::shipped_frustum);
    const Occluder nothing;
    Random random(32);
    for (int k = 0; k < 2000; ++k) {
        const glm::dvec3 eye = some_eye(random);
        const glm::dvec3 point(between(random, -0.02, 0.02), between(random, -0.02, 0.02),
                               between(random, 0.01, 0.1));
        const Hotspot hotspot{point, glm::normalize(eye - point)};
        // The face by bisection: where the ray from inside leaves the prop.
        double inside = 0.0;
        double outside = 1.0;
        std::size_t face = 0;
        for (int step = 0; step < 60; ++step) {
            const double middle = 0.5 * (inside + outside);
            double farthest = -1.0;
            for (std::size_t plane = 0; plane < prop.bounds.size(); ++plane) {
                const double away = prop.bounds[plane].distance(point + middle * (eye - point));
                face = away > farthest ? plane : face;
                farthest = std::max(farthest, away);
            }
            (farthest > 0.0 ? outside : inside) = middle;
        }
        ASSERT_LT(face, prop.faces.size());
        EXPECT_TRUE(is_seen(hotspot, eye, prop, {1U << face}, nothing));
        EXPECT_FALSE(is_seen(hotspot, eye, prop, {~(1U << face)}, nothing));
        EXPECT_FALSE(is_seen({point, -hotspot.normal}, eye, prop, {all_faces}, nothing));
    }
}

struct Scene {
    geometry::PropShape prop = geometry::make_frustum({0.16, 0.09, 0.12});
    glm::dvec3 lens_m{0.0, 0.0, 1.5};
    geometry::RigidTransform table_from_prop;
    std::vector<typography::TableRectangle> pictures;
    LeaderLineNeeds needs;
};

/// A prop somewhere on the shipped table, a page of pictures, and a label at a free place.
Scene some_scene(Random& random, const std::vector<typography::TableRectangle>& pictures) {
    Scene scene;
    scene.pictures = pictures;
    scene.table_from_prop = {glm::angleAxis(between(random, -3.1, 3.1), glm::dvec3(0, 0, 1)),
                             {between(random, -0.15, 0.15), between(random, -0.1, 0.1), 0.0}};
    LeaderLineNeeds& needs = scene.needs;
    needs.eye_m = {between(random, -0.5, 0.5), between(random, -0.9, -0.45), between(random, 0.3, 0.8)};
    needs.point_m = scene.table_from_prop.point(
        {between(random, -0.03, 0.03), between(random, -0.03, 0.03), between(random, 0.0, 0.11)});
    needs.shadow = typography::hidden_by_prop(scene.prop, scene.table_from_prop, scene.lens_m);
    needs.hidden = typography::hidden_by_prop(scene.prop, scene.table_from_prop, needs.eye_m);
    typography::CaptionPlacer placer(
        std::vector<glm::dvec2>{{-0.4, -0.25}, {0.4, -0.25}, {0.4, 0.25}, {-0.4, 0.25}});
    placer.set_shapes(std::vector<glm::dvec2>{{between(random, 0.05, 0.12), 0.022}});
    placer.set_obstacles(pictures);
    placer.update({}, needs.shadow, needs.hidden, glm::dvec2(scene.table_from_prop.translation));
    needs.label = placer.at({}).rectangle;
    return scene;
}

std::vector<typography::TableRectangle> page_of(std::size_t artifacts) {
    TableSetUp set_up;
    set_up.artifacts = artifacts;
    set_up.picture_m = {{-0.4, -0.25}, {0.4, -0.25}, {0.4, 0.25}, {-0.4, 0.25}};
    set_up.prop = geometry::make_frustum({0.16, 0.09, 0.12});
    set_up.lens_m = {0.0, 0.0, 1.5};
    std::vector<typography::TableRectangle> found;
    for (const TablePlace& place : lay_out_table(set_up, 0).places) {
        found.push_back(place.whole());
    }
    return found;
}

bool holds(const typography::TableRectangle& rectangle, const glm::dvec2& at, double margin) {
    return glm::all(glm::lessThan(glm::abs(at - rectangle.centre_m), 0.5 * rectangle.size_m + margin));
}

/// True if the prop lies between a point and a table point, by ray cast.
bool hides(const Scene& scene, const glm::dvec3& from_m, const glm::dvec2& at) {
    const geometry::RigidTransform prop_from_table = scene.table_from_prop.inverse();
    const glm::dvec3 from = prop_from_table.point(from_m);
    geometry::PropHit hit;
    return geometry::enter(scene.prop, from, prop_from_table.point({at, 0.0}) - from, hit) && hit.t < 1.0;
}

TEST(LeaderLine, LeavesThePropInLineWithThePointAndAvoidsPictures) {
    Random random(33);
    int lines = 0;
    int bent = 0;
    constexpr int scenes = 2500;
    std::vector<std::vector<typography::TableRectangle>> pages;
    for (std::size_t artifacts = 2; artifacts <= max_table_places; ++artifacts) {
        pages.push_back(page_of(artifacts));
    }
    for (int k = 0; k < scenes; ++k) {
        Scene scene = some_scene(random, pages[random() % pages.size()]);
        scene.needs.pictures = scene.pictures;
        const std::optional<LeaderLine> line = leader_line(scene.needs);
        if (!line) {
            continue;
        }
        ++lines;
        bent += line->count == 3 ? 1 : 0;
        const std::span<const glm::dvec2> points = line->points();
        for (std::size_t part = 0; part + 1 < points.size(); ++part) {
            for (int step = 0; step <= 60; ++step) {
                const glm::dvec2 at = glm::mix(points[part], points[part + 1], step / 60.0);
                EXPECT_FALSE(hides(scene, scene.lens_m, at)) << k;
                EXPECT_FALSE(hides(scene, scene.needs.eye_m, at)) << k;
                for (const typography::TableRectangle& picture : scene.pictures) {
                    EXPECT_FALSE(holds(picture, at, 0.0035)) << k;
                }
            }
        }
        EXPECT_TRUE(holds(scene.needs.label, points.back(), 1e-9));
        EXPECT_FALSE(holds(scene.needs.label, points.back(), -1e-9));
        // It begins beside the prop, or beside the prop's shadow.
        const double off =
            std::min(typography::clearance(std::vector{points[0], points[0] + 1e-9, points[0] - 1e-9},
                                           scene.needs.shadow->corners()),
                     typography::clearance(std::vector{points[0], points[0] + 1e-9, points[0] - 1e-9},
                                           scene.needs.hidden->corners()));
        EXPECT_LT(off, 0.0075) << k; // 4 mm across the outline's edges, more at its corners
        // For the eye, the point and the first part of the line lie on one straight line.
        const glm::dvec3 eye = scene.needs.eye_m;
        const glm::dvec3 normal =
            glm::normalize(glm::cross(glm::dvec3(points[0], 0.0) - eye, glm::dvec3(points[1], 0.0) - eye));
        EXPECT_NEAR(glm::dot(normal, scene.needs.point_m - eye), 0.0, 1e-9) << k;
        if (HasFailure()) {
            FAIL() << "scene " << k;
        }
    }
    RecordProperty("lines", lines);
    RecordProperty("bent", bent);
    EXPECT_GT(lines, scenes * 95 / 100);
    EXPECT_GT(bent, 0);
}

TEST(LeaderLine, MovesSmoothlyAsThePropTurns) {
    Random random(34);
    constexpr double step_rad = 0.25 * std::numbers::pi / 180.0;
    int steps = 0;
    int fast = 0;
    for (int k = 0; k < 40; ++k) {
        Scene scene = some_scene(random, {});
        const glm::dvec3 point = scene.table_from_prop.inverse().point(scene.needs.point_m);
        // The label stays clear of the prop at every yaw, as it does in the exhibit for some time.
        const double reach = 0.17;
        scene.needs.label = {glm::dvec2(scene.table_from_prop.translation) + glm::dvec2(reach, -reach),
                             {0.08, 0.022}};
        std::optional<LeaderLine> before;
        for (int turn = 0; turn < 1440; ++turn) {
            scene.table_from_prop.rotation =
                glm::angleAxis(step_rad, glm::dvec3(0, 0, 1)) * scene.table_from_prop.rotation;
            scene.needs.point_m = scene.table_from_prop.point(point);
            scene.needs.shadow = typography::hidden_by_prop(scene.prop, scene.table_from_prop, scene.lens_m);
            scene.needs.hidden =
                typography::hidden_by_prop(scene.prop, scene.table_from_prop, scene.needs.eye_m);
            const std::optional<LeaderLine> line = leader_line(scene.needs);
            ASSERT_TRUE(line);
            ASSERT_EQ(line->count, 2U);
            if (before) {
                // The line's beginning moves faster than the outline only where it grazes the prop's outline.
                const double moved = glm::distance(line->points_m[0], before->points_m[0]);
                EXPECT_LT(moved, 0.008);
                EXPECT_LT(glm::distance(line->points_m[1], before->points_m[1]), 0.003);
                fast += moved > 0.003 ? 1 : 0;
                ++steps;
            }
            before = line;
        }
    }
    EXPECT_GT(steps, 50'000);
    EXPECT_LT(fast, steps / 1000);
}

TEST(LeaderLine, IsAbsentWithoutAFreePath) {
    Random random(35);
    Scene scene = some_scene(random, {});
    LeaderLineNeeds needs = scene.needs;
    ASSERT_TRUE(leader_line(needs));
    needs.hidden.reset(); // the eye is not above the prop
    EXPECT_FALSE(leader_line(needs));
    needs = scene.needs;
    needs.label.centre_m = glm::dvec2(scene.table_from_prop.translation); // under the prop
    EXPECT_FALSE(leader_line(needs));
    needs = scene.needs;
    const std::vector<typography::TableRectangle> everywhere{{{0.0, 0.0}, {2.0, 2.0}, 0}};
    needs.pictures = everywhere;
    EXPECT_FALSE(leader_line(needs));
}

} // namespace
} // namespace frustumscreen::exhibit
