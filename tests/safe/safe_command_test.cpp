// `frustumscreen-safe` from outside: its linked libraries, its pictures, its messages to a service manager.
#include "app/image/image.h"
#include "firmware_host/base/run_program.h"
#include "tests/base/temporary_folder.h"
#include "tests/folders.h"
#include "tests/service/notify_socket.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <sstream>

namespace frustumscreen::safe {
namespace {

namespace fs = std::filesystem;

const std::string program = bin_dir() + "/frustumscreen-safe";

class SafeCommand : public WithTemporaryFolder {
protected:
    ProgramEnd run(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), program);
        ProgramLimits limits;
        limits.complaint_bytes = 2000;
        Result<ProgramEnd> end = follow_program(arguments, "", limits);
        EXPECT_TRUE(end);
        return *std::move(end);
    }
    image::Image8 picture(std::vector<std::string> arguments) {
        const fs::path png = folder / "out.png";
        arguments.insert(arguments.end(), {"--png", png.string()});
        const ProgramEnd end = run(std::move(arguments));
        EXPECT_EQ(end.status, 0) << end.complaint;
        const Result<Bytes> bytes = read_file(png);
        const Result<image::Image8> read =
            bytes ? image::decode_png8(*bytes) : bad_input("test.refusal", "nothing was written");
        EXPECT_TRUE(read);
        return read.value_or(image::Image8(1, 1));
    }
    std::string write(const std::string& name, const std::string& text) {
        put(name, text);
        return folder / name;
    }
};

TEST_F(SafeCommand, IsLinkedWithoutLibrariesThatMayHaveFailed) {
    const Result<Bytes> listed = run_program({"ldd", program}, "");
    ASSERT_TRUE(listed) << listed.error().message;
    const std::string libraries(as_text(*listed));
    EXPECT_NE(libraries.find("libdrm.so"), std::string::npos) << libraries;
    for (const std::string library :
         {"libEGL", "libGL", "libgbm", "libusb", "libhidapi", "libudev", "libgpiod", "libevdev", "libasound",
          "libopus", "libminizip", "libsodium", "libtomlplusplus", "libwebp", "libfreetype", "libfontconfig",
          "libpango"}) {
        EXPECT_EQ(libraries.find(library), std::string::npos) << library;
    }
}

/// An unstripped program contains the names of its functions; this holds for the exhibit and for this
/// program.
TEST_F(SafeCommand, HasNoReaderOfPacksOrSettings) {
    const std::string exhibit = text_of(bin_dir() + "/frustumscreen");
    const std::string safe = text_of(program);
    ASSERT_GT(safe.size(), 1000U);
    EXPECT_NE(safe.find("lay_out_safe_page"), std::string::npos);
    for (const std::string name : {"load_pack", "load_settings", "decode_glyph_runs", "parse_manifest"}) {
        EXPECT_EQ(safe.find(name), std::string::npos) << name;
    }
    EXPECT_NE(exhibit.find("load_pack"), std::string::npos);
    EXPECT_NE(exhibit.find("load_settings"), std::string::npos);
}

TEST_F(SafeCommand, DrawsAnySizeDeterministically) {
    const image::Image8 landscape = picture({"--size", "1280x800"});
    EXPECT_EQ(landscape.width, 1280);
    EXPECT_EQ(landscape.height, 800);
    EXPECT_EQ(picture({"--size", "1280x800"}).texels, landscape.texels);
    EXPECT_EQ(landscape.at(0, 0), glm::u8vec4(0, 0, 0, 255));
    const image::Image8 portrait = picture({"--size", "800x1280"});
    EXPECT_EQ(portrait.height, 1280);
    EXPECT_NE(picture({"--size", "1280x800", "--language", "ja"}).texels, landscape.texels);
}

TEST_F(SafeCommand, ShowsTheReasonAndToleratesAnUnreadableOne) {
    const auto with = [&](const std::string& reason) {
        return picture({"--size", "640x400", "--reason", reason}).texels;
    };
    const auto without = picture({"--size", "640x400"}).texels;
    EXPECT_EQ(with(folder / "missing"), without);
    EXPECT_EQ(with(folder), without) << "a folder";
    EXPECT_EQ(with("/dev/zero"), without) << "no file of text";
    EXPECT_EQ(with(write("empty", "")), without);
    EXPECT_EQ(with(write("same", "No reason was given.\nA second line")), without);
    EXPECT_NE(with(write("other", "The disk is full.\n")), without);
    EXPECT_NE(with(write("accents", "Die Festplatte ist völlig überfüllt – Größe 0.\n")), without);
    EXPECT_NE(with(write("large", std::string(1 << 20, 'x'))), without);
    EXPECT_NE(with(write("binary", std::string("\xFF\0\x1B[2J", 6))), without);
    EXPECT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
    EXPECT_EQ(with(folder / "fifo"), without) << "nobody writes into it";
}

