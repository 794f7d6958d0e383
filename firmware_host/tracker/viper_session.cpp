#include "firmware_host/tracker/viper_session.h"

#include "firmware_host/base/byte_reader.h"

#include <cmath>

namespace frustumscreen::tracker {

namespace {

constexpr std::uint32_t rate_120_hz = 2;
constexpr double rate_hz = 120.0;
constexpr double min_agreement = 0.999; ///< cosine between the set and the confirmed hemisphere
constexpr std::uint32_t no_filter = 0;

template <typename T> std::span<const std::byte> bytes_of(const T& value) {
    return std::as_bytes(std::span(&value, 1));
}

std::array<float, 3> direction(const glm::dvec3& v) {
    const glm::dvec3 unit = glm::normalize(v);
    return {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z)};
}

struct HemispherePayload {
    std::uint32_t flags = 0; ///< 0: the half space is fixed
    std::array<float, 3> direction{};
};
struct FilterPayload {
    std::uint32_t level = no_filter;
    std::array<float, 4> custom{};
};
using UnitsPayload = std::array<std::uint32_t, 2>;

} // namespace

std::vector<ViperSession::Step> ViperSession::steps(const std::array<float, 3>& hemisphere) {
    using C = ViperCommand;
    using A = ViperAction;
    const UnitsPayload units{viper_metres, viper_quaternion};
    const HemispherePayload half{0, hemisphere};
    const FilterPayload filter{};
    std::vector<Step> steps;
    const auto add = [&steps](C name, A action, Need need, Failing failing,
                              std::span<const std::byte> payload = {}, std::uint32_t sensor = 0,
                              ViperFilterTarget target = ViperFilterTarget::Both) {
        steps.push_back({.command = ViperCommandBytes(name, action, payload, sensor, target),
                         .name = name,
                         .action = action,
                         .need = need,
                         .failing = failing});
    };
    const auto set = [&add](C name, std::span<const std::byte> payload, std::uint32_t sensor = 0) {
        add(name, A::Set, Need::Ack, Failing::TriesAgain, payload, sensor);
        add(name, A::Get, Need::Same, Failing::TriesAgain); // of sensor 0, the prop's
    };
    add(C::Continuous, A::Reset, Need::Ack, Failing::GoesOn); // an earlier program's stream may run
    add(C::WhoAmI, A::Get, Need::Ack, Failing::TriesAgain);
    set(C::Units, bytes_of(units));
    set(C::Hemisphere, bytes_of(half), viper_all_sensors);
    add(C::Filter, A::Set, Need::Ack, Failing::GoesOn, bytes_of(filter), viper_all_sensors);
    for (const ViperFilterTarget target : {ViperFilterTarget::Orientation, ViperFilterTarget::Position}) {
        add(C::Filter, A::Get, Need::Same, Failing::GoesOn, {}, 0, target);
    }
    set(C::FrameRate, bytes_of(rate_120_hz));
    add(C::Continuous, A::Set, Need::Ack, Failing::TriesAgain);
    return steps;
}

ViperSession::ViperSession(const UsbTrackerSetUp& set_up)
    : hemisphere_(direction(set_up.hemisphere)), steps_(steps(hemisphere_)), progress_(steps_.size()),
      intake_(1e9 / rate_hz) {}

std::span<const std::byte> ViperSession::due(MonotonicTime now) {
    if (progress_.silent(now, intake_)) {
        try_again(steps_.size() - 1, UsbTrackerState::Silent);
    }
    if (progress_.unanswered(now) && asks_filter_again()) {
        progress_.put_off(UsbTrackerState::SettingUp, now);
    } else if (progress_.unanswered(now)) {
        fail_step(progress_.step(), progress_.trouble_without_answer(), now);
    }
    if (!progress_.may_send(now)) {
        return {};
    }
    if (stream_stale_) {
        stream_.clear(); // half a frame would hide the answer
        stream_stale_ = false;
    }
    if (progress_.step() == 0) {
        filter_stays_on_ = false; // until the device shows otherwise
        doubtful_ = false;
        filter_unanswered_ = 0;
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
    do { // a setting that was not made is not read back
        progress_.next(now);
    } while (steps_[progress_.step()].need == Need::Same);
}

/// On a busy machine an answer may be late, and a filter that stays on adds lag until the tracker is
/// unplugged.
bool ViperSession::asks_filter_again() {
    return steps_[progress_.step()].name == ViperCommand::Filter &&
           ++filter_unanswered_ < SessionTimes::tries;
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
    case ViperCommand::Filter:
        return reader.read<FilterPayload>().level == no_filter && reader.ok();
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
        return reader.ok() && cosine >= min_agreement * std::sqrt(squared) && squared > 0.0;
    }
    default:
        return true;
    }
}

void ViperSession::answer(const ViperReply& reply, MonotonicTime now) {
    if (!progress_.waits_for_answer() ||
        reply.command != static_cast<std::uint32_t>(steps_[progress_.step()].name)) {
        return; // a late reply, or an unsolicited one
    }
    const Step& step = steps_[progress_.step()];
    if (reply.action == static_cast<std::uint32_t>(ViperAction::Ack)) {
        if (step.need == Need::Same && reply.payload.empty()) {
            return; // a late reply to the Set before
        }
        if (step.need == Need::Same && !repeats_what_was_set(reply)) {
            const bool units = step.name == ViperCommand::Units;
            fail_step(progress_.step() - 1,
                      units ? UsbTrackerState::WrongUnits : UsbTrackerState::SetUpRefused, now);
            return;
        }
        progress_.next(now);
    } else if (reply.action == static_cast<std::uint32_t>(ViperAction::NakWarning)) {
        doubtful_ = true;
        progress_.next(now);
    } else {
        refused(reply, now);
    }
}

void ViperSession::refused(const ViperReply& reply, MonotonicTime now) {
    ByteReader reader(reply.payload);
    const auto code = static_cast<ViperNak>(reader.read<std::uint32_t>());
    if (reader.ok() && code == ViperNak::Booting) {
        progress_.put_off(UsbTrackerState::Booting, now + SessionTimes::booting); // without a limit
    } else if (steps_[progress_.step()].action == ViperAction::Get) {
        // The device may have accepted the setting without confirming it, which leaves doubt. WhoAmI is not a
        // setting and leaves none.
        doubtful_ = doubtful_ || steps_[progress_.step()].need == Need::Same;
        progress_.next(now);
    } else {
        const bool fault = reader.ok() && code == ViperNak::BuiltInTest;
        fail_step(progress_.step(), fault ? UsbTrackerState::DeviceFault : UsbTrackerState::SetUpRefused,
                  now);
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
            } else if (std::holds_alternative<DiscardReason>(step.message)) {
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
    if (state != UsbTrackerState::Streaming) {
        return state;
    }
    return filter_stays_on_ ? UsbTrackerState::FilterStaysOn
           : doubtful_      ? UsbTrackerState::SetUpDoubtful
                            : state;
}

} // namespace frustumscreen::tracker
