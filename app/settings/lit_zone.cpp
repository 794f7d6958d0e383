#include "app/settings/lit_zone.h"

#include "app/geometry/picture_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

namespace frustumscreen::settings {

namespace {

constexpr double pi = std::numbers::pi;

/// Azimuths within `half` of `middle`; half >= pi: the full circle.
struct Arc {
    double middle = 0.0;
    double half = pi;

    [[nodiscard]] double min_cosine_to(double azimuth) const {
        const double apart = std::abs(std::remainder(azimuth - middle, 2.0 * pi));
        return std::cos(std::fmin(apart + half, pi));
    }
    [[nodiscard]] Arc turned(double by) const { return {middle + by, half}; }
};
constexpr Arc full_circle{};

/// The plane through the lens and an edge of the picture, table frame.
struct PictureEdge {
    glm::dvec3 inward{0.0};  ///< unit normal
    double horizontal = 0.0; ///< length of its horizontal part
    double azimuth = 0.0;
};

std::array<PictureEdge, 4> picture_edges(const ProjectorSettings& projector) {
    const std::array<geometry::Plane, 4> planes =
        geometry::picture_planes(projector.pinhole, projector.table_from_projector);
    std::array<PictureEdge, 4> edges{};
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec3& inward = planes[k].normal;
        edges[k] = {inward, glm::length(glm::dvec2(inward)), std::atan2(inward.y, inward.x)};
    }
    return edges;
}

/// The table top less a rim; empty if nothing is left.
Polygon table_within(const TableSettings& table, double rim) {
    const double x = table.width_m / 2.0 - rim;
    const double y = table.depth_m / 2.0 - rim;
    if (!(x > 0.0 && y > 0.0)) {
        return {};
    }
    return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

/// A point of the prop, which moves on a circle about the axis as the prop turns.
struct Round {
    double radius = 0.0;
    double z = 0.0;
    double off = 0.0; ///< azimuth, from that of the face with this corner
    [[nodiscard]] bool operator==(const Round&) const = default;
};

/// A face at any yaw: its plane is run cos(azimuth) x + ... + rise z = offset.
struct TurnedFace {
    double run = 0.0; ///< length of the normal's horizontal part; 0: it looks straight up or down
    double rise = 0.0;
    double offset = 0.0;
    geometry::PerCorner<Round> corners{};
};

TurnedFace turned(const geometry::PropFace& face) {
    const glm::dvec3& n = face.plane.normal;
    TurnedFace result{
        .run = glm::length(glm::dvec2(n)), .rise = n.z, .offset = face.plane.offset, .corners = {}};
    const double azimuth = result.run > 0.0 ? std::atan2(n.y, n.x) : 0.0;
    for (const glm::dvec3& corner : face.corners) {
        result.corners.push_back({glm::length(glm::dvec2(corner)), corner.z,
                                  std::remainder(std::atan2(corner.y, corner.x) - azimuth, 2.0 * pi)});
    }
    return result;
}

/// The sides of a frustum are congruent: at any yaw they count as one face.
bool are_alike(const TurnedFace& a, const TurnedFace& b) {
    constexpr double rounding = 1e-12;
    const auto near = [](double x, double y) { return std::abs(x - y) <= rounding; };
    return near(a.run, b.run) && near(a.rise, b.rise) && near(a.offset, b.offset) &&
           std::equal(a.corners.begin(), a.corners.end(), b.corners.begin(), b.corners.end(),
                      [&](const Round& c, const Round& d) {
                          return near(c.radius, d.radius) && near(c.z, d.z) && near(c.off, d.off);
                      });
}

/// The upright prop and the light, reduced to what the conditions need.
struct Scene {
    explicit Scene(const Settings& settings)
        : edges(picture_edges(settings.projector)),
          lens(settings.projector.table_from_projector.translation) {
        const geometry::PropShape prop = make_prop(settings.prop);
        for (const geometry::PropFace& face : prop.faces) {
            const bool on_table = std::all_of(face.corners.begin(), face.corners.end(),
                                              [](const glm::dvec3& corner) { return corner.z == 0.0; });
            const TurnedFace turned_face = turned(face);
            const bool known = std::any_of(faces.begin(), faces.end(), [&](const TurnedFace& other) {
                return are_alike(turned_face, other);
            });
            if (!on_table && !known) {
                faces.push_back(turned_face);
            }
        }
        for (const glm::dvec3& corner : prop.corners) {
            const Round round{glm::length(glm::dvec2(corner)), corner.z, 0.0};
            if (std::find(corners.begin(), corners.end(), round) == corners.end()) {
                corners.push_back(round);
            }
            reach = std::fmax(reach, round.radius);
            middle_reach = std::fmax(middle_reach, glm::distance(corner, prop.middle));
        }
    }

    /// The least sine of the light on a face that looks into `arc`.
    [[nodiscard]] double min_sine_on(const TurnedFace& face, const glm::dvec2& place, const Arc& arc) const {
        const glm::dvec2 to_lens = glm::dvec2(lens) - place;
        const double distance = glm::length(to_lens);
        const double toward = distance * arc.min_cosine_to(std::atan2(to_lens.y, to_lens.x));
        return (face.run * toward + face.rise * lens.z - face.offset) / std::hypot(distance, lens.z);
    }
    /// True if an arc of the circle about the prop's axis is inside the picture.
    [[nodiscard]] bool in_picture(const glm::dvec2& place, const Round& round, const Arc& arc) const {
        return std::all_of(edges.begin(), edges.end(), [&](const PictureEdge& edge) {
            const double middle = glm::dot(edge.inward, glm::dvec3(place, round.z) - lens);
            const double most = edge.horizontal * round.radius;
            return middle >= most ||
                   (middle >= -most && middle + most * arc.min_cosine_to(edge.azimuth) >= 0.0);
        });
    }

    std::array<PictureEdge, 4> edges;
    glm::dvec3 lens;
    std::vector<TurnedFace> faces; ///< one of each kind, without those that lie on the table
    std::vector<Round> corners;    ///< of the solid
    double reach = 0.0;            ///< from the axis
    double middle_reach = 0.0;     ///< from the prop's middle
};

/// The azimuths of a face at the yaws that show it to the eye; nothing if there are none.
std::optional<Arc> seen_azimuths(const TurnedFace& face, const glm::dvec2& place, const glm::dvec3& eye) {
    if (face.run == 0.0) {
        return face.rise * eye.z > face.offset ? std::optional(full_circle) : std::nullopt;
    }
    const glm::dvec2 to_eye = glm::dvec2(eye) - place;
    const double min_cosine = (face.offset - face.rise * eye.z) / (face.run * glm::length(to_eye));
    if (!(min_cosine < 1.0)) {
        return std::nullopt;
    }
    return Arc{std::atan2(to_eye.y, to_eye.x), std::acos(std::fmax(min_cosine, -1.0))};
}

bool lit_at_any_yaw(const Scene& scene, const glm::dvec2& place, const glm::dvec3& eye) {
    return std::all_of(scene.faces.begin(), scene.faces.end(), [&](const TurnedFace& face) {
        const std::optional<Arc> seen = seen_azimuths(face, place, eye);
        return !seen || (scene.min_sine_on(face, place, *seen) >= min_sine_of_light &&
                         std::all_of(face.corners.begin(), face.corners.end(), [&](const Round& corner) {
                             return scene.in_picture(place, corner, seen->turned(corner.off));
                         }));
    });
}

/// The distance from the lens's foot up to which every face is turned to the light at every yaw: the sine where the
/// prop's axis meets the table. Negative if there is none. Compare radius_lit_at_farthest_corner in whole_zone.cpp.
double radius_lit_at_foot(const Scene& scene) {
    const auto lit = [&](double radius) {
        const glm::dvec2 place = glm::dvec2(scene.lens) + glm::dvec2(radius, 0.0);
        return std::all_of(scene.faces.begin(), scene.faces.end(), [&](const TurnedFace& face) {
            return scene.min_sine_on(face, place, full_circle) >= min_sine_of_light;
        });
    };
    if (!lit(0.0)) {
        return -1.0;
    }
    double near = 0.0;
    double far = 100.0;
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (near + far);
        (lit(middle) ? near : far) = middle;
    }
    return near;
}

/// The places of `polygon` at height z that lie in the picture together with a circle, and with a ball, around
/// them.
Polygon clipped_to_picture(Polygon polygon, const Scene& scene, double z, double circle, double ball = 0.0) {
    for (const PictureEdge& edge : scene.edges) {
        const double offset = glm::dot(edge.inward, scene.lens) - edge.inward.z * z;
        polygon = clipped(polygon, {glm::dvec2(edge.inward), offset + circle * edge.horizontal + ball});
    }
    return polygon;
}

/// Places at which the prop in the hand lies in the picture, its middle just high enough to turn it in any way.
Polygon hand_zone(const Settings& settings, const Scene& scene) {
    const double ball = scene.middle_reach;
    return clipped_to_picture(table_within(settings.table, ball), scene, ball, 0.0, ball);
}

Polygon upright_zone(const Settings& settings, const Scene& scene) {
    const double radius = radius_lit_at_foot(scene);
    if (radius < 0.0) {
        return {};
    }
    Polygon zone = table_within(settings.table, scene.reach);
    for (const Round& corner : scene.corners) {
        zone = clipped_to_picture(std::move(zone), scene, corner.z, corner.radius);
    }
    // The disc as an inscribed polygon: never too large, too small by 0.02 % at most.
    constexpr int sides = 180;
    const double apothem = radius * std::cos(pi / sides);
    for (int side = 0; side < sides; ++side) {
        const double azimuth = 2.0 * pi * side / sides;
        const glm::dvec2 inward(-std::cos(azimuth), -std::sin(azimuth));
        zone = clipped(zone, {inward, glm::dot(inward, glm::dvec2(scene.lens)) - apothem});
    }
    return zone.size() >= 3 && area_of(zone) > 0.0 ? zone : Polygon();
}

Polygon any_eye_zone(const Settings& settings, const Scene& scene) {
    return settings.prop.zone == PropZone::Hand ? hand_zone(settings, scene) : upright_zone(settings, scene);
}

/// Every degree, and the corners of the zone for any eye, which is a part of the zone searched for.
std::vector<double> azimuths_from(const glm::dvec2& middle, const Polygon& any_eye) {
    std::vector<double> azimuths;
    for (int degree = -179; degree <= 180; ++degree) {
        azimuths.push_back(glm::radians(1.0 * degree));
    }
    for (const glm::dvec2& corner : any_eye) {
        azimuths.push_back(std::atan2(corner.y - middle.y, corner.x - middle.x));
    }
    std::sort(azimuths.begin(), azimuths.end());
    return azimuths;
}

Polygon default_eye_zone(const Settings& settings, const Scene& scene, const Polygon& any_eye) {
    const double x = settings.table.width_m / 2.0 - scene.reach;
    const double y = settings.table.depth_m / 2.0 - scene.reach;
    const auto lit = [&](const glm::dvec2& p) {
        return std::abs(p.x) <= x && std::abs(p.y) <= y && lit_at_any_yaw(scene, p, settings.eye.default_m);
    };
    constexpr int cells = 100;
    std::vector<glm::dvec2> places;
    for (int k = 0; k < cells * cells && x > 0.0 && y > 0.0; ++k) {
        const glm::dvec2 cell(k % cells, k / cells);
        const glm::dvec2 at = (cell + 0.5) / (0.5 * cells) - 1.0;
        if (lit(at * glm::dvec2(x, y))) {
            places.push_back(at * glm::dvec2(x, y));
        }
    }
    if (places.empty()) {
        return {};
    }
    const glm::dvec2 mean =
        std::accumulate(places.begin(), places.end(), glm::dvec2(0.0)) / static_cast<double>(places.size());
    const glm::dvec2 middle =
        *std::min_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
            return glm::distance(a, mean) < glm::distance(b, mean);
        });
    // On a table hardly wider than the prop, steps in proportion to its width would never reach its ends.
    const double step = std::fmax(std::fmin(x, y) / 250.0, std::fmax(x, y) / 5000.0);
    Polygon zone;
    for (const double azimuth : azimuths_from(middle, any_eye)) {
        const glm::dvec2 direction(std::cos(azimuth), std::sin(azimuth));
        double inside = 0.0;
        while (lit(middle + direction * (inside + step))) {
            inside += step;
        }
        double outside = inside + step;
        for (int halving = 0; halving < 40; ++halving) {
            const double between = 0.5 * (inside + outside);
            (lit(middle + direction * between) ? inside : outside) = between;
        }
        zone.push_back(middle + direction * inside);
    }
    return zone;
}

} // namespace

