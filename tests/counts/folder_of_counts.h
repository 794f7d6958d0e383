// A folder of the test's own, which is removed with it.
#pragma once

#include "app/counts/counts_folder.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>

#include <string>

namespace frustumscreen::counts {

class FolderOfCounts : public WithTemporaryFolder {
protected:
    [[nodiscard]] bool has(const std::string& name) const { return std::filesystem::exists(folder / name); }

    static DayCounts counted(std::optional<std::chrono::sys_days> day, std::uint64_t visits) {
        DayCounts counts;
        counts.day = day;
        for (std::uint64_t k = 0; k < visits; ++k) {
            counts.add({std::chrono::seconds(30), true, true, true, Sentence("Amphora"), Sentence("en")}, 11);
        }
        return counts;
    }
};

} // namespace frustumscreen::counts
