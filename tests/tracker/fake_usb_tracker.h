/// A tracker on a fake bus with a fake clock that uses the real wire formats; its faults are set by the test.
#pragma once

#include "firmware_host/tracker/usb_transport.h"
#include "tests/tracker/wire_bytes.h"

#include <deque>
#include <functional>
#include <optional>
#include <set>
#include <string>

namespace frustumscreen::tracker {

/// A VIPER's reaction to the command that switches its filters off.
enum class FakeFilter { Obeys, Refuses, SaysNothing, StaysOn, TurnStaysOn };
/// A VIPER's answers to other commands.
enum class FakeAnswers { Plain, WarnsOfSettings, WarnsOfQuestions, RefusesQuestions, FailsItsTest };

struct FakeUsbTracker {
    UsbTrackerModel model = UsbTrackerModel::Viper;
    MonotonicTime now = from_microseconds(1'000'000);
    UsbTrackerState in_the_way = UsbTrackerState::NotConnected; ///< result of a search while it is unplugged
    bool plugged = true;
    MonotonicTime boots_until{}; ///< until then it answers commands with 'still booting'
    bool keeps_inches = false;   ///< confirms that units were set, but does not set them
    bool deaf = false;           ///< answers no command
    bool mute = false;           ///< sends no frames
    FakeFilter filter = FakeFilter::Obeys;
    FakeAnswers manner = FakeAnswers::Plain;
    Nanoseconds answers_after{}; ///< VIPER
    double slower = 1.0;         ///< factor of its frame period and its clock's period
    bool clock_stands = false;   ///< PATRIOT, HID
    bool streaming = false;
    std::uint32_t counter = 0;
    std::uint32_t highest = 0; ///< highest counter sent
    std::vector<int> connectors{1, 2};
    unsigned distortion = 0;
    unsigned fault = 0; ///< result of its self-test
    unsigned position_units = 3;
    /// Modifies a frame on its way; empty: unchanged.
    std::function<std::vector<wire::Wire>(wire::Wire)> mischief;

    std::deque<wire::Wire> to_host;
    std::deque<std::pair<MonotonicTime, wire::Wire>> answers; ///< not yet due
    std::vector<std::uint32_t> commands;                      ///< VIPER: command * 16 + action, in order of
                                                              ///< arrival
    std::string text;                                         ///< PATRIOT: everything received
    std::optional<int> unplug_after_calls;                    ///< the cable is pulled after this many calls
    MonotonicTime next_frame{};

    [[nodiscard]] Nanoseconds period() const {
        return Nanoseconds(
            std::llround(slower * (model == UsbTrackerModel::Patriot ? 16'666'667 : 8'333'333)));
    }
    /// A position that is unique per frame and sensor and exact in 32 bits; metres.
    [[nodiscard]] static glm::dvec3 position_of(std::uint32_t frame, int connector) {
        return {static_cast<double>(frame % 1024) / 1024.0, static_cast<double>(frame / 1024 % 64) / 64.0,
                connector / 16.0};
    }
    /// Whether a sample at this place was ever sent.
    [[nodiscard]] bool was_sent(const PoseSample& sample) const {
        const auto low = static_cast<std::uint32_t>(std::lround(sample.position_m.x * 1024.0));
        const auto high = static_cast<std::uint32_t>(std::lround(sample.position_m.y * 64.0));
        const std::uint32_t frame = high * 1024 + low;
        return frame <= highest &&
               glm::distance(position_of(frame, sample.station), sample.position_m) < resolution_m();
    }

    [[nodiscard]] std::uint32_t clock() const { return clock_stands ? 7 : counter; }
    [[nodiscard]] double resolution_m() const { return model == UsbTrackerModel::Hid ? 1e-5 : 1e-6; }

