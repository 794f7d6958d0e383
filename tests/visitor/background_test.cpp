#include "app/visitor/background.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace frustumscreen::visitor {
namespace {

constexpr int width = 60;
constexpr int height = 40;
constexpr int table_rows = 10; // the lowest rows

std::vector<Shows> shows() {
    std::vector<Shows> all(width * height, Shows::Head);
    std::fill(all.end() - table_rows * width, all.end(), Shows::Table);
    return all;
}

/// A wall that is brighter to the right, lit by lamps and by a share of the projector's light that grows
/// upwards.
class Wall {
public:
    double lamps = 1.0, projector = 0.0;
    PixelBox thing;
    PixelBox prop; ///< the picture on it moves
    double moved = 0.0;
    SmallFrame frame() {
        moved += 0.15;
        SmallFrame frame{width, height, {}};
        for (int row = 0; row < height; ++row) {
            for (int column = 0; column < width; ++column) {
                const bool is_table = row >= height - table_rows;
                double code =
                    is_table ? 40.0 + 80.0 * projector : lamps * (60.0 + column) + projector * (height - row);
                if (row >= prop.top && row < prop.bottom && column >= prop.left && column < prop.right) {
                    code = 60.0 + 120.0 * projector * (0.7 + 0.3 * std::sin(0.3 * column + moved));
                }
                if (row >= thing.top && row < thing.bottom && column >= thing.left && column < thing.right) {
                    code = 25.0;
                }
                frame.luma.push_back(static_cast<float>(code + noise_(random_)));
            }
        }
        return frame;
    }

private:
    std::mt19937_64 random_{1};
    std::normal_distribution<double> noise_{0.0, 1.0};
};

/// A background and the time that it has seen so far.
class Watch {
public:
    Wall wall;
    std::vector<PixelBox> people;
    Background background{shows()};
    /// Number of foreground pixels after this time.
    long look(double seconds) {
        long count = 0;
        for (const double end_s = t_s_ + seconds; t_s_ < end_s; t_s_ += 1.0 / 30.0) {
            if (changes) {
                wall.projector = 0.5 + 0.5 * std::sin(2.0 * t_s_);
            }
            const SmallFrame frame = wall.frame();
            const auto foreground =
                background.find(MonotonicTime(Nanoseconds(std::llround(1e9 * (1.0 + t_s_)))), frame);
            count = std::count(foreground.begin(), foreground.end(), 255);
            most = std::max(most, count);
            background.learn(frame, people);
        }
        return count;
    }
    bool changes = false;
    long most = 0; ///< maximum over all frames since it was reset

private:
    double t_s_ = 0.0;
};

TEST(Background, DetectsAnObjectThatAppears) {
    Watch watch;
    EXPECT_EQ(watch.look(2.0), 0);
    watch.wall.thing = {20, 5, 40, 30};
    EXPECT_NEAR(static_cast<double>(watch.look(0.1)), 20.0 * 25.0, 20.0);
    EXPECT_EQ(watch.background.beginnings(), 1);
}

TEST(Background, LearnsObjectsButNoPeople) {
    Watch watch;
    static_cast<void>(watch.look(2.0));
    watch.wall.thing = {20, 5, 40, 30};
    watch.people = {{15, 0, 45, 40}};
    EXPECT_NEAR(static_cast<double>(watch.look(60.0)), 20.0 * 25.0, 20.0);
    watch.people.clear();
    EXPECT_EQ(watch.look(60.0), 0);
}

/// Otherwise a blot remains that resembles a head, and is taken for a person who stands still.
TEST(Background, DetectsPassersRepeatedlyWithoutTraces) {
    Watch watch;
    watch.changes = true;
    static_cast<void>(watch.look(20.0));
    const PixelBox passer{20, 5, 40, 30};
    for (int k = 0; k < 20; ++k) {
        watch.wall.thing = passer;
        EXPECT_NEAR(static_cast<double>(watch.look(0.7)), 20.0 * 25.0, 20.0) << k;
        watch.wall.thing = {};
        EXPECT_EQ(watch.look(1.3), 0) << k;
    }
}

/// Movement in the picture on the prop cannot be explained by a share of the table's mean.
TEST(Background, IgnoresTheProp) {
    Watch watch;
    watch.changes = true;
    watch.wall.prop = {10, 12, 30, 30};
    static_cast<void>(watch.look(20.0));
    watch.most = 0;
    static_cast<void>(watch.look(20.0));
    EXPECT_EQ(watch.most, 0);
}

TEST(Background, IgnoresDimmedLamps) {
    Watch watch;
    static_cast<void>(watch.look(2.0));
    for (watch.wall.lamps = 1.0; watch.wall.lamps > 0.5; watch.wall.lamps -= 0.01) {
        EXPECT_EQ(watch.look(0.1), 0) << watch.wall.lamps;
    }
    watch.wall.lamps = 1.4; // suddenly
    EXPECT_EQ(watch.look(0.1), 0);
    EXPECT_EQ(watch.background.beginnings(), 1);
}

/// Without the table in the same frames, the projector's light could not be identified.
TEST(Background, LearnsAndRemovesTheLightOfTheProjector) {
    Watch watch;
    watch.changes = true;
    static_cast<void>(watch.look(30.0));
    watch.most = 0;
    static_cast<void>(watch.look(10.0));
    EXPECT_EQ(watch.most, 0);
    watch.wall.thing = {20, 5, 40, 30};
    EXPECT_NEAR(static_cast<double>(watch.look(0.1)), 20.0 * 25.0, 20.0);
}

TEST(Background, RestartsWhenEverythingChangesAtOnce) {
    Watch watch;
    static_cast<void>(watch.look(2.0));
    watch.wall.projector = 3.0; // a lamp elsewhere, which no gain explains
    EXPECT_GT(watch.look(0.5), 500);
    EXPECT_EQ(watch.look(3.0), 0);
    EXPECT_EQ(watch.background.beginnings(), 2);
}

} // namespace
} // namespace frustumscreen::visitor
