// A PATRIOT that sends arbitrary data: its text during set-up, its frames, and both at the wrong time.
#include "firmware_host/tracker/patriot_session.h"
#include "tests/fuzz/session_talk.h"

using namespace frustumscreen;

namespace {

enum class Word : std::uint8_t { Wait, Raw, Line, Agree, Pose, Frame, Cut, Count };

/// A header with 40 bytes of payload.
Bytes framed(std::uint8_t sensor, char error, Bytes payload) {
    Bytes frame;
    append(frame, std::array<char, 2>{'P', 'A'});
    append(frame, sensor);
    append(frame, 'C');
    append(frame, error);
    append(frame, '\0');
    append(frame, std::uint16_t{40});
    payload.resize(40);
    frame.insert(frame.end(), payload.begin(), payload.end());
    return frame;
}

/// 60 Hz and centimetres.
Bytes pose_frame(const fuzz::ScriptedPose& pose, std::uint32_t counter) {
    Bytes payload;
    append(payload, counter * 50U / 3U);
    append(payload, counter);
    append(payload, static_cast<std::int32_t>(pose.distortion));
    for (const float metres : pose.position) {
        append(payload, metres * 100.0F);
    }
    append(payload, pose.quaternion);
    return framed(static_cast<std::uint8_t>(pose.sensor + 1), ' ', payload);
}

/// The answer that the session expects: a name, or that its units are centimetres.
std::string_view agreement(const Bytes& command) {
    return as_text(command).starts_with('U') ? "0U 1\r\n" : "Patriot\r\n";
}

void check_units_answer(std::string_view text) {
    const auto answer = tracker::patriot_units_answer(text);
    fuzz::require(!answer || *answer == 0 || *answer == 1, "units are inches or centimetres");
    fuzz::require(!answer || tracker::patriot_units_answer(std::string(text) + "1U0\r\n") == answer,
                  "what comes later changes no answer");
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tracker::PatriotSession session(tracker::UsbTrackerSetUp{});
    fuzz::SessionTalk talk(session);
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
        case Word::Line: {
            Bytes line = fuzz::take(script, script.read<std::uint8_t>());
            check_units_answer(as_text(line));
            append(line, '\n');
            talk.deliver(line);
            break;
        }
        case Word::Agree:
            talk.deliver(as_bytes(agreement(talk.command())));
            break;
        case Word::Pose: {
            const fuzz::ScriptedPose pose(script);
            counter += pose.step;
            talk.deliver(pose_frame(pose, counter));
            break;
        }
        case Word::Frame: {
            const auto sensor = script.read<std::uint8_t>();
            const auto error = script.read<char>();
            talk.deliver(framed(sensor, error, fuzz::take(script, 40)));
            break;
        }
        default:
            talk.cut(script.read<std::uint8_t>());
        }
    }
    check_units_answer(as_text(talk.wire()));
    fuzz::check_stream(talk.wire(), tracker::parse_patriot);
    return 0;
}
