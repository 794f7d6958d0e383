#include "app/library/import_end.h"

#include <gtest/gtest.h>

namespace frustumscreen::library {
namespace {

ImportReport at(const char* id, ImportStage stage) {
    ImportReport report;
    report.import_id = id;
    report.stage = stage;
    report.packs.resize(2);
    return report;
}

TEST(ImportEnd, ReportsAStoppedImportAsFailed) {
    for (const ImportStage stage : {ImportStage::Found, ImportStage::Copying}) {
        const auto report = final_report_of(at("stick7p1", stage), "stick7p1", "signal", 12);
        ASSERT_TRUE(report);
        EXPECT_EQ(report->stage, ImportStage::Failed);
        EXPECT_EQ(report->refusal, ImportRefusal::Unreadable);
        EXPECT_FALSE(report->reason.empty());
        EXPECT_EQ(report->set_number, 12U);
        ASSERT_EQ(report->packs.size(), 2U);
        EXPECT_EQ(report->packs[0].outcome, ImportOutcome::Refused) << "none was switched to";
    }
}

TEST(ImportEnd, ReportsDoneOnceTheSetWasSwitched) {
    const auto report = final_report_of(at("stick7p1", ImportStage::MayTakeOut), "stick7p1", "signal", 12);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->stage, ImportStage::Done);
}

TEST(ImportEnd, ReportsAnExceededLimit) {
    for (const char* result : {"timeout", "oom-kill", "resources"}) {
        const auto report = final_report_of(at("stick7p1", ImportStage::Copying), "stick7p1", result, 0);
        ASSERT_TRUE(report);
        EXPECT_EQ(report->refusal, ImportRefusal::TooMuch) << result;
    }
}

TEST(ImportEnd, KeepsAFinalReport) {
    EXPECT_FALSE(final_report_of(at("stick7p1", ImportStage::Done), "stick7p1", "success", 0));
    EXPECT_FALSE(final_report_of(at("stick7p1", ImportStage::Failed), "stick7p1", "timeout", 0));
}

TEST(ImportEnd, KeepsAnotherSticksReportWhileItIsRead) {
    EXPECT_FALSE(final_report_of(at("stick8", ImportStage::Copying), "stick7p1", "signal", 0));
    const auto report = final_report_of(at("stick8", ImportStage::Done), "stick7p1", "signal", 0);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->import_id, "stick7p1");
    EXPECT_TRUE(report->packs.empty());
    EXPECT_EQ(report->done_bytes, 0U);
}

TEST(ImportEnd, ReportsAFailureWithoutAnEarlierReport) {
    const auto report = final_report_of(std::nullopt, "stick7p1", "core-dump", 3);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->import_id, "stick7p1");
    EXPECT_EQ(report->stage, ImportStage::Failed);
}

TEST(ImportEnd, ASuccessfulEndKeepsAnotherSticksReport) {
    for (const ImportStage stage : {ImportStage::Found, ImportStage::Done, ImportStage::Failed}) {
        EXPECT_FALSE(final_report_of(at("stick8", stage), "stick7p1", "success", 0));
    }
}

TEST(ImportEnd, ReportsAnUnmountableStickOnce) {
    EXPECT_TRUE(must_report_unmounted(std::nullopt, "stick7p1"));
    EXPECT_TRUE(must_report_unmounted(at("stick71p1", ImportStage::Done), "stick7p1"));
    EXPECT_TRUE(must_report_unmounted(at("stick7p2", ImportStage::Failed), "stick7p1"));
    EXPECT_FALSE(must_report_unmounted(at("stick7p2", ImportStage::Done), "stick7p1"));
    EXPECT_FALSE(must_report_unmounted(at("stick7", ImportStage::Copying), "stick7p1"));
    EXPECT_FALSE(must_report_unmounted(at("stick7p1", ImportStage::Found), "stick7p1"));
    EXPECT_FALSE(must_report_unmounted(at("stick7p1", ImportStage::Failed), "stick7p1"));
}

TEST(ImportEnd, DelaysTheNextReportAfterAFinalOne) {
    using std::chrono::hours;
    using std::chrono::seconds;
    const ImportReport other = at("stick7p1", ImportStage::Done);
    const auto wait = [&](const ImportReport& last, Nanoseconds age) {
        return delay_before_first_report(last, "stick8p1", age, seconds(10));
    };
    EXPECT_EQ(wait(other, seconds(3)), seconds(7));
    EXPECT_EQ(wait(other, seconds(10)), seconds(0));
    EXPECT_EQ(wait(other, hours(1000)), seconds(0)) << "the clock was set";
    EXPECT_EQ(wait(other, -hours(1000)), seconds(10));
    EXPECT_EQ(wait(at("stick7p1", ImportStage::Failed), seconds(1)), seconds(9));
    EXPECT_EQ(wait(at("stick7p1", ImportStage::Copying), seconds(1)), seconds(0)) << "it was stopped";
    EXPECT_EQ(wait(at("stick8p1", ImportStage::Done), seconds(1)), seconds(0));
    EXPECT_EQ(delay_before_first_report(std::nullopt, "stick8p1", seconds(1), seconds(10)), seconds(0));
}

} // namespace
} // namespace frustumscreen::library
