// The staff's volume over restarts, and with changed settings in between.

#include "app/show/kept_volume.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace frustumscreen::show {
namespace {

class KeptVolume : public WithTemporaryFolder {
protected:
    void write(const std::string& text) const { std::ofstream(file(), std::ios::binary) << text; }
    [[nodiscard]] std::filesystem::path file() const { return folder / "volume.txt"; }
};

TEST_F(KeptVolume, SurvivesARestart) {
    EXPECT_EQ(read_kept_volume(file(), -3.0), 0);
    VolumeKeeper keeper(file(), -3.0);
    keeper.note(0);
    EXPECT_FALSE(std::filesystem::exists(file())) << "nothing was chosen";
    keeper.note(6);
    EXPECT_EQ(read_kept_volume(file(), -3.0), 6);
    keeper.note(-9);
    EXPECT_EQ(read_kept_volume(file(), -3.0), -9);
    keeper.note(0);
    EXPECT_EQ(read_kept_volume(file(), -3.0), 0);
}

TEST_F(KeptVolume, IsDiscardedWhenTheSettingsVolumeChanges) {
    VolumeKeeper(file(), -3.0).note(6);
    EXPECT_EQ(read_kept_volume(file(), 0.0), 0);
    EXPECT_EQ(read_kept_volume(file(), -3.5), 0);
    VolumeKeeper(file(), 0.0).note(0);
    EXPECT_EQ(read_kept_volume(file(), -3.0), 0) << "also when the earlier settings come again";
}

TEST_F(KeptVolume, IgnoresAMalformedFile) {
    for (const char* text : {"", "louder_db", "louder_db x over 0\n", "louder_db 6 over 0",
                             "louder_db 6 over 0\nmore", "louder_db 999999999999 over 0\n"}) {
        write(text);
        EXPECT_EQ(read_kept_volume(file(), 0.0), 0) << text;
    }
    write("louder_db 6 over 0\n");
    EXPECT_EQ(read_kept_volume(file(), 0.0), 6);
}

TEST_F(KeptVolume, WritesNothingWithoutAFolder) {
    VolumeKeeper none({}, 0.0);
    none.note(3);
    VolumeKeeper gone(folder / "no-such-folder/volume.txt", 0.0);
    gone.note(3);
    EXPECT_FALSE(std::filesystem::exists(folder / "no-such-folder"));
}

} // namespace
} // namespace frustumscreen::show
