/// Chooses how each object of a room is drawn: in the quickest way that is good enough from where the eye is. If the frame's
/// time does not suffice, some objects are drawn in a quicker way with a larger error.
///
/// Good     an option is enough if its error is within the tolerance. Options with less error than the quickest of these are not
///          worth their time.
/// Short    a knapsack with one choice for each object: of all steps to a quicker option, take first those that add the least
///          error, weighted by the object's pixels, for each microsecond saved.
/// Steady   hysteresis: an option that is enough stays while it costs at most a third more than the quickest; a quicker one is entered
///          at `entered_tolerance` of the tolerance, so that an eye at one place does not change it back and forth. Short of
///          time, the choices stay while they fit and waste little, or have changed within `dwell_s`.
///
/// Units    errors in pixels, as seen from the eye; microseconds; seconds.
/// Threads  values; one caller. `choose` allocates nothing after the constructor.
/// Source   Funkhouser & Sequin 1993, "Adaptive display algorithm for interactive frame rates", from the best choices down.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::scene {

/// A way to draw an object in this frame.
struct RoomOption {
    double error_px = 0.0;
    double cost_us = 0.0; ///< infinite: it cannot be drawn now
};

/// An object in the picture.
struct RoomSeen {
    std::uint32_t object = 0;
    std::uint32_t first = 0; ///< of its options
    std::uint32_t count = 0;
    double pixels = 0.0; ///< its weight
};

class RoomChoice {
public:
    static constexpr double entered_tolerance = 0.85;
    static constexpr double dwell_s = 0.5;
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    explicit RoomChoice(std::size_t objects);

    /// `seen`: each object once. `seconds` may stand still or go back.
    void choose(double seconds, std::span<const RoomSeen> seen, std::span<const RoomOption> options,
                double tolerance_px, double budget_us);

    /// The option of an object of the latest `seen`, among its own; none if all of its options cost infinitely.
    [[nodiscard]] std::uint32_t of(std::uint32_t object) const { return chosen_[object]; }
    /// The cost of all chosen levels.
    [[nodiscard]] double cost_us() const { return cost_us_; }
    /// True if the budget made some objects coarser than is good enough.
    [[nodiscard]] bool is_short() const { return short_; }

private:
    struct Step {
        double added_per_us = 0.0;
        std::uint32_t seen = 0;
        std::uint32_t to = 0;
    };
    /// The option that is enough, or the one with the least error.
    [[nodiscard]] static std::uint32_t enough(std::span<const RoomOption> own, std::uint32_t present,
                                              double tolerance_px);
    void push_step(std::span<const RoomSeen> seen, std::span<const RoomOption> options, std::uint32_t of);
    /// Takes steps until the sum keeps the budget.
    void coarsen(std::span<const RoomSeen> seen, std::span<const RoomOption> options, double budget_us);

    std::vector<std::uint32_t> chosen_;        ///< by object, also of those that were seen earlier
    std::vector<std::uint32_t> wanted_, next_; ///< by place in `seen`
    std::vector<Step> steps_;                  ///< a heap: the step that adds the least first
    double cost_us_ = 0.0;
    double changed_s_ = 0.0; ///< when the choices were last made for a budget
    bool short_ = false;
};

} // namespace frustumscreen::scene
