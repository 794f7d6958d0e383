// An exhibit that shows each eye its own picture in turn, on the fake kernel at 120 refreshes a second. The pictures are
// judged by what the fake card scans out, not by what the display's code believes.
#pragma once

#include "firmware_host/display/eye_order.h"
#include "tests/display/fake_desk.h"

#include <cstring>
#include <functional>
#include <random>
#include <string>

namespace frustumscreen::display {

inline constexpr PixelSize eye_size{320, 200};
inline constexpr std::uint64_t turn_us = 8'333; ///< a refresh of 120 Hz

inline OutputRequest wish_for_turns() {
    OutputRequest request;
    request.picture_width = eye_size.width;
    request.picture_height = eye_size.height;
    request.picture_hz = 120.0;
    request.eyes = EyeLayout::InTurn;
    request.fast = true;
    return request;
}

inline std::vector<drmModeModeInfo> fast_modes() {
    return {kernel_mode(320, 200, 60.0, true), kernel_mode(320, 200, 120.0), kernel_mode(256, 192, 120.0)};
}

/// Two framebuffers; the first pixel of each half says which picture it belongs to, and of which eye it is.
class StampedPair final : public ScanoutPair {
public:
    static std::uint32_t stamp(std::uint32_t picture, int eye) {
        return 2 * picture + static_cast<std::uint32_t>(eye);
    }
    static Result<std::unique_ptr<ScanoutPair>> make(int card, PixelSize size, const std::uint32_t& drawn) {
        auto pair = std::make_unique<StampedPair>(drawn);
        pair->size_ = size;
        for (std::optional<DumbBuffer>& buffer : pair->buffers_) {
            buffer = DumbBuffer::create(card, size);
            if (!buffer || !buffer->map()) {
                return fail(ErrorKind::BadConfiguration, "test.device", "the graphics card has no memory");
            }
        }
        return pair;
    }
    explicit StampedPair(const std::uint32_t& drawn) : drawn_(drawn) {}
    [[nodiscard]] PixelSize size() const override { return size_; }
    [[nodiscard]] FramebufferId fill(int which, const PixelRectangle& /*part*/) override {
        const DumbBuffer& buffer = *buffers_.at(static_cast<std::size_t>(which));
        for (const int eye : {0, 1}) {
            const std::uint32_t value = stamp(drawn_, eye);
            const std::size_t row = static_cast<std::size_t>(eye * size_.height / 2) * buffer.stride();
            std::memcpy(buffer.memory().subspan(row).data(), &value, sizeof value);
        }
        return buffer.shown();
    }

private:
    const std::uint32_t& drawn_; ///< the exhibit's newest picture
    PixelSize size_;
    std::array<std::optional<DumbBuffer>, 2> buffers_;
};

/// Takes the place of the thread: a call of the card's file wakes it after `latency`.
class EyesOnTestClock final : public KmsDevice {
public:
    EyesOnTestClock(KmsDevice& device, CardOnDesk& desk, std::function<Nanoseconds()> latency)
        : clock_(device), order_(clock_), desk_(desk), card_(desk.card), latency_(std::move(latency)),
          refreshes_at_(from_microseconds(static_cast<std::int64_t>(card_.time_us + card_.refresh_us))) {
        clock_.time = from_microseconds(static_cast<std::int64_t>(card_.time_us));
    }
    KmsAnswer light(std::uint32_t connector, const ModeTiming& mode, const ScannedOut& shown,
                    std::uint64_t ticket) override {
        return order_.light(connector, mode, shown, ticket);
    }
    KmsAnswer flip(FramebufferId shown, std::uint64_t ticket) override {
        const KmsAnswer answer = order_.flip(shown, ticket);
        accepted = answer == KmsAnswer::Done ? drawn : accepted;
        return answer;
    }
    KmsAnswer darken() override { return order_.darken(); }
    bool become_master() override { return clock_.become_master(); }
    std::optional<Flipped> wait_flip(Nanoseconds at_most) override {
        const MonotonicTime until = now() + at_most;
        hear();
        while (!news_ && now() < until) {
            pass_until(std::min(until, now() + std::chrono::microseconds(500)));
        }
        return std::exchange(news_, std::nullopt);
    }
    [[nodiscard]] bool flips_keep_time() const override { return clock_.flips_keep_time(); }
    [[nodiscard]] bool in_turn() const override { return order_.in_turn(); }
    [[nodiscard]] std::string_view card() const override { return clock_.card(); }
    [[nodiscard]] MonotonicTime now() const override { return clock_.time; }

