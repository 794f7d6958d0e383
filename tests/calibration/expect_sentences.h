/// Checks that every key spoken on the table has its sentence among the exhibit's own words.
#pragma once

#include "tests/folders.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

namespace frustumscreen::calibration {

inline void expect_sentences(const std::set<std::string>& keys) {
    std::ifstream file(source_dir() + "/assets_baked/texts/words/en.toml");
    std::set<std::string> known;
    std::string table;
    for (std::string line; std::getline(file, line);) {
        table = line.starts_with("[") ? line.substr(1, line.size() - 2) + "." : table;
        known.insert(table + line.substr(0, line.find(" = ")));
    }
    for (const std::string& key : keys) {
        EXPECT_TRUE(key.starts_with("calibration.") && known.contains(key)) << key;
    }
}

} // namespace frustumscreen::calibration
