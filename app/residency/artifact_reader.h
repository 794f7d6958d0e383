/// A thread that reads and prepares one item at a time, an artifact or some of its texts, so that the render
/// thread does not.
///
/// The render thread requests an item by number, and finds it ready some frames later. Neither thread waits
/// for the other: a lock held by a thread of low priority could stop the picture.
///
/// Threads  `request` and `take` from one thread; they neither wait nor read a file. `prepare` runs on the
///          reader's own thread, which has a low priority and uses the time that the picture leaves.
/// Errors   those of `prepare`, as an answer.
#pragma once

#include "app/residency/prepared_artifact.h"
#include "firmware_host/base/result.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <variant>

namespace frustumscreen::residency {

class ArtifactReader {
public:
    using Prepared = std::variant<TextPictures, PreparedArtifact>;
    /// True if the item is not wanted any more: `prepare` should then return soon, with any result.
    using GivenUp = std::function<bool()>;
    using Prepare = std::function<Result<Prepared>(std::size_t item, const GivenUp& given_up)>;
    struct Answer {
        std::size_t item = 0;
        Result<Prepared> prepared;
    };

    /// Starts the thread.
    explicit ArtifactReader(Prepare prepare);
    /// Cancels the item in progress and waits for the thread.
    ~ArtifactReader();
    ArtifactReader(const ArtifactReader&) = delete;
    ArtifactReader& operator=(const ArtifactReader&) = delete;

    /// Requests an item, or nothing; any other item in progress is cancelled. An item requested again after
    /// its answer was taken is prepared again.
    void request(std::optional<std::size_t> item);
    /// Returns the prepared item, once; it may answer a request before the latest.
    [[nodiscard]] std::unique_ptr<Answer> take();

private:
    void work();

    /// `wanted_` is an item or one of these values.
    static constexpr std::uint32_t nothing = ~std::uint32_t{0};
    static constexpr std::uint32_t the_end = nothing - 1;

    Prepare prepare_;
    std::atomic<std::uint32_t> wanted_{nothing};
    std::atomic<Answer*> answer_{nullptr}; ///< owned by whichever thread exchanges it out
    std::jthread thread_;                  ///< last: it uses the others
};

} // namespace frustumscreen::residency
