// After the first frames, a frame makes no allocations in our code. The driver's own malloc does not count.

#include "tests/render/counted_new.h"
#include "tests/render/rig.h"

namespace frustumscreen::synthetic {
namespace {

TEST(Frame, AllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    for (const int samples : {1, 4}) {
        Rig rig(320, 200, samples);
        TestTable table(320, 200);
        std::mt19937 random(5);
        long counted = 0;
        for (int k = 0; k < 60; ++k) {
            table.shuffle(random);
            const long before = allocations_so_far();
            scene::plan_frame(table.prop, rig.level, table.view(scene::LightCompensation{}), rig.plan);
            counted += allocations_so_far() - before;
            // In its first frames llvmpipe compiles shaders, with LLVM's C++ allocations.
            const long before_draw = allocations_so_far();
            rig.draw();
            counted += k < 20 ? 0 : allocations_so_far() - before_draw;
        }
        EXPECT_EQ(counted, 0) << samples;
    }
}

} // namespace
} // namespace frustumscreen::synthetic
