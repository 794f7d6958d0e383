#include "app/settings/lit_zone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace frustumscreen {

namespace {

using Polygon = std::vector<glm::dvec2>;
constexpr double pi = std::numbers::pi;

/// Azimuths within `half` of `middle`; half >= pi is the full circle.
struct Arc {
    double middle = 0.0;
    double half = pi;

    [[nodiscard]] double least_cosine_to(double azimuth) const {
        const double apart = std::abs(std::remainder(azimuth - middle, 2.0 * pi));
        return std::cos(std::fmin(apart + half, pi));
    }
    [[nodiscard]] Arc widened(double by) const { return {middle, std::fmin(half + by, pi)}; }
};
constexpr Arc full_circle{};

/// a.x >= offset.
struct HalfPlane {
    glm::dvec2 inward{0.0};
    double offset = 0.0;
};

/// Planes through the lens and the picture's edges, unit normals inward, table frame.
std::array<glm::dvec3, 4> picture_edges(const ProjectorSettings& projector) {
    const Pinhole& p = projector.pinhole;
    const std::array<glm::dvec2, 4> corners{glm::dvec2(0, 0), glm::dvec2(p.width, 0),
                                            glm::dvec2(p.width, p.height), glm::dvec2(0, p.height)};
    std::array<glm::dvec3, 4> edges{};
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec3 normal = glm::cross(p.ray(corners[k]), p.ray(corners[(k + 1) % 4]));
        edges[k] = projector.table_from_projector.direction(glm::normalize(normal));
    }
    return edges;
}

Polygon clipped(const Polygon& polygon, const HalfPlane& keep) {
    Polygon result;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const glm::dvec2& a = polygon[k];
        const glm::dvec2& b = polygon[(k + 1) % polygon.size()];
        const double a_inside = glm::dot(keep.inward, a) - keep.offset;
        const double b_inside = glm::dot(keep.inward, b) - keep.offset;
        if (a_inside >= 0.0) {
            result.push_back(a);
        }
        if ((a_inside > 0.0 && b_inside < 0.0) || (a_inside < 0.0 && b_inside > 0.0)) {
            result.push_back(a + (b - a) * (a_inside / (a_inside - b_inside)));
        }
    }
    return result;
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

/// The prop and the light, reduced to what the conditions need.
struct Scene {
    explicit Scene(const Settings& settings)
        : edges(picture_edges(settings.projector)), lens(settings.projector.table_from_projector.translation),
          bottom_half(settings.prop.base_m / 2.0), height(settings.prop.height_m),
          top_half((settings.prop.kind == PropKind::Cube ? settings.prop.base_m : settings.prop.top_m) / 2.0),
          slope((bottom_half - top_half) / height) {}

    [[nodiscard]] double bottom_radius() const { return bottom_half * std::numbers::sqrt2; }
    [[nodiscard]] double top_radius() const { return top_half * std::numbers::sqrt2; }

    /// Least sine, over faces looking into `arc`, of the light onto a side face: (cos - (b - slope z)) of the
    /// lens's azimuth, per length of the face's normal, per distance.
    [[nodiscard]] double least_sine_on_sides(const glm::dvec2& place, const Arc& arc) const {
        const glm::dvec2 to_lens = glm::dvec2(lens) - place;
        const double toward = glm::length(to_lens) * arc.least_cosine_to(std::atan2(to_lens.y, to_lens.x));
        const double above = (toward + slope * lens.z - bottom_half) / std::hypot(1.0, slope);
        return above / std::hypot(glm::length(to_lens), lens.z);
    }
    [[nodiscard]] double sine_on_top(const glm::dvec2& place) const {
        return (lens.z - height) / std::hypot(glm::distance(glm::dvec2(lens), place), lens.z);
    }
    /// Is an arc of the circle about the prop's axis at height z inside the picture?
    [[nodiscard]] bool in_picture(const glm::dvec2& place, double radius, double z, const Arc& arc) const {
        return std::all_of(edges.begin(), edges.end(), [&](const glm::dvec3& edge) {
            const double least =
                glm::length(glm::dvec2(edge)) * radius * arc.least_cosine_to(std::atan2(edge.y, edge.x));
            return glm::dot(edge, glm::dvec3(place, z) - lens) + least >= 0.0;
        });
    }

    std::array<glm::dvec3, 4> edges;
    glm::dvec3 lens;
    double bottom_half;
    double height;
    double top_half;
    double slope; ///< horizontal run of a side face for each metre up
};

bool lit_at_any_yaw(const Scene& scene, const glm::dvec2& place, const glm::dvec3& eye) {
    if (eye.z > scene.height) {
        if (scene.sine_on_top(place) < least_sine_of_light ||
            !scene.in_picture(place, scene.top_radius(), scene.height, full_circle)) {
            return false;
        }
    }
    // The eye sees the side faces whose azimuth's cosine towards it exceeds this.
    const glm::dvec2 to_eye = glm::dvec2(eye) - place;
    const double least_cosine = (scene.bottom_half - scene.slope * eye.z) / glm::length(to_eye);
    if (least_cosine >= 1.0) {
        return true;
    }
    const Arc seen{std::atan2(to_eye.y, to_eye.x), std::acos(std::fmax(least_cosine, -1.0))};
    const Arc corners = seen.widened(pi / 4.0);
    return scene.least_sine_on_sides(place, seen) >= least_sine_of_light &&
           scene.in_picture(place, scene.bottom_radius(), 0.0, corners) &&
           scene.in_picture(place, scene.top_radius(), scene.height, corners);
}

