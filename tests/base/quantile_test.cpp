#include "firmware_host/base/quantile.h"

#include <gtest/gtest.h>

#include <array>

namespace frustumscreen {
namespace {

TEST(Quantile, ReturnsAValueOfTheSample) {
    EXPECT_EQ(quantile({}, 0.5), 0.0);
    EXPECT_EQ(quantile({3.0, 1.0, 2.0}, 0.5), 2.0);
    EXPECT_EQ(quantile({4.0, 3.0, 1.0, 2.0}, 0.5), 2.0);
    EXPECT_EQ(quantile({4.0, 3.0, 1.0, 2.0}, 1.0), 4.0);
    EXPECT_EQ(quantile({4.0, 3.0, 1.0, 2.0}, 0.0), 1.0);
}

TEST(Quantile, InPlaceVersionLeavesValuesOutsideTheSpan) {
    std::array<float, 5> values{9.0F, 3.0F, 1.0F, 2.0F, 0.0F};
    EXPECT_EQ(quantile_in(std::span(values).subspan(1, 3), 0.5), 2.0);
    EXPECT_EQ(values.front(), 9.0F);
    EXPECT_EQ(values.back(), 0.0F);
}

} // namespace
} // namespace frustumscreen
