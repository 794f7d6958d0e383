#include "app/simulation/visitor_view.h"

#include "app/simulation/room_light.h"
#include "app/simulation/sampled_light.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace frustumscreen::simulation {

namespace {

constexpr double prop_share_of_picture = 0.62;
constexpr double whole_share_of_picture = 0.94;
constexpr double largest_sine = 0.9;

constexpr double contact_shadow_reach_m = 0.035;
constexpr double faded_at_m = 2.0; ///< half of the light at this distance

/// A point that a visitor's ray hits.
struct Place {
    glm::dvec3 point_m{0.0}; ///< table frame
    glm::dvec3 normal{0.0};  ///< table frame
    bool lit = false;        ///< visible from the projector's lens
    double albedo = table_albedo;
    double room_share = 1.0; ///< share of the room's light that arrives
    std::optional<ScreenHit> screen = std::nullopt;
};

struct ObjectHit {
    double t = std::numeric_limits<double>::infinity();
    glm::dvec3 normal{0.0};
    const RoomObject* object = nullptr;
};

/// The first hit of a ray from outside an object.
ObjectHit first_object(const std::vector<RoomObject>& objects, const glm::dvec3& origin,
                       const glm::dvec3& direction) {
    ObjectHit first;
    for (const RoomObject& object : objects) {
        double enters = 0.0;
        double leaves = first.t;
        glm::dvec3 normal(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (object.low_m[axis] - origin[axis]) / direction[axis];
            const double b = (object.high_m[axis] - origin[axis]) / direction[axis];
            if (std::min(a, b) > enters) {
                enters = std::min(a, b);
                normal = glm::dvec3(0.0);
                normal[axis] = direction[axis] > 0.0 ? -1.0 : 1.0;
            }
            leaves = std::min(leaves, std::max(a, b));
        }
        if (enters > 0.0 && enters < leaves) {
            first = {enters, normal, &object};
        }
    }
    return first;
}

class Room {
public:
    Room(const VisitorScene& scene, const image::Image8& picture, const VisitorViewOptions& options)
        : scene_(scene), picture_(picture), options_(options),
          prop_from_table_(scene.table_from_prop.inverse()),
          projector_from_table_(scene.table_from_projector.inverse()),
          eye_in_prop_(prop_from_table_.point(scene.eye_m)),
          lens_in_prop_(prop_from_table_.point(scene.table_from_projector.translation)) {
        exposure_ = exposure_of(scene.prop, lens());
        if (scene.screen && options.light) {
            screen_light_.emplace(*scene.screen);
        }
        for (const glm::dvec3& corner : geometry::foot_of(scene.prop)) {
            foot_ = glm::max(foot_, glm::abs(glm::dvec2(corner)));
        }
    }

    [[nodiscard]] std::optional<Place> first_place(const glm::dvec3& direction) const {
        const glm::dvec3 in_prop = prop_from_table_.direction(direction);
        const ObjectHit object = first_object(scene_.objects, scene_.eye_m, direction);
        const std::optional<ScreenHit> screen =
            scene_.screen ? meet(*scene_.screen, scene_.eye_m, direction) : std::nullopt;
        geometry::PropHit prop;
        double nearest = std::numeric_limits<double>::infinity();
        std::optional<Place> place;
        const bool meets_prop = geometry::enter(scene_.prop, eye_in_prop_, in_prop, prop);
        if (meets_prop) {
            nearest = prop.t;
            place = on_prop(scene_.eye_m + prop.t * direction, static_cast<std::size_t>(prop.face));
        }
        if (screen && screen->t < nearest) {
            nearest = screen->t;
            place = Place{.point_m = scene_.eye_m + screen->t * direction,
                          .normal = screen->normal,
                          .lit = false,
                          .albedo = screen_case_albedo,
                          .screen = screen};
        }
        const double table = direction.z < 0.0 ? -scene_.eye_m.z / direction.z : -1.0;
        if (!meets_prop && table > 0.0 && table < nearest && on_table(scene_.eye_m + table * direction)) {
            nearest = table;
            place = on_table_top(scene_.eye_m + table * direction);
        }
        if (object.object != nullptr && object.t < nearest) {
            const glm::dvec3 meets = scene_.eye_m + object.t * direction;
            place = Place{.point_m = meets,
                          .normal = object.normal,
                          .lit = false,
                          .albedo = object.object->albedo,
                          .room_share = fading(meets)};
        }
        return place;
    }

    /// Linear light that a point sends to the eye.
    [[nodiscard]] glm::dvec3 sent_back(const Place& place) const {
        glm::dvec3 light(0.0);
        if (place.screen && place.screen->shines) {
            light = linear_at(scene_.screen->picture, place.screen->pixel, options_.nearest);
            return options_.light ? scene_.screen->white * light : light;
        }
        if (place.lit) {
            light = projected(place.point_m);
        }
        if (!options_.light) {
            return light;
        }
        light *=
            exposure_ * received_from(lens(), place.point_m, place.normal) * pixels_beside(place.point_m);
        const glm::dvec3 glow =
            screen_light_ ? screen_light_->on(place.point_m, place.normal) : glm::dvec3(0.0);
        return place.albedo * (light + glow + place.room_share * room_light_on(place.normal));
    }