    /// A HID device identifies itself, then streams unprompted.
    void opened() {
        if (model == UsbTrackerModel::Hid) {
            restart();
            streaming = true;
            next_frame = now + period();
            to_host.push_back(wire::hid_info(keeps_inches ? 25400 : 10));
        }
    }
    void restart() {
        streaming = false;
        to_host.clear();
        answers.clear();
        next_frame = {};
    }
    /// Sends answers and frames up to now.
    void run() {
        for (; !answers.empty() && answers.front().first <= now; answers.pop_front()) {
            to_host.push_back(std::move(answers.front().second));
        }
        if (!streaming || mute) {
            next_frame = now + period();
            return;
        }
        for (; next_frame <= now; next_frame += period()) {
            highest = std::max(highest, ++counter);
            for (wire::Wire& frame : frames()) {
                for (wire::Wire& bytes : mischief ? mischief(frame) : std::vector<wire::Wire>{frame}) {
                    to_host.push_back(std::move(bytes));
                }
            }
        }
    }
    [[nodiscard]] std::vector<wire::Wire> frames() const {
        if (model == UsbTrackerModel::Hid) {
            return hid_frames();
        }
        std::vector<wire::Pose> poses;
        const double units = model == UsbTrackerModel::Viper ? 1.0 : 100.0;
        for (const int connector : connectors) {
            const glm::vec3 at(position_of(counter, connector) * units);
            poses.push_back(
                {connector, {at.x, at.y, at.z}, {0.5F, 0.5F, -0.5F, 0.5F}, distortion, position_units});
        }
        if (model == UsbTrackerModel::Viper) {
            return {wire::viper_frame(counter, poses, fault << 4U)};
        }
        std::vector<wire::Wire> all;
        for (const wire::Pose& pose : poses) {
            all.push_back(
                wire::patriot_frame(static_cast<std::uint32_t>(clock() * 16.666667), counter, pose));
        }
        return all;
    }

    [[nodiscard]] std::vector<wire::Wire> hid_frames() const {
        std::vector<wire::Wire> all;
        for (const int connector : connectors) {
            const glm::dvec3 at = position_of(counter, connector) * 1e5;
            wire::HidPose pose;
            pose.station = static_cast<unsigned>(connector);
            pose.status = now < boots_until ? 2 : fault != 0 ? 4 : 0;
            pose.distortion = distortion;
            pose.counter = counter;
            pose.time_us = static_cast<std::uint32_t>(clock() * 8333.333);
            pose.position = {static_cast<std::int32_t>(std::lround(at.x)),
                             static_cast<std::int32_t>(std::lround(at.y)),
                             static_cast<std::int32_t>(std::lround(at.z))};
            all.push_back(wire::hid_pose(pose));
        }
        return all;
    }

