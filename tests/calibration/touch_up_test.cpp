// A kept calibration is touched up: the move is found, and the picture is corrected.
#include "app/calibration/touch_up.h"
#include "tests/calibration/simulated_touches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace frustumscreen::calibration {
namespace {

constexpr double top_m = 0.12;

/// Crosses spread over the picture and the blocks, the prop turned by a quarter turn from one to the next.
std::vector<Cross> few_crosses(const simulators::SimulatedTable& table, std::size_t count) {
    const std::vector<Cross> shares{{{0.07, 0.08}, 0.0, 0.0},  {{0.93, 0.2}, 0.12, 0.0},
                                    {{0.5, 0.93}, 0.0, 0.0},   {{0.93, 0.93}, 0.0, 0.0},
                                    {{0.07, 0.93}, 0.12, 0.0}, {{0.93, 0.07}, 0.0, 0.0},
                                    {{0.5, 0.07}, 0.12, 0.0}};
    std::vector<Cross> crosses(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t k = 0; k < count; ++k) {
        crosses[k].pixel *= glm::dvec2(table.truth.pinhole.width, table.truth.pinhole.height);
        crosses[k].yaw_rad = 0.5 * std::numbers::pi * static_cast<double>(k);
    }
    return crosses;
}

/// A table, its kept calibration, and the table after a bump.
struct Bumped {
    simulators::SimulatedTable before, table;
    CalibratedTable kept;
};

simulators::SimulatedTable moved_by(simulators::SimulatedTable table, Moved what, const glm::dvec3& turn,
                                    const glm::dvec3& shift) {
    const double angle = glm::length(turn);
    const geometry::RigidTransform change{glm::angleAxis(angle, turn / angle), shift};
    geometry::RigidTransform& pose =
        what == Moved::Projector ? table.truth.table_from_projector : table.truth.table_from_tracker;
    pose = pose * change; // about the lens, or the tracker's own origin
    return table;
}

/// A move in any direction that displaces the picture by `off_m`; a rotation of 20 mrad comes with a shift of
/// 20 mm.
Bumped bumped(std::uint64_t seed, Moved what, double off_m, ChosenCrosses& crosses) {
    Bumped out;
    out.before = simulators::some_table(seed);
    simulators::SeededNumbers numbers(8000 + seed);
    out.kept = *calibrate_touch(touches_of(out.before, crosses.of(out.before, 9), {}, numbers),
                                setup_for(out.before))
                    .table;
    out.table = out.before;
    if (what == Moved::Nothing) {
        return out;
    }
    const glm::dvec3 turn = numbers.normals();
    const glm::dvec3 shift = numbers.normals();
    double size = off_m;
    for (int k = 0; k < 8; ++k) {
        out.table = moved_by(out.before, what, size * turn, size * shift);
        size *= off_m / simulators::registration_error(out.table, out.before.truth, top_m).mean_m;
    }
    return out;
}

/// Distance of the pixel's light, at the touched height, from the touched place; millimetres.
double beside_mm(const CalibratedTable& table, const Touch& touch) {
    const glm::dvec3 touched =
        table.table_from_tracker.point(touch.tracker_from_sensor.point(table.sensor_offset_m));
    const glm::dvec3 lens = table.table_from_projector.translation;
    const glm::dvec3 ray = table.table_from_projector.direction(table.pinhole.ray(touch.pixel));
    const glm::dvec3 lit = lens + ray * ((touch.block_m - lens.z) / ray.z);
    return 1e3 * glm::distance(lit, touched);
}

struct Share {
    int named = 0, either = 0, misnamed = 0, nothing = 0, refused = 0, usable = 0, broken = 0;
    double before_mm = 0.0, after_mm = 0.0;
    double said_mm = 0.0; ///< mean over results with a table
    std::vector<double> worst_mm;
};

Share share_of(Moved what, double off_m, std::size_t count, std::uint64_t seeds, ChosenCrosses& crosses) {
    Share share;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const Bumped one = bumped(seed, what, off_m, crosses);
        simulators::SeededNumbers numbers(9000 + seed);
        const Touches touches = touches_of(one.table, few_crosses(one.table, count), {}, numbers);
        const TouchUp found = touch_up(one.kept, touches, setup_for(one.table));
        share.named += found.table && found.moved == what ? 1 : 0;
        share.either += found.moved == Moved::Either ? 1 : 0;
        share.nothing += found.table && found.moved == Moved::Nothing ? 1 : 0;
        share.misnamed += found.table && found.moved != what && found.moved != Moved::Either ? 1 : 0;
        share.refused += found.table ? 0 : 1;
        const simulators::RegistrationError before =
            simulators::registration_error(one.table, one.kept, top_m);
        const simulators::RegistrationError after =
            found.table ? simulators::registration_error(one.table, *found.table, top_m) : before;
        if (found.verdict == Verdict::Good || found.verdict == Verdict::Usable) {
            ++share.usable;
            share.broken += after.worst_m > (found.verdict == Verdict::Good ? 5e-3 : 8e-3) ? 1 : 0;
        }
        share.before_mm += 1e3 * before.mean_m / static_cast<double>(seeds);
        share.after_mm += 1e3 * after.mean_m / static_cast<double>(seeds);
        share.said_mm += 1e3 * found.uncertainty.mean_m / static_cast<double>(seeds);
        share.worst_mm.push_back(1e3 * after.worst_m);
        EXPECT_EQ(found.zone.size(), found.table ? 3 * zone_columns * zone_rows : 0);
    }
    std::sort(share.worst_mm.begin(), share.worst_mm.end());
    std::printf("%s, off by %2.0f mm, %d touches: mean %.2f -> %.2f mm (said %.2f), worst place in 9 of 10 "
                "%.2f; named %d, "
                "either %d, wrongly %d, nothing %d, refused %d; good or usable %d, broken %d\n",
                std::string(name_of(what)).c_str(), 1e3 * off_m, static_cast<int>(count), share.before_mm,
                share.after_mm, share.said_mm, share.worst_mm[share.worst_mm.size() * 9 / 10], share.named,
                share.either, share.misnamed, share.nothing, share.refused, share.usable, share.broken);
    return share;
}

