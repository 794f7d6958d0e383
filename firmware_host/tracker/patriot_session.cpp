#include "firmware_host/tracker/patriot_session.h"

#include <fmt/format.h>

namespace frustumscreen::tracker {

namespace {

constexpr double tick_ns = 1e6; ///< the timestamp counts milliseconds
/// Pause after a command without an answer, in which the rest of an interrupted stream arrives.
constexpr Nanoseconds between_commands = std::chrono::milliseconds(20);
constexpr int centimetres = 1;

} // namespace

std::vector<PatriotSession::Step> PatriotSession::steps(const UsbTrackerSetUp& set_up) {
    const glm::dvec3 half = glm::normalize(set_up.hemisphere);
    return {
        {"P", Need::Nothing}, // stops a stream that an earlier program left running
        {"F0\r", Need::Nothing},
        {"\x16\r", Need::AnyText}, // ^V: asks for the identification
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

PatriotSession::PatriotSession(const UsbTrackerSetUp& set_up)
    : steps_(steps(set_up)), progress_(steps_.size()), intake_(tick_ns) {}

std::span<const std::byte> PatriotSession::due(MonotonicTime now) {
    if (progress_.silent(now, intake_)) {
        progress_.try_again(0, UsbTrackerState::Silent);
    }
    if (progress_.unanswered(now)) {
        progress_.try_again(0, progress_.trouble_without_answer());
    }
    if (!progress_.may_send(now)) {
        return {};
    }
    const Step& step = steps_[progress_.step()];
    const auto bytes = std::as_bytes(std::span(step.command.data(), step.command.size()));
    stream_.clear();
    if (step.need == Need::Nothing) {
        progress_.next(now, between_commands);
    } else {
        progress_.sent(now);
    }
    return bytes;
}

void PatriotSession::read_answer(MonotonicTime now) {
    if (!progress_.waits_for_answer()) {
        return; // the rest of an earlier stream
    }
    const auto bytes = stream_.bytes();
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (steps_[progress_.step()].need == Need::AnyText) {
        if (text.find('\n') != std::string_view::npos) {
            progress_.next(now, between_commands);
        }
    } else if (const std::optional<int> units = patriot_units_answer(text)) {
        if (*units == centimetres) {
            progress_.next(now, between_commands);
        } else {
            progress_.try_again(0, UsbTrackerState::WrongUnits);
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
            if (intake_.take(*frame, arrival, samples)) {
                progress_.well();
            }
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
        if (progress_.streaming()) {
            read_frames(arrival, samples);
        } else {
            read_answer(arrival);
        }
        if (taken == 0) {
            stream_.clear(); // an answer without an end
        }
    }
}

} // namespace frustumscreen::tracker
