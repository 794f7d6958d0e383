// A HID tracker that sends arbitrary data: its feature report and its poses, with or without a corrected
// checksum.
#include "firmware_host/tracker/crc.h"
#include "firmware_host/tracker/hid_tracker_session.h"
#include "tests/fuzz/session_talk.h"

using namespace frustumscreen;

namespace {

enum class Word : std::uint8_t { Wait, Raw, Checked, Agree, Pose, Count };

Bytes checked(Bytes report) {
    append(report, tracker::crc16_arc(report));
    return report;
}

/// Version 1, 10 um, 100 Hz, the script's number of stations; one spare byte.
Bytes information(std::uint8_t stations) {
    Bytes report;
    append(report, tracker::hid_tracker_info_report);
    append(report, static_cast<std::uint8_t>(tracker::hid_tracker_version));
    append(report, std::uint16_t{10});
    append(report, std::uint16_t{100});
    append(report, stations);
    append(report, std::uint8_t{0});
    return checked(report);
}

Bytes pose_report(const fuzz::ScriptedPose& pose, std::uint32_t counter, std::uint8_t status) {
    Bytes report;
    append(report, std::uint8_t{1});
    append(report, static_cast<std::uint8_t>(pose.sensor + 1));
    append(report, status);
    append(report, pose.distortion);
    append(report, counter);
    append(report, counter * 10000U);
    for (const float metres : pose.position) {
        append(report, static_cast<std::int32_t>(metres * 1e5F));
    }
    for (const float component : pose.quaternion) {
        append(report, static_cast<std::int16_t>(std::isnan(component) ? 0.0F : component * 32767.0F));
    }
    return checked(report);
}

void check_codec(std::span<const std::byte> report) {
    const tracker::HidTrackerMessage message = tracker::parse_hid_tracker(report);
    if (const auto* pose = std::get_if<tracker::HidTrackerPose>(&message)) {
        fuzz::require_sound(pose->frame);
        fuzz::require(!pose->frame.sensors[0].usable || !(pose->frame.fault || pose->starting),
                      "a pose that the device disowns is not usable");
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tracker::HidTrackerSession session;
    fuzz::SessionTalk talk(session);
    std::uint32_t counter = 0;
    const auto deliver = [&](const Bytes& report) {
        check_codec(report);
        talk.deliver(report);
    };
    ByteReader script(fuzz::bytes_of(data, size));
    while (script.left() > 0 && !talk.over()) {
        switch (static_cast<Word>(script.read<std::uint8_t>() % static_cast<unsigned>(Word::Count))) {
        case Word::Wait:
            talk.wait(std::chrono::milliseconds(script.read<std::uint16_t>() % 512));
            break;
        case Word::Raw:
            deliver(fuzz::take(script, script.read<std::uint8_t>()));
            break;
        case Word::Checked:
            deliver(checked(fuzz::take(script, script.read<std::uint8_t>())));
            break;
        case Word::Agree:
            deliver(information(script.read<std::uint8_t>()));
            break;
        default: {
            const fuzz::ScriptedPose pose(script);
            counter += pose.step;
            deliver(pose_report(pose, counter, script.read<std::uint8_t>()));
        }
        }
    }
    return 0;
}