    /// Refreshes and the thread's turns happen at their times.
    void pass_until(MonotonicTime until) {
        while (true) {
            const MonotonicTime next = std::min(refreshes_at_, wakes_at_);
            if (next > until) {
                clock_.time = std::max(clock_.time, until);
                return;
            }
            clock_.time = std::max(clock_.time, next);
            if (refreshes_at_ <= wakes_at_) {
                card_.refresh();
                if (const auto shown = card_.shown(desk_.hdmi)) {
                    card_.refresh_us = period_us(shown->mode);
                }
                refreshes_at_ =
                    from_microseconds(static_cast<std::int64_t>(card_.time_us + card_.refresh_us));
                wakes_at_ = std::min(wakes_at_, now() + latency_());
            } else {
                order_.turn();
                hear();
                wakes_at_ = std::max(order_.due(), now() + std::chrono::microseconds(100)) + latency_();
            }
        }
    }

    std::uint32_t drawn = 0;    ///< the exhibit's newest picture
    std::uint32_t accepted = 0; ///< the newest picture that was taken to be shown

private:
    /// Takes what the order tells: after a failure, the picture before it is the newest.
    void hear() {
        if (const std::optional<Flipped> shown = order_.next_shown()) {
            confirmed_ = shown->answer == KmsAnswer::Done ? accepted : confirmed_;
            accepted = confirmed_;
            news_ = shown;
        }
    }
    /// The card refreshes at the rate of the mode that it shows.
    [[nodiscard]] static std::uint64_t period_us(const drmModeModeInfo& mode) {
        return std::uint64_t{1'000} * mode.htotal * mode.vtotal / mode.clock;
    }

    OnTestClock clock_;
    EyeOrder order_;
    const CardOnDesk& desk_;
    FakeCard& card_;
    std::function<Nanoseconds()> latency_;
    std::optional<Flipped> news_;
    std::uint32_t confirmed_ = 0; ///< the newest picture that was said to be shown
    MonotonicTime refreshes_at_;
    MonotonicTime wakes_at_ = MonotonicTime::max();
};

/// Judges what the projector receives, refresh by refresh.
class ShownEyes {
public:
    /// `accepted`: the newest picture that was taken to be shown.
    ShownEyes(FakeCard& card, std::uint32_t connector, const std::uint32_t& accepted)
        : card_(card), connector_(connector), accepted_(accepted) {
        card_.refreshed = [this] { look(); };
    }
    ~ShownEyes() { card_.refreshed = nullptr; }
    ShownEyes(const ShownEyes&) = delete;
    ShownEyes& operator=(const ShownEyes&) = delete;

    int kept = 0;     ///< refreshes that a flip reached in time, since both eyes are shown
    int repeated = 0; ///< refreshes without a flip
    int dark = 0;
    int by_card = 0;          ///< flips that took the card longer than to the next refresh
    std::uint32_t newest = 0; ///< the newest picture that was shown
    MonotonicTime newest_at;  ///< since when
    std::string wrongs;

private:
    /// The stamp of one half.
    [[nodiscard]] std::uint32_t stamp_of(std::uint32_t framebuffer, std::uint32_t row) const {
        const std::span<const std::byte> memory = card_.pixels(framebuffer);
        std::uint32_t value = 0;
        std::memcpy(&value, memory.subspan(memory.size() / card_.height(framebuffer) * row).data(),
                    sizeof value);
        return value;
    }
    void wrong(const std::string& what) {
        wrongs +=
            wrongs.size() < 500 ? "refresh " + std::to_string(card_.refreshes) + ": " + what + "; " : "";
    }
    void look() {
        const bool stayed = stamp_ && card_.has(scanned_.framebuffer);
        if (stayed && stamp_of(scanned_.framebuffer, scanned_.first_row) != *stamp_) {
            wrong("a picture changed while it was scanned out");
        }
        const std::uint32_t promised = std::exchange(promised_, accepted_);
        stamp_.reset();
        if (const std::optional<FakeCard::Scanned> scanned = card_.scanned(connector_)) {
            scanned_ = *scanned;
            stamp_ = stamp_of(scanned->framebuffer, scanned->first_row);
            judge(*stamp_ / 2, static_cast<int>(*stamp_ % 2), promised);
        } else {
            ++dark;
        }
    }
    void judge(std::uint32_t picture, int eye, std::uint32_t promised) {
        const std::uint32_t half = card_.height(scanned_.framebuffer) / 2;
        const std::uint32_t other = stamp_of(scanned_.framebuffer, scanned_.first_row == 0 ? half : 0);
        if (other != StampedPair::stamp(picture, 1 - eye)) {
            wrong("the halves are of different pictures");
        }
        if (picture < newest) {
            wrong("an older picture comes again");
        }
        newest_at =
            picture > newest ? from_microseconds(static_cast<std::int64_t>(card_.time_us)) : newest_at;
        newest = picture;
        repeated += scanned_.waited == 0 ? 1 : 0;
        by_card += scanned_.waited > 1 ? 1 : 0;
        begun_ = !scanned_.modeset && (begun_ || eye == 1);
        if (scanned_.waited != 1 || !begun_) {
            return; // the order begins with the right eye's first picture after the mode was set
        }
        ++kept;
        if (static_cast<std::uint32_t>(eye) != card_.refreshes % 2) {
            wrong("the other eye's picture");
        }
        if (picture < promised) {
            wrong("an old picture, though a newer one was there");
        }
    }