struct Faulty {
    int sets = 0, refused = 0, repeat = 0, judged = 0, broken = 0;
};

/// One touch slipped by 5 to 80 mm, or was on another block than given.
Faulty with_one_wrong(Moved what, std::size_t count, std::uint64_t seeds, ChosenCrosses& crosses) {
    Faulty out;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const Bumped one = bumped(seed, what, 10e-3, crosses);
        simulators::SeededNumbers numbers(9500 + seed);
        Touches touches = touches_of(one.table, few_crosses(one.table, count), {}, numbers);
        Touch& wrong = touches[numbers.below(count)];
        if (seed % 2 == 0) {
            const double angle = numbers.between(0.0, 2.0 * std::numbers::pi);
            const double far = 5e-3 * std::exp(numbers.between(0.0, std::log(16.0)));
            wrong.tracker_from_sensor.translation +=
                glm::conjugate(one.table.truth.table_from_tracker.rotation) *
                (far * glm::dvec3(std::cos(angle), std::sin(angle), 0.0));
        } else {
            wrong.block_m += 0.04;
        }
        const TouchUp found = touch_up(one.kept, touches, setup_for(one.table));
        ++out.sets;
        out.refused += found.verdict == Verdict::Refused ? 1 : 0;
        out.repeat += found.verdict == Verdict::Repeat ? 1 : 0;
        if (found.verdict == Verdict::Good || found.verdict == Verdict::Usable) {
            ++out.judged;
            const double worst_m = simulators::registration_error(one.table, *found.table, top_m).worst_m;
            out.broken += worst_m > (found.verdict == Verdict::Good ? 5e-3 : 8e-3) ? 1 : 0;
            if (worst_m > 5e-3) {
                std::printf("  seed %d %s: %s, off by %.1f\n", static_cast<int>(seed),
                            std::string(name_of(found.verdict)).c_str(), found.reason.sentence.c_str(),
                            1e3 * worst_m);
            }
        }
    }
    std::printf("%s, one wrong of %d touches: of %d sets %d refused, %d to be repeated, %d good or usable, "
                "%d of them "
                "broken\n",
                std::string(name_of(what)).c_str(), static_cast<int>(count), out.sets, out.refused,
                out.repeat, out.judged, out.broken);
    return out;
}

