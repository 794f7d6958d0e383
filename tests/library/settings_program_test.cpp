// frustumscreen-import --settings on real folders: which settings of a stick are taken, and that others leave the
// kiosk's own intact.
#include "tests/folders.h"
#include "tests/library/museum.h"
#include "tests/programs/program_folder.h"

#include <sys/stat.h>

namespace frustumscreen::library {
namespace {

class SettingsProgram : public programs::ProgramFolder {
protected:
    void SetUp() override {
        for (const char* name : {"stick", "settings", "report"}) {
            std::filesystem::create_directories(folder / name);
        }
        put("settings/kiosk.toml", shipped);
    }
    [[nodiscard]] static std::string naming(const pack::SecretKey& key, const std::string& more = "") {
        return fmt::format("[exhibit]\nlanguage = \"de\"\n[[exhibit.keys]]\nname = \"Museum\"\n"
                           "public_key = \"{}\"\n{}",
                           pack::public_key_line(key.public_key()), more);
    }
    /// `serial` 0: unsigned.
    void fill(const std::string& content, const pack::SecretKey& key, std::uint64_t serial) const {
        std::filesystem::remove_all(folder / "stick");
        std::filesystem::create_directory(folder / "stick");
        put("stick/kiosk.toml", content);
        if (serial > 0) {
            put("stick/kiosk.toml.minisig", key.sign(as_bytes(content), fmt::format("serial:{}", serial)));
        }
    }
    [[nodiscard]] static std::string command() {
        return "frustumscreen-import --from stick --into library --config settings/kiosk.toml --settings "
               "settings --report report/report.json";
    }
    /// The outcome of the settings, from the report; the exit status is the stick's.
    [[nodiscard]] ImportedPack put_in() const {
        std::filesystem::remove(folder / "report/settings-taken");
        static_cast<void>(run(command()));
        const Result<ImportReport> report = parse_import_report(text("report/report.json"));
        EXPECT_TRUE(report) << text("err.txt");
        EXPECT_TRUE(report && !report->packs.empty()) << "nothing is told of the settings";
        const ImportedPack told = report && !report->packs.empty() ? report->packs.front() : ImportedPack();
        EXPECT_EQ(told.file, "kiosk.toml");
        EXPECT_EQ(std::filesystem::exists(folder / "report/settings-taken"),
                  told.outcome == ImportOutcome::Taken);
        return told;
    }
    void expect_refused(ImportRefusal why, std::string_view words) const {
        const std::string before = text("settings/kiosk.toml");
        const ImportedPack told = put_in();
        EXPECT_EQ(told.outcome, ImportOutcome::Refused);
        EXPECT_EQ(told.refusal, why) << told.reason;
        EXPECT_NE(told.reason.find(words), std::string::npos) << told.reason;
        EXPECT_EQ(text("settings/kiosk.toml"), before);
    }

