// Keys that sets bring: their signers, their last days, and how they are taken back.
#include "app/library/library_folder.h"
#include "app/library/pack_signers.h"
#include "app/library/trusted_keys.h"
#include "firmware_host/base/calendar_day.h"
#include "tests/library/stick_fixture.h"

namespace frustumscreen::library {
namespace {

using namespace testing_disk;

class ImportKeys : public StickTest {
protected:
    static std::string key_text(const pack::SecretKey& key, std::string_view until = "") {
        return fmt::format("[[key]]\nname = \"new\"\npublic_key = \"{}\"\n{}",
                           pack::public_key_line(key.public_key()),
                           until.empty() ? "" : fmt::format("until = \"{}\"\n", until));
    }
    /// Imports a stick that has only a set file with this text.
    ImportReport bring(const std::string& text, const pack::SecretKey& signer, std::uint64_t serial) {
        VolatileDisk other;
        other.put("exhibit.toml", text);
        other.put("exhibit.toml.minisig", signer.sign(as_bytes(text), fmt::format("serial:{}", serial)));
        return import_quietly(other, kiosk, request);
    }
    /// True if a new pack signed with this key is taken.
    bool is_believed(const pack::SecretKey& key, std::uint64_t serial = 0) {
        const std::string id = fmt::format("p{}", ++packs_);
        VolatileDisk other;
        other.put("p.fspack", Museum::signed_by(key, Museum::unsigned_pack(id, id), serial > 0 ? serial : 1));
        const ImportReport report = import_quietly(other, kiosk, request);
        return line_of(report, "p.fspack").outcome == ImportOutcome::Taken;
    }
    static std::chrono::sys_days day(std::string_view text) { return parse_day(text).value(); }

