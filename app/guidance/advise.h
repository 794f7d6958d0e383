/// The one move that lets a visitor see the whole artifact, and the number of moves in its sequence.
///
/// A single move is advised only if it helps however people carry it out: with its direction up to 20 degrees off and
/// its amount up to 40 per cent off, each execution leads to a situation in which the artifact is whole or less of it
/// is lost; carried out well, it leads to a whole one. Among these moves, the one with the least effort is taken,
/// counting how sure it is and how steadily it ends (steadiness.h). A single move therefore opens every face that is
/// seen and not lit, and keeps those that are lit; the paper asks for the largest face at a time. If no single move
/// does, the advice is the first move of the shortest sequence found.
///
/// Stable   an advice is kept as long as it helps and no other is clearly easier; until the visitor begins to follow
///          it, it is kept even if another one has become a little shorter.
/// Cost     some milliseconds, in rare cases tens: in a frame, use pieces.
/// Threads  pure; any. Allocates nothing.
/// Source   Kim, Shin, Kim 2008, 'Guiding the user'.
#pragma once

#include "app/guidance/advice.h"
#include "app/guidance/advice_search.h"
#include "app/guidance/face_reader.h"

#include <optional>
#include <span>
#include <utility>

namespace frustumscreen::guidance {

/// Nothing if the artifact is whole. Action::Wait: no sequence of up to four moves was found.
[[nodiscard]] std::optional<Advice> advise(const FaceReader& reader, const GuidedState& tracked_state,
                                           const std::optional<GivenAdvice>& standing = std::nullopt);

/// Advises one visitor over a sequence of situations.
class Advisor {
public:
    explicit Advisor(GuidanceSetup setup) : reader_(std::move(setup)) {}

    /// As FaceReader::show; a running search must be started again with `begin`.
    void show(std::span<const glm::dvec3> hull) { reader_.show(hull); }
    [[nodiscard]] std::optional<Advice> advise(const GuidedState& tracked_state);

    /// As `advise`, in pieces (advice_search.h): call `begin`, then `advance` until it returns true.
    void begin(const GuidedState& tracked_state);
    [[nodiscard]] bool advance(int looks);
    [[nodiscard]] const std::optional<Advice>& found() const { return search_.found(); }
    [[nodiscard]] const FaceReader& reader() const { return reader_; }

private:
    FaceReader reader_;
    std::optional<GivenAdvice> standing_;
    AdviceSearch search_;
};

} // namespace frustumscreen::guidance
