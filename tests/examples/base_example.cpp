// A function that can fail returns a Result. TRY takes the value, or returns the error to the caller.
#include "firmware_host/base/result.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Base) {
    // example
    const auto half_of = [](int number) -> Result<int> {
        if (number % 2 != 0) {
            return bad_input("number.odd", "{} has no half; give an even number", number);
        }
        return number / 2;
    };
    const auto quarter_of = [&](int number) -> Result<int> {
        TRY(const int half, half_of(number));
        return half_of(half);
    };
    EXPECT_EQ(quarter_of(12).value(), 3);
    EXPECT_EQ(quarter_of(6).error().id, "number.odd");
    // end
}

} // namespace
} // namespace frustumscreen::example
