// The thread that keeps two eyes' pictures in turn, with a card that refreshes only when a flip is queued: nothing depends on the
// machine's speed.
#include "firmware_host/display/eye_thread.h"
#include "tests/base/comes_true.h"
#include "tests/display/fake_kms.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <deque>

namespace frustumscreen::display {
namespace {

constexpr Nanoseconds turn{8'333'333};
constexpr Nanoseconds long_wait = std::chrono::seconds(60);

/// The file of a card, readable while an event waits there.
class EventFile {
public:
    EventFile() { EXPECT_EQ(::pipe(ends_.data()), 0); }
    ~EventFile() {
        ::close(ends_[0]);
        ::close(ends_[1]);
    }
    EventFile(const EventFile&) = delete;
    EventFile& operator=(const EventFile&) = delete;
    void put() const { EXPECT_EQ(::write(ends_[1], "x", 1), 1); }
    void take() const {
        char byte = 0;
        EXPECT_EQ(::read(ends_[0], &byte, 1), 1);
    }
    [[nodiscard]] int number() const { return ends_[0]; }

private:
    std::array<int, 2> ends_{};
};

struct Shot {
    std::uint32_t refresh = 0;
    FramebufferId framebuffer = 0;
    int first_row = 0;
};

/// Its flips take effect, and are reported, as soon as they are queued; each time one refresh passes.
class ObedientCard final : public KmsDevice {
public:
    ObedientCard(const EventFile& file, std::vector<Shot>& shots) : file_(file), shots_(shots) {}
    KmsAnswer light(std::uint32_t, const ModeTiming&, const ScannedOut& shown,
                    std::uint64_t ticket) override {
        return flip_from(0, shown.framebuffer, ticket);
    }
    KmsAnswer flip(FramebufferId shown, std::uint64_t ticket) override { return flip_from(0, shown, ticket); }
    KmsAnswer flip_from(int first_row, FramebufferId shown, std::uint64_t ticket) override {
        ++refresh_;
        shots_.push_back({refresh_, shown, first_row});
        events_.push_back({.time = MonotonicTime(refresh_ * turn), .ticket = ticket, .refresh = refresh_});
        file_.put();
        return KmsAnswer::Done;
    }
    KmsAnswer darken() override { return KmsAnswer::Done; }
    bool become_master() override { return true; }
    std::optional<Flipped> wait_flip(Nanoseconds) override {
        if (events_.empty()) {
            return std::nullopt;
        }
        file_.take();
        const Flipped first = events_.front();
        events_.pop_front();
        return first;
    }
    [[nodiscard]] bool flips_keep_time() const override { return true; }
    [[nodiscard]] MonotonicTime now() const override {
        return MonotonicTime(refresh_ * turn) + std::chrono::microseconds(50);
    }

private:
    const EventFile& file_;
    std::vector<Shot>& shots_;
    std::deque<Flipped> events_;
    std::uint32_t refresh_ = 6;
};

class EyeThreadTest : public testing::Test {
protected:
    void make() { thread_.emplace(std::make_unique<ObedientCard>(file_, shots_), file_.number()); }
    void show(FramebufferId picture) {
        ASSERT_EQ(thread_->flip(picture, picture), KmsAnswer::Done);
        const std::optional<Flipped> shown = thread_->wait_flip(long_wait);
        ASSERT_TRUE(shown);
        EXPECT_EQ(shown->ticket, picture);
        EXPECT_EQ(shown->answer, KmsAnswer::Done);
    }
    void light(FramebufferId picture) {
        ASSERT_EQ(
            thread_->light(1, a_mode(320, 200, 120.0), {picture, {320, 200}, {0, 0, 320, 200}}, picture),
            KmsAnswer::Done);
        ASSERT_TRUE(thread_->wait_flip(long_wait));
    }

    EventFile file_;
    std::vector<Shot> shots_; ///< of the thread, until it has ended
    std::optional<EyeThread> thread_;
};

TEST_F(EyeThreadTest, ShowsEachPictureAndAlternatesTheEyes) {
    make();
    light(1);
    for (FramebufferId picture = 2; picture < 500; ++picture) {
        show(picture);
    }
    EXPECT_TRUE(thread_->in_turn());
    thread_.reset();
    FramebufferId newest = 1;
    ASSERT_GT(shots_.size(), 498U);
    for (std::size_t k = 1; k < shots_.size(); ++k) {
        EXPECT_EQ(shots_[k].first_row, shots_[k].refresh % 2 == 0 ? 0 : 200) << k;
        EXPECT_GE(shots_[k].framebuffer, newest);
        EXPECT_LE(shots_[k].framebuffer, newest + 1);
        newest = shots_[k].framebuffer;
    }
    EXPECT_EQ(newest, 499U);
}

TEST_F(EyeThreadTest, FlipsNothingBeforeLightingAndAfterDarkening) {
    make();
    EXPECT_FALSE(thread_->wait_flip(std::chrono::milliseconds(20)));
    light(1);
    show(2);
    EXPECT_EQ(thread_->darken(), KmsAnswer::Done);
    EXPECT_FALSE(thread_->wait_flip(std::chrono::milliseconds(20)));
    EXPECT_TRUE(comes_true([&] {
        const std::optional<MonotonicTime> alive = thread_->alive_until();
        return alive && *alive > monotonic_now();
    }));
    thread_.reset();
    ASSERT_FALSE(shots_.empty());
    EXPECT_EQ(shots_.back().framebuffer, 2U);
}

} // namespace
} // namespace frustumscreen::display
