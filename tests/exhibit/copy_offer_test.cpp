// The copy that the staff may have written: each state, and the reports that lead from one to the next.

#include "app/exhibit/copy_offer.h"
#include "app/library/report_request.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace frustumscreen::exhibit {
namespace {

using library::ImportOutcome;
using library::ImportRefusal;
using library::ImportStage;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

const MonotonicTime start{seconds(100)};

library::ImportReport told(const std::string& id, ImportStage stage,
                           std::vector<library::ImportedPack> lines = {}) {
    library::ImportReport report;
    report.import_id = id;
    report.stage = stage;
    report.packs = std::move(lines);
    return report;
}
library::ImportedPack line(const std::string& file, ImportOutcome outcome, const std::string& reason = "") {
    return {.file = file, .title = "", .outcome = outcome, .refusal = ImportRefusal::None, .reason = reason};
}
library::ImportReport waiting(const std::string& id) {
    return told(id, ImportStage::Done, {line("vase.fspack", ImportOutcome::Taken), library::copy_offer()});
}
library::ImportReport written(const std::string& id) {
    return told(id, ImportStage::Done, {line("frustumscreen-1a2b3c-2031", ImportOutcome::Written)});
}

class Offer : public ::testing::Test {
protected:
    CopyStage take(const library::ImportReport& report, bool is_old = false) {
        now += seconds(1);
        offer.take(now, report, is_old);
        return offer.step(now).stage;
    }
    CopyStage after(Nanoseconds time) {
        now += time;
        return offer.step(now).stage;
    }
    CopyOffer offer;
    MonotonicTime now = start;
};

TEST_F(Offer, BeginsWhenAStickRequestsACopy) {
    EXPECT_EQ(offer.step(now).stage, CopyStage::NoStick);
    EXPECT_EQ(take(told("stick1", ImportStage::Found)), CopyStage::Looking);
    EXPECT_EQ(take(told("stick1", ImportStage::Copying)), CopyStage::Looking);
    EXPECT_EQ(take(told("stick1", ImportStage::MayTakeOut, {library::copy_offer()})), CopyStage::Looking)
        << "the importer still reads it";
    EXPECT_EQ(take(told("stick1", ImportStage::Done, {line("vase.fspack", ImportOutcome::Taken)})),
              CopyStage::NoRequest);
    EXPECT_EQ(take(told("stick2", ImportStage::Found)), CopyStage::Looking);
    EXPECT_EQ(take(waiting("stick2")), CopyStage::Offered);
    EXPECT_EQ(take(told("stick3", ImportStage::Failed)), CopyStage::NoRequest);
    library::ImportReport full = waiting("stick4"); // the packs were refused; the copy goes the other way
    full.stage = ImportStage::Failed;
    EXPECT_EQ(take(full), CopyStage::Offered);
}

TEST_F(Offer, IgnoresOtherRequests) {
    const std::string request(library::copy_request_name);
    EXPECT_EQ(take(told("stick1", ImportStage::Done, {line(request, ImportOutcome::Pending)})),
              CopyStage::NoRequest)
        << "a signed one for the state of delivery";
    library::ImportedPack refused = line(request, ImportOutcome::NotWritten);
    refused.refusal = ImportRefusal::Unsigned;
    EXPECT_EQ(take(told("stick2", ImportStage::Done, {refused})), CopyStage::NoRequest);
    library::ImportedPack pack = library::copy_offer();
    pack.file = "vase.fspack";
    EXPECT_EQ(take(told("stick3", ImportStage::Done, {pack})), CopyStage::NoRequest);
}

TEST_F(Offer, ExpiresAfterTenMinutes) {
    static_cast<void>(take(waiting("stick1")));
    EXPECT_EQ(after(minutes(5)), CopyStage::Offered);
    EXPECT_EQ(take(waiting("stick1")), CopyStage::Offered) << "the same report does not prolong it";
    EXPECT_EQ(after(minutes(5) - seconds(1) - milliseconds(1)), CopyStage::Offered);
    EXPECT_EQ(after(milliseconds(1)), CopyStage::NoStick);
    offer.confirm(now);
    EXPECT_EQ(offer.step(now).stage, CopyStage::NoStick);
    EXPECT_EQ(take(waiting("stick2"), true), CopyStage::NoStick) << "the report was there before the exhibit";
}

TEST_F(Offer, TracksTheConfirmedStickUntilItIsWritten) {
    static_cast<void>(take(waiting("stick1")));
    offer.confirm(now);
    EXPECT_FALSE(offer.is_offered());
    EXPECT_EQ(offer.step(now), (CopyState{.stage = CopyStage::Writing}));
    EXPECT_EQ(take(waiting("stick1")), CopyStage::Writing) << "its first report";
    EXPECT_EQ(take(told("stick1.staff", ImportStage::Found)), CopyStage::Writing);
    library::ImportReport copies = told("stick1.staff", ImportStage::Copying);
    copies.total_bytes = 200;
    for (const auto& [done, percent] : {std::pair(0U, 0), std::pair(51U, 25), std::pair(200U, 100)}) {
        copies.done_bytes = done;
        EXPECT_EQ(take(copies), CopyStage::Writing);
        EXPECT_EQ(offer.step(now).percent, percent);
    }
    EXPECT_EQ(take(waiting("stick2")), CopyStage::Writing) << "another stick";
    EXPECT_EQ(take(written("stick2.staff")), CopyStage::Writing);
    EXPECT_EQ(take(written("stick1.staff")), CopyStage::Written);
    EXPECT_EQ(offer.step(now).said, "frustumscreen-1a2b3c-2031");
    EXPECT_EQ(after(minutes(20)), CopyStage::Written) << "until another stick";
    EXPECT_EQ(take(told("stick3", ImportStage::Found)), CopyStage::Looking);
}

TEST_F(Offer, ReportsWhyNothingWasWritten) {
    const auto ends_with = [this](const library::ImportReport& report) {
        static_cast<void>(take(waiting("stick1")));
        offer.confirm(now);
        EXPECT_EQ(take(report), CopyStage::Failed);
        const std::string said = offer.step(now).said;
        static_cast<void>(take(told("between", ImportStage::Found)));
        return said;
    };
    EXPECT_EQ(ends_with(told("stick1.staff", ImportStage::Done,
                             {line("frustumscreen-1a2b3c-2031", ImportOutcome::Written),
                              line("frustumscreen-request.toml", ImportOutcome::NotWritten, "full")})),
              "full")
        << "a report was written, the copy was not";
    library::ImportReport pulled = told("stick1.staff.report", ImportStage::Failed);
    pulled.reason = "pulled out";
    EXPECT_EQ(ends_with(pulled), "pulled out");
    EXPECT_NE(ends_with(told("stick1.staff", ImportStage::Done)), "");
}

TEST_F(Offer, TimesOutWhenAStickStopsReporting) {
    static_cast<void>(take(told("stick1", ImportStage::Found)));
    EXPECT_EQ(after(CopyOffer::timeout), CopyStage::NoStick);
    static_cast<void>(take(waiting("stick1")));
    offer.confirm(now);
    library::ImportReport copies = told("stick1.staff", ImportStage::Copying);
    copies.total_bytes = 1U << 30U;
    for (copies.done_bytes = 0; copies.done_bytes < 1000;
         ++copies.done_bytes) { // a slow one, less than a percent
        now += minutes(1);
        EXPECT_EQ(take(copies), CopyStage::Writing);
    }
    EXPECT_EQ(after(CopyOffer::timeout - milliseconds(1)), CopyStage::Writing);
    EXPECT_EQ(after(milliseconds(1)), CopyStage::Failed);
    EXPECT_NE(offer.step(now).said, "");
    EXPECT_EQ(take(written("stick1.staff")), CopyStage::Written) << "it came to its end after all";
}

} // namespace
} // namespace frustumscreen::exhibit
