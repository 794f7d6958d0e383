#include "app/bench/guidance/shown_sign.h"

#include "app/bench/guidance/paper_rule.h"

namespace frustumscreen::bench {

namespace {

MonotonicTime time_at(double now_s) {
    return MonotonicTime(std::chrono::duration_cast<Nanoseconds>(std::chrono::duration<double>(now_s)));
}

double seconds_of(Nanoseconds time) {
    return std::chrono::duration<double>(time).count();
}

} // namespace

void ShownSign::step(double now_s, const guidance::GuidedState& tracked_state) {
    if (adviser_ == Adviser::Paper) {
        step_paper(now_s, tracked_state);
    } else if (adviser_ == Adviser::Exhibit) {
        const guidance::Guidance& guidance =
            guide_.step(time_at(now_s), tracked_state, guidance::Sensing::Good, false);
        shown_.reset();
        if (guidance.stage != guidance::GuidanceStage::Quiet) {
            shown_ = SignOnTable{guidance.move, seconds_of(guidance.since.time_since_epoch())};
        }
    }
}

void ShownSign::step_paper(double now_s, const guidance::GuidedState& tracked_state) {
    if (guide_.reader().whole(tracked_state)) {
        shown_.reset();
        dark_since_s_.reset();
        return;
    }
    dark_since_s_ = dark_since_s_ ? dark_since_s_ : now_s;
    if (now_s - *dark_since_s_ < seconds_of(guidance::Guide::debounce) || (shown_ && now_s < next_look_s_)) {
        return;
    }
    next_look_s_ = now_s + seconds_of(guidance::Guide::looks_every);
    const guidance::Move move = paper_advice(guide_.reader(), tracked_state).value_or(guidance::Move{});
    const bool same = shown_ && guidance::alike(shown_->move, move);
    shown_ = SignOnTable{move, same ? shown_->since_s : now_s};
}

} // namespace frustumscreen::bench
