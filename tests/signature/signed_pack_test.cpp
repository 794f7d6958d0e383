// A pack is not used before its signature was verified. Signing changes one entry of a pack.
#include "app/pack/container/limits.h"
#include "app/pack/pack_reader.h"
#include "tests/base/told.h"
#include "tests/signature/signature_testing.h"

#include <unistd.h>

#include <cstring>
#include <filesystem>

namespace frustumscreen::pack {
namespace {

using pack::Packing;
using pack::ZipReader;
using pack::ZipWriter;
using testing::comment_of;
using testing::manifest_of;
using testing::signed_pack;
using testing::trusted;
using Why = PackRefusal::Why;

class SignedPacks : public ::testing::Test {
protected:
    tl::expected<SignedPack, PackRefusal> open(const Bytes& bytes,
                                               UnsignedPacks unsigned_packs = UnsignedPacks::Refuse) const {
        return open_signed_pack(bytes, {keys_, std::nullopt, unsigned_packs});
    }
    void expect_refused(const Bytes& bytes, Why why, SignatureFault fault, std::string_view words,
                        UnsignedPacks unsigned_packs = UnsignedPacks::Refuse) const {
        const auto opened = open(bytes, unsigned_packs);
        ASSERT_FALSE(opened) << words;
        const std::string told = test::told(opened.error().error);
        EXPECT_EQ(opened.error().why, why) << told;
        EXPECT_EQ(opened.error().fault, fault) << told;
        EXPECT_TRUE(samples::is_one_line(told));
        EXPECT_NE(told.find(words), std::string::npos) << told;
    }
    void expect_no_pack(const Bytes& bytes, std::string_view words) const {
        for (const UnsignedPacks unsigned_packs : {UnsignedPacks::Refuse, UnsignedPacks::Allow}) {
            expect_refused(bytes, Why::NotAPack, SignatureFault::Unsigned, words, unsigned_packs);
        }
    }