    /// Density of the projector's pixels at a point relative to a lens without distortion: each pixel has the
    /// same light.
    [[nodiscard]] double pixels_beside(const glm::dvec3& point_m) const {
        const glm::dvec3 p = in_projector(point_m);
        return scene_.projector.lens.area_factor((p.x * p.x + p.y * p.y) / (p.z * p.z));
    }
    [[nodiscard]] glm::dvec3 lens() const { return scene_.table_from_projector.translation; }
    [[nodiscard]] glm::dvec3 in_projector(const glm::dvec3& point_m) const {
        return projector_from_table_.point(point_m);
    }

private:
    /// The projector's light, linear, as on a surface perpendicular to it.
    [[nodiscard]] glm::dvec3 projected(const glm::dvec3& point_m) const {
        const std::optional<glm::dvec2> pixel = scene_.projector.pixel(projector_from_table_.point(point_m));
        if (!pixel || pixel->x < 0.0 || pixel->y < 0.0 || pixel->x >= picture_.width ||
            pixel->y >= picture_.height) {
            return glm::dvec3(0.0);
        }
        return linear_at(picture_, *pixel, options_.nearest);
    }
    [[nodiscard]] Place on_prop(const glm::dvec3& point_m, std::size_t bound) const {
        const geometry::Plane& plane = scene_.prop.bounds[bound];
        return {.point_m = point_m,
                .normal = scene_.table_from_prop.direction(plane.normal),
                .lit = bound < scene_.prop.faces.size() && plane.distance(lens_in_prop_) > 0.0,
                .albedo = prop_albedo};
    }
    [[nodiscard]] Place on_table_top(const glm::dvec3& point_m) const {
        geometry::PropHit shade;
        const bool shadowed = geometry::enter(scene_.prop, lens_in_prop_,
                                              prop_from_table_.point(point_m) - lens_in_prop_, shade) &&
                              shade.t < 1.0;
        return {.point_m = point_m,
                .normal = glm::dvec3(0, 0, 1),
                .lit = !shadowed,
                .albedo = table_albedo,
                .room_share = contact_shadow(point_m)};
    }
    [[nodiscard]] bool on_table(const glm::dvec3& point_m) const {
        return std::abs(point_m.x) <= scene_.table_size_m.x / 2.0 &&
               std::abs(point_m.y) <= scene_.table_size_m.y / 2.0;
    }
    /// The room's own light is around the table and fades with distance.
    [[nodiscard]] static double fading(const glm::dvec3& point_m) {
        return 1.0 / (1.0 + glm::dot(point_m, point_m) / (faded_at_m * faded_at_m));
    }
    /// Less of the room's light arrives near the prop.
    [[nodiscard]] double contact_shadow(const glm::dvec3& point_m) const {
        const glm::dvec3 p = prop_from_table_.point(point_m);
        const glm::dvec3 outside = glm::max(glm::abs(p) - glm::dvec3(foot_, 0.0), glm::dvec3(0.0));
        return 1.0 - 0.75 * std::exp(-glm::length(outside) / contact_shadow_reach_m);
    }

    const VisitorScene& scene_;
    const image::Image8& picture_;
    VisitorViewOptions options_;
    geometry::RigidTransform prop_from_table_;
    geometry::RigidTransform projector_from_table_;
    glm::dvec3 eye_in_prop_;
    glm::dvec3 lens_in_prop_;
    glm::dvec2 foot_{0.0}; ///< half of the sides of a rectangle around the prop's axis that holds its foot
    double exposure_ = 1.0;
    std::optional<ScreenLight> screen_light_;
};

/// The rotation of a camera without roll: its columns are right, down and forward.
glm::dmat3 looking_along(const glm::dvec3& forward) {
    const glm::dvec3 across = glm::cross(forward, glm::dvec3(0, 0, 1));
    const glm::dvec3 right = glm::length(across) > 1e-9 ? glm::normalize(across) : glm::dvec3(1, 0, 0);
    return {right, glm::cross(forward, right), forward};
}

} // namespace

VisitorCamera visitor_camera(const geometry::PropShape& prop, const geometry::RigidTransform& table_from_prop,
                             const glm::dvec3& eye_m, int width, int height) {
    double radius = 0.0;
    for (const glm::dvec3& corner : prop.corners) {
        radius = std::max(radius, glm::distance(corner, prop.middle));
    }
    const glm::dvec3 towards = table_from_prop.point(prop.middle) - eye_m;
    const double distance = glm::length(towards);
    const glm::dvec3 forward = distance > 0.0 ? towards / distance : glm::dvec3(0, 0, -1);
    const double sine = distance > 0.0 ? std::min(largest_sine, radius / distance) : largest_sine;
    const double focal_px = prop_share_of_picture * std::min(width, height) / 2.0 / std::tan(std::asin(sine));
    return {{width, height, focal_px, focal_px, width / 2.0, height / 2.0},
            {glm::normalize(glm::quat_cast(looking_along(forward))), eye_m}};
}

