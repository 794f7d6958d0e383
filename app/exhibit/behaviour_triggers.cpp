#include "app/exhibit/behaviour_triggers.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::exhibit {

std::optional<std::size_t> BehaviourTriggers::next(std::span<const TriggeredBehaviour> behaviours,
                                                   std::size_t presses) {
    const auto has_button = [](const TriggeredBehaviour& one) {
        return one.trigger == world::Trigger::Button;
    };
    const auto count =
        static_cast<std::size_t>(std::count_if(behaviours.begin(), behaviours.end(), has_button));
    if (count == 0) {
        return std::nullopt;
    }
    std::size_t skip = presses % count;
    std::size_t k = 0;
    while (!has_button(behaviours[k]) || skip-- > 0) {
        ++k;
    }
    return k;
}

void BehaviourTriggers::reset(std::size_t artifact) {
    artifact_ = artifact;
    presses_ = 0;
    held_.fill(false);
    told_since_.reset();
    heard_ = false;
}

/// Narration time counts from the first portion of a description that is read, and from the first sound of one that is heard.
void BehaviourTriggers::follow_narration(MonotonicTime now, const Input& input) {
    if (!input.tells) {
        told_since_.reset();
        heard_ = false;
    } else if ((!told_since_ && !input.speech_comes) || (input.heard && !heard_)) {
        told_since_ = now;
        heard_ = input.heard;
    }
}

bool BehaviourTriggers::holds(MonotonicTime now, const Input& input,
                              const TriggeredBehaviour& behaviour) const {
    switch (behaviour.trigger) {
    case world::Trigger::Dwell:
        return input.rested >= dwell;
    case world::Trigger::Hotspot:
        return input.hotspot == behaviour.hotspot;
    case world::Trigger::Narration:
        return told_since_ && to_seconds(now - *told_since_) >= behaviour.narration_s;
    case world::Trigger::Arrival:
        return input.arrived;
    case world::Trigger::Button:
        break;
    }
    return false;
}

BehaviourEvents BehaviourTriggers::step(MonotonicTime now, const Input& input) {
    BehaviourEvents result;
    const bool came = input.artifact != artifact_;
    const bool left = input.attracts && !attracted_; // the visitor
    attracted_ = input.attracts;
    if (came || left || !input.shown) {
        result.end_all = !ended_;
        ended_ = true;
        reset(input.artifact);
    }
    silent_ = left || (silent_ && !came && input.attracts);
    follow_narration(now, input);
    if (!input.shown || silent_) {
        return result;
    }
    const std::size_t count = std::min(input.behaviours.size(), world::max_behaviours);
    for (std::size_t k = 0; k < count; ++k) {
        const TriggeredBehaviour& behaviour = input.behaviours[k];
        const bool held = std::exchange(held_[k], holds(now, input, behaviour));
        if (held_[k] && !held) {
            result.add(k, BehaviourEvent::Kind::Start);
        } else if (!held_[k] && held && behaviour.lasts) {
            result.add(k, BehaviourEvent::Kind::End);
        }
    }
    const std::optional<std::size_t> pressed =
        input.pressed && input.arrived ? next(input.behaviours.first(count), presses_) : std::nullopt;
    if (pressed) {
        result.add(*pressed, BehaviourEvent::Kind::Toggle);
        ++presses_;
    }
    ended_ = ended_ && result.events().empty();
    return result;
}

} // namespace frustumscreen::exhibit
