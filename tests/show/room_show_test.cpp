// The picture of the screen behind the table: what is drawn of a room, from where, and in whose memory.

#include "app/pack/pack_file.h"
#include "app/pack/pack_relief.h"
#include "app/render/read_back.h"
#include "app/residency/run_levels.h"
#include "app/show/room_show.h"
#include "firmware_host/base/file.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/base/comes_true.h"
#include "tests/base/temporary_folder.h"
#include "tests/render/counted_new.h"
#include "tests/render/interlocked.h"
#include "tests/render/ring_relief.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>
#include <vector>

namespace frustumscreen::synthetic {
namespace {

constexpr int width = 160;
constexpr int height = 90;

/// A box of one colour, closed.
pack::Pack box_pack(const glm::dvec3& size, const glm::u8vec4& colour) {
    pack::Pack pack = pack_of(box(size));
    pack.textures[0] = image::Image8(64, 64, colour);
    pack.levels[0].error = {1e-5F, 1e-5F, 1e-5F, 0.0F};
    pack.title = "A box";
    complete(pack);
    return pack;
}

/// Rings at three levels whose errors are 4, 1 and 0.1 thousandths of the box.
pack::Pack ring_pack() {
    pack::Pack pack = rings(32, 16);
    for (const auto& [around, error] : {std::pair(16U, 1e-3F), std::pair(10U, 4e-3F)}) {
        const pack::Pack coarse = rings(around, around / 2);
        pack.levels.insert(pack.levels.begin(), coarse.levels[0]);
        pack.levels[0].error = {error, error, error, 0.0F};
    }
    pack.levels[2].error = {1e-4F, 1e-4F, 1e-4F, 0.0F};
    pack.title = "Rings";
    complete(pack);
    return pack;
}

/// So that the processor rasterizes it.
pack::Pack with_reliefs(pack::Pack pack, const std::vector<int>& texels) {
    pack::Pack source = pack;
    source.levels = {pack.levels.back()};
    std::vector<pack::MeasuredRelief> reliefs;
    for (const int each : texels) {
        const float error = 0.2F / static_cast<float>(each);
        reliefs.push_back({*relief_of(source, each), {error, error, error, 0.0F}});
    }
    pack::put_reliefs(pack, reliefs);
    return pack;
}

class Shown {
public:
    /// The room's text names its packs by file.
    void pack(const std::string& name, const pack::Pack& pack) const {
        static_cast<void>(write_file(folder_.path() / name, pack::write_pack(pack).value()));
    }
    [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
    void object(const std::string& pack, const glm::dvec3& at, double size_m, double turn_deg = 0.0,
                const std::string& motion = "") {
        text_ +=
            fmt::format("[[object]]\npack = \"{}\"\nplace_m = [{}, {}, {}]\nsize_m = {}\nturn_deg = {}\n{}\n",
                        pack, at.x, at.y, at.z, size_m, turn_deg, motion);
    }
    /// With the objects so far. Returns what it says.
    Result<void> open(show::RoomShowOptions options, int memory_mb = 192) {
        static_cast<void>(write_file(folder_.path() / "room.toml", as_bytes(text_)));
        settings::Settings settings;
        settings.screen.room = folder_.path() / "room.toml";
        settings.screen.width = width;
        settings.screen.height = height;
        settings.exhibit.memory_mb = memory_mb;
        settings.render.error_tolerance_px = 0.125;
        show.reset();
        TRY(show, show::RoomShow::create(settings, options));
        return {};
    }
    void draw(double seconds, const glm::dvec3& eye) {
        static_cast<void>(show->draw(seconds, std::span(&eye, 1),
                                     {display->framebuffer(), display->buffer_age()},
                                     render::Redraw::Everything));
        static_cast<void>(display->present(MonotonicTime{}));
    }
    image::Image8 picture(double seconds, const glm::dvec3& eye) {
        draw(seconds, eye);
        return render::read_colour(display->framebuffer(), width, height);
    }

private:
    TemporaryFolder folder_;
    std::string text_;

public:
    std::unique_ptr<display::SurfacelessDisplay> display =
        display::SurfacelessDisplay::create(width, height).value();
    std::unique_ptr<show::RoomShow> show; ///< uses the display's context
};

/// The place of a pixel on the usual settings' screen.
glm::dvec3 pixel_on(double x, double y) {
    return {-0.6 + 1.2 * x / width, 0.7, 0.85 - 0.675 * y / height};
}

TEST(RoomShow, DrawsInterlockingBoxesPixelExact) {
    const std::array<glm::u8vec4, 3> colours{{{250, 0, 0, 255}, {0, 250, 0, 255}, {0, 0, 250, 255}}};
    const std::array<glm::dvec3, 3> sizes{{{1.0, 0.3, 0.4}, {0.3, 1.0, 0.5}, {0.4, 0.4, 1.0}}};
    Shown shown;
    std::vector<room::Object> objects;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (std::size_t k = 0; k < 3; ++k) {
        shown.pack(fmt::format("{}.fspack", k), box_pack(sizes[k], colours[k]));
    }
    for (int k = 0; k < 12; ++k) {
        room::Object& object = objects.emplace_back();
        object.pack = static_cast<std::size_t>(k % 3);
        object.place_m = {0.5 * u(random), 1.2 + 0.6 * u(random), 0.3 + 0.2 * u(random)};
        object.turn_deg = std::round(180.0 * u(random));
        object.size_m = 0.4;
        shown.object(fmt::format("{}.fspack", object.pack), object.place_m, object.size_m, object.turn_deg);
    }
    ASSERT_TRUE(shown.open({.samples = 1}));
    std::size_t checked = 0;
    for (int pose = 0; pose < 20; ++pose) {
        const glm::dvec3 eye(0.6 * u(random), -0.5 + 0.5 * u(random), 0.6 + 0.4 * u(random));
        const image::Image8 picture = shown.picture(0.0, eye);
        image::Image<int> first(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const glm::dvec3 at = pixel_on(x + 0.5, y + 0.5);
                double nearest = std::numeric_limits<double>::infinity();
                first.at(x, y) = -1;
                for (const room::Object& object : objects) {
                    const geometry::RigidTransform own = room::table_from_object(object, 0.0).inverse();
                    const glm::dvec3 from = own.point(eye);
                    const glm::dvec3 ray = own.point(at) - from;
                    const glm::dvec3 half = 0.5 * object.size_m * sizes[object.pack];
                    double begin = 0.0;
                    double end = std::numeric_limits<double>::infinity();
                    for (int axis = 0; axis < 3; ++axis) {
                        const double middle = axis == 2 ? half.z : 0.0;
                        const double one = (middle - half[axis] - from[axis]) / ray[axis];
                        const double other = (middle + half[axis] - from[axis]) / ray[axis];
                        begin = std::max(begin, std::min(one, other));
                        end = std::min(end, std::max(one, other));
                    }
                    if (begin <= end && begin < nearest) {
                        nearest = begin;
                        first.at(x, y) = static_cast<int>(object.pack);
                    }
                }
            }
        }
        for (int y = 1; y + 1 < height; ++y) {
            for (int x = 1; x + 1 < width; ++x) {
                bool same = true; // all around: no edge runs through the pixel
                for (int k = 0; k < 9; ++k) {
                    same = same && first.at(x + k % 3 - 1, y + k / 3 - 1) == first.at(x, y);
                }
                if (same) {
                    const int hit = first.at(x, y);
                    const glm::u8vec4 want =
                        hit < 0 ? glm::u8vec4(0, 0, 0, 255) : colours[static_cast<std::size_t>(hit)];
                    ASSERT_EQ(glm::u8vec3(picture.at(x, y)), glm::u8vec3(want))
                        << pose << ": " << x << ", " << y;
                    checked += hit >= 0 ? 1 : 0;
                }
            }
        }
    }
    EXPECT_GT(checked, 20'000U);
}

TEST(RoomShow, CullingHiddenObjectsChangesNoPixel) {
    std::array<std::unique_ptr<Shown>, 2> both{std::make_unique<Shown>(), std::make_unique<Shown>()};
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (const auto& shown : both) {
        // The rasterizer's pixels do not depend on what else is drawn; a driver's depths and edges do.
        shown->pack("wall.fspack", with_reliefs(box_pack({1.0, 0.05, 0.5}, {200, 200, 180, 255}), {32}));
        shown->pack("rings.fspack", with_reliefs(ring_pack(), {32}));
    }
    const auto add = [&](const std::string& pack, const glm::dvec3& at, double size_m, double turn_deg) {
        both[0]->object(pack, at, size_m, turn_deg);
        both[1]->object(pack, at, size_m, turn_deg);
    };
    add("wall.fspack", {-0.8, 1.5, -0.2}, 2.4, 10.0);
    add("wall.fspack", {0.9, 2.6, -0.2}, 2.8, -15.0);
    for (int k = 0; k < 40; ++k) {
        add("rings.fspack", {1.6 * u(random), 2.2 + 1.2 * u(random) + (k % 2), 0.35 + 0.35 * u(random)}, 0.15,
            180.0 * u(random));
    }
    ASSERT_TRUE(both[0]->open({.samples = 1, .culls = true}));
    std::size_t hidden = 0;
    std::vector<image::Image8> culled;
    std::vector<glm::dvec3> eyes;
    for (int pose = 0; pose < 200; ++pose) {
        eyes.emplace_back(0.8 * u(random), -0.6 + 0.6 * u(random), 0.6 + 0.4 * u(random));
        culled.push_back(both[0]->picture(10.0 * pose, eyes.back()));
        hidden += both[0]->show->counts().in_view - both[0]->show->counts().seen;
    }
    EXPECT_GT(hidden, 1000U) << "or the test tries nothing";
    ASSERT_TRUE(both[1]->open({.samples = 1, .culls = false}));
    for (std::size_t pose = 0; pose < eyes.size(); ++pose) {
        const image::Image8 all = both[1]->picture(10.0 * static_cast<double>(pose), eyes[pose]);
        std::size_t other = 0;
        for (std::size_t k = 0; k < all.texels.size(); ++k) {
            other += all.texels[k] != culled[pose].texels[k] ? 1 : 0;
        }
        EXPECT_EQ(other, 0U) << pose;
    }
}

TEST(RoomShow, DrawsMovingObjectsAtTheirCurrentPlace) {
    Shown moving;
    Shown still;
    moving.pack("rings.fspack", ring_pack());
    still.pack("rings.fspack", ring_pack());
    moving.object("rings.fspack", {0.1, 1.2, 0.3}, 0.3, 20.0,
                  "turns_per_minute = 5.0\nsway_m = [0.2, 0.0, 0.0]\nsway_s = 8.0");
    still.object("rings.fspack", {0.3, 1.2, 0.3}, 0.3,
                 80.0); // after 2 s: a sixth of a turn, the end of the sway
    const glm::dvec3 eye(0.0, -0.6, 0.7);
    ASSERT_TRUE(moving.open({}));
    static_cast<void>(moving.picture(0.0, eye));
    const image::Image8 then = moving.picture(2.0, eye);
    ASSERT_TRUE(still.open({}));
    const image::Image8 there = still.picture(0.0, eye);
    std::size_t other = 0;
    for (std::size_t k = 0; k < then.texels.size(); ++k) {
        for (int channel = 0; channel < 3; ++channel) {
            other += std::abs(then.texels[k][channel] - there.texels[k][channel]) > 2 ? 1 : 0;
        }
    }
    EXPECT_LE(other, 3U) << "sin and cos are rounded";
}

TEST(RoomShow, FadesAnObjectBetweenLevels) {
    Shown shown;
    shown.pack("rings.fspack", ring_pack());
    shown.object("rings.fspack", {0.0, 4.0, 0.3}, 0.5);
    shown.object("rings.fspack", {3.0, -3.0, 0.3}, 0.5); // out of the picture
    ASSERT_TRUE(shown.open({}));
    shown.draw(0.0, {0.0, -6.0, 0.7});
    EXPECT_EQ(shown.show->counts().drawn, 1U);
    EXPECT_EQ(shown.show->counts().fading, 0U) << "the first picture";
    const double far_mm = shown.show->error_mm();
    shown.draw(1.0, {0.0, 0.0, 0.7});
    ASSERT_EQ(shown.show->counts().fading, 1U);
    shown.draw(1.0 + 0.25 * residency::level_fade_s, {0.0, 0.0, 0.7});
    const std::vector<scene::Draw>& draws = shown.show->plans().front().draws;
    ASSERT_EQ(draws.size(), 2U);
    EXPECT_TRUE(draws[0].shader.dithered && draws[1].shader.dithered);
    EXPECT_NE(draws[0].dither.complement, draws[1].dither.complement);
    EXPECT_FLOAT_EQ(draws[0].dither.share, 0.25F);
    EXPECT_FLOAT_EQ(draws[1].dither.share, 0.25F);
    shown.draw(1.1 + residency::level_fade_s, {0.0, 0.0, 0.7});
    EXPECT_EQ(shown.show->counts().fading, 0U);
    EXPECT_EQ(shown.show->plans().front().draws.size(), 1U);
    EXPECT_GT(shown.show->error_mm(), far_mm) << "nearer to the screen a pixel is a wider angle";
}

TEST(RoomShow, AllowsALargerErrorWhenTheTimeBudgetIsShort) {
    Shown shown;
    shown.pack("rings.fspack", ring_pack());
    for (int k = 0; k < 16; ++k) {
        shown.object("rings.fspack", {-0.6 + 0.08 * k, 0.9, 0.1}, 0.8);
    }
    ASSERT_TRUE(shown.open({}));
    const glm::dvec3 eye(0.0, 0.0, 0.6);
    shown.draw(0.0, eye);
    const double best_mm = shown.show->error_mm();
    EXPECT_FALSE(shown.show->counts().is_short);
    shown.show->set_budget(9'400.0); // the picture itself takes 8 ms of these
    shown.draw(1.0, eye);
    shown.draw(2.0, eye);
    EXPECT_TRUE(shown.show->counts().is_short);
    EXPECT_GT(shown.show->error_mm(), best_mm);
    shown.show->set_budget(1e6);
    shown.draw(3.0, eye);
    shown.draw(4.0, eye);
    EXPECT_DOUBLE_EQ(shown.show->error_mm(), best_mm);
}

TEST(RoomShow, RepeatingAWalkAllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    Shown shown;
    shown.pack("rings.fspack", ring_pack());
    shown.pack("wall.fspack", box_pack({1.0, 0.05, 0.5}, {200, 200, 180, 255}));
    shown.object("wall.fspack", {-0.8, 1.5, -0.2}, 2.4, 10.0);
    for (int k = 0; k < 30; ++k) {
        shown.object("rings.fspack", {-1.5 + 0.1 * k, 1.0 + 0.1 * k, 0.4}, 0.2, 10.0 * k,
                     k % 3 == 0 ? "turns_per_minute = 10.0" : "");
    }
    ASSERT_TRUE(shown.open({}));
    const auto walk = [&](double from_s) {
        long allocated = 0;
        for (int frame = 0; frame < 40; ++frame) {
            const glm::dvec3 eye(-0.5 + 0.025 * frame, -1.0 + 0.02 * frame, 0.7);
            const long before = allocations_so_far();
            static_cast<void>(shown.show->draw(from_s + frame / 20.0, std::span(&eye, 1),
                                               {shown.display->framebuffer(), shown.display->buffer_age()},
                                               render::Redraw::Everything));
            allocated += allocations_so_far() - before;
            static_cast<void>(shown.display->present(MonotonicTime{}));
        }
        return allocated;
    };
    EXPECT_GT(walk(0.0), 0) << "or nothing is counted";
    EXPECT_EQ(walk(60.0), 0); // ten turns later
}

TEST(RoomShow, LoadsTheNearestFirstWithinItsMemory) {
    Shown shown;
    for (int k = 0; k < 8; ++k) {
        shown.pack(fmt::format("{}.fspack", k), ring_pack());
        shown.object(fmt::format("{}.fspack", k), {0.02 * k, 1.0 + 0.5 * k, 0.4}, 0.2);
    }
    ASSERT_TRUE(shown.open({}));
    const glm::dvec3 eye(0.0, -0.5, 0.7);
    shown.draw(0.0, eye);
    EXPECT_EQ(shown.show->counts().drawn, 8U);
    const std::span<const std::string> loaded = shown.show->models().loaded();
    ASSERT_GE(loaded.size(), 8U);
    for (std::size_t k = 0; k < 8; ++k) {
        EXPECT_EQ(loaded[k], fmt::format("{} level0", k)) << "first something of each, the nearest first";
    }
    const std::uint64_t all = shown.show->models().bytes();
    // The smallest allowed memory holds them all here; so less is asked of RoomModels itself.
    EXPECT_LE(all, static_cast<std::uint64_t>(show::RoomShow::room_share * 192e6));
}

TEST(RoomModels, KeepsItsBudgetAndUnloadsWhatIsLeastNeeded) {
    Shown shown;
    std::vector<std::optional<residency::KnownModel>> models;
    for (int k = 0; k < 4; ++k) {
        shown.pack(fmt::format("{}.fspack", k), ring_pack());
        models.emplace_back(residency::know_model(shown.file(fmt::format("{}.fspack", k))).value());
    }
    const std::uint64_t one = residency::read_quality_level(*models[0], 0).value().bytes;
    render::GpuStore store;
    residency::RoomModels room(models, {.max_bytes = 2 * one + one / 2, .waits = true}, store);
    const auto frame = [&](const std::vector<double>& urgency,
                           std::optional<std::size_t> shows = std::nullopt) {
        room.begin_frame();
        for (std::size_t k = 0; k < urgency.size(); ++k) {
            room.want(k, 0, urgency[k]);
        }
        if (shows) {
            room.keep(*shows, 0);
        }
        room.go_on();
        EXPECT_LE(room.bytes(), 2 * one + one / 2);
        std::string there;
        for (std::size_t k = 0; k < 4; ++k) {
            there += room.find(k, 0) != nullptr ? fmt::format("{}", k) : "";
        }
        return there;
    };
    // A level that was never read counts as larger, since its texture is not known: the first frames find out.
    for (int k = 0; k < 4; ++k) {
        static_cast<void>(
            frame({k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0, k == 3 ? 1.0 : 0.0}));
    }
    EXPECT_EQ(frame({4.0, 3.0, 2.0, 1.0}), "01");
    EXPECT_EQ(frame({1.0, 3.0, 2.0, 4.0}), "13");
    EXPECT_EQ(frame({1.0, 3.0, 3.1, 4.0}), "13") << "2 is not clearly more urgent";
    EXPECT_EQ(frame({9.0, 3.0, 8.0, 4.0}, 3), "03") << "what is on show stays";
}

TEST(RoomShow, LiveFadesInLoadedObjectsAndReportsUnusablePacks) {
    Shown shown;
    shown.pack("rings.fspack", ring_pack());
    shown.pack("box.fspack", box_pack({1.0, 1.0, 1.0}, {250, 0, 0, 255}));
    shown.object("rings.fspack", {0.0, 1.5, 0.3}, 0.3);
    shown.object("gone.fspack", {0.3, 1.5, 0.3}, 0.3);
    shown.object("box.fspack", {-0.3, 1.5, 0.3}, 0.2);
    const Result<void> strict = shown.open({});
    ASSERT_FALSE(strict);
    EXPECT_NE(strict.error().message.find("gone.fspack"), std::string::npos);
    // Its colours are damaged; its manifest is not.
    Bytes bytes = read_file(shown.file("box.fspack"), 1U << 24U).value();
    const std::size_t name = as_text(bytes).find("textures/0");
    bytes[name + 32] ^= std::byte{0x40};
    static_cast<void>(write_file(shown.file("box.fspack"), bytes));
    ASSERT_TRUE(shown.open({.live = true}));
    ASSERT_EQ(shown.show->faults().size(), 1U);
    EXPECT_NE(shown.show->faults()[0].find("gone.fspack"), std::string::npos);
    const glm::dvec3 eye(0.0, -0.5, 0.7);
    double seconds = 0.0;
    bool faded = false;
    ASSERT_TRUE(comes_true([&] {
        shown.draw(seconds += 0.02, eye);
        faded = faded || shown.show->counts().fading > 0;
        return shown.show->counts().drawn >= 1 && shown.show->faults().size() >= 2;
    }));
    EXPECT_TRUE(faded) << "it comes by a fade";
    EXPECT_EQ(shown.show->counts().drawn, 1U) << "the rings";
    ASSERT_EQ(shown.show->faults().size(), 2U);
    EXPECT_NE(shown.show->faults()[1].find("box.fspack"), std::string::npos);
}

} // namespace
} // namespace frustumscreen::synthetic
