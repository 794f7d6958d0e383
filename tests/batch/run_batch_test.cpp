// Many bakes, each in a process of its own: a shell script stands for the program and fails in every possible way.
#include "app/programs/batch/run_batch.h"
#include "tests/programs/program_folder.h"

#include <algorithm>

namespace frustumscreen::programs {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// Writes a pack like the program; the name of the object in its input chooses the failure.
constexpr const char* script = R"(
for word; do case "$word" in --output=*) out=${word#--output=} ;; esac; done
echo "$1" >>"$COUNT"
case "$1" in
*bad) echo "frustumscreen-bake: said before" >&2; echo "frustumscreen-bake: $1: has no triangles" >&2; exit 1 ;;
*slow) sleep 1000 ;;
*crash) kill -SEGV $$ ;;
*greedy) exec python3 -c 'a = bytearray(1 << 30)' ;;
*mute) exit 1 ;;
*liar) echo no JSON; : >"$out"; exit 0 ;;
esac
cat "$1" >"$out.part" && mv "$out.part" "$out"
cat <<'END'
{"title": "T", "bytes": 5, "levels": [{"mean_mm": 1, "p95_mm": 2, "colour_rmse": 3}], "default_level": 0, "lost": ["x"], "silent": [],
 "scan": {"format": "OBJ", "triangles": 12, "vertices": 8, "pictures": [[4, 2]], "materials": 1, "colours": true, "normals": false,
          "extents": [1, 2, 0.5], "unit": "m", "estimated_bytes": 6, "estimated_triangles": 7}}
END
)";

class Batch : public ProgramFolder {
protected:
    void SetUp() override {
        put("bake.sh", script);
        plan.output = folder / "out";
        fs::create_directories(plan.output);
        plan.program = {"env", "COUNT=" + (folder / "count").string(), "sh", (folder / "bake.sh").string()};
        plan.limits.complaint_bytes = 1000;
        plan.jobs = 2;
    }
    void add(const std::string& name, const std::string& content = "scan") {
        put(name, content);
        plan.objects.push_back({name, folder / name, {}});
    }
    std::vector<BatchRow> run_all() const {
        return run_batch(plan, [](const BatchRow&) {});
    }
    /// Number of starts of the script.
    std::size_t bakes() const {
        const std::string all = text("count");
        return static_cast<std::size_t>(std::count(all.begin(), all.end(), '\n'));
    }

    BatchPlan plan;
};

TEST_F(Batch, ContinuesAfterFailures) {
    for (const char* name : {"good", "bad", "crash", "mute", "liar", "other"}) {
        add(name);
    }
    add("twin");
    plan.objects.back().fault = "it has a twin";
    const std::vector<BatchRow> rows = run_all();
    ASSERT_EQ(rows.size(), 7U);
    EXPECT_EQ(rows[0].status, BatchStatus::Baked) << rows[0].sentence;
    EXPECT_EQ(rows[0].title, "T");
    EXPECT_EQ(rows[0].scan.lost, 1U);
    EXPECT_EQ(rows[0].scan.format, "OBJ");
    EXPECT_EQ(rows[0].scan.pictures, (std::vector<std::array<int, 2>>{{4, 2}}));
    EXPECT_EQ(rows[1].sentence, (folder / "bad").string() + ": has no triangles") << "the last line alone";
    EXPECT_NE(rows[2].sentence.find("ended by signal 11"), std::string::npos) << rows[2].sentence;
    EXPECT_EQ(rows[3].sentence, "the bake ended with status 1");
    EXPECT_EQ(rows[4].status, BatchStatus::Failed) << "a bake without a report";
    EXPECT_EQ(rows[5].status, BatchStatus::Baked) << "it comes after all these";
    EXPECT_EQ(rows[6].sentence, "it has a twin");
    EXPECT_EQ(bakes(), 6U);
}

TEST_F(Batch, SkipsUnchangedObjects) {
    add("a");
    add("b");
    add("bad");
    (void)run_all();
    EXPECT_EQ(bakes(), 3U);
    std::vector<BatchRow> rows = run_all();
    EXPECT_EQ(bakes(), 4U) << "what failed is tried again";
    EXPECT_EQ(rows[0].status, BatchStatus::Unchanged);
    EXPECT_EQ(rows[0].title, "T") << "the report has it all the same";
    EXPECT_EQ(rows[0].scan.extents[2], 0.5) << "and what the scan has";
    EXPECT_EQ(rows[0].scan.lost, 1U);
    put("b", "another scan");
    rows = run_all();
    EXPECT_EQ(rows[1].status, BatchStatus::Baked);
    EXPECT_EQ(text("out/b.fspack"), "another scan");
    EXPECT_EQ(bakes(), 6U);
    put("out/a.fspack", "somebody wrote here");
    EXPECT_EQ(run_all()[0].status, BatchStatus::Baked) << "a pack that is not the stamp's";
    plan.bake_options = {"--unlit"};
    EXPECT_EQ(run_all()[0].status, BatchStatus::Baked);
    plan.program_key = "a newer program";
    EXPECT_EQ(run_all()[0].status, BatchStatus::Baked);
    put("out/a.stamp", "{\"format\": 3}");
    EXPECT_EQ(run_all()[0].status, BatchStatus::Baked) << "a stamp that is none";
    EXPECT_EQ(run_all()[0].status, BatchStatus::Unchanged);
}

TEST_F(Batch, ReportsThatAFailureKeepsThePreviousPack) {
    add("bad");
    put("out/bad.fspack", "of last year");
    EXPECT_NE(run_all()[0].sentence.find("(the previous pack is still there)"), std::string::npos);
    EXPECT_EQ(text("out/bad.fspack"), "of last year");
}

TEST_F(Batch, LimitsTimeAndMemory) {
    add("slow");
    plan.limits.time = 300ms;
    EXPECT_EQ(run_all()[0].sentence,
              "the bake took longer than 0.3 s and was ended; allow more time, or use a smaller scan");
    plan.objects.clear();
    add("greedy");
    add("good");
    plan.limits.time = 60s;
    plan.limits.memory_bytes = std::uint64_t{200} << 20U;
    const std::vector<BatchRow> rows = run_all();
    EXPECT_EQ(rows[0].sentence, "MemoryError") << "what Python says of it";
    EXPECT_EQ(rows[1].status, BatchStatus::Baked) << rows[1].sentence;
}

TEST_F(Batch, BakesNothingForAReportOnly) {
    add("a");
    add("bad");
    plan.bakes = false;
    std::vector<BatchRow> rows = run_all();
    EXPECT_EQ(rows[0].status, BatchStatus::Missing);
    plan.bakes = true;
    (void)run_all();
    plan.bakes = false;
    add("late");
    rows = run_all();
    EXPECT_EQ(bakes(), 2U);
    EXPECT_EQ(rows[0].status, BatchStatus::Unchanged);
    EXPECT_EQ(rows[1].status, BatchStatus::Failed);
    EXPECT_NE(rows[1].sentence.find("has no triangles"), std::string::npos) << "why it failed is kept";
    EXPECT_EQ(rows[2].status, BatchStatus::Missing);
}

} // namespace
} // namespace frustumscreen::programs
