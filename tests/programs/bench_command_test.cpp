// What the bench's program ends with, seen from outside.

#include "firmware_host/base/json.h"
#include "tests/programs/program_folder.h"

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
        return run(
            "frustumscreen-bench counts --pack star.fspack --poses 2 --config '" FRUSTUMSCREEN_SOURCE_DIR
            "/config/near.toml' --out out " +
            more);
    }
    /// Writes the counts in `out`, changed by `change`, as reference.json.
    template <class Change> void write_reference(Change change) const {
        nlohmann::json counts = nlohmann::json::parse(text("out/counts.json"));
        change(counts.at("mean_of_a_frame"));
        ASSERT_TRUE(write_file(folder / "reference.json", as_bytes(counts.dump())));
    }
};

TEST_F(BenchCounts, TheirOwnReferenceHolds) {
    ASSERT_EQ(count(""), 0) << text("err.txt");
    write_reference([](nlohmann::json&) {});
    EXPECT_EQ(count("--reference reference.json"), 0) << text("err.txt");
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

TEST_F(BenchCounts, AFrameThatTakesMoreEndsWithOne) {
    ASSERT_EQ(count(""), 0) << text("err.txt");
    write_reference(
        [](nlohmann::json& counts) { counts[0]["triangles"] = 0.9 * counts[0]["triangles"].get<double>(); });
    EXPECT_EQ(count("--reference reference.json"), 1);
    EXPECT_NE(text("err.txt").find("takes over 5 % more"), std::string::npos) << text("err.txt");
}

} // namespace
} // namespace frustumscreen
