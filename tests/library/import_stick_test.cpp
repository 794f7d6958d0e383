// What becomes of a stick: taken, there already, refused, removed; and what is kept for the exhibit meanwhile.
#include "tests/library/museum.h"

#include <cerrno>

namespace frustumscreen {
namespace {

using namespace testing_disk;

/// One byte of a part is another, and the container's checksum is right.
Bytes with_another_part(const Bytes& pack) {
    Result<pack_format::ZipReader> zip = pack_format::ZipReader::open(pack);
    pack_format::ZipWriter other;
    for (const pack_format::ZipEntry& entry : zip->entries()) {
        Bytes part = zip->read(entry).value();
        if (entry.name == "padding.bin") {
            part[0] ^= std::byte{1};
        }
        other.add(entry.name, part, pack_format::Packing::Stored);
    }
    return other.finish().value();
}

class ImportStick : public ::testing::Test {
protected:
    ImportReport import() {
        ImportReport report = import_quietly(stick, kiosk, request);
        EXPECT_EQ(inspector.fault_of(kiosk), "");
        return report;
    }
    static std::vector<std::string> ids(VolatileDisk& disk) { return ids_of(installed(disk)); }
    std::size_t pack_files() {
        std::size_t count = 0;
        EXPECT_TRUE(kiosk.list("packs", [&](const FolderEntry&) {
            ++count;
            return true;
        }));
        return count;
    }
    void expect_refused(const std::string& file, ImportRefusal refusal, const std::string& words) {
        const ImportReport report = import();
        const ImportedPack& line = line_of(report, file);
        EXPECT_EQ(line.outcome, ImportOutcome::Refused);
        EXPECT_EQ(line.refusal, refusal);
        EXPECT_NE(line.reason.find(words), std::string::npos) << line.reason;
        EXPECT_TRUE(samples::is_one_line(line.reason)) << line.reason;
        EXPECT_EQ(line.title, refusal == ImportRefusal::Older ? line.title : "");
    }

