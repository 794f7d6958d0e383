// A kiosk's settings become a copy, which another kiosk reads; a stick's request names what is wanted, and until when.
#include "app/kiosk_copy/copy_request.h"
#include "app/kiosk_copy/kiosk_copy.h"

#include <gtest/gtest.h>

namespace frustumscreen {
namespace {

TEST(RoomExample, KioskCopy) {
    // example
    const CopyRequest request =
        parse_copy_request("what = [\"settings\", \"packs\"]\nuntil = \"2031-12-31\"\n").value();
    EXPECT_TRUE(request.settings && request.packs && !request.counts);
    KioskCopy copy;
    copy.settings = "[table]\nwidth_m = 0.7\n";
    const Bytes file = write_kiosk_copy(copy).value(); // kiosk.fsk; packs lie beside it
    EXPECT_EQ(parse_kiosk_copy(file).value().settings, copy.settings);
    EXPECT_FALSE(parse_kiosk_copy(std::span(file).first(file.size() / 2)));
    // end
}

} // namespace
} // namespace frustumscreen
