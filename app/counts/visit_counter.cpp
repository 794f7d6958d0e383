#include "app/counts/visit_counter.h"

#include <algorithm>

namespace frustumscreen::counts {

namespace {

constexpr std::size_t max_names =
    64; ///< of one visit; a further artifact counts as new each time it is shown
constexpr std::size_t max_held = 16;

/// True if `name` is not yet in the list; adds it.
bool is_new(const Sentence& name, std::vector<Sentence>& names) {
    if (std::find(names.begin(), names.end(), name) != names.end()) {
        return false;
    }
    if (names.size() < max_names) {
        names.push_back(name);
    }
    return true;
}

} // namespace

VisitCounter::VisitCounter() {
    held_.reserve(max_held);
    artifacts_.reserve(max_names);
    languages_.reserve(max_names);
}

void VisitCounter::step(const Frame& frame, std::vector<VisitPiece>& pieces) {
    const bool touched = frame.used && frame.used != used_;
    used_ = frame.used;
    waits_for_rest_ = (waits_for_rest_ || frame.staff) && !frame.rests;
    if (began_ && frame.staff && frame.now - *began_ < staff_within) {
        began_.reset();
        held_.clear();
    } else if (began_ && (frame.rests || frame.staff)) {
        end(frame.now, pieces);
    } else if (!began_ && touched && !frame.rests && !waits_for_rest_) {
        began_ = frame.now;
        artifacts_.clear();
        languages_.clear();
        begin_piece(frame);
        piece_.begins = true;
    } else if (began_) {
        const bool is_other =
            piece_.artifact != Sentence(frame.artifact) || piece_.language != Sentence(frame.language);
        if (is_other || frame.now - piece_began_ >= longest_piece) {
            end_piece(frame.now, pieces);
            begin_piece(frame);
        }
    }
}

void VisitCounter::end(MonotonicTime now, std::vector<VisitPiece>& pieces) {
    if (began_) {
        end_piece(now, pieces);
        release(pieces);
        began_.reset();
    }
}

void VisitCounter::begin_piece(const Frame& frame) {
    piece_ = {};
    piece_.artifact = Sentence(frame.artifact);
    piece_.language = Sentence(frame.language);
    piece_.new_artifact = is_new(piece_.artifact, artifacts_);
    piece_.new_language = is_new(piece_.language, languages_);
    piece_began_ = frame.now;
}

void VisitCounter::end_piece(MonotonicTime now, std::vector<VisitPiece>& pieces) {
    piece_.length = now - piece_began_;
    if (held_.size() == max_held) {
        release(pieces); // sixteen pieces within `staff_within` are not the staff's
    }
    held_.push_back(piece_);
    if (now - *began_ >= staff_within) {
        release(pieces);
    }
}

void VisitCounter::release(std::vector<VisitPiece>& pieces) {
    pieces.insert(pieces.end(), held_.begin(), held_.end());
    held_.clear();
}

} // namespace frustumscreen::counts
