// `frustumscreen-bake --batch`: a killed run continues and ends with the packs of an uninterrupted one; shards do too.
#include "tests/folders.h"
#include "tests/programs/curator_folder.h"

namespace frustumscreen::programs {
namespace {

namespace fs = std::filesystem;

constexpr const char* spoken = "[[texts]]\nlanguage = \"en\"\ntitle = \"Jug\"\ndescription = \"A jug.\"\n";

class BakeBatch : public CuratorFolder {
protected:
    void SetUp() override {
        for (const char* name : {"a", "b"}) {
            put_jug(std::string("objects/") + name, spoken);
        }
        put_jug("objects/misspelt", "siez = 3\n");
        put("objects/also.obj", text("objects/a/jug.obj"));
        put_recording("voice.wav");
        put("voice.sh", "cat voice.wav\n");
    }
    [[nodiscard]] int batch(const std::string& more) const {
        return run("frustumscreen-bake --batch objects --size 16 --speech 'sh voice.sh' " + more);
    }
    void expect_same_packs(const std::string& one, const std::string& other) const {
        for (const char* name : {"a", "b", "also"}) {
            const std::string pack = text(fmt::format("{}/{}.fspack", one, name));
            EXPECT_FALSE(pack.empty()) << name;
            EXPECT_TRUE(pack == text(fmt::format("{}/{}.fspack", other, name))) << name;
        }
    }
};

TEST_F(BakeBatch, ResumedAndShardedRunsProduceTheSamePacksAsAWholeRun) {
    ASSERT_EQ(batch("-o whole -j 2"), 1) << "one object is broken: " << text("err.txt");
    EXPECT_NE(text("out.txt").find("4 objects: 3 baked, 1 failed"), std::string::npos) << text("out.txt");
    EXPECT_EQ(count("err.txt", "misspelt: objects/misspelt/artifact.toml:3: siez"), 1U) << text("err.txt");

    // The second spoken object waits as long as `hold` exists.
    put("hold", "");
    put("voice.sh", "if [ -e hold ] && [ -e spoken_once ]; then echo $$ >held; sleep 1000; fi\n"
                    ": >spoken_once\ncat voice.wav\n");
    const pid_t killed =
        start("frustumscreen-bake --batch objects --size 16 --speech 'sh voice.sh' -o parts -j 1");
    ASSERT_TRUE(comes_true([&] { return count("held", "\n") == 1; })) << text("log.txt");
    ASSERT_EQ(::kill(killed, SIGKILL), 0);
    const auto voice = static_cast<pid_t>(std::stol(text("held")));
    EXPECT_TRUE(comes_true([&] { return !runs(voice); })) << "what it had started ends with it";
    EXPECT_TRUE(fs::exists(folder / "parts/a.fspack"));
    EXPECT_FALSE(fs::exists(folder / "parts/b.fspack"));
    EXPECT_FALSE(fs::exists(folder / "parts/report.csv"));

    fs::remove(folder / "hold");
    ASSERT_EQ(batch("-o parts -j 2"), 1);
    EXPECT_NE(text("out.txt").find("4 objects: 1 baked, 2 unchanged, 1 failed"), std::string::npos)
        << text("out.txt");
    expect_same_packs("whole", "parts");
    for (const auto& entry : fs::directory_iterator(folder / "parts")) {
        EXPECT_EQ(entry.path().string().find(".part"), std::string::npos)
            << entry.path() << " was left behind";
    }

    // Two shards in another folder give the same packs.
    EXPECT_EQ(batch("-o shards --shard 1/2 --json"), 0) << text("err.txt");
    EXPECT_NE(text("out.txt").find("\"baked\": 2"), std::string::npos) << text("out.txt");
    EXPECT_EQ(batch("-o shards --shard 2/2"), 1) << "the misspelt one is here";
    expect_same_packs("whole", "shards");
    EXPECT_EQ(batch("-o shards --report-only"), 1);
    EXPECT_NE(text("out.txt").find("4 objects: 3 unchanged, 1 failed"), std::string::npos) << text("out.txt");
    // Python's csv reader: the two shards' rows are those of the whole run.
    put("look.py",
        "import csv, glob\n"
        "def names(pattern): return sorted(r['object'] for f in glob.glob(pattern)\n"
        "                                  for r in csv.DictReader(open(f, newline='')))\n"
        "assert names('shards/report.?-of-2.csv') == names('shards/report.csv') == "
        "names('whole/report.csv')\n"
        "assert len(glob.glob('shards/report.?-of-2.html')) == 2\n"
        "rows = {r['object']: r for r in csv.DictReader(open('shards/report.csv', newline=''))}\n"
        "assert 'siez' in rows['misspelt']['sentence'] and float(rows['a']['seconds']) > 0, rows\n");
    EXPECT_EQ(std::system(fmt::format("cd '{}' && python3 look.py", folder.string()).c_str()), 0);
}

TEST_F(BakeBatch, SlurmBakesTheSharesAsAJobArray) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer needs more memory than a task is allowed";
#endif
    for (const char* program : {"slurmctld", "slurmd", "munged", "sbatch"}) {
        if (std::system(fmt::format("PATH=$PATH:/usr/sbin command -v {} >/dev/null", program).c_str()) != 0) {
            GTEST_SKIP() << program << " is not installed (Debian's slurm-wlm)";
        }
    }
    if (std::system("unshare -n -m -p -f true 2>/dev/null") != 0) {
        GTEST_SKIP() << "only root may start a cluster here";
    }
    put("submit.sh",
        fmt::format("export FRUSTUMSCREEN_BAKE='{}/frustumscreen-bake'\n"
                    "sbatch --wait --array=1-2 --cpus-per-task=1 --mem=600M --output=task.%a.log "
                    "'{}/assets_baked/batch/slurm_array.sh' objects packs --size 16 --speech 'sh voice.sh'\n"
                    "sbatch --wait --array=2-3 --cpus-per-task=1 --mem=600M --output=refused.%a.log "
                    "'{}/assets_baked/batch/slurm_array.sh' objects packs\n",
                    bin_dir(), source_dir(), source_dir()));
    fs::create_directory(folder / "cluster");
    (void)std::system(
        fmt::format(
            "cd '{}' && PATH=$PATH:/usr/sbin timeout -s KILL 120 '{}/tests/programs/slurm_cluster.sh' "
            "cluster sh submit.sh >slurm.txt 2>&1",
            folder.string(), source_dir())
            .c_str());
    EXPECT_EQ(count("task.1.log", "2 objects: 2 baked"), 1U) << text("slurm.txt") << text("task.1.log");
    EXPECT_EQ(count("task.2.log", "2 objects: 1 baked, 1 failed"), 1U)
        << text("slurm.txt") << text("task.2.log");
    for (const char* log : {"refused.2.log", "refused.3.log"}) {
        EXPECT_EQ(count(log, "submit the array as --array=1-N"), 1U) << text("slurm.txt") << text(log);
    }
    ASSERT_EQ(batch("-o whole -j 2"), 1);
    expect_same_packs("whole", "packs");
}

TEST_F(BakeBatch, ReportsErrorsOfTheWholeBatchInOneLine) {
    const auto said = [&](const std::string& command, int status, const std::string& part) {
        EXPECT_EQ(run("frustumscreen-bake " + command), status) << command;
        EXPECT_EQ(count("err.txt", "\n"), 1U) << text("err.txt");
        EXPECT_EQ(count("err.txt", part), 1U) << text("err.txt");
    };
    said("--batch nowhere -o packs", 1, "nowhere: cannot be read as a folder of objects");
    said("--batch objects -o packs --shard 3/2", 2, "--shard '3/2': allowed are 1/N to N/N");
    said("--batch objects -o voice.sh", 1, "voice.sh: ");
    put("none/notes.txt", "nothing to bake here");
    said("--batch none -o packs", 1, "none: it contains no scan and no folder with an artifact.toml");
    EXPECT_EQ(run("frustumscreen-bake --batch objects"), 2) << "no place for the packs";
    EXPECT_EQ(run("frustumscreen-bake --batch -o packs"), 2);
    EXPECT_EQ(run("frustumscreen-bake --batch --help"), 0);
    EXPECT_EQ(count("out.txt", "--memory-limit"), 1U) << text("out.txt");
    EXPECT_EQ(run("frustumscreen-bake --batch objects -o packs -j 0"), 2);
    EXPECT_EQ(run("frustumscreen-bake --batch objects -o packs --memory-limit 100"), 2);
    EXPECT_EQ(count("err.txt", "allowed are 500 megabytes and more, or 0 for no limit"), 1U)
        << text("err.txt");
}

} // namespace
} // namespace frustumscreen::programs
