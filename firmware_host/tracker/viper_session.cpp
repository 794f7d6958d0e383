#include "firmware_host/tracker/viper_session.h"

#include "firmware_host/base/byte_reader.h"

#include <cmath>

namespace frustumscreen {

namespace {

constexpr std::uint32_t rate_120_hz = 2;
constexpr double rate_hz = 120.0;
constexpr double least_agreement = 0.999; ///< cosine between the hemispheres set and answered
/// F, FLow, FHigh, factor: 0, 1, 0, 0 is no filter.
constexpr std::array<float, 4> no_filter{0.0F, 1.0F, 0.0F, 0.0F};

template <typename T> std::span<const std::byte> bytes_of(const T& value) {
    return std::as_bytes(std::span(&value, 1));
}

std::array<float, 3> direction(const glm::dvec3& v) {
    const glm::dvec3 unit = glm::normalize(v);
    return {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z)};
}

struct HemispherePayload {
    std::uint32_t track = 0; ///< 0: the half space stays where it is
    std::array<float, 3> direction{};
};
using UnitsPayload = std::array<std::uint32_t, 2>;

} // namespace

std::vector<ViperSession::Step> ViperSession::steps(const std::array<float, 3>& hemisphere) {
    using C = ViperCommand;
    using A = ViperAction;
    const UnitsPayload units{viper_metres, viper_quaternion};
    const HemispherePayload half{0, hemisphere};
    std::vector<Step> steps;
    const auto ask = [&steps](C name, A action, Failing failing = Failing::TriesAgain) {
        steps.push_back({ViperCommandBytes(name, action), name, Need::Ack, failing});
    };
    const auto set = [&steps](C name, std::span<const std::byte> payload,
                              Failing failing = Failing::TriesAgain, std::uint32_t arg2 = 0) {
        steps.push_back(
            {ViperCommandBytes(name, A::Set, payload, viper_all_sensors, arg2), name, Need::Ack, failing});
        steps.push_back(
            {ViperCommandBytes(name, A::Get, {}, viper_all_sensors, arg2), name, Need::Same, failing});
    };
    ask(C::Continuous, A::Reset, Failing::GoesOn); // whatever an earlier program left running
    ask(C::WhoAmI, A::Get);
    set(C::Units, bytes_of(units));
    set(C::Hemisphere, bytes_of(half));
    set(C::Filter, bytes_of(no_filter), Failing::GoesOn, 0);
    set(C::Filter, bytes_of(no_filter), Failing::GoesOn, 1);
    set(C::FrameRate, bytes_of(rate_120_hz));
    ask(C::Continuous, A::Set);
    return steps;
}

ViperSession::ViperSession(const UsbTrackerSetUp& set_up)
    : hemisphere_(direction(set_up.hemisphere)), steps_(steps(hemisphere_)), progress_(steps_.size()),
      intake_(1e9 / rate_hz) {}

std::span<const std::byte> ViperSession::due(MonotonicTime now) {
    if (progress_.silent(now, intake_)) {
        try_again(steps_.size() - 1, UsbTrackerState::Silent);
    }
    if (progress_.unanswered(now)) {
        fail_step(progress_.step(), progress_.trouble_without_answer(), now);
    }
    if (!progress_.may_send(now)) {
        return {};
    }
    if (stream_stale_) {
        stream_.clear(); // half a frame would swallow the answer
        stream_stale_ = false;
    }
    if (progress_.step() == 0) {
        filter_stays_on_ = false; // until it is known
    }
    progress_.sent(now);
    return steps_[progress_.step()].command.bytes();
}

void ViperSession::fail_step(std::size_t back_to, UsbTrackerState trouble, MonotonicTime now) {
    const Step& step = steps_[progress_.step()];
    if (step.failing == Failing::TriesAgain) {
        try_again(back_to, trouble);
        return;
    }
    filter_stays_on_ = filter_stays_on_ || step.name == ViperCommand::Filter;
    do { // what was not set is not read back either
        progress_.next(now);
    } while (steps_[progress_.step()].need == Need::Same);
}

