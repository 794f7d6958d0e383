// frustumscreen-import on real folders: its output, the files it leaves, and that it may be killed.
#include "app/pack/signature/signature.h"
#include "firmware_host/base/json.h"
#include "tests/folders.h"
#include "tests/library/museum.h"
#include "tests/programs/program_folder.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <random>

namespace frustumscreen::library {
namespace {

using nlohmann::json;
using testing_disk::Museum;

class ImportProgram : public programs::ProgramFolder {
protected:
    void SetUp() override {
        std::filesystem::create_directories(folder / "stick/more");
        std::filesystem::create_directories(folder / "keys");
        put("keys/museum.pub", as_bytes(pack::write_public_key(museum.key.public_key())));
    }
    void put(const std::string& file, std::span<const std::byte> bytes) const {
        ASSERT_TRUE(write_file(folder / file, bytes));
    }
    [[nodiscard]] int import(const std::string& more = "") const {
        return run("frustumscreen-import --from stick --into library --keys keys " + more);
    }
    [[nodiscard]] json listed() const {
        EXPECT_EQ(run("frustumscreen-import --list --into library --json"), 0) << text("err.txt");
        return json::parse(text("out.txt"));
    }
    [[nodiscard]] std::vector<std::string> titles() const {
        std::vector<std::string> titles;
        const json set = listed();
        for (const json& pack : set["packs"]) {
            titles.push_back(pack["title"]);
        }
        return titles;
    }
    /// Every listed file is there and has its hash.
    void expect_whole() const {
        const json set = listed();
        for (const json& pack : set["packs"]) {
            const Result<Bytes> bytes = read_file(folder / "library" / pack["file"].get<std::string>());
            ASSERT_TRUE(bytes) << pack;
            EXPECT_EQ(pack::sha256_hex(*bytes), pack["sha256"].get<std::string>());
        }
    }
    /// Names, sizes and times of all entries of the stick.
    [[nodiscard]] std::string stick_state() const {
        std::string state;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "stick")) {
            struct stat status {};
            ::lstat(entry.path().c_str(), &status);
            state += fmt::format("{} {} {}.{}\n", entry.path().string(), status.st_size,
                                 status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
        }
        return state;
    }

