// A stick's request for a copy: which counts, and the one sentence about each that does not.
#include "app/kiosk_copy/copy_request.h"
#include "app/library/report_request.h"
#include "tests/kiosk_copy/copies.h"
#include "tests/library/volatile_disk.h"

#include <gtest/gtest.h>

namespace frustumscreen::kiosk_copy {
namespace {

using testing_copy::first_day;
using testing_disk::VolatileDisk;

const std::string good = "what = [\"settings\", \"packs\"]\nuntil = \"2024-10-10\"\n";

std::string fault_of(const std::string& text) {
    const Result<CopyRequest> request = parse_copy_request(text);
    EXPECT_TRUE(request || request.error().message.starts_with("frustumscreen-request.toml"));
    return request ? "" : std::string(request.error().id.view());
}

TEST(CopyRequest, ParsesTheRequestedParts) {
    const Result<CopyRequest> request = parse_copy_request(good);
    ASSERT_TRUE(request) << request.error().message;
    EXPECT_TRUE(request->settings && request->packs && !request->calibration && !request->counts);
    EXPECT_EQ(request->until, std::chrono::sys_days(std::chrono::year(2024) / 10 / 10));
    const Result<CopyRequest> all = parse_copy_request(
        "what = [\"counts\", \"calibration\", \"settings\", \"packs\"]\nuntil = \"2031-12-31\"\n");
    ASSERT_TRUE(all);
    EXPECT_FALSE(all->reset);
    const Result<CopyRequest> reset = parse_copy_request("reset = true\nuntil = \"2031-12-31\"\n");
    ASSERT_TRUE(reset);
    EXPECT_TRUE(reset->reset);
    EXPECT_FALSE(reset->asks_for_copy());
    EXPECT_TRUE(all->settings && all->packs && all->calibration && all->counts);
}

TEST(CopyRequest, RejectsInvalidRequests) {
    EXPECT_EQ(fault_of("until = \"2024-10-10\"\n"), "copy_request.nothing");
    EXPECT_EQ(fault_of("what = []\nuntil = \"2024-10-10\"\n"), "copy_request.nothing");
    EXPECT_EQ(fault_of("what = [\"everything\"]\nuntil = \"2024-10-10\"\n"), "copy_request.what");
    EXPECT_EQ(fault_of("what = [\"packs\"]\n"), "copy_request.until");
    EXPECT_EQ(fault_of("what = [\"packs\"]\nuntil = \"2024-02-30\"\n"), "copy_request.until");
    EXPECT_EQ(fault_of("reset = false\nuntil = \"2024-10-10\"\n"), "copy_request.nothing");
    EXPECT_EQ(fault_of("reset = true\n"), "copy_request.until");
    EXPECT_NE(fault_of("reset = \"yes\"\nuntil = \"2024-10-10\"\n"), "");
    EXPECT_NE(fault_of("what = [\"packs\"]\nuntil = \"2024-10-10\"\nreboot = true\n"), "");
    EXPECT_NE(fault_of("what = \n"), "");
    EXPECT_EQ(fault_of("what = [\"packs\"]\nuntil = \"2024-10-10\"\nmachine = \"a\\nb\"\n"),
              "copy_request.machine");
}

class SignedRequest : public ::testing::Test {
protected:
    void sign(const std::string& text, const pack::SecretKey& by) {
        stick.put(std::string(library::copy_request_name), text);
        stick.put(std::string(library::copy_request_signature), by.sign(as_bytes(text), "serial:7"));
    }
    /// None: the request counts.
    std::optional<library::ImportRefusal> refusal(std::chrono::sys_days today = first_day) {
        const auto request = read_copy_request(stick, keys, "frustumscreen-1a2b3c", today);
        EXPECT_TRUE(!request || *request);
        EXPECT_TRUE(request || request.error().reason.starts_with("frustumscreen-request.toml"));
        return request ? std::nullopt : std::optional(request.error().refusal);
    }
    VolatileDisk stick;
    pack::SecretKey key = pack::SecretKey::make(), other = pack::SecretKey::make();
    std::vector<pack::TrustedKey> keys{{"Museum", key.public_key(), std::nullopt}};
};

TEST_F(SignedRequest, MissingRequestIsNoError) {
    const auto request = read_copy_request(stick, keys, "frustumscreen-1a2b3c", first_day);
    ASSERT_TRUE(request);
    EXPECT_FALSE(*request);
}

TEST_F(SignedRequest, IsValidOnlyIfSignedByATrustedKey) {
    sign(good, key);
    EXPECT_EQ(refusal(), std::nullopt);
    sign(good, other);
    EXPECT_EQ(refusal(), library::ImportRefusal::WrongKey);
    sign(good, key);
    stick.put(std::string(library::copy_request_name), good + "# more\n");
    EXPECT_EQ(refusal(), library::ImportRefusal::Altered);
    stick.take_away(std::string(library::copy_request_signature));
    EXPECT_EQ(refusal(), library::ImportRefusal::Unsigned);
    keys[0].until = first_day - std::chrono::days(1);
    sign(good, key);
    EXPECT_EQ(refusal(), library::ImportRefusal::WrongKey);
    keys.clear();
    EXPECT_EQ(refusal(), library::ImportRefusal::WrongKey) << "a kiosk without a key gives nothing away";
}

TEST_F(SignedRequest, IsValidUntilItsLastDay) {
    sign(good, key);
    const std::chrono::sys_days last = std::chrono::year(2024) / 10 / 10;
    EXPECT_EQ(refusal(last), std::nullopt);
    EXPECT_EQ(refusal(last + std::chrono::days(1)), library::ImportRefusal::Older);
}

TEST_F(SignedRequest, IsValidOnlyForTheNamedMachine) {
    sign(good + "machine = \"frustumscreen-1a2b3c\"\n", key);
    EXPECT_EQ(refusal(), std::nullopt);
    sign(good + "machine = \"frustumscreen-000000\"\n", key);
    EXPECT_EQ(refusal(), library::ImportRefusal::WrongKey);
}

/// An empty one asks for nothing by itself, nor for what a signature would: it waits for the staff's buttons.
TEST_F(SignedRequest, EmptyUnsignedRequestWaitsForTheStaff) {
    const std::string name(library::copy_request_name);
    EXPECT_FALSE(library::waits_for_staff(stick)) << "there is none";
    stick.put(name, "");
    EXPECT_TRUE(library::waits_for_staff(stick));
    EXPECT_EQ(refusal(), library::ImportRefusal::Unsigned);
    EXPECT_TRUE(library::lines_of_stick_report(stick, std::nullopt, false).empty());
    ASSERT_EQ(library::lines_of_stick_report(stick, std::nullopt, true).size(), 1U)
        << "the writer left no word";
    for (const std::string text : {"\n", "what = [\"packs\"]\n"}) {
        stick.put(name, text);
        EXPECT_FALSE(library::waits_for_staff(stick)) << text;
        EXPECT_EQ(library::lines_of_stick_report(stick, std::nullopt, false).size(), 1U);
    }
    sign("", key);
    EXPECT_FALSE(library::waits_for_staff(stick));
    EXPECT_EQ(refusal(), library::ImportRefusal::NotAPack) << "it says nothing of what is wanted";
    const CopyRequest all = whole_copy();
    EXPECT_TRUE(all.settings && all.calibration && all.counts && all.packs && all.by_staff);
    EXPECT_FALSE(all.reset) << "the state of delivery needs a signature too";
}

TEST_F(SignedRequest, IsParsedOnlyAfterItsSignatureIsVerified) {
    sign("what = [\n", key);
    EXPECT_EQ(refusal(), library::ImportRefusal::NotAPack);
    sign("what = [\n", other);
    EXPECT_EQ(refusal(), library::ImportRefusal::WrongKey);
}

} // namespace
} // namespace frustumscreen::kiosk_copy
