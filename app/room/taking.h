/// Artifacts of the room that are taken into the prop and put back. An object that is taken leaves its place, glides to the
/// prop, takes on the size that its artifact has there, and hands its light over: the artifact in the prop brightens as the
/// object on the screen fades. Put back, it does the same in reverse.
///
///     Exhibit's choice, prop's pose -> step -> poses() for the screen, prop_share() for the prop
///
/// Way      one spring for each object, critically damped, from 0 (in its place) to 1 (in the prop). Up to `hands_over` it
///          moves, from there on it stands still in the prop's frame and hands over. It begins to return when the hand-over is
///          undone. The spring is solved from its last event (world/spring.h), so the steps between do not matter, and a
///          change on the way turns it around without a jump of place or speed; it never leaves 0..1.
/// Light    an object's share of the screen's pixels and its artifact's light in the prop add up to 1 at any time.
/// Lean     an object that the prop rests before rises a little and grows, so that the visitor sees that it is meant.
/// Frames   table T; metres; object as room.h.
/// Time     `now` never goes back.
/// Threads  values; one caller. `step` allocates nothing.
/// Errors   none: artifacts without an object are in the prop alone.
#pragma once

#include "app/geometry/transform.h"
#include "app/room/moving_pose.h"
#include "app/room/room.h"
#include "app/world/spring.h"
#include "firmware_host/base/time.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::room {

/// An object that is not in its place, or leans, as the screen shows it.
struct TakenPose {
    std::size_t object = 0; ///< index into Room::objects
    geometry::RigidTransform table_from_object;
    double size_m = 0.3;  ///< longest edge of its box
    double opacity = 1.0; ///< share of its pixels that show it, 0..1; 0: it is not drawn
};

/// Where the screen shows object `index`: `taken` if it is among them, in the order of the objects, else its own place.
[[nodiscard]] TakenPose pose_of(std::size_t index, const Object& object, double seconds,
                                std::span<const TakenPose> taken);

/// The artifact that an object stands for.
struct TakeableObject {
    std::size_t object = 0;   ///< index into Room::objects
    std::size_t artifact = 0; ///< as the exhibit numbers them
    double size_m = 0.1;      ///< longest edge of its box in the prop
};

struct TakingInput {
    MonotonicTime now;
    std::optional<std::size_t> chosen; ///< the artifact that belongs into the prop; none: all are put back
    std::size_t shown = 0;             ///< the artifact that the prop shows, or is about to
    double shown_light = 0.0;          ///< of that artifact without a room: 0..1, a factor on linear light
    geometry::RigidTransform table_from_prop;
    bool idle = false;                 ///< the pose is not the prop's own (exhibit::DrawnPose::attracts)
    std::optional<std::size_t> before; ///< the object that the prop rests before, index into Room::objects
};

class Taking {
public:
    static constexpr double rate_per_s = 5.5;   ///< of the spring: nine tenths of the light after a second
    static constexpr double hands_over = 0.85;  ///< of the spring's way
    static constexpr double lean_per_s = 6.0;   ///< rate of the spring of the lean
    static constexpr double lean_size = 0.06;   ///< it grows by this share
    static constexpr double lean_height = 0.08; ///< and rises by this share of its size

    Taking() = default;
    /// `start`: the time at which the objects began to move.
    Taking(std::vector<Object> objects, MonotonicTime start);

    /// Says which objects can be taken, in the order of the objects; those on their way go on. Allocates.
    void set_takeable(std::span<const TakeableObject> takeable);
    void step(const TakingInput& input);

    /// As of the latest step, in the order of the objects; valid until the next one.
    [[nodiscard]] std::span<const TakenPose> poses() const { return poses_; }
    /// The factor of the shown artifact's light: 0 while it is on the screen, 1 in the prop, and for artifacts that no object
    /// stands for.
    [[nodiscard]] double prop_share() const { return prop_share_; }
    /// True if, as of the latest step, something is on its way.
    [[nodiscard]] bool moves() const { return moves_; }
    /// Since the objects began to move.
    [[nodiscard]] double seconds(MonotonicTime now) const { return to_seconds(now - start_); }
    [[nodiscard]] std::span<const Object> objects() const { return objects_; }

private:
    /// A value that follows 0 or 1 on a critically damped spring.
    struct Follower {
        MonotonicTime event;
        world::Motion from_goal{}; ///< at the event
        double goal = 0.0;

        [[nodiscard]] double at(MonotonicTime now, double rate_per_s) const;
        void turn_to(double new_goal, MonotonicTime now, double rate_per_s);
        [[nodiscard]] bool moves(MonotonicTime now, double rate_per_s) const;
    };
    struct Body {
        TakeableObject as;
        bool takeable = true; ///< false: it only returns
        Follower way, lean;
        double anchor_s = 0.0; ///< its turn at this time is where its way begins
        glm::dquat goal{1.0, 0.0, 0.0,
                        0.0}; ///< the prop's rotation, of the sign that continues the last step's
    };

    [[nodiscard]] std::optional<std::size_t> body_for(const TakingInput& input) const;
    [[nodiscard]] bool belongs_in_prop(const Body& body, std::size_t index, const TakingInput& input) const;
    void anchor(Body& body, MonotonicTime now) const;
    void put(Body& body, const TakingInput& input, double lit);

    std::vector<Object> objects_;
    MonotonicTime start_;
    std::vector<Body> bodies_;
    std::optional<std::size_t> chosen_; ///< index into `bodies_`: for the artifact that belongs into the prop
    MovingPose table_from_prop_;
    std::vector<TakenPose> poses_;
    double prop_share_ = 1.0;
    bool moves_ = false;
};

} // namespace frustumscreen::room
