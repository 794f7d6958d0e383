// Limits on the cost of a stick: entries, time, work, unnecessary copies.
#include "tests/library/stick_fixture.h"

namespace frustumscreen::library {
namespace {

using namespace testing_disk;

class ImportCosts : public StickTest {};

TEST_F(ImportCosts, LimitsPacksFoldersAndEntries) {
    request.limits.max_entries = 10;
    request.limits.max_packs = 3;
    request.limits.max_folders = 2;
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

TEST_F(ImportCosts, AStickThatAnswersSlowlyIsRefused) {
    stick.put("a.fspack", museum.pack("a", 1, 20000));
    stick.put("b.fspack", museum.pack("b", 1));
    ImportEnvironment outside = quiet_environment();
    MonotonicTime now{};
    outside.now = [&] { return now; };
    stick.before_operation = [&](int) { now += std::chrono::seconds(25); };
    const ImportReport look = import_stick(stick, kiosk, request, outside);
    EXPECT_EQ(look.stage, ImportStage::Failed);
    EXPECT_EQ(look.refusal, ImportRefusal::TooMuch);
    // The stick is slow only during the copy; the pace asks for 4 MB in 30 s.
    stick.before_operation = nullptr;
    outside.tell = [&](const ImportReport& report) {
        if (report.stage == ImportStage::Copying) {
            stick.before_operation = [&](int) { now += std::chrono::seconds(5); };
        }
    };
    const ImportReport copy = import_stick(stick, kiosk, request, outside);
    EXPECT_EQ(copy.refusal, ImportRefusal::TooMuch) << copy.reason;
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{});
    // An equally slow disk is not the stick's fault.
    stick.before_operation = nullptr;
    outside.tell = [](const ImportReport&) {};
    kiosk.before_operation = [&](int) { now += std::chrono::seconds(40); };
    EXPECT_EQ(import_stick(stick, kiosk, request, outside).stage, ImportStage::Done);
}

TEST_F(ImportCosts, DamagedCopiesOfOnePackAreTriedTwice) {
    const Bytes pack = with_another_part(museum.pack("a", 1, 100000));
    for (int k = 0; k < 200; ++k) {
        stick.put(fmt::format("{:03}.fspack", k), pack);
    }
    stick.put("b.fspack", museum.pack("b", 1));
    const ImportReport report = import();
    EXPECT_EQ(report.stage, ImportStage::Done);
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"b 1"});
    EXPECT_NE(line_of(report, "001.fspack").reason.find("padding.bin"), std::string::npos);
    for (const std::string file : {"002.fspack", "199.fspack"}) {
        EXPECT_NE(line_of(report, file).reason.find("not tried"), std::string::npos)
            << line_of(report, file).reason;
        EXPECT_EQ(line_of(report, file).refusal, ImportRefusal::Altered);
    }
    const int one_copy = static_cast<int>(pack.size() / request.limits.step_bytes);
    EXPECT_LT(kiosk.operations, 10 * one_copy) << "writes, and reads of the check";
}

TEST_F(ImportCosts, ManyDamagedPacksStopTheImport) {
    ImportEnvironment outside = quiet_environment();
    Nanoseconds work{0};
    outside.work = [&] { return work; };
    kiosk.before_operation = [&](int) { work += std::chrono::seconds(1); };
    for (int k = 0; k < 3; ++k) {
        stick.put(fmt::format("{}.fspack", k),
                  with_another_part(museum.pack(fmt::format("id-{}", k), 1, 3000)));
    }
    stick.put("good.fspack", museum.pack("good", 1));
    const ImportReport some = import_stick(stick, kiosk, request, outside);
    EXPECT_EQ(some.stage, ImportStage::Done)
        << "large packs that are damaged concern no other pack: " << some.reason;
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"good 1"});
    for (int k = 3; k < 20; ++k) {
        stick.put(fmt::format("{:02}.fspack", k),
                  with_another_part(museum.pack(fmt::format("id-{}", k), 1, 3000)));
    }
    const ImportReport many = import_stick(stick, kiosk, request, outside);
    EXPECT_EQ(many.refusal, ImportRefusal::TooMuch);
    EXPECT_NE(many.reason.find("damaged"), std::string::npos) << many.reason;
    EXPECT_EQ(ids(kiosk), std::vector<std::string>{"good 1"});
}

TEST_F(ImportCosts, ManyInvalidFilesStopTheImport) {
    for (int k = 0; k < 50; ++k) {
        stick.put(fmt::format("{:02}.fspack", k), "PK");
    }
    ImportEnvironment outside = quiet_environment();
    Nanoseconds work{0};
    outside.work = [&] { return work += std::chrono::milliseconds(100); };
    const ImportReport report = import_stick(stick, kiosk, request, outside);
    EXPECT_EQ(report.refusal, ImportRefusal::TooMuch);
    EXPECT_LT(report.packs.size(), 20U);
}

TEST_F(ImportCosts, ImportsFiveHundredPacks) {
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
} // namespace frustumscreen::library
