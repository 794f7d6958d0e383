/// Which objects of a room the eyes can see in a frame, and from how far away.
///
/// Frames   table T; metres.
/// Threads  values; one caller. `look` allocates nothing after the constructor.
/// Errors   none.
#pragma once

#include "app/room/room.h"
#include "app/room/taking.h"
#include "app/scene/room_culling.h"
#include "app/scene/stereo.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::show {

/// An object as it stands in the latest frame.
struct PlacedObject {
    glm::dmat4 table_from_object{1.0};
    double size_m = 0.0;  ///< longest edge of its box
    double opacity = 1.0; ///< share of its pixels that show it
    bool in_place = true; ///< not taken, nor on its way
    glm::dvec3 middle_m{0.0};
    double radius_m = 0.0;      ///< of a ball around its box
    double silhouette_m2 = 0.0; ///< of its box, the mean over all directions
    double away_m = 0.0;        ///< at least, from the nearest eye
    bool is_in_view = false;    ///< part of it is in some eye's frustum
    bool is_seen = false;       ///< in view and not certainly hidden
};

class RoomView {
public:
    /// The room must outlive this. `box_sizes`: of each pack, its longest edge 1.
    RoomView(const room::Room& room, const scene::FlatScreen& screen, std::span<const glm::dvec3> box_sizes);

    /// `solid_of`: of an object that is drawn, in the units of its box; null if none is known. `culls`: false: everything counts as seen.
    using SolidOf = std::function<const std::optional<scene::BoxCorners>*(std::uint32_t object)>;
    /// `taken`: the objects that are not in their places.
    void look(double seconds, std::span<const glm::dvec3> eyes_m, std::span<const room::TakenPose> taken,
              const SolidOf& solid_of, bool culls = true);

    [[nodiscard]] const std::vector<PlacedObject>& objects() const { return objects_; }
    /// The objects that are seen, in the order of the room.
    [[nodiscard]] const std::vector<std::uint32_t>& seen() const { return seen_; }

private:
    static constexpr std::size_t max_solids = 64;
    /// A solid that may hide other objects.
    struct Solid {
        double size_rad = 0.0;
        scene::BoxCorners corners{};
    };
    void place(std::size_t object, double seconds, std::span<const room::TakenPose> taken);
    void look_with(const glm::dvec3& eye_m, const SolidOf& solid_of);
    [[nodiscard]] scene::BoxCorners corners_of(std::size_t object, const geometry::Box& box) const;

    const room::Room& room_;
    std::vector<glm::dvec3> box_sizes_;
    scene::RoomCulling culling_;
    std::vector<PlacedObject> objects_;
    std::vector<std::uint32_t> seen_, in_view_;
    std::vector<Solid> solids_;
    bool placed_ = false;
};

} // namespace frustumscreen::show
