#include "firmware_host/display/output_properties.h"
#include "tests/display/fake_kms.h"

#include <gtest/gtest.h>

namespace frustumscreen::display {
namespace {

/// A connector as in i915 of Linux 6.1 (intel_connector.c, drm_connector.c).
std::vector<KmsProperty> intel_hdmi() {
    return {
        {1, 0, true, "EDID", {}},
        {2, 0, false, "max bpc", {}},
        {3, 0, false, "Broadcast RGB", {{"Automatic", 0}, {"Full", 1}, {"Limited 16:235", 2}}},
        {4, 9, false, "Colorspace", {{"Default", 0}, {"BT2020_RGB", 9}}},
        {5, 4, false, "content type", {{"No Data", 0}, {"Graphics", 1}, {"Game", 4}}},
        {6, 77, false, "HDR_OUTPUT_METADATA", {}},
    };
}

TEST(OutputProperties, SetFullRangeGraphicsAndNoHighDynamicRange) {
    const std::vector<PropertySetting> wanted{{3, 1}, {4, 0}, {5, 1}, {6, 0}};
    EXPECT_EQ(exact_picture(intel_hdmi()), wanted);
    std::vector<KmsProperty> set = intel_hdmi();
    for (const PropertySetting& setting : wanted) {
        set[setting.property - 1].value = setting.value;
    }
    EXPECT_TRUE(exact_picture(set).empty()) << "what is so already is left alone";
}

TEST(OutputProperties, TurnOffUnderscanAndMargins) {
    // amdgpu orders its enumeration differently from nouveau; vc4 has margins.
    EXPECT_EQ(exact_picture(std::vector<KmsProperty>{
                  {7, 2, false, "underscan", {{"off", 0}, {"on", 1}, {"auto", 2}}},
                  {8, 40, false, "underscan hborder", {}},
              }),
              (std::vector<PropertySetting>{{7, 0}}));
    EXPECT_EQ(exact_picture(std::vector<KmsProperty>{
                  {7, 0, false, "underscan", {{"auto", 0}, {"off", 3}}},
                  {1, 30, false, "left margin", {}},
                  {2, 0, false, "right margin", {}},
                  {3, 12, false, "top margin", {}},
                  {4, 12, true, "bottom margin", {}},
              }),
              (std::vector<PropertySetting>{{7, 3}, {1, 0}, {3, 0}}));
}

TEST(OutputProperties, IgnoreChoicesThatTheDriverDoesNotOffer) {
    EXPECT_TRUE(
        exact_picture(std::vector<KmsProperty>{{3, 0, false, "Broadcast RGB", {{"Automatic", 0}}}}).empty());
    EXPECT_TRUE(exact_picture({}).empty());
}

TEST(OutputProperties, ReportAnUncertainRangeOnHdmiInATelevisionsMode) {
    const ModeTiming television = a_mode(1920, 1080, 60.0);
    EXPECT_FALSE(range_in_doubt({}, true, television, true).empty());
    EXPECT_FALSE(range_in_doubt(intel_hdmi(), true, television, false).empty()) << "the driver refused it";
    EXPECT_TRUE(range_in_doubt(intel_hdmi(), true, television, true).empty());
    EXPECT_TRUE(range_in_doubt({}, false, television, true).empty()) << "DVI and VGA have one range";
    EXPECT_TRUE(range_in_doubt({}, true, a_mode(1280, 800, 60.0), true).empty()) << "full by the standard";
    EXPECT_TRUE(range_in_doubt({}, true, a_mode(640, 480, 60.0), true).empty()) << "its exception";
}

} // namespace
} // namespace frustumscreen::display
