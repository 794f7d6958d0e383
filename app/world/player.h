/// Plays behaviours: several at once, each interruptible from where it is, and back to rest.
///
/// Several  a cell's part (translation, rotation, scale, light) that two behaviours move has the value of the one that
///          was started last; springs and pendulums add up.
/// Ends     an interrupted or ended behaviour returns to rest from where it is, within `return_s`, without a jump of
///          the pose; a spring and a pendulum go on by their own law, with their velocity.
/// Time     `now` is a parameter and never goes back.
/// Threads  values; one caller. Nothing after the constructor allocates.
#pragma once

#include "app/world/behaviour.h"
#include "app/world/cell.h"
#include "firmware_host/base/time.h"

#include <cstddef>
#include <span>
#include <vector>

namespace frustumscreen::world {

inline constexpr double return_s = 0.6;

/// The poses `seconds` after the behaviour's start, with everything else at rest. For pictures of a given time.
[[nodiscard]] std::vector<CellPose> poses_at(std::span<const Cell> cells, const Behaviour& behaviour,
                                             double seconds);

class Player {
public:
    Player(std::vector<Cell> cells, std::vector<Behaviour> behaviours);

    /// Starts the behaviour; if it is on, ends it: it returns to rest.
    void trigger(std::size_t behaviour, MonotonicTime now);
    void start(std::size_t behaviour, MonotonicTime now);
    void end(std::size_t behaviour, MonotonicTime now);
    /// Everything returns to rest.
    void end_all(MonotonicTime now);

    /// True if the behaviour is on: started and neither ended nor over.
    [[nodiscard]] bool is_on(std::size_t behaviour) const;
    /// True if some cell is not at rest.
    [[nodiscard]] bool moves() const { return moves_; }
    /// The poses at `now`; valid until the next call.
    [[nodiscard]] std::span<const CellPose> step(MonotonicTime now);

    [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
    [[nodiscard]] const std::vector<Behaviour>& behaviours() const { return behaviours_; }

private:
    std::vector<Cell> cells_;
    std::vector<Behaviour> behaviours_;
    bool moves_ = false;
};

} // namespace frustumscreen::world
