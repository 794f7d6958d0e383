#include "app/room/room_file.h"

#include "app/settings/range.h"
#include "app/settings/toml_file.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace frustumscreen::room {

namespace {

constexpr std::uintmax_t max_bytes = std::uintmax_t{4} << 20; ///< some 400 bytes for each object
constexpr settings::Range in_the_room{-100.0, 100.0, "metres"};

/// An object as the file has it.
struct WrittenObject {
    Object object;
    std::filesystem::path pack;
};

void read_motion(settings::TableReader& keys, Motion& motion) {
    keys.number("turns_per_minute", motion.turns_per_minute, {-60.0, 60.0, "turns a minute"});
    keys.vector("sway_m", motion.sway_m, in_the_room);
    keys.number("sway_s", motion.sway_s, {0.5, 3600.0, "seconds"});
}

void read_object(settings::TableReader& keys, WrittenObject& written) {
    Object& object = written.object;
    keys.text("name", object.name);
    keys.path("pack", written.pack, {});
    keys.require("room.no_pack", !written.pack.empty(), "pack",
                 "is missing; name the object's pack, a file *.fspack from frustumscreen-bake");
    keys.vector("place_m", object.place_m, in_the_room);
    keys.number("turn_deg", object.turn_deg, {-360.0, 360.0, "degrees"});
    keys.number("size_m", object.size_m, {0.001, 100.0, "metres"});
    keys.text("artifact", object.artifact);
    read_motion(keys, object.motion);
}

/// Objects without a name get their pack's, and a number from the second one on.
void name_objects(std::vector<WrittenObject>& objects) {
    std::map<std::string, std::size_t> counts;
    for (WrittenObject& each : objects) {
        if (each.object.name.empty()) {
            const std::string stem = printable(each.pack.stem().string(), 80);
            const std::size_t count = ++counts[stem];
            each.object.name = count == 1 ? stem : fmt::format("{}-{}", stem, count);
        }
    }
}

Result<Room> room_of(std::vector<WrittenObject> objects, const std::string& file) {
    name_objects(objects);
    Room room;
    std::map<std::filesystem::path, std::size_t> packs;
    std::set<std::string> names;
    for (WrittenObject& each : objects) {
        if (!names.insert(each.object.name).second) {
            return bad_input("room.name_twice",
                             "{}: two objects have the name \"{}\"; give each a name of its own", file,
                             each.object.name);
        }
        const auto [at, is_new] = packs.emplace(each.pack, room.packs.size());
        if (is_new) {
            room.packs.push_back(each.pack);
        }
        each.object.pack = at->second;
        room.objects.push_back(std::move(each.object));
    }
    if (room.packs.size() > max_packs) {
        return bad_input("room.packs", "{}: its objects name {} different packs; allowed are at most {}",
                         file, room.packs.size(), max_packs);
    }
    return room;
}

} // namespace

Result<Room> parse_room(std::string_view text, const std::filesystem::path& file) {
    settings::ReadState state{.file = printable(file.string(), 4096),
                              .folder = file.parent_path(),
                              .lines = {},
                              .error = std::nullopt};
    std::vector<WrittenObject> objects;
    settings::read_toml(state, text, max_bytes, [&](const toml::table& root) {
        settings::TableReader keys(state, &root, "");
        keys.tables("object", objects, max_objects,
                    [](settings::TableReader& item, WrittenObject& object) { read_object(item, object); },
                    {});
        keys.require("room.empty", !objects.empty(), "object",
                     "is missing; a room has at least one table [[object]]");
        keys.finish();
    });
    if (state.error) {
        return as_kind(ErrorKind::BadInput, *std::move(state.error));
    }
    return room_of(std::move(objects), state.file);
}

Result<Room> read_room(const std::filesystem::path& file) {
    TRY(const Bytes bytes, read_file(file, max_bytes));
    return parse_room(as_text(bytes), file);
}

} // namespace frustumscreen::room
