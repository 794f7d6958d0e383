#include "firmware_host/service/journal.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

namespace frustumscreen::service {
namespace {

namespace fs = std::filesystem;

TEST(Journal, IsRecognizedByDeviceAndInode) {
    struct stat file {};
    file.st_dev = 9;
    file.st_ino = 1234;
    EXPECT_TRUE(is_journal("9:1234", file));
    for (const char* other : {"9:123", "9:12345", "91:234", "", ":", "nonsense"}) {
        EXPECT_FALSE(is_journal(other, file)) << other;
    }
    EXPECT_FALSE(is_journal(nullptr, file));
}

TEST(Journal, PrintsOneLineToStandardErrorWithoutAJournal) {
    ::unsetenv("JOURNAL_STREAM");
    ::testing::internal::CaptureStderr();
    Journal("frustumscreen").note(LogPriority::Info, "tracker: it runs", {{"DEVICE", "tracker"}});
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "frustumscreen: tracker: it runs\n");
}

TEST(Journal, SurvivesAFullStandardError) {
    ::unsetenv("JOURNAL_STREAM");
    const int before = ::dup(STDERR_FILENO);
    const int full = ::open("/dev/full", O_WRONLY);
    ASSERT_GE(full, 0);
    ::dup2(full, STDERR_FILENO);
    EXPECT_NO_THROW(Journal("frustumscreen").note(LogPriority::Info, "nobody reads this"));
    ::dup2(before, STDERR_FILENO);
    ::close(full);
    ::close(before);
}

/// The journal's end of its socket, at the path built into the library.
class JournalSocket {
public:
    static constexpr const char* path = "/run/systemd/journal/socket";

    JournalSocket() : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
        std::error_code failed;
        if (fs::exists(path, failed)) {
            return; // the machine's own journal: must not be replaced
        }
        fs::create_directories(fs::path(path).parent_path(), failed);
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::strncpy(address.sun_path, path, sizeof address.sun_path - 1);
        bound_ = ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    }
    ~JournalSocket() {
        ::close(socket_);
        if (bound_) {
            ::unlink(path);
        }
    }
    JournalSocket(const JournalSocket&) = delete;
    JournalSocket& operator=(const JournalSocket&) = delete;
    [[nodiscard]] bool bound() const { return bound_; }
    [[nodiscard]] std::string receive() const {
        std::array<char, 8192> text{};
        const ssize_t size = ::recv(socket_, text.data(), text.size(), MSG_DONTWAIT);
        return size < 0 ? "" : std::string(text.data(), static_cast<std::size_t>(size));
    }

private:
    int socket_;
    bool bound_ = false;
};

TEST(Journal, SendsFieldsIfStandardErrorIsTheJournal) {
    const JournalSocket socket;
    if (!socket.bound()) {
        GTEST_SKIP() << "needs a machine without a journal, and the right to stand in for it";
    }
    struct stat file {};
    ASSERT_EQ(::fstat(STDERR_FILENO, &file), 0);
    ::setenv("JOURNAL_STREAM", (std::to_string(file.st_dev) + ":" + std::to_string(file.st_ino)).c_str(), 1);
    const Journal journal("frustumscreen");
    ::unsetenv("JOURNAL_STREAM");
    journal.note(LogPriority::Warning, "tracker: it is gone",
                 {{"DEVICE", "tracker"}, {"STATE", "it is gone"}});
    const std::string entry = socket.receive();
    for (const char* line : {"MESSAGE=tracker: it is gone\n", "PRIORITY=4\n",
                             "SYSLOG_IDENTIFIER=frustumscreen\n", "DEVICE=tracker\n", "STATE=it is gone\n"}) {
        EXPECT_NE(entry.find(line), std::string::npos) << line << " not in:\n" << entry;
    }
    EXPECT_EQ(entry.find("CODE_FILE"), std::string::npos);
    journal.note(LogPriority::Info, std::string(10'000, 'x'), {{"ARTIFACT", "cat"}}); // truncated, without
                                                                                      // harm
    EXPECT_NE(socket.receive().find("ARTIFACT=cat\nMESSAGE=xxx"), std::string::npos);
}

} // namespace
} // namespace frustumscreen::service
