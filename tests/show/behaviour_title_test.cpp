// The title of a behaviour as pixels: where the exhibit placed it, in the visitor's language, and nowhere else.

#include "app/pack/pack_texts.h"
#include "app/pack/pack_world.h"
#include "tests/show/comings.h"
#include "tests/show/square_letters.h"

#include <glm/gtc/matrix_transform.hpp>

namespace frustumscreen::synthetic {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr int width = 640;
constexpr int height = 400;

/// As many filled squares in a row, each as large as the type size.
pack::GlyphText squares(const std::string& key, std::int32_t count) {
    pack::GlyphSetting setting{.limit = 20 * pack::em_units,
                               .width = count * pack::em_units,
                               .height = pack::em_units,
                               .lines = {{pack::em_units, static_cast<std::uint32_t>(count)}},
                               .glyphs = {}};
    for (std::int32_t k = 0; k < count; ++k) {
        setting.glyphs.push_back({0, 0, k * pack::em_units});
    }
    return {key, pack::TextDirection::LeftToRight, {setting}};
}

world::Behaviour slide(world::Trigger trigger) {
    world::Behaviour behaviour;
    behaviour.name = std::string(trigger == world::Trigger::Button ? "pressed" : "rested");
    behaviour.trigger = trigger;
    behaviour.seconds = 1.0;
    behaviour.channels = {{.cell = 0,
                           .path = world::Path::Translation,
                           .curve = {.interpolation = world::Interpolation::Linear,
                                     .times_s = {0.0F, 1.0F},
                                     .values = {glm::vec4(0.0F), glm::vec4(0.05F, 0.0F, 0.0F, 0.0F)}}}};
    return behaviour;
}

/// Rings with a behaviour for a visitor who rests and one for a button, both with titles. `set`: the bake set these, in
/// English three squares and in German six, and none in French.
pack::Pack moving_pack(bool set) {
    pack::Pack whole = numbered_pack(0);
    whole.languages = {"en", "de", "fr"};
    whole.captions = {{"en", "Rings", ""}, {"de", "Ringe", ""}, {"fr", "Anneaux", ""}};
    pack::PackWorld world;
    pack::PackCell& cell = world.cells.emplace_back();
    cell.cell.name = "rings";
    cell.cell.has_geometry = true;
    cell.triangles = 1728;
    cell.low = {-0.5 * whole.box_size.x, -0.5 * whole.box_size.y, 0.0};
    cell.high = {0.5 * whole.box_size.x, 0.5 * whole.box_size.y, whole.box_size.z};
    world.behaviours = {
        {slide(world::Trigger::Dwell), {{"en", "Wait"}, {"de", "Warten"}}},
        {slide(world::Trigger::Button), {{"en", "Turn"}, {"de", "Drehen"}, {"fr", "Tourner"}}}};
    const Result<void> put = pack::put_world(whole, world, std::vector{numbered_pack(0)});
    EXPECT_TRUE(put) << put.error().message;
    if (set) {
        pack::put_set_texts(
            whole, std::vector{set_in_squares("en", {squares("behaviour.0", 9), squares("behaviour.1", 3)}),
                               set_in_squares("de", {squares("behaviour.1", 6)})});
    }
    return whole;
}

class BehaviourTitles : public ArtifactShowTest {
protected:
    BehaviourTitles() {
        settings.projector.pinhole = settings.projector.pinhole.scaled_to(width, height);
        settings.exhibit.captions = true;
        settings.panel.kind = settings::PanelKind::Keys;
        settings.panel.keys = {"1", "2", "3", "4", "5", "6"};
        devices.language = true;
        options.technique = "finest"; // no governor: pictures can be compared
        display.reset();              // one context at a time
        display = display::SurfacelessDisplay::create(width, height).value();
    }
    /// The picture two seconds after a visitor has come, and `commands` were given.
    image::Image8 picture_of(const pack::Pack& pack, std::vector<settings::Command> commands = {}) {
        EXPECT_TRUE(write_file(files.files()[0], pack::write_pack(pack).value()));
        now = MonotonicTime(seconds(100));
        start(1, true);
        run(seconds(1), 0.0);
        for (const settings::Command command : commands) {
            run(milliseconds(500), 0.01, {command});
        }
        run(seconds(2), 0.02);
        return render::read_colour(display->framebuffer(), width, height);
    }
    void run(Nanoseconds length, double x, std::vector<settings::Command> commands = {}) {
        for (const MonotonicTime end = now + length; now < end; now += milliseconds(20)) {
            tracking::TrackedState tracked_state;
            tracked_state.prop_known = true;
            tracked_state.eye_m = settings.eye.default_m;
            tracked_state.table_from_prop.translation.x = x;
            exhibit->note(show->artifacts());
            shown = exhibit->step(now, commands, tracked_state);
            commands.clear();
            static_cast<void>(show->draw(now, shown, std::span(&tracked_state.eye_m, 1),
                                         {display->framebuffer(), 0}, render::Redraw::Everything));
        }
    }
    /// In pixels from the title's edge to the pixel's centre, above 0 inside; for a lens that looks straight down.
    [[nodiscard]] double depth_px(int x, int y) const {
        const geometry::Pinhole& p = settings.projector.pinhole;
        const glm::dvec3 lens = settings.projector.table_from_projector.translation;
        const typography::TableRectangle& title = shown.title->rectangle;
        const glm::dvec2 at{lens.x + (x + 0.5 - p.cx) / p.fx * lens.z,
                            lens.y - (y + 0.5 - p.cy) / p.fy * lens.z};
        const std::array<glm::dvec2, 4> corners = title.corners();
        const glm::dvec2 half = glm::abs(corners[2] - corners[0]) / 2.0;
        const glm::dvec2 inside = half - glm::abs(at - title.centre_m);
        return std::min(inside.x, inside.y) * p.fx / lens.z;
    }
    /// `with` has the title's light in its rectangle, and elsewhere nothing that `without` has not.
    void expect_only_the_title(const image::Image8& with, const image::Image8& without) {
        ASSERT_TRUE(shown.title);
        ASSERT_EQ(shown.title->brightness, 1.0);
        const int code = image::srgb8_from_linear(settings.exhibit.caption_brightness *
                                                  typography::caption_text_brightness);
        int inside = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const double depth = depth_px(x, y);
                if (depth > 1.5) {
                    ++inside;
                    EXPECT_NEAR(with.at(x, y).g, code, 3) << x << ", " << y;
                } else if (depth < -1.5) {
                    EXPECT_EQ(with.at(x, y), without.at(x, y)) << x << ", " << y;
                }
            }
        }
        EXPECT_GT(inside, 50);
    }

    exhibit::Presentation shown;
};

