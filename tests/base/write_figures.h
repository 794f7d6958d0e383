/// Writes the table of a test that measures, for `frustumscreen-bench report`, into the folder that FRUSTUMSCREEN_FIGURES
/// names. Without that variable nothing is written.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace frustumscreen {

inline void write_figures(const std::string& file, std::string_view csv) {
    const char* const folder = std::getenv("FRUSTUMSCREEN_FIGURES");
    if (folder == nullptr) {
        return;
    }
    std::filesystem::create_directories(folder);
    std::ofstream written(std::filesystem::path(folder) / file, std::ios::binary);
    written << csv;
    written.close();
    EXPECT_TRUE(written) << folder << ": " << file << " cannot be written";
}

} // namespace frustumscreen