    void hear(std::span<const std::byte> bytes) {
        if (deaf) {
            return;
        }
        model == UsbTrackerModel::Viper ? hear_viper(bytes) : hear_patriot(bytes);
    }
    void hear_viper(std::span<const std::byte> bytes) {
        const auto word = [&](std::size_t at) {
            std::uint32_t value = 0;
            std::memcpy(&value, bytes.data() + at, sizeof(value));
            return value;
        };
        const std::uint32_t command = word(12);
        const std::uint32_t action = word(16);
        commands.push_back(command * 16 + action);
        const auto say = [&](std::uint32_t said, const wire::Wire& payload) {
            answers.emplace_back(now + answers_after, wire::viper_reply(command, said, payload));
        };
        wire::Wire payload;
        if (now < boots_until) {
            wire::put(payload, std::uint32_t{1});
            return say(4, payload);
        }
        if (command == 1 && filter == FakeFilter::SaysNothing) {
            return;
        }
        if (command == 1 && filter == FakeFilter::Refuses) {
            wire::put(payload, std::uint32_t{2});
            return say(4, payload);
        }
        // A query to all sensors is not documented, and orientation (1) and position (2) have separate
        // filters.
        const bool question = action == 1;
        const bool of_all = command <= 1 && word(20) == 0xFFFFFFFFU;
        const bool of_both = command == 1 && word(24) == 0;
        if ((question && (of_all || of_both || manner == FakeAnswers::RefusesQuestions)) ||
            (action == 0 && manner == FakeAnswers::FailsItsTest)) {
            wire::put(payload, std::uint32_t{question ? 2U : 3U});
            return say(4, payload);
        }
        if (action == 0 && bytes.size() > 32) {
            settings[command].assign(bytes.begin() + 28, bytes.end() - 4);
        }
        if (question) {
            payload = settings[command];
        }
        if (command == 1 && question &&
            (filter == FakeFilter::StaysOn || (filter == FakeFilter::TurnStaysOn && word(24) == 1))) {
            payload = wire::from_hex("02000000 00000000 00000000 00000000 00000000");
        }
        if (command == 7 && keeps_inches && action == 1) {
            payload = wire::from_hex("00000000 02000000");
        }
        if (command == 19) {
            streaming = action == 0;
            next_frame = now + period();
        }
        if (manner == (question ? FakeAnswers::WarnsOfQuestions : FakeAnswers::WarnsOfSettings)) {
            payload.assign(180, std::byte{0});
            return say(5, payload);
        }
        say(3, payload);
    }
    void hear_patriot(std::span<const std::byte> bytes) {
        const std::string line(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        text += line;
        const auto say = [&](std::string_view answer) {
            const auto said = std::as_bytes(std::span(answer.data(), answer.size()));
            to_host.emplace_back(said.begin(), said.end());
        };
        if (line == "P" || line == "C\r") {
            streaming = line != "P";
            next_frame = now + period();
        } else if (line == "\x16\r") {
            say("00V PATRIOT\r\n");
        } else if (line == "U\r") {
            say(keeps_inches ? "00U 0\r\n" : "00U 1\r\n");
        }
    }
    std::array<wire::Wire, 32> settings; ///< VIPER: payloads set, by command
};

class FakeTransport final : public UsbTransport {
public:
    explicit FakeTransport(FakeUsbTracker& device) : device_(device) {}
    [[nodiscard]] Result<std::size_t> read(std::span<std::byte> buffer, Nanoseconds timeout) override {
        if (gone()) {
            return fail(ErrorKind::DeviceLost, "test.device", "unplugged");
        }
        device_.run();
        if (device_.to_host.empty()) {
            device_.now += device_.streaming ? std::min(timeout, device_.period()) : timeout;
            device_.run();
        }
        if (device_.to_host.empty()) {
            return 0U;
        }
        device_.now += std::chrono::microseconds(50);
        const wire::Wire bytes = std::move(device_.to_host.front());
        device_.to_host.pop_front();
        std::copy(bytes.begin(), bytes.end(), buffer.begin());
        return bytes.size();
    }
    [[nodiscard]] Result<void> write(std::span<const std::byte> bytes, Nanoseconds) override {
        if (gone()) {
            return fail(ErrorKind::DeviceLost, "test.device", "unplugged");
        }
        device_.now += std::chrono::microseconds(100);
        device_.run();
        device_.hear(bytes);
        device_.run();
        return {};
    }
    void close() override {}

private:
    [[nodiscard]] bool gone() {
        if (device_.unplug_after_calls && --*device_.unplug_after_calls < 0) {
            device_.plugged = false;
            device_.unplug_after_calls.reset();
            device_.restart();
        }
        return !device_.plugged;
    }
    FakeUsbTracker& device_;
};

class FakeBus final : public UsbBus {
public:
    explicit FakeBus(FakeUsbTracker& device) : device_(device) {}
    [[nodiscard]] tl::expected<FoundTracker, UsbTrackerState>
    find(std::span<const std::string> /*but_not*/) override {
        if (!device_.plugged) {
            return tl::unexpected(device_.in_the_way);
        }
        if (device_.deaf && device_.model == UsbTrackerModel::Hid) { // its feature report cannot be read
            return tl::unexpected(UsbTrackerState::SetUpRefused);
        }
        device_.opened();
        return FoundTracker{std::make_unique<FakeTransport>(device_), device_.model, {}};
    }

private:
    FakeUsbTracker& device_;
};

} // namespace frustumscreen::tracker
