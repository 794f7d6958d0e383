#include "tests/simulators/visitor/visitor_run.h"

#include "app/tracking/live_tracked_state.h"
#include "app/visitor/visitor_reader.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::simulators {

namespace {

const glm::dvec2 table_size_m(0.8, 0.5);
const glm::dvec3 default_eye_m(0.0, -0.55, 0.5);
constexpr double comes_s = 2.0;
constexpr double arrives_s = 3.0;
constexpr double walks_in_m_s = 1.2;
constexpr double settles_s = 1.0;    ///< after this time a standing person is measured
constexpr double lit_after_s = 0.05; ///< camera, processor, display

/// A person whose eye is in the room at some times; nullopt: not in the room.
struct Somebody {
    Person person;
    glm::dvec3 stands_m{0.0};
    double walks_m_s = 0.0;
    bool comes = true; ///< comes to the table; otherwise walks by along the wall behind
    [[nodiscard]] std::optional<glm::dvec3> eye(double t_s) const {
        if (!comes) {
            const double x = std::remainder(0.9 * t_s + person.phase, 6.0);
            return std::abs(x) < 2.6 ? std::optional(glm::dvec3(x, -2.6, stands_m.z)) : std::nullopt;
        }
        if (t_s < comes_s) {
            return std::nullopt;
        }
        const glm::dvec2 out = glm::normalize(glm::dvec2(stands_m));
        const glm::dvec3 before = walks_in_m_s * std::fmax(0.0, arrives_s - t_s) * glm::dvec3(out, 0.0);
        constexpr double half_way_m = 0.3;
        const double gone = walks_m_s * std::fmax(0.0, t_s - arrives_s) / half_way_m;
        const double along = walks_m_s > 0.0 ? half_way_m * std::sin(gone) : 0.0;
        return stands_m + before + glm::dvec3(along * glm::dvec2(-out.y, out.x), 0.0) + sway(person, t_s);
    }
};

std::vector<Somebody> anybody(const VisitorCase& of, bool comes, std::mt19937_64& random) {
    std::vector<Somebody> people;
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    const double azimuth = glm::radians(of.farthest_azimuth_deg) * share(random);
    for (int k = 0; k < (comes ? of.people : 0); ++k) {
        Somebody one{any_person(of.build, random), {}, of.walks_m_s, true};
        one.person.hair = of.hair.value_or(one.person.hair);
        one.person.holds = k == 0;
        constexpr double apart = 0.75; // radians: a person's breadth at the table's edge
        const double turned = azimuth + apart * (k % 2 == 1 ? 1 : -1) * (k + 1) / 2;
        const double outside = 0.12 + 0.06 * share(random) + (k == 0 ? 0.0 : 0.25);
        one.stands_m = any_eye(of.build, k == 0 ? azimuth : turned, outside, table_size_m, random);
        people.push_back(one);
    }
    for (int k = 0; k < of.passers_by; ++k) {
        Somebody one{any_person(Build::Adult, random), {0.0, -2.6, 0.72}, 0.0, false};
        one.person.holds = false;
        people.push_back(one);
    }
    return people;
}

Lights lights_of(const VisitorCase& of, std::mt19937_64& random) {
    const double phase = std::uniform_real_distribution<double>(0.0, 100.0)(random);
    return [of, phase](double t_s) {
        LightNow now;
        now.lamps = 1.0 + of.lamps_drift * std::sin(0.6 * t_s + phase);
        now.lamps *= of.lamps_switched && t_s > 1.4 ? 0.67 : 1.0;
        // A different artifact every four seconds, with a fade; and movement in it.
        const auto level = [phase](double number) { return 0.5 + 0.45 * std::sin(12.9898 * number + phase); };
        const double place = (t_s + phase) / 4.0;
        const double fade = std::clamp(8.0 * (place - std::floor(place)), 0.0, 1.0);
        const double shown = glm::mix(level(std::floor(place) - 1.0), level(std::floor(place)), fade);
        now.picture = of.picture_changes > 0.0 ? shown * (0.9 + 0.1 * std::sin(7.0 * t_s)) : 0.5;
        return now;
    };
}

/// A coat on a chair resembles a body with a head: a round top on shoulders.
std::vector<Ball> coat() {
    const glm::dmat3 upright(1.0);
    return {ball({0.35, -0.62, 0.28}, upright, {0.09, 0.10, 0.12}, 0.08),
            ball({0.35, -0.62, 0.02}, upright, {0.22, 0.12, 0.2}, 0.08)};
}

struct Room {
    Visit visit;
    VisitorCase of;
    std::vector<Somebody> people;
    Lights lights;
    RoomScene scene;
    visitor::VisitorReader reader;
    tracking::LiveTrackedState live;
};

WatchingCamera believed(const VisitorCase& of) {
    WatchingCamera camera = of.camera;
    const double away = glm::distance(camera.aim_m, camera.place_m);
    camera.aim_m += away * std::tan(glm::radians(of.camera_off_deg)) * glm::normalize(glm::dvec3(1, 0, 1));
    return camera;
}

Room room_of(const VisitorCase& of, bool comes, std::mt19937_64& random) {
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    const glm::dvec3 prop(0.15 * share(random), 0.06 * share(random), 0.0);
    std::vector<Somebody> people = anybody(of, comes, random);
    Lights lights = lights_of(of, random);
    visitor::HeadZone zone;
    zone.table_size_m = table_size_m;
    return {
        {prop, {}},
        of,
        std::move(people),
        std::move(lights),
        RoomScene(of.camera, of.light, table_size_m, geometry::make_frustum(geometry::shipped_frustum), prop),
        visitor::VisitorReader({of.camera.pinhole, believed(of).table_from_camera(), zone},
                               camera::thread_seconds),
        tracking::LiveTrackedState(default_eye_m, 0.5 * geometry::shipped_frustum.height_m)};
}

MonotonicTime time_of(double t_s) {
    return MonotonicTime(std::chrono::seconds(1) + Nanoseconds(std::llround(1e9 * t_s)));
}

void step(Room& room, double t_s, std::uint64_t seed) {
    const glm::dvec3 looked_at =
        room.visit.prop_m + glm::dvec3(0.0, 0.0, 0.5 * geometry::shipped_frustum.height_m);
    const auto bodies = [&](double moment_s) {
        std::vector<std::vector<Ball>> all;
        for (const Somebody& one : room.people) {
            if (const auto eye = one.eye(moment_s)) {
                all.push_back(body_of(one.person, *eye, looked_at));
            }
        }
        if (room.of.coat_s >= 0.0 && moment_s >= room.of.coat_s) {
            all.push_back(coat());
        }
        return all;
    };
    const geometry::Pinhole& pinhole = room.of.camera.pinhole;
    const camera::CameraFrame frame{time_of(t_s), 1, pinhole.width, pinhole.height,
                                    room.scene.picture(bodies, room.lights, t_s, seed)};
    const double begin = camera::thread_seconds();
    const std::span<const tracking::SeenHead> heads = room.reader.read(frame);
    VisitMoment moment;
    moment.ms = 1e3 * (camera::thread_seconds() - begin);
    tracker::PoseSample prop;
    prop.time = frame.time;
    prop.station = tracker::prop_station;
    prop.position_m = room.visit.prop_m;
    prop.rotation = {1.0, 0.0, 0.0, 0.0};
    prop.ok = true;
    static_cast<void>(room.live.take(prop));
    for (const tracking::SeenHead& head : heads) {
        static_cast<void>(room.live.take_visitor(head));
    }
    const double lit_s = t_s + lit_after_s;
    const tracking::TrackedState tracked_state = room.live.at(time_of(lit_s));
    moment.t_s = lit_s;
    moment.seen = tracked_state.head_seen;
    moment.shown_eye_m = tracked_state.eye_m;
    moment.said_sd_m = tracked_state.eye_sd_m;
    if (!room.people.empty() && room.people.front().comes) {
        const auto eye = room.people.front().eye(lit_s);
        moment.eye_m = eye.value_or(default_eye_m);
        moment.is_there = eye && lit_s >= arrives_s + settles_s;
        moment.was_there = eye.has_value();
        moment.stands = moment.is_there;
    }
    room.visit.moments.push_back(moment);
}

Visit run(const VisitorCase& of, bool comes, double length_s, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Room room = room_of(of, comes, random);
    const auto frames = static_cast<int>(std::lround(length_s * visit_rate_hz));
    for (int k = 0; k < frames; ++k) {
        step(room, k / visit_rate_hz, random());
    }
    return std::move(room.visit);
}

} // namespace

