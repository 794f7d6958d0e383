#include "app/residency/prompt_reader.h"

#include "app/pack/pack_texts.h"
#include "app/residency/portion_times.h"
#include "firmware_host/base/device_thread.h"
#include "firmware_host/base/standard_error.h"
#include "firmware_host/sound/opus_reader.h"
#include "firmware_host/sound/pauses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::residency {

namespace {

Result<sound::Prompt> decode(const PromptRecording& recording) {
    if (!recording.opus.empty()) {
        return sound::read_opus(recording.opus);
    }
    TRY(const Bytes opus, pack::load_sound(recording.pack, recording.language, recording.key));
    if (opus.empty()) {
        return bad_input("show.no_sound", "{} no longer has its sound; bake the pack again",
                         recording.pack.string());
    }
    return sound::read_opus(opus);
}

void soften(sound::Prompt& prompt, double gain_db) {
    if (gain_db < 0.0) {
        const double gain = std::pow(10.0, gain_db / 20.0);
        for (std::int16_t& sample : prompt.samples) {
            sample = static_cast<std::int16_t>(std::lround(gain * sample));
        }
    }
}

} // namespace

PromptReader::PromptReader(Answer answer)
    : answer_(answer), worker_([this](const std::stop_token& stop) { work(stop); }) {}

void PromptReader::want(SpokenUse use, const SharedRecording& recording) {
    const std::scoped_lock lock(mutex_);
    SharedRecording& wanted = wanted_.at(static_cast<std::size_t>(use));
    if (wanted == recording) {
        return;
    }
    wanted = recording;
    if (Kept* kept = recording ? place_of(recording) : nullptr) {
        kept->wanted_at = ++wants_;
    }
    changed_.notify_all();
}

SharedReading PromptReader::find(const SharedRecording& recording) {
    std::unique_lock lock(mutex_);
    const auto is_wanted = [&] {
        return std::find(wanted_.begin(), wanted_.end(), recording) != wanted_.end();
    };
    if (answer_ == Answer::Always && recording) {
        changed_.wait(lock, [&] { return !is_wanted() || place_of(recording) != nullptr; });
    }
    const Kept* kept = recording ? place_of(recording) : nullptr;
    return kept != nullptr ? kept->reading : nullptr;
}

PromptReader::Kept* PromptReader::place_of(const SharedRecording& recording) {
    const auto found = std::find_if(kept_.begin(), kept_.end(),
                                    [&](const Kept& kept) { return kept.recording == recording; });
    return found != kept_.end() ? &*found : nullptr;
}

SharedRecording PromptReader::next() const {
    for (const SharedRecording& wanted : wanted_) {
        if (wanted && std::none_of(kept_.begin(), kept_.end(),
                                   [&](const Kept& kept) { return kept.recording == wanted; })) {
            return wanted;
        }
    }
    return nullptr;
}

/// The worker frees the replaced entry, and also a recording that is not wanted any more.
void PromptReader::keep(const SharedRecording& recording, SharedReading reading) {
    Kept old{recording, std::move(reading), 0};
    const std::scoped_lock lock(mutex_);
    old.wanted_at = ++wants_;
    if (recording == wanted_.at(static_cast<std::size_t>(SpokenUse::Description))) {
        std::swap(kept_.back(), old);
    } else if (recording == wanted_.at(static_cast<std::size_t>(SpokenUse::Word))) {
        std::swap(*std::min_element(kept_.begin(), kept_.end() - 1,
                                    [](const Kept& a, const Kept& b) { return a.wanted_at < b.wanted_at; }),
                  old);
    }
    changed_.notify_all();
}

SharedReading PromptReader::read(const PromptRecording& recording) {
    auto reading = std::make_shared<Reading>();
    Result<sound::Prompt> prompt = decode(recording);
    if (!prompt) {
        if (silent_.insert(recording.name).second) {
            say_line("frustumscreen",
                     fmt::format("{} is silent: {}", recording.name, prompt.error().message));
        }
        return reading;
    }
    soften(*prompt, recording.gain_db);
    prompt->marks = sound::find_pauses(prompt->samples);
    reading->portions = portion_times(recording.portions, *prompt);
    reading->prompt = std::make_shared<const sound::Prompt>(*std::move(prompt));
    return reading;
}

void PromptReader::work(const std::stop_token& stop) {
    begin_device_thread("prompts");
    while (!stop.stop_requested()) {
        SharedRecording recording;
        Kept unwanted; // freed after the lock is released
        {
            std::unique_lock lock(mutex_);
            const auto is_unwanted = [&] {
                return kept_.back().recording &&
                       kept_.back().recording != wanted_.at(static_cast<std::size_t>(SpokenUse::Description));
            };
            changed_.wait(lock, stop, [&] { return next() != nullptr || is_unwanted(); });
            if (is_unwanted()) {
                std::swap(kept_.back(), unwanted);
            }
            recording = next();
        }
        if (recording && !stop.stop_requested()) {
            keep(recording, read(*recording));
        }
    }
}

} // namespace frustumscreen::residency
