/// A thread that reads and prepares one item at a time, so that the render thread does not.
///
/// The render thread requests an item by number, and finds it ready some frames later. Neither thread waits
/// for the other: a lock held by a thread of low priority could stop the picture.
///
/// Threads  `request` and `take` from one thread; they neither wait nor read a file. `prepare` runs on the
///          reader's own thread, which has a low priority and uses the time that the picture leaves.
/// Errors   those of `prepare`, as an answer.
#pragma once

#include "firmware_host/base/device_thread.h"
#include "firmware_host/base/result.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

namespace frustumscreen::residency {

template <typename Item> class BackgroundReader {
public:
    using Prepared = Item;
    /// True if the item is not wanted any more: `prepare` should then return soon, with any result.
    using GivenUp = std::function<bool()>;
    using Prepare = std::function<Result<Prepared>(std::size_t item, const GivenUp& given_up)>;
    struct Answer {
        std::size_t item = 0;
        Result<Prepared> prepared;
    };

    /// Starts the thread; `name`: as begin_device_thread, a literal.
    explicit BackgroundReader(Prepare prepare, const char* name = "artifacts")
        : prepare_(std::move(prepare)), thread_([this, name] { work(name); }) {}
    /// Cancels the item in progress and waits for the thread.
    ~BackgroundReader() {
        wanted_ = the_end;
        wanted_.notify_one();
        thread_.join();
        delete answer_.load();
    }
    BackgroundReader(const BackgroundReader&) = delete;
    BackgroundReader& operator=(const BackgroundReader&) = delete;

    /// Requests an item, or nothing; any other item in progress is cancelled. An item requested again after
    /// its answer was taken is prepared again.
    void request(std::optional<std::size_t> item) {
        const std::uint32_t wanted = item ? static_cast<std::uint32_t>(*item) : nothing;
        if (wanted_.exchange(wanted) != wanted) {
            wanted_.notify_one();
        }
    }
    /// Returns the prepared item, once; it may answer a request before the latest.
    [[nodiscard]] std::unique_ptr<Answer> take() {
        return std::unique_ptr<Answer>(answer_.exchange(nullptr));
    }

private:
    void work(const char* name) {
        begin_device_thread(name, ThreadPriority::Low);
        while (true) {
            wanted_.wait(nothing);
            const std::uint32_t item = wanted_;
            if (item == the_end) {
                return;
            }
            if (item == nothing) {
                continue;
            }
            bool gave_up = false; // permanent: an equal request may have returned in between
            auto answer = std::make_unique<Answer>(Answer{item, prepare_(item, [&] {
                                                              gave_up = gave_up || wanted_ != item;
                                                              return gave_up;
                                                          })});
            if (gave_up || wanted_ != item) {
                continue;
            }
            delete answer_.exchange(answer.release());
            std::uint32_t still = item;
            wanted_.compare_exchange_strong(still, nothing); // done, unless another request has arrived
        }
    }

    /// `wanted_` is an item or one of these values.
    static constexpr std::uint32_t nothing = ~std::uint32_t{0};
    static constexpr std::uint32_t the_end = nothing - 1;

    Prepare prepare_;
    std::atomic<std::uint32_t> wanted_{nothing};
    std::atomic<Answer*> answer_{nullptr}; ///< owned by whichever thread exchanges it out
    std::jthread thread_;                  ///< last: it uses the others
};

} // namespace frustumscreen::residency