Polygon picture_on_table(const Settings& settings, double z, double circle_m) {
    return clipped_to_picture(table_within(settings.table, 0.0), Scene(settings), z, circle_m);
}

Rectangle lit_rectangle(const Settings& settings) {
    return rectangle_inside(any_eye_zone(settings, Scene(settings)));
}

LitZone lit_zone(const Settings& settings) {
    const Scene scene(settings);
    LitZone zone;
    const bool in_hand = settings.prop.zone == PropZone::Hand;
    zone.any_eye = any_eye_zone(settings, scene);
    zone.any_eye_rectangle = rectangle_inside(zone.any_eye);
    zone.default_eye = in_hand ? zone.any_eye : default_eye_zone(settings, scene, zone.any_eye);
    return zone;
}

bool every_seen_face_is_lit(const Settings& settings, const geometry::RigidTransform& table_from_prop,
                            const glm::dvec3& eye) {
    const geometry::PropShape prop = make_prop(settings.prop);
    const geometry::RigidTransform prop_from_table = table_from_prop.inverse();
    const geometry::RigidTransform& table_from_projector = settings.projector.table_from_projector;
    const glm::dvec3 eye_prop = prop_from_table.point(eye);
    const glm::dvec3 lens_prop = prop_from_table.point(table_from_projector.translation);
    const geometry::RigidTransform projector_from_prop = table_from_projector.inverse() * table_from_prop;
    const geometry::Pinhole& pinhole = settings.projector.pinhole;
    const auto in_picture = [&](const glm::dvec3& corner) {
        const auto pixel = pinhole.pixel(projector_from_prop.point(corner));
        return pixel && pixel->x >= 0.0 && pixel->y >= 0.0 && pixel->x <= pinhole.width &&
               pixel->y <= pinhole.height;
    };
    return std::all_of(prop.faces.begin(), prop.faces.end(), [&](const geometry::PropFace& face) {
        return face.plane.distance(eye_prop) <= 0.0 ||
               (face.plane.distance(lens_prop) >= min_sine_of_light * glm::length(lens_prop) &&
                std::all_of(face.corners.begin(), face.corners.end(), in_picture));
    });
}

} // namespace frustumscreen::settings
