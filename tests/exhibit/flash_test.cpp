// Whatever is pressed, the picture flashes no more than photosensitive people can bear.

#include "app/exhibit/attract.h"
#include "app/exhibit/captions.h"
#include "app/exhibit/exhibit.h"
#include "tests/exhibit/flash_counter.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <random>

namespace frustumscreen {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const MonotonicTime start{seconds(100)};
constexpr Nanoseconds frame = std::chrono::nanoseconds(1'000'000'000 / 120);

std::vector<Luminance> wave(const std::function<double(double)>& value_at) {
    std::vector<Luminance> samples;
    for (MonotonicTime now = start; now < start + seconds(3); now += milliseconds(2)) {
        samples.push_back({now, value_at(to_seconds(now - start))});
    }
    return samples;
}

TEST(FlashCounter, CountsPairsOfOpposingChanges) {
    const auto square = [](double hz, double low, double high) {
        return wave([=](double t) { return std::fmod(hz * t, 1.0) < 0.5 ? high : low; });
    };
    const auto sine = [](double hz, double low, double high) {
        return wave([=](double t) {
            return low + 0.5 * (high - low) * (1.0 - std::cos(2.0 * std::numbers::pi * hz * t));
        });
    };
    for (int hz = 1; hz <= 9; ++hz) {
        EXPECT_EQ(most_flashes_a_second(square(hz, 0.0, 1.0)), hz);
        EXPECT_EQ(most_flashes_a_second(sine(hz, 0.0, 1.0)), hz);
        EXPECT_EQ(most_flashes_a_second(sine(hz, 0.0, 0.11)), hz);
        EXPECT_EQ(most_flashes_a_second(sine(hz, 0.0, 0.09)), 0) << "too small a change";
        EXPECT_EQ(most_flashes_a_second(square(hz, 0.81, 1.0)), 0) << "the darker one is bright";
        EXPECT_EQ(most_flashes_a_second(square(hz, 0.79, 0.9)), hz);
    }
    EXPECT_EQ(most_flashes_a_second(wave([](double t) { return t / 3.0; })), 0) << "one change is no pair";
    const auto trembling = wave([](double t) {
        return 0.5 + 0.5 * std::sin(2.0 * std::numbers::pi * t) + 0.04 * std::sin(100.0 * t);
    });
    EXPECT_EQ(most_flashes_a_second(trembling), 1);
}

/// One artifact's pixel and one of its caption, in a picture that is white there, as a visitor sees it.
class Watched {
public:
    explicit Watched(MonotonicTime now) : attract_({0.0, 0.0}, true, now) { placer_.set_shapes(size_); }

    /// `lost`: since when nobody knows where the prop is.
    void look(MonotonicTime now, const Exhibit& exhibit, std::optional<MonotonicTime> lost = {}) {
        const Shown shown = exhibit.at(now);
        if (shown.artifact != artifact_ || shown.language != language_) { // as the exhibit's pictures do
            placer_.set_shapes(size_);
            artifact_ = shown.artifact;
            language_ = shown.language;
        }
        placer_.update(now, shadow_, std::nullopt, {0.0, 0.1});
        const double stand = attract_.at(now, !lost, lost ? now - *lost : Nanoseconds(0), {}).brightness;
        artifact.push_back({now, shown.brightness * stand});
        caption.push_back({now, shown.caption_brightness * placer_.at(now).opacity * stand});
    }

    std::vector<Luminance> artifact;
    std::vector<Luminance> caption;

private:
    std::array<glm::dvec2, 4> room_{{{-0.4, -0.25}, {0.4, -0.25}, {0.4, 0.25}, {-0.4, 0.25}}};
    std::array<glm::dvec2, 1> size_{glm::dvec2(0.2, 0.05)};
    TablePolygon shadow_{{{{-0.05, 0.05}, {0.05, 0.05}, {0.0, 0.15}}}, 3};
    CaptionPlacer placer_{room_};
    Attract attract_;
    std::size_t artifact_ = 0;
    std::string_view language_;
};

constexpr std::array wishes{Wish::NextArtifact, Wish::PreviousArtifact, Wish::NextLanguage};

void press(Exhibit& exhibit, std::mt19937& random, MonotonicTime now) {
    const Wish wish = wishes.at(random() % wishes.size());
    if (random() % 8 == 0) {
        exhibit.take_back(wish, now);
    } else {
        exhibit.wish(wish, now);
    }
}

/// At rest it flashes twice a second at most; the prop, lost and found, adds one.
TEST(Flashes, AreAtMostTwoASecondWhateverIsPressedAndThreeWhereThePropIsLostToo) {
    int most = 0;
    for (unsigned seed = 0; seed < 30; ++seed) {
        std::mt19937 random(seed);
        Exhibit exhibit(2 + random() % 3, {"en", "de", "fr"}, "en", start);
        const bool loses_prop = seed % 2 == 1;
        Watched watched(start);
        MonotonicTime next = start;
        std::optional<MonotonicTime> lost;
        MonotonicTime turn = start + seconds(1);
        const unsigned slowest_ms = 1U << (1 + seed % 11); // 2 ms to 2 s
        for (MonotonicTime now = start; now < start + seconds(30); now += frame) {
            while (next <= now) {
                press(exhibit, random, now);
                next += milliseconds(1 + random() % slowest_ms);
            }
            if (loses_prop && now >= turn) {
                lost = lost ? std::nullopt : std::optional(now);
                turn += milliseconds(random() % (lost ? 4000 : 500));
            }
            watched.look(now, exhibit, lost);
        }
        for (const auto* samples : {&watched.artifact, &watched.caption}) {
            const int found = most_flashes_a_second(*samples);
            EXPECT_LE(found, loses_prop ? 3 : 2) << seed;
            most = std::max(most, found);
        }
    }
    EXPECT_GE(most, 2) << "nothing was seen of the presses";
}

/// Somebody who watches the picture and presses just when it hurts most: at any brightness on its way up.
TEST(Flashes, AreAtMostTwoASecondForWhoeverPressesAtTheWorstBrightness) {
    for (const Wish wish : wishes) {
        for (int percent = 1; percent <= 100; percent += 3) {
            Exhibit exhibit(3, {"en", "de"}, "en", start);
            Watched watched(start);
            double before = 0.0;
            for (MonotonicTime now = start; now < start + seconds(10); now += frame) {
                watched.look(now, exhibit);
                const double seen =
                    wish == Wish::NextLanguage ? watched.caption.back().value : watched.artifact.back().value;
                if (seen >= 0.01 * percent && seen >= before) {
                    exhibit.wish(wish, now);
                }
                before = seen;
            }
            EXPECT_LE(most_flashes_a_second(watched.artifact), 2) << percent;
            EXPECT_LE(most_flashes_a_second(watched.caption), 2) << percent;
        }
    }
}

} // namespace
} // namespace frustumscreen
