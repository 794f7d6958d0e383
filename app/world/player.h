/// Plays behaviours: several at once, each interruptible from where it is, and back to rest.
///
/// Several  a cell's part (translation, rotation, scale, light) that two behaviours move has the value of the one that
///          was started last; springs and pendulums add up. A cell's light is its own times its parent's.
/// Ends     an interrupted or ended behaviour returns to rest from where it is, within `return_s`, without a jump of
///          the pose; a spring and a pendulum go on by their own law, with their velocity.
/// Begins   a part at rest has a curve's value at once, so the first key may jump as its author wants it to; a part
///          that is elsewhere comes from there within `return_s`.
/// Repeats  a repeating pendulum is pushed in each round; a spring is pulled as long as its behaviour is on.
/// Time     `now` is a parameter and never goes back. A pose depends on the times of starts and ends, and on no step
///          between them.
/// Threads  one caller. Nothing after the constructor allocates.
#pragma once

#include "app/world/behaviour.h"
#include "app/world/cell.h"
#include "app/world/cell_spring.h"
#include "app/world/moving_part.h"
#include "firmware_host/base/time.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::world {

/// The poses `seconds` after the behaviour's start, with everything else at rest. For pictures of a given time.
[[nodiscard]] std::vector<CellPose> poses_at(std::span<const Cell> cells, const Behaviour& behaviour,
                                             double seconds);

class Player {
public:
    Player(std::vector<Cell> cells, std::vector<Behaviour> behaviours);
    Player(Player&&) = default;
    Player& operator=(Player&&) = default;
    ~Player() = default;

    /// Starts the behaviour; if it is on, ends it: it returns to rest.
    void trigger(std::size_t behaviour, MonotonicTime now);
    void start(std::size_t behaviour, MonotonicTime now);
    void end(std::size_t behaviour, MonotonicTime now);
    /// Everything returns to rest.
    void end_all(MonotonicTime now);

    /// True if the behaviour is on: started and neither ended nor over.
    [[nodiscard]] bool is_on(std::size_t behaviour) const;
    /// True if at the last step some cell was not at rest; a swing of 1e-4 of the cell's size is none.
    [[nodiscard]] bool moves() const { return moves_; }
    /// The poses at `now`; valid until the next call.
    [[nodiscard]] std::span<const CellPose> step(MonotonicTime now);

    [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
    [[nodiscard]] const std::vector<Behaviour>& behaviours() const { return behaviours_; }

private:
    struct Run {
        bool on = false;
        MonotonicTime began;
        std::uint64_t turn = 0; ///< number of this start, counted over the starts of all behaviours
    };
    struct Link {
        std::size_t behaviour = 0;
        const Channel* channel = nullptr;
    };
    struct Part {
        MovingPart motion;
        std::vector<Link> movers; ///< the behaviours that have a channel for it
    };
    struct Swinging {
        CellSpring motion;
        std::size_t behaviour = 0;
        std::int64_t rounds = 0; ///< of the repeating behaviour, for which it was pushed
    };

    void make_parts();
    void make_springs();
    /// Everything that happens by itself until `now`: runs that are over, and pushes.
    void advance(MonotonicTime now);
    void push(Swinging& swinging, MonotonicTime now) const;
    void finish(std::size_t behaviour, MonotonicTime now);
    [[nodiscard]] std::optional<Driver> newest(const Part& part) const;
    [[nodiscard]] bool at_rest(MonotonicTime now) const;

    std::vector<Cell> cells_;
    std::vector<Behaviour> behaviours_;
    std::vector<Run> runs_; ///< one for each behaviour
    std::uint64_t starts_ = 0;
    std::vector<Part> parts_;
    std::vector<Swinging> springs_;
    std::vector<LocalPose> local_; ///< of the step, as are the next two
    std::vector<glm::dmat4> base_from_cell_;
    std::vector<CellPose> poses_;
    bool moves_ = false;
};

} // namespace frustumscreen::world
