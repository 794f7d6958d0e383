#include "app/bench/room/room_scene.h"

#include "app/bench/truth/seeded_draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace frustumscreen::bench {

namespace {

constexpr double hall_m = 6.4;  ///< its width and depth
constexpr double near_m = 0.85; ///< y of its front edge: a little behind the screen as shipped

std::vector<std::size_t> used_as(std::span<const RoomSource> sources, PieceUse use) {
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < sources.size(); ++k) {
        if (sources[k].use == use) {
            found.push_back(k);
        }
    }
    return found;
}

/// Floor and walls around the hall.
void add_shell(std::span<const RoomSource> sources, room::Room& room) {
    const double middle_y = near_m + 0.5 * hall_m;
    const std::size_t floor = used_as(sources, PieceUse::Floor).front();
    const std::size_t wall = used_as(sources, PieceUse::Wall).front();
    const auto add = [&](std::string name, std::size_t pack, const glm::dvec3& place_m, double turn_deg) {
        room.objects.push_back({.name = std::move(name),
                                .pack = pack,
                                .place_m = place_m,
                                .turn_deg = turn_deg,
                                .size_m = hall_m,
                                .motion = {}});
    };
    add("floor", floor, {0.0, middle_y, -0.04}, 0.0); // its upper side is at 0
    add("back wall", wall, {0.0, near_m + hall_m, 0.0}, 0.0);
    add("left wall", wall, {-0.5 * hall_m, middle_y, 0.0}, 90.0);
    add("right wall", wall, {0.5 * hall_m, middle_y, 0.0}, -90.0);
}

/// Every fifth one turns, every seventh one sways, some do both.
room::Motion motion_of(int number, SeededDraw& draw) {
    room::Motion motion;
    if (number % 5 == 2) {
        motion.turns_per_minute = draw.between(2.0, 8.0);
    }
    if (number % 7 == 3) {
        motion.sway_m = {draw.between(0.04, 0.12), draw.between(-0.05, 0.05), 0.0};
        motion.sway_s = draw.between(4.0, 10.0);
    }
    return motion;
}

} // namespace

room::Room make_room(std::span<const RoomSource> sources, int objects, std::uint64_t seed) {
    constexpr int shell = 4;
    room::Room room;
    for (const RoomSource& source : sources) {
        room.packs.push_back(source.pack);
    }
    add_shell(sources, room);
    const std::vector<std::size_t> artifacts = used_as(sources, PieceUse::Artifact);
    const std::size_t plinth = used_as(sources, PieceUse::Plinth).front();
    const int plinths = std::max(1, objects / 5);
    const int places = objects - shell - plinths;
    const int columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(places))));
    const int rows = (places + columns - 1) / columns;
    const double across_m = (hall_m - 0.4) / columns;
    const double along_m = (hall_m - 0.4) / rows;
    SeededDraw draw(seed);
    int standing = 0; // on plinths
    for (int k = 0; k < places; ++k) {
        const int column = k % columns;
        const int row = k / columns;
        const glm::dvec3 jitter_m(0.2 * across_m * draw.between(-1.0, 1.0),
                                  0.2 * along_m * draw.between(-1.0, 1.0), 0.0);
        glm::dvec3 place_m = glm::dvec3((column + 0.5) * across_m - 0.5 * (hall_m - 0.4),
                                        near_m + 0.1 + (row + 0.5) * along_m, 0.0) +
                             jitter_m;
        const bool raised = standing < plinths && (k + 1) * plinths >= (standing + 1) * places;
        const double max_m = std::clamp(0.8 * std::min(across_m, along_m), 0.1, 0.45);
        if (raised) {
            const double high_m = std::min(max_m, draw.between(0.22, 0.36));
            room.objects.push_back({.name = fmt::format("plinth {}", ++standing),
                                    .pack = plinth,
                                    .place_m = place_m,
                                    .turn_deg = draw.between(-12.0, 12.0),
                                    .size_m = high_m,
                                    .motion = {}});
            place_m.z = high_m;
        }
        const std::size_t artifact = artifacts[static_cast<std::size_t>(
            draw.between(0.0, static_cast<double>(artifacts.size()) - 1e-9))];
        room::Object object{.name = fmt::format("{} {}", sources[artifact].name, k + 1),
                            .pack = artifact,
                            .place_m = place_m,
                            .turn_deg = draw.between(-180.0, 180.0),
                            .size_m = max_m * draw.between(0.5, raised ? 0.75 : 1.0),
                            .motion = motion_of(k, draw)};
        if (raised) {
            object.motion.sway_m = glm::dvec3(0.0); // it would leave its plinth
        }
        room.objects.push_back(std::move(object));
    }
    return room;
}

std::string room_toml(const room::Room& room) {
    std::string text = "# Made by frustumscreen-bench room. Frame: the table's; metres, degrees.\n";
    for (const room::Object& object : room.objects) {
        text += fmt::format("\n[[object]]\nname = \"{}\"\npack = \"{}\"\nplace_m = [{}, {}, {}]\nturn_deg = "
                            "{}\nsize_m = {}\n",
                            object.name, room.packs[object.pack].filename().string(), object.place_m.x,
                            object.place_m.y, object.place_m.z, object.turn_deg, object.size_m);
        const room::Motion& motion = object.motion;
        if (motion.moves()) {
            text += fmt::format("turns_per_minute = {}\nsway_m = [{}, {}, {}]\nsway_s = {}\n",
                                motion.turns_per_minute, motion.sway_m.x, motion.sway_m.y, motion.sway_m.z,
                                motion.sway_s);
        }
    }
    return text;
}

namespace {

double wave(double seconds, double period_s, double phase = 0.0) {
    return std::sin(2.0 * std::numbers::pi * (seconds / period_s + phase));
}

} // namespace

std::vector<RoomWalk> room_walks(const settings::ScreenSettings& screen, int frames) {
    // Relative to the screen's middle: x to the right, y towards the people before it, z up.
    const glm::dvec3 middle_m = 0.5 * (screen.corners_m[0] + screen.corners_m[2]);
    const double wide_m = glm::distance(screen.corners_m[0], screen.corners_m[1]);
    const auto along = [&](std::string name, const std::function<glm::dvec3(double seconds)>& away_m) {
        RoomWalk walk{std::move(name), {}};
        for (int frame = 0; frame < frames; ++frame) {
            const double seconds = frame / room_walk_hz;
            const glm::dvec3 away = away_m(seconds);
            walk.frames.push_back({seconds, {middle_m.x + away.x, middle_m.y - away.y, middle_m.z + away.z}});
        }
        return walk;
    };
    return {along("paper",
                  [&](double s) {
                      return glm::dvec3(0.75 * wide_m * wave(s, 8.0), 1.25 - 0.85 * wave(s, 6.0, -0.25),
                                        0.10 * wave(s, 5.0));
                  }),
            along("visitor",
                  [](double s) {
                      return glm::dvec3(0.25 * wave(s, 6.0) + 0.03 * wave(s, 1.7), 1.25 + 0.10 * wave(s, 4.3),
                                        0.05 + 0.04 * wave(s, 3.1));
                  }),
            along("bends", [&](double s) {
                const double near = 0.5 - 0.5 * wave(s, 6.0, 0.25); // 0 at first, 1 when the visitor is near
                return glm::dvec3(0.55 * wide_m * near * wave(s, 3.5), 2.2 - 1.75 * near,
                                  0.08 - 0.25 * near * near + 0.01 * wave(s, 1.3));
            })};
}

} // namespace frustumscreen::bench
