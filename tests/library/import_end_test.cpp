#include "app/library/import_end.h"

#include <gtest/gtest.h>

namespace frustumscreen {
namespace {

ImportReport at(const char* id, ImportStage stage) {
    ImportReport report;
    report.import_id = id;
    report.stage = stage;
    report.packs.resize(2);
    return report;
}

TEST(ImportEnd, IsSaidOfAnImportThatWasStopped) {
    for (const ImportStage stage : {ImportStage::Found, ImportStage::Copying}) {
        const auto word = last_word(at("stick7p1", stage), "stick7p1", "signal", 12);
        ASSERT_TRUE(word);
        EXPECT_EQ(word->stage, ImportStage::Failed);
        EXPECT_EQ(word->refusal, ImportRefusal::Unreadable);
        EXPECT_FALSE(word->reason.empty());
        EXPECT_EQ(word->set_number, 12U);
        ASSERT_EQ(word->packs.size(), 2U);
        EXPECT_EQ(word->packs[0].outcome, ImportOutcome::Refused) << "none was switched to";
    }
}

TEST(ImportEnd, IsDoneOnceTheSetWasSwitchedTo) {
    const auto word = last_word(at("stick7p1", ImportStage::MayTakeOut), "stick7p1", "signal", 12);
    ASSERT_TRUE(word);
    EXPECT_EQ(word->stage, ImportStage::Done);
}

TEST(ImportEnd, NamesALimitThatWasMet) {
    for (const char* result : {"timeout", "oom-kill", "resources"}) {
        const auto word = last_word(at("stick7p1", ImportStage::Copying), "stick7p1", result, 0);
        ASSERT_TRUE(word);
        EXPECT_EQ(word->refusal, ImportRefusal::TooMuch) << result;
    }
}

TEST(ImportEnd, LeavesWhatWasSaid) {
    EXPECT_FALSE(last_word(at("stick7p1", ImportStage::Done), "stick7p1", "success", 0));
    EXPECT_FALSE(last_word(at("stick7p1", ImportStage::Failed), "stick7p1", "timeout", 0));
}

TEST(ImportEnd, LeavesAnotherSticksReportWhileThatIsRead) {
    EXPECT_FALSE(last_word(at("stick8", ImportStage::Copying), "stick7p1", "signal", 0));
    const auto word = last_word(at("stick8", ImportStage::Done), "stick7p1", "signal", 0);
    ASSERT_TRUE(word);
    EXPECT_EQ(word->import_id, "stick7p1");
    EXPECT_TRUE(word->packs.empty());
    EXPECT_EQ(word->done_bytes, 0U);
}

TEST(ImportEnd, IsSaidWhereNothingWas) {
    const auto word = last_word(std::nullopt, "stick7p1", "core-dump", 3);
    ASSERT_TRUE(word);
    EXPECT_EQ(word->import_id, "stick7p1");
    EXPECT_EQ(word->stage, ImportStage::Failed);
}

} // namespace
} // namespace frustumscreen
