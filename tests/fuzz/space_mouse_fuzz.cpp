// A SpaceMouse that sends arbitrary data: the prop always stays on or above the table.
#include "firmware_host/tracker/space_mouse_session.h"
#include "tests/fuzz/session_talk.h"

using namespace frustumscreen;

namespace {

constexpr glm::dvec2 table_half_m{0.4, 0.25};

void require_on_table(const tracker::PoseSample& sample) {
    const glm::dvec3& p = sample.position_m;
    fuzz::require(std::abs(p.x) <= table_half_m.x && std::abs(p.y) <= table_half_m.y && p.z >= 0.0 &&
                      p.z <= tracker::SpaceMouseSession::highest_m,
                  "the prop stays on and above the table");
}

} // namespace

/// Input: u16 milliseconds, u8 length, the report; repeated.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tracker::SpaceMouseSession session(table_half_m);
    fuzz::SessionTalk talk(session, require_on_table);
    ByteReader script(fuzz::bytes_of(data, size));
    while (script.left() > 0 && !talk.over()) {
        talk.wait(std::chrono::milliseconds(script.read<std::uint16_t>() % 2048));
        talk.deliver(fuzz::take(script, script.read<std::uint8_t>() % 24));
    }
    return 0;
}
