// A cube from its mesh to its pictures and its measured error, made only by the programs.

#include "firmware_host/base/json.h"
#include "tests/folders.h"
#include "tests/programs/program_folder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <sstream>

namespace frustumscreen::programs {
namespace {

/// A six-sided die of unequal pyramids on a core: every side is visible, the bottom too.
class CubeProgram : public ProgramFolder {
protected:
    void SetUp() override {
        write_star();
        ASSERT_EQ(run("frustumscreen-bake star.obj -o star.fspack --prop cube --up z --unlit --size 64"), 0)
            << text("err.txt");
    }
    [[nodiscard]] static std::string settings() { return source_dir() + "/config/cube.toml"; }
};

TEST_F(CubeProgram, PackVerifiesAndReportsItsSizeOnTheCube) {
    ASSERT_EQ(run("frustumscreen-pack verify star.fspack"), 0) << text("err.txt");
    ASSERT_EQ(run("frustumscreen-pack explain --json star.fspack"), 0) << text("err.txt");
    const nlohmann::json json = nlohmann::json::parse(text("out.txt"));
    EXPECT_EQ(json.at("prop").at("kind"), "cube");
    EXPECT_EQ(json.at("prop").at("height_m"), json.at("prop").at("base_m"));
    // At most 2.1 high and 1.7 wide: as high as the cube of 0.16 m.
    EXPECT_NEAR(json.at("artifact_size_m")[2].get<double>(), 0.16, 1e-3);
}

TEST_F(CubeProgram, DrawsTheLowerHalfWhenUpsideDown) {
    // Half a turn about X, with the middle above the table's centre, seen from straight above.
    ASSERT_TRUE(
        write_file(folder / "poses.csv", as_bytes("t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n"
                                                  "0,1,0,0,0.15,0,1,0,0,1\n0,2,0,0,0.8,1,0,0,0,1\n")));
    ASSERT_EQ(
        run(fmt::format("frustumscreen render --config '{}' --pack star.fspack --poses poses.csv --out out "
                        "--technique finest --no-light --aov",
                        settings())),
        0)
        << text("err.txt");
    const std::string pfm = text("out/frame_00000.pfm");
    std::istringstream header(pfm);
    std::string kind;
    int width = 0;
    int height = 0;
    double scale = 0.0;
    header >> kind >> width >> height >> scale;
    ASSERT_EQ(kind, "PF");
    ASSERT_EQ(scale, -1.0);
    const std::size_t floats = std::size_t{3} * static_cast<std::size_t>(width * height);
    ASSERT_GT(pfm.size(), 4 * floats);
    int hits = 0;
    float highest = 0.0F;
    for (std::size_t k = 0; k < floats; k += 3) {
        std::array<float, 3> point{};
        std::memcpy(point.data(), pfm.data() + pfm.size() - 4 * (floats - k), sizeof(point));
        if (!std::isnan(point[2])) {
            ++hits;
            highest = std::max(highest, point[2]);
        }
    }
    EXPECT_GT(hits, 5000);
    // Only the lower half of the star, whose waist is at 1 / 2.1 of its height.
    EXPECT_LT(highest, 0.1F / 2.1F + 5e-4F);
    EXPECT_GT(highest, 0.02F);
}

TEST_F(CubeProgram, ErrorTimeWritesARowForEachPose) {
    ASSERT_EQ(
        run(fmt::format(
            "frustumscreen-bench error-time --limits none --config '{}' --pack star.fspack --mesh star.obj "
            "--out bench --poses 6 --peers none",
            settings())),
        0)
        << text("err.txt") << text("out.txt");
    std::istringstream rows(text("bench/error_time_poses.csv"));
    std::string line;
    int poses = 0;
    while (std::getline(rows, line)) {
        ++poses;
    }
    EXPECT_GT(poses, 1 + 6);
    EXPECT_EQ((poses - 1) % 6, 0) << "a header, and a row for each pose of each level";
}

} // namespace
} // namespace frustumscreen::programs
