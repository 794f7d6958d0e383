// A notice's pictures, with letters that can be counted, and their places on the table.
#include "app/exhibit/notice_place.h"
#include "app/typography/ring.h"
#include "app/typography/visitor_side.h"
#include "tests/exhibit/block_words.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const MonotonicTime start{seconds(100)};
constexpr double texels_per_m = 2400.0;
const std::vector<glm::dvec2> room{{-0.4, -0.25}, {0.4, -0.25}, {0.4, 0.25}, {-0.4, 0.25}};

const NoticeText copying{{"stick.copying"}, {}, true};
const NoticeText told{
    {"stick.take_out"},
    {{"coin.fspack", "coin.fspack", "stick.refused.altered"}, {"Vase", "vase.fspack", "stick.taken"}},
    false};

const typography::Typesetter& typesetter() {
    static const typography::Typesetter opened = typography::Typesetter::open().value();
    return opened;
}
NoticePicture draw(const NoticeText& text, pack::TextDirection direction = pack::TextDirection::LeftToRight) {
    const pack::LanguageWords words = synthetic::block_words("en", direction);
    return draw_notice(text, text, {words.runs, words.atlas, typesetter(), texels_per_m});
}

/// The number of solid squares of half the type size: each has the area of a quarter of an em square.
double squares_in(const image::Image<std::uint8_t>& image) {
    const double em_px = typography::min_caption_em_m * texels_per_m;
    double light = 0.0;
    for (const std::uint8_t texel : image.texels) {
        light += texel / 255.0;
    }
    return light / (0.25 * em_px * em_px);
}
/// The light in the columns [first, end), given as fractions of the picture's width.
double light_between(const image::Image<std::uint8_t>& image, double first, double end) {
    double light = 0.0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = static_cast<int>(first * image.width); x < static_cast<int>(end * image.width); ++x) {
            light += image.at(x, y) / 255.0;
        }
    }
    return light;
}

} // namespace

TEST(NoticeImage, every_shape_contains_all_letters) {
    for (const pack::TextDirection direction :
         {pack::TextDirection::LeftToRight, pack::TextDirection::RightToLeft}) {
        const NoticePicture picture = draw(copying, direction);
        ASSERT_EQ(picture.shapes.size(), 4U);
        for (const NoticeShape& shape : picture.shapes) {
            // In the narrowest shape, sentences are no larger than lines.
            const double em = &shape == &picture.shapes.back() ? 1.0 : typography::caption_title_em;
            EXPECT_NEAR(squares_in(shape.image.coverage), 14.0 * em * em, 0.055 * 14.0 * em * em);
            ASSERT_TRUE(shape.ring_m);
        }
        // Letters, then the words in lines: 24 pt, as captions.
        EXPECT_LT(picture.sizes_m[3].x, picture.sizes_m[0].x);
        EXPECT_NEAR(picture.sizes_m[0].x,
                    (14.0 * typography::caption_title_em + 1.0) * typography::min_caption_em_m + 0.032,
                    0.004);
    }
}

TEST(NoticeImage, ring_area_contains_no_letters) {
    constexpr double reach_m = notice_ring_radius_m + typography::ring_gap_m + typography::ring_width_m;
    for (const pack::TextDirection direction :
         {pack::TextDirection::LeftToRight, pack::TextDirection::RightToLeft}) {
        for (const NoticeShape& shape : draw(copying, direction).shapes) {
            const image::Image<std::uint8_t>& image = shape.image.coverage;
            const glm::dvec2 middle(0.5 * image.width + shape.ring_m->x * texels_per_m,
                                    0.5 * image.height - shape.ring_m->y * texels_per_m);
            double light = 0.0;
            for (int y = 0; y < image.height; ++y) {
                for (int x = 0; x < image.width; ++x) {
                    const double off = glm::distance(glm::dvec2(x + 0.5, y + 0.5), middle);
                    light += off < reach_m * texels_per_m ? image.at(x, y) : 0;
                }
            }
            EXPECT_EQ(light, 0.0);
            EXPECT_GE(middle.x, reach_m * texels_per_m - 1.0);
            EXPECT_LE(middle.x, image.width - reach_m * texels_per_m + 1.0);
            EXPECT_EQ(direction == pack::TextDirection::RightToLeft, shape.ring_m->x > 0.001);
        }
    }
}