/// Each half of a stereo picture has all words, shrunk: each pixel is between the two that fall on it.
TEST_F(SafeCommand, ShowsAllWordsToEachEyeOfAStereoProjector) {
    const auto with = [&](const std::string& layout) {
        return picture({"--size", "640x400", "--stereo", write("stereo.txt", layout)});
    };
    const image::Image8 whole = picture({"--size", "640x400"});
    for (const char* layout :
         {"off\n", "anaglyph\n", "frame_sequential\n", "", "sideways", "side_by_sides\n"}) {
        EXPECT_EQ(with(layout).texels, whole.texels) << layout;
    }
    EXPECT_EQ(picture({"--size", "640x400", "--stereo", folder / "missing"}).texels, whole.texels);
    const image::Image8 beside = with("side_by_side\n"), below = with("top_bottom");
    int lit = 0;
    for (int y = 0; y < 400; ++y) {
        for (int x = 0; x < 320; ++x) {
            const auto [low, high] = std::minmax(whole.at(2 * x, y).r, whole.at(2 * x + 1, y).r);
            const int seen = beside.at(x, y).r;
            ASSERT_TRUE(seen >= low && seen <= high) << x << ' ' << y;
            ASSERT_EQ(beside.at(x + 320, y), beside.at(x, y));
            lit += seen > 100 ? 1 : 0;
        }
    }
    EXPECT_GT(lit, 500);
    lit = 0;
    for (int y = 0; y < 200; ++y) {
        for (int x = 0; x < 640; ++x) {
            const auto [low, high] = std::minmax(whole.at(x, 2 * y).r, whole.at(x, 2 * y + 1).r);
            const int seen = below.at(x, y).r;
            ASSERT_TRUE(seen >= low && seen <= high) << x << ' ' << y;
            ASSERT_EQ(below.at(x, y + 200), below.at(x, y));
            lit += seen > 100 ? 1 : 0;
        }
    }
    EXPECT_GT(lit, 500);
}

TEST_F(SafeCommand, RejectsInvalidArguments) {
    for (const std::string size : {"1280", "1280x", "1280x800x2", "0x0", "100000x100", "axb", "-5x800"}) {
        const ProgramEnd end = run({"--png", folder / "out.png", "--size", size});
        EXPECT_EQ(end.status, 2) << size;
        EXPECT_NE(end.complaint.find("1280x800"), std::string::npos) << end.complaint;
    }
    EXPECT_EQ(run({"--size", "1280x800"}).status, 2) << "a size without a picture";
    EXPECT_EQ(run({"--png", folder / "out.png", "--language", "tlh"}).status, 2);
    const ProgramEnd end = run({"--png", folder / "nowhere" / "out.png"});
    EXPECT_EQ(end.status, 1);
    EXPECT_NE(end.complaint.find("nowhere"), std::string::npos) << end.complaint;
    EXPECT_EQ(run({"--help"}).status, 0);
    EXPECT_EQ(as_text(run({"--version"}).output).substr(0, 19), "frustumscreen-safe ");
}

/// Without a graphics card it waits for one: it reports ready, feeds the watchdog, and is small.
TEST_F(SafeCommand, WaitsForACardUnderAServiceManagerUntilItIsStopped) {
    const service::NotifySocket socket;
    ASSERT_TRUE(socket.bound());
    const std::string alive = folder / "alive";
    const pid_t process = ::fork();
    ASSERT_GE(process, 0);
    if (process == 0) {
        ::setenv("NOTIFY_SOCKET", socket.path().c_str(), 1);
        std::freopen("/dev/null", "w", stderr);
        ::execl(program.c_str(), program.c_str(), "--card", "/dev/dri/none", "--alive", alive.c_str(),
                nullptr);
        ::_exit(127);
    }
    bool waits = false;
    bool ready = false;
    int fed = 0;
    for (int k = 0; k < 60 && fed < 2; ++k) {
        const std::string told = socket.receive(1000).value_or("");
        waits = waits || told.find("STATUS=display: /dev/dri/none cannot be opened") == 0;
        ready = ready || told == "READY=1";
        fed += ready && told == "WATCHDOG=1" ? 1 : 0;
    }
    EXPECT_TRUE(waits);
    EXPECT_TRUE(ready);
    EXPECT_EQ(fed, 2);
    EXPECT_FALSE(fs::exists(alive)) << "nothing was shown";
    const std::string memory = text_of("/proc/" + std::to_string(process) + "/status");
    ::kill(process, SIGTERM);
    int status = 0;
    ASSERT_EQ(::waitpid(process, &status, 0), process);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    std::istringstream words(memory.substr(memory.find("VmHWM:") + 6));
    int peak_kb = 0;
    words >> peak_kb;
    EXPECT_GT(peak_kb, 1000);
    EXPECT_LE(peak_kb, 16 * 1024);
#endif
}

} // namespace
} // namespace frustumscreen::safe
