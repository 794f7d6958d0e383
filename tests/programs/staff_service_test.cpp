// The exhibit's answers to the staff over the socket, from a picture that another thread presents.

#include "app/programs/frustumscreen/staff_service.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/base/comes_true.h"
#include "tests/base/temporary_folder.h"

#include <GLES3/gl31.h>
#include <gtest/gtest.h>

#include <fstream>
#include <future>

namespace frustumscreen::programs {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;

constexpr int width = 32, height = 16;

std::size_t open_descriptors() {
    const fs::directory_iterator all("/proc/self/fd");
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

class StaffService : public WithTemporaryFolder {
protected:
    void SetUp() override {
        path = folder / "s";
        ::unsetenv("JOURNAL_STREAM");
    }
    /// Opens the socket; the journal's text goes to `said`.
    [[nodiscard]] std::unique_ptr<service::StaffSocket> opened(const fs::path& at) {
        ::testing::internal::CaptureStderr();
        std::unique_ptr<service::StaffSocket> socket =
            open_staff_socket(at, screenshot, service::Journal("test"));
        said = ::testing::internal::GetCapturedStderr();
        return socket;
    }
    /// The socket's answer to a question.
    [[nodiscard]] Result<Bytes> asked(std::string_view question) const {
        return service::ask_staff_socket(path, question, std::size_t{1} << 20, seconds(60));
    }

    fs::path path;
    show::Screenshot screenshot{width, height};
    std::string said;
};

TEST_F(StaffService, ReturnsThePresentedPicture) {
    const auto display = display::SurfacelessDisplay::create(width, height);
    ASSERT_TRUE(display) << display.error().message;
    glBindFramebuffer(GL_FRAMEBUFFER, (*display)->framebuffer());
    glClearColor(1.0F, 0.0F, 1.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    ASSERT_TRUE((*display)->present(monotonic_now()));
    const auto socket = opened(path);
    ASSERT_NE(socket, nullptr);
    EXPECT_EQ(said, "");
    std::future<Result<Bytes>> answer = std::async(std::launch::async, [this] {
        Result<Bytes> got = Bytes();
        static_cast<void>(comes_true([&] { // a pause on either side costs a question its answer
            got = ask_for_screenshot(path);
            return got.has_value();
        }));
        return got;
    });
    while (answer.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
        screenshot.serve(**display);
    }
    const Result<Bytes> png = answer.get();
    ASSERT_TRUE(png) << png.error().message;
    const Result<image::Image8> picture = image::decode_png8(*png);
    ASSERT_TRUE(picture) << picture.error().message;
    EXPECT_EQ(picture->width, width);
    EXPECT_EQ(picture->height, height);
    for (const glm::u8vec4& texel : picture->texels) {
        ASSERT_EQ(texel, glm::u8vec4(255, 0, 255, 255));
    }
}

TEST_F(StaffService, RefusesEveryOtherQuestion) {
    const auto socket = opened(path);
    ASSERT_NE(socket, nullptr);
    for (const std::string_view question : {"", "Screenshot", "screenshot ", "reboot", "\x1b[2J"}) {
        const Result<Bytes> answer = asked(question);
        ASSERT_FALSE(answer) << question;
        EXPECT_EQ(answer.error().id, "staff.exhibit_says") << answer.error().message;
        EXPECT_EQ(answer.error().message.find('\x1b'), std::string::npos) << "it goes to a terminal";
        EXPECT_NE(answer.error().message.find("'screenshot'"), std::string::npos) << answer.error().message;
    }
}

TEST_F(StaffService, ReportsThatNoPictureIsPresented) {
    const auto socket = opened(path); // no thread presents a picture
    ASSERT_NE(socket, nullptr);
    for (int k = 0; k < 2; ++k) {
        const Result<Bytes> answer = ask_for_screenshot(path);
        ASSERT_FALSE(answer);
        EXPECT_EQ(answer.error().id, "staff.exhibit_says") << answer.error().message;
    }
}

TEST_F(StaffService, OpensNoSocketWithoutAPath) {
    EXPECT_EQ(opened({}), nullptr);
    EXPECT_EQ(said, "");
}

TEST_F(StaffService, LogsASocketThatCannotBeCreated) {
    std::ofstream(folder / "file") << "kept";
    for (const fs::path& at :
         {folder / "none" / "s", folder / "file", folder, folder / std::string(200, 'x')}) {
        EXPECT_EQ(opened(at), nullptr) << at;
        EXPECT_NE(said.find(at.string() + ": the staff's socket cannot be made"), std::string::npos) << said;
    }
    EXPECT_TRUE(fs::is_regular_file(folder / "file"));
}

TEST_F(StaffService, AnotherExhibitKeepsItsSocket) {
    auto first = opened(path);
    ASSERT_NE(first, nullptr);
    EXPECT_EQ(opened(path), nullptr);
    EXPECT_NE(said.find("another exhibit listens there"), std::string::npos) << said;
    EXPECT_FALSE(asked("who")); // the first socket answers
    first.reset();
    EXPECT_NE(opened(path), nullptr) << said;
}

TEST_F(StaffService, ClosesWithoutLeaksWhileAQuestionIsPending) {
    const std::size_t before = open_descriptors();
    auto socket = opened(path);
    ASSERT_NE(socket, nullptr);
    std::future<Result<Bytes>> answer =
        std::async(std::launch::async, [this] { return ask_for_screenshot(path); });
    std::this_thread::sleep_for(std::chrono::milliseconds(100)); // the request has usually arrived by then
    socket.reset();
    EXPECT_FALSE(answer.get());
    EXPECT_FALSE(fs::exists(path));
    EXPECT_EQ(open_descriptors(), before);
    EXPECT_FALSE(ask_for_screenshot(path));
}

} // namespace
} // namespace frustumscreen::programs