TEST_F(BehaviourTitles, AreDrawnOnlyWhereTheExhibitPlacesThem) {
    const image::Image8 without = picture_of(moving_pack(false));
    EXPECT_FALSE(shown.title) << "an older pack has none that are set";
    const image::Image8 with = picture_of(moving_pack(true));
    ASSERT_TRUE(shown.title);
    EXPECT_EQ(shown.title->title, (exhibit::TitleIndex{0, 1, 0})) << "that of the button";
    expect_only_the_title(with, without);
}

TEST_F(BehaviourTitles, AreInTheVisitorsLanguage) {
    using settings::Command;
    const image::Image8 without = picture_of(moving_pack(false), {Command::NextLanguage});
    const image::Image8 german = picture_of(moving_pack(true), {Command::NextLanguage});
    ASSERT_TRUE(shown.title);
    const glm::dvec2 size_m = shown.title->rectangle.size_m;
    EXPECT_NEAR(size_m.x, 6.0 * settings.exhibit.caption_height_m, 0.003) << "six squares";
    expect_only_the_title(german, without);
    const image::Image8 french =
        picture_of(moving_pack(true), {Command::NextLanguage, Command::NextLanguage});
    EXPECT_FALSE(shown.title) << "it was not set";
    EXPECT_EQ(french.texels,
              picture_of(moving_pack(false), {Command::NextLanguage, Command::NextLanguage}).texels);
}

TEST_F(BehaviourTitles, AreHiddenWithoutTheButton) {
    settings.panel.keys.pop_back();
    const image::Image8 without = picture_of(moving_pack(false));
    EXPECT_EQ(picture_of(moving_pack(true)).texels, without.texels);
    settings.panel = {};
    settings.panel.script = {{.at_s = 1000.0, .button = 4}};
    EXPECT_EQ(picture_of(moving_pack(true)).texels, without.texels);
    settings.panel.script = {{.at_s = 1000.0, .button = 5}};
    EXPECT_NE(picture_of(moving_pack(true)).texels, without.texels) << "a script presses it";
}

TEST_F(BehaviourTitles, AreCountedInTheTextMemory) {
    picture_of(moving_pack(false));
    const std::uint64_t without = show->use().text_gpu_bytes;
    picture_of(moving_pack(true));
    const double texels_per_m =
        settings.projector.pinhole.fx / settings.projector.table_from_projector.translation.z;
    std::uint64_t bytes = 0;
    for (const glm::dvec2& size_m : show->catalogue()[0].behaviours[1].title_sizes_m) {
        const glm::ivec2 size(glm::round(texels_per_m * size_m));
        bytes += scene::caption_gpu_bytes(size.x, size.y);
    }
    EXPECT_GT(bytes, 0U);
    EXPECT_EQ(show->use().text_gpu_bytes, without + bytes) << "of English, German and French";
    EXPECT_EQ(show->use().gpu_bytes, show->use().planned_gpu_bytes);
}

} // namespace
} // namespace frustumscreen::synthetic
