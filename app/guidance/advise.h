/// The one move that lets a visitor see the whole artifact, and how many moves it is the first of.
///
/// A single move is advised only if it helps however people carry it out: with its direction up to 20 degrees off, its
/// amount up to 40 per cent off, each execution leads to a situation in which the artifact is whole, or less of it lost; done well, it
/// leads to a whole one. Among those it is the one with the least effort, for as much as it is sure and ends steadily (steadiness.h). So it opens every face that is seen and not
/// lit, and keeps those that are; the paper asks for the largest one at a time. Where no single move does, it is the
/// first of the shortest sequence found.
///
/// Stable   what is advised already is kept as long as it helps and nothing else is clearly easier; until the visitor
///          begins to follow it, even where something else has become a little shorter.
/// Cost     some milliseconds, in rare cases tens: in a frame, in pieces.
/// Threads  pure; any. Allocates nothing.
/// Source   Kim, Shin, Kim 2008, 'Guiding the user'.
#pragma once

#include "app/guidance/advice.h"
#include "app/guidance/advice_search.h"
#include "app/guidance/face_reader.h"

#include <optional>
#include <span>
#include <utility>

namespace frustumscreen {

/// Nothing if it is whole. Wait: no sequence of up to four moves was found.
[[nodiscard]] std::optional<Advice> advise(const FaceReader& reader, const GuidedState& tracked_state,
                                           const std::optional<GivenAdvice>& standing = std::nullopt);

/// Advises one visitor from situation to situation.
class Advisor {
public:
    explicit Advisor(GuidanceSetup setup) : reader_(std::move(setup)) {}

    /// As FaceReader::show; a search that goes on is to be begun anew.
    void show(std::span<const glm::dvec3> hull) { reader_.show(hull); }
    [[nodiscard]] std::optional<Advice> advise(const GuidedState& tracked_state);

    /// The same in pieces (advice_search.h): begin, then advance until it is true.
    void begin(const GuidedState& tracked_state);
    [[nodiscard]] bool advance(int looks);
    [[nodiscard]] const std::optional<Advice>& found() const { return search_.found(); }
    [[nodiscard]] const FaceReader& reader() const { return reader_; }

private:
    FaceReader reader_;
    std::optional<GivenAdvice> standing_;
    AdviceSearch search_;
};

} // namespace frustumscreen
