/// Each verdict's sentence has an id of its own, which docs/verdicts.md lists. The ids are read from the sources
/// and from the page, not from the library.
#include "app/calibration/calibrate_auto.h"
#include "app/calibration/corners.h"
#include "app/calibration/eye_fit.h"
#include "app/calibration/touch_up.h"
#include "tests/base/temporary_folder.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace frustumscreen::calibration {

namespace {

std::vector<std::string> found_in(const std::string& text, const std::regex& pattern) {
    std::vector<std::string> found;
    for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) {
        found.push_back((*at)[1]);
    }
    return found;
}

/// The ids in the sources that judge, each with the sources that name it.
std::map<std::string, std::set<std::string>> ids_in_sources() {
    const std::regex id(R"re("((?:verdict|points|touches|rests|touch_up|corners|sightings)\.[a-z_]+)")re");
    std::map<std::string, std::set<std::string>> sources;
    for (const auto& entry : std::filesystem::directory_iterator(source_dir() + "/app/calibration")) {
        const std::string name = entry.path().filename();
        if (entry.path().extension() != ".cpp" || name == "point_files.cpp") { // its ids are those of errors
            continue;
        }
        for (const std::string& each : found_in(text_of(entry.path()), id)) {
            sources[each].insert(name);
        }
    }
    return sources;
}

TEST(VerdictIds, MatchTheDocumentedList) {
    const std::string page = text_of(source_dir() + "/docs/verdicts.md");
    const std::size_t table = page.find("|---|---|");
    ASSERT_NE(table, std::string::npos);
    const std::string rows = page.substr(table);
    std::set<std::string> listed;
    for (const std::string& id : found_in(rows, std::regex("`([a-z_]+\\.[a-z_]+)`"))) {
        EXPECT_TRUE(listed.insert(id).second) << id << " is listed twice";
    }
    std::set<std::string> used;
    for (const auto& [id, sources] : ids_in_sources()) {
        EXPECT_EQ(sources.size(), 1U) << id << " belongs to one file";
        used.insert(id);
    }
    EXPECT_EQ(used, listed);
    EXPECT_GT(used.size(), 50U);
}

/// A sentence that is set alone would keep the id of another one.
TEST(VerdictIds, AreSetWithTheirSentences) {
    int reasons = 0;
    for (const auto& entry : std::filesystem::directory_iterator(source_dir() + "/app/calibration")) {
        const std::string text = text_of(entry.path());
        EXPECT_FALSE(std::regex_search(text, std::regex(R"(sentence\s=[^=])"))) << entry.path();
        reasons += static_cast<int>(
            found_in(text, std::regex(R"((reason = \{|VerdictReason\{|refused\(\{))")).size());
    }
    EXPECT_GT(reasons, 40);
}

/// Each way's verdict on an empty input.
TEST(VerdictIds, EmptyInputReportsTooFewPoints) {
    constexpr int width = 1920;
    constexpr int height = 1200;
    TouchSetup touches;
    touches.width = width;
    touches.height = height;
    AutoSetup rests;
    rests.width = width;
    rests.height = height;
    EXPECT_EQ(calibrate_touch({}, touches).reason.id, "points.too_few");
    EXPECT_EQ(touch_up({}, {}, touches).reason.id, "points.too_few");
    EXPECT_EQ(calibrate_auto({}, rests).found.reason.id, "rests.too_few");
    EXPECT_EQ(calibrate_corners({}, width, height).reason.id, "corners.too_few");
    EXPECT_EQ(fit_eyes({}, 0.15).reason.id, "sightings.too_few");
}

} // namespace

} // namespace frustumscreen::calibration
