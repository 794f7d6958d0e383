#include "firmware_host/base/byte_reader.h"

#include <gtest/gtest.h>

#include <limits>

namespace frustumscreen {
namespace {

TEST(ByteReader, RoundTrip) {
    Bytes bytes;
    append(bytes, std::uint16_t{0x0102});
    append_all(bytes, std::vector<std::uint32_t>{3, 4, 5});
    append_all(bytes, std::vector<std::uint32_t>{});
    EXPECT_EQ(bytes.size(), 14U);
    EXPECT_EQ(bytes[0], std::byte{2}); // little-endian
    ByteReader reader(bytes);
    EXPECT_EQ(reader.read<std::uint16_t>(), 0x0102);
    EXPECT_EQ(reader.read_all<std::uint32_t>(3), (std::vector<std::uint32_t>{3, 4, 5}));
    EXPECT_EQ(reader.left(), 0U);
    EXPECT_TRUE(reader.read_all<std::uint32_t>(0).empty());
    EXPECT_TRUE(reader.ok());
}

TEST(ByteReader, ReadingPastTheEndFailsAndStaysFailed) {
    const Bytes bytes(7);
    ByteReader one(bytes);
    EXPECT_EQ(one.read<std::uint64_t>(), 0U);
    EXPECT_FALSE(one.ok());
    EXPECT_EQ(one.read<std::uint8_t>(), 0U);
    for (const std::size_t count : {std::size_t{2}, std::numeric_limits<std::size_t>::max()}) {
        ByteReader many(bytes); // a huge count must not allocate memory
        EXPECT_TRUE(many.read_all<std::uint32_t>(count).empty());
        EXPECT_FALSE(many.ok());
    }
}

} // namespace
} // namespace frustumscreen
