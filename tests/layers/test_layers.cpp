// Compares every #include of the project with the rooms' declared dependencies (cmake/rooms.cmake).
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Rooms = std::set<std::string>;

struct Include {
    std::string file; ///< relative to the root
    int line = 0;
    std::string header;
    bool quoted = false;
};

struct Table {
    std::map<std::string, std::string> room_of_place; ///< folder or file -> room
    std::map<std::string, Rooms> uses;                ///< closed transitively

    /// The room with the longest place that `path` lies in; empty if none.
    [[nodiscard]] std::string room_of(const std::string& path) const {
        std::string room;
        std::size_t longest = 0;
        for (const auto& [place, owner] : room_of_place) {
            const bool inside = path == place || path.compare(0, place.size() + 1, place + "/") == 0;
            if (inside && place.size() >= longest) {
                longest = place.size();
                room = owner;
            }
        }
        return room;
    }
};

void close(std::map<std::string, Rooms>& uses) {
    for (bool changed = true; changed;) {
        changed = false;
        for (auto& [room, used] : uses) {
            Rooms more = used;
            for (const std::string& other : used) {
                more.insert(uses[other].begin(), uses[other].end());
            }
            changed = changed || more.size() != used.size();
            used = more;
        }
    }
}

Table read_table() {
    Table table;
    std::ifstream file(frustumscreen::build_dir() + "/tests/layers/layers.txt");
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string kind;
        std::string room;
        words >> kind >> room;
        if (kind == "place") {
            std::string place;
            words >> place;
            table.room_of_place[place] = room;
        }
        if (kind == "uses") {
            table.uses[room].insert(std::istream_iterator<std::string>(words),
                                    std::istream_iterator<std::string>());
        }
    }
    close(table.uses);
    return table;
}

std::vector<Include> includes_below(const std::string& folder) {
    const fs::path root = frustumscreen::source_dir();
    std::vector<Include> includes;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
        const std::string extension = entry.path().extension();
        if (extension != ".h" && extension != ".cpp") {
            continue;
        }
        std::ifstream file(entry.path());
        int number = 0;
        for (std::string line; std::getline(file, line);) {
            ++number;
            const std::size_t start = line.find_first_of("<\"");
            if (line.rfind("#include", 0) == 0 && start != std::string::npos) {
                const std::size_t end = line.find_first_of(">\"", start + 1);
                includes.push_back({fs::relative(entry.path(), root).string(), number,
                                    line.substr(start + 1, end - start - 1), line[start] == '"'});
            }
        }
    }
    EXPECT_FALSE(includes.empty()) << folder;
    return includes;
}

