// The results of the bench's program, seen from outside.

#include "firmware_host/base/json.h"
#include "tests/folders.h"
#include "tests/programs/program_folder.h"

#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace frustumscreen::programs {
namespace {

class BenchCounts : public ProgramFolder {
protected:
    void SetUp() override {
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
        put("reference.json", counts.dump());
    }
};

TEST_F(BenchCounts, AcceptsFourPercentGrowthAndFailsAtSixPercent) {
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

TEST_F(BenchCounts, FailsAndNamesAnArtifactMissingFromTheReference) {
    ASSERT_EQ(count(""), 0) << text("err.txt");
    write_reference([](nlohmann::json& counts) { counts[0]["artifact"] = "moon.obj, 8 triangles"; });
    EXPECT_EQ(count("--reference reference.json"), 1);
    EXPECT_NE(text("err.txt").find("reference.json lacks star.obj, 8 triangles in near"), std::string::npos)
        << text("err.txt");
    write_reference([](nlohmann::json& counts) { counts.clear(); });
    EXPECT_EQ(count("--reference reference.json"), 1);
}

TEST_F(BenchCounts, FailsWhenASingleCountGrows) {
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

TEST_F(BenchScaling, ReliefBlocksDoNotGrowWithTheTrianglesOfOneSurface) {
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

TEST_F(BenchScaling, BakesModeWritesARowAndLeavesNoPack) {
    write_star();
    ASSERT_EQ(run("frustumscreen-bench scaling --bakes --mesh star.obj --size 48 --out out"), 0)
        << text("err.txt");
    const std::string csv = text("out/bakes.csv");
    EXPECT_TRUE(csv.starts_with("triangles,")) << csv;
    EXPECT_NE(csv.find("\n8,"), std::string::npos) << csv; // the star's triangles
    EXPECT_FALSE(std::filesystem::exists(folder / "out/bench-bake.fspack"));
    EXPECT_EQ(run("frustumscreen-bench scaling --mesh star.obj --out out"), 2) << "--mesh is for --bakes";
    EXPECT_EQ(run("frustumscreen-bench scaling --bakes --mesh none.obj --out out"), 1);
    EXPECT_NE(text("err.txt").find("none.obj"), std::string::npos) << text("err.txt");
}

TEST_F(BenchScaling, ThrowRatiosAreMeasuredWithoutASearch) {
    ASSERT_EQ(run("frustumscreen-bench setup --config '" + source_dir() +
                  "/config/kiosk.toml' --throw-ratios 1.875 1.5 --out out"),
              0)
        << text("err.txt");
    // At 1.5 m the picture is 1.5 / 1.875 = 0.8 m wide and 1200 / 1920 of that deep, with 1920 / 0.8 pixels a metre.
    const std::string csv = text("out/zones.csv");
    EXPECT_NE(csv.find("\n1.8750,0.8000,0.5000,"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",2400.0\n1.5000,1.0000,0.6250,"), std::string::npos) << csv;
    EXPECT_FALSE(std::filesystem::exists(folder / "out/setup.csv"));
}

/// A page with the ladder's table, and the CSV of one policy.
class BenchReport : public ProgramFolder {
protected:
    void SetUp() override {
        std::filesystem::create_directories(folder / "from/ladder");
        put("page.md", page("old\n"));
        write_ladder("0.00019");
    }
    void write_ladder(const std::string& dark) const {
        put("from/ladder/ladder_policies.csv",
            "policy,whole,untracked,words,dark,longest_dark_s,reboots,false_alarms\n"
            "ladder,0.9856,0.009,0.0052," +
                dark + ",120,47,0\n");
    }
    [[nodiscard]] static std::string page(const std::string& table) {
        return "# A page\n<!-- table: ladder -->\n" + table + "<!-- end -->\nprose\n";
    }
    [[nodiscard]] int report(const std::string& more = {}) const {
        return run("frustumscreen-bench report --from from --page page.md " + more);
    }
    const std::string measured =
        page("| policy | whole exhibit | does not follow | words for staff | dark | longest dark | reboots | "
             "false alarms |\n|---|---|---|---|---|---|---|---|\n"
             "| ladder | 98.56 % | 0.90 % | 0.52 % | 0.019 % | 2 min | 47 | 0 |\n");
};

TEST_F(BenchReport, CheckFailsUntilTheTableIsWritten) {
    EXPECT_EQ(report("--check"), 1);
    EXPECT_EQ(text("page.md"), page("old\n"));
    EXPECT_EQ(text("out.txt"), "ladder: differs from from/ladder/ladder_policies.csv\n");
    EXPECT_NE(text("err.txt").find("[report.differs]"), std::string::npos) << text("err.txt");
    EXPECT_EQ(report(), 0) << text("err.txt");
    EXPECT_EQ(text("out.txt"), "ladder: written\n");
    EXPECT_EQ(text("page.md"), measured);
    EXPECT_EQ(report("--check"), 0) << text("err.txt");
    EXPECT_EQ(text("out.txt"), "ladder: is as measured\n");
}

TEST_F(BenchReport, ReportsAMalformedNumberInOneLineAndKeepsThePage) {
    write_ladder("much");
    EXPECT_EQ(report(), 1);
    const std::string said = text("err.txt");
    EXPECT_NE(said.find("from/ladder/ladder_policies.csv, line 2, column 'dark': 'much' is not a number"),
              std::string::npos)
        << said;
    EXPECT_EQ(said.find('\n'), said.size() - 1);
    EXPECT_EQ(text("page.md"), page("old\n"));
}

TEST_F(BenchReport, NamesAMissingPageOrFolder) {
    EXPECT_EQ(run("frustumscreen-bench report --from nowhere --page page.md"), 1);
    EXPECT_NE(text("err.txt").find("nowhere"), std::string::npos);
    EXPECT_EQ(run("frustumscreen-bench report --from from --page none.md"), 1);
    EXPECT_NE(text("err.txt").find("none.md"), std::string::npos);
}

} // namespace
} // namespace frustumscreen::programs
