// The pictures on the table, as pixels: at their places, in their colours, not on the prop, and a ring that fills.

#include "app/pack/pack_file.h"
#include "app/render/read_back.h"
#include "app/scene/device_plan.h"
#include "app/show/artifact_show.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/base/temporary_folder.h"
#include "tests/render/counted_new.h"
#include "tests/render/synthetic_pack.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace frustumscreen::synthetic {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr int width = 960;
constexpr int height = 600;

/// A saturated colour, so that captions and titles are distinct from pictures.
glm::u8vec4 colour_of(std::size_t artifact) {
    const auto part = [&](std::size_t k) {
        return static_cast<std::uint8_t>(30 + (artifact * 67 + k * 101) % 190);
    };
    return {part(0), part(1), static_cast<std::uint8_t>(artifact % 2 == 0 ? 0 : 250), 255};
}

/// Rings with a picture of one colour: the left half is opaque, the right half half transparent.
pack::Pack pack_of(std::size_t artifact, bool with_picture) {
    pack::Pack pack = rings(12, 4);
    pack.levels[0].error = {1e-4F, 3e-4F, 1e-3F, 1.0F};
    pack.title = fmt::format("Artifact {}", artifact);
    pack.languages = {"en", "de"};
    pack.captions = {{"en", pack.title, "A text"},
                     {"de", fmt::format("Das lange Werk Nummer {}", artifact), "Ein Text"}};
    complete(pack);
    pack.samples = 1;
    if (with_picture) {
        pack.table_picture = image::Image8(256, 256, colour_of(artifact));
        for (int y = 0; y < 256; ++y) {
            for (int x = 128; x < 256; ++x) {
                pack.table_picture.at(x, y).a = 128;
            }
        }
    }
    return pack;
}