    Museum museum;
    ImportRequest request = request_of(museum);
    VolatileDisk stick, kiosk;
    Inspector inspector;
};

TEST_F(ImportStick, TakesPacksFromTheRootAndOneFolderDown) {
    stick.put("b.FSPACK", museum.pack("b", 1));
    stick.put("folder/a.fspack", museum.pack("a", 7));
    stick.put("folder/._a.fspack", "a twin");
    stick.put(".hidden/x.fspack", museum.pack("x", 1));
    stick.put("$RECYCLE.BIN/y.fspack", museum.pack("y", 1));
    stick.put("System Volume Information/z.fspack", museum.pack("z", 1));
    stick.put(".Trash-1000/u.fspack", museum.pack("u", 1));
    stick.put("lost+found/v.fspack", museum.pack("v", 1));
    stick.put("holiday.jpg", "a picture");
    std::vector<ImportStage> stages;
    ImportSurroundings outside = quiet_surroundings();
    outside.tell = [&](const ImportReport& report) {
        EXPECT_LE(report.done_bytes, report.total_bytes);
        if (stages.empty() || stages.back() != report.stage) {
            stages.push_back(report.stage);
        }
    };
    const ImportReport report = import_stick(stick, kiosk, request, outside);
    EXPECT_EQ(stages, (std::vector{ImportStage::Found, ImportStage::Copying, ImportStage::MayTakeOut,
                                   ImportStage::Done}));
    ASSERT_EQ(report.packs.size(), 2U);
    EXPECT_EQ(line_of(report, "folder/a.fspack").title, "a 7");
    EXPECT_EQ(line_of(report, "b.FSPACK").outcome, ImportOutcome::Taken);
    EXPECT_EQ(ids(kiosk), (std::vector<std::string>{"b 1", "a 7"}));
    EXPECT_EQ(report.set_number, 1U);
    EXPECT_EQ(report.done_bytes, report.total_bytes);
    EXPECT_EQ(pack_files(), 2U);
}

TEST_F(ImportStick, TheSameStickTwiceChangesNothing) {
    stick.put("a.fspack", museum.pack("a", 1));
    stick.put("plain.fspack", Museum::unsigned_pack("", "no id"));
    museum.put_exhibit(stick, "order = [\"a\"]\n", 3);
    request.unsigned_packs = UnsignedPacks::Allow;
    EXPECT_EQ(line_of(import(), "plain.fspack").outcome, ImportOutcome::Taken);
    const std::string text(as_text(**kiosk.content("set.txt")));
    const ImportReport again = import();
    EXPECT_EQ(again.stage, ImportStage::Done);
    for (const ImportedPack& line : again.packs) {
        EXPECT_EQ(line.outcome, ImportOutcome::AlreadyThere) << line.file;
    }
    EXPECT_EQ(again.total_bytes, 0U);
    EXPECT_EQ(as_text(**kiosk.content("set.txt")), text);
}

TEST_F(ImportStick, AnEmptyStickIsAllRight) {
    EXPECT_EQ(import().stage, ImportStage::Done);
    EXPECT_FALSE(kiosk.content("set.txt"));
}

TEST_F(ImportStick, RefusesWhatIsNotTheMuseums) {
    const Bytes plain = Museum::unsigned_pack("a", "a");
    stick.put("a.fspack", plain);
    expect_refused("a.fspack", ImportRefusal::Unsigned, "not signed");
    stick.put("a.fspack", Museum::signed_by(SecretKey::make(), plain, 1));
    expect_refused("a.fspack", ImportRefusal::WrongKey, "none of those known");
    request.keys[0].until = std::chrono::sys_days(std::chrono::year(2030) / 12 / 31);
    request.today = std::chrono::sys_days(std::chrono::year(2100) / 1 / 1);
    stick.put("a.fspack", museum.pack("a", 1));
    expect_refused("a.fspack", ImportRefusal::WrongKey, "2100-01-01");
    request.today = std::chrono::sys_days(std::chrono::year(1970) / 1 / 1);
    EXPECT_EQ(line_of(import(), "a.fspack").outcome, ImportOutcome::Taken);
}

TEST_F(ImportStick, RefusesWhatWasAlteredOrIsNoPack) {
    Bytes bytes = museum.pack("a", 1, 3000);
    stick.put("short.fspack", Bytes(bytes.begin(), bytes.end() - 1));
    stick.put("empty.fspack", Bytes());
    stick.put("text.fspack", "not a ZIP");
    // Manifest and signature of these are right, so it is the copy's check that finds them.
    stick.put("other_part.fspack", with_another_part(bytes));
    bytes[bytes.size() - 2000] ^= std::byte{1};
    stick.put("altered.fspack", bytes);
    const ImportReport report = import();
    EXPECT_EQ(report.stage, ImportStage::Done);
    for (const std::string file : {"short.fspack", "empty.fspack", "text.fspack"}) {
        EXPECT_EQ(line_of(report, file).refusal, ImportRefusal::NotAPack) << file;
    }
    for (const std::string file : {"altered.fspack", "other_part.fspack"}) {
        const ImportedPack& line = line_of(report, file);
        EXPECT_EQ(line.refusal, ImportRefusal::Altered) << file;
        EXPECT_NE(line.reason.find("padding.bin"), std::string::npos) << line.reason;
    }
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{});
    EXPECT_EQ(pack_files(), 0U);
    stick.put("whole.fspack", museum.pack("a", 1, 3000));
    EXPECT_EQ(line_of(import(), "whole.fspack").outcome, ImportOutcome::Taken) << "of three with one id";
}

TEST_F(ImportStick, NeverTakesALowerSerialThanOnceTaken) {
    stick.put("a.fspack", museum.pack("a", 5));
    import();
    stick.put("a.fspack", museum.pack("a", 4));
    expect_refused("a.fspack", ImportRefusal::Older, "serial 5");
    stick.put("a.fspack", museum.pack("a", 5, 100)); // another one
    expect_refused("a.fspack", ImportRefusal::Older, "the same serial 5");
    // Neither when it is no longer there.
    stick.put("a.fspack", museum.pack("b", 1));
    museum.put_exhibit(stick, "remove = [\"a\"]\n", 1);
    const ImportReport removed = import();
    EXPECT_EQ(line_of(removed, "a").outcome, ImportOutcome::Removed);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"b 1"});
    stick.take_away("exhibit.toml");
    stick.put("a.fspack", museum.pack("a", 4));
    expect_refused("a.fspack", ImportRefusal::Older, "serial 5");
    request.unsigned_packs = UnsignedPacks::Allow;
    stick.put("a.fspack", Museum::unsigned_pack("a", "a"));
    expect_refused("a.fspack", ImportRefusal::Older, "unsigned");
    stick.put("a.fspack", museum.pack("a", 6));
    EXPECT_EQ(line_of(import(), "a.fspack").outcome, ImportOutcome::Taken);
}