TEST(NoticeImage, titles_are_on_the_side_where_reading_starts) {
    NoticeText lines = told;
    lines.lines = {{"IIIII", "", "stick.taken"}};
    lines.sentences.clear();
    // Words are fainter than titles and have solid letters, so their light is known.
    const double word = 3 * 0.8 * 0.25 * std::pow(typography::min_caption_em_m * texels_per_m, 2);
    const image::Image<std::uint8_t> to_right = draw(lines).shapes[0].image.coverage;
    const image::Image<std::uint8_t> to_left =
        draw(lines, pack::TextDirection::RightToLeft).shapes[0].image.coverage;
    EXPECT_NEAR(light_between(to_right, 0.5, 1.0), word, 0.1 * word);
    EXPECT_NEAR(light_between(to_left, 0.0, 0.5), word, 0.1 * word);
}

TEST(NoticeImage, unsupported_title_falls_back_to_the_file_name) {
    const auto width = [](const NoticeLine& line) {
        return draw({{}, {line}, false}).shapes[0].image.coverage.texels;
    };
    const auto file = width({"file.fspack", "", "stick.taken"});
    EXPECT_EQ(width({"أمفورة", "file.fspack", "stick.taken"}), file);
    EXPECT_EQ(width({"壺", "file.fspack", "stick.taken"}), file);
    EXPECT_NE(width({"Αμφορέας", "file.fspack", "stick.taken"}), file);
    EXPECT_EQ(width({"壺", "壺.fspack", "stick.taken"}), width({"–", "", "stick.taken"}));
}

TEST(NoticeImage, long_names_are_truncated) {
    NoticeText text = told;
    text.lines[0].label = std::string(900, 'W');
    const NoticePicture picture = draw(text);
    EXPECT_LE(picture.sizes_m[0].x, 36.5 * typography::min_caption_em_m);
    EXPECT_LE(picture.sizes_m[1].x, 25.5 * typography::min_caption_em_m);
    EXPECT_LE(picture.sizes_m[2].x, 18.5 * typography::min_caption_em_m);
    EXPECT_LE(picture.sizes_m[3].x, 9.5 * typography::min_caption_em_m);
}

namespace {

SharedNotice notice_of(std::vector<glm::dvec2> sizes_m) {
    NoticePicture picture;
    picture.sizes_m = std::move(sizes_m);
    picture.shapes.resize(picture.sizes_m.size());
    return std::make_shared<const NoticePicture>(picture);
}

struct Table {
    geometry::PropShape prop = geometry::make_frustum(geometry::shipped_frustum);
    geometry::RigidTransform pose;
    int quarter_turns = 0;
    std::vector<typography::TableRectangle> obstacles, kept;
    std::optional<typography::TableRectangle> caption;
    NoticePlace place{room};
    MonotonicTime now = start;
    Nanoseconds frame = milliseconds(20);

    [[nodiscard]] NoticeEnvironment environment() const {
        return {typography::hidden_by_prop(prop, pose, {0.0, 0.0, 1.5}),
                typography::hidden_by_prop(prop, pose, {0.0, -0.55, 0.5}),
                glm::dvec2(pose.translation),
                quarter_turns,
                obstacles,
                kept,
                caption};
    }
    std::optional<PresentedNotice> wait(milliseconds time, const SharedNotice& wanted) {
        std::optional<PresentedNotice> shown;
        for (Nanoseconds each{0}; each < time; each += frame) {
            now += frame;
            shown = place.step(now, wanted, environment());
        }
        return shown;
    }
};

bool touch(const typography::TableRectangle& a, const typography::TableRectangle& b) {
    return typography::clearance(a.corners(), b.corners()) <= 0.0;
}

} // namespace

TEST(NoticePlace, lies_beside_the_caption_or_replaces_it_without_room) {
    const SharedNotice small = notice_of({{0.2, 0.05}});
    Table table;
    table.caption = typography::TableRectangle{{0.0, -0.2}, {0.3, 0.06}, 0};
    const auto beside = table.wait(milliseconds(600), small);
    ASSERT_TRUE(beside);
    EXPECT_EQ(beside->brightness, 1.0);
    EXPECT_FALSE(touch(beside->rectangle, *table.caption));
    EXPECT_EQ(left_to_caption(*table.caption, *beside), 1.0);

    Table full;
    full.caption = table.caption;
    full.obstacles = {
        {{-0.3, 0.0}, {0.19, 0.49}, 0}, {{0.3, 0.0}, {0.19, 0.49}, 0}, {{0.0, 0.19}, {0.4, 0.1}, 0}};
    const auto over = full.wait(milliseconds(1500), small);
    ASSERT_TRUE(over);
    EXPECT_TRUE(touch(over->rectangle, *full.caption));
    EXPECT_EQ(left_to_caption(*full.caption, *over), 0.0);
    for (const typography::TableRectangle& obstacle : full.obstacles) {
        EXPECT_FALSE(touch(over->rectangle, obstacle));
    }
    const typography::TableRectangle first = over->rectangle;
    for (int k = 0; k < 100; ++k) {
        const auto later = full.wait(milliseconds(100), small);
        ASSERT_TRUE(later);
        EXPECT_EQ(later->rectangle.centre_m, first.centre_m) << "it stays";
        EXPECT_EQ(later->brightness, 1.0);
    }
}

