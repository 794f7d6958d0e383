/// The scene that `frustumscreen-bench room` measures: a hall behind the screen with a floor, three walls, plinths, and
/// artifacts on the floor and on the plinths, some of which turn or sway; and the walks of an eye before the screen.
///
/// Frames   table T, metres; the hall's floor is at z = 0.
/// Threads  pure; any. The same numbers and seed give the same scene and walks on every machine.
/// Errors   none.
#pragma once

#include "app/bench/room/room_pieces.h"
#include "app/room/room.h"
#include "app/settings/settings.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::bench {

/// A pack and the mesh that it was baked from.
struct RoomSource {
    std::string name;
    PieceUse use = PieceUse::Artifact;
    std::shared_ptr<const bake::SourceMesh> mesh;
    std::filesystem::path pack;
};

/// At least a floor, three walls, a plinth and an artifact.
inline constexpr int min_room_objects = 6;

/// `room.packs` are those of `sources`, in this order; `objects`: floor, walls and plinths included.
[[nodiscard]] room::Room make_room(std::span<const RoomSource> sources, int objects, std::uint64_t seed);

/// As room_file.h reads it; packs by their names alone, for a file beside them.
[[nodiscard]] std::string room_toml(const room::Room& room);

struct RoomFrame {
    double seconds = 0.0; ///< since the objects began to move
    glm::dvec3 eye_m{0.0};
};
struct RoomWalk {
    std::string name;
    std::vector<RoomFrame> frames;
};
/// Frames of a walk: the least rate that the paper keeps, so that a short walk goes as far as possible.
inline constexpr double room_walk_hz = 10.0;

/// paper     Kim 2008, Fig. 9: a user who moves through the scene. The screen stands still, so here the user goes along it
///           and comes as near as a hand.
/// visitor   stands before the table, and the head is never quite still.
/// bends     comes near, and bends aside and down to look past what is in front.
/// The eye moves in every frame.
[[nodiscard]] std::vector<RoomWalk> room_walks(const settings::ScreenSettings& screen, int frames);

} // namespace frustumscreen::bench