    SecretKey key_ = SecretKey::make();
    std::vector<TrustedKey> keys_{trusted(key_)};
};

/// A container of these entries, uncompressed.
Bytes zip_of(const std::vector<std::pair<std::string, std::string>>& entries) {
    ZipWriter zip;
    for (const auto& [name, text] : entries) {
        zip.add(name, as_bytes(text), Packing::Stored);
    }
    return zip.finish().value();
}

TEST_F(SignedPacks, GiveSignerTitleAndParts) {
    const Bytes bytes = signed_pack(samples::full_pack(), key_, 42);
    auto opened = open(bytes);
    ASSERT_TRUE(opened) << opened.error().error.message;
    EXPECT_EQ(opened->signer->key, "House");
    EXPECT_EQ(opened->signer->trusted_comment, comment_of(42));
    EXPECT_EQ(opened->serial(), 42U);
    EXPECT_EQ(opened->description().id, "museum-1234.a");
    const Result<VerifiedPack> pack = read_pack(opened->reader);
    ASSERT_TRUE(pack) << pack.error().message;
    EXPECT_EQ((*pack)->title, samples::full_pack().title);
    EXPECT_EQ(claim_of(opened->reader).value()->serial, 42U);
}

TEST_F(SignedPacks, OpenFromAFile) {
    ASSERT_TRUE(write_file("signed.fspack", signed_pack(samples::pack(), key_, 7)));
    auto opened =
        open_signed_pack(*OpenFile::open("signed.fspack", std::uint64_t{1} << 31U), {keys_, std::nullopt});
    std::filesystem::remove("signed.fspack");
    ASSERT_TRUE(opened) << opened.error().error.message;
    EXPECT_EQ(opened->serial(), 7U);
    EXPECT_TRUE(read_pack(opened->reader)) << "it is open, whatever its name";
}

/// The manifest is parsed after the signature check: an invalid manifest is not even read.
TEST_F(SignedPacks, CheckTheSignatureBeforeParsingTheManifest) {
    const std::string no_manifest = "{\"format\": [[[[";
    expect_refused(zip_of({{"manifest.json", no_manifest}}), Why::Signature, SignatureFault::Unsigned,
                   "[signature.unsigned]");
    expect_refused(zip_of({{"manifest.json", no_manifest}, {"signature", "hello"}}), Why::Signature,
                   SignatureFault::Malformed, "its signature");
    const std::string of_another = SecretKey::make().sign(as_bytes(no_manifest), comment_of(1));
    expect_refused(zip_of({{"manifest.json", no_manifest}, {"signature", of_another}}), Why::Signature,
                   SignatureFault::UnknownKey, "[signature.unknown_key]");
    const std::string right = key_.sign(as_bytes(no_manifest), comment_of(1));
    expect_refused(zip_of({{"manifest.json", no_manifest}, {"signature", right}}), Why::NotAPack,
                   SignatureFault::Unsigned, "manifest.json: ");
    expect_refused(zip_of({{"manifest.json", no_manifest + " "}, {"signature", right}}), Why::Signature,
                   SignatureFault::Altered, "altered after it was signed with the key House");
}

TEST_F(SignedPacks, AreRequiredUnlessUnsignedPacksAreAllowed) {
    const Bytes bytes = samples::bytes_of(samples::pack());
    expect_refused(bytes, Why::Signature, SignatureFault::Unsigned, "[signature.unsigned]");
    auto opened = open(bytes, UnsignedPacks::Allow);
    ASSERT_TRUE(opened) << opened.error().error.message;
    EXPECT_FALSE(opened->signer);
    EXPECT_EQ(opened->serial(), 0U);
    EXPECT_EQ(claim_of(opened->reader).value(), std::nullopt);
    // A signature that is present must be valid in any case.
    expect_refused(signed_pack(samples::pack(), SecretKey::make(), 1), Why::Signature,
                   SignatureFault::UnknownKey, "[signature.unknown_key]", UnsignedPacks::Allow);
}

TEST_F(SignedPacks, RejectFilesThatAreNoPacks) {
    expect_no_pack({}, "[zip.not_a_pack]");
    expect_no_pack(samples::some_bytes("a text, longer than a directory's end"), "[zip.not_a_pack]");
    Bytes cut = signed_pack(samples::pack(), key_, 1);
    cut.resize(cut.size() / 2);
    expect_no_pack(cut, "truncated");
    expect_no_pack(zip_of({{"photo.jpg", "x"}}), "not a pack");
    expect_no_pack(zip_of({{"photo.jpg", "x"}, {"manifest.json", "{}"}}), "[pack.no_manifest]");
}

TEST_F(SignedPacks, RejectOversizedSignaturesAndManifests) {
    const std::string large(pack::max_signature_bytes + 1, 'a');
    expect_no_pack(zip_of({{"manifest.json", "{}"}, {"signature", large}}),
                   "the signature has 65537 bytes, allowed are 65536");
    ZipWriter zip;
    zip.add("manifest.json", Bytes(pack::max_manifest_bytes + 1), Packing::Deflated);
    expect_no_pack(zip.finish().value(), "manifest.json has 16777217 bytes");
}

TEST_F(SignedPacks, ReportATruncatedFileAsUnreadable) {
    ASSERT_TRUE(write_file("pulled.fspack", signed_pack(samples::pack(), key_, 1)));
    Result<OpenFile> file = OpenFile::open("pulled.fspack", std::uint64_t{1} << 31U);
    ASSERT_EQ(::truncate("pulled.fspack", 100), 0);
    const auto opened = open_signed_pack(*std::move(file), {keys_, std::nullopt});
    std::filesystem::remove("pulled.fspack");
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().why, Why::Unreadable) << opened.error().error.message;
}

/// Names, sizes and packed bytes of all entries except the signature; independent of how they are written.
std::map<std::string, std::pair<std::uint64_t, Bytes>> packed_entries(const Bytes& pack) {
    auto zip = ZipReader::open(pack);
    std::map<std::string, std::pair<std::uint64_t, Bytes>> entries;
    for (const pack::ZipEntry& entry : zip->entries()) {
        if (entry.name != "signature") {
            entries[entry.name] = {entry.stored_bytes, zip->read(entry).value()};
        }
    }
    return entries;
}

TEST_F(SignedPacks, SigningKeepsAllOtherEntriesUnchanged) {
    const Bytes plain = samples::bytes_of(samples::full_pack());
    const Bytes once = with_signature(plain, key_.sign(manifest_of(plain), comment_of(1))).value();
    const Bytes twice = with_signature(once, key_.sign(manifest_of(plain), comment_of(2))).value();
    EXPECT_EQ(packed_entries(once), packed_entries(plain));
    EXPECT_EQ(packed_entries(twice), packed_entries(plain));
    EXPECT_EQ(open(twice)->serial(), 2U) << "the signature is replaced";
    EXPECT_EQ(ZipReader::open(twice)->entries().back().name, "signature");
    EXPECT_EQ(once.size(), twice.size());
    // Everything before the old directory is equal, byte by byte, including local headers.
    std::uint32_t directory = 0;
    std::memcpy(&directory, plain.data() + plain.size() - 6, sizeof directory);
    EXPECT_TRUE(std::equal(plain.begin(), plain.begin() + directory, once.begin()));
    EXPECT_TRUE(std::equal(plain.begin(), plain.begin() + directory, twice.begin()));
}

/// Another archive program may have placed the signature anywhere except first.
TEST_F(SignedPacks, AcceptTheSignatureAtAnyPlace) {
    const Bytes plain = samples::bytes_of(samples::pack());
    const std::string signature = key_.sign(manifest_of(plain), comment_of(5));
    auto zip = ZipReader::open(plain);
    ZipWriter writer;
    for (const pack::ZipEntry& entry : zip->entries()) {
        ASSERT_TRUE(writer.copy(*zip, entry));
        if (entry.name == "manifest.json") {
            writer.add("signature", as_bytes(signature), Packing::Deflated);
        }
    }
    const Bytes bytes = writer.finish().value();
    EXPECT_EQ(open(bytes)->serial(), 5U);
    EXPECT_EQ(with_signature(bytes, signature).value(), with_signature(plain, signature).value());
}

} // namespace
} // namespace frustumscreen::pack