TEST(NoticePlace, finds_the_captions_place_at_every_frame_rate) {
    for (const int hz : {24, 25, 30, 50, 60, 75, 85, 100, 120, 144}) {
        Table full;
        full.frame = Nanoseconds(1'000'000'000 / hz);
        full.caption = typography::TableRectangle{{0.0, -0.2}, {0.3, 0.06}, 0};
        full.kept = {{{0.0, 0.19}, {0.4, 0.1}, 0}};
        full.obstacles = {{{-0.3, 0.0}, {0.19, 0.49}, 0}, {{0.3, 0.0}, {0.19, 0.49}, 0}};
        const SharedNotice small = notice_of({{0.2, 0.05}});
        const auto kept = full.wait(milliseconds(1500), small);
        ASSERT_TRUE(kept) << hz;
        EXPECT_TRUE(touch(kept->rectangle, full.kept.front())) << hz;
        full.obstacles.push_back(full.kept.front());
        const auto over = full.wait(milliseconds(1500), small);
        ASSERT_TRUE(over) << hz;
        EXPECT_TRUE(touch(over->rectangle, *full.caption)) << hz;
    }
}

TEST(NoticePlace, avoids_kept_places_while_there_is_other_room) {
    const SharedNotice tall = notice_of({{0.12, 0.3}});
    Table table;
    table.kept = {{{-0.3, 0.0}, {0.1, 0.1}, 0}};
    table.caption = typography::TableRectangle{{0.0, -0.2}, {0.3, 0.06}, 0};
    const auto right = table.wait(milliseconds(1500), tall);
    ASSERT_TRUE(right);
    EXPECT_GT(right->rectangle.centre_m.x, 0.2);
    table.obstacles = {{{0.3, 0.0}, {0.1, 0.1}, 0}};
    const auto left = table.wait(milliseconds(1500), tall);
    ASSERT_TRUE(left);
    EXPECT_LT(left->rectangle.centre_m.x, -0.2);
    EXPECT_FALSE(touch(left->rectangle, *table.caption));
}

TEST(NoticePlace, moves_away_from_new_obstacles) {
    const SharedNotice notice = notice_of({{0.2, 0.05}});
    Table table;
    const typography::TableRectangle before = table.wait(milliseconds(600), notice)->rectangle;
    table.obstacles = {before};
    const auto after = table.wait(milliseconds(800), notice);
    ASSERT_TRUE(after);
    EXPECT_FALSE(touch(after->rectangle, before));
    table.obstacles = {{{0.0, 0.0}, {0.8, 0.5}, 0}};
    EXPECT_FALSE(table.wait(milliseconds(800), notice)) << "it waits until there is room";
    table.obstacles.clear();
    EXPECT_TRUE(table.wait(milliseconds(800), notice));
}

/// The only space is where the prop passes, every 0.6 s.
TEST(NoticePlace, does_not_flicker_while_the_prop_slides_about) {
    const SharedNotice small = notice_of({{0.2, 0.05}});
    Table table;
    table.obstacles = {
        {{-0.3, 0.0}, {0.19, 0.49}, 0}, {{0.3, 0.0}, {0.19, 0.49}, 0}, {{0.0, 0.19}, {0.4, 0.1}, 0}};
    ASSERT_TRUE(table.wait(milliseconds(600), small));
    int comes = 0;
    bool lit = true;
    for (int k = 0; k < 495; ++k) { // in the last frame the prop is in the way
        table.pose.translation.y = k % 30 < 15 ? -0.1 : 0.0;
        const bool now_lit = table.wait(milliseconds(20), small).has_value();
        comes += now_lit && !lit ? 1 : 0;
        lit = now_lit;
    }
    EXPECT_EQ(comes, 0);
    EXPECT_FALSE(lit);
    table.pose.translation.y = 0.0;
    EXPECT_FALSE(table.wait(milliseconds(400), small)) << "it may go on";
    const auto again = table.wait(milliseconds(800), small);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->brightness, 1.0);
    for (int k = 0; k < 200;
         ++k) { // the notice stays while it fits: the prop approaches and leaves, with enough space
        table.pose.translation.y = k % 30 < 15 ? -0.003 : 0.0;
        const auto stays = table.wait(milliseconds(20), small);
        ASSERT_TRUE(stays);
        EXPECT_EQ(stays->rectangle.centre_m, again->rectangle.centre_m);
    }
}