    const pack::SecretKey next = pack::SecretKey::make();
    const pack::SecretKey third = pack::SecretKey::make();

private:
    int packs_ = 0;
};

TEST_F(ImportKeys, AcceptsNewKeysSignedByTrustedOnes) {
    const pack::SecretKey next = pack::SecretKey::make();
    const std::string text =
        fmt::format("[[key]]\nname = \"2031\"\npublic_key = \"{}\"\nuntil = \"2040-12-31\"\n",
                    pack::public_key_line(next.public_key()));
    stick.put("a.fspack", Museum::signed_by(next, Museum::unsigned_pack("a", "a"), 1));
    stick.put("exhibit.toml", text);
    stick.put("exhibit.toml.minisig", next.sign(as_bytes(text), "serial:1"));
    EXPECT_EQ(import().refusal, ImportRefusal::WrongKey) << "a key does not vouch for itself";
    museum.put_exhibit(stick, text, 1);
    EXPECT_EQ(line_of(import(), "a.fspack").outcome, ImportOutcome::Taken) << "on the same stick";
    stick.take_away("exhibit.toml");
    stick.put("b.fspack", Museum::signed_by(next, Museum::unsigned_pack("b", "b"), 1));
    EXPECT_EQ(line_of(import(), "b.fspack").outcome, ImportOutcome::Taken) << "and from then on";
    request.today = std::chrono::sys_days(std::chrono::year(2041) / 1 / 1);
    stick.put("c.fspack", Museum::signed_by(next, Museum::unsigned_pack("c", "c"), 1));
    expect_refused("c.fspack", ImportRefusal::WrongKey, "2040-12-31");
}

TEST_F(ImportKeys, AKeyAloneMakesNoNewSet) {
    stick.put("a.fspack", museum.pack("a", 1));
    import();
    museum.put_exhibit(stick,
                       fmt::format("[[key]]\nname = \"2031\"\npublic_key = \"{}\"\n",
                                   pack::public_key_line(pack::SecretKey::make().public_key())),
                       1);
    const ImportReport report = import();
    EXPECT_EQ(line_of(report, "exhibit.toml").outcome, ImportOutcome::Taken);
    EXPECT_EQ(report.set_number, 1U) << "the exhibit has nothing to try";
    EXPECT_EQ(read_set_file(kiosk)->keys.size(), 1U);
}

TEST_F(ImportKeys, KeepsAndNamesPacksOfARevokedKey) {
    request.today = day("2026-11-20");
    ASSERT_EQ(bring(key_text(next), museum.key, 1).stage, ImportStage::Done);
    stick.put("jar.fspack", museum.pack("jar", 1));
    stick.put("vase.fspack", Museum::signed_by(next, Museum::unsigned_pack("vase", "Vase"), 1));
    stick.put("no_id.fspack", Museum::signed_by(next, Museum::unsigned_pack("", "Bowl"), 1));
    ASSERT_EQ(import().stage, ImportStage::Done);
    const ImportReport report = bring(key_text(next, "2026-11-01"), museum.key, 2);
    EXPECT_EQ(line_of(report, "exhibit.toml").outcome, ImportOutcome::Taken);
    const std::string reason = line_of(report, "exhibit.toml").reason;
    EXPECT_NE(reason.find("stay: Bowl, vase;"), std::string::npos) << reason;
    const SetFile file = *read_set_file(kiosk);
    ASSERT_EQ(file.choice.set.packs.size(), 3U) << "they are shown as before";
    const std::vector<pack::TrustedKey> counting = trusted_keys(request.keys, file.keys);
    const auto ended = [&](std::string_view today) {
        return packs_of_ended_keys(kiosk, file.choice.set, counting, day(today));
    };
    EXPECT_EQ(ended("2026-11-20"), (std::vector<std::string>{"Bowl", "vase"}));
    EXPECT_TRUE(ended("2026-11-01").empty()) << "its last day";
    EXPECT_TRUE(packs_of_ended_keys(kiosk, file.choice.set, counting, std::nullopt).empty())
        << "without a clock";
    EXPECT_EQ(signing_key(kiosk, file.choice.set.packs[0]), pack::text_of_key_id(museum.key.public_key().id));
    InstalledPack gone = file.choice.set.packs[1];
    gone.file = "packs/gone.fspack";
    EXPECT_FALSE(signing_key(kiosk, gone));
    const ImportReport again = bring(key_text(third), museum.key, 3);
    EXPECT_NE(line_of(again, "exhibit.toml").reason.find("vase"), std::string::npos) << "whichever key comes";
}

TEST(PackSigners, ListsAtMostFiveNames) {
    EXPECT_EQ(names_in_words(std::vector<std::string>{}), "");
    EXPECT_EQ(names_in_words(std::vector<std::string>{"a", "b"}), "a, b");
    EXPECT_EQ(names_in_words(std::vector<std::string>{"a", "b", "c", "d", "e", "f", "g"}),
              "a, b, c, d, e and 2 more");
}

TEST_F(ImportKeys, AKeyLosesTrustWithItsSigner) {
    ASSERT_EQ(bring(key_text(next), museum.key, 1).stage, ImportStage::Done);
    ASSERT_EQ(bring(key_text(third), next, 2).stage, ImportStage::Done);
    EXPECT_TRUE(is_believed(next));
    EXPECT_TRUE(is_believed(third));
    request.keys = {{"another", pack::SecretKey::make().public_key(), std::nullopt}};
    EXPECT_FALSE(is_believed(next));
    EXPECT_FALSE(is_believed(third));
    request.keys = {{"next", next.public_key(), std::nullopt}};
    EXPECT_TRUE(is_believed(third)) << "its chain is whole again";
    request.keys = museum.keys();
    ASSERT_EQ(bring(key_text(next, "2026-01-01"), museum.key, 3).stage, ImportStage::Done);
    request.today = day("2026-11-23");
    EXPECT_FALSE(is_believed(next)) << "taken back by a new end";
}

TEST_F(ImportKeys, AKeySurvivesItsSignersExpiryButNotItsRevocation) {
    request.keys[0].until = day("2030-12-31");
    request.today = day("2030-06-01");
    ASSERT_EQ(bring(key_text(next), museum.key, 1).stage, ImportStage::Done);
    EXPECT_EQ(read_set_file(kiosk)->keys.at(0).since, "2030-06-01");
    request.today = day("2031-06-01");
    EXPECT_FALSE(is_believed(museum.key));
    EXPECT_TRUE(is_believed(next)) << "it is there for the years to come";
    request.keys[0].until = day("2030-05-31"); // the key was stolen in June
    EXPECT_FALSE(is_believed(next));
}

TEST_F(ImportKeys, AKeyCannotExtendItself) {
    ASSERT_EQ(bring(key_text(next, "2030-12-31"), museum.key, 1).stage, ImportStage::Done);
    const ImportReport again = bring(key_text(next, "2099-12-31"), next, 2);
    EXPECT_EQ(again.refusal, ImportRefusal::WrongKey);
    EXPECT_NE(again.reason.find("sign it with another key"), std::string::npos) << again.reason;
    ASSERT_EQ(bring(key_text(third), next, 2).stage, ImportStage::Done);
    EXPECT_EQ(bring(key_text(next, "2099-12-31"), third, 3).refusal, ImportRefusal::WrongKey)
        << "nor in a ring";
    // Only the settings say when their own keys expire.
    request.keys[0].until = day("2030-12-31");
    request.today = day("2030-12-01");
    ASSERT_EQ(bring(key_text(museum.key, "2099-12-31"), museum.key, 4).stage, ImportStage::Done);
    request.today = day("2031-01-01");
    EXPECT_FALSE(is_believed(museum.key));
}

TEST_F(ImportKeys, AClockSetBackRevivesNoKey) {
    request.keys[0].until = day("2030-12-31");
    request.today = day("2031-01-01");
    EXPECT_FALSE(is_believed(museum.key));
    request.today = day("1970-01-01");
    EXPECT_FALSE(is_believed(museum.key));
    EXPECT_EQ(read_set_file(kiosk)->latest_day, "2031-01-01");
    // A clock that is far ahead once expires no key for ever.
    request.keys[0].until = day("2050-12-31");
    request.today = day("2100-01-01");
    EXPECT_FALSE(is_believed(museum.key));
    request.today = day("2031-01-02");
    EXPECT_TRUE(is_believed(museum.key));
}

TEST_F(ImportKeys, ASerialAdvancesTheLatestDay) {
    constexpr std::uint64_t in_2031 = 1927584000; // 2031-01-31, by date -u -d @1927584000
    request.keys = {{"old", museum.key.public_key(), day("2030-12-31")},
                    {"new", next.public_key(), std::nullopt}};
    request.today = day("1970-01-01");
    EXPECT_TRUE(is_believed(museum.key));
    EXPECT_TRUE(is_believed(next, in_2031));
    EXPECT_EQ(read_set_file(kiosk)->latest_day, "2031-01-31");
    EXPECT_FALSE(is_believed(museum.key));
    EXPECT_TRUE(is_believed(next, 99999999999)) << "a serial that is no time";
    EXPECT_EQ(read_set_file(kiosk)->latest_day, "2031-01-31");
}

} // namespace
} // namespace frustumscreen::library