TEST_F(ImportStick, OfTwoWithOneIdTakesTheNewer) {
    stick.put("1.fspack", museum.pack("a", 1));
    stick.put("2.fspack", museum.pack("a", 3));
    stick.put("3.fspack", museum.pack("a", 2));
    stick.put("4.fspack", museum.pack("a", 3));
    const ImportReport report = import();
    EXPECT_EQ(line_of(report, "1.fspack").refusal, ImportRefusal::Older);
    EXPECT_EQ(line_of(report, "2.fspack").outcome, ImportOutcome::Taken);
    EXPECT_EQ(line_of(report, "3.fspack").refusal, ImportRefusal::Older);
    EXPECT_EQ(line_of(report, "4.fspack").outcome, ImportOutcome::AlreadyThere);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 3"});
}

TEST_F(ImportStick, ANewerPackStandsInTheOlderOnesPlace) {
    for (const std::string id : {"a", "b", "c"}) {
        stick.put(id + ".fspack", museum.pack(id, 1));
    }
    import();
    stick.put("b.fspack", museum.pack("b", 2));
    import();
    EXPECT_EQ(ids(kiosk), (std::vector<std::string>{"a 1", "b 2", "c 1"}));
}

TEST_F(ImportStick, ASetFileIsTakenWholeOrNotAtAll) {
    stick.put("a.fspack", museum.pack("a", 1));
    stick.put("b.fspack", Museum::unsigned_pack("b", "b"));
    museum.put_exhibit(stick, "order = [\"a\"]\n", 1);
    const ImportReport torn = import();
    EXPECT_EQ(torn.stage, ImportStage::Failed);
    EXPECT_EQ(torn.refusal, ImportRefusal::Unsigned);
    EXPECT_EQ(line_of(torn, "a.fspack").outcome, ImportOutcome::Refused);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{});
    stick.put("b.fspack", museum.pack("b", 1));
    EXPECT_EQ(import().stage, ImportStage::Done);
    EXPECT_EQ(ids(kiosk), (std::vector<std::string>{"a 1", "b 1"}));
    museum.put_exhibit(stick, "order = [\"a\", \"missing\"]\n", 2);
    EXPECT_NE(import().reason.find("\"missing\""), std::string::npos);
    museum.put_exhibit(stick, "order = [\"a\"]\nonly = true\n", 2);
    EXPECT_NE(import().reason.find("\"b\""), std::string::npos);
    stick.take_away("b.fspack");
    const ImportReport only = import();
    EXPECT_EQ(line_of(only, "b").outcome, ImportOutcome::Removed);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 1"});
    museum.put_exhibit(stick, "order = [\"a\"]\n", 1);
    EXPECT_EQ(import().refusal, ImportRefusal::Older);
    stick.put("exhibit.toml", "order = [\"b\"]\n");
    EXPECT_EQ(import().refusal, ImportRefusal::Altered);
    stick.take_away("exhibit.toml.minisig");
    EXPECT_EQ(import().refusal, ImportRefusal::Unsigned);
}

TEST_F(ImportStick, ASetFileSaysOrderAndAttractTexts) {
    for (const std::string id : {"a", "b", "c"}) {
        stick.put(id + ".fspack", museum.pack(id, 1));
    }
    museum.put_exhibit(stick, "order = [\"c\", \"a\"]\n[attract]\nen = \"Come near\"\nde-ch = \"Grüezi\"\n",
                       1);
    import();
    EXPECT_EQ(ids(kiosk), (std::vector<std::string>{"c 1", "a 1", "b 1"}));
    const std::vector<AttractText> texts{{"de-CH", "Grüezi"}, {"en", "Come near"}};
    EXPECT_EQ(installed(kiosk).attract, texts);
    museum.put_exhibit(stick, "order = [\"b\"]\n", 2);
    import();
    EXPECT_EQ(installed(kiosk).attract, texts) << "left out, they stay";
}

