#include "app/exhibit/narration_sequencer.h"

#include <algorithm>

namespace frustumscreen::exhibit {

namespace {

bool is_described(const Tellable& tellable) {
    return !tellable.portions.empty();
}

/// The index of a hotspot among all things to tell.
std::size_t thing_of_hotspot(const Tellable& tellable, std::size_t hotspot) {
    return hotspot + (is_described(tellable) ? 1 : 0);
}

bool is_hotspot(const Tellable& tellable, std::size_t thing) {
    return thing >= thing_of_hotspot(tellable, 0) && thing < tellable.count();
}

} // namespace

Told NarrationSequencer::step(MonotonicTime now, const NarrationInput& input) {
    follow_subject(now, input);
    if (input.tellable == nullptr) {
        return {};
    }
    give_way(now, input);
    take_presses(now, input);
    if (state_ == State::Description &&
        since_ < now) { // in the first step the report is about the speech before
        follow_speech(now, input);
    }
    follow_rest(now, input);

    Told told;
    if (state_ == State::Description) {
        told.portion = portion_;
        told.leaves = leaving_since_.has_value();
        told.speaks = !reads_ && !told.leaves && !over_since_;
    } else if (state_ == State::Hotspot) {
        told.hotspot = hotspot_;
    }
    return told;
}

/// Ends the narration of a former subject. After a long absence of the visitor, forgets what was told.
void NarrationSequencer::follow_subject(MonotonicTime now, const NarrationInput& input) {
    const bool other = input.subject != subject_;
    if (other || input.stops || input.tellable == nullptr) {
        end(now);
        next_waits_ = describe_waits_ = false;
    }
    if (other) {
        subject_ = input.subject;
        leads_to_ = 0;
    }
    if (other || !input.shown || !input.whole) {
        rests_from_ = now;
    }
    if (input.there || state_ != State::Nothing) {
        nobody_since_.reset();
        return;
    }
    nobody_since_ = nobody_since_ ? nobody_since_ : now;
    if (now - *nobody_since_ >= forgets) {
        leads_to_ = 0;
    }
}

void NarrationSequencer::give_way(MonotonicTime now, const NarrationInput& input) {
    if (!input.gives_way || state_ == State::Nothing || leaving_since_) {
        return;
    }
    const bool in_first_half = portion_ < (input.tellable->portions.size() + 1) / 2;
    if (state_ == State::Description && !over_since_) {
        leads_to_ = in_first_half ? 0 : 1;
        if (!reads_) {
            leaving_since_ = now;
            return;
        }
    }
    end(now);
}

void NarrationSequencer::take_presses(MonotonicTime now, const NarrationInput& input) {
    next_waits_ = next_waits_ || input.next;
    describe_waits_ = describe_waits_ || input.describe;
    if (!input.shown) {
        return;
    }
    const bool leaves = leaving_since_.has_value();
    if (describe_waits_ && is_described(*input.tellable) &&
        (state_ != State::Description || leaves || over_since_)) {
        begin(0, now, *input.tellable);
    } else if (next_waits_) {
        const std::size_t thing = next_thing(*input.tellable);
        is_hotspot(*input.tellable, thing) && !input.in_prop ? end(now) : begin(thing, now, *input.tellable);
    }
    next_waits_ = describe_waits_ = false;
}

/// The index of the thing that a press leads to; past the last: nothing more is told.
std::size_t NarrationSequencer::next_thing(const Tellable& tellable) const {
    switch (state_) {
    case State::Nothing:
        return 0;
    case State::Description:
        return 1;
    case State::Hotspot:
        break;
    }
    return thing_of_hotspot(tellable, hotspot_) + 1;
}

void NarrationSequencer::begin(std::size_t thing, MonotonicTime now, const Tellable& tellable) {
    end(now);
    leads_to_ = thing + 1;
    if (thing >= tellable.count()) {
        return;
    }
    if (is_described(tellable) && thing == 0) {
        state_ = State::Description;
        portion_ = 0;
        reads_ = false;
    } else {
        state_ = State::Hotspot;
        hotspot_ = thing - (is_described(tellable) ? 1 : 0);
    }
}

void NarrationSequencer::end(MonotonicTime now) {
    if (state_ != State::Nothing) {
        rests_from_ = now;
    }
    state_ = State::Nothing;
    since_ = now;
    leaving_since_.reset();
    over_since_.reset();
}

void NarrationSequencer::follow_speech(MonotonicTime now, const NarrationInput& input) {
    const Tellable& tellable = *input.tellable;
    const bool heard = input.narration.state == SpeechProgress::State::Heard;
    if (leaving_since_) {
        if (!heard || now - *leaving_since_ >= longest_leaving) {
            end(now);
            return;
        }
    }
    if (!reads_ && !over_since_) {
        const bool is_over = input.narration.state == SpeechProgress::State::Over;
        const bool never_came =
            input.narration.state == SpeechProgress::State::Silent ||
            (input.narration.state == SpeechProgress::State::Coming && now - since_ >= longest_coming);
        if (never_came) {
            reads_ = true;
            portion_since_ = now;
        } else if (is_over && tellable.ends_unspoken) {
            reads_ = true;
            portion_ = tellable.portions.size() - 1;
            portion_since_ = now;
        } else if (is_over) {
            over_since_ = now;
        }
    }
    if (heard && !reads_) {
        portion_ = std::max(portion_, std::min(input.narration.portion, tellable.portions.size() - 1));
    }
    if (reads_ && !over_since_) {
        read_on(now, tellable);
    }
    if (!reads_ && now - since_ >= longest_description) { // reading ends by itself
        end(now);
    }
}

void NarrationSequencer::read_on(MonotonicTime now, const Tellable& tellable) {
    const Nanoseconds time = tellable.portions[portion_] + finds_text;
    if (now - portion_since_ < time) {
        return;
    }
    if (portion_ + 1 < tellable.portions.size()) {
        ++portion_;
        portion_since_ = now;
    } else {
        over_since_ = now;
    }
}

void NarrationSequencer::follow_rest(MonotonicTime now, const NarrationInput& input) {
    const Tellable& tellable = *input.tellable;
    // Rest counts from the latest interruption by an end or a fade.
    const Nanoseconds rested = std::min(input.rested, now - rests_from_);
    const bool rests = input.shown && input.whole && !input.gives_way;
    const auto lead_on = [&] { begin(std::min(leads_to_, tellable.count()), now, tellable); };
    switch (state_) {
    case State::Nothing:
        if (rests && input.there && leads_to_ < tellable.count() && rested >= first_rest) {
            lead_on();
        }
        break;
    case State::Description:
        if (over_since_ && now - *over_since_ >= breath) {
            rests&& rested >= breath ? lead_on() : end(now);
        }
        break;
    case State::Hotspot: {
        const Nanoseconds time = std::max(min_hotspot, tellable.hotspots[hotspot_] + finds_text + breath);
        const bool seen = now - since_ >= time && rests && rested >= breath;
        if (seen || now - since_ >= std::max(time, longest_hotspot)) {
            seen ? lead_on() : end(now);
        }
        break;
    }
    }
}

} // namespace frustumscreen::exhibit
