/// Derives visits from the exhibit's activity: a visit begins when a button is pressed or the prop is moved, and
/// lasts until the exhibit rests. Visitors are not identified: two visitors in a row may count as one visit.
///
/// Staff    staff are not counted as visitors: a visit that leads to the staff's picture within `staff_within` is
///          dropped, and no visit begins until the exhibit has rested.
/// Time     monotonic, of the frame; never goes back.
/// Threads  values; one caller. Allocates nothing after construction, except in the caller's list.
#pragma once

#include "firmware_host/base/sentence.h"
#include "firmware_host/base/time.h"

#include <optional>
#include <string_view>
#include <vector>

namespace frustumscreen::counts {

/// A piece of a visit.
struct VisitPiece {
    Nanoseconds length{0};
    bool begins = false;         ///< the piece begins a visit
    bool new_artifact = false;   ///< for this visit
    bool new_language = false;   ///< for this visit
    Sentence artifact, language; ///< shown during the piece
};

class VisitCounter {
public:
    static constexpr Nanoseconds staff_within = std::chrono::seconds(5);
    /// The longest piece; short, so that a piece belongs to one hour.
    static constexpr Nanoseconds longest_piece = std::chrono::seconds(10);

    struct Frame {
        MonotonicTime now;
        std::optional<MonotonicTime> used; ///< last press of a button or move of the prop
        bool rests = false;                ///< no visitor is present: attract state or asleep
        bool staff = false;                ///< the staff's picture is shown
        std::string_view artifact, language;
    };

    VisitCounter();
    /// Appends the completed pieces.
    void step(const Frame& frame, std::vector<VisitPiece>& pieces);
    /// Ends the run.
    void end(MonotonicTime now, std::vector<VisitPiece>& pieces);

private:
    void begin_piece(const Frame& frame);
    void end_piece(MonotonicTime now, std::vector<VisitPiece>& pieces);
    void release(std::vector<VisitPiece>& pieces);

    std::optional<MonotonicTime> used_;  ///< at the last frame
    std::optional<MonotonicTime> began_; ///< begin of the visit; nothing: no visit
    MonotonicTime piece_began_;
    VisitPiece piece_;                ///< the piece in progress
    std::vector<VisitPiece> held_;    ///< while the visit may still prove to be the staff's
    std::vector<Sentence> artifacts_; ///< of this visit
    std::vector<Sentence> languages_; ///< of this visit
    bool waits_for_rest_ = false;     ///< after the staff's picture
};

} // namespace frustumscreen::counts
