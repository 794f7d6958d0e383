#include "app/exhibit/dwell.h"
#include "app/exhibit/table_layout.h"
#include "firmware_host/base/file.h"
#include "firmware_host/tracker/convert_recording.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using Random = std::mt19937_64;

double between(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

MonotonicTime at_s(double seconds) {
    return from_microseconds(static_cast<std::int64_t>(std::llround(seconds * 1e6)));
}

/// The pictures of a full page of the table as shipped.
const std::vector<typography::TableRectangle>& shipped_pictures() {
    static const std::vector<typography::TableRectangle> pictures = [] {
        TableSetUp set_up;
        set_up.artifacts = 12;
        set_up.picture_m = {{-0.4, -0.25}, {0.4, -0.25}, {0.4, 0.25}, {-0.4, 0.25}};
        set_up.prop = geometry::make_frustum(geometry::shipped_frustum);
        set_up.lens_m = {0.0, 0.0, 1.5};
        std::vector<typography::TableRectangle> found;
        for (const TablePlace& place : lay_out_table(set_up, 0).places) {
            found.push_back(place.picture);
        }
        return found;
    }();
    return pictures;
}

/// A hand's way from one place to another: minimum jerk (Flash and Hogan 1985).
glm::dvec2 stroke(const glm::dvec2& from, const glm::dvec2& to, double share) {
    const double s = std::clamp(share, 0.0, 1.0);
    return from + (to - from) * (s * s * s * (10.0 - 15.0 * s + 6.0 * s * s));
}

glm::dvec2 some_place(Random& random) {
    return {between(random, -0.4, 0.4), between(random, -0.25, 0.25)};
}

glm::dvec2 noise(Random& random) {
    std::normal_distribution<double> normal(0.0, 0.0003);
    return {normal(random), normal(random)};
}

TEST(Dwell, RingFillsIn1500MsAndChoosesOnce) {
    const std::vector<typography::TableRectangle>& pictures = shipped_pictures();
    ASSERT_EQ(pictures.size(), 12U);
    Dwell dwell;
    double full = 0.0;
    int filling = 0;
    std::vector<double> chosen_s;
    for (int frame = 0; frame <= 600; ++frame) {
        const double now = frame / 60.0;
        const DwellState state = dwell.update(at_s(now), pictures[7].centre_m, pictures);
        if (state.chosen) {
            EXPECT_EQ(*state.chosen, 7U);
            EXPECT_EQ(state.full, 1.0);
            chosen_s.push_back(now);
        }
        if (chosen_s.empty() && state.place) {
            EXPECT_EQ(*state.place, 7U);
            EXPECT_NEAR(state.full, std::clamp((now - 0.2) / 1.5, 0.0, 1.0), 1e-5);
            EXPECT_GE(state.full, full);
            full = state.full;
            ++filling;
        }
    }
    EXPECT_NEAR(filling, 90, 1); // 1.5 s
    ASSERT_EQ(chosen_s.size(), 1U);
    EXPECT_NEAR(chosen_s.front(), 1.7, 0.017);
}

TEST(Dwell, RingEmptiesSmoothlyWhenThePropMovesOn) {
    const std::vector<typography::TableRectangle>& pictures = shipped_pictures();
    Dwell dwell;
    double before = 0.0;
    double most = 0.0;
    double gone_s = 0.0;
    for (int frame = 0; frame <= 300; ++frame) {
        const double now = frame / 60.0;
        // The prop leaves 0.1 s before the ring is full, at 0.2 m/s.
        const glm::dvec2 at = pictures[0].centre_m + glm::dvec2(std::max(0.0, now - 1.6) * 0.2, 0.0);
        const DwellState state = dwell.update(at_s(now), at, pictures);
        EXPECT_FALSE(state.chosen);
        EXPECT_LT(std::abs(state.full - before), 1.0 / 60.0 / 0.2 + 1e-4); // emptying is faster
        gone_s = state.full > 0.0 ? now : gone_s;
        most = std::max(most, state.full);
        before = state.full;
    }
    EXPECT_GT(most, 0.9);
    EXPECT_GT(gone_s, 1.6);
    EXPECT_LT(gone_s, 2.0);
}

TEST(Dwell, IgnoresAChosenPictureUntilThePropLeavesIt) {
    const std::vector<typography::TableRectangle>& pictures = shipped_pictures();
    Dwell dwell;
    std::vector<std::size_t> chosen;
    const auto rest = [&](double from_s, double to_s, const glm::dvec2& at) {
        for (int frame = static_cast<int>(from_s * 60); frame < static_cast<int>(to_s * 60); ++frame) {
            const DwellState state = dwell.update(at_s(frame / 60.0), at, pictures);
            if (state.chosen) {
                chosen.push_back(*state.chosen);
            }
        }
    };
    rest(0.0, 3.0, pictures[3].centre_m);
    rest(3.0, 6.0, pictures[3].centre_m + glm::dvec2(0.02, 0.01)); // still on it
    EXPECT_EQ(chosen, std::vector<std::size_t>{3});
    rest(6.0, 9.0, pictures[4].centre_m); // on to another one at once
    EXPECT_EQ(chosen, (std::vector<std::size_t>{3, 4}));
    rest(9.0, 9.1, {0.0, 0.0});
    rest(9.1, 12.0, pictures[4].centre_m); // and back
    EXPECT_EQ(chosen, (std::vector<std::size_t>{3, 4, 4}));
}

TEST(Dwell, IgnoresPicturesThatAppearUnderTheProp) {
    const std::vector<typography::TableRectangle>& pictures = shipped_pictures();
    Dwell dwell;
    int chosen = 0;
    for (int frame = 0; frame < 450; ++frame) {
        if (frame == 30) {
            dwell.pictures_changed(pictures);
        }
        const bool away = frame == 300;
        const DwellState state =
            dwell.update(at_s(frame / 60.0), away ? glm::dvec2(0.0) : pictures[5].centre_m, pictures);
        chosen += state.chosen ? 1 : 0;
        EXPECT_TRUE(frame < 30 || frame > 300 || !state.place);
        EXPECT_TRUE(frame != 29 || state.place == 5U) << "a ring had begun";
        EXPECT_TRUE(frame > 300 || chosen == 0);
    }
    EXPECT_EQ(chosen, 1) << "once the prop has left it and is back";
}

TEST(Dwell, IgnoresALiftedOrLostProp) {
    const geometry::PropShape prop = geometry::make_frustum(geometry::shipped_frustum);
    EXPECT_EQ(standing_place(prop, {{1, 0, 0, 0}, {0.1, 0.2, 0.0}}), glm::dvec2(0.1, 0.2));
    EXPECT_FALSE(standing_place(prop, {{1, 0, 0, 0}, {0.1, 0.2, 0.03}}));
    // A cube that lies on another face: its middle counts, not its bottom's.
    const glm::dquat lying = glm::angleAxis(std::numbers::pi / 2.0, glm::dvec3(0, 1, 0));
    const std::optional<glm::dvec2> at = standing_place(geometry::make_cube(0.1), {lying, {0.1, 0.2, 0.05}});
    ASSERT_TRUE(at);
    EXPECT_LT(glm::distance(*at, {0.15, 0.2}), 1e-12);

    const std::vector<typography::TableRectangle>& pictures = shipped_pictures();
    Dwell dwell;
    for (int frame = 0; frame < 600; ++frame) {
        // Lost for one frame every 1.2 seconds; in the second half, one frame a second.
        const bool lost = frame % 72 == 0;
        const double now = frame < 300 ? frame / 60.0 : 5.0 + (frame - 300);
        const DwellState state =
            dwell.update(at_s(now), lost ? std::nullopt : std::optional(pictures[0].centre_m), pictures);
        EXPECT_FALSE(state.chosen) << frame;
    }
}

TEST(Dwell, SweepsOverPicturesNeverChoose) {
    const std::vector<typography::TableRectangle>& pictures = shipped_pictures();
    Random random(21);
    int choices = 0;
    int crossed = 0;
    double swept_s = 0.0;
    for (int person = 0; person < 400; ++person) {
        Dwell dwell;
        double now = 0.0;
        glm::dvec2 from = some_place(random);
        const double period_s = 1.0 / between(random, 30.0, 240.0);
        for (int k = 0; k < 12; ++k) {
            // Every other stroke ends on a picture. A hand is slow at both ends of a stroke, so that the prop keeps
            // within 12 mm of a stop for longer than it stands, but for less than a ring takes.
            glm::dvec2 to = from;
            while (glm::distance(from, to) < 0.1) {
                to = k % 2 == 0 ? pictures[random() % pictures.size()].centre_m : some_place(random);
            }
            const double stroke_s = std::clamp(glm::distance(from, to) / between(random, 0.1, 0.8), 0.3, 3.0);
            const double stop_s = random() % 3 == 0 ? between(random, 0.0, 0.6) : 0.0;
            const double begin = now;
            for (; now < begin + stroke_s + stop_s; now += period_s) {
                const glm::dvec2 at = stroke(from, to, (now - begin) / stroke_s) + noise(random);
                const DwellState state = dwell.update(at_s(now), at, pictures);
                choices += state.chosen ? 1 : 0;
                crossed += state.place && state.full < 0.01 ? 1 : 0;
            }
            swept_s += now - begin;
            from = to;
        }
    }
    RecordProperty("swept_s", static_cast<int>(swept_s));
    EXPECT_EQ(choices, 0);
    EXPECT_GT(crossed, 300); // rings began
    EXPECT_GT(swept_s, 3000.0);
}

/// The slowest motion that counts as a sweep: 12 mm/s, through the middles of a row of pictures.
TEST(Dwell, ASlowSteadySweepNeverChooses) {
    const std::vector<typography::TableRectangle>& pictures = shipped_pictures();
    Random random(22);
    for (int k = 0; k < 100; ++k) {
        Dwell dwell;
        const double speed = between(random, 0.012, 0.04);
        const glm::dvec2 start(-0.4, pictures[random() % pictures.size()].centre_m.y);
        bool ringed = false;
        for (int frame = 0; frame / 60.0 * speed < 0.8; ++frame) {
            const glm::dvec2 at = start + glm::dvec2(frame / 60.0 * speed, 0.0) + noise(random);
            const DwellState state = dwell.update(at_s(frame / 60.0), at, pictures);
            EXPECT_FALSE(state.chosen);
            ringed = ringed || state.place;
        }
        EXPECT_TRUE(ringed) << "it was over a picture for longer than a ring takes to begin: " << speed;
    }
}

/// A hand at rest: it trembles at 4 to 12 Hz by 1 to 3 mm and drifts a little.
struct RestingHand {
    explicit RestingHand(Random& random) {
        amplitude = between(random, 0.001, 0.003);
        direction = between(random, 0.0, 2.0 * std::numbers::pi);
        hz = between(random, 4.0, 12.0);
        beat_hz = between(random, 0.3, 1.5);
        phase = between(random, 0.0, 6.28);
        drift_m_s = between(random, 0.0, 0.0015);
        drift_direction = between(random, 0.0, 6.28);
    }
    [[nodiscard]] glm::dvec2 at(double s) const {
        const double wave = amplitude * (0.6 + 0.4 * std::sin(6.2832 * beat_hz * s + 2.0 * phase)) *
                            std::sin(6.2832 * hz * s + phase);
        return wave * glm::dvec2(std::cos(direction), std::sin(direction)) +
               drift_m_s * std::max(0.0, s) *
                   glm::dvec2(std::cos(drift_direction), std::sin(drift_direction));
    }
    double amplitude, direction, hz, beat_hz, phase, drift_m_s, drift_direction;
};

TEST(Dwell, ChoosesARestedPictureWithin1800Ms) {
    const std::vector<typography::TableRectangle>& pictures = shipped_pictures();
    Random random(23);
    constexpr int people = 4000;
    int in_time = 0;
    int wrong = 0;
    std::vector<double> took_s;
    for (int person = 0; person < people; ++person) {
        Dwell dwell;
        const RestingHand hand(random);
        const std::size_t wanted = random() % pictures.size();
        const double inner = 0.5 * pictures[wanted].size_m.x - 0.005;
        const glm::dvec2 to = pictures[wanted].centre_m +
                              glm::dvec2(between(random, -inner, inner), between(random, -inner, inner));
        const glm::dvec2 from = 0.2 * some_place(random);
        const double stroke_s = glm::distance(from, to) / between(random, 0.08, 0.5);
        const double period_s = 1.0 / between(random, 30.0, 240.0);
        double chosen_s = 1e9;
        for (double now = 0.0; now < stroke_s + 4.0 && chosen_s > 1e8; now += period_s) {
            const glm::dvec2 at = stroke(from, to, now / stroke_s) + hand.at(now - stroke_s) + noise(random);
            const DwellState state = dwell.update(at_s(now), at, pictures);
            if (state.chosen) {
                chosen_s = now - stroke_s;
                wrong += *state.chosen == wanted ? 0 : 1;
            }
        }
        in_time += chosen_s <= 1.8 ? 1 : 0;
        took_s.push_back(chosen_s);
    }
    std::sort(took_s.begin(), took_s.end());
    RecordProperty("in_time", in_time);
    RecordProperty("median_ms", static_cast<int>(1e3 * took_s[people / 2]));
    RecordProperty("p99_ms", static_cast<int>(1e3 * took_s[people * 99 / 100]));
    RecordProperty("worst_ms", static_cast<int>(1e3 * std::min(took_s.back(), 100.0)));
    EXPECT_GE(in_time, people * 99 / 100);
    EXPECT_EQ(wrong, 0);
}

/// True if, for the time of a ring before `last`, the prop was within 24 mm of its place at `last`: plain search.
bool rested_before(const std::vector<tracker::PoseSample>& samples, const std::vector<glm::dvec2>& places,
                   std::size_t last) {
    for (std::size_t k = last + 1; k-- > 0 && samples[last].time - samples[k].time <= milliseconds(1490);) {
        if (glm::distance(places[last], places[k]) > 0.024) {
            return false;
        }
    }
    return true;
}

/// The recorded path as laid on the table; or turned, scaled down, and begun over one of the pictures.
std::vector<glm::dvec2> some_way(Random& random, const std::vector<tracker::PoseSample>& samples,
                                 bool as_it_is) {
    const double scale = as_it_is ? 1.0 : between(random, 0.3, 1.0);
    const double angle = as_it_is ? 0.0 : between(random, -3.14, 3.14);
    const glm::dvec2 across(-std::sin(angle), std::cos(angle));
    const glm::dvec2 along(std::cos(angle), std::sin(angle));
    const std::vector<typography::TableRectangle>& pictures = shipped_pictures();
    const glm::dvec2 over = pictures[random() % pictures.size()].centre_m;
    const glm::dvec2 met(samples[random() % samples.size()].position_m);
    std::vector<glm::dvec2> way;
    for (const tracker::PoseSample& sample : samples) {
        const glm::dvec2 off = scale * (glm::dvec2(sample.position_m) - (as_it_is ? glm::dvec2(0.0) : met));
        way.push_back((as_it_is ? glm::dvec2(0.0) : over) + off.x * along + off.y * across);
    }
    return way;
}

TEST(Dwell, RecordedHandMovementsChooseNothingByAccident) {
    const std::vector<typography::TableRectangle>& pictures = shipped_pictures();
    Random random(24);
    int accidents = 0;
    int choices = 0;
    int rings = 0;
    double minutes = 0.0;
    for (const std::string name : {"vicon_handheld_1.csv", "camera_target_handheld_1.csv",
                                   "tum_fr1_xyz_groundtruth.txt", "tum_fr1_xyz_rgbdslam.txt"}) {
        const Result<Bytes> bytes = read_file(std::filesystem::path(shared_dir() + "/data/tracker") / name);
        if (!bytes) {
            GTEST_SKIP() << "the recordings are missing: " << bytes.error().message;
        }
        const tracker::RecordingOptions options{tracker::prop_station, true, {0.4, 0.25}};
        const Result<tracker::ConvertedRecording> recording =
            tracker::convert_recording(as_text(*bytes), name, options);
        ASSERT_TRUE(recording) << recording.error().message;
        const std::vector<tracker::PoseSample>& samples = recording->samples;
        for (int run = 0; run < 40; ++run) {
            const std::vector<glm::dvec2> way = some_way(random, samples, run == 0);
            Dwell dwell;
            bool ringed = false;
            for (std::size_t k = 0; k < samples.size(); ++k) {
                const DwellState state = dwell.update(samples[k].time, way[k], pictures);
                rings += state.place && !ringed ? 1 : 0;
                ringed = state.place.has_value();
                if (state.chosen) {
                    ++choices;
                    accidents += rested_before(samples, way, k) ? 0 : 1;
                }
            }
            minutes += to_seconds(samples.back().time - samples.front().time) / 60.0;
        }
    }
    RecordProperty("rings", rings);
    RecordProperty("choices", choices);
    RecordProperty("minutes", static_cast<int>(minutes));
    EXPECT_GT(rings, 150); // the hands pass over pictures and slow down there
    EXPECT_EQ(accidents, 0) << "of " << choices << " choices";
}

} // namespace
} // namespace frustumscreen::exhibit