class OnTheTable : public WithTemporaryFolder {
protected:
    void make(std::size_t artifacts, std::string_view more = "", std::size_t without_picture = 99) {
        std::vector<fs::path> packs;
        for (std::size_t k = 0; k < artifacts; ++k) {
            packs.push_back(folder / fmt::format("{}.fspack", k));
            const Result<Bytes> bytes = pack::write_pack(pack_of(k, k != without_picture));
            ASSERT_TRUE(bytes) << bytes.error().message;
            ASSERT_TRUE(write_file(packs.back(), *bytes));
        }
        settings = **settings::parse_settings(
            fmt::format("[projector]\nwidth = {}\nheight = {}\n{}", width, height, more), "kiosk.toml");
        settings.panel.script = {{1.0, 2}};
        show::ArtifactShowOptions options{packs, "auto", 1, scene::AllCullKinds};
        options.waits = waits;
        show = show::ArtifactShow::create(settings, scene::plan_devices(settings, false, false), options,
                                          {display->framebuffer(), 0})
                   .value();
        exhibit.emplace(show::make_exhibit(settings, *show, now));
        tracked_state.prop_known = true;
        tracked_state.eye_m = settings.eye.default_m;
    }
    void wait(milliseconds time, std::span<const settings::Command> commands = {}) {
        for (milliseconds each{0}; each < time; each += milliseconds(20)) {
            now += milliseconds(20);
            shown = exhibit->step(now, each.count() == 0 ? commands : std::span<const settings::Command>{},
                                  tracked_state);
        }
    }
    image::Image8 picture(render::Redraw redraw = render::Redraw::Everything) {
        static_cast<void>(show->draw(now, shown, std::span(&tracked_state.eye_m, 1),
                                     {display->framebuffer(), redraw == render::Redraw::Changes ? 1 : 0},
                                     redraw));
        return render::read_colour(display->framebuffer(), width, height);
    }
    /// The pixel of a table point for a lens that looks straight down, independent of the program's own projection.
    [[nodiscard]] glm::dvec2 pixel_of(const glm::dvec2& table_m) const {
        const geometry::Pinhole& p = settings.projector.pinhole;
        const glm::dvec3 lens = settings.projector.table_from_projector.translation;
        return {p.cx + p.fx * (table_m.x - lens.x) / lens.z, p.cy - p.fy * (table_m.y - lens.y) / lens.z};
    }
    [[nodiscard]] glm::dvec2 table_of(int x, int y) const {
        const geometry::Pinhole& p = settings.projector.pinhole;
        const glm::dvec3 lens = settings.projector.table_from_projector.translation;
        return {lens.x + (x + 0.5 - p.cx) / p.fx * lens.z, lens.y - (y + 0.5 - p.cy) / p.fy * lens.z};
    }
    [[nodiscard]] static bool within(const typography::TableRectangle& rectangle, const glm::dvec2& at,
                                     double margin_m) {
        return typography::clearance(rectangle.corners(), std::span(&at, 1)) <= margin_m;
    }
    /// The colour at a point of the place's picture, in fractions from its left and top as the reader sees it.
    [[nodiscard]] glm::u8vec4 seen_at(const image::Image8& image, const exhibit::TablePlace& place, double u,
                                      double v) const {
        const std::array<glm::dvec2, 4> c = place.picture.corners();
        const glm::dvec2 at = glm::mix(glm::mix(c[3], c[2], u), glm::mix(c[0], c[1], u), v);
        const glm::dvec2 pixel = pixel_of(at);
        return image.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
    }
    void expect_pictures_in_their_places() {
        const image::Image8 image = picture();
        ASSERT_NE(shown.table, nullptr);
        int lit = 0;
        for (const exhibit::PlacedPicture& placed : shown.table->pictures()) {
            if (!placed.artifact || placed.brightness < 1.0) {
                continue;
            }
            ++lit;
            const glm::u8vec4 colour = colour_of(*placed.artifact);
            const glm::u8vec4 whole = seen_at(image, placed.place, 0.25, 0.5);
            const glm::u8vec4 half = seen_at(image, placed.place, 0.75, 0.5);
            for (int k = 0; k < 3; ++k) {
                EXPECT_NEAR(whole[k], colour[k], 2) << *placed.artifact;
                EXPECT_NEAR(image::linear_from_srgb(half[k] / 255.0),
                            image::linear_from_srgb(colour[k] / 255.0) * 128 / 255, 0.012)
                    << *placed.artifact;
            }
        }
        EXPECT_GE(lit, 2);
        expect_black_elsewhere(image);
    }
    /// Expects black except at the pictures and the prop, whose shadow is compared with an exhibit without pictures.
    void expect_black_elsewhere(const image::Image8& image) {
        const auto shadow =
            typography::hidden_by_prop(settings::make_prop(settings.prop), shown.table_from_prop,
                                       settings.projector.table_from_projector.translation);
        ASSERT_TRUE(shadow);
        const double pixel_m =
            1.5 * settings.projector.table_from_projector.translation.z / settings.projector.pinhole.fx;
        int strayed = 0;
        int outside = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const glm::dvec2 at = table_of(x, y);
                bool allowed = typography::clearance(shadow->corners(), std::span(&at, 1)) <= pixel_m ||
                               (shown.caption && within(shown.caption->rectangle, at, pixel_m));
                for (const exhibit::PlacedPicture& placed : shown.table->pictures()) {
                    typography::TableRectangle title = placed.place.title;
                    title.size_m.x = std::max(title.size_m.x, 0.077); // a line may be some millimetres longer
                    allowed =
                        allowed || within(placed.place.picture, at, pixel_m) || within(title, at, pixel_m);
                }
                const glm::u8vec4& texel = image.at(x, y);
                outside += allowed ? 0 : 1;
                strayed += !allowed && texel.r + texel.g + texel.b > 0 ? 1 : 0;
            }
        }
        EXPECT_EQ(strayed, 0);
        EXPECT_GT(outside, width * height / 4);
    }

    bool waits = false; ///< for everything that is loaded ahead
    settings::Settings settings;
    std::unique_ptr<display::SurfacelessDisplay> display =
        display::SurfacelessDisplay::create(width, height).value();
    std::unique_ptr<show::ArtifactShow> show;
    std::optional<exhibit::Exhibit> exhibit;
    tracking::TrackedState tracked_state;
    exhibit::Presentation shown;
    MonotonicTime now{std::chrono::seconds(100)};
};