std::vector<Include> includes_of_the_house() {
    std::vector<Include> all;
    for (const std::string folder : {"app", "firmware_host", "assets_baked"}) {
        const std::vector<Include> some = includes_below(folder);
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

bool starts_with(const std::string& text, const std::string& start) {
    return text.rfind(start, 0) == 0;
}

/// A library's headers, and the only rooms (or files) that may include them.
struct Guard {
    std::string header; ///< beginning of its name
    std::vector<std::string> places;
};

const std::vector<Guard> guards = {
    {"GLES",
     {"app/render/", "app/bench/", "firmware_host/display/", "firmware_host/gl/", "firmware_host/window/"}},
    {"EGL/", {"firmware_host/display/"}},
    {"GL/", {}},
    {"gbm.h", {"firmware_host/display/"}},
    {"xf86drm", {"firmware_host/display/"}},
    {"libudev", {"firmware_host/display/"}},
    {"libxcvt/", {"firmware_host/display/"}},
    {"SDL", {"firmware_host/window/"}},
    {"libusb", {"firmware_host/tracker/"}},
    {"hidapi", {"firmware_host/tracker/"}},
    {"gpiod", {"firmware_host/panel/"}},
    {"libevdev", {"firmware_host/panel/"}},
    {"linux/input", {"firmware_host/panel/"}},
    {"linux/videodev2", {"firmware_host/camera/"}},
    {"apriltag/", {"firmware_host/tags/"}},
    {"qrencode", {"app/show/"}},
    {"turbojpeg", {"firmware_host/camera/", "assets_baked/bake/"}},
    {"systemd/", {"firmware_host/service/"}},
    {"alsa/", {"firmware_host/sound/"}},
    {"opusfile", {"firmware_host/sound/"}},
    {"embree", {"assets_baked/bake/", "app/bench/"}},
    {"draco/", {"assets_baked/bake/"}},
    {"tiny_obj_loader", {"assets_baked/bake/"}},
    {"meshoptimizer", {"assets_baked/bake/", "app/bench/"}},
    {"toml++", {"app/settings/", "assets_baked/texts/", "assets_baked/safe/"}},
    {"pango/", {"assets_baked/texts/"}},
    {"fontconfig/", {"assets_baked/texts/"}},
    {"hb", {}},
    {"sndfile", {"assets_baked/texts/"}},
    {"samplerate", {"assets_baked/texts/"}},
    {"ebur128", {"assets_baked/texts/"}},
    {"unzip.h", {"app/pack/"}},
    {"zip.h", {"app/pack/"}},
    {"minizip/", {"app/pack/"}},
    {"sodium", {"app/pack/", "app/programs/"}},
    {"CLI/", {"app/programs/"}},
};

} // namespace

TEST(Layers, TableContainsTheRooms) {
    const Table table = read_table();
    for (const std::string room : {"base", "geometry", "pack", "settings", "render", "bake", "artifacts"}) {
        EXPECT_TRUE(table.uses.contains(room)) << room;
    }
    EXPECT_EQ(table.room_of("assets_baked/bake/loaders/text.h"), "loaders");
    EXPECT_EQ(table.room_of("assets_baked/bake/source_mesh.h"), "source_mesh");
    EXPECT_EQ(table.room_of("assets_baked/bake/bake.h"), "bake");
}

TEST(Layers, EveryIncludeIsAllowedByTheTable) {
    const Table table = read_table();
    for (const Include& include : includes_of_the_house()) {
        if (!include.quoted) {
            continue;
        }
        const std::string from = table.room_of(include.file);
        const std::string to = table.room_of(include.header);
        ASSERT_FALSE(from.empty()) << include.file << " lies in no room";
        if (from != to && !table.uses.at(from).contains(to)) {
            ADD_FAILURE() << include.file << ":" << include.line << ": room '" << from
                          << "' may not include \"" << include.header << "\" of room '" << to << "'";
        }
    }
}

TEST(Layers, QuotedIncludesAreRelativeToTheRoot) {
    for (const Include& include : includes_of_the_house()) {
        if (include.quoted) {
            EXPECT_TRUE(fs::exists(fs::path(frustumscreen::source_dir()) / include.header))
                << include.file << ":" << include.line << ": " << include.header;
        }
    }
}

TEST(Layers, HostDoesNotIncludeTheExhibit) {
    for (const Include& include : includes_below("firmware_host")) {
        EXPECT_FALSE(starts_with(include.header, "app/") || starts_with(include.header, "assets_baked/"))
            << include.file << ":" << include.line;
    }
}

TEST(Layers, KioskDoesNotUseTheBake) {
    const Table table = read_table();
    for (const std::string room : {"geometry", "tracking", "pack", "settings", "scene", "exhibit", "render",
                                   "image", "show", "simulation"}) {
        const auto found = table.uses.find(room);
        ASSERT_NE(found, table.uses.end()) << room;
        for (const std::string below : {"bake", "loaders", "artifacts", "texts", "source_mesh", "bench"}) {
            EXPECT_FALSE(found->second.contains(below)) << room << " uses " << below;
        }
    }
}

TEST(Layers, ProgramOfTheKioskLinksNoLibraryOfTheBake) {
    std::ifstream file(frustumscreen::bin_dir() + "/frustumscreen", std::ios::binary);
    if (!file) {
        GTEST_SKIP() << "the program frustumscreen is not built";
    }
    std::ostringstream copy;
    copy << file.rdbuf(); // a sanitized program is large
    const std::string bytes = copy.str();
    for (const std::string library :
         {"libembree3.so", "libdraco.so", "libmeshoptimizer.so", "libSDL2", "libpango", "libharfbuzz",
          "libfontconfig", "libsndfile", "libebur128"}) {
        EXPECT_EQ(bytes.find(library), std::string::npos) << library;
    }
}

/// Only people sign, on their own computers: the kiosk's programs have no code for secret keys.
TEST(Layers, ProgramsOfTheKioskHaveNoCodeForSecretKeys) {
    int looked_at = 0;
    for (const std::string program : {"frustumscreen", "frustumscreen-import", "frustumscreen-pack"}) {
        std::ifstream file(frustumscreen::bin_dir() + "/" + program, std::ios::binary);
        std::ostringstream copy;
        copy << file.rdbuf();
        const bool holds = copy.str().find("crypto_pwhash_scryptsalsa208sha256") != std::string::npos;
        const bool is_built = copy.str().size() > 1000;
        looked_at += is_built ? 1 : 0;
        EXPECT_EQ(holds, is_built && program == "frustumscreen-pack") << program;
    }
    if (looked_at == 0) {
        GTEST_SKIP() << "none of the programs is built";
    }
}

TEST(Layers, LibrariesStayInTheirAdapters) {
    for (const Include& include : includes_of_the_house()) {
        for (const Guard& guard : guards) {
            if (include.quoted || !starts_with(include.header, guard.header)) {
                continue;
            }
            const bool allowed =
                std::any_of(guard.places.begin(), guard.places.end(),
                            [&](const std::string& place) { return starts_with(include.file, place); });
            EXPECT_TRUE(allowed) << include.file << ":" << include.line << ": <" << include.header << ">";
        }
    }
}
