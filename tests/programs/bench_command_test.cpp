// The results of the bench's program, seen from outside.

#include "firmware_host/base/json.h"
#include "tests/folders.h"
#include "tests/programs/program_folder.h"

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace frustumscreen {
namespace {

class BenchCounts : public ProgramFolder {
protected:
    void SetUp() override {
        ProgramFolder::SetUp();
        write_star();
        ASSERT_EQ(run("frustumscreen-bake star.obj -o star.fspack --unlit --no-relief --size 64"), 0)
            << text("err.txt");
    }
    [[nodiscard]] int count(const std::string& more) const {
        return run("frustumscreen-bench counts --pack star.fspack --poses 2 --config '" + source_dir() +
                   "/config/near.toml' --out out " + more);
    }
    /// Writes the counts in `out`, changed by `change`, as reference.json.
    template <class Change> void write_reference(Change change) const {
        nlohmann::json counts = nlohmann::json::parse(text("out/counts.json"));
        change(counts.at("mean_of_a_frame"));
        ASSERT_TRUE(write_file(folder / "reference.json", as_bytes(counts.dump())));
    }
};

TEST_F(BenchCounts, AFrameThatTakesFourPercentMoreIsNoLossAndSixPercentEndsWithOne) {
    ASSERT_EQ(count(""), 0) << text("err.txt");
    const auto divide_by = [this](double growth) {
        write_reference([growth](nlohmann::json& counts) {
            for (const char* key : {"triangles", "vertices", "draw_calls", "samples", "bytes"}) {
                counts[0].at(key) = counts[0].at(key).get<double>() / growth;
            }
        });
    };
    divide_by(1.04);
    EXPECT_EQ(count("--reference reference.json"), 0) << text("err.txt");
    divide_by(1.06);
    EXPECT_EQ(count("--reference reference.json"), 1);
    EXPECT_NE(text("err.txt").find("takes over 5 % more"), std::string::npos) << text("err.txt");
}

TEST_F(BenchCounts, AnArtifactThatTheReferenceLacksEndsWithOneAndIsNamed) {
    ASSERT_EQ(count(""), 0) << text("err.txt");
    write_reference([](nlohmann::json& counts) { counts[0]["artifact"] = "moon.obj, 8 triangles"; });
    EXPECT_EQ(count("--reference reference.json"), 1);
    EXPECT_NE(text("err.txt").find("reference.json lacks star.obj, 8 triangles in near"), std::string::npos)
        << text("err.txt");
    write_reference([](nlohmann::json& counts) { counts.clear(); });
    EXPECT_EQ(count("--reference reference.json"), 1);
}

TEST_F(BenchCounts, OneCountOfAllThatTakesMoreEndsWithOne) {
    ASSERT_EQ(count(""), 0) << text("err.txt");
    write_reference(
        [](nlohmann::json& counts) { counts[0]["triangles"] = 0.9 * counts[0]["triangles"].get<double>(); });
    EXPECT_EQ(count("--reference reference.json"), 1);
}

/// Blocks and triangles of the table's rows, by technique, in the order of the counts.
std::map<std::string, std::vector<double>> drawn_by(const std::string& csv) {
    std::map<std::string, std::vector<double>> drawn;
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line); // the columns' names
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        std::string cell;
        std::vector<std::string> row;
        while (std::getline(cells, cell, ',')) {
            row.push_back(cell);
        }
        drawn[row.at(2)].push_back(std::stod(row.at(3)));
    }
    return drawn;
}

class BenchScaling : public ProgramFolder {};

TEST_F(BenchScaling, OneSurfaceInFourTimesTheTrianglesHasAReliefOfAsManyBlocks) {
    ASSERT_EQ(run("frustumscreen-bench scaling --same-surface --triangles 4000 16000 --size 48 --poses 1 "
                  "--no-peers "
                  "--config '" +
                  source_dir() + "/config/near.toml' --out out"),
              0)
        << text("err.txt");
    const std::map<std::string, std::vector<double>> drawn = drawn_by(text("out/scaling_near.csv"));
    const std::vector<double>& source = drawn.at("two-pass 1024");
    ASSERT_EQ(source.size(), 2U);
    EXPECT_EQ(source[1], 4.0 * source[0]);
    const std::vector<double>& blocks = drawn.at("relief48");
    ASSERT_EQ(blocks.size(), 2U);
    EXPECT_LT(blocks[1], 1.1 * blocks[0]);
    EXPECT_NE(text("out.txt").find("finest relief"), std::string::npos) << text("out.txt");
}

} // namespace
} // namespace frustumscreen
