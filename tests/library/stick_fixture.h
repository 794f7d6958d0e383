/// A museum's stick and the kiosk's disk, both in memory.
#pragma once

#include "tests/library/museum.h"

#include <string>
#include <vector>

namespace frustumscreen::testing_disk {

class StickTest : public ::testing::Test {
protected:
    library::ImportReport import() {
        library::ImportReport report = import_quietly(stick, kiosk, request);
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
    void expect_refused(const std::string& file, library::ImportRefusal refusal, const std::string& words) {
        const library::ImportReport report = import();
        const library::ImportedPack& line = line_of(report, file);
        EXPECT_EQ(line.outcome, library::ImportOutcome::Refused);
        EXPECT_EQ(line.refusal, refusal);
        EXPECT_NE(line.reason.find(words), std::string::npos) << line.reason;
        EXPECT_TRUE(samples::is_one_line(line.reason)) << line.reason;
        EXPECT_EQ(line.title, refusal == library::ImportRefusal::Older ? line.title : "");
    }

    Museum museum;
    library::ImportRequest request = request_of(museum);
    VolatileDisk stick, kiosk;
    Inspector inspector;
};

} // namespace frustumscreen::testing_disk
