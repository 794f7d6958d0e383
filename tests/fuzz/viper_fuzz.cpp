// A VIPER that sends arbitrary data: the codec, the set-up, the stream. Frames may be corrupted, or have
// their checksum corrected to reach the fields behind it.
#include "firmware_host/tracker/crc.h"
#include "firmware_host/tracker/viper_session.h"
#include "tests/fuzz/session_talk.h"

using namespace frustumscreen;

namespace {

enum class Word : std::uint8_t { Wait, Raw, Reply, Agree, Pose, Poses, Cut, Count };

/// Adds header and checksum to a body, with the codec's own checksum function.
Bytes framed(std::string_view preamble, const Bytes& body) {
    Bytes frame;
    frame.insert(frame.end(), as_bytes(preamble).begin(), as_bytes(preamble).end());
    append(frame, static_cast<std::uint32_t>(body.size() + 4));
    frame.insert(frame.end(), body.begin(), body.end());
    append(frame, static_cast<std::uint32_t>(tracker::crc16_arc(frame)));
    return frame;
}

std::uint32_t command_of(const Bytes& frame) {
    return frame.size() < 16 ? 0 : ByteReader(std::span(frame).subspan(12)).read<std::uint32_t>();
}

Bytes reply(std::uint32_t command, std::uint32_t action, const Bytes& payload) {
    Bytes body;
    for (const std::uint32_t word : {7U, command, action, 0U, 0U}) {
        append(body, word);
    }
    body.insert(body.end(), payload.begin(), payload.end());
    return framed("VPRC", body);
}

/// Accepts the session's settings and returns them when queried.
class ObedientDevice {
public:
    Bytes answer(const Bytes& command) {
        const auto name = command_of(command);
        if (command.size() > 32) {
            payloads_[name % payloads_.size()].assign(command.begin() + 28, command.end() - 4);
        }
        return reply(name, static_cast<std::uint32_t>(tracker::ViperAction::Ack),
                     payloads_[name % payloads_.size()]);
    }

private:
    std::array<Bytes, 32> payloads_; ///< by command
};

Bytes pose_body(const fuzz::ScriptedPose& pose, std::uint32_t counter) {
    Bytes body;
    for (const std::uint32_t word : {7U, counter, 0U, 1U}) {
        append(body, word);
    }
    append(body, pose.sensor | tracker::viper_metres << 8U | tracker::viper_quaternion << 10U |
                     static_cast<std::uint32_t>(pose.distortion) << 14U);
    append(body, pose.position);
    append(body, pose.quaternion);
    return body;
}

void require_command(const Bytes& command) {
    const tracker::ViperStep step = tracker::parse_viper(command);
    fuzz::require(command.empty() || (step.consumed == command.size() &&
                                      std::holds_alternative<tracker::ViperReply>(step.message)),
                  "what is sent is one whole command");
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tracker::ViperSession session(tracker::UsbTrackerSetUp{});
    fuzz::SessionTalk talk(session);
    ObedientDevice device;
    std::uint32_t counter = 0;
    ByteReader script(fuzz::bytes_of(data, size));
    while (script.left() > 0 && !talk.over()) {
        const auto word = static_cast<Word>(script.read<std::uint8_t>() % static_cast<unsigned>(Word::Count));
        switch (word) {
        case Word::Wait:
            talk.wait(std::chrono::milliseconds(script.read<std::uint16_t>()));
            break;
        case Word::Raw:
            talk.deliver(fuzz::take(script, script.read<std::uint8_t>()));
            break;
        case Word::Reply: {
            const auto action = script.read<std::uint8_t>();
            talk.deliver(
                reply(command_of(talk.command()), action, fuzz::take(script, script.read<std::uint8_t>())));
            break;
        }
        case Word::Agree:
            talk.deliver(device.answer(talk.command()));
            break;
        case Word::Pose: {
            const fuzz::ScriptedPose pose(script);
            counter += pose.step;
            talk.deliver(framed("VPRP", pose_body(pose, counter)));
            break;
        }
        case Word::Poses:
            talk.deliver(framed("VPRP", fuzz::take(script, script.read<std::uint8_t>())));
            break;
        default:
            talk.cut(script.read<std::uint8_t>());
        }
        require_command(talk.command());
    }
    fuzz::check_stream(talk.wire(), tracker::parse_viper);
    return 0;
}