void ViperSession::try_again(std::size_t from, UsbTrackerState trouble) {
    progress_.try_again(from, trouble);
    stream_stale_ = true;
}

bool ViperSession::repeats_what_was_set(const ViperReply& reply) const {
    ByteReader reader(reply.payload);
    switch (steps_[progress_.step()].name) {
    case ViperCommand::Units: {
        const auto units = reader.read<UnitsPayload>();
        return reader.ok() && units == UnitsPayload{viper_metres, viper_quaternion};
    }
    case ViperCommand::Filter: {
        const auto filter = reader.read<std::array<float, 4>>();
        return reader.ok() && filter == no_filter;
    }
    case ViperCommand::FrameRate:
        return reader.read<std::uint32_t>() == rate_120_hz && reader.ok();
    case ViperCommand::Hemisphere: {
        const auto half = reader.read<HemispherePayload>();
        double cosine = 0.0;
        double squared = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto component = static_cast<double>(half.direction[k]);
            cosine += component * static_cast<double>(hemisphere_[k]);
            squared += component * component;
        }
        return reader.ok() && cosine >= least_agreement * std::sqrt(squared) && squared > 0.0;
    }
    default:
        return true;
    }
}

void ViperSession::answer(const ViperReply& reply, MonotonicTime now) {
    if (!progress_.waits_for_answer() ||
        reply.command != static_cast<std::uint32_t>(steps_[progress_.step()].name)) {
        return; // late, or not asked for
    }
    const Step& step = steps_[progress_.step()];
    if (reply.action == static_cast<std::uint32_t>(ViperAction::Ack)) {
        if (step.need == Need::Same && reply.payload.empty()) {
            return; // late, to what was set
        }
        if (step.need == Need::Same && !repeats_what_was_set(reply)) {
            const bool units = step.name == ViperCommand::Units;
            fail_step(progress_.step() - 1,
                      units ? UsbTrackerState::WrongUnits : UsbTrackerState::SetUpRefused, now);
            return;
        }
        progress_.next(now);
        return;
    }
    const auto nak = ByteReader(reply.payload).read<std::uint32_t>();
    if (reply.payload.size() >= 4 && nak == static_cast<std::uint32_t>(ViperNak::Booting)) {
        progress_.put_off(UsbTrackerState::Booting, now + SessionTimes::booting); // for as long as it takes
    } else {
        fail_step(progress_.step(), UsbTrackerState::SetUpRefused, now);
    }
}

void ViperSession::receive(std::span<const std::byte> bytes, MonotonicTime arrival,
                           std::vector<PoseSample>& samples) {
    while (!bytes.empty()) {
        bytes = bytes.subspan(stream_.append(bytes));
        while (true) {
            const ViperStep step = parse_viper(stream_.bytes());
            if (step.consumed == 0) {
                break;
            }
            if (const auto* reply = std::get_if<ViperReply>(&step.message)) {
                answer(*reply, arrival);
            } else if (std::holds_alternative<Refusal>(step.message)) {
                intake_.count_refusal();
            } else if (const auto* frame = std::get_if<DeviceFrame>(&step.message);
                       frame && progress_.streaming()) {
                if (!frame->units_as_set) {
                    try_again(0, UsbTrackerState::WrongUnits);
                } else if (intake_.take(*frame, arrival, samples)) {
                    progress_.well();
                }
            }
            stream_.drop(step.consumed);
        }
    }
}

UsbTrackerState ViperSession::state(MonotonicTime now) const {
    const UsbTrackerState state = progress_.state(now, intake_);
    return state == UsbTrackerState::Streaming && filter_stays_on_ ? UsbTrackerState::FilterStaysOn : state;
}

} // namespace frustumscreen