TEST(TouchUp, ResidualsMatchTheFitOfTheOtherTouches) {
    ChosenCrosses crosses;
    int compared = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const Bumped one = bumped(seed, Moved::Tracker, 0.02, crosses);
        simulators::SeededNumbers numbers(9000 + seed);
        const Touches touches = touches_of(one.table, few_crosses(one.table, 7), {}, numbers);
        const TouchSetup setup = setup_for(one.table);
        const TouchUp found = touch_up(one.kept, touches, setup);
        for (std::size_t k = 0; found.moved == Moved::Tracker && k < touches.size(); ++k) {
            Touches others = touches;
            others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
            const TouchUp without = touch_up(one.kept, others, setup);
            if (without.moved != Moved::Tracker) {
                continue; // the move is ambiguous
            }
            ++compared;
            const double said_mm = 1e3 * found.residuals[k].on_table_m;
            EXPECT_NEAR(said_mm, beside_mm(*without.table, touches[k]), 0.02);
            EXPECT_GT(std::abs(said_mm - beside_mm(*found.table, touches[k])), 0.02) << "by its own table";
        }
    }
    EXPECT_GE(compared, 7);
}

TEST(TouchUp, CorrectsThePictureAfterAMove) {
    ChosenCrosses crosses;
    for (const Moved what : {Moved::Projector, Moved::Tracker}) {
        const Share share = share_of(what, 10e-3, 7, 8, crosses);
        EXPECT_LT(share.after_mm, 1.0);
        EXPECT_NEAR(share.said_mm / share.after_mm, 1.0, 0.35); // the reported uncertainty is right
        EXPECT_GE(share.usable, 6);
        EXPECT_LE(share.misnamed, 1);
        EXPECT_EQ(share.broken, 0);
    }
}

/// One wrong touch is refused, or more touches are requested.
TEST(TouchUp, VerdictsHoldWithOneWrongTouch) {
    ChosenCrosses crosses;
    for (const std::size_t count : {3U, 5U}) {
        EXPECT_EQ(with_one_wrong(Moved::Projector, count, 12, crosses).broken, 0);
    }
}

TEST(TouchUp, ReportsThatNothingMoved) {
    ChosenCrosses crosses;
    const Share share = share_of(Moved::Nothing, 0.0, 3, 20, crosses);
    EXPECT_GE(share.nothing, 19);
}

/// Refusals: touches that contradict each other by a wrong block or a tracker glitch; touches in a line;
/// touches in a corner; too few.
TEST(TouchUp, RefusesDegenerateTouchesWithAReason) {
    ChosenCrosses crosses;
    const Bumped one = bumped(3, Moved::Projector, 10e-3, crosses);
    simulators::SeededNumbers numbers(1);
    const TouchSetup setup = setup_for(one.table);
    const auto reason = [&](const Touches& touches) {
        const TouchUp found = touch_up(one.kept, touches, setup);
        EXPECT_EQ(found.verdict, Verdict::Refused);
        EXPECT_FALSE(found.table);
        return found.reason.sentence;
    };
    const Touches good = touches_of(one.table, few_crosses(one.table, 3), {}, numbers);
    EXPECT_NE(touch_up(one.kept, good, setup).verdict, Verdict::Refused);
    EXPECT_NE(reason({good[0], good[1]}).find("too few"), std::string::npos);
    EXPECT_NE(reason({good[0], good[1], good[1]}).find("different places"), std::string::npos);
    Touches wrong = good;
    wrong[1].tracker_from_sensor.translation += 0.3 * numbers.normals();
    EXPECT_NE(reason(wrong).find("contradict"), std::string::npos);
    std::vector<Cross> line = few_crosses(one.table, 3);
    line[2].pixel = 0.5 * (line[0].pixel + line[1].pixel);
    EXPECT_NE(reason(touches_of(one.table, line, {}, numbers)).find("line"), std::string::npos);
    for (Cross& cross : line) {
        cross.pixel *= 0.1;
    }
    EXPECT_NE(reason(touches_of(one.table, line, {}, numbers)).find("near"), std::string::npos);
}