    Museum museum;
};

TEST_F(ImportProgram, ImportsListsAndReports) {
    put("stick/vase.fspack", museum.pack("vase", 3));
    put("stick/more/cup.fspack", museum.pack("cup", 1));
    put("stick/plain.fspack", Museum::unsigned_pack("plain", "plain"));
    const std::string before = stick_state();
    EXPECT_EQ(import("--report report.json --label MUSEUM"), 0) << text("err.txt");
    EXPECT_EQ(stick_state(), before);
    EXPECT_NE(text("out.txt").find("vase.fspack (\"vase 3\"): taken"), std::string::npos) << text("out.txt");
    EXPECT_EQ(text("err.txt").find("frustumscreen-import: plain.fspack: refused: it is not signed"), 0U)
        << text("err.txt");
    const Result<ImportReport> report = parse_import_report(text("report.json"));
    ASSERT_TRUE(report);
    EXPECT_EQ(report->stage, ImportStage::Done);
    EXPECT_EQ(report->stick, "MUSEUM");
    EXPECT_EQ(report->packs.size(), 3U);
    const json set = listed();
    ASSERT_EQ(set["packs"].size(), 2U);
    EXPECT_EQ(set["packs"][0]["title"], "cup 1");
    EXPECT_EQ(set["packs"][1]["serial"], 3);
    expect_whole();
    EXPECT_EQ(import(), 0);
    EXPECT_NE(text("out.txt").find("already there"), std::string::npos);
    EXPECT_EQ(import("--json"), 0);
    EXPECT_EQ(parse_import_report(text("out.txt"))->packs.size(), 3U);
}

TEST_F(ImportProgram, ListsTrustedKeys) {
    const pack::SecretKey next = pack::SecretKey::make();
    const std::string set =
        fmt::format("[[key]]\nname = \"2031\"\npublic_key = \"{}\"\nuntil = \"2035-12-31\"\n",
                    pack::public_key_line(next.public_key()));
    put("stick/exhibit.toml", as_bytes(set));
    put("stick/exhibit.toml.minisig", as_bytes(museum.key.sign(as_bytes(set), "serial:1")));
    ASSERT_EQ(import(), 0) << text("err.txt");
    const json alone = listed()["keys"];
    ASSERT_EQ(alone.size(), 1U);
    EXPECT_EQ(alone[0]["name"], "2031");
    EXPECT_EQ(alone[0]["id"], pack::text_of_key_id(next.public_key().id));
    EXPECT_EQ(alone[0]["from"], pack::text_of_key_id(museum.key.public_key().id));
    EXPECT_TRUE(alone[0]["counts"].is_null()) << "unknown without the settings";
    ASSERT_EQ(run("frustumscreen-import --list --into library --keys keys --json"), 0);
    const json both = json::parse(text("out.txt"))["keys"];
    ASSERT_EQ(both.size(), 2U);
    EXPECT_EQ(both[0]["name"], "museum");
    EXPECT_EQ(both[1]["counts"], true);
    put("keys/museum.pub", as_bytes(pack::write_public_key(pack::SecretKey::make().public_key())));
    ASSERT_EQ(run("frustumscreen-import --list --into library --keys keys"), 0);
    EXPECT_NE(text("out.txt").find("until 2035-12-31"), std::string::npos) << text("out.txt");
    EXPECT_NE(text("out.txt").find("is no longer trusted"), std::string::npos) << text("out.txt");
}

TEST_F(ImportProgram, ListsEachPacksSignerAndItsTrust) {
    const pack::SecretKey second = pack::SecretKey::make();
    const auto bring_key = [&](const std::string& until, int serial) {
        const std::string set = fmt::format("[[key]]\nname = \"second\"\npublic_key = \"{}\"\n{}",
                                            pack::public_key_line(second.public_key()), until);
        put("stick/exhibit.toml", as_bytes(set));
        put("stick/exhibit.toml.minisig",
            as_bytes(museum.key.sign(as_bytes(set), fmt::format("serial:{}", serial))));
    };
    bring_key("", 1);
    put("stick/vase.fspack", museum.pack("vase", 3));
    put("stick/cup.fspack", Museum::signed_by(second, Museum::unsigned_pack("cup", "Cup"), 1));
    ASSERT_EQ(import(), 0) << text("err.txt");
    const auto listed_line = [&](const std::string& id) {
        const std::string all = text("out.txt");
        const std::size_t at = all.find("  " + id + "  ");
        return at == std::string::npos ? all : all.substr(at, all.find('\n', at) - at);
    };
    ASSERT_EQ(run("frustumscreen-import --list --into library --keys keys"), 0);
    EXPECT_TRUE(listed_line("cup").ends_with("signed by second")) << text("out.txt");
    EXPECT_TRUE(listed_line("vase").ends_with("signed by museum")) << text("out.txt");
    const json without = listed()["packs"];
    EXPECT_EQ(without[0]["signed_by"]["id"], pack::text_of_key_id(second.public_key().id));
    EXPECT_TRUE(without[0]["signed_by"]["counts"].is_null()) << "unknown without the settings";

    bring_key("until = \"2020-01-01\"\n", 2);
    std::filesystem::remove(folder / "stick/cup.fspack"); // it would be refused, and with it the whole stick
    ASSERT_EQ(import(), 0) << text("err.txt");
    EXPECT_NE(
        text("out.txt").find("exhibit.toml: taken: packs of a key that is no longer trusted stay: cup;"),
        std::string::npos)
        << text("out.txt");
    ASSERT_EQ(run("frustumscreen-import --list --into library --keys keys"), 0);
    EXPECT_TRUE(
        listed_line("cup").ends_with("signed by second, which is no longer trusted (until 2020-01-01)"))
        << text("out.txt");
    EXPECT_TRUE(listed_line("vase").ends_with("signed by museum")) << text("out.txt");
    ASSERT_EQ(run("frustumscreen-import --list --into library --keys keys --json"), 0);
    const json packs = json::parse(text("out.txt"))["packs"];
    EXPECT_EQ(packs[0]["signed_by"]["name"], "second");
    EXPECT_EQ(packs[0]["signed_by"]["counts"], false);
    EXPECT_EQ(packs[1]["signed_by"]["counts"], true);
    std::filesystem::remove(folder / "library" / packs[0]["file"].get<std::string>());
    ASSERT_EQ(run("frustumscreen-import --list --into library --keys keys"), 0);
    EXPECT_TRUE(listed_line("cup").ends_with("its file cannot be read")) << text("out.txt");
}

/// The name as udev writes it: mke2fs -L and blkid give the same bytes (util-linux, encode.c).
TEST_F(ImportProgram, DecodesTheLabelFromTheUdevLink) {
    const auto label_of = [&](const std::string& link) {
        std::filesystem::remove_all(folder / "labels");
        std::filesystem::create_directory(folder / "labels");
        std::filesystem::create_symlink("../../sda1", folder / "labels" / link);
        EXPECT_EQ(import("--report report.json --label-from labels"), 0) << text("err.txt");
        const Result<ImportReport> report = parse_import_report(text("report.json"));
        EXPECT_TRUE(report) << text("report.json");
        return report ? report->stick : std::string();
    };
    EXPECT_EQ(label_of("label=MUSÉE"), "MUSÉE");
    EXPECT_EQ(label_of("label=Oak\\x20Room\\x2f2"), "Oak Room/2");
    EXPECT_EQ(label_of("label=.."), "..");
    EXPECT_EQ(label_of("label=A\\x4"), "A\\x4");
    EXPECT_EQ(label_of("label="), "");
    EXPECT_EQ(label_of("other"), "");
    for (const char* hostile : {"label=\\x1b\\x5b2J", "label=\\xff\\xc0", "label=\\x0a\\x0aREAD\\x00"}) {
        const std::string label = label_of(hostile);
        EXPECT_TRUE(std::none_of(label.begin(), label.end(), [](unsigned char c) {
            return c < ' ' || c == 0x7f || c >= 0xf8;
        })) << hostile;
    }
    std::filesystem::remove_all(folder / "labels");
    EXPECT_EQ(import("--report report.json --label-from labels"), 0) << text("err.txt");
}

TEST_F(ImportProgram, RejectsMissingOptionsAndFolders) {
    EXPECT_EQ(run("frustumscreen-import --from stick"), 2);
    EXPECT_EQ(run("frustumscreen-import --from stick --into library"), 2);
    EXPECT_EQ(run("frustumscreen-import --list"), 2);
    EXPECT_EQ(run("frustumscreen-import --help"), 0);
    EXPECT_EQ(run("frustumscreen-import --version"), 0);
    EXPECT_EQ(run("frustumscreen-import --from nowhere --into library --keys keys"), 1);
    EXPECT_NE(text("err.txt").find("nowhere"), std::string::npos);
    EXPECT_EQ(run("frustumscreen-import --list --into nowhere"), 1);
    EXPECT_EQ(run("frustumscreen-import --unmounted --report report.json --label X"), 1);
    EXPECT_EQ(parse_import_report(text("report.json"))->refusal, ImportRefusal::Unreadable);
}

TEST_F(ImportProgram, ReportsUnusableSettingsAndLibrary) {
    put("kiosk.toml", as_bytes("[exhibit\n"));
    const std::string words = "frustumscreen-import --from stick --report report.json --id stick8p1 ";
    EXPECT_EQ(run(words + "--into library --config kiosk.toml"), 1);
    Result<ImportReport> report = parse_import_report(text("report.json"));
    ASSERT_TRUE(report);
    EXPECT_EQ(report->stage, ImportStage::Failed);
    EXPECT_EQ(report->refusal, ImportRefusal::Unwritable);
    EXPECT_EQ(report->import_id, "stick8p1");
    EXPECT_NE(report->reason.find("kiosk.toml"), std::string::npos) << report->reason;
    EXPECT_NE(text("err.txt").find(report->reason), std::string::npos) << text("err.txt");
    put("file", as_bytes("no folder"));
    EXPECT_EQ(run(words + "--into file --keys keys"), 1);
    report = parse_import_report(text("report.json"));
    EXPECT_EQ(report->refusal, ImportRefusal::Unwritable);
    EXPECT_NE(report->reason.find("file"), std::string::npos) << report->reason;
}

TEST_F(ImportProgram, UnmountedKeepsTheReportOfAStickThatWasRead) {
    put("stick/vase.fspack", museum.pack("vase", 3));
    ASSERT_EQ(import("--report report.json --id stick8p1"), 0);
    const std::string read = text("report.json");
    const std::string words = "frustumscreen-import --unmounted --into library --report report.json --id ";
    EXPECT_EQ(run(words + "stick8p1"), 0);
    EXPECT_EQ(run(words + "stick8p2"), 0);
    EXPECT_EQ(text("report.json"), read);
    // The clock was set back by an hour: the wait is still no longer than requested.
    std::filesystem::last_write_time(folder / "report.json",
                                     std::filesystem::file_time_type::clock::now() + std::chrono::hours(1));
    EXPECT_EQ(run(words + "stick9 --report-stands 0.1"), 1);
    EXPECT_EQ(parse_import_report(text("report.json"))->import_id, "stick9");
}

TEST_F(ImportProgram, FollowsNoLinkAndWaitsForNoPipe) {
    put("vase.fspack", museum.pack("vase", 3));
    std::filesystem::create_symlink(folder / "vase.fspack", folder / "stick/link.fspack");
    std::filesystem::create_directory_symlink(folder, folder / "stick/outside");
    ASSERT_EQ(::mkfifo((folder / "stick/pipe.fspack").c_str(), 0600), 0);
    std::filesystem::create_directories(folder / "stick/folder.fspack");
    EXPECT_EQ(import("--json"), 0);
    const Result<ImportReport> report = parse_import_report(text("out.txt"));
    ASSERT_TRUE(report);
    EXPECT_EQ(report->packs.size(), 2U);
    for (const ImportedPack& pack : report->packs) {
        EXPECT_EQ(pack.refusal, ImportRefusal::NotAPack) << pack.file;
    }
    std::filesystem::create_symlink(folder / "keys/museum.pub", folder / "stick/exhibit.toml");
    EXPECT_EQ(import(), 1);
}

TEST_F(ImportProgram, WaitsForAnotherImportAndTakesBothSticks) {
    put("stick/vase.fspack", museum.pack("vase", 1));
    std::filesystem::create_directories(folder / "second");
    put("second/cup.fspack", museum.pack("cup", 1));
    std::filesystem::create_directories(folder / "library");
    const int lock = ::open((folder / "library").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    ASSERT_EQ(::flock(lock, LOCK_EX), 0);
    // It does not begin while the lock is held, however long it waits.
    EXPECT_EQ(std::system(
                  fmt::format("cd '{}' && timeout 0.5 '{}'/frustumscreen-import --from stick --into library "
                              "--keys keys >out.txt 2>err.txt",
                              folder.string(), bin_dir())
                      .c_str()) >>
                  8,
              124);
    EXPECT_EQ(text("out.txt"), "");
    ::close(lock);
    const std::string program = bin_dir() + "/frustumscreen-import";
    EXPECT_EQ(
        std::system(fmt::format("cd '{0}' && '{1}' --from stick --into library --keys keys >/dev/null & "
                                "cd '{0}' && '{1}' --from second --into library --keys keys >/dev/null; "
                                "other=$?; wait $! && exit $other",
                                folder.string(), program)
                        .c_str()),
        0);
    std::vector<std::string> both = titles();
    std::sort(both.begin(), both.end());
    EXPECT_EQ(both, (std::vector<std::string>{"cup 1", "vase 1"}));
    expect_whole();
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_F(ImportProgram, NeedsLittleMemoryForALargePart) {
    constexpr std::size_t mib = 1U << 20U;
    {
        const Bytes small = Museum::unsigned_pack("large", "large", 1000);
        samples::Entries entries = samples::take_apart(small);
        entries.part("padding.bin") = Bytes(100 * mib);
        samples::right_hashes(entries);
        pack::ZipWriter zip;
        zip.add("manifest.json", as_bytes(entries.manifest.dump()), pack::Packing::Deflated);
        for (const auto& [name, bytes] : entries.parts) {
            zip.add(name, bytes, pack::Packing::Deflated);
        }
        put("stick/large.fspack", Museum::signed_by(museum.key, zip.finish().value(), 1));
    }
    // The limit covers all memory that a process may write to, including the libraries' own data.
    EXPECT_EQ(
        std::system(fmt::format("cd '{}' && ulimit -d 49152 && '{}'/frustumscreen-import --from stick --into "
                                "library --keys keys >out.txt 2>err.txt",
                                folder.string(), bin_dir())
                        .c_str()),
        0)
        << text("err.txt");
    EXPECT_EQ(titles(), std::vector<std::string>{"large"});
}
#endif

TEST_F(ImportProgram, MayBeKilledAtAnyMoment) {
    constexpr int kills = 24;
    put("stick/a.fspack", museum.pack("a", 1));
    ASSERT_EQ(import(), 0);
    for (const std::string id : {"a", "b", "c"}) {
        put("stick/" + id + ".fspack", museum.pack(id, 2, 300000));
    }
    std::filesystem::copy(folder / "library", folder / "old", std::filesystem::copy_options::recursive);
    const auto began = std::chrono::steady_clock::now();
    ASSERT_EQ(import(), 0);
    const auto whole = std::chrono::steady_clock::now() - began;
    const std::vector<std::string> old_titles{"a 1"};
    const std::vector<std::string> new_titles{"a 2", "b 2", "c 2"};
    ASSERT_EQ(titles(), new_titles);
    const std::string program = bin_dir() + "/frustumscreen-import";
    std::mt19937 random(7);
    for (int k = 0; k < kills; ++k) {
        std::filesystem::remove_all(folder / "library");
        std::filesystem::copy(folder / "old", folder / "library", std::filesystem::copy_options::recursive);
        const pid_t process = ::fork();
        if (process == 0) {
            if (::chdir(folder.c_str()) == 0 && ::freopen("out.txt", "w", stdout) != nullptr) {
                ::execl(program.c_str(), "frustumscreen-import", "--from", "stick", "--into", "library",
                        "--keys", "keys", nullptr);
            }
            ::_exit(127);
        }
        ::usleep(
            static_cast<useconds_t>(std::chrono::duration_cast<std::chrono::microseconds>(whole).count() *
                                    static_cast<std::int64_t>(random() % 1000) / 1000));
        ::kill(process, SIGKILL);
        ::waitpid(process, nullptr, 0);
        const std::vector<std::string> now = titles();
        EXPECT_TRUE(now == old_titles || now == new_titles) << now.size();
        expect_whole();
        ASSERT_EQ(import(), 0) << text("err.txt");
        EXPECT_EQ(titles(), new_titles);
    }
}

} // namespace
} // namespace frustumscreen::library
