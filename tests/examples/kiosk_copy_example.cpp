// A kiosk's settings become a copy, which another kiosk reads; a stick's request names what is wanted, and until when.
#include "app/kiosk_copy/copy_request.h"
#include "app/kiosk_copy/kiosk_copy.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, KioskCopy) {
    // example
    const kiosk_copy::CopyRequest request =
        kiosk_copy::parse_copy_request("what = [\"settings\", \"packs\"]\nuntil = \"2031-12-31\"\n").value();
    EXPECT_TRUE(request.settings && request.packs && !request.counts);
    kiosk_copy::KioskCopy copy;
    copy.settings = "[table]\nwidth_m = 0.7\n";
    const Bytes file = kiosk_copy::write_kiosk_copy(copy).value(); // kiosk.fsk; packs lie beside it
    EXPECT_EQ(kiosk_copy::parse_kiosk_copy(file).value().settings, copy.settings);
    EXPECT_FALSE(kiosk_copy::parse_kiosk_copy(std::span(file).first(file.size() / 2)));
    // end
}

} // namespace
} // namespace frustumscreen::example