TEST_F(ImportStick, NewKeysComeSignedByOldOnes) {
    const SecretKey next = SecretKey::make();
    const std::string text =
        fmt::format("[[key]]\nname = \"2031\"\npublic_key = \"{}\"\nuntil = \"2040-12-31\"\n",
                    public_key_line(next.public_key()));
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

TEST_F(ImportStick, AKeyAloneIsNoNewSet) {
    stick.put("a.fspack", museum.pack("a", 1));
    import();
    museum.put_exhibit(stick,
                       fmt::format("[[key]]\nname = \"2031\"\npublic_key = \"{}\"\n",
                                   public_key_line(SecretKey::make().public_key())),
                       1);
    const ImportReport report = import();
    EXPECT_EQ(line_of(report, "exhibit.toml").outcome, ImportOutcome::Taken);
    EXPECT_EQ(report.set_number, 1U) << "the exhibit has nothing to try";
    EXPECT_EQ(read_set_file(kiosk)->keys.size(), 1U);
}

TEST_F(ImportStick, KeepsTheLastGoodSetWhileANewOneIsOnTrial) {
    const auto put = [&](std::uint64_t serial) {
        stick.put("a.fspack", museum.pack("a", serial));
        import();
    };
    put(1);
    judge(kiosk, Verdict::Good);
    put(2);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 2"});
    EXPECT_EQ(pack_files(), 2U);
    judge(kiosk, Verdict::Bad);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 1"}) << "comes back";
    put(2); // once more, by hand
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 2"});
    judge(kiosk, Verdict::Trying, most_starts - 1);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 2"});
    judge(kiosk, Verdict::Trying, most_starts);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 1"}) << "the exhibit does not come up with it";
    put(3);
    judge(kiosk, Verdict::Trying, 1);
    put(4); // while 3 is on trial
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 4"});
    EXPECT_EQ(pack_files(), 3U) << "1 is the last good one, 3 may still be shown";
    judge(kiosk, Verdict::Bad);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"a 1"});
    put(5);
    judge(kiosk, Verdict::Good);
    put(6);
    EXPECT_EQ(pack_files(), 2U);
}

TEST_F(ImportStick, NeedsRoomForAllOfItAndAMargin) {
    stick.put("a.fspack", museum.pack("a", 1));
    stick.put("b.fspack", museum.pack("b", 1));
    const std::uint64_t needed = (*stick.content("a.fspack"))->size() + (*stick.content("b.fspack"))->size();
    kiosk.free = needed + request.limits.margin_bytes - 1;
    const ImportReport report = import();
    EXPECT_EQ(report.stage, ImportStage::Failed);
    EXPECT_EQ(report.refusal, ImportRefusal::NoRoom);
    EXPECT_EQ(line_of(report, "a.fspack").refusal, ImportRefusal::NoRoom);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{});
    ++kiosk.free;
    EXPECT_EQ(import().stage, ImportStage::Done);
}

TEST_F(ImportStick, CountsWhatAStickMayHold) {
    request.limits.most_entries = 10;
    request.limits.most_packs = 3;
    request.limits.most_folders = 2;
    for (int k = 0; k < 4; ++k) {
        stick.put(fmt::format("{}.fspack", k), "x");
    }
    EXPECT_EQ(import().refusal, ImportRefusal::TooMuch);
    VolatileDisk folders;
    for (int k = 0; k < 3; ++k) {
        folders.put(fmt::format("{}/x", k), "x");
    }
    EXPECT_EQ(import_quietly(folders, kiosk, request).refusal, ImportRefusal::TooMuch);
    VolatileDisk files;
    for (int k = 0; k < 11; ++k) {
        files.put(fmt::format(".{}", k), "passed over, and counted");
    }
    const ImportReport report = import_quietly(files, kiosk, request);
    EXPECT_EQ(report.refusal, ImportRefusal::TooMuch);
    EXPECT_TRUE(samples::is_one_line(report.reason));
}