TEST_F(OnTheTable, DrawsPicturesInTheirPlacesAndColours) {
    for (const std::size_t artifacts : {std::size_t{3}, std::size_t{12}}) {
        make(artifacts);
        for (const glm::dvec3& eye :
             {settings.eye.default_m, glm::dvec3(0.7, 0.0, 0.5), glm::dvec3(0.0, 0.6, 0.5)}) {
            tracked_state.eye_m = eye;
            wait(milliseconds(1500));
            expect_pictures_in_their_places();
        }
        EXPECT_EQ(show->use().planned_gpu_bytes, show->use().gpu_bytes);
        EXPECT_EQ(show->use().planned_shaders, show->use().shaders);
    }
}

TEST_F(OnTheTable, DrawsNoPictureOntoThePropAtHome) {
    make(12);
    wait(milliseconds(1500));
    const image::Image8 with = picture();
    const auto shadow = typography::hidden_by_prop(settings::make_prop(settings.prop), shown.table_from_prop,
                                                   settings.projector.table_from_projector.translation);
    make(12, "[exhibit]\ntable_pictures = false\n[panel]\nscript = [{at_s = 1.0, button = 1}]\n");
    wait(milliseconds(1500));
    EXPECT_EQ(shown.table, nullptr);
    const image::Image8 without = picture();
    int compared = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::dvec2 at = table_of(x, y);
            if (typography::clearance(shadow->corners(), std::span(&at, 1)) <= 0.0) {
                ASSERT_EQ(with.at(x, y), without.at(x, y)) << x << ' ' << y;
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 20000);
}

TEST_F(OnTheTable, RingShowsTheExhibitsProgress) {
    make(3, "[exhibit]\ncaptions = false\n[prop]\nbase_m = 0.16\ntop_m = 0.08\nheight_m = 0.12\n");
    wait(milliseconds(800));
    ASSERT_NE(shown.table, nullptr);
    ASSERT_GE(shown.table->count, 2U);
    const exhibit::PlacedPicture chosen = shown.table->pictures()[1];
    ASSERT_TRUE(chosen.artifact);
    tracked_state.table_from_prop.translation = glm::dvec3(chosen.place.picture.centre_m, 0.0);
    wait(milliseconds(400));
    const auto shadow =
        typography::hidden_by_prop(settings::make_prop(settings.prop), tracked_state.table_from_prop,
                                   settings.projector.table_from_projector.translation);
    double last = 0.0;
    int pictures = 0;
    while (shown.table->ring && pictures < 20) {
        ASSERT_EQ(*shown.table->ring, 1U);
        const image::Image8 image = picture();
        int white = 0;
        int faint = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const glm::dvec2 at = table_of(x, y);
                const double off = typography::clearance(shadow->corners(), std::span(&at, 1));
                const int code = image.at(x, y).r;
                if (off > 0.004 && off < 0.008 && code == image.at(x, y).b) {
                    white += code > 180 ? 1 : 0;
                    faint += code > 20 && code <= 180 ? 1 : 0;
                }
            }
        }
        if (shown.table->ring_full > 0.15) { // the ring has appeared
            EXPECT_NEAR(1.0 * white / (white + faint), shown.table->ring_full, 0.05);
            EXPECT_GT(white, last);
            last = white;
            ++pictures;
        }
        wait(milliseconds(200));
    }
    EXPECT_GE(pictures, 4);
    wait(milliseconds(1000));
    EXPECT_EQ(shown.artifact, *chosen.artifact);
}

