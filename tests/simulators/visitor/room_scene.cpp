#include "tests/simulators/visitor/room_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace frustumscreen::simulators {

namespace {

/// One ray goes through each pixel; the exhibit averages four neighbours, which belong to four moments of the
/// exposure.
constexpr int side = 2;
constexpr std::array<double, side * side> share_of_exposure{0.125, 0.625, 0.875, 0.375};
constexpr int bands = 12; // groups of rows with a common exposure time

const glm::dvec3 room_low(-3.0, -3.2, -0.9);
const glm::dvec3 room_high(3.2, 2.6, 2.2);
const glm::dvec3 lamp(-0.4, -1.0, 2.1);

/// Reflectance of a wall: pictures, a door, and uneven paint.
double wall(double along, double up) {
    const double paint = 0.55 + 0.04 * std::sin(3.0 * along) * std::sin(2.0 * up + 1.0);
    const double column = along - 1.3 * std::floor(along / 1.3);
    if (column > 0.25 && column < 0.95 && up > 0.3 && up < 1.1) {
        const bool frame = column < 0.29 || column > 0.91 || up < 0.34 || up > 1.06;
        return frame ? 0.1 : 0.3 + 0.2 * std::sin(9.0 * along) * std::cos(7.0 * up);
    }
    return up < -0.75 ? 0.2 : paint; // skirting board
}

double lamps_on(const glm::dvec3& point, const glm::dvec3& normal) {
    const glm::dvec3 to = lamp - point;
    const double distance = glm::length(to);
    return 0.5 + 0.9 * std::fmax(0.0, glm::dot(normal, to) / distance) / (1.0 + 0.3 * distance * distance);
}

/// The projector's light that the prop and the table reflect into the room.
double spill_on(const glm::dvec3& point, const glm::dvec3& normal) {
    const glm::dvec3 to = glm::dvec3(0.0, 0.0, 0.1) - point;
    const double square = std::fmax(0.05, glm::dot(to, to));
    return 0.03 * std::fmax(0.0, glm::dot(normal, to) / std::sqrt(square)) / square;
}

} // namespace

geometry::RigidTransform WatchingCamera::table_from_camera() const {
    // The top of its picture is up.
    const glm::dvec3 forward = glm::normalize(aim_m - place_m);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 0, 1)));
    return {glm::quat_cast(glm::dmat3(right, glm::cross(forward, right), forward)), place_m};
}

RoomScene::RoomScene(const WatchingCamera& camera, const RoomLight& light, const glm::dvec2& table_size_m,
                     const geometry::PropShape& prop, const glm::dvec3& prop_m)
    : camera_(camera), table_from_camera_(camera.table_from_camera()), light_(light),
      table_size_m_(table_size_m), prop_(prop), prop_m_(prop_m) {
    for (std::size_t k = 0; k < code_of_.size(); ++k) {
        const double light_seen = static_cast<double>(k) / (codes_of_light - 1.0);
        code_of_[k] =
            static_cast<std::uint8_t>(std::lround(255.0 * std::pow(light_seen, 1.0 / camera_.gamma)));
    }
    const geometry::Pinhole& pinhole = camera_.pinhole;
    for (int row = 0; row < pinhole.height; ++row) {
        for (int column = 0; column < pinhole.width; ++column) {
            rays_.push_back(
                glm::normalize(table_from_camera_.direction(pinhole.ray({column + 0.5, row + 0.5}))));
            seen_.push_back(room(rays_.back()));
        }
    }
}

std::size_t RoomScene::pixel_at(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(camera_.pinhole.width) +
           static_cast<std::size_t>(column);
}

RoomScene::Seen RoomScene::room(const glm::dvec3& direction) const {
    const glm::dvec3& origin = table_from_camera_.translation;
    Seen seen;
    const auto set = [&](double away, double reflectance, const glm::dvec3& normal, double direct) {
        const glm::dvec3 point = origin + away * direction;
        seen.away_m = static_cast<float>(away);
        seen.lamps = static_cast<float>(light_.room * reflectance * lamps_on(point, normal));
        seen.projector = static_cast<float>(light_.projector * reflectance *
                                            (direct > 0.0 ? direct : spill_on(point, normal)));
        seen.is_lit = direct > 0.0;
    };
    if (geometry::PropHit hit; geometry::enter(prop_, origin - prop_m_, direction, hit)) {
        set(hit.t, 0.85, prop_.bounds[static_cast<std::size_t>(hit.face)].normal, 0.6);
        return seen;
    }
    if (direction.z < 0.0) {
        const double away = -origin.z / direction.z;
        const glm::dvec3 at = glm::abs(origin + away * direction);
        if (2.0 * at.x < table_size_m_.x && 2.0 * at.y < table_size_m_.y) {
            set(away, 0.2, {0, 0, 1}, 0.12);
            return seen;
        }
    }
    double away = std::numeric_limits<double>::infinity();
    glm::dvec3 normal(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const double end = direction[axis] > 0.0 ? room_high[axis] : room_low[axis];
        const double t = (end - origin[axis]) / direction[axis];
        if (t > 0.0 && t < away) {
            away = t;
            normal = glm::dvec3(0.0);
            normal[axis] = direction[axis] > 0.0 ? -1.0 : 1.0;
        }
    }
    const glm::dvec3 at = origin + away * direction;
    const bool up_down = normal.z != 0.0;
    set(away, up_down ? (normal.z > 0.0 ? 0.25 : 0.7) : wall(normal.x != 0.0 ? at.y : at.x, at.z), normal,
        0.0);
    seen.is_floor = normal.z > 0.0;
    return seen;
}