/// Crosses as `table` chooses them for the kept projector: the first `few`, then `more`.
std::vector<Cross> chosen_crosses(const CalibratedTable& kept, int few, int more) {
    TouchModel model;
    model.pinhole = kept.pinhole;
    model.projector_from_tracker = kept.table_from_projector.inverse();
    model.sensor_offset_m = kept.sensor_offset_m;
    CrossSetup setup;
    setup.count = few;
    return choose_touch_up_crosses(model, setup, more);
}

struct ByButtons {
    int refused = 0, after_few = 0, after_all = 0, broken = 0;
    double before_mm = 0.0, after_mm = 0.0;
};

/// A projector bumped by 10 mm, touched up at the crosses that the table shows: seven, and two more if seven
/// are not enough.
ByButtons by_buttons(int few, int more, std::uint64_t seeds, ChosenCrosses& crosses) {
    ByButtons out;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const Bumped one = bumped(seed, Moved::Projector, 10e-3, crosses);
        const std::vector<Cross> chosen = chosen_crosses(one.kept, few, more);
        simulators::SeededNumbers numbers(9700 + seed);
        const Touches all = touches_of(one.table, chosen, {}, numbers);
        const auto first = std::span(all).first(static_cast<std::size_t>(few));
        TouchUp found = touch_up(one.kept, first, setup_for(one.table));
        const bool is_enough = found.verdict == Verdict::Good || found.verdict == Verdict::Usable;
        out.after_few += is_enough ? 1 : 0;
        if (found.verdict == Verdict::Repeat && more > 0) {
            found = touch_up(one.kept, all, setup_for(one.table));
        }
        const bool is_kept = found.verdict == Verdict::Good || found.verdict == Verdict::Usable;
        const simulators::RegistrationError before =
            simulators::registration_error(one.table, one.kept, top_m);
        const simulators::RegistrationError after =
            is_kept ? simulators::registration_error(one.table, *found.table, top_m) : before;
        out.refused += found.verdict == Verdict::Refused ? 1 : 0;
        out.after_all += is_kept ? 1 : 0;
        out.broken += is_kept && after.worst_m > (found.verdict == Verdict::Good ? 5e-3 : 8e-3) ? 1 : 0;
        out.before_mm += 1e3 * before.mean_m / static_cast<double>(seeds);
        out.after_mm += 1e3 * after.mean_m / static_cast<double>(seeds);
    }
    std::printf(
        "%d crosses as they are chosen, and %d more: %.1f -> %.2f mm; good or usable after the first %d, "
        "after all %d, refused %d, broken %d of %d\n",
        few, more, out.before_mm, out.after_mm, out.after_few, out.after_all, out.refused, out.broken,
        static_cast<int>(seeds));
    return out;
}

TEST(TouchUp, VerdictsHoldAtTheShownCrosses) {
    ChosenCrosses crosses;
    const ByButtons seven = by_buttons(7, 2, 4, crosses);
    EXPECT_EQ(seven.after_all + seven.refused, 4);
    EXPECT_GE(seven.after_few, 2);
    EXPECT_LE(seven.refused, 1);
    EXPECT_EQ(seven.broken, 0);
}

// The figures of docs/calibration.md: `ctest -C long -R calibration_touch_up`.
TEST(TouchUp, DISABLED_TheFigures) {
    ChosenCrosses crosses;
    for (const int few : {3, 5, 6, 7, 9}) {
        EXPECT_EQ(by_buttons(few, few == 7 ? 2 : 0, 40, crosses).broken, 0);
    }
    for (const std::size_t count : {3U, 5U, 7U}) {
        for (const Moved what : {Moved::Nothing, Moved::Projector, Moved::Tracker}) {
            EXPECT_EQ(with_one_wrong(what, count, 100, crosses).broken, 0);
        }
        share_of(Moved::Nothing, 0.0, count, 100, crosses);
        for (const Moved what : {Moved::Projector, Moved::Tracker}) {
            for (const double off_m : {2e-3, 5e-3, 10e-3, 20e-3}) {
                EXPECT_EQ(share_of(what, off_m, count, 100, crosses).broken, 0);
            }
        }
    }
}

} // namespace
} // namespace frustumscreen::calibration
