// The staff's socket: its answers, its access check, and clients that stall, flood, hang up or send invalid
// questions.
#include "firmware_host/service/staff_socket.h"
#include "firmware_host/service/unix_address.h"
#include "tests/base/temporary_folder.h"

#include <grp.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace frustumscreen::service {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;

class StaffSocketTest : public WithTemporaryFolder {
protected:
    void open() {
        Result<std::unique_ptr<StaffSocket>> opened = StaffSocket::open(
            path, [this](std::string_view question, const std::stop_token&) -> Result<Bytes> {
                ++questions;
                if (question == "big") {
                    return Bytes(std::size_t{8} << 20, std::byte{7});
                }
                return question == "hello" ? Result<Bytes>(Bytes{std::byte{42}})
                                           : bad_input("test.refusal", "no\nsuch question");
            });
        ASSERT_TRUE(opened) << opened.error().message;
        server = std::move(*opened);
    }
    [[nodiscard]] Descriptor connected() const {
        Descriptor client(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
        const UnixAddress address = *UnixAddress::of(path);
        EXPECT_EQ(::connect(client.number(), address.get(), address.size()), 0);
        return client;
    }
    /// Everything received until the connection is closed.
    [[nodiscard]] static std::string rest(const Descriptor& client) {
        std::string text;
        char part[4096];
        for (ssize_t got = 0; (got = ::recv(client.number(), part, sizeof part, 0)) > 0;) {
            text.append(part, static_cast<std::size_t>(got));
        }
        return text;
    }
    /// A pause of a second before the question is sent costs it its answer; then it is asked again.
    [[nodiscard]] std::string answer_to(std::string_view sent) const {
        std::string answer;
        do {
            const Descriptor client = connected();
            static_cast<void>(::send(client.number(), sent.data(), sent.size(), MSG_NOSIGNAL));
            answer = rest(client);
        } while (answer == no_question_came);
        return answer;
    }
    [[nodiscard]] bool still_answers() const { return answer_to("hello\n") == "ok 1\n*"; }

    static constexpr std::string_view no_question_came = "no no question came within a second\n";
    fs::path path = folder / "s";
    std::unique_ptr<StaffSocket> server;
    std::atomic<int> questions{0};
};

TEST_F(StaffSocketTest, AnswersQuestionsWithStatusAndLength) {
    open();
    EXPECT_EQ(answer_to("hello\n"), "ok 1\n*");
    EXPECT_EQ(answer_to("what\n"), "no no?such question\n");
    EXPECT_EQ(answer_to("hello\nhello\n"), "ok 1\n*");
    Result<Bytes> asked = Bytes();
    do {
        asked = ask_staff_socket(path, "big", std::size_t{9} << 20, seconds(60));
    } while (!asked && asked.error().message.find("no question came") != std::string::npos);
    ASSERT_TRUE(asked) << asked.error().message;
    EXPECT_EQ(*asked, Bytes(std::size_t{8} << 20, std::byte{7}));
    EXPECT_FALSE(ask_staff_socket(path, "big", std::size_t{7} << 20, seconds(60)));
}

TEST_F(StaffSocketTest, FileIsAccessibleToOwnerAndFolderGroupOnly) {
    constexpr gid_t other_group = 54321;
    const bool may_give = ::chown(folder.c_str(), static_cast<uid_t>(-1), other_group) == 0;
    ASSERT_EQ(::chmod(folder.c_str(), may_give ? 02750 : 0750), 0);
    open();
    struct stat file {};
    ASSERT_EQ(::stat(path.c_str(), &file), 0);
    EXPECT_TRUE(S_ISSOCK(file.st_mode));
    EXPECT_EQ(file.st_mode & 07777U, 0660U);
    if (may_give) {
        EXPECT_EQ(file.st_gid, other_group);
    }
    server.reset();
    EXPECT_FALSE(fs::exists(path));
}

TEST_F(StaffSocketTest, RejectsOtherUsersRegardlessOfTheFileMode) {
    if (::geteuid() != 0) {
        GTEST_SKIP() << "only root can change the user";
    }
    open();
    fs::permissions(folder, fs::perms::all);
    fs::permissions(path, fs::perms::all);
    const auto asked_by = [this](uid_t user, gid_t group) {
        const pid_t child = ::fork();
        if (child == 0) {
            if (::setgroups(0, nullptr) + ::setgid(group) + ::setuid(user) != 0) {
                ::_exit(3);
            }
            const std::string answer = answer_to("hello\n");
            ::_exit(answer == "ok 1\n*" ? 0 : answer.starts_with("no only the staff may ask this") ? 1 : 2);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    };
    EXPECT_EQ(asked_by(65534, 65534), 1);
    EXPECT_EQ(asked_by(65534, ::getegid()), 0); // the file's group
    EXPECT_EQ(questions, 1);
}

TEST(StaffSocket, RootOwnerAndGroupMembersAreStaff) {
    const gid_t groups[] = {7, 8, 900};
    EXPECT_TRUE(is_staff({0, 5, {}}, 100, 900));
    EXPECT_TRUE(is_staff({100, 5, {}}, 100, 900));
    EXPECT_TRUE(is_staff({101, 900, {}}, 100, 900));
    EXPECT_TRUE(is_staff({101, 5, groups}, 100, 900));
    EXPECT_FALSE(is_staff({101, 100, groups}, 100, 901));
}

TEST_F(StaffSocketTest, RejectsMalformedQuestionsWithoutAskingTheHandler) {
    open();
    EXPECT_EQ(answer_to(std::string(64, 'x')), "no a question has at most 64 bytes\n");
    for (const std::string& sent :
         {std::string(1 << 20, 'x'), std::string(100, '\0'), std::string("\xff\xfe")}) {
        const Descriptor client = connected();
        // The rest of a flood is not read: the connection is closed.
        static_cast<void>(::send(client.number(), sent.data(), sent.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
        ::shutdown(client.number(), SHUT_WR);
        EXPECT_FALSE(rest(client).starts_with("ok"));
    }
    EXPECT_EQ(questions, 0);
    EXPECT_TRUE(still_answers());
}

TEST_F(StaffSocketTest, DropsStalledClients) {
    open();
    const Descriptor silent = connected();
    const Descriptor half = connected();
    static_cast<void>(::send(half.number(), "hel", 3, MSG_NOSIGNAL));
    EXPECT_TRUE(still_answers()); // after both clients
    EXPECT_EQ(rest(silent), no_question_came);
    EXPECT_EQ(rest(half), no_question_came);
    const Descriptor deaf = connected(); // requests more than its socket buffer holds, and reads nothing
    static_cast<void>(::send(deaf.number(), "big\n", 4, MSG_NOSIGNAL));
    EXPECT_TRUE(still_answers());
    EXPECT_LT(rest(deaf).size(), std::size_t{8} << 20);
}

TEST_F(StaffSocketTest, SlowClientGetsTheWholeAnswer) {
    open();
    std::vector<char> part(std::size_t{1} << 20);
    std::size_t taken = 0;
    Nanoseconds longest_pause{0};
    Nanoseconds took{0};
    bool asked_late = false;
    do { // again if this thread itself stood still for so long that it was a client that stalls
        const MonotonicTime begun = monotonic_now();
        const Descriptor slow = connected();
        static_cast<void>(::send(slow.number(), "big\n", 4, MSG_NOSIGNAL));
        MonotonicTime latest = monotonic_now();
        asked_late = latest - begun >= StaffSocket::question_within;
        taken = 0;
        longest_pause = Nanoseconds(0);
        const auto take = [&] {
            const ssize_t got = ::recv(slow.number(), part.data(), part.size(), MSG_WAITALL);
            const MonotonicTime now = monotonic_now();
            longest_pause = std::max<Nanoseconds>(longest_pause, now - latest);
            latest = now;
            return got;
        };
        for (ssize_t got = 0; (got = take()) > 0; taken += static_cast<std::size_t>(got)) {
            ::poll(nullptr, 0, 800);
        }
        took = latest - begun;
    } while (asked_late || longest_pause >= StaffSocket::max_stall ||
             took >= StaffSocket::answer_taken_within);
    EXPECT_EQ(taken, (std::size_t{8} << 20) + std::string_view("ok 8388608\n").size());
    EXPECT_GT(took, StaffSocket::max_stall); // or this test shows nothing
}

TEST_F(StaffSocketTest, LimitsTheRateOfConnections) {
    open();
    const MonotonicTime end = monotonic_now() + seconds(1);
    const UnixAddress address = *UnixAddress::of(path);
    int taken = 0;
    while (monotonic_now() < end) {
        const Descriptor client(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
        taken += ::connect(client.number(), address.get(), address.size()) == 0 ? 1 : 0;
        ::poll(nullptr, 0, 1);
    }
    EXPECT_GT(taken, 0);
    EXPECT_LT(taken, 20 + 10); // twenty per second, plus those in the queue
    EXPECT_EQ(questions, 0);
    EXPECT_TRUE(still_answers());
}

TEST_F(StaffSocketTest, ReplacesAStaleSocketButNothingElse) {
    {
        const Descriptor left(::socket(AF_UNIX, SOCK_STREAM, 0));
        const UnixAddress address = *UnixAddress::of(path);
        ASSERT_EQ(::bind(left.number(), address.get(), address.size()), 0);
    }
    ASSERT_TRUE(fs::exists(path));
    open();
    EXPECT_TRUE(still_answers());
    const auto nobody = [](std::string_view, const std::stop_token&) -> Result<Bytes> { return Bytes(); };
    EXPECT_FALSE(StaffSocket::open(path, nobody)); // another exhibit listens there
    EXPECT_TRUE(still_answers());
    const fs::path file = folder / "file";
    std::ofstream(file) << "kept";
    EXPECT_FALSE(StaffSocket::open(file, nobody));
    EXPECT_TRUE(fs::is_regular_file(file));
    EXPECT_FALSE(StaffSocket::open(folder / std::string(200, 'x'), nobody));
    EXPECT_FALSE(StaffSocket::open(folder / "none" / "s", nobody));
}

TEST_F(StaffSocketTest, AskingAHangingExhibitTimesOut) {
    const Descriptor hanging(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const UnixAddress address = *UnixAddress::of(path);
    ASSERT_EQ(::bind(hanging.number(), address.get(), address.size()), 0);
    ASSERT_EQ(::listen(hanging.number(), 4), 0);
    const Result<Bytes> none = ask_staff_socket(path, "hello", 10, std::chrono::milliseconds(300));
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().id, "staff.no_answer") << none.error().message;
}

TEST_F(StaffSocketTest, EndsWhileAClientStalls) {
    open();
    const Descriptor silent = connected();
    server.reset();
    EXPECT_EQ(rest(silent), ""); // closed, before or after it was accepted
}

} // namespace
} // namespace frustumscreen::service
