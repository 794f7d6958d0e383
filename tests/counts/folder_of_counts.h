// A folder of the test's own, which is removed with it.
#pragma once

#include "app/counts/counts_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace frustumscreen::counts {

class FolderOfCounts : public testing::Test {
protected:
    FolderOfCounts() {
        std::string pattern = (std::filesystem::temp_directory_path() / "counts.XXXXXX").string();
        folder_ = ::mkdtemp(pattern.data());
    }
    ~FolderOfCounts() override { std::filesystem::remove_all(folder_); }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
    }
    [[nodiscard]] std::string text_of(const std::string& name) const {
        std::ifstream stream(folder_ / name);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    [[nodiscard]] bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

    static DayCounts counted(std::optional<std::chrono::sys_days> day, std::uint64_t visits) {
        DayCounts counts;
        counts.day = day;
        for (std::uint64_t k = 0; k < visits; ++k) {
            counts.add({std::chrono::seconds(30), true, true, true, Sentence("Amphora"), Sentence("en")}, 11);
        }
        return counts;
    }

    std::filesystem::path folder_;
};

} // namespace frustumscreen::counts
