// frustumscreen-bench room: its scene, its walks, its truth, and all of it in a small room.

#include "app/bench/room/room_bench.h"
#include "app/room/room_file.h"
#include "firmware_host/base/file.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

namespace frustumscreen::bench {
namespace {

/// Sources of which only the names and uses count.
std::vector<RoomSource> named_sources() {
    std::vector<RoomSource> sources;
    for (const auto& [name, use] :
         {std::pair("vase", PieceUse::Artifact), std::pair("cup", PieceUse::Artifact),
          std::pair("plinth", PieceUse::Plinth), std::pair("wall", PieceUse::Wall),
          std::pair("floor", PieceUse::Floor)}) {
        sources.push_back({name, use, nullptr, std::string(name) + ".fspack"});
    }
    return sources;
}

TEST(RoomScene, HasTheRequestedObjectsAndSurvivesARoundTrip) {
    const std::vector<RoomSource> sources = named_sources();
    for (const int objects : {min_room_objects, 57, 200}) {
        const room::Room made = make_room(sources, objects, 3);
        ASSERT_EQ(made.objects.size(), static_cast<std::size_t>(objects));
        const Result<room::Room> read = room::parse_room(room_toml(made), "room.toml");
        ASSERT_TRUE(read) << read.error().message;
        ASSERT_EQ(read->objects.size(), made.objects.size());
        for (std::size_t k = 0; k < made.objects.size(); ++k) {
            room::Object object = read->objects[k];
            EXPECT_EQ(read->packs[object.pack], made.packs[made.objects[k].pack]) << k;
            object.pack = made.objects[k].pack;
            if (!object.motion.moves()) {
                object.motion = made.objects[k].motion;
            }
            EXPECT_EQ(object, made.objects[k]) << k;
        }
    }
    EXPECT_EQ(make_room(sources, 57, 3).objects, make_room(sources, 57, 3).objects);
    EXPECT_NE(make_room(sources, 57, 3).objects, make_room(sources, 57, 4).objects);
}

TEST(RoomScene, SomeObjectsMoveAndNoneLeavesItsPlinth) {
    const room::Room room = make_room(named_sources(), 200, 1);
    const auto moving = std::count_if(room.objects.begin(), room.objects.end(),
                                      [](const room::Object& object) { return object.motion.moves(); });
    EXPECT_GT(moving, 30);
    EXPECT_LT(moving, 100);
    for (const room::Object& object : room.objects) {
        if (object.place_m.z > 0.0) {
            EXPECT_EQ(object.motion.sway_m, glm::dvec3(0.0)) << object.name;
        }
    }
}

TEST(RoomWalks, MoveTheEyeInEveryFrameInFrontOfTheScreen) {
    const settings::ScreenSettings screen;
    const std::vector<RoomWalk> walks = room_walks(screen, 600);
    ASSERT_EQ(walks.size(), 3U);
    for (const RoomWalk& walk : walks) {
        ASSERT_EQ(walk.frames.size(), 600U);
        for (std::size_t k = 0; k < walk.frames.size(); ++k) {
            EXPECT_LT(walk.frames[k].eye_m.y, screen.corners_m[0].y - 0.3) << walk.name << k;
            if (k > 0) { // no faster than a person
                const double step_m = glm::distance(walk.frames[k].eye_m, walk.frames[k - 1].eye_m);
                EXPECT_GT(step_m, 1e-4) << walk.name << k;
                EXPECT_LT(step_m, 2.5 / room_walk_hz) << walk.name << k;
            }
        }
    }
}

/// A vase and the plain pieces, baked small, once for all tests; a hall of ten objects.
class SmallRoom : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<TemporaryFolder>();
        Result<std::vector<RoomPiece>> pieces = make_room_pieces(1200);
        ASSERT_TRUE(pieces) << pieces.error().message;
        for (RoomPiece& piece : *pieces) {
            if (piece.use == PieceUse::Artifact && piece.name != "winding-vase") {
                continue;
            }
            const std::filesystem::path file = folder_->path() / (piece.name + ".fspack");
            ASSERT_TRUE(bake_piece(piece, file, 48));
            sources_.push_back({piece.name, piece.use,
                                std::make_shared<const bake::SourceMesh>(std::move(piece.mesh)), file});
        }
    }
    static void TearDownTestSuite() {
        sources_.clear();
        folder_.reset();
    }
    void SetUp() override {
        ASSERT_EQ(sources_.size(), 4U);
        room_ = make_room(sources_, 10, 1);
        settings_.screen = {.room = folder_->path() / "room.toml", .width = 160, .height = 90};
        ASSERT_TRUE(write_file(settings_.screen.room, as_bytes(room_toml(room_))));
    }
    [[nodiscard]] std::unique_ptr<RoomSet> open() const {
        Result<std::unique_ptr<RoomSet>> set = RoomSet::open(settings_, room_, sources_, {});
        EXPECT_TRUE(set) << set.error().message;
        return *std::move(set);
    }

