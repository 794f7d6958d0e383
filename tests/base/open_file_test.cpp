// Files that are read in pieces.
#include "firmware_host/base/file.h"
#include "firmware_host/base/open_file.h"
#include "tests/base/temporary_folder.h"
#include "tests/base/told.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <atomic>
#include <string>
#include <thread>

using namespace frustumscreen;
namespace fs = std::filesystem;

namespace {

class OpenFileTest : public WithTemporaryFolder {
protected:
    void SetUp() override { put("digits", "0123456789"); }
    [[nodiscard]] std::string refusal(const std::string& name, std::uint64_t limit = 100) const {
        const Result<OpenFile> file = OpenFile::open(folder / name, limit);
        return file ? std::string() : test::told(file.error());
    }
};

} // namespace

TEST_F(OpenFileTest, reads_any_range_inside_the_file) {
    const Result<OpenFile> file = OpenFile::open(folder / "digits", 10);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->bytes(), 10U);
    std::array<std::byte, 3> piece{};
    EXPECT_TRUE(file->read(7, piece));
    EXPECT_EQ(as_text(piece), "789");
    EXPECT_TRUE(file->read(0, piece));
    EXPECT_EQ(as_text(piece), "012");
    EXPECT_FALSE(file->read(8, piece));
    EXPECT_FALSE(file->read(1000, piece));
    EXPECT_TRUE(file->read(10, {}));
}

TEST_F(OpenFileTest, reading_beyond_a_truncated_end_fails) {
    const Result<OpenFile> file = OpenFile::open(folder / "digits", 10);
    ASSERT_TRUE(file);
    fs::resize_file(folder / "digits", 4);
    std::array<std::byte, 3> piece{};
    EXPECT_FALSE(file->read(7, piece));
    EXPECT_TRUE(file->read(1, piece));
}

/// A status file is replaced by another while it is read.
TEST_F(OpenFileTest, reads_whole_files_during_replacement) {
    const std::string names[] = {"0123456789", "01234"};
    std::atomic<bool> over = false;
    std::thread writer([&] {
        for (int k = 0; k < 2000; ++k) {
            static_cast<void>(write_file(folder / "digits", as_bytes(names[k % 2])));
        }
        over = true;
    });
    int cut = 0;
    while (!over) {
        const Result<Bytes> bytes = read_file(folder / "digits");
        cut += bytes && (as_text(*bytes) == names[0] || as_text(*bytes) == names[1]) ? 0 : 1;
    }
    writer.join();
    EXPECT_EQ(cut, 0);
}

TEST_F(OpenFileTest, reports_why_a_file_cannot_be_opened) {
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_NE(refusal("pipe").find("[file.not_regular]"), std::string::npos) << "and does not wait for it";
    EXPECT_NE(refusal(".").find("this is a folder"), std::string::npos);
    EXPECT_NE(refusal("nothing").find("there is no such file"), std::string::npos);
    EXPECT_NE(refusal("digits", 9).find("10 bytes; at most 9 are allowed"), std::string::npos);
}
