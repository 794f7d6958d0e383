// The safe picture's access to a graphics card, as far as possible without one.

#include "app/programs/safe/safe_scanout.h"
#include "app/programs/safe/safe_screen.h"
#include "app/programs/safe/show_safe_picture.h"
#include "tests/base/temporary_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

namespace frustumscreen::safe {
namespace {

namespace fs = std::filesystem;

std::size_t open_descriptors() {
    const fs::directory_iterator all("/proc/self/fd");
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

class SafeScreenTest : public WithTemporaryFolder {
protected:
    void TearDown() override { EXPECT_EQ(open_descriptors(), descriptors); }
    std::size_t descriptors = open_descriptors();
};

TEST_F(SafeScreenTest, NamesAMissingCard) {
    const std::vector<std::pair<std::string, std::string>> cards{
        {"no-such-card", "/dev/dri/no-such-card"}, // by name
        {folder / "none", (folder / "none").string()},
        {folder, folder.string()}};
    for (const auto& [card, named] : cards) {
        const auto screen = programs::SafeScreen::open(card, safe_languages());
        ASSERT_FALSE(screen) << card;
        EXPECT_EQ(screen.error().kind, ErrorKind::DeviceLost) << "it may come";
        EXPECT_EQ(screen.error().message.find("display: " + named + " cannot be opened: "), 0U)
            << screen.error().message;
    }
}

TEST_F(SafeScreenTest, ReportsAFileThatIsNoCard) {
    std::ofstream(folder / "file") << "no card";
    for (const std::string& card : {std::string("/dev/null"), (folder / "file").string()}) {
        const auto screen = programs::SafeScreen::open(card, safe_languages());
        ASSERT_FALSE(screen) << card;
        EXPECT_EQ(screen.error().kind, ErrorKind::DeviceLost);
        EXPECT_NE(screen.error().message.find(card + " has no connectors"), std::string::npos)
            << screen.error().message;
    }
}

TEST_F(SafeScreenTest, ReportsACardWithoutPermission) {
    std::ofstream(folder / "card") << '\n';
    fs::permissions(folder / "card", fs::perms::none);
    const auto opened_by_nobody = [this] {
        constexpr uid_t nobody = 65534;
        if (::geteuid() == 0 && ::setuid(nobody) != 0) {
            ::_exit(2);
        }
        const auto screen = programs::SafeScreen::open(folder / "card", safe_languages());
        ::_exit(!screen && screen.error().kind == ErrorKind::BadConfiguration &&
                        screen.error().message.find("group video") != std::string::npos
                    ? 0
                    : 1);
    };
    EXPECT_EXIT(opened_by_nobody(), ::testing::ExitedWithCode(0), "");
}

TEST_F(SafeScreenTest, ReportsTheSizeOfMemoryThatTheCardRefuses) {
    const int file = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    const programs::SafePicture picture{.languages = safe_languages(), .text = {}};
    const auto scanout = programs::SafeScanout::make(file, {1280, 800}, picture);
    ::close(file);
    ASSERT_FALSE(scanout);
    EXPECT_EQ(scanout.error().kind, ErrorKind::BadConfiguration);
    EXPECT_NE(scanout.error().message.find("1280 x 800"), std::string::npos) << scanout.error().message;
}

TEST_F(SafeScreenTest, ReadsTheReasonsFirst4096BytesOrNothing) {
    const auto with = [this](const std::string& bytes) {
        std::ofstream(folder / "reason", std::ios::binary) << bytes;
        return programs::read_reason(folder / "reason");
    };
    EXPECT_EQ(with("The disk is full.\nMore"), "The disk is full.\nMore");
    EXPECT_EQ(with(""), "");
    EXPECT_EQ(with(std::string("\0\xff", 2)), std::string("\0\xff", 2));
    EXPECT_EQ(with(std::string(1 << 20, 'x')), std::string(4096, 'x'));
    EXPECT_EQ(programs::read_reason({}), "");
    EXPECT_EQ(programs::read_reason(folder), "");
    EXPECT_EQ(programs::read_reason(folder / "none"), "");
    EXPECT_EQ(programs::read_reason("/dev/zero"), "");
    ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
    EXPECT_EQ(programs::read_reason(folder / "fifo"), "") << "nobody writes into it";
    fs::create_symlink(folder / "reason", folder / "link");
    EXPECT_EQ(programs::read_reason(folder / "link"), std::string(4096, 'x'));
}

} // namespace
} // namespace frustumscreen::safe