VisitorCamera whole_camera(const VisitorScene& scene, int width, int height) {
    std::vector<glm::dvec3> shown = scene.beside_m;
    for (const glm::dvec3& corner : scene.prop.corners) {
        shown.push_back(scene.table_from_prop.point(corner));
    }
    if (scene.screen) {
        shown.insert(shown.end(), scene.screen->corners_m.begin(), scene.screen->corners_m.end());
        for (const double side : {-0.5, 0.5}) {
            shown.emplace_back(side * scene.table_size_m.x, 0.5 * scene.table_size_m.y, 0.0);
        }
    }
    glm::dvec3 forward(0.0);
    for (const glm::dvec3& place : shown) {
        forward += glm::normalize(place - scene.eye_m);
    }
    glm::dmat3 rotation = looking_along(glm::normalize(forward));
    glm::dvec2 half(1.0);     // of what is shown, as tangents
    constexpr int rounds = 8; // the middle of the box changes with the direction; it settles at once
    for (int round = 0; round < rounds; ++round) {
        glm::dvec2 low(std::numeric_limits<double>::infinity());
        glm::dvec2 high(-std::numeric_limits<double>::infinity());
        for (const glm::dvec3& place : shown) {
            const glm::dvec3 seen = glm::transpose(rotation) * (place - scene.eye_m);
            const glm::dvec2 tangents =
                glm::dvec2(seen) / std::fmax(seen.z, 1e-3); // beside the eye: at the edge
            low = glm::min(low, tangents);
            high = glm::max(high, tangents);
        }
        half = 0.5 * (high - low);
        const glm::dvec2 middle = 0.5 * (low + high);
        rotation = looking_along(glm::normalize(rotation * glm::dvec3(middle, 1.0)));
    }
    const double focal_px = 0.5 * whole_share_of_picture * std::fmin(width / half.x, height / half.y);
    return {{width, height, focal_px, focal_px, width / 2.0, height / 2.0},
            {glm::normalize(glm::quat_cast(rotation)), scene.eye_m}};
}

image::Image8 visitor_view(const VisitorScene& scene, const image::Image8& projected,
                           const VisitorCamera& camera, const VisitorViewOptions& options) {
    const Room room(scene, projected, options);
    image::Image8 view(camera.pinhole.width, camera.pinhole.height, glm::u8vec4(0, 0, 0, 255));
    const int rays = std::max(1, options.rays_per_side);
    const auto pixel_colour = [&](int x, int y) {
        glm::dvec3 sum(0.0);
        for (int k = 0; k < rays * rays; ++k) {
            const int column = k % rays;
            const int row = k / rays;
            const glm::dvec2 at(x + (column + 0.5) / rays, y + (row + 0.5) / rays);
            if (const auto place =
                    room.first_place(camera.table_from_camera.direction(camera.pinhole.ray(at)))) {
                sum += room.sent_back(*place);
            }
        }
        return sum / static_cast<double>(rays * rays);
    };
    parallel_for(static_cast<std::size_t>(view.height), 8, [&](std::size_t begin, std::size_t end) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
            for (int x = 0; x < view.width; ++x) {
                const glm::dvec3 colour = pixel_colour(x, y);
                view.at(x, y) =
                    glm::u8vec4(image::srgb8_from_linear(colour.r), image::srgb8_from_linear(colour.g),
                                image::srgb8_from_linear(colour.b), 255);
            }
        }
    });
    return view;
}

std::string visitor_cameras_json(std::span<const VisitorFrame> frames) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const VisitorFrame& frame : frames) {
        const geometry::Pinhole& pinhole = frame.camera.pinhole;
        const glm::dmat4 matrix = frame.camera.table_from_camera.matrix();
        nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
        for (int k = 0; k < 16; ++k) {
            numbers.push_back(matrix[k / 4][k % 4]);
        }
        list.push_back({{"frame", frame.frame},
                        {"t_us", frame.t_us},
                        {"eye_m", {frame.eye_m.x, frame.eye_m.y, frame.eye_m.z}},
                        {"width", pinhole.width},
                        {"height", pinhole.height},
                        {"fx", pinhole.fx},
                        {"fy", pinhole.fy},
                        {"cx", pinhole.cx},
                        {"cy", pinhole.cy},
                        {"table_from_camera", numbers}});
    }
    return nlohmann::ordered_json{{"frames", list}}.dump(1) + "\n";
}

} // namespace frustumscreen::simulation
