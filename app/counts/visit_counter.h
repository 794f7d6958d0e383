/// Turns what the exhibit does into visits: a visit begins when a button is pressed or the prop is moved, and lasts until the exhibit
/// rests. Who comes is not known, and no number tells two visitors from one.
///
/// Staff    who holds the staff's buttons is no visitor: a visit that leads to the staff's picture within `staff_within` is dropped, and
///          none begins until the exhibit has rested.
/// Time     monotonic, of the frame; never goes back.
/// Threads  values; one caller. Allocates nothing after construction, but for the caller's list.
#pragma once

#include "firmware_host/base/sentence.h"
#include "firmware_host/base/time.h"

#include <optional>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// A piece of a visit.
struct VisitPiece {
    Nanoseconds length{0};
    bool begins = false;         ///< a visit begins with it
    bool new_artifact = false;   ///< in this visit
    bool new_language = false;   ///< in this visit
    Sentence artifact, language; ///< that were shown
};

class VisitCounter {
public:
    static constexpr Nanoseconds staff_within = std::chrono::seconds(5);
    /// No piece is longer, so that it belongs to one hour.
    static constexpr Nanoseconds longest_piece = std::chrono::seconds(10);

    struct Frame {
        MonotonicTime now;
        std::optional<MonotonicTime> used; ///< when a button was pressed or the prop moved last
        bool rests = false;                ///< nobody is there: it invites, or is asleep
        bool staff = false;                ///< the staff's picture is shown
        std::string_view artifact, language;
    };

    VisitCounter();
    /// Appends the pieces that are over.
    void step(const Frame& frame, std::vector<VisitPiece>& pieces);
    /// The run ends.
    void end(MonotonicTime now, std::vector<VisitPiece>& pieces);

private:
    void begin_piece(const Frame& frame);
    void end_piece(MonotonicTime now, std::vector<VisitPiece>& pieces);
    void release(std::vector<VisitPiece>& pieces);

    std::optional<MonotonicTime> used_;  ///< as it was seen last
    std::optional<MonotonicTime> began_; ///< the visit; nothing: there is none
    MonotonicTime piece_began_;
    VisitPiece piece_;                ///< that grows
    std::vector<VisitPiece> held_;    ///< while the visit may turn out to be the staff's
    std::vector<Sentence> artifacts_; ///< of this visit
    std::vector<Sentence> languages_; ///< of this visit
    bool waits_for_rest_ = false;     ///< the staff were there
};

} // namespace frustumscreen
