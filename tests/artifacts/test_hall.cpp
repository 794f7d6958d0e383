// The contents of the example hall: its meshes, its room file, and its page.
#include "app/room/room_file.h"
#include "app/settings/settings.h"
#include "assets_baked/artifacts/builtin.h"
#include "assets_baked/artifacts/hall/hall.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/last_look.h"
#include "tests/base/text_of.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <tuple>
#include <utility>

namespace frustumscreen::artifacts {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

class EveryHallObject : public testing::TestWithParam<HallObject> {
protected:
    /// Each is made once for all tests.
    [[nodiscard]] static const bake::SourceMesh& made(std::int64_t triangles) {
        static std::map<std::pair<std::string_view, std::int64_t>, bake::SourceMesh> meshes;
        bake::SourceMesh& mesh = meshes[{GetParam().name, triangles}];
        if (mesh.triangles.empty()) {
            mesh = make_builtin(GetParam().name, triangles).value();
        }
        return mesh;
    }
};

/// How often each edge is run through in one direction more than in the other, by places: seams of the texture do not count.
std::map<Edge, int> edges_of(const bake::SourceMesh& mesh) {
    std::map<std::tuple<double, double, double>, std::uint32_t> numbers;
    std::vector<std::uint32_t> places;
    for (const glm::dvec3& p : mesh.positions) {
        places.push_back(
            numbers.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(numbers.size())).first->second);
    }
    std::map<Edge, int> balance;
    for (const auto& triangle : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = places[triangle[i]];
            const std::uint32_t b = places[triangle[(i + 1) % 3]];
            if (a != b) {
                balance[std::minmax(a, b)] += a < b ? 1 : -1;
            }
        }
    }
    return balance;
}

TEST_P(EveryHallObject, IsAValidMeshOfTheRequestedTriangles) {
    for (const std::int64_t triangles : {3'000, 12'000}) {
        const bake::SourceMesh& mesh = made(triangles);
        EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), static_cast<double>(triangles),
                    0.05 * static_cast<double>(triangles));
        ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
        ASSERT_EQ(mesh.textures.size(), 1U);
        EXPECT_LE(mesh.textures[0].image->width, 2048);
        for (const glm::dvec3& position : mesh.positions) {
            ASSERT_TRUE(std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z));
        }
        for (const glm::vec2& uv : mesh.uvs) {
            ASSERT_TRUE(uv.x >= 0.0F && uv.x <= 4.0F && uv.y >= 0.0F && uv.y <= 1.0F);
        }
    }
}

