// How often advice, carried out well, makes the picture whole within the moves that it names: solids in the hand against
// a cube of the settings.
#include "app/guidance/advise.h"
#include "guided_props.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <utility>

namespace frustumscreen::guidance {
namespace {

struct Restored {
    int cases = 0;  ///< situations in which a seen face is not lit
    int within = 0; ///< of them, those that the advice restores within its steps
    int waits = 0;
    [[nodiscard]] double share() const { return within / static_cast<double>(cases); }
};

bool every_seen_face_is_lit(const FaceReader& reader, const GuidedState& tracked_state) {
    return reader.read(tracked_state).unlit() == 0;
}

/// The visitor carries out each move well and asks again after it.
Restored follow(const std::string& name, const GuidanceSetup& setup, int situations) {
    const FaceReader reader(setup);
    bench::Seeded seeded(41);
    Restored restored;
    for (int k = 0; k < situations; ++k) {
        GuidedState tracked_state = bench::seeded_situation(setup, seeded);
        Advisor advisor(setup);
        std::optional<Advice> advice = advisor.advise(tracked_state);
        EXPECT_EQ(advice.has_value(), !every_seen_face_is_lit(reader, tracked_state)) << name << ' ' << k;
        if (!advice) {
            continue;
        }
        ++restored.cases;
        restored.waits += advice->move.action == Action::Wait ? 1 : 0;
        for (int left = advice->steps; left > 0 && advice; --left) {
            tracked_state = after(advice->move, setup, tracked_state);
            advice = advisor.advise(tracked_state);
        }
        restored.within += every_seen_face_is_lit(reader, tracked_state) ? 1 : 0;
    }
    std::printf("%s: mended within the steps named %d of %d (%.1f %%), %d to wait\n", name.c_str(),
                restored.within, restored.cases, 100.0 * restored.share(), restored.waits);
    return restored;
}

/// An eye sees up to three sides of an upright hexagonal prism, which no lens above it lights at many places: there no
/// listed move helps, and the visitor has to wait. In these situations at most one in 400 of all places, heights and
/// turns, as the prism leans or upright, makes the picture whole, and in one of ten none does: a hand does not meet them.
TEST(SolidAdvice, RestoresNearlyAllSituationsWithinItsSteps) {
    constexpr int situations = 150;
    const Restored cube = follow("cube of the settings", cube_setup(), situations);
    EXPECT_GT(cube.share(), 0.98);
    for (const auto& [name, min_share] : {std::pair("cube", 0.98), std::pair("hexagon", 0.90),
                                          std::pair("tetrahedron", 0.98), std::pair("gem", 0.98)}) {
        const Restored solid = follow(name, solid_setup(name), situations);
        EXPECT_GT(solid.cases, situations / 3) << name;
        EXPECT_GE(solid.share(), min_share) << name;
        EXPECT_GE(solid.within, 0.98 * (solid.cases - solid.waits))
            << name << ": of advice that names a move";
    }
}

} // namespace
} // namespace frustumscreen::guidance
