// set.txt, the verdict, the report: written files are read back, and altered ones are refused.
#include "app/library/import_report.h"
#include "app/library/set_file.h"
#include "app/library/stick_walk.h"

#include <gtest/gtest.h>
#include <sodium.h>

#include <string>

namespace frustumscreen::library {
namespace {

InstalledSet a_set(std::uint64_t number) {
    const std::string hash(64, static_cast<char>('0' + number % 10));
    return {number,
            {{"packs/" + hash + ".fspack", "vase", "A \"vase\", Vase à colonnettes", 18446744073709551615ULL,
              hash, 1234, std::string(64, 'a')}},
            {{"en", "Come near"}}};
}

SetFile a_file() {
    return {{a_set(7), a_set(6)},
            a_set(5),
            12,
            std::string(64, 'b'),
            "2030-01-31",
            {{"vase", 18446744073709551615ULL}, {"cup", 0}},
            {{"2031", "RWQf6LRCGA9i53mlYecO4IzT51TGPpvWucNSCh1CBM0QTaLn73Y7GFO3", "2031-12-31",
              "RWQf6LRCGA9i53mlYecO4IzT51TGPpvWucNSCh1CBM0QTaLn73Y7GFO3", "2026-11-01"}}};
}

std::string with_right_hash(const std::string& body) {
    std::array<unsigned char, crypto_hash_sha256_BYTES> hash{};
    crypto_hash_sha256(hash.data(), reinterpret_cast<const unsigned char*>(body.data()), body.size());
    std::string digits(2 * hash.size() + 1, '\0');
    sodium_bin2hex(digits.data(), digits.size(), hash.data(), hash.size());
    digits.pop_back();
    return "frustumscreen-set 1 " + digits + "\n" + body;
}

TEST(SetFileText, RoundTrip) {
    const std::string text = write_set_file(a_file());
    EXPECT_EQ(parse_set_file(text).value(), a_file());
    EXPECT_EQ(text, with_right_hash(text.substr(text.find('\n') + 1)));
    SetFile first;
    EXPECT_EQ(parse_set_file(write_set_file(first)).value(), first);
}

TEST(SetFileText, RejectsEveryAlteredByte) {
    const std::string text = write_set_file(a_file());
    for (std::size_t k = 0; k < text.size(); ++k) {
        std::string altered = text;
        altered[k] = static_cast<char>(altered[k] ^ 1);
        EXPECT_FALSE(parse_set_file(altered)) << k;
        EXPECT_FALSE(parse_set_file(text.substr(0, k))) << k;
    }
    EXPECT_FALSE(parse_set_file(text + "\n"));
}

TEST(SetFileText, RejectsOtherFilePaths) {
    std::string body = write_set_file(a_file());
    body = body.substr(body.find('\n') + 1);
    for (const std::string file : {"../../etc/passwd", "/etc/passwd", "packs/x.fspack", ""}) {
        std::string other = body;
        const std::string name = "packs/" + std::string(64, '7') + ".fspack";
        other.replace(other.find(name), name.size(), file);
        EXPECT_FALSE(parse_set_file(with_right_hash(other))) << file;
    }
    EXPECT_TRUE(parse_set_file(with_right_hash(body)));
}

TEST(SetToShow, IsTheLastGoodOneOnlyIfTheNewOneFailed) {
    const SetChoice choice{a_set(7), a_set(6)};
    const auto shown = [&](const std::optional<SetVerdict>& verdict) {
        return set_to_show(choice, verdict).number;
    };
    EXPECT_EQ(shown(std::nullopt), 7U);
    EXPECT_EQ(shown(SetVerdict{7, TrialState::Good, 1, ""}), 7U);
    EXPECT_EQ(shown(SetVerdict{7, TrialState::Good, max_starts, ""}), 7U);
    EXPECT_EQ(shown(SetVerdict{7, TrialState::Bad, 1, "x"}), 6U);
    EXPECT_EQ(shown(SetVerdict{7, TrialState::Trying, max_starts - 1, ""}), 7U);
    EXPECT_EQ(shown(SetVerdict{7, TrialState::Trying, max_starts, ""}), 6U);
    EXPECT_EQ(shown(SetVerdict{6, TrialState::Bad, 1, "of another set"}), 7U);
    EXPECT_EQ(set_to_show({a_set(7), std::nullopt}, SetVerdict{7, TrialState::Bad, 9, ""}).number, 7U);
}

TEST(VerdictText, RoundTrip) {
    const SetVerdict verdict{3, TrialState::Bad, 2, "the vase cannot be shown"};
    EXPECT_EQ(parse_verdict(write_verdict(verdict)).value(), verdict);
    EXPECT_FALSE(parse_verdict(""));
    EXPECT_FALSE(parse_verdict(R"({"number":3,"verdict":"fine","starts":0,"reason":""})"));
    EXPECT_FALSE(parse_verdict(R"({"number":-3,"verdict":"bad","starts":0,"reason":""})"));
}

TEST(ReportText, RoundTripWithPrintableText) {
    ImportReport report{"17-4", "MUSEUM", ImportStage::Copying, 5, 10, ImportRefusal::None, "", 4, {}};
    report.packs = {{"a.fspack", "A vase", ImportOutcome::Taken, ImportRefusal::None, ""},
                    {"b.fspack", "", ImportOutcome::Refused, ImportRefusal::TooMuch, "too much"}};
    EXPECT_EQ(parse_import_report(write_import_report(report)).value(), report);
    report.stick = "a\nb\x1b[31m";
    report.packs[0].file = "\xff\xfe.fspack";
    const Result<ImportReport> read = parse_import_report(write_import_report(report));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->stick, "a?b?[31m");
    EXPECT_FALSE(parse_import_report("[1, 2"));
}

TEST(StickWalk, IgnoresSystemFilesAndFolders) {
    for (const std::string name :
         {"._vase.fspack", ".Trashes", ".Spotlight-V100", ".Trash-1000", "$RECYCLE.BIN", "$Recycle.Bin",
          "RECYCLER", "System Volume Information", "lost+found"}) {
        EXPECT_TRUE(is_ignored(name)) << name;
    }
    for (const std::string name : {"vase.fspack", "packs", "_vase.fspack", "$vase", "lost"}) {
        EXPECT_FALSE(is_ignored(name)) << name;
    }
}

} // namespace
} // namespace frustumscreen::library
