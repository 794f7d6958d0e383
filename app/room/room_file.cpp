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

constexpr std::uintmax_t max_bytes = std::uintmax_t{8} << 20; ///< some 800 bytes for each object
constexpr std::size_t max_name_bytes = 80;
constexpr settings::Range in_the_room{-100.0, 100.0, "metres"};

/// An object as the file has it.
struct WrittenObject {
    Object object;
    std::filesystem::path pack;
    std::string pack_at; ///< as TableReader::place
    std::string name_at;
};

void read_motion(settings::TableReader& keys, Motion& motion) {
    keys.number("turns_per_minute", motion.turns_per_minute, {-60.0, 60.0, "turns a minute"});
    keys.vector("sway_m", motion.sway_m, in_the_room);
    keys.number("sway_s", motion.sway_s, {0.5, 3600.0, "seconds"});
}

void read_object(settings::TableReader& keys, WrittenObject& written) {
    Object& object = written.object;
    keys.text("name", object.name);
    written.name_at = keys.place("name");
    keys.path("pack", written.pack, {});
    written.pack_at = keys.place("pack");
    keys.vector("place_m", object.place_m, in_the_room);
    keys.number("turn_deg", object.turn_deg, {-360.0, 360.0, "degrees"});
    keys.number("size_m", object.size_m, {0.001, 100.0, "metres"});
    keys.text("artifact", object.artifact);
    read_motion(keys, object.motion);
}

/// Objects without a name get their pack's, and from the second one on a number that makes it their own.
void name_objects(std::vector<WrittenObject>& objects) {
    std::set<std::string> given;
    for (const WrittenObject& each : objects) {
        given.insert(each.object.name);
    }
    std::map<std::string, std::size_t> counts;
    for (WrittenObject& each : objects) {
        if (each.object.name.empty()) {
            const std::string stem = printable(each.pack.stem().string(), max_name_bytes);
            std::size_t& count = counts[stem];
            do {
                ++count;
                each.object.name = count == 1 ? stem : fmt::format("{}-{}", stem, count);
            } while (given.count(each.object.name) != 0);
        }
    }
}

/// The first object that has no pack, or another's name.
Result<void> check(const std::vector<WrittenObject>& objects) {
    std::map<std::string, std::string> names; ///< and where they are
    for (const WrittenObject& each : objects) {
        if (each.pack.empty()) {
            return bad_input("room.no_pack",
                             "{} is missing; name the object's pack, a file *.fspack from frustumscreen-bake",
                             each.pack_at);
        }
        const std::string& name = each.object.name;
        if (name.size() > max_name_bytes) {
            return bad_input("room.long_name", "{} has {} bytes; allowed are at most {}", each.name_at,
                             name.size(), max_name_bytes);
        }
        const auto [first, is_new] = names.emplace(name, each.name_at);
        if (!name.empty() && !is_new) {
            return bad_input("room.name_twice", "{} is \"{}\", as at {}; give each object a name of its own",
                             each.name_at, printable(name, 80), first->second);
        }
    }
    return {};
}

Result<Room> room_of(std::vector<WrittenObject> objects, const std::string& file) {
    if (objects.empty()) {
        return bad_input("room.empty",
                         "{}: object is missing; write at least one table [[object]] with its pack", file);
    }
    TRY_VOID(check(objects));
    name_objects(objects);
    Room room;
    std::map<std::filesystem::path, std::size_t> packs;
    for (WrittenObject& each : objects) {
        const auto [at, is_new] = packs.emplace(each.pack, room.packs.size());
        if (is_new) {
            room.packs.push_back(each.pack);
        }
        each.object.pack = at->second;
        room.objects.push_back(std::move(each.object));
    }
    if (room.packs.size() > max_packs) {
        return bad_input("room.packs",
                         "{}: its objects name {} different packs; allowed are at most {}: let objects share "
                         "packs",
                         file, room.packs.size(), max_packs);
    }
    return room;
}

Result<void> check_size(std::uintmax_t bytes, const std::string& file) {
    if (bytes > max_bytes) {
        return bad_input("room.too_large",
                         "{}: is {} bytes; allowed are at most {} bytes and {} objects: write fewer objects",
                         file, bytes, max_bytes, max_objects);
    }
    return {};
}

} // namespace

Result<Room> parse_room(std::string_view text, const std::filesystem::path& file) {
    settings::ReadState state{.file = printable(file.string(), 4096),
                              .folder = file.parent_path(),
                              .lines = {},
                              .error = std::nullopt};
    TRY_VOID(check_size(text.size(), state.file));
    std::vector<WrittenObject> objects;
    settings::read_toml(state, text, max_bytes, [&](const toml::table& root) {
        settings::TableReader keys(state, &root, "");
        keys.tables("object", objects, max_objects,
                    [](settings::TableReader& item, WrittenObject& object) { read_object(item, object); },
                    {});
        keys.finish();
    });
    if (state.error) {
        return as_kind(ErrorKind::BadInput, *std::move(state.error));
    }
    return room_of(std::move(objects), state.file);
}

Result<Room> read_room(const std::filesystem::path& file) {
    std::error_code failed;
    if (const std::uintmax_t bytes = std::filesystem::file_size(file, failed); !failed) {
        TRY_VOID(check_size(bytes, printable(file.string(), 4096)));
    }
    TRY(const Bytes bytes, read_file(file, max_bytes));
    return parse_room(as_text(bytes), file);
}

} // namespace frustumscreen::room
