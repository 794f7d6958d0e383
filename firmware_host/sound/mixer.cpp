#include "firmware_host/sound/mixer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::sound {

namespace {

constexpr float full_scale = 32768.0F;

/// Smooth step of k / n, with zero slope at both ends.
float ease(std::uint32_t k, std::uint32_t n) {
    const float x = std::min(static_cast<float>(k) / static_cast<float>(n), 1.0F);
    return x * x * (3.0F - 2.0F * x);
}

std::uint32_t length_of(const Prompt& prompt) {
    return static_cast<std::uint32_t>(prompt.samples.size());
}

float sample_of(const Prompt& prompt, std::uint32_t k) {
    return static_cast<float>(prompt.samples[k]) / full_scale;
}

std::int16_t code_of(float x) {
    return static_cast<std::int16_t>(std::clamp(std::lrint(x * full_scale), -32767L, 32767L));
}

} // namespace

float Ramp::next(float goal) {
    value_ += std::clamp(goal - value_, -step_, step_);
    return value_;
}

float amplitude_of(double gain_db) {
    constexpr double silence_db = -60.0;
    constexpr double max_db = 12.0;
    if (!(gain_db > silence_db)) { // also true for NaN
        return 0.0F;
    }
    return static_cast<float>(std::pow(10.0, std::min(gain_db, max_db) / 20.0));
}

float soft_limit(float x) {
    constexpr float knee = Mixer::linear_up_to;
    constexpr float range = 1.0F - knee;
    const float size = std::abs(x);
    return size <= knee ? x : std::copysign(knee + range * std::tanh((size - knee) / range), x);
}

void Mixer::follow(const SoundRequest& request) {
    if (request.stops_ != request_.stops_) {
        waiting_ = {};
        if (spoken_.prompt && fade_left_ == 0) {
            fade_left_ = fade_samples;
        }
        leaving_ = true;
        breath_ = 0;
        next_breath_ = 0;
    }
    if (request.leaves_ != request_.leaves_) {
        waiting_ = {};
        leaving_ = true;
    }
    if (request.number_ != request_.number_) {
        waiting_ = {request.prompt_, request.number_};
        leaving_ = true;
    }
    leaving_ = leaving_ && spoken_.prompt != nullptr;
    gain_goal_ = amplitude_of(request.gain_db_);
    if (!begun_) {
        gain_ = Ramp(gain_goal_, gain_samples);
    }
    request_ = request;
    request_.prompt_.reset();
}

void Mixer::mix(std::span<std::int16_t> samples) {
    begun_ = true;
    for (std::int16_t& sample : samples) {
        sample = code_of(soft_limit(gain_.next(gain_goal_) * next_of_speech()));
    }
}

SoundReport Mixer::report(Nanoseconds queued) const {
    SoundReport report;
    const std::uint64_t living = spoken_.prompt ? spoken_.number : waiting_.prompt ? waiting_.number : 0;
    report.over = living > 0 ? living - 1 : request_.number_;
    if (spoken_.prompt) {
        report.number = spoken_.number;
        report.heard = std::max(duration_of(position_) - queued, Nanoseconds(0));
        report.length = duration_of(spoken_.prompt->samples.size());
    }
    return report;
}

bool Mixer::may_leave_here() {
    const std::vector<Mark>& marks = spoken_.prompt->marks;
    while (mark_ < marks.size() && marks[mark_].end < position_) {
        ++mark_;
    }
    return mark_ < marks.size() && marks[mark_].begin <= position_;
}

void Mixer::end_speech() {
    spoken_ = {};
    leaving_ = false;
    fade_left_ = 0;
    breath_ = std::exchange(next_breath_, breath_samples);
}

float Mixer::next_of_speech() {
    if (!spoken_.prompt) {
        if (breath_ > 0) {
            --breath_;
            return 0.0F;
        }
        if (!waiting_.prompt) {
            return 0.0F;
        }
        spoken_ = std::exchange(waiting_, {});
        position_ = 0;
        mark_ = 0;
        next_breath_ = breath_samples;
    }
    const Prompt& prompt = *spoken_.prompt;
    const std::uint32_t length = length_of(prompt);
    if (position_ >= length) { // an empty prompt
        end_speech();
        return 0.0F;
    }
    if (leaving_ && fade_left_ == 0 && may_leave_here()) {
        fade_left_ = fade_samples;
    }
    const float edge = ease(std::min(position_ + 1, length - position_), fade_samples);
    const float early = fade_left_ > 0 ? ease(fade_left_ - 1, fade_samples) : 1.0F;
    const float sample = sample_of(prompt, position_) * edge * early;
    ++position_;
    if (position_ == length || (fade_left_ > 0 && --fade_left_ == 0)) {
        end_speech();
    }
    return sample;
}

} // namespace frustumscreen::sound
