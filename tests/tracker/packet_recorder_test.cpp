#include "firmware_host/tracker/packet_recorder.h"
#include "firmware_host/tracker/packet_replay.h"
#include "firmware_host/tracker/usb_tracker.h"
#include "tests/base/temporary_folder.h"
#include "tests/tracker/wire_bytes.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <thread>

namespace {

/// errno of the disk's flush; 0: success.
std::atomic<int> disk_error{0};

} // namespace

/// Replaces the C library's function for the whole test, because no disk can be unplugged here.
extern "C" int fdatasync(int) {
    errno = disk_error;
    return errno == 0 ? 0 : -1;
}

namespace frustumscreen::tracker {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

class RecorderTest : public WithTemporaryFolder {
protected:
    void TearDown() override { disk_error = 0; }

    struct Contents {
        std::vector<std::uint64_t> numbers; ///< of the received packets
        std::uint64_t dropped = 0;
        std::string about;
        std::size_t left = 0;
    };
    static Contents contents_of(const Bytes& file) {
        Contents contents;
        Result<PacketReader> reader = PacketReader::open(file, "test");
        EXPECT_TRUE(reader);
        while (const std::optional<Packet> packet = reader ? reader->next() : std::nullopt) {
            std::uint64_t number = 0;
            std::memcpy(&number, packet->payload.data(), std::min<std::size_t>(packet->payload.size(), 8));
            if (packet->kind == PacketKind::Received) {
                contents.numbers.push_back(number);
            } else if (packet->kind == PacketKind::Dropped) {
                contents.dropped += number;
            } else {
                contents.about = as_text(packet->payload);
            }
        }
        contents.left = reader ? reader->left() : 0;
        return contents;
    }
    static void put(PacketRecorder& recorder, std::uint64_t number, std::size_t size) {
        std::vector<std::byte> payload(size);
        std::memcpy(payload.data(), &number, sizeof(number));
        recorder.packet(PacketKind::Received, from_microseconds(static_cast<std::int64_t>(number)), payload);
    }
};

TEST_F(RecorderTest, KeepsEveryPacketInOrder) {
    Result<GrowingFile> file = GrowingFile::create(folder / "a");
    ASSERT_TRUE(file);
    PacketRecorder recorder(std::move(*file), "a test", from_microseconds(0));
    for (std::uint64_t k = 0; k < 20'000; ++k) {
        put(recorder, k, 8 + k % 100);
    }
    EXPECT_NE(recorder.state().find("is recorded to"), std::string_view::npos);
    ASSERT_TRUE(recorder.finish());
    EXPECT_EQ(recorder.counts().dropped, 0U);
    const Contents contents = contents_of(*read_file(folder / "a"));
    ASSERT_EQ(contents.numbers.size(), 20'000U);
    EXPECT_TRUE(std::is_sorted(contents.numbers.begin(), contents.numbers.end()));
    EXPECT_EQ(contents.about, "a test");
    EXPECT_EQ(contents.left, 0U);
}

TEST_F(RecorderTest, WritesPacketsToTheFileWhileRecording) {
    Result<GrowingFile> file = GrowingFile::create(folder / "a");
    ASSERT_TRUE(file);
    PacketRecorder recorder(std::move(*file), "", from_microseconds(0));
    put(recorder, 7, 8);
    Contents contents;
    while (contents.numbers.empty()) { // its thread writes with a delay
        std::this_thread::sleep_for(milliseconds(10));
        const Bytes bytes = *read_file(folder / "a");
        contents = bytes.empty() ? Contents() : contents_of(bytes);
    }
    EXPECT_EQ(contents.numbers.front(), 7U);
}

TEST_F(RecorderTest, NeverOverwritesAnExistingFile) {
    WithTemporaryFolder::put("a", "precious");
    EXPECT_EQ(GrowingFile::create(folder / "a")->path(), folder / "a.2");
    EXPECT_EQ(GrowingFile::create(folder / "a")->path(), folder / "a.3");
    EXPECT_EQ(text("a"), "precious");
    const Result<GrowingFile> nowhere = GrowingFile::create(folder / "no" / "a");
    ASSERT_FALSE(nowhere);
    EXPECT_EQ(nowhere.error().id, "file.not_made") << nowhere.error().message;
}

TEST_F(RecorderTest, FullDiskEndsTheRecordingAndIsReported) {
    PacketRecorder recorder(GrowingFile(::open("/dev/full", O_WRONLY | O_CLOEXEC), "stick/a"), "",
                            from_microseconds(0));
    std::uint64_t number = 0;
    while (recorder.state().find("ended") == std::string_view::npos) {
        put(recorder, ++number, 64);
        std::this_thread::sleep_for(milliseconds(1));
    }
    EXPECT_EQ(recorder.state(), "the recording has ended; stick/a: the disk is full");
    for (int k = 0; k < 1000; ++k) {
        put(recorder, ++number, 4096);
    }
    const Result<void> finished = recorder.finish();
    ASSERT_FALSE(finished);
    EXPECT_EQ(finished.error().id, "file.disk_full") << finished.error().message;
}

/// A pipe that acts as a disk: it hangs until the test reads from it.
class HangingDisk {
public:
    HangingDisk() { EXPECT_EQ(::pipe2(ends_.data(), O_CLOEXEC), 0); }
    ~HangingDisk() { ::close(ends_[0]); }
    HangingDisk(const HangingDisk&) = delete;
    HangingDisk& operator=(const HangingDisk&) = delete;
    /// Call once; closing the file ends the wait in `read_back`.
    [[nodiscard]] GrowingFile file() const { return {ends_[1], "slow"}; }
    void go_on() {
        reader_ = std::jthread([this] { read_back_ = everything_from(ends_[0]); });
    }
    [[nodiscard]] const Bytes& read_back() {
        reader_.join();
        return read_back_;
    }

private:
    static Bytes everything_from(int descriptor) {
        Bytes all;
        std::array<std::byte, 65536> block;
        for (ssize_t count = 0; (count = ::read(descriptor, block.data(), block.size())) > 0;) {
            all.insert(all.end(), block.begin(), block.begin() + count);
        }
        return all;
    }

    std::array<int, 2> ends_{};
    Bytes read_back_;
    std::jthread reader_;
};

TEST_F(RecorderTest, RecordsTheGapThatAHangingDiskCauses) {
    HangingDisk disk;
    std::uint64_t number = 0;
    {
        PacketRecorder recorder(disk.file(), "", from_microseconds(0));
        while (recorder.counts().dropped < 100) {
            put(recorder, number++, 4096);
        }
        while (recorder.state().find("too slow") == std::string_view::npos) { // reported while it hangs
            std::this_thread::sleep_for(milliseconds(1));
        }
        EXPECT_EQ(recorder.state(), "the tracker is recorded to slow, but the disk is too slow: 64 or more "
                                    "packets are missing");
        disk.go_on();
        const std::uint64_t before = recorder.counts().packets;
        while (recorder.counts().packets < before + 10) {
            put(recorder, number++, 4096);
            std::this_thread::sleep_for(milliseconds(1));
        }
        EXPECT_TRUE(recorder.finish());
        EXPECT_NE(recorder.state().find("too slow"), std::string_view::npos);
    } // closes the file
    const Contents contents = contents_of(disk.read_back());
    EXPECT_EQ(contents.numbers.size() + contents.dropped, number);
    EXPECT_TRUE(std::is_sorted(contents.numbers.begin(), contents.numbers.end()));
}

TEST_F(RecorderTest, RecordsAGapAtTheEnd) {
    HangingDisk disk;
    std::uint64_t number = 0;
    {
        PacketRecorder recorder(disk.file(), "", from_microseconds(0));
        while (recorder.counts().dropped < 100) {
            put(recorder, number++, 4096);
        }
        disk.go_on();
        EXPECT_TRUE(recorder.finish());
    } // closes the file
    const Contents contents = contents_of(disk.read_back());
    EXPECT_EQ(contents.numbers.size() + contents.dropped, number);
    EXPECT_GE(contents.dropped, 100U);
}

TEST_F(RecorderTest, FailedFlushEndsTheRecording) {
    for (const auto& [error, words] :
         {std::pair{EIO, "cannot be written: Input/output error"}, std::pair{ENOSPC, "the disk is full"}}) {
        disk_error = error;
        Result<GrowingFile> file = GrowingFile::create(folder / "a");
        ASSERT_TRUE(file);
        const std::string path = file->path();
        PacketRecorder recorder(std::move(*file), "", from_microseconds(0));
        while (recorder.state().find("ended") == std::string_view::npos) {
            std::this_thread::sleep_for(milliseconds(1));
        }
        EXPECT_EQ(recorder.state(), "the recording has ended; " + path + ": " + words);
        EXPECT_FALSE(recorder.finish());
    }
}

TEST_F(RecorderTest, FinishReportsAFailedFlush) {
    Result<GrowingFile> file = GrowingFile::create(folder / "a");
    ASSERT_TRUE(file);
    PacketRecorder recorder(std::move(*file), "", from_microseconds(0));
    disk_error = EIO; // long before the first second has passed
    const Result<void> finished = recorder.finish();
    ASSERT_FALSE(finished);
    EXPECT_EQ(finished.error().id, "file.not_grown") << finished.error().message;
}

TEST_F(RecorderTest, IgnoresPacketsAfterFinish) {
    Result<GrowingFile> file = GrowingFile::create(folder / "a");
    ASSERT_TRUE(file);
    PacketRecorder recorder(std::move(*file), "", from_microseconds(0));
    put(recorder, 1, 8);
    ASSERT_TRUE(recorder.finish());
    const std::uint64_t packets = recorder.counts().packets;
    put(recorder, 2, 8);
    EXPECT_EQ(recorder.counts().packets, packets);
    EXPECT_EQ(contents_of(*read_file(folder / "a")).numbers, std::vector<std::uint64_t>{1});
}

/// A HID tracker that streams on the machine's real clock.
class StreamingTransport final : public UsbTransport {
public:
    [[nodiscard]] Result<std::size_t> read(std::span<std::byte> buffer, Nanoseconds) override {
        std::this_thread::sleep_for(std::chrono::microseconds(500));
        wire::HidPose pose;
        pose.counter = counter_++;
        pose.time_us = 500 * pose.counter;
        const wire::Wire report = counter_ == 1 ? wire::hid_info() : wire::hid_pose(pose);
        std::copy(report.begin(), report.end(), buffer.begin());
        return report.size();
    }
    [[nodiscard]] Result<void> write(std::span<const std::byte>, Nanoseconds) override { return {}; }
    void close() override {}

private:
    std::uint32_t counter_ = 0;
};
class StreamingBus final : public UsbBus {
public:
    [[nodiscard]] tl::expected<FoundTracker, UsbTrackerState>
    find(std::span<const std::string> /*but_not*/) override {
        return FoundTracker{std::make_unique<StreamingTransport>(), UsbTrackerModel::Hid, {}};
    }
};

TEST_F(RecorderTest, RecordsAllPolledSamplesOfARunningTracker) {
    std::vector<PoseSample> polled;
    {
        Result<GrowingFile> file = GrowingFile::create(folder / "a");
        ASSERT_TRUE(file);
        PacketRecorder recorder(std::move(*file), "", monotonic_now());
        UsbTracker tracker(std::make_unique<StreamingBus>(), {}, &recorder);
        while (polled.size() < 300) {
            ASSERT_TRUE(tracker.poll(monotonic_now(), polled));
            std::this_thread::sleep_for(milliseconds(1));
        }
    } // both end as in the exhibit
    Result<PacketReplay> replay = PacketReplay::open(*read_file(folder / "a"), "a");
    ASSERT_TRUE(replay);
    EXPECT_EQ(replay->left_bytes(), 0U);
    std::vector<PoseSample> replayed;
    replay->play(replay->end(), replayed);
    // A poll after a pause of 256 samples misses the oldest, which are recorded all the same.
    auto at = replayed.begin();
    for (std::size_t k = 0; k < polled.size(); ++k) {
        at = std::find_if(at, replayed.end(),
                          [&](const PoseSample& sample) { return sample.time == polled[k].time; });
        ASSERT_NE(at, replayed.end()) << k;
        ASSERT_EQ(polled[k].position_m, at->position_m) << k;
        ++at;
    }
}

} // namespace
} // namespace frustumscreen::tracker