TEST_F(OnTheTable, TitlesFollowTheLanguage) {
    make(3);
    wait(milliseconds(1500));
    const auto columns_of_title = [&] {
        const image::Image8 image = picture();
        const typography::TableRectangle& title = shown.table->pictures()[1].place.title;
        const glm::dvec2 low = pixel_of(title.corners()[3]);
        const glm::dvec2 high = pixel_of(title.corners()[1]);
        int columns = 0;
        for (int x = static_cast<int>(low.x); x < static_cast<int>(high.x); ++x) {
            bool lit = false;
            for (int y = static_cast<int>(low.y); y < static_cast<int>(high.y); ++y) {
                lit = lit || image.at(x, y).r > 60;
            }
            columns += lit ? 1 : 0;
        }
        return columns;
    };
    const int english = columns_of_title();
    wait(milliseconds(1500), std::array{settings::Command::NextLanguage});
    EXPECT_EQ(shown.table_language, "de");
    EXPECT_GT(english, 15);
    EXPECT_GT(columns_of_title(), english + 8);
}

TEST_F(OnTheTable, DrawsASquareForAPackWithoutAPicture) {
    make(3, "", 2);
    wait(milliseconds(1500));
    const image::Image8 image = picture();
    const std::span<const exhibit::PlacedPicture> pictures = shown.table->pictures();
    const auto placed = std::ranges::find_if(
        pictures, [](const exhibit::PlacedPicture& each) { return each.artifact == std::size_t{2}; });
    ASSERT_NE(placed, pictures.end());
    EXPECT_GT(seen_at(image, placed->place, 0.5, 0.022).g, 60); // its outline
    const glm::u8vec4 corner = seen_at(image, placed->place, 0.2, 0.2);
    EXPECT_EQ(corner.r + corner.g + corner.b, 0);
    EXPECT_EQ(show->use().planned_gpu_bytes, show->use().gpu_bytes);
}

TEST_F(OnTheTable, DrawingAllocatesNothingAndRedrawsOnlyTheRing) {
    waits = true; // the next and the previous artifact are loaded ahead; receiving another one allocates
    make(12);
    wait(milliseconds(1500));
    static_cast<void>(picture());
    ASSERT_GE(show->state(shown).loaded, 3U);
    const std::span<const exhibit::PlacedPicture> placed = shown.table->pictures();
    const auto next = std::find_if(placed.begin(), placed.end(), [](const exhibit::PlacedPicture& each) {
        return each.artifact == std::size_t{1};
    });
    ASSERT_NE(next, placed.end());
    const glm::dvec2 home(tracked_state.table_from_prop.translation);
    const glm::dvec2 goal = next->place.picture.centre_m;
    const long before = synthetic::allocations_so_far();
    for (int k = 0; k <= 60; ++k) {
        tracked_state.table_from_prop.translation = glm::dvec3(glm::mix(home, goal, k / 60.0), 0.0);
        wait(milliseconds(20));
        static_cast<void>(show->draw(now, shown, std::span(&tracked_state.eye_m, 1),
                                     {display->framebuffer(), 1}, render::Redraw::Changes));
    }
    wait(milliseconds(600));
    static_cast<void>(show->draw(now, shown, std::span(&tracked_state.eye_m, 1), {display->framebuffer(), 1},
                                 render::Redraw::Changes));
    if (synthetic::allocations_are_counted) {
        EXPECT_EQ(synthetic::allocations_so_far(), before);
    }
    wait(milliseconds(100)); // the ring alone
    const render::DrawResult ring = show->draw(now, shown, std::span(&tracked_state.eye_m, 1),
                                               {display->framebuffer(), 1}, render::Redraw::Changes);
    EXPECT_TRUE(ring.drawn);
    EXPECT_LT(ring.redrawn.width * ring.redrawn.height, width * height / 2);
    const image::Image8 partly = render::read_colour(display->framebuffer(), width, height);
    EXPECT_EQ(partly.texels, picture().texels);
}

} // namespace
} // namespace frustumscreen::synthetic