TEST(NoticePlace, fades_one_notice_out_before_the_next) {
    const SharedNotice first = notice_of({{0.2, 0.05}});
    const SharedNotice second = notice_of({{0.1, 0.1}});
    Table table;
    static_cast<void>(table.wait(milliseconds(600), first));
    double last = 1.0;
    bool changed = false;
    for (int k = 0; k < 40; ++k) {
        const auto shown = table.wait(milliseconds(20), second);
        const double brightness = shown ? shown->brightness : 0.0;
        EXPECT_LE(std::abs(brightness - last), 1.5 * 0.020 / 0.25 + 1e-9);
        if (shown && !changed && shown->picture == second) {
            EXPECT_LT(last, 0.15);
            changed = true;
        }
        last = brightness;
    }
    EXPECT_TRUE(changed);
    EXPECT_EQ(last, 1.0);
    EXPECT_FALSE(table.wait(milliseconds(400), nullptr));
}

TEST(NoticePlace, ring_lies_in_the_picture_for_every_reader) {
    const NoticePicture drawn = draw(copying);
    const SharedNotice notice = std::make_shared<const NoticePicture>(drawn);
    for (int side = 0; side < 4; ++side) {
        Table table;
        table.quarter_turns = side;
        const auto shown = table.wait(milliseconds(600), notice);
        ASSERT_TRUE(shown) << side;
        const auto round = notice_ring(*shown);
        ASSERT_TRUE(round);
        for (const glm::dvec2& corner : round->corners()) {
            EXPECT_LE(typography::clearance(typography::polygon_of(shown->rectangle).corners(),
                                            std::span(&corner, 1)),
                      0.0);
            const glm::dvec2 seen = typography::turned(corner - shown->rectangle.centre_m, -side);
            EXPECT_LT(seen.x, 0.0) << "at the reader's left";
        }
    }
}

/// The prop slides and turns anywhere and things come and go: a lit notice never overlaps any of them.
TEST(NoticePlace, never_overlaps_anything_and_never_allocates) {
    const std::array<SharedNotice, 3> notices{notice_of({{0.3, 0.1}, {0.15, 0.2}, {0.08, 0.1}}),
                                              notice_of({{0.25, 0.04}, {0.1, 0.08}}), nullptr};
    int lit = 0;
    for (unsigned seed = 0; seed < 12; ++seed) {
        std::mt19937 random(seed);
        const auto between = [&](double low, double high) {
            return low + (high - low) * static_cast<double>(random() % 10001) / 10000.0;
        };
        Table table;
        table.obstacles.reserve(8);
        SharedNotice wanted = notices[0];
        std::vector<MonotonicTime> came;
        came.reserve(8);
        for (int k = 0; k < 1500; ++k) {
            if (random() % 100 == 0) {
                wanted = notices.at(random() % 3);
            }
            if (random() % 60 == 0) {
                table.pose.translation = {between(-0.3, 0.3), between(-0.15, 0.15), 0.0};
            }
            table.quarter_turns = random() % 300 == 0 ? static_cast<int>(random() % 4) : table.quarter_turns;
            if (random() % 80 == 0) {
                table.obstacles.clear();
                came.clear();
                for (std::size_t each = random() % 4; each > 0; --each) {
                    table.obstacles.push_back({{between(-0.3, 0.3), between(-0.2, 0.2)}, {0.1, 0.08}, 0});
                    came.push_back(table.now);
                }
            }
            const long before = synthetic::allocations_so_far();
            const auto shown = table.wait(milliseconds(20), wanted);
            if (synthetic::allocations_are_counted) {
                ASSERT_EQ(synthetic::allocations_so_far(), before);
            }
            if (!shown) {
                continue;
            }
            ++lit;
            EXPECT_GT(
                typography::clearance(shown->rectangle.corners(), table.environment().shadow->corners()),
                0.0);
            for (std::size_t each = 0; each < table.obstacles.size(); ++each) {
                if (table.now - came[each] > milliseconds(300)) { // long enough to have faded
                    EXPECT_FALSE(touch(shown->rectangle, table.obstacles[each]));
                }
            }
        }
    }
    EXPECT_GT(lit, 5000);
}

} // namespace frustumscreen::exhibit
