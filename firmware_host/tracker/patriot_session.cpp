#include "firmware_host/tracker/patriot_session.h"

#include <fmt/format.h>

namespace frustumscreen {

namespace {

constexpr double tick_ns = 1e6; ///< the timestamp counts milliseconds
/// Between commands that are not answered, and for the rest of an interrupted stream to arrive.
constexpr Nanoseconds between_commands = std::chrono::milliseconds(20);
constexpr int centimetres = 1;

} // namespace

PatriotSession::PatriotSession(const UsbTrackerSetUp& set_up) : intake_(tick_ns) {
    const glm::dvec3 half = glm::normalize(set_up.hemisphere);
    steps_ = {
        {"P", Need::Nothing}, // whatever an earlier program left running
        {"F0\r", Need::Nothing},
        {"\x16\r", Need::AnyText}, // ^V: who are you
        {"U1\r", Need::Nothing},
        {"U\r", Need::Metric},
        {fmt::format("H*,{:.4f},{:.4f},{:.4f}\r", half.x, half.y, half.z), Need::Nothing},
        {"X0,1,0,0\r", Need::Nothing},
        {"Y0,1,0,0\r", Need::Nothing},
        {"O*,8,9,11,3,7\r", Need::Nothing},
        {"@B0\r", Need::Nothing},
        {"F1\r", Need::Nothing},
        {"C\r", Need::Nothing},
    };
}

std::span<const std::byte> PatriotSession::due(MonotonicTime now) {
    if (streaming()) {
        const MonotonicTime heard = std::max(intake_.latest().value_or(*awake_), *awake_);
        if (now - heard <= SessionTimes::quiet) {
            return {};
        }
        try_again(UsbTrackerState::Silent, now);
    }
    if (sent_ && now - *sent_ > SessionTimes::reply) {
        try_again(trouble_ == UsbTrackerState::SettingUp ? UsbTrackerState::SetUpRefused : trouble_, now);
    }
    if (failed_ || sent_ || (pause_ && now < *pause_)) {
        return {};
    }
    const Step& step = steps_[at_];
    const auto bytes = std::as_bytes(std::span(step.command.data(), step.command.size()));
    stream_.clear();
    if (step.need == Need::Nothing) {
        next(now);
    } else {
        sent_ = now;
    }
    return bytes;
}

void PatriotSession::next(MonotonicTime now) {
    ++at_;
    sent_.reset();
    pause_ = now + between_commands;
    if (streaming()) {
        awake_ = now;
    }
}

void PatriotSession::try_again(UsbTrackerState trouble, MonotonicTime now) {
    at_ = 0;
    sent_.reset();
    pause_ = now;
    trouble_ = trouble;
    failed_ = ++tries_ >= SessionTimes::tries;
}

void PatriotSession::read_answer(MonotonicTime now) {
    if (!sent_) {
        return; // the rest of an earlier stream
    }
    const auto bytes = stream_.bytes();
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (steps_[at_].need == Need::AnyText) {
        if (text.find('\n') != std::string_view::npos) {
            next(now);
        }
    } else if (const std::optional<int> units = patriot_units_answer(text)) {
        if (*units == centimetres) {
            next(now);
        } else {
            try_again(UsbTrackerState::WrongUnits, now);
        }
    }
}

void PatriotSession::read_frames(MonotonicTime arrival, std::vector<PoseSample>& samples) {
    while (true) {
        const PatriotStep step = parse_patriot(stream_.bytes());
        if (step.consumed == 0) {
            return;
        }
        if (const auto* frame = std::get_if<DeviceFrame>(&step.message)) {
            intake_.take(*frame, arrival, samples);
            tries_ = 0;
            trouble_ = UsbTrackerState::SettingUp;
        } else {
            intake_.count_refusal();
        }
        stream_.drop(step.consumed);
    }
}

void PatriotSession::receive(std::span<const std::byte> bytes, MonotonicTime arrival,
                             std::vector<PoseSample>& samples) {
    while (!bytes.empty()) {
        const std::size_t taken = stream_.append(bytes);
        bytes = bytes.subspan(taken);
        if (streaming()) {
            read_frames(arrival, samples);
        } else {
            read_answer(arrival);
        }
        if (taken == 0) {
            stream_.clear(); // an answer without an end
        }
    }
}

UsbTrackerState PatriotSession::state(MonotonicTime now) const {
    const bool heard = streaming() && intake_.latest() && *intake_.latest() >= *awake_;
    return heard ? intake_.state(now) : trouble_;
}

} // namespace frustumscreen