    static inline std::unique_ptr<TemporaryFolder> folder_;
    static inline std::vector<RoomSource> sources_;
    settings::Settings settings_;
    room::Room room_;
};

TEST_F(SmallRoom, EveryTechniqueHasItsRowAndAnErrorThatIsFinite) {
    const std::unique_ptr<RoomSet> set = open();
    const RoomOptions options{.frames = 4, .passes = 1, .peer_every = 2, .errors = 2};
    const Result<RoomResult> result =
        measure_room(*set, room_walks(settings_.screen, 4), options, [](const std::string&, double) {});
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->objects, 10U);
    EXPECT_GT(result->triangles, 4'000U);
    std::set<std::string> names;
    for (const RoomRow& row : result->rows) {
        names.insert(row.technique);
        EXPECT_EQ(row.times.frames.size(), row.technique == "ours" ? 12U : 6U);
        EXPECT_GT(row.times.ms_p50(), 0.0) << row.technique;
        EXPECT_GE(row.times.ms_p99(), row.times.ms_p50()) << row.technique;
        EXPECT_NEAR(row.times.fps_min() * row.times.ms_p99(), 1e3, 1e-6) << row.technique;
        EXPECT_TRUE(std::isfinite(row.error.mean_mm)) << row.technique;
        EXPECT_GT(row.error.mean_mm, 0.0) << row.technique;
        EXPECT_LT(row.error.mean_mm, 60.0)
            << row.technique; // a hall that is elsewhere would be off by metres
    }
    EXPECT_EQ(names, (std::set<std::string>{"ours", "polygons", "relief", "lod", "paper"}));
    EXPECT_TRUE(room_csv(*result).starts_with(
        "technique,objects,triangles,ms_p50,ms_p99,fps_min,error_mm_mean\nours,10,"));
    ASSERT_EQ(result->paper.size(), 7U); // five machines, one without a limit, and ours
    for (const RoomPaperRow& row : result->paper) {
        EXPECT_TRUE(std::isfinite(row.error.mean_mm)) << row.polygons_s;
        if (row.technique == "paper" && row.polygons_s > 0.0) { // the paper's own limit
            EXPECT_LE(row.polygons_max, row.polygons_s / paper_min_fps);
        }
    }
}

TEST_F(SmallRoom, DetectsAnObjectDisplacedByACentimetre) {
    const std::unique_ptr<RoomSet> set = open();
    const std::vector<RoomWalk> walks = room_walks(settings_.screen, 2);
    const auto error_mm = [&](const room::Room& true_room) {
        const std::unique_ptr<RoomTruth> truth =
            RoomTruth::build(true_room, set->sources(), set->box_from_file()).value();
        const std::unique_ptr<RoomErrors> errors =
            RoomErrors::create(*set, *truth, walks, 2, [](double) {}).value();
        const std::unique_ptr<RoomTechnique> finest = make_room_polygons(*set, 0.0);
        return errors->measure(*finest, false).value();
    };
    const RoomError right = error_mm(room_);
    EXPECT_LT(right.p95_mm, 2.0); // apart from outlines, the finest level is the surface
    room::Room other = room_;
    other.objects.front().place_m.z += 0.01; // the floor, a large part of the picture
    const RoomError wrong = error_mm(other);
    EXPECT_GT(wrong.mean_mm, right.mean_mm + 5.0);
    EXPECT_GT(wrong.p95_mm, 10.0); // seen slantingly, it is off by more
    other = room_;
    other.objects.back().place_m.x += 0.01; // one artifact
    EXPECT_GT(error_mm(other).mean_mm, right.mean_mm + 0.01);
}

} // namespace
} // namespace frustumscreen::bench