    const std::string shipped = "[table]\nwidth_m = 0.9\n";
    pack::SecretKey key = pack::SecretKey::make(), other = pack::SecretKey::make();
};

TEST_F(SettingsProgram, AcceptsUnsignedSettingsUntilTheyNameAKey) {
    const std::string first = "# the museum's\r\n[table]\r\nwidth_m = 0.7\r\n";
    fill(first, key, 0);
    EXPECT_EQ(put_in().outcome, ImportOutcome::Taken);
    EXPECT_EQ(text("settings/kiosk.toml"), first);
    EXPECT_EQ(text("settings/kiosk.toml.before"), shipped);
    EXPECT_EQ(put_in().outcome, ImportOutcome::AlreadyThere);
    EXPECT_EQ(text("settings/kiosk.toml.before"), shipped) << "the same once more changes nothing";

    fill(naming(key), key, 0);
    EXPECT_EQ(put_in().outcome, ImportOutcome::Taken);
    EXPECT_EQ(put_in().outcome, ImportOutcome::AlreadyThere);
    fill(shipped, key, 0);
    expect_refused(ImportRefusal::Unsigned, "frustumscreen-pack sign");
    fill(shipped, other, 9);
    expect_refused(ImportRefusal::WrongKey, pack::text_of_key_id(other.public_key().id));
    fill(shipped, key, 9);
    put("stick/kiosk.toml", shipped + "#");
    expect_refused(ImportRefusal::Altered, "altered");

    const std::string next = naming(key, "\n[table]\nwidth_m = 0.8\n");
    fill(next, key, 20);
    EXPECT_EQ(put_in().outcome, ImportOutcome::Taken);
    EXPECT_EQ(text("settings/kiosk.toml"), next);
    fill(naming(key), key, 19);
    expect_refused(ImportRefusal::Older, "20");
    fill(naming(key), key, 21);
    EXPECT_EQ(put_in().outcome, ImportOutcome::Taken);
    // Signed settings without a key let any settings be taken again.
    fill(shipped, key, 22);
    EXPECT_EQ(put_in().outcome, ImportOutcome::Taken);
    fill(first, key, 0);
    EXPECT_EQ(put_in().outcome, ImportOutcome::Taken);
}

TEST_F(SettingsProgram, KeepsProvedSettingsAfterTwoBadSticks) {
    put("settings/kiosk.toml.proved", shipped);
    const std::string bad = "[table]\nwidth_m = 0.5\n", worse = "[table]\nwidth_m = 0.4\n";
    for (const std::string& settings : {bad, worse}) {
        fill(settings, key, 0);
        EXPECT_EQ(put_in().outcome, ImportOutcome::Taken);
        EXPECT_EQ(text("settings/kiosk.toml"), settings);
        EXPECT_EQ(text("settings/kiosk.toml.before"), shipped);
    }
    put("settings/kiosk.toml.proved", worse); // ten minutes later
    fill(bad, key, 0);
    EXPECT_EQ(put_in().outcome, ImportOutcome::Taken);
    EXPECT_EQ(text("settings/kiosk.toml.before"), worse);
}

TEST_F(SettingsProgram, TheFirstSerialRefusesOlderSettings) {
    fill(naming(key), key, 50);
    EXPECT_EQ(put_in().outcome, ImportOutcome::Taken);
    fill(naming(key, "# older\n"), key, 49);
    expect_refused(ImportRefusal::Older, "50");
}

TEST_F(SettingsProgram, AnExpiredKeyRefusesSignedAndUnsignedSettings) {
    put("settings/kiosk.toml", naming(key, "until = \"2020-12-31\"\n"));
    fill(shipped, key, 5);
    expect_refused(ImportRefusal::WrongKey, "2020-12-31");
    fill(shipped, key, 0);
    expect_refused(ImportRefusal::Unsigned, "");
}

TEST_F(SettingsProgram, ReportsErrorsWithTheirLine) {
    fill("[table]\nwidth_m = 0.7\ndepth_m = \"half\"\n", key, 0);
    expect_refused(ImportRefusal::NotAPack, "line 3");
    fill("[table\n", key, 0);
    expect_refused(ImportRefusal::NotAPack, "line 1");
    fill("[table]\nwidht_m = 0.7\n", key, 0);
    expect_refused(ImportRefusal::NotAPack, "line 2");
    // The reader's own message for the same file.
    const std::string reason = put_in().reason;
    EXPECT_EQ(run("frustumscreen-import --list --into library --config stick/kiosk.toml"), 1);
    EXPECT_NE(text("err.txt").find(reason.substr(reason.find(": ") + 2)), std::string::npos) << reason;
}

TEST_F(SettingsProgram, RefusesLargeAndIrregularFiles) {
    fill(std::string((64U << 10U) - 1, '#') + "\n", key, 0);
    EXPECT_EQ(put_in().outcome, ImportOutcome::Taken);
    fill(std::string((64U << 10U) + 1, '#'), key, 0);
    expect_refused(ImportRefusal::NotAPack, "65536");
    std::filesystem::resize_file(folder / "stick/kiosk.toml", std::uintmax_t{2} << 40U);
    expect_refused(ImportRefusal::NotAPack, "65536");
    const auto anew = [&] { std::filesystem::remove_all(folder / "stick/kiosk.toml"); };
    anew();
    std::filesystem::create_symlink(folder / "settings/kiosk.toml.before", folder / "stick/kiosk.toml");
    expect_refused(ImportRefusal::NotAPack, "not a regular file");
    anew();
    std::filesystem::create_directory(folder / "stick/kiosk.toml");
    expect_refused(ImportRefusal::NotAPack, "not a regular file");
    anew();
    ASSERT_EQ(::mkfifo((folder / "stick/kiosk.toml").c_str(), 0600), 0);
    expect_refused(ImportRefusal::NotAPack, "not a regular file");
}

/// A stick that is pulled from the office computer too early has such files.
TEST_F(SettingsProgram, RefusesEmptyAndTruncatedFiles) {
    const std::string whole = "[table]\nwidth_m = 0.7\n# the end of a comment\n";
    for (const std::string& empty : {std::string(), std::string("\r\n \n"), std::string(300, '\0')}) {
        fill(empty, key, 0);
        expect_refused(ImportRefusal::NotAPack, "it is empty");
    }
    fill(whole.substr(0, whole.size() - 8), key, 0);
    expect_refused(ImportRefusal::NotAPack, "its last line has no end");
    fill(whole.substr(0, whole.size() - 8), key, 7);
    EXPECT_EQ(put_in().outcome, ImportOutcome::Taken) << "a signature vouches for the file's end";
}

TEST_F(SettingsProgram, ReportsNearlyRightNames) {
    for (const std::string name : {"kiosk.toml.txt", "Kiosk.toml", "kiosk (1).toml", "set/kiosk.toml"}) {
        std::filesystem::remove_all(folder / "stick");
        std::filesystem::create_directories(folder / "stick/set");
        put("stick/" + name, "[table]\nwidth_m = 0.7\n");
        static_cast<void>(run(command()));
        const Result<ImportReport> report = parse_import_report(text("report/report.json"));
        ASSERT_TRUE(report) << text("err.txt");
        ASSERT_EQ(report->packs.size(), 1U) << name;
        EXPECT_EQ(report->packs[0].file, name);
        EXPECT_EQ(report->packs[0].outcome, ImportOutcome::Refused);
        EXPECT_NE(report->packs[0].reason.find("are called kiosk.toml"), std::string::npos)
            << report->packs[0].reason;
        EXPECT_EQ(text("settings/kiosk.toml"), shipped);
    }
    fill("[table]\nwidth_m = 0.7\n", key, 0);
    put("stick/kiosk.toml.txt", "no settings");
    EXPECT_EQ(put_in().outcome, ImportOutcome::Taken);
    EXPECT_EQ(parse_import_report(text("report/report.json"))->packs.size(), 1U)
        << "where there is one, others are no matter";
}

TEST_F(SettingsProgram, AcceptsPacksSignedWithTheKeyOfTheSameStick) {
    const testing_disk::Museum museum;
    fill(naming(museum.key), key, 0);
    ASSERT_TRUE(write_file(folder / "stick/vase.fspack", museum.pack("vase", 1)));
    EXPECT_EQ(put_in().outcome, ImportOutcome::Taken);
    const Result<ImportReport> report = parse_import_report(text("report/report.json"));
    ASSERT_EQ(report->packs.size(), 2U);
    EXPECT_EQ(report->packs[1].outcome, ImportOutcome::Taken) << report->packs[1].reason;
}

TEST_F(SettingsProgram, KeepsTheSettingsIfNewOnesCannotBeWritten) {
    fill(naming(key), key, 7);
    // The folder is read-only, for root too.
    static_cast<void>(std::system(
        fmt::format("cd '{}' && unshare --mount --map-root-user sh -c 'mount --bind settings settings && "
                    "mount -o remount,bind,ro settings && {}/{}' >out.txt 2>err.txt",
                    folder.string(), bin_dir(), command())
            .c_str()));
    const Result<ImportReport> report = parse_import_report(text("report/report.json"));
    ASSERT_TRUE(report && report->packs.size() == 1) << text("err.txt");
    EXPECT_EQ(report->packs[0].refusal, ImportRefusal::Unwritable);
    EXPECT_NE(report->packs[0].reason.find("Read-only file system"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder / "report/settings-taken"));
    EXPECT_EQ(text("settings/kiosk.toml"), shipped);
    // A folder blocks the first step, then the last but one; once it is gone, the same stick is taken.
    for (const char* in_the_way : {"settings/kiosk.toml.new", "settings/kiosk.toml.before"}) {
        std::filesystem::create_directories(folder / in_the_way / "inner");
        EXPECT_EQ(put_in().refusal, ImportRefusal::Unwritable) << in_the_way;
        EXPECT_EQ(text("settings/kiosk.toml"), shipped);
        std::filesystem::remove_all(folder / in_the_way);
    }
    EXPECT_EQ(put_in().outcome, ImportOutcome::Taken);
    EXPECT_EQ(text("settings/kiosk.toml.before"), shipped);
}

TEST_F(SettingsProgram, DamagedSettingsDoNotAcceptUnsignedOnes) {
    put("settings/kiosk.toml", "[exhi");
    fill(shipped, key, 0);
    expect_refused(ImportRefusal::Unwritable, "damaged");
    put("settings/kiosk.toml.before", naming(key));
    expect_refused(ImportRefusal::Unsigned, "");
    fill(shipped, key, 1);
    EXPECT_EQ(put_in().outcome, ImportOutcome::Taken);
    EXPECT_EQ(text("settings/kiosk.toml.before"), naming(key)) << "what is spoilt is nothing to go back to";
}

TEST_F(SettingsProgram, PackSignSignsOnlyValidSettings) {
    ASSERT_EQ(run("frustumscreen-pack keygen -o museum"), 0);
    put("stick/kiosk.toml", shipped);
    ASSERT_EQ(run("frustumscreen-pack sign stick/kiosk.toml --key museum.key --serial 3"), 0)
        << text("err.txt");
    const std::string line = text("museum.pub");
    const Result<pack::PublicKey> public_key = pack::parse_public_key(line);
    put("settings/kiosk.toml", fmt::format("[[exhibit.keys]]\nname = \"M\"\npublic_key = \"{}\"\n",
                                           pack::public_key_line(*public_key)));
    EXPECT_EQ(put_in().outcome, ImportOutcome::Taken);
    put("stick/kiosk.toml", "[table]\nwidht_m = 1\n");
    EXPECT_EQ(run("frustumscreen-pack sign stick/kiosk.toml --key museum.key"), 1);
    EXPECT_NE(text("err.txt").find("stick/kiosk.toml:2: "), std::string::npos) << text("err.txt");
}

} // namespace
} // namespace frustumscreen::library
