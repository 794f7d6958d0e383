// Rooms: refused in one line that begins with the file's name, or objects within the ranges, each with a pack and with a name of its
// own, and finite at every time.
#include "app/room/room_file.h"
#include "tests/fuzz/fuzz.h"

#include <set>

using namespace frustumscreen;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Result<room::Room> room = room::parse_room(fuzz::text_of(data, size), "hall/room.toml");
    if (!room) {
        fuzz::require(room.error().message.starts_with("hall/room.toml:"), "a message names the file",
                      room.error().message);
        fuzz::require_one_line(room.error().message);
        return 0;
    }
    fuzz::require(!room->objects.empty() && room->objects.size() <= room::max_objects, "it has objects");
    fuzz::require(!room->packs.empty() && room->packs.size() <= room::max_packs, "it has packs");
    const std::set<std::filesystem::path> packs(room->packs.begin(), room->packs.end());
    fuzz::require(packs.size() == room->packs.size() && packs.count({}) == 0, "a pack is listed once");
    std::set<std::string> names;
    std::set<std::size_t> used;
    for (const room::Object& object : room->objects) {
        fuzz::require(!object.name.empty() && names.insert(object.name).second, "a name is an object's own",
                      object.name);
        fuzz::require(object.pack < room->packs.size(), "a pack is in the list");
        used.insert(object.pack);
        fuzz::require(object.size_m >= 0.001 && object.size_m <= 100.0, "a size is in its range");
        for (const double seconds : {0.0, 1e-9, 3600.5, 1e9}) {
            const geometry::RigidTransform at = room::table_from_object(object, seconds);
            fuzz::require(fuzz::is_finite(at.translation) && fuzz::is_unit(at.rotation), "a place is a pose");
            fuzz::require(glm::length(at.translation) < 400.0, "a place is in the room");
        }
    }
    fuzz::require(used.size() == room->packs.size(), "a listed pack is used");
    return 0;
}