TEST_F(ImportStick, AStickThatAnswersSlowlyIsRefused) {
    stick.put("a.fspack", museum.pack("a", 1, 20000));
    stick.put("b.fspack", museum.pack("b", 1));
    ImportSurroundings outside = quiet_surroundings();
    MonotonicTime now{};
    outside.now = [&] { return now; };
    stick.before_operation = [&](int) { now += std::chrono::seconds(25); };
    const ImportReport look = import_stick(stick, kiosk, request, outside);
    EXPECT_EQ(look.stage, ImportStage::Failed);
    EXPECT_EQ(look.refusal, ImportRefusal::TooMuch);
    // Only slow once it is copied; a pace of 4 MB in 30 s is asked for.
    stick.before_operation = nullptr;
    outside.tell = [&](const ImportReport& report) {
        if (report.stage == ImportStage::Copying) {
            now += std::chrono::seconds(5);
        }
    };
    const ImportReport copy = import_stick(stick, kiosk, request, outside);
    EXPECT_EQ(copy.refusal, ImportRefusal::TooMuch) << copy.reason;
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{});
    outside.tell = [](const ImportReport&) {};
    // A clock that jumps is not asked: time is monotonic, days only matter for keys.
    EXPECT_EQ(import_stick(stick, kiosk, request, outside).stage, ImportStage::Done);
}

TEST_F(ImportStick, ManyFilesThatAreNoPacksDoNotKeepTheProcessor) {
    for (int k = 0; k < 50; ++k) {
        stick.put(fmt::format("{:02}.fspack", k), "PK");
    }
    ImportSurroundings outside = quiet_surroundings();
    Nanoseconds work{0};
    outside.work = [&] { return work += std::chrono::milliseconds(100); };
    const ImportReport report = import_stick(stick, kiosk, request, outside);
    EXPECT_EQ(report.refusal, ImportRefusal::TooMuch);
    EXPECT_LT(report.packs.size(), 20U);
}

TEST_F(ImportStick, AFileOrFolderThatIsClosedConcernsItAlone) {
    stick.put("a.fspack", museum.pack("a", 1));
    stick.put("closed.fspack", museum.pack("b", 1));
    // Operations: the list of the root, opening a, then what reading it takes, then opening the other.
    VolatileDisk counted;
    counted.put("a.fspack", museum.pack("a", 1));
    import_quietly(counted, *std::make_unique<VolatileDisk>(), request);
    for (int operation = 2; operation < counted.operations; ++operation) {
        const auto closed = stick.copy();
        closed->plan = {FaultPlan::never, operation, operation + 1, EACCES, false};
        VolatileDisk other;
        const ImportReport report = import_quietly(*closed, other, request);
        EXPECT_EQ(report.stage, ImportStage::Done) << operation << report.reason;
        EXPECT_EQ(installed(other).packs.size(), 1U) << operation;
    }
}

TEST_F(ImportStick, ADamagedSetFileIsNotForgotten) {
    stick.put("a.fspack", museum.pack("a", 1));
    import();
    std::string text(as_text(**kiosk.content("set.txt")));
    text[text.size() / 2] ^= 1;
    kiosk.put("set.txt", text);
    const ImportReport report = import_quietly(stick, kiosk, request);
    EXPECT_EQ(report.refusal, ImportRefusal::Unwritable);
    EXPECT_EQ(pack_files(), 1U) << "nothing is cleared away";
    EXPECT_EQ(as_text(**kiosk.content("set.txt")), text);
}

TEST_F(ImportStick, FiveHundredPacks) {
    const Bytes plain = Museum::unsigned_pack("a", "a");
    const samples::Entries entries = samples::take_apart(plain);
    for (int k = 0; k < 500; ++k) {
        samples::Entries other = entries;
        other.manifest["sections"]["identity"]["data"]["id"] = fmt::format("id-{:03}", k);
        stick.put(fmt::format("{:03}.fspack", k),
                  Museum::signed_by(museum.key, samples::put_together(other), 1));
    }
    const ImportReport report = import();
    EXPECT_EQ(report.stage, ImportStage::Done);
    EXPECT_EQ(installed(kiosk).packs.size(), 500U);
    EXPECT_EQ(report.packs.size(), 500U);
    EXPECT_EQ(parse_import_report(write_import_report(report)).value(), report);
}

} // namespace
} // namespace frustumscreen