/// How far from the lens's foot every face is turned to the light at every yaw; negative if nowhere.
double lit_radius(const Scene& scene) {
    const auto lit = [&](double radius) {
        const glm::dvec2 place = glm::dvec2(scene.lens) + glm::dvec2(radius, 0.0);
        return scene.least_sine_on_sides(place, full_circle) >= least_sine_of_light &&
               scene.sine_on_top(place) >= least_sine_of_light;
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

Polygon clipped_to_picture(Polygon polygon, const Scene& scene, double z, double rim) {
    for (const glm::dvec3& edge : scene.edges) {
        const glm::dvec2 inward(edge);
        polygon =
            clipped(polygon, {inward, glm::dot(edge, scene.lens) - edge.z * z + rim * glm::length(inward)});
    }
    return polygon;
}

Polygon any_eye_zone(const Settings& settings, const Scene& scene) {
    const double radius = lit_radius(scene);
    if (radius < 0.0) {
        return {};
    }
    Polygon zone = table_within(settings.table, scene.bottom_radius());
    zone = clipped_to_picture(std::move(zone), scene, 0.0, scene.bottom_radius());
    zone = clipped_to_picture(std::move(zone), scene, scene.height, scene.top_radius());
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

glm::dvec2 centroid(const Polygon& polygon) {
    glm::dvec2 sum(0.0);
    double area = 0.0;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
        const glm::dvec2 a = polygon[k] - polygon[0];
        const glm::dvec2 b = polygon[k + 1] - polygon[0];
        const double twice = a.x * b.y - a.y * b.x;
        area += twice;
        sum += twice * (polygon[0] + (a + b) / 3.0);
    }
    return sum / area;
}

/// The largest upright rectangle about the centroid of a convex polygon.
Rectangle rectangle_inside(const Polygon& polygon) {
    if (polygon.empty()) {
        return {};
    }
    Rectangle best{centroid(polygon), glm::dvec2(0.0)};
    constexpr int shapes = 360;
    for (int shape = 1; shape < shapes; ++shape) {
        const double angle = 0.5 * pi * shape / shapes;
        const glm::dvec2 half(std::cos(angle), std::sin(angle));
        double scale = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const glm::dvec2 along = polygon[(k + 1) % polygon.size()] - polygon[k];
            const glm::dvec2 outward(along.y, -along.x);
            const double room = glm::dot(outward, polygon[k] - best.centre_m);
            const double reach = glm::dot(glm::abs(outward), half);
            scale = reach > 0.0 ? std::fmin(scale, room / reach) : scale;
        }
        const glm::dvec2 scaled = half * scale;
        best.half_m = scaled.x * scaled.y > best.half_m.x * best.half_m.y ? scaled : best.half_m;
    }
    return best;
}

/// Every degree, and the corners of the zone for any eye, which is a part of the zone sought.
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
    const double x = settings.table.width_m / 2.0 - scene.bottom_radius();
    const double y = settings.table.depth_m / 2.0 - scene.bottom_radius();
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
    // On a table hardly wider than the prop, steps of its width would never get to its ends.
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

double area_of(const std::vector<glm::dvec2>& polygon) {
    double twice = 0.0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const glm::dvec2& a = polygon[k];
        const glm::dvec2& b = polygon[(k + 1) % polygon.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * twice;
}

std::vector<glm::dvec2> picture_on_table(const Settings& settings, double z) {
    return clipped_to_picture(table_within(settings.table, 0.0), Scene(settings), z, 0.0);
}

LitZone lit_zone(const Settings& settings) {
    const Scene scene(settings);
    LitZone zone;
    zone.any_eye = any_eye_zone(settings, scene);
    zone.any_eye_rectangle = rectangle_inside(zone.any_eye);
    zone.default_eye = default_eye_zone(settings, scene, zone.any_eye);
    return zone;
}

bool every_seen_face_is_lit_at_any_yaw(const Settings& settings, const glm::dvec2& place,
                                       const glm::dvec3& eye) {
    return lit_at_any_yaw(Scene(settings), place, eye);
}

bool every_seen_face_is_lit(const Settings& settings, const RigidTransform& table_from_prop,
                            const glm::dvec3& eye) {
    const PropShape prop = make_prop(settings.prop);
    const RigidTransform prop_from_table = table_from_prop.inverse();
    const RigidTransform& table_from_projector = settings.projector.table_from_projector;
    const glm::dvec3 eye_prop = prop_from_table.point(eye);
    const glm::dvec3 lens_prop = prop_from_table.point(table_from_projector.translation);
    const RigidTransform projector_from_prop = table_from_projector.inverse() * table_from_prop;
    const Pinhole& pinhole = settings.projector.pinhole;
    const auto in_picture = [&](const glm::dvec3& corner) {
        const auto pixel = pinhole.pixel(projector_from_prop.point(corner));
        return pixel && pixel->x >= 0.0 && pixel->y >= 0.0 && pixel->x <= pinhole.width &&
               pixel->y <= pinhole.height;
    };
    return std::all_of(prop.faces.begin(), prop.faces.end(), [&](const PropFace& face) {
        return face.plane.distance(eye_prop) <= 0.0 ||
               (face.plane.distance(lens_prop) >= least_sine_of_light * glm::length(lens_prop) &&
                std::all_of(face.corners.begin(), face.corners.end(), in_picture));
    });
}

} // namespace frustumscreen
