/// Searches for an advice in pieces, so that no frame waits for it: each piece examines about as many situations as
/// allowed.
///
/// Single moves come first, in order of effort; then sequences, the shortest first. The result does not depend on the
/// pieces.
///
/// Cost     about 1 us for a situation; a single move needs hundreds, a sequence tens of thousands.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/guidance/advice.h"
#include "app/guidance/candidates.h"
#include "app/guidance/face_reader.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace frustumscreen::guidance {

class AdviceSearch {
public:
    static constexpr int unlimited = std::numeric_limits<int>::max();

    /// `standing`: the advice that the visitor already has.
    void begin(const FaceReader& reader, const GuidedState& tracked_state,
               const std::optional<GivenAdvice>& standing);
    /// Examines about `looks` more situations. True: the search is over.
    [[nodiscard]] bool advance(const FaceReader& reader, int looks);
    /// The situation of the latest `begin`.
    [[nodiscard]] const GuidedState& tracked_state() const { return tracked_state_; }
    /// The result, once the search is over: as `advise`.
    [[nodiscard]] const std::optional<Advice>& found() const { return found_; }

private:
    static constexpr double never = std::numeric_limits<double>::infinity();
    enum class Stage : std::uint8_t { Begun, Steadiness, SingleMoves, Sequences };
    struct Best {
        Move move;
        double cost = never;
        [[nodiscard]] bool any() const { return cost < never; }
    };
    /// A search for sequences of one length.
    struct Try {
        GuidedState from;
        std::optional<Move> settled_by = {}; ///< the move before the try; it is then the advice
        std::optional<Move> like = {};       ///< the try's first move must be alike
        int steps_before = 0;
        int depth = 1;
        MoveSet last = MoveSet::Only;
    };
    void collect_single_moves(const FaceReader& reader);
    void weigh_single_move(const FaceReader& reader);
    void try_single_move(const FaceReader& reader);
    void plan_sequences(const FaceReader& reader);
    void plan_up_to_two(Try from);
    void plan_after_settling(const FaceReader& reader);
    void begin_try(const FaceReader& reader);
    void go_on_with_try(const FaceReader& reader);
    [[nodiscard]] double cost_of_end(const FaceReader& reader, const GuidedState& end);
    [[nodiscard]] double min_effort(const FaceReader& reader, const GuidedState& from, MoveSet set);
    void end(const Move& move, int steps);

    GuidedState tracked_state_;
    std::optional<GivenAdvice> standing_;
    std::optional<Advice> found_;
    bool over_ = true;
    int looks_left_ = 0;
    Stage stage_ = Stage::Begun;
    Candidates candidates_; ///< single moves, or the first moves of the try
    std::size_t next_ = 0;  ///< index into `candidates_`
    Best best_;
    std::array<Try, 24> tries_{};
    std::size_t try_count_ = 0;
    std::size_t try_ = 0;
};

} // namespace frustumscreen::guidance
