// Packs altered by a stick that was pulled too early, or by a flipped bit.
#include "tests/pack/samples.h"

using namespace frustumscreen;
using namespace frustumscreen::pack;

TEST(AlteredPack, every_truncation_is_refused_in_one_line) {
    const Bytes bytes = samples::bytes_of(samples::pack());
    for (std::size_t size = 0; size < bytes.size(); size += size < 200 ? 1 : 97) {
        const std::string message =
            samples::refusal_of(Bytes(bytes.begin(), bytes.begin() + std::ptrdiff_t(size)));
        ASSERT_TRUE(samples::is_one_line(message)) << size << ": " << message;
    }
    const std::string message = samples::refusal_of(Bytes(bytes.begin(), bytes.end() - 1));
    EXPECT_NE(message.find("truncated"), std::string::npos) << message;
}

TEST(AlteredPack, bytes_in_front_or_behind_are_refused) {
    Bytes bytes = samples::bytes_of(samples::pack());
    bytes.push_back(std::byte{0});
    EXPECT_TRUE(samples::is_one_line(samples::refusal_of(bytes)));
    bytes.pop_back();
    EXPECT_EQ(samples::refusal_of(bytes), "");
    bytes.insert(bytes.begin(), 4, std::byte{'P'});
    EXPECT_TRUE(samples::is_one_line(samples::refusal_of(bytes)));
}

TEST(AlteredPack, a_flipped_bit_is_refused_or_changes_nothing) {
    const Bytes bytes = samples::bytes_of(samples::pack());
    std::mt19937 random(17);
    int refused = 0;
    constexpr int flips = 1500;
    for (int k = 0; k < flips; ++k) {
        Bytes altered = bytes;
        const std::size_t where = random() % altered.size();
        altered[where] ^= static_cast<std::byte>(1U << (random() % 8));
        const Result<VerifiedPack> pack = verify_pack(altered);
        if (pack) {
            // Dates, attributes and similar fields of the container, which the reader ignores.
            ASSERT_EQ(samples::bytes_of(**pack), bytes) << "byte " << where;
        } else {
            ++refused;
            ASSERT_TRUE(samples::is_one_line(pack.error().message)) << where << ": " << pack.error().message;
        }
    }
    EXPECT_GT(refused, flips * 3 / 4);
}

TEST(AlteredPack, every_flipped_byte_of_a_part_is_refused) {
    const Bytes bytes = samples::bytes_of(samples::pack());
    const Bytes picture = samples::take_apart(bytes).part("textures/0.png");
    const auto there = std::search(bytes.begin(), bytes.end(), picture.begin(), picture.end());
    ASSERT_NE(there, bytes.end()) << "pictures are stored as they are";
    for (std::size_t k = 0; k < picture.size(); ++k) {
        Bytes altered = bytes;
        altered[static_cast<std::size_t>(there - bytes.begin()) + k] ^= std::byte{0x10};
        ASSERT_NE(samples::refusal_of(altered).find("textures/0.png"), std::string::npos) << k;
    }
}

TEST(AlteredPack, a_part_changed_with_its_checksum_still_fails_its_hash) {
    samples::Entries entries = samples::take_apart(samples::bytes_of(samples::pack()));
    entries.part("levels/0.bin")[30] ^= std::byte{1};
    const std::string message = samples::refusal_of(samples::put_together(entries));
    EXPECT_NE(message.find("levels/0.bin does not match its hash"), std::string::npos) << message;
}

TEST(AlteredPack, other_files_are_reported_as_not_a_pack) {
    EXPECT_NE(samples::refusal_of({}).find("not a pack"), std::string::npos);
    const std::string text(500, 'x');
    const auto bytes = as_bytes(text);
    EXPECT_NE(samples::refusal_of(Bytes(bytes.begin(), bytes.end())).find("not a pack"), std::string::npos);
    pack::ZipWriter zip;
    zip.add("letter.txt", as_bytes(text), pack::Packing::Deflated);
    EXPECT_NE(samples::refusal_of(zip.finish().value()).find("not a pack"), std::string::npos);
}