    FakeCard& card_;
    std::uint32_t connector_;
    const std::uint32_t& accepted_;
    std::uint32_t promised_ = 0;         ///< the newest picture at the refresh before
    FakeCard::Scanned scanned_;          ///< since the refresh before
    std::optional<std::uint32_t> stamp_; ///< its stamp; nullopt: it was dark
    bool begun_ = false;                 ///< both eyes' pictures are shown
};

inline bool has_words(std::string_view text, std::string_view words) {
    return text.find(words) != std::string_view::npos;
}

/// Presents pictures in both eyes on an open card.
class Sitting {
public:
    Sitting(CardOnDesk& desk, unsigned seed, const OutputRequest& request = wish_for_turns())
        : desk_(desk), random_(seed), card_(KmsCard::open(card_path, request)) {
        desk.card.refresh_us = turn_us;
        desk.card.flips_at_once = false;
        if (!card_) {
            end_ = card_.error().message;
            return;
        }
        kms_ = make_kms_device(*card_);
        clock_.emplace(*kms_, desk, [this] { return latency(); });
        seen_eyes_.emplace(desk.card, desk.hdmi, clock_->accepted);
        presenter_.emplace(
            *clock_, [this](PixelSize size) { return StampedPair::make(card_->file(), size, clock_->drawn); },
            request);
    }

    /// One frame of 60 Hz that draws for `draws`; returns when its picture is said to be lit.
    MonotonicTime frame(Nanoseconds draws = std::chrono::milliseconds(4)) {
        if (!end_.empty()) {
            return {};
        }
        const CardSeen seen = card_->look(!presenter_->lit());
        if (seen != seen_) {
            seen_ = seen;
            presenter_->connected(seen_);
        }
        const MonotonicTime begin = clock_->now();
        clock_->pass_until(begin + draws);
        ++clock_->drawn;
        const Result<MonotonicTime> shown = presenter_->present({0, 0, 320, 400}, true);
        end_ = shown ? "" : shown.error().message;
        clock_->pass_until(presenter_->next_frame(begin, one_refresh));
        return shown.value_or(MonotonicTime{});
    }
    void frames(int count) {
        for (int k = 0; k < count; ++k) {
            frame();
        }
    }
    void sleep(int count) {
        for (int k = 0; k < count && end_.empty(); ++k) {
            const Result<void> dark = presenter_->stay_dark(true);
            end_ = dark ? "" : dark.error().message;
            rest(one_refresh);
        }
    }
    /// Nothing new is drawn.
    void rest(Nanoseconds length) {
        if (clock_) {
            clock_->pass_until(clock_->now() + length);
        }
    }
    void plugged() {
        if (end_.empty()) {
            seen_ = card_->look(true);
            presenter_->connected(seen_);
        }
    }
    /// Whether the next pictures are shown to the eyes in their order, at every refresh.
    [[nodiscard]] bool in_order(int pictures = 60) {
        frames(10);
        const int kept = eyes().kept;
        const std::uint32_t before = desk_.card.refreshes;
        frames(pictures);
        const int refreshes = static_cast<int>(desk_.card.refreshes - before);
        return refreshes >= 2 * pictures - 2 && eyes().kept - kept == refreshes;
    }
    [[nodiscard]] const ShownEyes& eyes() const { return *seen_eyes_; }
    [[nodiscard]] bool is_open() const { return seen_eyes_.has_value(); }
    [[nodiscard]] const std::string& end() const { return end_; }
    [[nodiscard]] std::string_view state() const { return presenter_->state(); }
    [[nodiscard]] DeviceCondition condition() const { return presenter_->condition(); }
    [[nodiscard]] const EyesOnTestClock& clock() const { return *clock_; }

    int slow_wakes = 0; ///< of a hundred: the thread wakes a refresh late or later

private:
    Nanoseconds latency() {
        const auto one_of = [this](unsigned count) { return static_cast<int>(random_() % count); };
        return one_of(100) < slow_wakes ? std::chrono::microseconds(2'000 + one_of(20'000))
                                        : std::chrono::microseconds(20 + one_of(500));
    }

    CardOnDesk& desk_;
    std::mt19937 random_;
    Result<KmsCard> card_;
    std::unique_ptr<KmsDevice> kms_;
    std::optional<EyesOnTestClock> clock_;
    std::optional<ShownEyes> seen_eyes_;
    std::optional<Presenter> presenter_;
    CardSeen seen_;
    std::string end_;
};

} // namespace frustumscreen::display