Visit run_visit(const VisitorCase& of, double length_s, std::uint64_t seed) {
    return run(of, true, length_s, seed);
}

Visit run_empty(const VisitorCase& of, double length_s, std::uint64_t seed) {
    return run(of, false, length_s, seed);
}

namespace {

/// Where the ray from an eye to a point meets the plane of a face.
glm::dvec3 on_face(const geometry::Plane& plane, const glm::dvec3& eye, const glm::dvec3& point) {
    const glm::dvec3 along = point - eye;
    return eye - along * (plane.distance(eye) / glm::dot(plane.normal, along));
}

} // namespace

std::vector<double> picture_errors_mm(const glm::dvec3& prop_m, const glm::dvec3& eye_m,
                                      const glm::dvec3& shown_eye_m) {
    static const geometry::PropShape prop = geometry::make_frustum(geometry::shipped_frustum);
    const glm::dvec3 half(0.045, 0.045, 0.07);
    const glm::dvec3 middle(0.0, 0.0, 0.0725);
    const glm::dvec3 eye = eye_m - prop_m;
    std::vector<double> errors;
    constexpr int rings = 8;
    constexpr int around = 16;
    for (int ring = 0; ring < rings; ++ring) {
        for (int k = 0; k < around; ++k) { // equal areas on a sphere
            const double z = 2.0 * (ring + 0.5) / rings - 1.0;
            const double turn = 2.0 * std::numbers::pi * k / around;
            const double flat = std::sqrt(1.0 - z * z);
            const glm::dvec3 unit(flat * std::cos(turn), flat * std::sin(turn), z);
            const glm::dvec3 point = middle + half * unit;
            geometry::PropHit hit;
            if (glm::dot(unit / half, eye - point) > 0.0 && geometry::enter(prop, eye, point - eye, hit)) {
                const geometry::Plane& face = prop.bounds[static_cast<std::size_t>(hit.face)];
                errors.push_back(1e3 * glm::distance(on_face(face, eye, point),
                                                     on_face(face, shown_eye_m - prop_m, point)));
            }
        }
    }
    return errors;
}

glm::dvec3 shown_middle_m(const glm::dvec3& prop_m, const glm::dvec3& eye_m, const glm::dvec3& shown_eye_m) {
    static const geometry::PropShape prop = geometry::make_frustum(geometry::shipped_frustum);
    const glm::dvec3 middle(0.0, 0.0, 0.0725);
    const glm::dvec3 eye = eye_m - prop_m;
    geometry::PropHit hit;
    if (!geometry::enter(prop, eye, middle - eye, hit)) {
        return middle;
    }
    return on_face(prop.bounds[static_cast<std::size_t>(hit.face)], shown_eye_m - prop_m, middle);
}

} // namespace frustumscreen::simulators
