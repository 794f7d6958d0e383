// A pack is written to bytes and read back. A changed byte is found by the hashes.
#include "app/pack/pack_file.h"
#include "tests/pack/samples.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Pack) {
    // example
    pack::Pack pack = samples::pack();
    pack.title = "A cup";
    Bytes bytes = pack::write_pack(pack).value();
    const pack::VerifiedPack read = pack::verify_pack(bytes).value();
    EXPECT_EQ(read->title, "A cup");
    const pack::Placement placement =
        pack::place(*read, geometry::make_frustum({})); // a pack knows no prop's size
    EXPECT_GT(placement.metres_per_box, 0.0);

    bytes[bytes.size() / 2] ^= std::byte{1};
    EXPECT_FALSE(pack::verify_pack(bytes));
    // end
}

} // namespace
} // namespace frustumscreen::example