double RoomScene::people_light(const Ball& ball, const glm::dvec3& point_m, const LightNow& now) const {
    const glm::dvec3 unit = ball.unit_from_table * (point_m - ball.middle_m);
    const glm::dvec3 normal = glm::normalize(glm::transpose(ball.unit_from_table) * unit);
    const glm::dvec2 at = glm::abs(glm::dvec2(point_m));
    const bool under_projector = 2.0 * at.x < table_size_m_.x && 2.0 * at.y < table_size_m_.y;
    const double picture = under_projector ? 0.4 * std::fmax(0.0, normal.z) : spill_on(point_m, normal);
    return ball.reflectance *
           (light_.room * now.lamps * lamps_on(point_m, normal) + light_.projector * now.picture * picture);
}

std::pair<int, int> RoomScene::columns_of(const std::vector<Ball>& body) const {
    const geometry::Pinhole& pinhole = camera_.pinhole;
    const geometry::RigidTransform camera_from_table = table_from_camera_.inverse();
    double left = pinhole.width;
    double right = 0.0;
    for (const Ball& one : body) {
        const glm::dvec3 at = camera_from_table.point(one.middle_m);
        const double away = std::fmax(0.05, glm::length(at) - one.radius_m);
        const double reach = 1.6 * pinhole.fx * one.radius_m / away;
        const auto pixel = pinhole.pixel(at);
        const double middle = pixel ? pixel->x : (at.x < 0.0 ? 0.0 : pinhole.width);
        left = std::fmin(left, middle - reach);
        right = std::fmax(right, middle + reach + 1.0);
    }
    return {static_cast<int>(std::fmax(0.0, left)), static_cast<int>(std::fmin(pinhole.width, right))};
}

/// Light where a body's ray hits nearer than `nearest_m`, which is updated to that distance.
void RoomScene::meet(const std::vector<Ball>& body, const LightNow& now, std::size_t ray, float& nearest_m,
                     double& light) const {
    const glm::dvec3& origin = table_from_camera_.translation;
    const glm::dvec3& direction = rays_[ray];
    const Ball* met = nullptr;
    for (const Ball& one : body) {
        const glm::dvec3 off = origin - one.middle_m;
        const double along = glm::dot(off, direction);
        if (glm::dot(off, off) - along * along > one.radius_m * one.radius_m) {
            continue;
        }
        if (const auto away = enter(one, origin, direction); away && *away < nearest_m) {
            nearest_m = static_cast<float>(*away);
            met = &one;
        }
    }
    if (met != nullptr) {
        light = people_light(*met, origin + static_cast<double>(nearest_m) * direction, now);
    }
}

void RoomScene::add_people(std::vector<double>& light, const Bodies& bodies, const Lights& lights,
                           double t_s) const {
    const geometry::Pinhole& pinhole = camera_.pinhole;
    std::vector<float> nearest_m(seen_.size());
    std::transform(seen_.begin(), seen_.end(), nearest_m.begin(),
                   [](const Seen& seen) { return seen.away_m; });
    for (int band = 0; band < bands; ++band) {
        const int top = band * pinhole.height / bands;
        const int bottom = (band + 1) * pinhole.height / bands;
        for (int k = 0; k < side * side; ++k) {
            const double moment =
                t_s + 1e-3 * (camera_.rolling_ms * band / bands +
                              camera_.exposure_ms * share_of_exposure[static_cast<std::size_t>(k)]);
            const LightNow now = lights(moment);
            for (const std::vector<Ball>& body : bodies(moment)) {
                const auto [left, right] = columns_of(body);
                for (int row = top + (top + k / side) % side; row < bottom; row += side) {
                    for (int column = left + (left + k) % side; column < right; column += side) {
                        const std::size_t ray = pixel_at(row, column);
                        meet(body, now, ray, nearest_m[ray], light[ray]);
                    }
                }
            }
        }
    }
}

std::vector<std::uint8_t> RoomScene::picture(const Bodies& bodies, const Lights& lights, double t_s,
                                             std::uint64_t seed) const {
    const LightNow now = lights(t_s);
    std::vector<glm::dvec2> feet;
    for (const std::vector<Ball>& body : bodies(t_s)) {
        feet.emplace_back(body.front().middle_m);
    }
    std::vector<double> light(seen_.size());
    for (std::size_t k = 0; k < seen_.size(); ++k) {
        const Seen& seen = seen_[k];
        double picture = now.picture;
        double lamps = now.lamps;
        if (seen.is_lit) { // parts of the picture move
            const glm::dvec3 at =
                table_from_camera_.translation + static_cast<double>(seen.away_m) * rays_[k];
            picture *= 0.7 + 0.3 * std::sin(60.0 * at.x + 45.0 * at.y + 2.0 * t_s);
        }
        if (seen.is_floor) {
            const glm::dvec2 at(table_from_camera_.translation + static_cast<double>(seen.away_m) * rays_[k]);
            for (const glm::dvec2& foot : feet) {
                lamps *= 1.0 - 0.5 * std::exp(-glm::dot(at - foot, at - foot) / (0.4 * 0.4));
            }
        }
        light[k] = lamps * seen.lamps + picture * seen.projector;
    }
    add_people(light, bodies, lights, t_s);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::vector<std::uint8_t> codes;
    codes.reserve(light.size());
    for (const double one : light) {
        const double linear = 255.0 * std::clamp(one, 0.0, 1.0);
        const double sd = std::sqrt(camera_.read_noise * camera_.read_noise + camera_.shot_noise * linear);
        const double noisy = std::clamp((linear + sd * normal(random)) / 255.0, 0.0, 1.0);
        codes.push_back(code_of_[static_cast<std::size_t>(std::lround(noisy * (codes_of_light - 1.0)))]);
    }
    return codes;
}

} // namespace frustumscreen::simulators