TEST_P(EveryHallObject, IsClosedAsDeclared) {
    const std::map<Edge, int> balance = edges_of(made(3'000));
    const bool closed =
        std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
    EXPECT_EQ(closed, GetParam().surface == HallSurface::Closed);
    for (const auto& [edge, sum] : balance) {
        EXPECT_LE(std::abs(sum), 1) << "two triangles run along an edge in the same direction";
    }
}

TEST_P(EveryHallObject, FacesOutward) {
    const bake::SourceMesh& mesh = made(3'000);
    if (GetParam().kind == HallKind::Building && GetParam().surface == HallSurface::Open) {
        // A sheet looks up, down, or to the front.
        const glm::dvec3 front = GetParam().name == "hall-floor"     ? glm::dvec3(0, 1, 0)
                                 : GetParam().name == "hall-ceiling" ? glm::dvec3(0, -1, 0)
                                                                     : glm::dvec3(0, 0, 1);
        glm::dvec3 sum(0.0);
        for (const auto& t : mesh.triangles) {
            sum += 0.5 * glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                    mesh.positions[t[2]] - mesh.positions[t[0]]);
        }
        EXPECT_GT(glm::dot(sum, front), 1e6) << "square millimetres";
        return;
    }
    double volume = 0.0;
    for (const auto& t : mesh.triangles) {
        volume +=
            glm::dot(mesh.positions[t[0]], glm::cross(mesh.positions[t[1]], mesh.positions[t[2]])) / 6.0;
    }
    EXPECT_GT(volume, 1e4) << "cubic millimetres";
}

TEST_P(EveryHallObject, BakesWithoutScraps) {
    const bake::SourceMesh& mesh = made(3'000);
    bake::BakeOptions options;
    options.size = 32;
    options.relief = false;
    options.unlit = GetParam().kind == HallKind::Building;
    options.measuring = 0.05;
    options.table_picture = false;
    const Result<pack::Pack> pack = bake::bake(mesh, options);
    ASSERT_TRUE(pack) << pack.error().message;
    EXPECT_FALSE(pack->levels.empty());
    EXPECT_EQ(bake::find_scraps(mesh).triangles, 0U);
}

INSTANTIATE_TEST_SUITE_P(Hall, EveryHallObject,
                         testing::ValuesIn(hall_objects().begin(), hall_objects().end()),
                         [](const auto& test) {
                             std::string name(test.param.name);
                             std::erase(name, '-');
                             return name;
                         });

std::string read(const std::string& file) {
    return text_of(source_dir() + "/" + file);
}

TEST(HallRoom, NamesExactlyThePacksThatRunBakes) {
    const Result<room::Room> hall = room::read_room(source_dir() + "/config/hall/room.toml");
    ASSERT_TRUE(hall) << hall.error().message;
    std::set<std::string> baked;
    for (const HallObject& object : hall_objects()) {
        baked.insert("out/packs/hall/" + std::string(object.name) + ".fspack");
    }
    const std::string run = read("run");
    EXPECT_NE(run.find("pack=out/packs/hall"), std::string::npos);
    for (const std::string_view name : builtin_names()) {
        EXPECT_NE(run.find("bake_builtin " + std::string(name)), std::string::npos);
        baked.insert("out/packs/" + std::string(name) + ".fspack");
    }
    std::set<std::string> named;
    for (const std::filesystem::path& pack : hall->packs) {
        named.insert(std::filesystem::relative(pack.lexically_normal(), source_dir()).string());
    }
    EXPECT_EQ(named, baked);
}

TEST(HallRoom, IsSymmetricWithTwoMovingObjectsBeforeTheScreen) {
    const Result<settings::CheckedSettings> settings =
        settings::load_settings(source_dir() + "/config/hall.toml");
    ASSERT_TRUE(settings) << settings.error().message;
    const Result<room::Room> hall = room::read_room((*settings)->screen.room);
    ASSERT_TRUE(hall) << hall.error().message;
    const std::array<glm::dvec3, 4>& corners = (*settings)->screen.corners_m;
    EXPECT_NEAR(glm::distance(corners[0], corners[1]), 1.2, 1e-9);
    EXPECT_NEAR(glm::distance(corners[0], corners[1]) / glm::distance(corners[0], corners[3]), 16.0 / 9.0,
                1e-9);
    std::size_t turning = 0;
    std::size_t before = 0;
    for (const room::Object& object : hall->objects) {
        const bool mirrored =
            std::any_of(hall->objects.begin(), hall->objects.end(), [&](const room::Object& other) {
                return glm::distance(other.place_m, object.place_m * glm::dvec3(-1, 1, 1)) < 1e-9;
            });
        EXPECT_TRUE(mirrored) << object.name << " has nothing at the other side of the aisle";
        turning += object.motion.moves() ? 1 : 0;
        before += object.motion.moves() && object.place_m.y < corners[0].y ? 1 : 0;
    }
    EXPECT_EQ(turning, 2U);
    EXPECT_EQ(before, 2U);
}

/// The keys that a reader asks for, from its source, are those of the page's table, whose defaults change nothing.
TEST(HallRoom, PageListsEachKeyWithItsDefault) {
    std::set<std::string> read_keys;
    const std::string source = read("app/room/room_file.cpp");
    static const std::regex asked(R"re(keys\.(?:text|path|vector|number|flag|integer)\("(\w+)")re");
    for (std::sregex_iterator match(source.begin(), source.end(), asked), end; match != end; ++match) {
        read_keys.insert((*match)[1]);
    }
    std::set<std::string> told;
    std::string all = "[[object]]\npack = \"a.fspack\"\n";
    const std::string page = read("docs/room.md");
    static const std::regex row(R"re(\n\| `(\w+)` \| (?:`([^`]*)`)?)re");
    for (std::sregex_iterator match(page.begin(), page.end(), row), end; match != end; ++match) {
        told.insert((*match)[1]);
        if ((*match)[2].length() > 0) {
            all += (*match)[1].str() + " = " + (*match)[2].str() + "\n";
        }
    }
    EXPECT_EQ(told, read_keys);
    const Result<room::Room> with_defaults = room::parse_room(all, "room.toml");
    const Result<room::Room> without = room::parse_room("[[object]]\npack = \"a.fspack\"\n", "room.toml");
    ASSERT_TRUE(with_defaults && without) << with_defaults.error().message;
    EXPECT_EQ(with_defaults->objects, without->objects);
}

} // namespace
} // namespace frustumscreen::artifacts
