// frustumscreen-pack keygen, sign and verify from outside, together with Debian's minisign: each accepts the
// other's output.
#include "tests/base/temporary_folder.h"
#include "tests/folders.h"
#include "tests/signature/signature_testing.h"

#include <pty.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace frustumscreen::pack {
namespace {

namespace fs = std::filesystem;

/// A separate folder for each test, in which commands run.
class SignProgram : public WithTemporaryFolder {
protected:
    struct Outcome {
        int status = -1;
        std::string out;
        std::string error;
    };

    void SetUp() override {
        ASSERT_TRUE(write_file(folder / "vase.fspack", samples::bytes_of(samples::full_pack())));
    }

    /// Runs a command without a terminal: standard input is empty unless the command redirects it.
    [[nodiscard]] Outcome run(const std::string& command) const {
        const int status = shell("exec 0</dev/null >out.txt 2>error.txt && " + command);
        return {status, text("out.txt"), text("error.txt")};
    }
    [[nodiscard]] Outcome pack(const std::string& arguments, const std::string& before = {}) const {
        return run(before + bin_dir() + "/frustumscreen-pack " + arguments);
    }
    void expect_done(const Outcome& outcome) const {
        EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.error;
    }
    void expect_failed(const Outcome& outcome, const std::string& words) const {
        EXPECT_EQ(outcome.status, 1);
        EXPECT_TRUE(outcome.error.starts_with("frustumscreen-pack: ")) << outcome.error;
        EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
        EXPECT_NE(outcome.error.find(words), std::string::npos) << outcome.error;
    }
    /// The procedure that FORMAT.md describes for minisign.
    [[nodiscard]] Outcome minisign_verifies(const std::string& file, const std::string& options) const {
        expect_done(run("python3 -c 'import sys, zipfile; z = zipfile.ZipFile(sys.argv[1]); "
                        "open(\"m\", \"wb\").write(z.read(\"manifest.json\")); "
                        "open(\"m.minisig\", \"wb\").write(z.read(\"signature\"))' " +
                        file));
        return run("minisign -V -m m -x m.minisig " + options);
    }
    /// Runs on a new terminal and types these lines. Returns the terminal's output.
    std::pair<int, std::string> on_terminal(const std::string& arguments, const std::string& typed) const {
        const std::string command =
            fmt::format("cd '{}' && exec {}/frustumscreen-pack {}", folder.string(), bin_dir(), arguments);
        int terminal = -1;
        const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
        if (child == 0) {
            ::alarm(100); // an unanswered question ends the test
            ::execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
            ::_exit(127);
        }
        std::string shown;
        std::size_t asked = 0;
        std::istringstream lines(typed);
        std::array<char, 4096> piece{};
        for (ssize_t got = 0; (got = ::read(terminal, piece.data(), piece.size())) > 0;) {
            shown.append(piece.data(), static_cast<std::size_t>(got));
            // Type a line only when it is requested: the terminal may echo lines typed earlier.
            for (std::size_t at = shown.find(": ", asked); at != std::string::npos;
                 at = shown.find(": ", asked)) {
                asked = at + 2;
                std::string line;
                if (shown.size() == asked && std::getline(lines, line)) {
                    line += '\n';
                    EXPECT_EQ(::write(terminal, line.data(), line.size()), static_cast<ssize_t>(line.size()));
                }
            }
        }
        int ended = 0;
        ::waitpid(child, &ended, 0);
        ::close(terminal);
        return {WIFEXITED(ended) ? WEXITSTATUS(ended) : -1, shown};
    }
    void make_keys() const {
        expect_done(pack("keygen -o house"));
        expect_done(pack("keygen -o stranger"));
    }
    [[nodiscard]] nlohmann::json verified(const std::string& arguments) const {
        return nlohmann::json::parse(pack("verify --json " + arguments).out);
    }
};

TEST_F(SignProgram, KeygenWithoutATerminalWritesAnUnencryptedPrivateFile) {
    const Outcome made = pack("keygen -o house");
    expect_done(made);
    EXPECT_NE(made.out.find("without a password"), std::string::npos) << made.out;
    struct stat status {};
    ASSERT_EQ(::stat((folder / "house.key").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U);
    EXPECT_NE(made.out.find(public_key_line(parse_public_key(text("house.pub")).value())), std::string::npos)
        << "the settings' line is said";
    const std::string before = text("house.key");
    expect_failed(pack("keygen -o house"), "house.key: this key exists");
    EXPECT_EQ(text("house.key"), before);
    fs::remove(folder / "house.key");
    expect_failed(pack("keygen -o house"), "house.pub: this key exists");
    EXPECT_FALSE(fs::exists(folder / "house.key"));
    expect_failed(pack("keygen -o nowhere/house"), "nowhere/house.key: cannot be written");
}

TEST_F(SignProgram, MinisignVerifiesOurSignatures) {
    make_keys();
    const Outcome done = pack("sign vase.fspack --key house.key --serial 17");
    expect_done(done);
    EXPECT_NE(done.out.find("serial 17"), std::string::npos) << done.out;
    const Outcome verified = minisign_verifies("vase.fspack", "-H -p house.pub");
    expect_done(verified);
    EXPECT_NE(verified.out.find("Trusted comment: serial:17\tfile:vase.fspack\thashed"), std::string::npos)
        << verified.out;
    EXPECT_NE(minisign_verifies("vase.fspack", "-p stranger.pub").status, 0);
    expect_done(run("echo >> m && ! minisign -V -m m -x m.minisig -p house.pub"));
}

TEST_F(SignProgram, VerifiesMinisignSignatures) {
    expect_done(run("minisign -G -W -p curator.pub -s curator.key"));
    const Bytes plain = samples::bytes_of(samples::pack());
    ASSERT_TRUE(write_file(folder / "m", testing::manifest_of(plain)));
    for (const std::string options : {"", "-l", "-t 'serial:5 of today'"}) {
        expect_done(run("minisign -S -s curator.key -m m " + options));
        const Bytes with = with_signature(plain, text("m.minisig")).value();
        ASSERT_TRUE(write_file(folder / "theirs.fspack", with));
        const nlohmann::json json = verified("theirs.fspack --key curator.pub");
        EXPECT_EQ(json[0]["signed"], true) << json;
        EXPECT_EQ(json[0]["key"], "curator");
    }
    EXPECT_EQ(verified("theirs.fspack --key curator.pub")[0]["serial"], 5);
}

TEST_F(SignProgram, SharesKeysWithMinisign) {
    make_keys();
    expect_done(run("minisign -S -s house.key -m house.pub && minisign -V -m house.pub -p house.pub"));
    expect_done(run("minisign -R -s house.key -p again.pub && cmp house.pub again.pub"));
    expect_done(run("minisign -G -W -p curator.pub -s curator.key"));
    expect_done(pack("sign vase.fspack --key curator.key"));
    expect_done(minisign_verifies("vase.fspack", "-p curator.pub"));
    expect_done(pack("verify vase.fspack --key house.pub --key curator.pub"));
}

TEST_F(SignProgram, PromptsTwiceForAHiddenPassword) {
    const auto [twice_different, shown] = on_terminal("keygen -o secret", "one\nanother\n");
    EXPECT_EQ(twice_different, 1) << shown;
    EXPECT_NE(shown.find("[password.different]"), std::string::npos) << shown;
    EXPECT_EQ(shown.find("another"), std::string::npos) << "the password is on the screen: " << shown;
    EXPECT_FALSE(fs::exists(folder / "secret.key"));

    const auto [made, said] = on_terminal("keygen -o secret", "sesame\nsesame\n");
    ASSERT_EQ(made, 0) << said;
    EXPECT_EQ(said.find("sesame"), std::string::npos) << said;
    EXPECT_NE(said.find("encrypted with your password"), std::string::npos) << said;
    expect_done(run("printf 'sesame\\n' | minisign -S -s secret.key -m vase.fspack"));

    expect_failed(pack("sign vase.fspack --key secret.key"), "[password.none]");
    const auto [done, asked] = on_terminal("sign vase.fspack --key secret.key", "sesame\n");
    EXPECT_EQ(done, 0) << asked;
    EXPECT_NE(asked.find("Password of secret.key: "), std::string::npos) << asked;
    expect_done(minisign_verifies("vase.fspack", "-p secret.pub"));
}

TEST_F(SignProgram, VerifyNamesTheSigner) {
    make_keys();
    EXPECT_EQ(verified("vase.fspack")[0]["signed"], false);
    expect_failed(pack("verify vase.fspack --key house.pub"), "vase.fspack: it is not signed");
    expect_done(pack("sign vase.fspack --key house.key --serial 3"));
    const Outcome unchecked = pack("verify vase.fspack");
    expect_done(unchecked);
    EXPECT_NE(unchecked.out.find("serial 3, not checked"), std::string::npos) << unchecked.out;
    const Outcome checked = pack("verify vase.fspack --key stranger.pub --key house.pub");
    expect_done(checked);
    EXPECT_NE(checked.out.find("intact, signed by house, serial 3"), std::string::npos) << checked.out;
    const nlohmann::json json = verified("vase.fspack --key house.pub")[0];
    EXPECT_EQ(json["sound"], true);
    EXPECT_EQ(json["signed"], true);
    EXPECT_EQ(json["checked"], true);
    EXPECT_EQ(json["key"], "house");
    EXPECT_EQ(json["serial"], 3);
    EXPECT_EQ(json["trusted_comment"], "serial:3\tfile:vase.fspack\thashed");
    expect_failed(pack("verify vase.fspack --key stranger.pub"), "not one of those known here (stranger)");
    EXPECT_EQ(verified("vase.fspack --key stranger.pub")[0]["signed"], false);
    EXPECT_NE(pack("list vase.fspack").out.find("serial 3, not checked"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(pack("explain vase.fspack --json").out)["serial"], 3);
    expect_failed(pack("verify vase.fspack --key vase.fspack"), "vase.fspack: ");
}

TEST_F(SignProgram, LowersASerialOnlyIfRequested) {
    make_keys();
    expect_done(pack("sign vase.fspack --key house.key"));
    const auto now = static_cast<std::uint64_t>(std::time(nullptr));
    const auto serial = verified("vase.fspack --key house.pub")[0]["serial"].get<std::uint64_t>();
    EXPECT_LE(serial, now);
    EXPECT_GT(serial + 600, now);
    expect_done(pack("sign vase.fspack --key house.key --serial 99999999999"));
    const std::string before = text("vase.fspack");
    expect_failed(pack("sign vase.fspack --key house.key"),
                  "vase.fspack: its signature has the serial 99999999999 already");
    EXPECT_EQ(text("vase.fspack"), before);
    expect_done(pack("sign vase.fspack --key house.key --serial 12"));
    EXPECT_EQ(verified("vase.fspack --key house.pub")[0]["serial"], 12);
    for (const char* wrong : {"0", "-1", "x", "9007199254740992"}) {
        EXPECT_EQ(pack(fmt::format("sign vase.fspack --key house.key --serial {}", wrong)).status, 2)
            << wrong;
    }
}

TEST_F(SignProgram, SignsSeveralPacksAndLeavesADamagedOneUnchanged) {
    make_keys();
    samples::Entries entries = samples::take_apart(samples::bytes_of(samples::pack()));
    entries.parts[0].second[0] ^= std::byte{1};
    const Bytes broken = samples::put_together(entries);
    ASSERT_TRUE(write_file(folder / "broken.fspack", broken));
    fs::copy_file(folder / "vase.fspack", folder / "bowl.fspack");
    const Outcome outcome = pack("sign vase.fspack broken.fspack bowl.fspack --key house.key --json");
    expect_failed(outcome, "broken.fspack: ");
    const nlohmann::json json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json[0]["signed"], true);
    EXPECT_EQ(json[1]["signed"], false);
    EXPECT_EQ(json[2]["file"], "bowl.fspack");
    expect_done(pack("verify vase.fspack bowl.fspack --key house.pub"));
    EXPECT_EQ(text("broken.fspack"), as_text(broken));
    expect_failed(pack("sign vase.fspack --key house.pub"), "house.pub: this is not a minisign secret key");
    expect_failed(pack("sign house.pub --key house.key"), "house.pub: this is not a pack");
}

TEST_F(SignProgram, WritesTheSignatureBesideASetFile) {
    make_keys();
    put("exhibit.toml", "order = [\"vase\"]\n");
    expect_done(pack("sign exhibit.toml --key house.key --serial 8"));
    EXPECT_EQ(text("exhibit.toml"), "order = [\"vase\"]\n");
    const Outcome verified = run("minisign -V -m exhibit.toml -p house.pub");
    expect_done(verified);
    EXPECT_NE(verified.out.find("serial:8\tfile:exhibit.toml"), std::string::npos) << verified.out;
    expect_done(pack("sign exhibit.toml --key house.key"));
    expect_done(pack("sign exhibit.toml --key house.key --serial 99999999999"));
    expect_failed(pack("sign exhibit.toml --key house.key"), "exhibit.toml: its signature has the serial");
}

TEST_F(SignProgram, RejectsAnInvalidSetFile) {
    make_keys();
    put("exhibit.toml", "order = [\"vase\"]\nonyl = true\n");
    expect_failed(pack("sign exhibit.toml --key house.key"), "frustumscreen-pack: exhibit.toml:2: ");
    fs::create_directories(folder / "more");
    fs::copy_file(folder / "exhibit.toml", folder / "more/exhibit.toml");
    expect_failed(pack("sign more/exhibit.toml --key house.key"),
                  "frustumscreen-pack: more/exhibit.toml:2: ");
    put("exhibit.toml", std::string(70000, '#'));
    expect_failed(pack("sign exhibit.toml --key house.key"), "65536");
    EXPECT_FALSE(std::filesystem::exists(folder / "exhibit.toml.minisig"));
}

TEST_F(SignProgram, ListsTheCommandsForAnUnknownOne) {
    const Outcome mistyped = pack("verfy vase.fspack");
    EXPECT_EQ(mistyped.status, 2);
    EXPECT_EQ(mistyped.error,
              "frustumscreen-pack: unknown command 'verfy'; the commands are verify, list, explain, preview, "
              "keygen, sign; frustumscreen-pack --help says more\n");
    EXPECT_NE(pack("").error.find("a command is missing; the commands are verify"), std::string::npos);
}

} // namespace
} // namespace frustumscreen::pack
