#include "app/scene/device_plan.h"
#include "tests/settings/steep_table.h"

#include <gtest/gtest.h>

namespace frustumscreen::scene {
namespace {

TEST(DevicePlan, OpensWhatIsConfigured) {
    settings::Settings settings = settings::steep_table();
    settings.exhibit.packs = {"a.fspack", "b.fspack"};
    const DevicePlan bare = plan_devices(settings, false, false);
    EXPECT_TRUE(bare.head);
    EXPECT_FALSE(bare.panel);
    EXPECT_FALSE(bare.other_packs);
    EXPECT_EQ(bare.threads.size(), 1U);
    EXPECT_EQ(bare.left_out.size(), 5U); // screen, torch, panel, second pack, status writer
    settings.panel.script = {{1.0, 2}};
    const DevicePlan languages = plan_devices(settings, false, true);
    EXPECT_TRUE(languages.panel);
    EXPECT_TRUE(languages.language);
    EXPECT_FALSE(languages.other_packs);
    EXPECT_EQ(languages.threads.size(), 2U);
    settings.panel.script = {{1.0, 1}};
    EXPECT_TRUE(plan_devices(settings, false, false).other_packs);
    EXPECT_TRUE(plan_devices(settings::Settings(), true, false).other_packs);
    settings.camera.visitor = true;
    EXPECT_TRUE(plan_devices(settings, false, false).visitor);
    EXPECT_EQ(plan_devices(settings, false, false).threads.back(),
              "the camera's reader, which sees who stands at the table");
    settings.camera.tags = true;
    EXPECT_EQ(plan_devices(settings, false, false).threads.back(),
              "the camera's reader, which finds the prop's tags and sees who stands at the table");
    settings.tracker.kind = settings::TrackerKind::None;
    EXPECT_FALSE(plan_devices(settings, false, false).head);
}

} // namespace
} // namespace frustumscreen::scene
