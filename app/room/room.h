/// The contents of the room behind the screen: objects, each an instance of a pack, placed in the table frame.
///
/// Frames   object: its pack's box, scaled: centred on the Z axis, standing on z = 0. Table T; metres.
/// Threads  values; any.
#pragma once

#include "app/geometry/transform.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen::room {

inline constexpr std::size_t max_objects = 10'000;
inline constexpr std::size_t max_packs = 256; ///< different ones

/// A steady motion, a function of the time alone.
struct Motion {
    double turns_per_minute = 0.0; ///< counter-clockwise seen from above
    glm::dvec3 sway_m{0.0};        ///< to either side of the place
    double sway_s = 10.0;          ///< there and back

    [[nodiscard]] bool moves() const { return turns_per_minute != 0.0 || sway_m != glm::dvec3(0.0); }
    [[nodiscard]] bool operator==(const Motion&) const = default;
};

struct Object {
    std::string name;                  ///< unique
    std::size_t pack = 0;              ///< index into Room::packs
    glm::dvec3 place_m{0.0, 1.5, 0.0}; ///< of the middle of its foot
    double turn_deg =
        0.0;             ///< counter-clockwise seen from above; at 0 its front looks to the table's near side
    double size_m = 0.3; ///< longest edge of its box
    Motion motion;
    std::string artifact{}; ///< id of the exhibit's artifact that it stands for; empty: its pack's

    [[nodiscard]] bool operator==(const Object&) const = default;
};

struct Room {
    std::vector<std::filesystem::path> packs; ///< each once
    std::vector<Object> objects;
};

/// `seconds`: since the exhibit's start.
[[nodiscard]] geometry::RigidTransform table_from_object(const Object& object, double seconds);

} // namespace frustumscreen::room
